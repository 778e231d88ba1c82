#pragma once
/// Whether the numbers of a cell can be trusted: what its own table says of them.

#include <vector>

#include "analysis/report/report.hpp"
#include "cases/cell/recording.hpp"

namespace gambeson {

std::vector<AuditCheck> cellChecks(const RecordedCell& cell);

}  // namespace gambeson
