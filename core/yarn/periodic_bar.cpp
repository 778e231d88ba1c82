#include "core/yarn/periodic_bar.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace gambeson {

HomogenisedBar homogenise(const PeriodicBar& bar) {
  const std::size_t n = bar.length.size();
  if (n == 0) throw InputError({"", 0, "length"}, "none, must be at least one");
  if (bar.young_Pa.size() != n)
    throw InputError({"", 0, "young"}, fmt::format("{} numbers, must be {} as lengths", bar.young_Pa.size(), n));
  for (std::size_t i = 0; i < n; ++i) {
    if (!(bar.length[i] > 0 && std::isfinite(bar.length[i])))
      throw InputError({"", 0, "length"}, fmt::format("{:.6g}, must be > 0", bar.length[i]));
    if (!(bar.young_Pa[i] > 0 && std::isfinite(bar.young_Pa[i])))
      throw InputError({"", 0, "young"}, fmt::format("{:.6g} Pa, must be > 0", bar.young_Pa[i]));
  }
  // Between its pinned ends: (k_i-1 + k_i) chi_i - k_i-1 chi_i-1 - k_i chi_i+1 = E_i - E_i-1, eliminated from the left.
  std::vector<double> stiffness(n), pivot(n, 0.0), right(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) stiffness[i] = bar.young_Pa[i] / bar.length[i];
  for (std::size_t i = 1; i < n; ++i) {
    pivot[i] = stiffness[i - 1] + stiffness[i];
    right[i] = bar.young_Pa[i] - bar.young_Pa[i - 1];
    if (i == 1) continue;
    const double part = stiffness[i - 1] / pivot[i - 1];
    pivot[i] -= part * stiffness[i - 1];
    right[i] += part * right[i - 1];
  }
  HomogenisedBar out;
  out.characteristic.assign(n + 1, 0.0);
  for (std::size_t i = n - 1; i > 0; --i)
    out.characteristic[i] = (right[i] + stiffness[i] * out.characteristic[i + 1]) / pivot[i];
  double sum = 0, period = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += bar.young_Pa[i] * (bar.length[i] + out.characteristic[i + 1] - out.characteristic[i]);
    period += bar.length[i];
  }
  out.young_Pa = sum / period;
  return out;
}

}  // namespace gambeson
