/// Internal force of the sheet on 10,000 cells of degree 2, non-uniform rational, against the core's multiply-add peak
/// measured in the same run. A point of the quadrature counts as 840 floating point operations whatever the code does:
/// the share of the peak is that of the work asked for, not of the instructions spent.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bench_table.hpp"
#include "core/sheet/shell.hpp"

namespace gambeson {
namespace {

constexpr double kFlopPerPoint = 840;
constexpr int kCells = 100;

/// A wavy sheet of 1 m; knots and weights uneven, so that nothing is uniform and every cell is rational.
Garment sheet() {
  KnotVector k{2, {0, 0}};
  for (int i = 0; i <= kCells; ++i) k.knots.push_back((i + 0.3 * std::sin(2.0 * i)) / kCells);
  k.knots[2] = 0;
  k.knots.back() = 1;
  k.knots.insert(k.knots.end(), {1, 1});
  NurbsPatch s{k, k, {}, {}};
  const std::vector<double> t = grevillePoints(k);
  for (std::size_t j = 0; j < t.size(); ++j)
    for (std::size_t i = 0; i < t.size(); ++i) {
      s.points.push_back({t[i], t[j], 0.02 * std::sin(20 * t[i]) * std::cos(15 * t[j])});
      s.weights.push_back(1 + 0.2 * std::sin(3.0 * static_cast<double>(i) + 5.0 * static_cast<double>(j)));
    }
  Garment g;
  g.patches = {s};
  g.weft = {{1, 0, 0}};
  // Soft armour, Zheng 2013, section 6.2.
  g.fabric.thickness_m = 0.762e-3;
  g.fabric.density_kg_per_m3 = 1440;
  g.fabric.young_weft_Pa = g.fabric.young_warp_Pa = 1.44e6;
  g.fabric.poisson = 0.3;
  g.fabric.shear_Pa = 1.44e6 / 2.6;
  g.fabric.bending_law = BendingLaw::zheng;
  g.fabric.bending_weft_Nm = g.fabric.bending_warp_Nm = 0.00371;
  g.fabric.twist_Nm = 0.00371 * 0.7;
  g.fabric.kappa0_per_m = 30;
  g.fabric.kappa_regular_per_m = 3;
  return g;
}

/// The points displaced, so that strains are not zero.
std::vector<Vec3> displaced(const Garment& g) {
  std::vector<Vec3> q = g.patches[0].points;
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] += Vec3{1e-4 * std::sin(7.0 * static_cast<double>(i)), 1e-4 * std::cos(11.0 * static_cast<double>(i)),
                 1e-4 * std::sin(13.0 * static_cast<double>(i))};
  return q;
}

double peakOnce(const KernelSet& kernels) {
  const auto start = std::chrono::steady_clock::now();
  const double flop = kernels.multiplyAddPeak(300'000);
  return flop / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Best of the iterations: other work on the machine only ever lengthens one.
template <class Work>
void timeBest(benchmark::State& state, const std::string& row, double flop, Work&& work) {
  double best = 1e300;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    best = std::min(best, s);
    state.SetIterationTime(s);
  }
  state.counters["best_GFlop/s"] = flop / best * 1e-9;
  bench::note(row, flop / best * 1e-9);
}

void MultiplyAddPeak(benchmark::State& state) {
  const KernelSet& kernels = widestKernels();
  double best = 0;
  for (auto _ : state) best = std::max(best, peakOnce(kernels));
  state.counters["best_GFlop/s"] = best * 1e-9;
  bench::note("peak", best * 1e-9);
}

/// `gather` 0: the cells' kernel alone; 1: with the sums on the control points.
void SheetForce(benchmark::State& state) {
  static const Garment garment = sheet();
  static const Shell shell(garment, widestKernels());
  const std::vector<Vec3> q = displaced(garment);
  std::vector<Vec3> f(q.size());
  ShellWork work;
  const int threads = static_cast<int>(state.range(0)), before = omp_get_max_threads();
  omp_set_num_threads(threads);
  const double flop = kFlopPerPoint * static_cast<double>(shell.gaussPoints());
  if (state.range(1)) {
    timeBest(state, "force " + std::to_string(threads), flop, [&] { shell.force(q, f, work); });
  } else {
    shell.force(q, f, work);
    timeBest(state, "kernel " + std::to_string(threads), flop, [&] { shell.cellForces(q, work); });
  }
  omp_set_num_threads(before);
}

BENCHMARK(MultiplyAddPeak)->Unit(benchmark::kMillisecond)->MinTime(1);
BENCHMARK(SheetForce)
    ->ArgNames({"threads", "gather"})
    ->Args({1, 0})
    ->Args({2, 0})
    ->Args({1, 1})
    ->Args({2, 1})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->MinTime(1);

}  // namespace
}  // namespace gambeson
