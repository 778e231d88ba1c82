#include "cases/cloth/arc.hpp"

#include <cmath>

namespace gambeson {

double arcParameter(double angle_rad, double fraction) {
  if (angle_rad == 0) return fraction;
  return 0.5 + 0.5 * std::tan((fraction - 0.5) * angle_rad / 2) / std::tan(angle_rad / 4);
}

double arcFraction(double angle_rad, double t) {
  if (angle_rad == 0) return t;
  return 0.5 + 2 * std::atan((2 * t - 1) * std::tan(angle_rad / 4)) / angle_rad;
}

}  // namespace gambeson
