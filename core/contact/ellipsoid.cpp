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

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Root u > 0 of |q(u)| = 1 with q_i = n_i/(u + d_i), n_i >= 0, d_i >= 0; q is left at the root. |q| falls with u and
/// 1 - 1/|q| is convex (the secular function of trust-region methods), so Newton from a point left of the root rises
/// monotonically to it; a step that rounding throws out of the bracket is replaced by bisection.
void solveSecular(const Vec3& n, const Vec3& d, double lo, double hi, Vec3& q) {
  double u = lo;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Vec3 w{1 / (u + d.x), 1 / (u + d.y), 1 / (u + d.z)};
    q = {n.x * w.x, n.y * w.y, n.z * w.z};
    const Vec3 q2{q.x * q.x, q.y * q.y, q.z * q.z};
    const double length2 = q2.x + q2.y + q2.z;
    const double length = std::sqrt(length2);
    (length > 1 ? lo : hi) = u;
    double next = u + (length - 1) * length2 / dot(q2, w);
    if (std::abs(next - u) <= 2 * kEps * u || std::abs(length2 - 1) <= 4 * kEps) return;
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
  if (!solved) solveSecular(n, d, lo, hi, q);
  q = q / norm(q);
  SurfacePoint c;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    const double signed_q = std::copysign(q[i], p[i] < 0 ? -1.0 : 1.0);
    c.position[i] = e[i] * signed_q;
    g[i] = signed_q * s.inverse[i];
  }
  c.normal = normalized(g);
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
