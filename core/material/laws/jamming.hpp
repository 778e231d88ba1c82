#pragma once
/// What keeps a membrane from being crushed to nothing.

#include <algorithm>

#include "core/material/laws/law.hpp"
#include "core/material/section.hpp"

namespace gambeson {

/// k as a part of the larger of A11 and A22; 0.05 would do to keep compression stable.
inline constexpr double jam_share = 0.1;
/// Nothing is that small; keeps numbers finite.
inline constexpr double jam_least_s = 1e-6;

/// k [N/m] of a membrane.
inline double jamStiffness(const Voigt& A) { return jam_share * std::max(A[0], A[1]); }

/// A St. Venant-Kirchhoff membrane resists compression along one direction up to a stretch of 1/sqrt(3) = 0.58 only and
/// gives way beyond: pressed into a fold narrower than a cell, cloth collapses to a point there, and the stable step
/// with it. Real cloth buckles long before, in folds that the cells cannot resolve, and these jam: their two sides
/// meet. With the square of the area ratio s = det(1 + 2 E) the energy per area is, where s < s0,
///   W_jam = k/8 (s0/s - 1)^2,   near s0: k/2 (1 - J/J0)^2 with J = sqrt(s),
/// zero elsewhere: C1, without bound as the area vanishes. With k = jam_share times the larger of the membrane's two
/// stiffnesses, compression along one direction resists more the farther it goes (d2W/dJ2 >= 0 for all J) wherever the
/// other direction is stretched by no more than a fifth. Strains above are untouched, to the last bit. Ours: no thesis
/// has it (core/material/DECISIONS.md). k >= 0 [N/m], 0 <= s0 < 1.
///
/// Adds to all of `out`, also to resultants and slope: to a membrane's.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void addJamming(const P& k, const P& s0, const S* e, Answer<S, 3>& out) {
  const S a = 1.0 + 2.0 * e[0], b = 1.0 + 2.0 * e[1], det = a * b - e[2] * e[2];
  const S s = pick(det > jam_least_s, det, Number<S>::of(jam_least_s)), inv = 1.0 / s;
  const S ratio = s0 * inv, r = pick(ratio > 1.0, ratio - 1.0, S{});
  const S push = -0.25 * k * r * ratio * inv;  // dW/ds
  const S grad[3] = {2.0 * b, 2.0 * a, -2.0 * e[2]};
  out.resultant[0] += push * grad[0];
  out.resultant[1] += push * grad[1];
  out.resultant[2] += push * grad[2];
  if constexpr (kParts & with_energy) out.energy += 0.125 * k * (r * r);
  if constexpr (kParts & with_slope) {
    const S steep = pick(ratio > 1.0, 0.25 * k * ratio * inv * inv * (ratio + 2.0 * r), S{});  // d2W/ds2
    constexpr int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
    for (int i = 0; i < 6; ++i) out.slope[i] += steep * grad[row[i]] * grad[column[i]];
    out.slope[3] += 4.0 * push;
    out.slope[2] -= 2.0 * push;
  }
}

}  // namespace gambeson
