#include "cases/wear/case/strides.hpp"

#include <cmath>

namespace gambeson {

double Strides::phase(double t_s, const std::string& side) const {
  const double p = (t_s - start_s) / time_s + (side == "left" ? 0.5 : 0);
  return p - std::floor(p);
}

std::vector<double> Strides::thousandths() const {
  std::vector<double> times_s;
  for (int i = 0; i < 1000; ++i) times_s.push_back(start_s + time_s * i / 1000);
  return times_s;
}

}  // namespace gambeson
