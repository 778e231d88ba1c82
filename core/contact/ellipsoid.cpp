#include "core/contact/ellipsoid.hpp"

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

}  // namespace gambeson
