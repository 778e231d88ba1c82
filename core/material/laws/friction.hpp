#pragma once
/// Friction between surfaces that touch.

#include <algorithm>
#include <cmath>

#include "core/material/laws/law.hpp"

namespace gambeson {

/// Coulomb's law as contact applies it to one row (Zheng 2013, eq. 3.19 and 3.20; Wong 2014, chapter 7, model C): of a
/// trial impulse (or traction) p and the unit normal n,
///   p_n = p . n <= 0:             0, the surfaces part;
///   |p_t| <= mu p_n + drag:       p, they stick;       p_t = p - p_n n
///   |p_t| > mu p_n + drag:        p_n n + (mu p_n + drag) p_t/|p_t|, they slip.
/// `drag` is what sliding costs whatever the pressure (viscosity), 0 in model C.
/// The normal part is kept, the tangential one cut to the cone. It has no potential: `slope`, d(impulse)/dp, 3 x 3 row
/// by row, is not symmetric. Impulse and slope in the units of p. Valid for mu, drag >= 0.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void coulombImpulse(const P& mu, const P& drag, const P* n, const S* p, S* impulse,
                                 [[maybe_unused]] S* slope = nullptr) {
  const S pressed = p[0] * n[0] + p[1] * n[1] + p[2] * n[2];
  const auto touches = pressed > 0.0;
  if (!anyOf<S>(touches)) {
    impulse[0] = impulse[1] = impulse[2] = S{};
    if constexpr (kParts & with_slope)
      for (int i = 0; i < 9; ++i) slope[i] = S{};
    return;
  }
  S t[3];
  for (int i = 0; i < 3; ++i) t[i] = p[i] - pressed * n[i];
  const S size2 = t[0] * t[0] + t[1] * t[1] + t[2] * t[2], limit = mu * pressed + drag;
  const auto slips = size2 > limit * limit;
  if constexpr (kParts & with_slope) {
    const S one = spread<S>(1.0), size = root(pick(slips, size2, one)), share = limit / size;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const S identity = spread<S>(i == j ? 1.0 : 0.0), along = t[i] / size, across = t[j] / size;
        const S slipping = n[i] * n[j] + mu * along * n[j] + share * (identity - n[i] * n[j] - along * across);
        slope[3 * i + j] = pick(touches, pick(slips, slipping, identity), S{});
      }
  }
  if (anyOf<S>(slips)) {
    const S cut = limit / root(size2);
    for (int i = 0; i < 3; ++i) t[i] = pick(slips, t[i] * cut, t[i]);
  }
  for (int i = 0; i < 3; ++i) impulse[i] = pick(touches, pressed * n[i] + t[i], S{});
}

/// Friction that depends on the motion (Wong 2014, eq. 7.1 to 7.7), a part of the pressure p [Pa] and, of viscosity, a
/// traction of its own. Of a contact that does not slip, mu_s p may hold it; of one that slips at v [m/s], what resists
/// is
///   mu(v) p + F_v v^d_v,   mu(v) = mu_c + (mu_s - mu_c) exp(-(v/v_S)^d_S),   v_S = 0: mu_c.
/// Model C: mu_s = mu_c; CS: v_S = 0; CSS: v_S > 0; CSSV: with F_v > 0. Both mu go with the pressure as (p/p_1)^(n - 1)
/// where p_1 > 0 (n below 1: fibres that flatten), p below p_1/100 counting as that; and with the direction of what
/// slips, or is about to, as sqrt(cos^2 a + w^2 sin^2 a), a its angle to the cloth's weft: an ellipse, w that along the
/// warp. Friction stays opposite to the slip. Valid for mu_s >= mu_c >= 0, d_S, d_v, n, w > 0.
struct FrictionLaw {
  double kinetic = 0;           ///< mu_c
  double still = 0;             ///< mu_s
  double stribeck_m_per_s = 0;  ///< v_S
  double stribeck_power = 1;    ///< d_S
  double viscosity = 0;         ///< F_v [N/m^2 per (m/s)^d_v]
  double viscous_power = 1;     ///< d_v
  double pressure_Pa = 0;       ///< p_1
  double pressure_power = 1;    ///< n
  double along_warp = 1;        ///< w

  FrictionLaw() = default;
  FrictionLaw(double mu) : kinetic(mu), still(mu) {}  // NOLINT: a number means model C
  bool operator==(const FrictionLaw&) const = default;

  /// Whether one number says all.
  bool isCoulomb() const { return still == kinetic && viscosity == 0 && !goesWithPressure() && !goesWithDirection(); }
  bool goesWithDirection() const { return along_warp != 1; }
  bool goesWithPressure() const { return pressure_Pa > 0 && pressure_power != 1; }
  double slipping(double v) const {
    return stribeck_m_per_s > 0
               ? kinetic + (still - kinetic) * std::exp(-std::pow(v / stribeck_m_per_s, stribeck_power))
               : kinetic;
  }
  double drag(double v) const { return viscosity > 0 ? viscosity * std::pow(v, viscous_power) : 0; }
  /// `weft2`: cos^2 of the angle to the weft.
  double towards(double weft2) const {
    return goesWithDirection() ? std::sqrt(weft2 + along_warp * along_warp * (1 - weft2)) : 1;
  }
  double atPressure(double p) const {
    return goesWithPressure() ? std::pow(std::max(p / pressure_Pa, 0.01), pressure_power - 1) : 1;
  }
};

}  // namespace gambeson
