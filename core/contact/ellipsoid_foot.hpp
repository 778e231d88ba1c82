#pragma once
/// The point of an ellipsoid nearest to a point, for host and device. Detail of ellipsoid.hpp.

#include <algorithm>
#include <cmath>

#include "core/math/vec.hpp"

namespace gambeson {

/// The point of a surface closest to a query point, the unit outward normal there, and the signed distance of the
/// query point (negative inside) [m].
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
  double distance_m = 0;
};

/// What the iteration needs of an ellipsoid, computed once: with e_m the smallest semi-axis,
/// `ratio_minus_1[i] = e_i^2/e_m^2 - 1`, without cancellation.
struct EllipsoidMetric {
  Vec3 semi_axes, inverse, inverse2, ratio_minus_1;
  int smallest = 0;
  double min_axis_m = 0;
};

namespace ellipsoid_detail {

/// Root u in [lo, hi], u > 0, of |q(u)| = 1 with q_i = n_i/(u + d_i), n_i >= 0, d_i >= 0, from the guess u; q is left
/// at the root. Far from the root: Newton on 1 - 1/|q|, which falls and is convex (the secular function of trust-region
/// methods), so that from the left of the root it rises monotonically to it, and from the right it lands on the left.
/// Near the root: Halley on |q|^2 - 1, of third order and without a square root. A step out of the bracket is replaced
/// by bisection.
GAMBESON_HD inline void solveSecular(const Vec3& n, const Vec3& d, double lo, double hi, double u, Vec3& q) {
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Vec3 w{1 / (u + d.x), 1 / (u + d.y), 1 / (u + d.z)};
    q = {n.x * w.x, n.y * w.y, n.z * w.z};
    const Vec3 r{q.x * q.x * w.x, q.y * q.y * w.y, q.z * q.z * w.z};  // -(1/2) d/du of q_i^2
    const double excess = norm2(q) - 1, fall = r.x + r.y + r.z;
    (excess > 0 ? lo : hi) = u;
    double step;
    if (std::abs(excess) < 0.5) {
      step = 2 * excess * fall / (4 * fall * fall - 3 * excess * dot(r, w));
    } else {
      const double length2 = 1 + excess;
      step = (std::sqrt(length2) - 1) * length2 / fall;
    }
    if (std::abs(step) <= 4e-6 * u && std::abs(excess) < 0.5) {
      // The next iterate is the root to rounding (third order), and q there is given by its expansion.
      const auto moved = [&](double qi, double wi) {
        const double k = wi * step;
        return qi * (1 - k * (1 - k));
      };
      q = {moved(q.x, w.x), moved(q.y, w.y), moved(q.z, w.z)};
      return;
    }
    double next = u + step;
    if (!(next >= lo && next <= hi)) next = 0.5 * (lo + hi);
    if (next == u) return;
    u = next;
  }
}

}  // namespace ellipsoid_detail

/// Closest point by a bracketed Newton iteration on the Lagrange parameter, for every point of space: inside, outside,
/// at the centre, on axes and symmetry planes, spheres and spheroids. Where several points are closest (the focal disc)
/// one of them is returned: the one at the non-negative end of the smallest axis. Distance accurate to a few units of
/// rounding of max(|p|, largest semi-axis).
GAMBESON_HD inline SurfacePoint closestOnEllipsoid(const EllipsoidMetric& s, const Vec3& p) {
  const Vec3& e = s.semi_axes;
  const Vec3& d = s.ratio_minus_1;
  // In units of the smallest axis, in the octant of p: n_i = r_i z_i with z = |p|/e, r = e^2/e_m^2 = 1 + d, and the
  // closest point is e_i q_i, q_i = n_i/(u + d_i), where u = 1 + t/e_m^2 and t is the Lagrange parameter.
  Vec3 n;
  for (int i = 0; i < 3; ++i) {
    const double z = std::abs(p[i]) * s.inverse[i];
    n[i] = z > 1e-150 ? (1 + d[i]) * z : 0;
  }
  double lo = std::max(std::max(std::max(n.x - d.x, n.y - d.y), n.z - d.z), 0.0);  // each |q_i| <= 1
  const double hi = norm(n);                                                       // all u + d_i >= u
  Vec3 q;
  bool solved = false;
  if (!(lo > 0)) {
    // No part along the smallest axes: the root may lie at u = 0 (the focal disc), where q_m is free.
    double rest2 = 0;
    for (int i = 0; i < 3; ++i) {
      q[i] = d[i] > 0 ? n[i] / d[i] : 0;
      rest2 += q[i] * q[i];
    }
    if (n[s.smallest] == 0 && rest2 < 1) {
      q[s.smallest] = std::sqrt(1 - rest2);
      solved = true;
    }
    lo = 1e-300;
  }
  if (!solved) {
    // Near the surface t = distance / |x/e^2|, with the distance to first order and x/e^2 taken at p.
    const Vec3 z{p.x * s.inverse.x, p.y * s.inverse.y, p.z * s.inverse.z};
    const Vec3 g{p.x * s.inverse2.x, p.y * s.inverse2.y, p.z * s.inverse2.z};
    const double guess = 1 + 0.5 * (norm2(z) - 1) / (norm2(g) * s.min_axis_m * s.min_axis_m);
    ellipsoid_detail::solveSecular(n, d, lo, hi, guess > lo && guess < hi ? guess : lo, q);
  }
  q *= 1.5 - 0.5 * norm2(q);  // |q| = 1 but for rounding: to the last bit
  SurfacePoint c;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    const double signed_q = std::copysign(q[i], p[i] < 0 ? -1.0 : 1.0);
    c.position[i] = e[i] * signed_q;
    g[i] = signed_q * s.inverse[i];
  }
  c.normal = (1 / norm(g)) * g;
  // Along the normal: an error of the foot point enters squared only.
  c.distance_m = dot(p - c.position, c.normal);
  return c;
}

/// True only if p is outside and further than `limit_m` >= 0 from the ellipsoid: a cheap and certain reject, sharp near
/// the surface. f(x) = |x/e|^2 is convex with f = 1 on the surface, so f(p) - 1 <= |grad f(p)| distance.
GAMBESON_HD inline bool surelyBeyond(const EllipsoidMetric& s, const Vec3& p, double limit_m) {
  const Vec3 a{p.x * s.inverse.x, p.y * s.inverse.y, p.z * s.inverse.z};
  const Vec3 g{a.x * s.inverse.x, a.y * s.inverse.y, a.z * s.inverse.z};
  const double excess = norm2(a) - 1;
  constexpr double slack = 1e-12;  // of rounding
  return excess > slack && (excess - slack) * (excess - slack) > 4 * (1 + slack) * limit_m * limit_m * norm2(g);
}

}  // namespace gambeson
