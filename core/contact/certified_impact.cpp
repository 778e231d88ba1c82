#include "core/contact/certified_impact.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gambeson {

namespace {

constexpr double kDirectionBound = 0x1p-48;  ///< error of a gap over R
constexpr double kCoplanarBound = 0x1p-44;   ///< error of the determinant over the product of its arms
constexpr double kRoundUp = 1 + 0x1p-49;     ///< the separation against |n| <= 1 + 5u
constexpr double kTiny = 1e-280;             ///< covers underflow
constexpr double kLargest = 1e50;            ///< relative coordinates beyond this are not looked at
constexpr int kCap = 2000;                   ///< steps
constexpr double kNormalised = 1e-200;       ///< squared length from which a vector has a direction

/// The differences x_i - x_j between the corners of the two primitives: N = 3 (p - a, p - b, p - c) or
/// N = 4 (a - c, a - d, b - c, b - d). The primitives meet where the hull of these points holds the origin; the hull is
/// a triangle or a parallelogram, and its nearest point to the origin tells the nearest points of the primitives.
template <std::size_t N>
using Relative = std::array<Vec3, N>;

Relative<3> relative3(const FourPoints& x) { return {x[0] - x[1], x[0] - x[2], x[0] - x[3]}; }
Relative<4> relative4(const FourPoints& x) { return {x[0] - x[2], x[0] - x[3], x[1] - x[2], x[1] - x[3]}; }

double largest(const Vec3& a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); }

/// A unit vector, from the hull towards the origin's other side: n.r > 0 on the hull where it separates.
struct Direction {
  Vec3 n;
  double u = 0, v = 0;  ///< of the nearest points that it belongs to
  double length_m = 0;  ///< their distance
  bool valid = false;
};

/// Nearest point of a line segment r0 r1 to the origin: r0 + s (r1 - r0), made orthogonal to the segment anew, as the
/// difference of long vectors leaves a direction that is not.
struct SegmentFoot {
  double s, length2;
  Vec3 q;
};
SegmentFoot footOnSegment(const Vec3& r0, const Vec3& r1) {
  const Vec3 e = r1 - r0;
  const double along = -dot(r0, e), length2 = norm2(e);
  if (!(along > 0)) return {0, norm2(r0), r0};
  if (!(along < length2)) return {1, norm2(r1), r1};
  const double s = along / length2;
  Vec3 q = r0 + s * e;
  q -= (dot(q, e) / length2) * e;
  return {s, norm2(q), q};
}

void orient(Direction& d, const Vec3& q, double length2) {
  d.valid = length2 > kNormalised;
  if (!d.valid) return;
  d.length_m = std::sqrt(length2);
  d.n = (1 / d.length_m) * q;
}

/// The direction of the plane of the hull, with the foot of the origin on it; `inside` where the foot is in the hull.
Direction planeDirection(const Vec3& normal, const Vec3& r) {
  Direction d;
  orient(d, normal, norm2(normal));
  if (!d.valid) return d;
  d.length_m = dot(d.n, r);
  if (d.length_m < 0) {
    d.length_m = -d.length_m;
    d.n = -d.n;
  }
  return d;
}

Direction faceDirection(const Relative<3>& r, bool& inside) {
  const Vec3 n = cross(r[0] - r[1], r[0] - r[2]);
  const double w0 = dot(n, cross(r[1], r[2])), w1 = dot(n, cross(r[2], r[0])), w2 = dot(n, cross(r[0], r[1]));
  Direction d = planeDirection(n, r[0]);
  inside = d.valid && w0 >= 0 && w1 >= 0 && w2 >= 0;
  if (inside) {
    const double sum = w0 + w1 + w2;
    d.u = sum > 0 ? w1 / sum : 1.0 / 3, d.v = sum > 0 ? w2 / sum : 1.0 / 3;
  }
  return d;
}

Direction faceDirection(const Relative<4>& r, bool& inside) {
  const Vec3 e = r[2] - r[0], f = r[0] - r[1];  // b - a, d - c
  const Vec3 n = cross(e, f);
  const double n2 = norm2(n);
  Direction d = planeDirection(n, r[0]);
  const double s = dot(n, cross(f, r[0])), t = dot(n, cross(e, r[0]));
  inside = d.valid && s >= 0 && s <= n2 && t >= 0 && t <= n2;
  if (inside) d.u = s / n2, d.v = t / n2;
  return d;
}

