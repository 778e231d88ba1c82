/// Internal force of cloth of triangles on 10,000 cells beside that of the NURBS shell from the same draft, per point;
/// bent by hinges, by mid-edge rotations, by triangles without them and by crossed springs.
#include <benchmark/benchmark.h>
#include <omp.h>

#include "bench_sheet.hpp"
#include "bench_table.hpp"
#include "bench_time.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"

namespace gambeson {
namespace {

constexpr int kCells = 100, kCalls = 200;

const char* const kBending[] = {"midedge", "triangle", "hinge", "springs"};

/// `equilateral`: 0 single, 1 equilateral; `bending`: of BendingElements. Both cloths take turns in one run.
void TriangleForce(benchmark::State& state) {
  omp_set_num_threads(1);
  const Garment garment = bench::wavySheet(2, kCells, false, bench::Knots::uneven_polynomial);
  const NurbsShell shell(garment);
  const bool single = state.range(0) == 0;
  std::vector<MeshDraft> garments;
  garments.push_back(meshDraft(garment, single ? MeshKind::single : MeshKind::equilateral));
  garments.back().bending = static_cast<BendingElements>(state.range(1));
  const TriangleCloth triangles(std::move(garments));
  const auto displacedBy = [](const Cloth& c) {
    std::vector<Vec3> q = c.rest();
    for (Vec3& x : q) x += 1e-3 * Vec3{x.y * x.y, x.x * x.z, x.x * x.y};
    return q;
  };
  const std::vector<Vec3> qs = displacedBy(shell), qt = displacedBy(triangles);
  std::vector<Vec3> fs(qs.size()), ft(qt.size());
  const std::vector<double> inner(triangles.innerValues());
  std::vector<double> inner_force(triangles.innerRates());
  ClothWork ws, wt;
  for (auto _ : state) {
    const double of_shell = bench::medianOf(kCalls, [&] { shell.force(qs, fs, ws); }) / static_cast<double>(qs.size());
    const double own = bench::medianOf(kCalls, [&] {
                         triangles.force({qt, inner, {}}, {ft, inner_force, {}, nullptr}, wt, {});
                       }) / static_cast<double>(qt.size());
    state.SetIterationTime(own);
    state.counters["shell_ns_per_point"] = 1e9 * of_shell;
    state.counters["triangles_ns_per_point"] = 1e9 * own;
    state.counters["over_shell"] = own / of_shell;
    bench::note(std::string("triangles, ") + (single ? "single, " : "equilateral, ") + kBending[state.range(1)] +
                    ", over the shell",
                own / of_shell);
  }
}
BENCHMARK(TriangleForce)
    ->ArgNames({"equilateral", "bending"})
    ->ArgsProduct({{0, 1}, {0, 1, 2, 3}})
    ->UseManualTime()
    ->Iterations(5);

}  // namespace
}  // namespace gambeson
