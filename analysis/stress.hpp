#pragma once
/// How hard the cloth is pulled: percentiles of the principal stress resultant, and the largest strain, per region.

#include <span>
#include <string>
#include <vector>

namespace gambeson {

/// A region is a patch of a garment: region[i] and area_m2[i] (consistent, may not be negative) of each sample.
struct Regions {
  std::vector<std::string> names;
  std::vector<int> region;
  std::vector<double> area_m2;
};

/// One frame: the larger principal stress resultant [N/m] and the larger principal Green-Lagrange strain of each
/// sample.
struct StressFrame {
  double time_s = 0;
  std::vector<float> stress_N_per_m, strain;
};

/// Percentiles by area: p95 is the least stress (p99_strain: the least strain) that 95 % (99 %) of the area does not
/// exceed.
struct StressSummary {
  double p50_N_per_m = 0, p95_N_per_m = 0, p99_N_per_m = 0;
  double max_N_per_m = 0, max_time_s = 0;
  double p99_strain = 0, max_strain = 0, max_strain_time_s = 0;
};

/// The least of `values` such that those not above it hold at least `fraction` (in [0, 1]) of the weight; without
/// weight or values NaN. Throws RunError where a value is not finite, std::logic_error for a negative weight.
double weightedPercentile(std::span<const double> values, std::span<const double> weights, double fraction);

/// One summary per region over all frames together (each frame with the same weight). Throws RunError where a value is
/// not finite, naming the region and the time.
std::vector<StressSummary> summarizeStress(const Regions& regions, std::span<const StressFrame> frames);

}  // namespace gambeson
