#pragma once
/// What keeps a membrane from being crushed to nothing.
///
/// A St. Venant-Kirchhoff membrane resists compression along one direction up to a stretch of 1/sqrt(3) = 0.58 only and
/// gives way beyond: pressed into a fold narrower than a cell, cloth collapses to a point there, and the stable step
/// with it. Real cloth buckles long before, in folds that the cells cannot resolve, and these jam: their layers meet.
/// With the square of the area ratio s = det(1 + 2 E) the energy per area is, where s < s0,
///   W_jam = k/8 (s0/s - 1)^2,   near s0: k/2 (1 - J/J0)^2 with J = sqrt(s),
/// zero elsewhere: C1, without bound as the area vanishes. With k = jam_share times the larger of the membrane's two
/// stiffnesses, compression along one direction resists more the farther it goes (d2W/dJ2 >= 0 for all J) wherever the
/// other direction is stretched by no more than a fifth. Strains above are untouched, to the last bit.

#include <algorithm>

#include "core/material/section.hpp"

namespace gambeson {

/// k as a part of the larger of A11 and A22; 0.05 would do to keep compression stable.
inline constexpr double jam_share = 0.1;
/// Nothing is that small; keeps numbers finite.
inline constexpr double jam_least_s = 1e-6;

/// k [N/m] of a membrane.
inline double jamStiffness(const Voigt& A) { return jam_share * std::max(A[0], A[1]); }

}  // namespace gambeson
