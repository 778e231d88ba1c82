#pragma once
/// The key strain_limit of cases of kind wear and dynamic.

#include <optional>
#include <string>

#include "core/dynamics/strain_limit.hpp"

namespace gambeson {

/// Strain limiting of weft and warp by projection (core/dynamics/strain_limit.hpp).
struct StrainLimitCase {
  LimitMode mode = LimitMode::upper_limit;
  std::optional<double> limit;  ///< Green-Lagrange strain, of upper_limit alone
  double tolerance = 2e-3;      ///< of the strain
  int max_projections = 40;     ///< of one pass
  LimitPoints points = LimitPoints::vertices;
};

StrainLimit limitOf(const StrainLimitCase& c);
/// A sentence for reports; what the stress includes is said with `mean` ("of the last step", say).
std::string limitInWords(const StrainLimitCase& c, const std::string& mean);

}  // namespace gambeson
