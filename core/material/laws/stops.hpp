#pragma once
/// Friction between the fibres of bent cloth: sums of stops, which make a measured loop of hysteresis with all its
/// inner loops, and what such a loop does to cloth that is bent again and again: set and fatigue.

#include <array>

#include "core/material/laws/law.hpp"

namespace gambeson {

/// A curvature along one line [1/m].
struct LineCurvature {
  static constexpr int size = 1;
  template <class S>
  GAMBESON_LAW static S norm2(const S* k) {
    return k[0] * k[0];
  }
  /// What is conjugate to component i, in parts of it.
  static constexpr double metric(int) { return 1; }
};

/// The tensor of curvature as (k11, k22, 2 k12) [1/m]; its norm is that of the tensor, the same about all axes.
struct PlaneCurvature {
  static constexpr int size = 3;
  template <class S>
  GAMBESON_LAW static S norm2(const S* k) {
    return k[0] * k[0] + k[1] * k[1] + 0.5 * k[2] * k[2];
  }
  static constexpr double metric(int i) { return i < 2 ? 1 : 0.5; }
};

/// How the slope of a virgin curve falls from its first value to its last, as stops.
template <int N>
struct StopShape {
  std::array<double, N> drop{};   ///< parts of the fall; their sum is 1
  std::array<double, N> reach{};  ///< curvatures at which they slip, as parts of that of the last value
  bool operator==(const StopShape&) const = default;
};

/// What a sum of stops that slips from `span` on [1/m] loses in a cycle from -`cycle` to `cycle` and back, per rise of
/// the slope [1/m^2].
template <int N>
double cycleLoss(const StopShape<N>& shape, double span, double cycle) {
  double sum = 0;
  for (int j = 0; j < N; ++j) {
    const double reach = span * shape.reach[static_cast<std::size_t>(j)];
    if (cycle > reach) sum += 4 * shape.drop[static_cast<std::size_t>(j)] * reach * (cycle - reach);
  }
  return sum;
}

/// The numbers of a sum of N stops: `drop` the parts that they have of the rise of the slope (their sum is 1), `reach`
/// the curvatures at which they slip, as parts of `span`.
template <class P>
struct StopNumbers {
  const P *drop, *reach;
  P rise;     ///< slope of all stops together, b1 - b2 [N m]
  P span;     ///< curvature from which on all slip, K0 [1/m]
  P wear;     ///< 1 over what the stops lose in a cycle of reference, as a part of the rise [m^2]
  P fatigue;  ///< nu: -ln of what a cycle of reference leaves of the friction
  P setting;  ///< lambda: how fast the set follows the curvature
};

/// 1 - exp(-x) for x >= 0 within x^5/120, in [0, 1).
template <class S>
GAMBESON_LAW S decayed(const S& x) {
  const S y = x * (1.0 + x * (1.0 / 2) * (1.0 + x * (1.0 / 3) * (1.0 + x * (1.0 / 4))));
  return y / (1.0 + y);
}

/// Doubles that a sum of N stops remembers: its sliders, its set and what it has lost of its friction.
template <int N, class Space>
constexpr int kStopHistory = (N + 1) * Space::size + 1;

/// The moment m of a curvature k, D the rigidities of what is elastic:
///   m = D (k - kp) + phi rise sum_j drop_j e_j,   e_j = k - q_j,   |e_j| <= span reach_j,
/// in which the slider q_j follows k where it must (Prandtl's elements in parallel; with many of them Masing's rule:
/// reversed curves are the virgin one doubled, and inner loops close). Wong 2014, eq. 4.2 to 4.8, is the loop of one
/// virgin curve; his rule for turning points is this one wherever he states it, and lets inner loops drift elsewhere.
/// Per slip, ds = wear sum_j drop_j span reach_j |dq_j| (1 in a cycle of reference, from -K to K and back),
///   dphi = -nu phi ds,   dkp = lambda phi (k - kp) ds,
/// in place of eq. 4.6 to 4.12, which jump at the end of each cycle and count vibrations as cycles. Both act from the
/// next step on: within a step phi and kp are those that were committed, so that m is the gradient of stored + lost.
/// stored = (k - kp) D (k - kp)/2 + phi rise sum drop |e|^2/2 with what the step leaves of phi and kp; lost is what
/// slips and what these take, never negative. Valid for D, rise, nu, lambda >= 0, span > 0. History from `at` on:
/// q_0, q_1, ..., kp, 1 - phi.
template <unsigned kParts, int N, class Space, class S, class P>
GAMBESON_LAW void sumOfStops(const P* D, const StopNumbers<P>& n, const S* k, History<S> history, int at,
                             Answer<S, Space::size>& out) {
  constexpr int kSize = Space::size;
  constexpr int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  const int set_at = at + N * kSize, worn_at = set_at + kSize;
  const S worn = history.before(worn_at), left = 1.0 - worn;
  S off[kSize];  // from the set
  for (int i = 0; i < kSize; ++i) {
    off[i] = k[i] - history.before(set_at + i);
    out.resultant[i] = D[i] * off[i];
  }
  if constexpr (kParts & with_slope)
    for (int i = 0; i < kSize; ++i)
      for (int l = i; l < kSize; ++l) out.slope[voigt[i][l]] = i == l ? spread<S>(D[i]) : S{};
  S held{}, slipped{}, sum[kSize]{};
  for (int j = 0; j < N; ++j) {
    const S reach = spread<S>(n.span * n.reach[j]);
    S slider[kSize], e[kSize];
    for (int i = 0; i < kSize; ++i) {
      slider[i] = history.before(at + j * kSize + i);
      e[i] = k[i] - slider[i];
    }
    const S size2 = Space::norm2(e);
    const auto slips = size2 > reach * reach;
    if constexpr (kParts & with_slope) {
      const S weight = left * (n.rise * n.drop[j]), squared = pick(slips, size2, spread<S>(1.0));
      const S part = pick(slips, reach / root(squared), spread<S>(1.0)), over = pick(slips, 1.0 / squared, S{});
      for (int i = 0; i < kSize; ++i)
        for (int l = i; l < kSize; ++l) {
          const S across = over * (Space::metric(i) * e[i]) * (Space::metric(l) * e[l]);
          const S own = weight * part * ((i == l ? Space::metric(i) : 0.0) - across);
          out.slope[voigt[i][l]] += kSize == 1 ? pick(slips, S{}, own) : own;
        }
    }
    if constexpr (kParts & with_energy) held += n.drop[j] * pick(slips, reach * reach, size2);
    if (anyOf<S>(slips)) {
      const S size = kSize == 1 ? magnitude(e[0]) : root(pick(slips, size2, reach * reach));
      slipped += n.drop[j] * reach * pick(slips, size - reach, S{});
      for (int i = 0; i < kSize; ++i) {
        const S cut = kSize == 1 ? pick(e[i] < 0.0, -reach, reach) : S((reach / size) * e[i]);
        e[i] = pick(slips, cut, e[i]);
        slider[i] = pick(slips, k[i] - cut, slider[i]);
      }
    }
    for (int i = 0; i < kSize; ++i) {
      sum[i] += n.drop[j] * e[i];
      history.keep(at + j * kSize + i, slider[i]);
    }
  }
  for (int i = 0; i < kSize; ++i) out.resultant[i] += left * n.rise * (Space::metric(i) * sum[i]);
  const S ds = n.wear * slipped, fades = left * decayed(S(n.fatigue * ds)), follows = decayed(S(n.setting * left * ds));
  history.keep(worn_at, worn + fades);
  for (int i = 0; i < kSize; ++i) history.keep(set_at + i, history.before(set_at + i) + follows * off[i]);
  if constexpr (kParts & with_energy) {
    const S still = 1.0 - follows;
    S elastic{};
    for (int i = 0; i < kSize; ++i) elastic += 0.5 * D[i] * off[i] * off[i];
    const S friction = 0.5 * n.rise * held;
    out.energy += still * still * elastic + (left - fades) * friction;
    out.lost += left * n.rise * slipped + fades * friction + follows * (1.0 + still) * elastic;
  }
}

}  // namespace gambeson
