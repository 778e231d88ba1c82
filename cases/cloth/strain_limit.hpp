#pragma once
/// The key strain_limit of cases of kind wear and dynamic.

#include <optional>
#include <string>

#include "core/motion/strain_limit.hpp"

namespace gambeson {

/// Strain limiting of weft and warp by projection (core/motion/strain_limit.hpp).
struct StrainLimitCase {
  LimitMode mode = LimitMode::upper_limit;
  std::optional<double> limit;              ///< Green-Lagrange strain, of upper_limit alone
  std::optional<double> stiffness_N_per_m;  ///< of threads that the limit holds
  double tolerance = 2e-3;                  ///< of the strain
  int max_projections = 40;                 ///< of one pass
  LimitPoints points = LimitPoints::vertices;
  LimitMethod method = LimitMethod::fast;
};

/// Of cloth that is worn, whose threads yield where the case does not say by how much: a tension of 100 N/m uses up the
/// tolerance.
StrainLimit wornLimit(const StrainLimitCase& c);
StrainLimit limitOf(const StrainLimitCase& c);
/// A sentence for reports; what the stress includes is said with `mean` ("of the last step", say).
std::string limitInWords(const StrainLimitCase& c, const std::string& mean);

}  // namespace gambeson
