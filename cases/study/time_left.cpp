#include "cases/study/time_left.hpp"

#include <algorithm>

namespace gambeson::study {
namespace {

/// Before that much is recorded a run tells little of how long it takes.
constexpr double telling_part = 0.1;

std::optional<double> durationOf(const RunTime& r) {
  if (r.done) return r.took_s;
  if (r.running_s > 0 && r.part - r.from >= telling_part) return r.running_s / (r.part - r.from);
  return {};
}

std::size_t differences(const std::vector<int>& a, const std::vector<int>& b) {
  std::size_t n = 0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) n += a[k] != b[k];
  return n;
}

/// Of a whole run: by itself, else the mean of those that are nearest.
std::optional<double> expected(const RunTime& run, std::span<const RunTime> runs) {
  if (const auto own = durationOf(run)) return own;
  std::size_t nearest = run.levels.size() + 1, count = 0;
  double sum = 0;
  for (const RunTime& r : runs) {
    const auto took = durationOf(r);
    const std::size_t away = differences(r.levels, run.levels);
    if (!took || away > nearest) continue;
    if (away < nearest) nearest = away, count = 0, sum = 0;
    ++count;
    sum += *took;
  }
  return count > 0 ? std::optional(sum / static_cast<double>(count)) : std::nullopt;
}

}  // namespace

std::optional<double> timeLeft(std::span<const RunTime> runs, int parallel) {
  std::vector<double> free_at(static_cast<std::size_t>(std::max(1, parallel)), 0);
  for (const bool waiting : {false, true})
    for (const RunTime& r : runs) {
      if (r.done || (r.running_s < 0) != waiting) continue;
      const auto whole = expected(r, runs);
      if (!whole) return {};
      const double left_s = durationOf(r) ? *whole * (1 - r.part) : *whole * (1 - r.from) - std::max(0.0, r.running_s);
      *std::min_element(free_at.begin(), free_at.end()) += std::max(0.0, left_s);
    }
  return *std::max_element(free_at.begin(), free_at.end());
}

}  // namespace gambeson::study
