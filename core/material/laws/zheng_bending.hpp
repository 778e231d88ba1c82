#pragma once
/// Bending with an initial part like friction: steep at first, then straight.

#include "core/material/laws/given_rigidities.hpp"
#include "core/material/laws/law.hpp"

namespace gambeson {

/// Zheng 2013, eq. 2.14 and 2.14', moment per length m [N] of a curvature k [1/m]:
///   m = 2 B0 sqrt(k0 |k|) sign(k),  kr <= |k| <= k0;   m = B0 (|k| + k0) sign(k),  |k| > k0.
/// The root has an infinite slope at k = 0. Below the regularising curvature kr it is replaced by the odd cubic
///   m = 2 B0 sqrt(k0/kr) k (5/4 - (k/kr)^2/4),
/// which meets it at kr with the same value and slope; the law is C1. The energy per area is zero at k = 0. The slope
/// is never negative: sqrt(k0/kr) B0 at kr, B0 from k0 on. Valid for B0 >= 0 [N m], 0 < kr <= k0 [1/m].
template <unsigned kParts, class S, class P>
GAMBESON_LAW void zhengCurve(const P& b0, const P& k0, const P& kr, const S& k, Answer<S, 1>& out) {
  const S a = magnitude(k);
  const P steep = 2.0 * b0 * root(k0 / kr);
  const S ratio2 = squaredRatio(a, kr);
  const S straight = b0 * (a + k0), curved = 2.0 * b0 * root(k0 * a), cubic = steep * a * (1.25 - 0.25 * ratio2);
  const S m = pick(a > k0, straight, pick(a > kr, curved, cubic));
  out.resultant[0] = pick(k < 0.0, -m, m);
  if constexpr (kParts & with_slope) {
    const S away = pick(a > 0.0, a, spread<S>(1.0));
    const S of_root = b0 * root(k0 / away), of_cubic = steep * (1.25 - 0.75 * ratio2);
    out.slope[0] = pick(a > k0, spread<S>(b0), pick(a > kr, of_root, of_cubic));
  }
  if constexpr (kParts & with_energy) {
    const S below = pick(a < kr, a, spread<S>(kr)), mid = pick(a < k0, a, spread<S>(k0));
    const S e = steep * below * below * (0.625 - 0.0625 * squaredRatio(below, kr));
    const S to_root = e + 4.0 / 3.0 * b0 * root(k0) * (mid * root(mid) - kr * root(kr));
    const S to_here = pick(a > kr, to_root, e);
    out.energy += pick(a > k0, to_here + b0 * (0.5 * (a * a - k0 * k0) + k0 * (a - k0)), to_here);
  }
}

/// The slope of zhengCurve at k = 0, its steepest [N m]: 5/2 B0 sqrt(k0/kr).
template <class P>
GAMBESON_LAW P zhengSteepest(const P& b0, const P& k0, const P& kr) {
  return 2.5 * b0 * root(k0 / kr);
}

/// Eq. 2.14 along weft and along warp, each for itself; twist, which the thesis leaves without stiffness, is linear.
/// B0 is the rigidity along either.
struct ZhengBending : GivenRigidities {
  static constexpr int number_count = 2, history_size = 0;
  double kappa0_per_m = 0;         ///< k0
  double kappa_regular_per_m = 0;  ///< kr

  bool operator==(const ZhengBending&) const = default;
  std::array<double, number_count> numbers() const { return {kappa0_per_m, kappa_regular_per_m}; }
  void check(const Refusal& refuse) const {
    GivenRigidities::check(refuse);
    if (!(kappa_regular_per_m > 0 && kappa_regular_per_m <= kappa0_per_m))
      refuse("kappa_regular_per_m", "must be > 0 and at most kappa0_per_m");
  }
  static ZhengBending mixed(const ZhengBending& a, const ZhengBending& b, double w) {
    return {GivenRigidities::mixed(a, b, w), mix(a.kappa0_per_m, b.kappa0_per_m, w),
            mix(a.kappa_regular_per_m, b.kappa_regular_per_m, w)};
  }

  template <unsigned kParts, class S, class P>
  GAMBESON_LAW static void bend(const P* D, const P* numbers, const S* k, History<S>, Answer<S, 3>& out) {
    Answer<S, 1> weft, warp;
    weft.energy = out.energy;
    zhengCurve<kParts>(D[0], numbers[0], numbers[1], k[0], weft);
    warp.energy = weft.energy;
    zhengCurve<kParts>(D[1], numbers[0], numbers[1], k[1], warp);
    const S twist = D[2] * k[2];
    out.resultant[0] = weft.resultant[0];
    out.resultant[1] = warp.resultant[0];
    out.resultant[2] = twist;
    if constexpr (kParts & with_energy) out.energy = warp.energy + 0.5 * twist * k[2];
    if constexpr (kParts & with_slope) {
      out.slope[0] = weft.slope[0];
      out.slope[1] = warp.slope[0];
      out.slope[2] = spread<S>(D[2]);
      out.slope[3] = out.slope[4] = out.slope[5] = S{};
    }
  }
  template <class P>
  GAMBESON_LAW static P steepest(int i, const P* D, const P* numbers) {
    return i < 2 ? zhengSteepest(D[i], numbers[0], numbers[1]) : D[i];
  }
  template <class P>
  GAMBESON_LAW static P steepening(const P* numbers) {
    return zhengSteepest(spread<P>(1.0), numbers[0], numbers[1]);
  }
};

}  // namespace gambeson
