#pragma once
/// Checks of how far garments are stretched against the limits that their fabrics, or the cards of these, state.

#include <span>
#include <vector>

#include "analysis/report/report.hpp"
#include "analysis/trust.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson {

/// One for each garment and direction with a limit; a law's own range is none (the check "Law range" is about that).
std::vector<AuditCheck> stretchChecks(const Case& c, std::span<const Stretch> measured);

}  // namespace gambeson
