/// Residual, tangent and factorisation of the sheet, one thread.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "bench_table.hpp"
#include "core/dynamics/reduction.hpp"
#include "core/sheet/supports.hpp"
#include "core/sheet/tangent.hpp"

namespace gambeson {
namespace {

/// A wavy sheet of 1 m; knots and weights uneven, so that nothing is uniform and every cell is rational. `solid`: the
/// consistent section in place of armour's bending law.
Garment sheet(int degree, int cells, bool solid, bool rational = true) {
  KnotVector k{degree, std::vector<double>(degree + 1, 0.0)};
  for (int i = 1; i < cells; ++i) k.knots.push_back((i + 0.3 * std::sin(2.0 * i)) / cells);
  k.knots.insert(k.knots.end(), degree + 1, 1.0);
  NurbsPatch s{k, k, {}, {}};
  const std::vector<double> t = grevillePoints(k);
  for (std::size_t j = 0; j < t.size(); ++j)
    for (std::size_t i = 0; i < t.size(); ++i) {
      s.points.push_back({t[i], t[j], 0.02 * std::sin(20 * t[i]) * std::cos(15 * t[j])});
      s.weights.push_back(!rational ? 1
                                    : 1 + 0.2 * std::sin(3.0 * static_cast<double>(i) + 5.0 * static_cast<double>(j)));
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
  g.fabric.bending_law = solid ? BendingLaw::consistent : BendingLaw::zheng;
  g.fabric.bending_weft_Nm = g.fabric.bending_warp_Nm = 0.00371;
  g.fabric.twist_Nm = 0.00371 * 0.7;
  g.fabric.kappa0_per_m = 30;
  g.fabric.kappa_regular_per_m = 3;
  return g;
}

std::vector<Vec3> displaced(const Garment& g) {
  std::vector<Vec3> q = g.patches[0].points;
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] += Vec3{1e-4 * std::sin(7.0 * static_cast<double>(i)), 1e-4 * std::cos(11.0 * static_cast<double>(i)),
                 1e-4 * std::sin(13.0 * static_cast<double>(i))};
  return q;
}

/// Median time of a call over the number of cells [us].
template <class Work>
void timeMedian(benchmark::State& state, double cells, Work&& work) {
  std::vector<double> times;
  for (auto _ : state) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    times.push_back(s);
    state.SetIterationTime(s);
  }
  std::nth_element(times.begin(), times.begin() + static_cast<long>(times.size() / 2), times.end());
  state.counters["us_per_cell"] = times[times.size() / 2] / cells * 1e6;
}

/// Degree, cells in each direction, solid section, what (0 residual, 1 tangent with scatter, 2 pattern and lists), and
/// rule: 0 the full rule of degree + 1 points on a rational sheet, 1 the same on a polynomial one, 2 the default rule
/// there.
void ShellCell(benchmark::State& state) {
  const int degree = static_cast<int>(state.range(0)), cells = static_cast<int>(state.range(1));
  const Garment garment = sheet(degree, cells, state.range(2) != 0, state.range(4) == 0);
  const Shell shell(garment, widestKernels(), 0, state.range(4) == 2 ? CellRule::automatic : CellRule::full);
  const FreeMap map = buildFreeMap(garment);
  const std::vector<Vec3> q = displaced(garment);
  ShellWork work;
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
    timeMedian(state, count, [&] { benchmark::DoNotOptimize(Tangent(shell, map).pattern().rows()); });
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
void Factorisation(benchmark::State& state) {
  const int cells = static_cast<int>(state.range(0));
  const Garment garment = sheet(2, cells, true, false);
  const Shell shell(garment, widestKernels());
  const FreeMap map = buildFreeMap(garment);
  const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PatchEdge edge{0, Side::u0, false};
  std::vector<LinearConstraint> held = supportEdge(garment, edge, axes);
  for (LinearConstraint& c : clampRotation(garment, edge)) held.push_back(std::move(c));
  const DofMap dofs = buildDofMap(map, held, 0);
  omp_set_num_threads(1);
  ShellWork work;
  BlockMatrix K;
  const Tangent tangent(shell, map);
  tangent.assemble(shell, garment.patches[0].points, work, K);
  const Reduction reduction(K, dofs.C);
  SymmetricMatrix A = reduction.pattern();
  reduction.reduce(K, A);
  SymmetricFactor factor(A);
  if (factor.factorise(A) != Definiteness::positive) state.SkipWithError("not positive definite");
  std::vector<double> b(A.size, 1.0), x(A.size);
  const double count = static_cast<double>(cells) * cells;
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
}

BENCHMARK(Factorisation)
    ->ArgNames({"cells", "what"})
    ->ArgsProduct({{30, 100, 316}, {0, 1, 2, 3}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->MinTime(0.3);

}  // namespace
}  // namespace gambeson
