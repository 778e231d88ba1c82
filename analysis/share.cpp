#include "analysis/share.hpp"

#include <cmath>

namespace gambeson {

ShareInterval wilsonInterval(int yes, int of) {
  if (of <= 0) return {};
  constexpr double z = 1.959963984540054;  // of the normal distribution, 97.5 %
  const double n = of, p = yes / n;
  const double middle = (yes + 0.5 * z * z) / (n + z * z);
  const double half = z * std::sqrt(n) / (n + z * z) * std::sqrt(p * (1 - p) + z * z / (4 * n));
  // The ends are 0 and 1 there but for rounding.
  return {yes == 0 ? 0 : middle - half, yes == of ? 1 : middle + half};
}

}  // namespace gambeson
