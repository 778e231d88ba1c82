#include "core/yarn/line_contact.hpp"

#include <numbers>

namespace gambeson {

LineContact lineContact(const LateralCompression& law, double touch_m, double distance_m) {
  if (!(distance_m < touch_m)) return {};
  const double d = distance_m, p = law.exponent;
  const double u = touch_m / d - 1, du = -touch_m / (d * d), ddu = -2 * du / d;
  const double power = law.half_force_N * std::pow(u, p - 2);
  const double F = power * u * u, dF = p * power * u * du, ddF = p * power * ((p - 1) * du * du + u * ddu);
  const double by = 1 / (2 * std::numbers::pi * d);
  return {by * F, by * (dF - F / d), by * (ddF - 2 * dF / d + 2 * F / (d * d))};
}

}  // namespace gambeson
