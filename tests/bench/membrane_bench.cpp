/// Internal force of cloth of triangles on 10,000 cells by its membrane, per point; springs and conditions also with
/// damping. A flat fabric without jamming that bends linearly.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <array>

#include "bench_sheet.hpp"
#include "bench_table.hpp"
#include "bench_time.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"

namespace gambeson {
namespace {

constexpr int kCells = 100, kCalls = 200;

TriangleCloth clothWith(MembraneElements elements, double damping) {
  Garment garment = bench::wavySheet(2, kCells, false, bench::Knots::uneven_polynomial);
  garment.fabric.law = LinearBending{{1e-5, 1e-5, 1e-5}};
  std::vector<MeshDraft> garments{meshDraft(garment, MeshKind::single)};
  garments[0].membrane.elements = elements;
  garments[0].membrane.stretch_damping_Ns_per_m = damping;
  return TriangleCloth(std::move(garments));
}

/// All take turns in one run.
void MembraneForce(benchmark::State& state) {
  omp_set_num_threads(1);
  const TriangleCloth cloths[] = {clothWith(MembraneElements::continuum, 0), clothWith(MembraneElements::springs, 0.1),
                                  clothWith(MembraneElements::baraff_witkin, 0.1)};
  constexpr std::array names{"continuum", "springs", "baraff_witkin"};
  std::vector<Vec3> q = cloths[0].rest();
  for (Vec3& x : q) x += 1e-3 * Vec3{x.y * x.y, x.x * x.z, x.x * x.y};
  const std::vector<Vec3> v = q;
  std::vector<Vec3> f(q.size());
  ClothWork work[3];
  const auto timeOf = [&](const auto& call) { return bench::medianOf(kCalls, call) / static_cast<double>(q.size()); };
  for (auto _ : state) {
    double own[3];
    for (std::size_t k = 0; k < 3; ++k) {
      own[k] = timeOf([&] { cloths[k].force(q, f, work[k]); });
      state.counters[std::string(names[k]) + "_ns_per_point"] = 1e9 * own[k];
      if (k > 0) bench::note(std::string(names[k]) + " over the continuum, of triangles", own[k] / own[0]);
      if (!cloths[k].damps()) continue;
      const double damped = timeOf([&] { cloths[k].dampingForce({q, {}, {}, v}, {f, {}, {}, nullptr}, work[k]); });
      state.counters[std::string(names[k]) + "_damping_ns_per_point"] = 1e9 * damped;
    }
    state.SetIterationTime(own[0]);
  }
}
BENCHMARK(MembraneForce)->UseManualTime()->Iterations(5);

}  // namespace
}  // namespace gambeson
