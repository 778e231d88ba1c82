#include "core/material/linearised.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace gambeson {

Fabric withEnergy(Fabric fabric, std::shared_ptr<const PointEnergy> energy) {
  constexpr double kLeastShear = 1e-6;
  const std::array<double, 36> slope = energy->at({}).slope;
  const double A11 = slope[0], A22 = slope[7], A12 = slope[1], A33 = slope[14], h = fabric.thickness_m;
  const double s = 1 - A12 * A12 / (A11 * A22);
  if (!(h > 0) || !(A11 > 0 && A22 > 0 && s > 0) || !std::isfinite(A33))
    throw InputError({"", 0, "law"},
                     "stretch is not resisted at rest: the slopes along weft and warp must be positive");
  fabric.young_weft_Pa = A11 * s / h;
  fabric.young_warp_Pa = A22 * s / h;
  fabric.poisson = A12 / A22;
  fabric.shear_Pa = std::max(A33, kLeastShear * std::sqrt(A11 * A22)) / h;
  fabric.law = LinearBending{{slope[21], slope[28], slope[35]}};
  fabric.jam_area = 0;
  fabric.energy = std::move(energy);
  return fabric;
}

}  // namespace gambeson
