#pragma once
/// Bending that keeps a part of its folds: elastic up to a yield moment, which it never surpasses.

#include "core/material/laws/given_rigidities.hpp"
#include "core/material/laws/law.hpp"

namespace gambeson {

/// A stop (Prandtl's element of perfect plasticity) of a curvature k [1/m] that remembers its set kp: with the rigidity
/// D [N m] and the yield moment y [N] per length
///   m = D (k - kp),   |m| <= y;   where it would be more, kp follows k such that |m| = y.
/// stored = m^2/(2 D), lost = y |dkp| since the history was committed; m is the gradient of their sum. The slope is D,
/// and 0 where the set follows. From k = 0 on m = D k up to the yield curvature y/D. Where D = 0, m = 0. Valid for
/// D >= 0, y > 0. A sum of stops is a measured loop of hysteresis with its inner loops (Masing).
template <unsigned kParts, class S, class P>
GAMBESON_LAW void stopCurve(const P& D, const P& y, const S& k, const S& set, S& new_set, Answer<S, 1>& out) {
  const S elastic = D * (k - set), size = magnitude(elastic), yield = spread<S>(y);
  const auto slips = size > yield;
  const S cut = pick(elastic < 0.0, -yield, yield), m = pick(slips, cut, elastic);
  const S divisor = pick(size > 0.0, spread<S>(D), spread<S>(1.0));  // D = 0 gives no moment
  const S moved = pick(slips, (elastic - m) / divisor, S{});
  new_set = set + moved;
  out.resultant[0] = m;
  if constexpr (kParts & with_slope) out.slope[0] = pick(slips, S{}, spread<S>(D));
  if constexpr (kParts & with_energy) {
    out.energy += 0.5 * m * (m / divisor);
    out.lost += yield * magnitude(moved);
  }
}

/// A stop along weft, one along warp and one of twist, with one yield moment. History: the set curvatures (k11, k22,
/// 2 k12) [1/m].
struct StopBending : GivenRigidities {
  static constexpr int number_count = 1, history_size = 3;
  double yield_N = 0;  ///< moment per length

  bool operator==(const StopBending&) const = default;
  std::array<double, number_count> numbers() const { return {yield_N}; }
  void check(const Refusal& refuse) const {
    GivenRigidities::check(refuse);
    if (!(yield_N > 0)) refuse("yield_moment_N", "must be > 0");
  }
  void stiffen(double factor) {
    GivenRigidities::stiffen(factor);
    yield_N *= factor;
  }
  /// The yield moment of a homogeneous sheet goes with the square of its thickness.
  void thicken(double factor) {
    GivenRigidities::thicken(factor);
    yield_N *= factor * factor;
  }
  static StopBending mixed(const StopBending& a, const StopBending& b, double w) {
    return {GivenRigidities::mixed(a, b, w), mix(a.yield_N, b.yield_N, w)};
  }

  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S> history, Answer<S, 3>& out) {
    for (int i = 0; i < 3; ++i) {
      Answer<S, 1> one;
      S set;
      stopCurve<kParts>(D[i], numbers[0], k[i], history.before(i), set, one);
      history.keep(i, set);
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
  GAMBESON_LAW static P steepest(int i, const P* D, const P* /*numbers*/) {
    return D[i];
  }
};

}  // namespace gambeson
