#include "core/material/linearised.hpp"

#include <utility>

#include "core/error.hpp"

namespace gambeson {

Fabric withEnergy(Fabric fabric, std::shared_ptr<const PointEnergy> energy) {
  const std::array<double, 36> slope = energy->at({}).slope;
  const double A11 = slope[0], A22 = slope[7], A12 = slope[1], A33 = slope[14], h = fabric.thickness_m;
  const double s = 1 - A12 * A12 / (A11 * A22);
  if (!(h > 0) || !(A11 > 0 && A22 > 0 && A33 > 0 && s > 0))
    throw InputError({"", 0, "law"}, "the cloth is not stiff at rest: its membrane there must be positive definite");
  fabric.young_weft_Pa = A11 * s / h;
  fabric.young_warp_Pa = A22 * s / h;
  fabric.poisson = A12 / A22;
  fabric.shear_Pa = A33 / h;
  fabric.law = LinearBending{{slope[21], slope[28], slope[35]}};
  fabric.jam_area = 0;
  fabric.energy = std::move(energy);
  return fabric;
}

}  // namespace gambeson
