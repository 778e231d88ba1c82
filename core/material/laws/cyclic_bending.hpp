#pragma once
/// Hysteresis of bending whose set and fatigue come at the ends of cycles, as Wong 2014 prints them: a reference.

#include "core/material/laws/hysteresis_bending.hpp"

namespace gambeson {

/// Doubles that a line of it remembers: those of the stops, and curvature and moment where the last step ended and
/// where the recovery began, both without the set.
constexpr int kCyclicHistory = kStopHistory<kStops, LineCurvature> + 4;

/// Where the moment of a loop vanishes that comes back from the curvature `top_k` > 0 and the moment `top_m` > 0, K_r of
/// Wong 2014, section 4.3.3: the virgin curve doubled (eq. 4.8), quadratic over 2 K0 with slopes from b1 to b2, M0 the
/// moment of all friction. At most `top_k`.
template <class S>
GAMBESON_LAW S residualCurvature(const S& top_k, const S& top_m, const S& b1, const S& b2, const S& K0, const S& M0) {
  const S fall = (b1 - b2) / (2.0 * K0), below = b1 * b1 - 2.0 * fall * top_m;
  const S on_quadratic = top_k - 2.0 * top_m / (b1 + root(pick(below > 0.0, below, S{})));
  const S on_line = M0 / pick(b2 > 0.0, b2, spread<S>(1e-300));
  const S found = pick(top_m > 2.0 * (M0 + b2 * K0), on_line, on_quadratic);
  return pick(found < 0.0, S{}, pick(found > top_k, top_k, found));
}

/// One line: the loop of sumOfStops without its own ageing, and at the end of each cycle of bending and recovery, even a
/// partial one, where friction was overcome (|M_m| > M_a = M0 + b2 K0 at its turn),
///   kp += xi lambda K_r,   M0 -> (1 - mu xi) M0,   xi = min(1, (|M_m| - |M|)/(2 M_a))
/// (Wong 2014, eq. 4.6, 4.7, 4.11). A cycle ends where recovery turns to bending, or the moment passes zero. K0 stays
/// where eq. 4.12 lets it fall with the root of M0. The jump acts from the next step on; what it takes from the stored
/// energy counts as lost, and is negative where the rule makes energy. A vibration is a cycle, so that both depend on
/// how the motion is resolved: for comparison with the thesis, not for garments. Valid as sumOfStops, and for b2 > 0.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void stopsWithCycles(const P* D, const StopNumbers<P>& n, const S* k, History<S> history, int at,
                                  Answer<S, 1>& out) {
  constexpr int set_at = kStops, worn_at = set_at + 1, last_at = worn_at + 1;
  Answer<S, 1> loop;
  sumOfStops<(kParts | with_energy), kStops, LineCurvature>(
      D, StopNumbers<P>{n.drop, n.reach, n.rise, n.span, n.wear, P{}, P{}}, k, history, at, loop);
  const S zero{}, set = history.before(at + set_at), left = 1.0 - history.before(at + worn_at);
  const S last_k = history.before(at + last_at), last_m = history.before(at + last_at + 1),
          top_k = history.before(at + last_at + 2), top_m = history.before(at + last_at + 3);
  const S now_k = k[0] - set, now_m = loop.resultant[0];
  P reaches{};
  for (int j = 0; j < kStops; ++j) reaches += n.drop[j] * n.reach[j];
  const S b2 = spread<S>(D[0]), K0 = spread<S>(n.span), M0 = left * spread<S>(n.rise * n.span * reaches),
          Ma = M0 + b2 * K0;
  const S size = magnitude(top_m);
  const S passes = pick(now_m * last_m > 0.0, zero, spread<S>(1.0));
  const S falls = pick(magnitude(now_m) < magnitude(last_m), 1.0 - passes, zero);
  const S recovered = pick(size > 0.0, spread<S>(1.0), zero), ends = recovered * (1.0 - falls);
  const S at_end = pick(passes > 0.0, zero, magnitude(last_m));
  const S overcome = (size - at_end) / (2.0 * Ma);
  const S xi = pick(size > Ma, ends * pick(overcome < 1.0, overcome, spread<S>(1.0)), zero);
  const S sign = pick(top_m < 0.0, spread<S>(-1.0), spread<S>(1.0));
  const S back = residualCurvature(S(sign * top_k), size, S(b2 + left * n.rise), b2, K0, M0);
  const S jump = xi * n.setting * sign * back, kept = 1.0 - xi * (1.0 - spread<S>(n.fatigue));
  history.keep(at + set_at, set + jump);
  history.keep(at + worn_at, 1.0 - left * kept);
  history.keep(at + last_at, now_k - jump);
  // What the next step starts from: without the jump of the moment, which is no recovery.
  history.keep(at + last_at + 1, b2 * (now_k - jump) + kept * (now_m - b2 * now_k));
  const S starts = falls * (1.0 - recovered), goes_on = falls * recovered;
  history.keep(at + last_at + 2, starts * last_k + goes_on * top_k);
  history.keep(at + last_at + 3, starts * last_m + goes_on * top_m);
  out.resultant[0] = now_m;
  if constexpr (kParts & with_slope) out.slope[0] = loop.slope[0];
  if constexpr (kParts & with_energy) {
    const S elastic = 0.5 * b2 * now_k * now_k, friction = loop.energy - elastic;
    const S after = 0.5 * b2 * (now_k - jump) * (now_k - jump) + kept * friction;
    out.energy += after;
    out.lost += loop.lost + (loop.energy - after);
  }
}

/// Weft, warp and twist each for itself.
struct CyclicHysteresisBending : FrictionInBending {
  static constexpr int history_size = 3 * kCyclicHistory;

  bool operator==(const CyclicHysteresisBending&) const = default;
  /// In place of nu, what a cycle leaves of the friction, 1 - mu.
  std::array<double, number_count> numbers() const {
    auto all = FrictionInBending::numbers();
    all[2 * kStops + 9] = 1 - fatigue;
    return all;
  }
  static CyclicHysteresisBending mixed(const CyclicHysteresisBending& a, const CyclicHysteresisBending& b, double w) {
    return {FrictionInBending::mixed(a, b, w)};
  }
  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S> history, Answer<S, 3>& out) {
    for (int i = 0; i < 3; ++i) {
      Answer<S, 1> one;
      stopsWithCycles<kParts>(D + i, stopsOf(numbers, i), k + i, history, i * kCyclicHistory, one);
      out.resultant[i] = one.resultant[0];
      if constexpr (kParts & with_energy) {
        out.energy += one.energy;
        out.lost += one.lost;
      }
      if constexpr (kParts & with_slope) out.slope[i] = one.slope[0];
    }
    if constexpr (kParts & with_slope) out.slope[3] = out.slope[4] = out.slope[5] = S{};
  }
  template <class P>
  GAMBESON_LAW static P steepest(int i, const P* D, const P* numbers) {
    return D[i] + numbers[2 * kStops + i];
  }
};

}  // namespace gambeson
