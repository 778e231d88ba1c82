/// Internal force of cloth of triangles on 10,000 cells beside that of the NURBS shell from the same draft, per point.
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

/// `mesh`: 0 single, 1 equilateral. Both cloths take turns in one run.
void TriangleForce(benchmark::State& state) {
  omp_set_num_threads(1);
  const Garment garment = bench::wavySheet(2, kCells, false, bench::Knots::uneven_polynomial);
  const NurbsShell shell(garment);
  const bool single = state.range(0) == 0;
  std::vector<MeshDraft> garments;
  garments.push_back(meshDraft(garment, single ? MeshKind::single : MeshKind::equilateral));
  const TriangleCloth triangles(std::move(garments));
  const auto displacedBy = [](const Cloth& c) {
    std::vector<Vec3> q = c.rest();
    for (Vec3& x : q) x += 1e-3 * Vec3{x.y * x.y, x.x * x.z, x.x * x.y};
    return q;
  };
  const std::vector<Vec3> qs = displacedBy(shell), qt = displacedBy(triangles);
  std::vector<Vec3> fs(qs.size()), ft(qt.size());
  ClothWork ws, wt;
  for (auto _ : state) {
    const double of_shell = bench::medianOf(kCalls, [&] { shell.force(qs, fs, ws); }) / static_cast<double>(qs.size());
    const double own = bench::medianOf(kCalls, [&] { triangles.force(qt, ft, wt); }) / static_cast<double>(qt.size());
    state.SetIterationTime(own);
    state.counters["shell_ns_per_point"] = 1e9 * of_shell;
    state.counters["triangles_ns_per_point"] = 1e9 * own;
    state.counters["over_shell"] = own / of_shell;
    bench::note(single ? "triangles, single, over the shell" : "triangles, equilateral, over the shell",
                own / of_shell);
  }
}
BENCHMARK(TriangleForce)->ArgName("equilateral")->Arg(0)->Arg(1)->UseManualTime()->Iterations(5);

}  // namespace
}  // namespace gambeson
