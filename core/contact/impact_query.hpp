#pragma once
/// The arithmetic of the certified impact test, whose law certified_impact.hpp states: one source for that and for
/// kernels, which cut a query into its start (`queryOf`, `boxesApart`, `startTime`), a first look (`know`, `verdict`)
/// and turns (`lookAhead`, `moveOn`, `turnTo`). The same bits wherever multiply-add is not contracted.

#include "core/contact/nearest_direction.hpp"

namespace gambeson::certified {

constexpr double kDirectionBound = 0x1p-48;  ///< error of a gap over R
constexpr double kCoplanarBound = 0x1p-44;   ///< error of the determinant over the product of its arms
constexpr double kRoundUp = 1 + 0x1p-49;     ///< the separation against |n| <= 1 + 5u
constexpr double kTiny = 1e-280;             ///< covers underflow
constexpr double kLargest = 1e50;            ///< relative coordinates beyond this are not looked at
constexpr int kCap = 2000;                   ///< steps

/// A polynomial by its Bernstein coefficients lies above their lower hull: the part of [0, 1], from 0 on, on which the
/// hull lies above a level. It falls to it on one of the lines between two coefficients.
template <std::size_t M>
GAMBESON_HD double partAbove(const std::array<double, M>& c, double level) {
  if (!(c[0] > level)) return 0;
  double s = 1;
  for (std::size_t j = 1; j < M; ++j) {
    if (c[j] > level) continue;
    for (std::size_t i = 0; i < j; ++i) {
      if (!(c[i] > level)) continue;
      const double di = static_cast<double>(i), dj = static_cast<double>(j);
      s = std::min(s, (di + (dj - di) * ((c[i] - level) / (c[i] - c[j]))) / (M - 1));
    }
  }
  return s;
}

/// tA + s (tB - tA), never above: a time in [tA, tB], both in [0, 1].
GAMBESON_HD inline double partWay(double tA, double tB, double s) {
  return s >= 1 ? tB : std::max(tA, tA + s * (tB - tA) - 0x1p-51);
}

template <std::size_t N>
struct Query {
  Relative<N> r0, r1;
  double error_m;       ///< of a gap along a unit vector
  double separation_m;  ///< rounded up
  bool sound;           ///< numbers that can be looked at; others are a hit at 0

  GAMBESON_HD Relative<N> at(double t) const {
    Relative<N> r;
    const double s = 1 - t;
    for (std::size_t i = 0; i < N; ++i) r[i] = s * r0[i] + t * r1[i];
    return r;
  }
  /// Of the nearest points that belong to a direction, relative to each other, over the whole step.
  GAMBESON_HD Vec3 velocityAt(const Direction& d) const {
    const double u = d.u, v = d.v;
    if constexpr (N == 3)
      return (1 - u - v) * (r1[0] - r0[0]) + u * (r1[1] - r0[1]) + v * (r1[2] - r0[2]);
    else
      return (1 - u) * ((1 - v) * (r1[0] - r0[0]) + v * (r1[1] - r0[1])) +
             u * ((1 - v) * (r1[2] - r0[2]) + v * (r1[3] - r0[3]));
  }
  GAMBESON_HD bool beyond(double gap_m) const { return gap_m - error_m > separation_m; }

  /// Do the boxes of the hull at both ends lie beyond the separation on one side of the origin?
  GAMBESON_HD bool boxesApart() const {
    for (int k = 0; k < 3; ++k) {
      double lo = std::min(r0[0][k], r1[0][k]), hi = std::max(r0[0][k], r1[0][k]);
      for (std::size_t i = 1; i < N; ++i) {
        lo = std::min(std::min(lo, r0[i][k]), r1[i][k]);
        hi = std::max(std::max(hi, r0[i][k]), r1[i][k]);
      }
      if (lo > separation_m || hi < -separation_m) return true;
    }
    return false;
  }

