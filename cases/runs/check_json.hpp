#pragma once
/// Checks of a run as summary.json lists them.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "analysis/report/report.hpp"

namespace gambeson {

/// A list with an object for each check: name, value, limit and unit, whether it holds, what is compared with what, and
/// in words what is wrong where it fails (else empty).
nlohmann::ordered_json checkJson(const std::vector<AuditCheck>& checks);

}  // namespace gambeson
