/// Internal force of cloth whose bending has hysteresis beside that of the same cloth with a linear law, on both kinds.
#include <benchmark/benchmark.h>
#include <omp.h>

#include "bench_sheet.hpp"
#include "bench_table.hpp"
#include "bench_time.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/triangles/draft_mesh.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/material/hysteresis.hpp"

namespace gambeson {
namespace {

constexpr int kCalls = 100;

template <class L>
BendingLaw loopLaw() {
  const Stops<kStops> stops = stopsOf<kStops>(curveOver(3e-5, 1e-5, 60));
  L law;
  law.weft_Nm = law.warp_Nm = stops.last_Nm;
  law.twist_Nm = 0.5 * stops.last_Nm;
  law.shape = stops.shape;
  law.first_Nm = {stops.first_Nm, stops.first_Nm, 0.5 * stops.first_Nm};
  law.span_per_m = {60, 60, 60};
  law.setting = 0.1;
  law.fatigue = 0.02;
  return law;
}

const char* const kCloth[] = {"shell", "triangles, midedge", "triangles, hinge"};

std::unique_ptr<const Cloth> clothOf(Garment garment, const BendingLaw& law, long cloth) {
  garment.fabric.law = law;
  if (cloth == 0) return std::make_unique<NurbsShell>(garment);
  std::vector<MeshDraft> garments;
  garments.push_back(meshDraft(garment, MeshKind::single));
  garments.back().bending = cloth == 1 ? BendingElements::midedge : BendingElements::hinge;
  return std::make_unique<TriangleCloth>(std::move(garments));
}

/// `cloth`: of kCloth; `isotropic`: 0 apart, 1 isotropic. All cloths take turns in one run.
void HysteresisForce(benchmark::State& state) {
  omp_set_num_threads(1);
  const Garment garment = bench::wavySheet(2, static_cast<int>(state.range(2)), false, bench::Knots::uneven_polynomial);
  const long cloth = state.range(0);
  const bool apart = state.range(1) == 0;
  const auto linear = clothOf(garment, LinearBending{{3e-5, 3e-5, 1.5e-5}}, cloth);
  const auto loop =
      clothOf(garment, apart ? loopLaw<HysteresisBending>() : loopLaw<IsotropicHysteresisBending>(), cloth);
  std::vector<Vec3> q = linear->rest(), f(q.size());
  for (Vec3& x : q) x += 1e-3 * Vec3{x.y * x.y, x.x * x.z, x.x * x.y};
  std::vector<double> committed(loop->historySize()), trial(committed.size());
  loop->startHistory(committed);
  const std::vector<double> inner(loop->innerValues());
  std::vector<double> inner_force(loop->innerRates());
  ClothWork w1, w2;
  const double points = static_cast<double>(q.size());
  for (auto _ : state) {
    const double elastic = bench::medianOf(kCalls, [&] {
      linear->force({q, inner, {}}, {f, inner_force, {}, nullptr}, w1, {});
    });
    const double own = bench::medianOf(kCalls, [&] {
      loop->force({q, inner, committed}, {f, inner_force, trial, nullptr}, w2, {});
    });
    state.SetIterationTime(own);
    state.counters["linear_ns_per_point"] = 1e9 * elastic / points;
    state.counters["loop_ns_per_point"] = 1e9 * own / points;
    state.counters["over_linear"] = own / elastic;
    bench::note(std::string("hysteresis, ") + kCloth[cloth] + (apart ? ", apart" : ", isotropic") +
                    ", " + std::to_string(state.range(2)) + "^2 cells, over linear",
                own / elastic);
  }
}
BENCHMARK(HysteresisForce)
    ->ArgNames({"cloth", "isotropic", "cells"})
    ->ArgsProduct({{0, 1, 2}, {0, 1}, {34, 100}})
    ->UseManualTime()
    ->Iterations(5);

}  // namespace
}  // namespace gambeson