  /// Smallest gap along n at time t, and the time from t on until which all gaps are certainly beyond the separation
  /// (-1: not even at t).
  struct Reach {
    double gap_m, time;
  };
  GAMBESON_HD Reach reach(const Vec3& n, double t) const {
    std::array<double, N> h0, h1;
    const double s = 1 - t;
    double gap = INFINITY, until = 1;
    for (std::size_t i = 0; i < N; ++i) {
      h0[i] = dot(n, r0[i]), h1[i] = dot(n, r1[i]);
      const double g = s * h0[i] + t * h1[i];
      gap = g < gap ? g : gap;
      if (!beyond(g)) return {gap, -1};  // NaN too
      if (beyond(h1[i])) continue;
      // Where the gap falls to the separation and twice the error; what rounding does to it is checked below.
      until = std::min(until, (h0[i] - 2 * error_m - separation_m) / (h0[i] - h1[i]));
    }
    until = std::max(until, t);
    for (std::size_t i = 0; i < N; ++i)
      if (!beyond((1 - until) * h0[i] + until * h1[i])) return {gap, t};
    return {gap, until};
  }

  /// The pair from tA (positions rA) to tB along the direction that turns from nA to nB: the part of the interval, from
  /// its start, on which all gaps are certainly beyond the separation.
  GAMBESON_HD double turning(const Vec3& nA, const Relative<N>& rA, const Vec3& nB, const Relative<N>& rB) const {
    double s = 1;
    for (std::size_t i = 0; i < N; ++i)
      s = std::min(s, partAbove<3>({dot(nA, rA[i]), 0.5 * (dot(nA, rB[i]) + dot(nB, rA[i])), dot(nB, rB[i])},
                                   separation_m + 2 * error_m));
    return s;
  }
};

/// What the determinant of coplanarity is made of: two edges e, f and an arm w between the primitives, at 0 and 1.
struct Coplanarity {
  Vec3 e0, e1, f0, f1, w0, w1;
  double ef_m2, efw_m3;  ///< products of their largest components

