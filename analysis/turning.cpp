#include "analysis/turning.hpp"

#include <cmath>
#include <limits>

namespace gambeson {
namespace {

/// Least part of the determinant of a ball's inertia that is taken for more than rounding of single precision.
constexpr double kFlat = 1e-12;

/// w of columns w = moment; NaN where they are dependent.
Vec3 solved(const Mat3& columns, const Vec3& moment) {
  const double det = dot(columns.a, cross(columns.b, columns.c));
  const double size = (columns.a.x + columns.b.y + columns.c.z) / 3;
  if (!(det > kFlat * size * size * size)) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {none, none, none};
  }
  return Vec3{dot(moment, cross(columns.b, columns.c)), dot(columns.a, cross(moment, columns.c)),
              dot(columns.a, cross(columns.b, moment))} /
         det;
}

}  // namespace

std::vector<Turning> turningOf(std::span<const int> region, std::span<const double> mass_kg, std::span<const Vec3> x_m,
                               std::span<const Vec3> v_m_per_s, int regions) {
  const auto count = static_cast<std::size_t>(regions);
  std::vector<double> mass(count, 0);
  std::vector<Vec3> centre(count), mean(count);
  std::vector<Turning> out(count);
  std::vector<Mat3> inertia(count, Mat3{{}, {}, {}});
  for (std::size_t i = 0; i < region.size(); ++i) {
    const auto r = static_cast<std::size_t>(region[i]);
    mass[r] += mass_kg[i];
    centre[r] += mass_kg[i] * x_m[i];
    mean[r] += mass_kg[i] * v_m_per_s[i];
  }
  for (std::size_t r = 0; r < count; ++r) centre[r] = centre[r] / mass[r], mean[r] = mean[r] / mass[r];
  for (std::size_t i = 0; i < region.size(); ++i) {
    const auto r = static_cast<std::size_t>(region[i]);
    const Vec3 d = x_m[i] - centre[r];
    out[r].momentum_Nms += mass_kg[i] * cross(d, v_m_per_s[i] - mean[r]);
    const double d2 = norm2(d);
    inertia[r].a += mass_kg[i] * (d2 * Vec3{1, 0, 0} - d.x * d);
    inertia[r].b += mass_kg[i] * (d2 * Vec3{0, 1, 0} - d.y * d);
    inertia[r].c += mass_kg[i] * (d2 * Vec3{0, 0, 1} - d.z * d);
  }
  for (std::size_t r = 0; r < count; ++r) out[r].rate_rad_per_s = solved(inertia[r], out[r].momentum_Nms);
  return out;
}

}  // namespace gambeson
