#include "analysis/series.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

namespace gambeson {
namespace {

void requireSameSize(std::size_t a, std::size_t b) {
  if (a != b) throw std::logic_error("a series needs one value per time");
}

double mean(const std::vector<double>& v) {
  double sum = 0;
  for (const double x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

}  // namespace

Peak peakOf(std::span<const double> time_s, std::span<const double> values) {
  requireSameSize(time_s.size(), values.size());
  Peak peak;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i == 0 || std::abs(values[i]) > std::abs(peak.value)) peak = {values[i], time_s[i]};
  return peak;
}

double rms(std::span<const double> values) {
  double sum = 0;
  for (const double x : values) sum += x * x;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

double amplitude(std::span<const double> values) {
  if (values.empty()) return 0;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return 0.5 * (*high - *low);
}

Likeness compareShifted(std::span<const double> time_s, std::span<const double> a, std::span<const double> b,
                        double shift_s, double from_s, double to_s) {
  requireSameSize(time_s.size(), a.size());
  requireSameSize(time_s.size(), b.size());
  std::vector<double> first, second, difference;
  if (time_s.empty()) return {std::nan(""), 0, std::nan(""), 0};
  // Times that were added up differ in the last bits: a shift that meets a sample meets it within this.
  const double slack = 1e-9 * std::max(1.0, std::abs(time_s.back()));
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (time_s[i] < from_s - slack || time_s[i] >= to_s - slack) continue;
    const double t = time_s[i] + shift_s;
    if (t < time_s.front() - slack || t > time_s.back() + slack) continue;
    const auto above = std::lower_bound(time_s.begin(), time_s.end(), t) - time_s.begin();
    const auto hi = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above, 0, std::ssize(time_s) - 1));
    const std::size_t lo = hi > 0 ? hi - 1 : 0;
    const double span = time_s[hi] - time_s[lo];
    const double s = span > 0 ? std::clamp((t - time_s[lo]) / span, 0.0, 1.0) : 0;
    first.push_back(a[i]);
    second.push_back((1 - s) * b[lo] + s * b[hi]);
    difference.push_back(second.back() - first.back());
  }
  if (first.empty()) return {std::nan(""), 0, std::nan(""), 0};
  const double ma = mean(first), mb = mean(second);
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const double da = first[i] - ma, db = second[i] - mb;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  Likeness like;
  like.correlation = aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : std::nan("");
  like.rms_difference = rms(difference);
  like.relative = rms(first) > 0 ? like.rms_difference / rms(first) : std::nan("");
  like.samples = static_cast<int>(first.size());
  return like;
}

double noiseRatio(std::span<const double> moving, std::span<const double> still) {
  return amplitude(moving) / amplitude(still);
}

std::string otherSide(const std::string& joint) {
  for (const auto& [here, there] : {std::pair<std::string, std::string>{"_left", "_right"}, {"_right", "_left"}})
    if (joint.ends_with(here)) return joint.substr(0, joint.size() - here.size()) + there;
  return {};
}

}  // namespace gambeson