  Coplanarity() = default;
  GAMBESON_HD Coplanarity(const Vec3& ea, const Vec3& eb, const Vec3& fa, const Vec3& fb, const Vec3& wa,
                          const Vec3& wb)
      : e0(ea), e1(eb), f0(fa), f1(fb), w0(wa), w1(wb) {
    ef_m2 = std::max(largest(e0), largest(e1)) * std::max(largest(f0), largest(f1));
    efw_m3 = ef_m2 * std::max(largest(w0), largest(w1));
  }
  /// The part of [tA, tB], from its start, on which it is beyond separation times |e x f|, with one sign.
  GAMBESON_HD double clear(double separation_m, double tA, double tB) const {
    const auto at = [](const Vec3& a, const Vec3& b, double t) { return (1 - t) * a + t * b; };
    const Vec3 ea = tA > 0 ? at(e0, e1, tA) : e0, fa = tA > 0 ? at(f0, f1, tA) : f0, wa = tA > 0 ? at(w0, w1, tA) : w0;
    const Vec3 eb = tB < 1 ? at(e0, e1, tB) : e1, fb = tB < 1 ? at(f0, f1, tB) : f1, wb = tB < 1 ? at(w0, w1, tB) : w1;
    const Vec3 n0 = cross(ea, fa), n2 = cross(eb, fb), n1 = 0.5 * (cross(ea, fb) + cross(eb, fa));
    std::array<double, 4> c{dot(n0, wa), (dot(n0, wb) + 2 * dot(n1, wa)) / 3, (2 * dot(n1, wb) + dot(n2, wa)) / 3,
                            dot(n2, wb)};
    if (c[0] < 0)
      for (double& x : c) x = -x;
    double bound = kCoplanarBound * efw_m3 + kTiny;
    // |n| lies below the largest of its coefficients.
    if (separation_m > 0)
      bound += separation_m * kRoundUp *
               (std::sqrt(std::max(std::max(norm2(n0), norm2(n1)), norm2(n2)) + 1e-300) + kCoplanarBound * ef_m2);
    return partAbove(c, bound);
  }
};

template <std::size_t N>
GAMBESON_HD Coplanarity coplanarity(const Query<N>& q, const FourPoints& x0, const FourPoints& x1) {
  if constexpr (N == 3)
    return {x0[2] - x0[1], x1[2] - x1[1], x0[3] - x0[1], x1[3] - x1[1], q.r0[0], q.r1[0]};
  else
    return {x0[1] - x0[0], x1[1] - x1[0], x0[3] - x0[2], x1[3] - x1[2], q.r0[0], q.r1[0]};
}

/// What is known about a pair at a time.
struct Known {
  Direction nearest;   ///< between the nearest points
  Direction furthest;  ///< the direction that separates longest from then on
  double until = -1;   ///< how long
  double gap_m = 0;    ///< largest of the gaps along the directions
};
template <std::size_t N>
GAMBESON_HD Known know(const Query<N>& q, const Relative<N>& r, double t) {
  Known k;
  k.gap_m = -INFINITY;
  const auto consider = [&](const Direction& d) {
    if (!d.valid) return;
    const auto [gap, until] = q.reach(d.n, t);
    k.gap_m = std::max(k.gap_m, gap);
    if (until > k.until) k.until = until, k.furthest = d;
  };
  bool inside = false;
  const Direction face = faceDirection(r, inside);
  if (inside) {
    k.nearest = face;
    consider(face);
    // The face direction of a hull that is nearly a line may be anything.
    if (k.until >= 1 || k.gap_m >= 0.5 * face.length_m) return k;
  }
  const Direction rim = rimDirection(r);
  consider(rim);
  if (!inside || rim.length_m < face.length_m) k.nearest = rim;
  if (!inside && k.until < 1) consider(face);
  return k;
}

/// N = 3: a point and a triangle, N = 4: two edges, as in FourPoints.
template <std::size_t N>
GAMBESON_HD Query<N> queryOf(const FourPoints& x0, const FourPoints& x1, double separation_m) {
  Query<N> q;
  q.r0 = relative<N>(x0), q.r1 = relative<N>(x1);
  double extent = 0, sum = 0;
  for (std::size_t i = 0; i < N; ++i) {
    extent = std::max(std::max(extent, largest(q.r0[i])), largest(q.r1[i]));
    // NaN is lost in a maximum, not in a sum.
    sum += (q.r0[i].x + q.r0[i].y + q.r0[i].z) + (q.r1[i].x + q.r1[i].y + q.r1[i].z);
  }
  q.error_m = kDirectionBound * extent + kTiny;
  q.separation_m = separation_m * kRoundUp;
  q.sound = extent < kLargest && std::isfinite(sum) && separation_m >= 0;
  return q;
}

/// The time until which coplanarity keeps the pair apart: where nearest points have to be looked at. 1: to the end.
template <std::size_t N>
GAMBESON_HD double startTime(const Query<N>& q, const Coplanarity& coplanar) {
  return partWay(0, 1, coplanar.clear(q.separation_m, 0, 1));
}

/// The gap from which on a pair is looked at further.
template <std::size_t N>
GAMBESON_HD double enoughGap(const Query<N>& q, double tolerance_m) {
  return q.separation_m + std::max(tolerance_m, 3 * q.error_m);
}

enum class Verdict { apart, meets, open };

/// From what is known at t, after so many turns: apart to the end, met at t, or to be looked at further.
GAMBESON_HD inline Verdict verdict(const Known& now, double t, double enough_m, int turns) {
  if (now.until >= 1) return Verdict::apart;
  return !(now.gap_m > enough_m) || !(now.until > t) || turns == kCap ? Verdict::meets : Verdict::open;
}

/// From an open pair at t on: just before the nearest points of now would be at the separation, or the end. As far as
/// it is worth to look; `stride` is how far it was worth before, 1 at first.
template <std::size_t N>
GAMBESON_HD double lookAhead(const Query<N>& q, const Known& now, double t, double stride) {
  const double closing = -dot(now.furthest.n, q.velocityAt(now.furthest)), far = std::min(1.0, t + stride);
  return closing > 0 ? std::min(far, t + 0.999 * (now.gap_m - q.separation_m) / closing) : far;
}

/// t moves on as far as the direction of now certifies: where that is past the time to look at.
GAMBESON_HD inline void moveOn(const Known& now, double& t, double& stride) {
  stride = 2 * (now.until - t);
  t = now.until;
}

enum class Turn {
  apart,    ///< to the end of the step
  moved,    ///< t has moved
  reached,  ///< t has moved to the time that was looked at
};

/// From t (positions r, known: now) to far (rFar, later): t moves as far as the direction that turns from one to the
/// other certifies, or that of now, or coplanarity.
template <std::size_t N>
GAMBESON_HD inline Turn turnTo(const Query<N>& q, const Coplanarity& coplanar, const Relative<N>& r, const Known& now,
                               const Relative<N>& rFar, const Known& later, double far, double& t, double& stride) {
  Vec3 n = later.nearest.n;
  if (dot(n, now.furthest.n) < 0) n = -n;  // already through the face
  const double part = std::max(q.turning(now.furthest.n, r, n, rFar), coplanar.clear(q.separation_m, t, far));
  if (part >= 1) {
    if (far >= 1) return Turn::apart;
    t = far;
    stride *= 2;
    return Turn::reached;
  }
  stride = part > 0.25 ? 2 * (far - t) : 0.25 * (far - t);
  t = std::max(now.until, partWay(t, far, part));
  return Turn::moved;
}

/// What is told of a pair that meets at t, where `now` is known of it.
template <std::size_t N>
GAMBESON_HD ImpactTime impactAt(const Query<N>& q, const Known& now, double t, double enough_m) {
  const Direction& n = now.nearest;
  return {t, n.u, n.v, n.length_m, !(n.length_m <= enough_m + 4 * q.error_m)};
}

/// Of a pair that is not sound.
GAMBESON_HD inline ImpactTime unsoundImpact() { return {0, 0, 0, 0, true}; }

/// The whole query.
template <std::size_t N>
GAMBESON_HD std::optional<ImpactTime> findImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                                 double tolerance_m) {
  const Query<N> q = queryOf<N>(x0, x1, separation_m);
  if (!q.sound) return unsoundImpact();
  if (q.boxesApart()) return std::nullopt;
  const Coplanarity coplanar = coplanarity(q, x0, x1);
  double t = startTime(q, coplanar);
  if (t >= 1) return std::nullopt;
  const double enough_m = enoughGap(q, tolerance_m);

  Relative<N> r = q.at(t);
  Known now = know(q, r, t);
  double stride = 1;
  for (int turns = 0;; ++turns) {
    const Verdict said = verdict(now, t, enough_m, turns);
    if (said == Verdict::apart) return std::nullopt;
    if (said == Verdict::meets) return impactAt(q, now, t, enough_m);
    const double far = lookAhead(q, now, t, stride);
    if (far > now.until) {
      const Relative<N> rFar = q.at(far);
      const Known later = know(q, rFar, far);
      const Turn turn = turnTo(q, coplanar, r, now, rFar, later, far, t, stride);
      if (turn == Turn::apart) return std::nullopt;
      if (turn == Turn::reached) {
        r = rFar, now = later;
        continue;
      }
    } else {
      moveOn(now, t, stride);
    }
    r = q.at(t);
    now = know(q, r, t);
  }
}

/// Lower bound of the distance of a pair at rest (pointTriangleGap, edgeEdgeGap).
template <std::size_t N>
GAMBESON_HD double gapAtRest(const FourPoints& x) {
  const Relative<N> r = relative<N>(x);
  double extent = 0;
  for (const Vec3& a : r) extent = std::max(extent, largest(a));
  const Query<N> q{r, r, kDirectionBound * extent + kTiny, 0, true};
  const double below = (know(q, r, 0).gap_m - q.error_m) / kRoundUp;
  return extent < kLargest && below > 0 ? below : 0;
}

}  // namespace gambeson::certified