Direction rimDirection(const Relative<3>& r) {
  Direction d;
  const SegmentFoot ab = footOnSegment(r[0], r[1]), bc = footOnSegment(r[1], r[2]), ca = footOnSegment(r[2], r[0]);
  if (ab.length2 <= bc.length2 && ab.length2 <= ca.length2) {
    d.u = ab.s;
    orient(d, ab.q, ab.length2);
  } else if (bc.length2 <= ca.length2) {
    d.u = 1 - bc.s, d.v = bc.s;
    orient(d, bc.q, bc.length2);
  } else {
    d.v = 1 - ca.s;
    orient(d, ca.q, ca.length2);
  }
  return d;
}

Direction rimDirection(const Relative<4>& r) {
  Direction d;
  SegmentFoot best = footOnSegment(r[0], r[1]);  // the corner a against cd
  d.u = 0, d.v = best.s;
  if (const SegmentFoot b = footOnSegment(r[2], r[3]); b.length2 < best.length2) best = b, d.u = 1, d.v = b.s;
  if (const SegmentFoot c = footOnSegment(r[0], r[2]); c.length2 < best.length2) best = c, d.u = c.s, d.v = 0;
  if (const SegmentFoot e = footOnSegment(r[1], r[3]); e.length2 < best.length2) best = e, d.u = e.s, d.v = 1;
  orient(d, best.q, best.length2);
  return d;
}

