/// Internal force of the sheet on 10,000 cells of degree 2, non-uniform rational, against the core's multiply-add peak
/// measured in the same run. A point of the quadrature counts as 840 floating point operations whatever the code does:
/// the share of the peak is that of the work asked for, not of the instructions spent.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>

#include "bench_sheet.hpp"
#include "bench_table.hpp"
#include "bench_time.hpp"
#include "core/cloth/shell/shell.hpp"

namespace gambeson {
namespace {

constexpr double kFlopPerPoint = 840;
constexpr int kCells = 100;

double peakOnce(const KernelSet& kernels) {
  const double start = bench::seconds(bench::Clock::wall);
  const double flop = kernels.multiplyAddPeak(300'000);
  return flop / (bench::seconds(bench::Clock::wall) - start);
}

/// Best of the iterations: other work on the machine only ever lengthens one.
template <class Work>
void timeBest(benchmark::State& state, const std::string& row, double flop, Work&& work) {
  const double best = bench::times(state, bench::Clock::wall, work).front();
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
  static const Garment garment = bench::wavySheet(2, kCells, false, bench::Knots::uneven_rational);
  static const Shell shell(garment, widestKernels());
  const std::vector<Vec3> q = bench::displaced(garment);
  std::vector<Vec3> f(q.size());
  ClothWork work;
  const int threads = static_cast<int>(state.range(0)), before = omp_get_max_threads();
  omp_set_num_threads(threads);
  const double flop = kFlopPerPoint * static_cast<double>(shell.gaussPoints());
  if (state.range(1)) {
    timeBest(state, "force " + std::to_string(threads), flop, [&] { shell.force(q, f, work); });
  } else {
    shell.force(q, f, work);
    timeBest(state, "kernel " + std::to_string(threads), flop, [&] { shell.cellForces(q, {}, work); });
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
