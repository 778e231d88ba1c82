#pragma once
/// Friction between the threads of sheared cloth: sums of stops beside the membrane's elastic shear.

#include "core/material/laws/stops.hpp"

namespace gambeson {

/// Numbers of the friction in shear.
struct ShearFriction {
  double rise_N_per_m = 0;    ///< slope of its stops together, where cloth was never sheared
  double span = 0;            ///< shear strain from which on all slip
  double growth_N_per_m = 0;  ///< the same of the part that grows with the shear, at kShearReference
  bool operator==(const ShearFriction&) const = default;
};

constexpr int kShearStops = 4;
/// Of a slope that falls in a straight line over the span (Wong 2014, eq. 4.2, as in bending), in intervals that end at
/// (j/4)^1.5 of it: each stop has the fall of its interval and slips at its middle.
inline constexpr double kShearEnds[kShearStops + 1] = {0, 0.125, 0.35355339059327379, 0.64951905283832900, 1};
constexpr int kShearHistory = 2 * kStopHistory<kShearStops, LineCurvature>;
/// Shear strain (E12 twice, in simple shear the tangent of the angle) at which the growing part has its slope: 5
/// degrees, where KES-FB1 reads 2HG5; and from which on it grows no more: 8 degrees, where that instrument turns.
inline constexpr double kShearReference = 0.087488663525924, kShearMost = 0.14054083470239;

/// g = 2 E12 [1]: two sums of stops (sumOfStops of stops.hpp, without an elastic part), one on g and one on
///   x(g) = g |g|/(2 g5) up to |g| = g8, and straight from there on,
/// whose friction is multiplied by x' = |g|/g5: threads that turn press on each other the more the farther they are
/// turned, so that the loop is wider at 5 degrees than at 0.5 (2HG5 > 2HG of KES-FB1; Kawabata 1980). Adds
///   n12 = stops(g) + x' stops(x)  [N/m]
/// and the energies of both to a membrane's answer: n12 is the gradient of stored + lost, what is lost is never
/// negative, and the history (from `at` on: that of the first sum, then of the second) is of both. Valid for numbers
/// >= 0, span > 0 where one is; `numbers`: rise, span, growth.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void addShearFriction(const P* numbers, const S& g, History<S> history, int at, Answer<S, 3>& out) {
  P drop[kShearStops], reach[kShearStops];
  for (int j = 0; j < kShearStops; ++j) {
    drop[j] = spread<P>(kShearEnds[j + 1] - kShearEnds[j]);
    reach[j] = spread<P>(0.5 * (kShearEnds[j + 1] + kShearEnds[j]));
  }
  const P none[1] = {spread<P>(0.0)};
  const StopNumbers<P> steady{drop, reach, numbers[0], numbers[1], none[0], none[0], none[0]};
  const StopNumbers<P> growing{drop, reach, numbers[2], numbers[1], none[0], none[0], none[0]};
  const S size = magnitude(g), inner = pick(size < kShearMost, size, spread<S>(kShearMost));
  const S turn = inner * (1.0 / kShearReference), way = turn * (size - 0.5 * inner), x = pick(g < 0.0, -way, way);
  Answer<S, 1> one, two;
  sumOfStops<kParts, kShearStops, LineCurvature>(none, steady, &g, history, at, one);
  sumOfStops<kParts, kShearStops, LineCurvature>(none, growing, &x, history, at + kShearHistory / 2, two);
  out.resultant[2] += one.resultant[0] + turn * two.resultant[0];
  if constexpr (kParts & with_energy) {
    out.energy += one.energy + two.energy;
    out.lost += one.lost + two.lost;
  }
  if constexpr (kParts & with_slope) {
    const S bend = pick(size < kShearMost, spread<S>(1.0 / kShearReference), S{}) * two.resultant[0];
    out.slope[2] += one.slope[0] + turn * turn * two.slope[0] + pick(g < 0.0, -bend, bend);
  }
}

/// The most that this may add to the slope of n12 [N/m].
template <class P>
GAMBESON_LAW P steepestShearFriction(const P* numbers) {
  constexpr double most = kShearMost / kShearReference;
  return numbers[0] + numbers[2] * (most * most + numbers[1] * (1.0 / kShearReference));
}

}  // namespace gambeson
