#include "core/contact/ellipsoid.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"

namespace gambeson {

EllipsoidMetric ellipsoidMetric(const Ellipsoid& shape) {
  const Vec3& e = shape.semi_axes;
  for (int i = 0; i < 3; ++i)
    if (!(e[i] > 0) || !std::isfinite(e[i]))
      throw InputError({"", 0, "semi_axes"},
                       "semi-axis " + std::to_string(i) + " is " + std::to_string(e[i]) + " m, must be > 0 and finite");
  EllipsoidMetric m;
  m.semi_axes = e;
  for (int i = 1; i < 3; ++i)
    if (e[i] < e[m.smallest]) m.smallest = i;
  m.min_axis_m = e[m.smallest];
  for (int i = 0; i < 3; ++i) {
    m.inverse[i] = 1 / e[i];
    m.inverse2[i] = m.inverse[i] * m.inverse[i];
    m.ratio_minus_1[i] = ((e[i] - m.min_axis_m) / m.min_axis_m) * ((e[i] + m.min_axis_m) / m.min_axis_m);
  }
  return m;
}

namespace {

/// Root u in [lo, hi], u > 0, of |q(u)| = 1 with q_i = n_i/(u + d_i), n_i >= 0, d_i >= 0, from the guess u; q is left
/// at the root. Far from the root: Newton on 1 - 1/|q|, which falls and is convex (the secular function of trust-region
/// methods), so that from the left of the root it rises monotonically to it, and from the right it lands on the left.
/// Near the root: Halley on |q|^2 - 1, of third order and without a square root. A step out of the bracket is replaced
/// by bisection.
void solveSecular(const Vec3& n, const Vec3& d, double lo, double hi, double u, Vec3& q) {
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

}  // namespace

SurfacePoint closestOnEllipsoid(const EllipsoidMetric& s, const Vec3& p) {
  const Vec3& e = s.semi_axes;
  const Vec3& d = s.ratio_minus_1;
  // In units of the smallest axis, in the octant of p: n_i = r_i z_i with z = |p|/e, r = e^2/e_m^2 = 1 + d, and the
  // closest point is e_i q_i, q_i = n_i/(u + d_i), where u = 1 + t/e_m^2 and t is the Lagrange parameter.
  Vec3 n;
  for (int i = 0; i < 3; ++i) {
    const double z = std::abs(p[i]) * s.inverse[i];
    n[i] = z > 1e-150 ? (1 + d[i]) * z : 0;
  }
  double lo = std::max({n.x - d.x, n.y - d.y, n.z - d.z, 0.0});  // each |q_i| <= 1
  const double hi = norm(n);                                     // all u + d_i >= u
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
    solveSecular(n, d, lo, hi, guess > lo && guess < hi ? guess : lo, q);
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

std::optional<double> ellipsoidEntry(const EllipsoidMetric& s, const Vec3& p0, const Vec3& p1) {
  const auto unit = [&](const Vec3& v) { return Vec3{v.x * s.inverse.x, v.y * s.inverse.y, v.z * s.inverse.z}; };
  const Vec3 a = unit(p0), b = unit(p1 - p0);
  const double A = norm2(b), B = dot(a, b), C = norm2(a) - 1;
  if (!(B < 0) || !(C >= -1e-10)) return std::nullopt;
  if (C <= 0) return 0.0;
  // B^2 - A C = A - |a x b|^2: the second form does not cancel far from the surface.
  const double disc = A - norm2(cross(a, b));
  if (!(disc > 0)) return std::nullopt;
  const double t = C / (-B + std::sqrt(disc));
  if (t <= 1) return t;
  return std::nullopt;
}

}  // namespace gambeson
