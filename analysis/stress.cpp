#include "analysis/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Several fractions of one sorted distribution.
std::vector<double> percentiles(std::span<const double> values, std::span<const double> weights,
                                std::span<const double> fractions) {
  if (values.size() != weights.size()) throw std::logic_error("percentiles need one weight per value");
  for (const double v : values)
    if (!std::isfinite(v)) throw RunError("a percentile of values that are not finite");
  double total = 0;
  for (const double w : weights) {
    if (!(w >= 0)) throw std::logic_error("percentiles need weights of at least 0");
    total += w;
  }
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> result;
  for (const double fraction : fractions) {
    if (!(fraction >= 0 && fraction <= 1)) throw std::logic_error("a percentile's fraction lies in [0, 1]");
    double below = 0, found = std::nan("");
    for (const std::size_t i : order) {
      if (weights[i] == 0) continue;
      below += weights[i];
      found = values[i];
      // The sum rounds: 95 of 100 equal weights are 95 %.
      if (below >= fraction * total * (1 - 1e-12)) break;
    }
    result.push_back(found);
  }
  return result;
}

}  // namespace

double weightedPercentile(std::span<const double> values, std::span<const double> weights, double fraction) {
  return percentiles(values, weights, {&fraction, 1})[0];
}

std::vector<StressSummary> summarizeStress(const Regions& regions, std::span<const StressFrame> frames) {
  if (regions.region.size() != regions.area_m2.size()) throw std::logic_error("regions need one area per sample");
  std::vector<StressSummary> summaries;
  for (std::size_t r = 0; r < regions.names.size(); ++r) {
    StressSummary s;
    std::vector<double> values, strains, weights;
    for (const StressFrame& f : frames) {
      if (f.stress_N_per_m.size() != regions.region.size() || f.strain.size() != regions.region.size())
        throw std::logic_error("a stress frame needs one value per sample");
      for (std::size_t i = 0; i < regions.region.size(); ++i) {
        if (regions.region[i] != static_cast<int>(r)) continue;
        const double stress = f.stress_N_per_m[i], strain = f.strain[i];
        if (!std::isfinite(stress) || !std::isfinite(strain))
          throw RunError(fmt::format("stress or strain is not finite in {} at {} s", regions.names[r], f.time_s));
        if (values.empty() || stress > s.max_N_per_m) s.max_N_per_m = stress, s.max_time_s = f.time_s;
        if (values.empty() || strain > s.max_strain) s.max_strain = strain, s.max_strain_time_s = f.time_s;
        values.push_back(stress);
        strains.push_back(strain);
        weights.push_back(regions.area_m2[i]);
      }
    }
    const double fractions[] = {0.50, 0.95, 0.99};
    const auto p = percentiles(values, weights, fractions);
    s.p50_N_per_m = p[0];
    s.p95_N_per_m = p[1];
    s.p99_N_per_m = p[2];
    s.p99_strain = weightedPercentile(strains, weights, 0.99);
    summaries.push_back(s);
  }
  return summaries;
}

}  // namespace gambeson
