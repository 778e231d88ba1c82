/// Residual, tangent and factorisation of the sheet, one thread.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <vector>

#include "bench_sheet.hpp"
#include "bench_time.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/cloth/shell/tangent.hpp"
#include "core/statics/reduction.hpp"

namespace gambeson {
namespace {

/// Median time of a call over the number of cells [us].
template <class Work>
void timeMedian(benchmark::State& state, double cells, Work&& work) {
  const std::vector<double> t = bench::times(state, bench::Clock::processor, work);
  state.counters["us_per_cell"] = t[t.size() / 2] / cells * 1e6;
}

/// Degree, cells in each direction, solid section, what (0 residual, 1 tangent with scatter, 2 sparsity and lists), and
/// rule: 0 the full rule of degree + 1 points on a rational sheet, 1 the same on a polynomial one, 2 the default rule
/// there.
void ShellCell(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0)), cells = static_cast<int>(state.range(1));
  const Garment garment =
      bench::wavySheet(degree, cells, state.range(2) != 0,
                       state.range(4) == 0 ? bench::Knots::uneven_rational : bench::Knots::uneven_polynomial);
  const Shell shell(garment, widestKernels(), 0, state.range(4) == 2 ? CellRule::automatic : CellRule::full);
  const FreeMap map = buildFreeMap(garment);
  const std::vector<Vec3> q = bench::displaced(garment);
  ClothWork work;
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const double count = static_cast<double>(cells) * cells;
  if (state.range(3) == 0) {
    std::vector<Vec3> f(q.size());
    shell.force(q, f, work);
    timeMedian(state, count, [&] { shell.force(q, f, work); });
  } else if (state.range(3) == 1) {
    const Tangent tangent(shell, map);
    BlockMatrix K;
    tangent.assemble(shell, q, work, K);
    timeMedian(state, count, [&] { tangent.assemble(shell, q, work, K); });
  } else {
    timeMedian(state, count, [&] { benchmark::DoNotOptimize(Tangent(shell, map).sparsity().rows()); });
  }
  omp_set_num_threads(before);
}

BENCHMARK(ShellCell)
    ->ArgNames({"degree", "cells", "solid", "what", "rule"})
    ->ArgsProduct({{2}, {32, 100, 316}, {0, 1}, {0, 1}, {0}})
    ->ArgsProduct({{2}, {32, 100, 316}, {1}, {0, 1}, {1, 2}})
    ->ArgsProduct({{3}, {100}, {0, 1}, {0, 1}, {0}})
    ->ArgsProduct({{2, 3}, {100}, {1}, {2}, {0}})
    ->UseManualTime()
    ->Unit(benchmark::kMicrosecond)
    ->MinTime(0.3);

/// The tangent of a solid quadratic sheet held at one edge, in its unknowns. Cells in each direction, and what: 0
/// reduction from blocks, 1 numerical factorisation (the symbolic one is kept), 2 analysis, 3 solution of one load.
/// `tangents`: the time in those that assembling the tangent takes in the same run.
void Factorisation(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const Garment garment = bench::wavySheet(2, cells, true, bench::Knots::uneven_polynomial);
  const Shell shell(garment, widestKernels());
  const FreeMap map = buildFreeMap(garment);
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PatchEdge edge{0, Side::u0, false};
  std::vector<LinearConstraint> held = supportEdge(garment, edge, axes);
  for (LinearConstraint& c : clampRotation(garment, edge)) held.push_back(std::move(c));
  const DofMap dofs = buildDofMap(map, held, 0);
  omp_set_num_threads(1);
  ClothWork work;
  BlockMatrix K;
  const Tangent tangent(shell, map);
  tangent.assemble(shell, garment.patches[0].points, work, K);
  const Reduction reduction(K, dofs.C);
  SymmetricMatrix A = reduction.sparsity();
  reduction.reduce(K, A);
  SymmetricFactor factor(A);
  if (factor.factorise(A) != Definiteness::positive) state.SkipWithError("not positive definite");
  std::vector<double> b(A.size, 1.0), x(A.size);
  const double count = static_cast<double>(cells) * cells;
  const double tangent_s = bench::medianOf(5, [&] { tangent.assemble(shell, garment.patches[0].points, work, K); });
  switch (state.range(1)) {
    case 0:
      timeMedian(state, count, [&] { reduction.reduce(K, A); });
      break;
    case 1:
      timeMedian(state, count, [&] { benchmark::DoNotOptimize(factor.factorise(A)); });
      break;
    case 2:
      timeMedian(state, count, [&] { benchmark::DoNotOptimize(SymmetricFactor(A).negativePivots()); });
      break;
    default:
      timeMedian(state, count, [&] { factor.solve(b, x); });
  }
  state.counters["unknowns"] = A.size;
  state.counters["tangents"] = state.counters["us_per_cell"] * 1e-6 * count / tangent_s;
}

BENCHMARK(Factorisation)
    ->ArgNames({"cells", "what"})
    ->ArgsProduct({{30, 100, 316}, {0, 1, 2, 3}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);

}  // namespace
}  // namespace gambeson
