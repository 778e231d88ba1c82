#include "cases/wear/case/strides.hpp"

#include <cmath>

namespace gambeson {

double Strides::phase(double t_s, const std::string& side) const {
  const double p = (t_s - start_s) / time_s + (side == "left" ? 0.5 : 0);
  return p - std::floor(p);
}

}  // namespace gambeson