/// A polynomial by its Bernstein coefficients lies above their lower hull: the part of [0, 1], from 0 on, on which the
/// hull lies above a level. It falls to it on one of the lines between two coefficients.
template <std::size_t M>
double partAbove(const std::array<double, M>& c, double level) {
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
double partWay(double tA, double tB, double s) { return s >= 1 ? tB : std::max(tA, tA + s * (tB - tA) - 0x1p-51); }

template <std::size_t N>
struct Query {
  Relative<N> r0, r1;
  double error_m;       ///< of a gap along a unit vector
  double separation_m;  ///< rounded up

  Relative<N> at(double t) const {
    Relative<N> r;
    const double s = 1 - t;
    for (std::size_t i = 0; i < N; ++i) r[i] = s * r0[i] + t * r1[i];
    return r;
  }
  /// Of the nearest points that belong to a direction, relative to each other, over the whole step.
  Vec3 velocityAt(const Direction& d) const {
    const double u = d.u, v = d.v;
    if constexpr (N == 3)
      return (1 - u - v) * (r1[0] - r0[0]) + u * (r1[1] - r0[1]) + v * (r1[2] - r0[2]);
    else
      return (1 - u) * ((1 - v) * (r1[0] - r0[0]) + v * (r1[1] - r0[1])) +
             u * ((1 - v) * (r1[2] - r0[2]) + v * (r1[3] - r0[3]));
  }
  bool beyond(double gap_m) const { return gap_m - error_m > separation_m; }

  /// Do the boxes of the hull at both ends lie beyond the separation on one side of the origin?
  bool boxesApart() const {
    for (int k = 0; k < 3; ++k) {
      double lo = std::min(r0[0][k], r1[0][k]), hi = std::max(r0[0][k], r1[0][k]);
      for (std::size_t i = 1; i < N; ++i) {
        lo = std::min({lo, r0[i][k], r1[i][k]});
        hi = std::max({hi, r0[i][k], r1[i][k]});
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
  Reach reach(const Vec3& n, double t) const {
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
  double turning(const Vec3& nA, const Relative<N>& rA, const Vec3& nB, const Relative<N>& rB) const {
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

  Coplanarity(const Vec3& ea, const Vec3& eb, const Vec3& fa, const Vec3& fb, const Vec3& wa, const Vec3& wb)
      : e0(ea), e1(eb), f0(fa), f1(fb), w0(wa), w1(wb) {
    ef_m2 = std::max(largest(e0), largest(e1)) * std::max(largest(f0), largest(f1));
    efw_m3 = ef_m2 * std::max(largest(w0), largest(w1));
  }
  /// The part of [tA, tB], from its start, on which it is beyond separation times |e x f|, with one sign.
  double clear(double separation_m, double tA, double tB) const {
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
               (std::sqrt(std::max({norm2(n0), norm2(n1), norm2(n2)}) + 1e-300) + kCoplanarBound * ef_m2);
    return partAbove(c, bound);
  }
};

Coplanarity coplanarity(const Relative<3>& r0, const Relative<3>& r1, const FourPoints& x0, const FourPoints& x1) {
  return {x0[2] - x0[1], x1[2] - x1[1], x0[3] - x0[1], x1[3] - x1[1], r0[0], r1[0]};
}
Coplanarity coplanarity(const Relative<4>& r0, const Relative<4>& r1, const FourPoints& x0, const FourPoints& x1) {
  return {x0[1] - x0[0], x1[1] - x1[0], x0[3] - x0[2], x1[3] - x1[2], r0[0], r1[0]};
}

/// What is known about a pair at a time.
struct Known {
  Direction nearest;   ///< between the nearest points
  Direction furthest;  ///< the direction that separates longest from then on
  double until = -1;   ///< how long
  double gap_m = 0;    ///< largest of the gaps along the directions
};
template <std::size_t N>
Known know(const Query<N>& q, const Relative<N>& r, double t) {
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

template <std::size_t N>
std::optional<ImpactTime> impact(const Relative<N>& r0, const Relative<N>& r1, double separation_m, double tolerance_m,
                                 const FourPoints& x0, const FourPoints& x1) {
  double extent = 0, sum = 0;
  for (std::size_t i = 0; i < N; ++i) {
    extent = std::max({extent, largest(r0[i]), largest(r1[i])});
    sum += (r0[i].x + r0[i].y + r0[i].z) + (r1[i].x + r1[i].y + r1[i].z);  // NaN is lost in a maximum, not in a sum
  }
  if (!(extent < kLargest && std::isfinite(sum) && separation_m >= 0)) return ImpactTime{0, 0, 0, 0, true};
  const Query<N> q{r0, r1, kDirectionBound * extent + kTiny, separation_m * kRoundUp};
  if (q.boxesApart()) return std::nullopt;
  const Coplanarity coplanar = coplanarity(r0, r1, x0, x1);
  double t = partWay(0, 1, coplanar.clear(q.separation_m, 0, 1));
  if (t >= 1) return std::nullopt;
  const double enough_m = q.separation_m + std::max(tolerance_m, 3 * q.error_m);

  Relative<N> r = q.at(t);
  Known now = know(q, r, t);
  double stride = 1;
  for (int step = 0;; ++step) {
    if (now.until >= 1) return std::nullopt;
    if (!(now.gap_m > enough_m) || !(now.until > t) || step == kCap) {
      const Direction& n = now.nearest;
      return ImpactTime{t, n.u, n.v, n.length_m, !(n.length_m <= enough_m + 4 * q.error_m)};
    }
    // Just before the nearest points of now would be at the separation, or the end: as far as it is worth to look.
    const Direction& d = now.furthest;
    const double closing = -dot(d.n, q.velocityAt(d));
    double far = std::min(1.0, t + stride);
    if (closing > 0) far = std::min(far, t + 0.999 * (now.gap_m - q.separation_m) / closing);
    if (far > now.until) {
      const Relative<N> rFar = q.at(far);
      Known later = know(q, rFar, far);
      Vec3 n = later.nearest.n;
      if (dot(n, d.n) < 0) n = -n;  // already through the face
      const double part = std::max(q.turning(d.n, r, n, rFar), coplanar.clear(q.separation_m, t, far));
      if (part >= 1) {
        if (far >= 1) return std::nullopt;
        t = far, r = rFar, now = later;
        stride *= 2;
        continue;
      }
      stride = part > 0.25 ? 2 * (far - t) : 0.25 * (far - t);
      t = std::max(now.until, partWay(t, far, part));
    } else {
      stride = 2 * (now.until - t);
      t = now.until;
    }
    r = q.at(t);
    now = know(q, r, t);
  }
}

template <std::size_t N>
double gap(const Relative<N>& r) {
  double extent = 0;
  for (std::size_t i = 0; i < N; ++i) extent = std::max(extent, largest(r[i]));
  const Query<N> q{r, r, kDirectionBound * extent + kTiny, 0};
  const double below = (know(q, r, 0).gap_m - q.error_m) / kRoundUp;
  return extent < kLargest && below > 0 ? below : 0;
}

}  // namespace

std::optional<ImpactTime> pointTriangleImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                              double tolerance_m) {
  return impact<3>(relative3(x0), relative3(x1), separation_m, tolerance_m, x0, x1);
}

std::optional<ImpactTime> edgeEdgeImpact(const FourPoints& x0, const FourPoints& x1, double separation_m,
                                         double tolerance_m) {
  return impact<4>(relative4(x0), relative4(x1), separation_m, tolerance_m, x0, x1);
}

double pointTriangleGap(const FourPoints& x) { return gap(relative3(x)); }
double edgeEdgeGap(const FourPoints& x) { return gap(relative4(x)); }

}  // namespace gambeson
