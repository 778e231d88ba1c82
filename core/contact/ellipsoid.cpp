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
