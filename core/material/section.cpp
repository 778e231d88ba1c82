#include "core/material/section.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/material/laws/membrane.hpp"

namespace gambeson {

Voigt reducedStiffness(const Ply& ply) {
  const auto reject = [](const char* key, const char* reason) { throw InputError({"", 0, key}, reason); };
  if (!(ply.young1_Pa > 0) || !std::isfinite(ply.young1_Pa)) reject("young1_Pa", "must be > 0");
  if (!(ply.young2_Pa > 0) || !std::isfinite(ply.young2_Pa)) reject("young2_Pa", "must be > 0");
  if (!(ply.shear_Pa > 0) || !std::isfinite(ply.shear_Pa)) reject("shear_Pa", "must be > 0");
  if (!(ply.poisson12 * ply.poisson12 * ply.young2_Pa < ply.young1_Pa))
    reject("poisson12", "must satisfy poisson12^2 young2 < young1");
  if (!std::isfinite(ply.angle_rad)) reject("angle_rad", "must be finite");
  Voigt Q;
  planeStress(ply.young1_Pa, ply.young2_Pa, ply.shear_Pa, ply.poisson12, 1.0, Q.data());
  const double Q11 = Q[0], Q22 = Q[1], Q12 = Q[3], Q66 = Q[2];
  const double c = std::cos(ply.angle_rad), s = std::sin(ply.angle_rad), c2 = c * c, s2 = s * s, cs = c * s;
  return {Q11 * c2 * c2 + 2 * (Q12 + 2 * Q66) * s2 * c2 + Q22 * s2 * s2,
          Q11 * s2 * s2 + 2 * (Q12 + 2 * Q66) * s2 * c2 + Q22 * c2 * c2,
          (Q11 + Q22 - 2 * Q12 - 2 * Q66) * s2 * c2 + Q66 * (s2 * s2 + c2 * c2),
          (Q11 + Q22 - 4 * Q66) * s2 * c2 + Q12 * (s2 * s2 + c2 * c2),
          (Q11 - Q12 - 2 * Q66) * cs * c2 + (Q12 - Q22 + 2 * Q66) * s2 * cs,
          (Q11 - Q12 - 2 * Q66) * s2 * cs + (Q12 - Q22 + 2 * Q66) * cs * c2};
}

Section laminate(std::span<const Ply> plies) {
  if (plies.empty()) throw InputError({"", 0, "plies"}, "at least one ply is needed");
  double total = 0;
  for (std::size_t k = 0; k < plies.size(); ++k) {
    if (!(plies[k].thickness_m > 0) || !std::isfinite(plies[k].thickness_m))
      throw InputError({"", 0, "plies[" + std::to_string(k) + "].thickness_m"}, "must be > 0");
    total += plies[k].thickness_m;
  }
  Section section;
  double bottom = -0.5 * total;
  for (std::size_t k = 0; k < plies.size(); ++k) {
    Voigt Q;
    try {
      Q = reducedStiffness(plies[k]);
    } catch (const InputError& e) {
      throw InputError({"", 0, "plies[" + std::to_string(k) + "]." + e.where().key}, e.reason());
    }
    // Powers of the top less those of the bottom, by h and the mid-height: a single ply has B = 0 exactly.
    const double h = plies[k].thickness_m, mid = plies.size() == 1 ? 0.0 : bottom + 0.5 * h;
    for (int i = 0; i < 6; ++i) {
      section.A[i] += Q[i] * h;
      section.B[i] -= Q[i] * h * mid;
      section.D[i] += Q[i] * h * (mid * mid + h * h / 12);
    }
    bottom += h;
  }
  return section;
}

}  // namespace gambeson
