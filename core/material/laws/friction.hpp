#pragma once
/// Friction between surfaces that touch.

#include "core/material/laws/law.hpp"

namespace gambeson {

/// Coulomb's law as contact applies it to one row (Zheng 2013, eq. 3.19 and 3.20; Wong 2014, chapter 7, model C): of a
/// trial impulse (or traction) p and the unit normal n,
///   p_n = p . n <= 0:         0, the surfaces part;
///   |p_t| <= mu p_n:          p, they stick;       p_t = p - p_n n
///   |p_t| > mu p_n:           p_n (n + mu p_t/|p_t|), they slip.
/// The normal part is kept, the tangential one cut to the cone. It has no potential: `slope`, d(impulse)/dp, 3 x 3 row
/// by row, is not symmetric. Impulse and slope in the units of p. Valid for mu >= 0.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void coulombImpulse(const P& mu, const P* n, const S* p, S* impulse, [[maybe_unused]] S* slope = nullptr) {
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
  const S size2 = t[0] * t[0] + t[1] * t[1] + t[2] * t[2], limit = mu * pressed;
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

}  // namespace gambeson
