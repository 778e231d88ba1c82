#include "analysis/course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kSlack_s = 1e-9;  ///< times were added up

void requirePairs(std::span<const double> a, std::span<const double> b) {
  if (a.size() != b.size() || a.empty()) throw std::logic_error("two courses need the same times, and some");
}

/// Mean ranks, from 1.
std::vector<double> ranksOf(std::span<const double> a) {
  std::vector<std::size_t> order(a.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return a[i] < a[j]; });
  std::vector<double> rank(a.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i + 1;
    while (end < order.size() && a[order[end]] == a[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) rank[order[k]] = 0.5 * static_cast<double>(i + 1 + end);
    i = end;
  }
  return rank;
}

}  // namespace

double valueAt(const Course& c, double t_s) {
  const auto& t = c.time_s;
  if (t.empty() || t_s < t.front() - kSlack_s || t_s > t.back() + kSlack_s)
    throw RunError(fmt::format("the course does not reach {:.4g} s", t_s));
  const auto hi = std::min<std::size_t>(
      static_cast<std::size_t>(std::lower_bound(t.begin(), t.end(), t_s - kSlack_s) - t.begin()), t.size() - 1);
  if (hi == 0 || std::abs(t[hi] - t_s) <= kSlack_s) return c.value[hi];
  const double s = std::clamp((t_s - t[hi - 1]) / (t[hi] - t[hi - 1]), 0.0, 1.0);
  return (1 - s) * c.value[hi - 1] + s * c.value[hi];
}

Course within(const Course& c, double from_s, double to_s) {
  Course part;
  for (std::size_t i = 0; i < c.time_s.size(); ++i) {
    if (c.time_s[i] < from_s - kSlack_s || c.time_s[i] > to_s + kSlack_s) continue;
    if (!std::isfinite(c.value[i]))
      throw RunError(fmt::format("the course is not a finite number at {:.4g} s", c.time_s[i]));
    part.time_s.push_back(c.time_s[i]);
    part.value.push_back(c.value[i]);
  }
  if (part.time_s.empty())
    throw RunError(fmt::format("nothing of the course lies between {:.4g} and {:.4g} s", from_s, to_s));
  return part;
}

Course resampled(const Course& c, Course& times, double shift_s) {
  Course kept, other;
  for (std::size_t i = 0; i < times.time_s.size(); ++i) {
    const double t = times.time_s[i] + shift_s;
    if (c.time_s.empty() || t < c.time_s.front() - kSlack_s || t > c.time_s.back() + kSlack_s) continue;
    kept.time_s.push_back(times.time_s[i]);
    kept.value.push_back(times.value[i]);
    other.time_s.push_back(times.time_s[i]);
    other.value.push_back(valueAt(c, t));
  }
  if (kept.time_s.empty()) throw RunError("the two courses have no time in common");
  times = std::move(kept);
  return other;
}

double correlation(std::span<const double> a, std::span<const double> b) {
  requirePairs(a, b);
  const double ma = meanOf(a), mb = meanOf(b);
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : std::numeric_limits<double>::quiet_NaN();
}

double rankCorrelation(std::span<const double> a, std::span<const double> b) {
  requirePairs(a, b);
  return correlation(ranksOf(a), ranksOf(b));
}

double differenceOverPeak(std::span<const double> a, std::span<const double> b) {
  requirePairs(a, b);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (b[i] - a[i]) * (b[i] - a[i]);
  return std::sqrt(sum / static_cast<double>(a.size())) / largestOf(a).value;
}

Largest largestOf(std::span<const double> a) {
  Largest best;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (std::abs(a[i]) > best.value) best = {std::abs(a[i]), i};
  return best;
}

double meanOf(std::span<const double> a) {
  if (a.empty()) throw std::logic_error("a mean of nothing");
  return std::accumulate(a.begin(), a.end(), 0.0) / static_cast<double>(a.size());
}

double greaterShare(std::span<const double> a, std::span<const double> b) {
  requirePairs(a, b);
  double n = 0;
  for (std::size_t i = 0; i < a.size(); ++i) n += a[i] > b[i];
  return n / static_cast<double>(a.size());
}

double halfTime(const Course& course) {
  const std::vector<double>&t = course.time_s, &v = course.value;
  const double half = 0.5 * largestOf(v).value;
  std::size_t last = v.size() - 1;
  while (last > 0 && std::abs(v[last]) < half) --last;
  if (last + 1 == v.size()) return t.back();
  const double above = std::abs(v[last]), below = std::abs(v[last + 1]);
  return t[last] + (t[last + 1] - t[last]) * (above - half) / (above - below);
}

double wrapped(double difference, double period) { return difference - period * std::round(difference / period); }

}  // namespace gambeson
