#include "cases/wear/recording/recorded_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/recording/windows.hpp"
#include "core/error.hpp"
#include "human/motion/inverse_statics.hpp"

namespace gambeson {

Postures posturesOf(const Scenario& s) {
  const Motion& motion = *s.motion;
  Postures out{motion.duration(), motion.stairs(), {0}, {}};
  const Windows windows(s.start_s, s.end_s, s.definition.output.window_s);
  for (long k = 0; k < windows.count(); ++k) {
    const double start = windows.bound(k), end = windows.bound(k + 1), middle = 0.5 * (start + end);
    if (end < 0) continue;  // the body stands as it starts
    out.time_s.insert(out.time_s.end(), {middle - kRate_s, middle, middle + kRate_s, end});
  }
  const auto add = [&](const std::vector<double>& times) {
    out.time_s.insert(out.time_s.end(), times.begin(), times.end());
  };
  if (const auto strides = stridesOf(s.definition)) add(strides->thousandths());
  add(hundredthsOf(motion));
  std::sort(out.time_s.begin(), out.time_s.end());
  out.time_s.erase(std::unique(out.time_s.begin(), out.time_s.end()), out.time_s.end());
  for (const double t : out.time_s) out.at.push_back(motion.at(t));
  return out;
}

Posture RecordedMotion::at(double time_s) const {
  constexpr double rounding_s = 1e-9;
  const std::vector<double>& times = postures_.time_s;
  auto after = std::lower_bound(times.begin(), times.end(), time_s);
  if (after == times.end() || (after != times.begin() && *after - time_s > time_s - *(after - 1))) --after;
  if (!(std::abs(*after - time_s) <= rounding_s))
    throw RunError(fmt::format("the recording does not hold the posture at {} s", time_s));
  return postures_.at[static_cast<std::size_t>(after - times.begin())];
}

}  // namespace gambeson
