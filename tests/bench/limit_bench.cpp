/// What strain limits cost and gain on the corner-held sheet of Zheng 2013, section 5.6.1 (1 m, 0.6 s, 50 frames per
/// second, full rule): seconds per frame of soft cloth that is limited, of stiff and of soft cloth that is not, at 100
/// and at 1,156 control points; and of the cloth that is stiff enough to stretch no more than the limited one.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <chrono>

#include "core/dynamics/advance.hpp"

namespace gambeson {
namespace {

class Still : public Stage {
 public:
  void placements(double, std::span<Placement>, std::span<Placement>) const override {}
};

Garment sheet(int cells, double k_over_rho) {
  const KnotVector k = uniformKnots(2, cells);
  NurbsPatch s{k, k, {}, {}};
  for (double b : grevillePoints(k))
    for (double a : grevillePoints(k)) {
      s.points.push_back({a, b, 0});
      s.weights.push_back(1);
    }
  Garment g;
  g.patches = {s};
  g.weft = {{1, 0, 0}};
  Fabric& f = g.fabric;
  f.thickness_m = 1.177e-3;
  f.density_kg_per_m3 = 0.117 / f.thickness_m;
  f.young_weft_Pa = f.young_warp_Pa = k_over_rho * f.density_kg_per_m3;
  f.shear_Pa = f.young_weft_Pa / 2.5;
  f.bending_law = BendingLaw::zheng;
  f.bending_weft_Nm = f.bending_warp_Nm = 3.3e-3;
  f.kappa0_per_m = 30;
  f.kappa_regular_per_m = 1;
  return g;
}

struct Swing {
  double frame_s = 0, most = 0, projections = 0, step_s = 0;
};

Swing swing(int cells, double k_over_rho, const StrainLimit& limit) {
  const Garment g = sheet(cells, k_over_rho);
  ModelOptions o;
  o.held_control_points = {g.patches[0].index(0, 0), g.patches[0].index(cells + 1, 0)};
  o.strain_limit = limit;
  o.cell_rule = CellRule::full;
  const auto model = buildModel(g, o, {{0, 0, -9.8}, 0.351}, {}, {});
  const StrainRows rows = buildStrainRows(g, model->map, {model->inverse_mass, {}});
  const Still stage;
  StepWork work;
  State state = initialState(*model, stage, 0, work);
  Frequency frequency;
  StepControl control;
  control.max_step_s = 2e-3;
  Swing result;
  std::vector<Vec3> e;
  double looking = 0;
  long steps = 0;
  using Clock = std::chrono::steady_clock;
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  const auto start = Clock::now();
  advance(*model, stage, control, 0.6, state, frequency, work,
          [&](const State&, const State& after, const StepReport& r, const StepWork&, const Frequency&) {
            const auto now = Clock::now();
            ++steps;
            result.projections += r.limit.projections;
            strainVectors(rows, after.p, e);
            for (const Vec3& d : e) result.most = std::max(result.most, strainOf(d));
            looking += seconds(Clock::now() - now);
          });
  result.frame_s = (seconds(Clock::now() - start) - looking) / 30;
  result.projections /= static_cast<double>(steps);
  result.step_s = 0.6 / static_cast<double>(steps);
  return result;
}

void say(benchmark::State& state, const Swing& s) {
  state.counters["s_per_frame"] = s.frame_s;
  state.counters["largest_strain_at_vertices"] = s.most;
  state.counters["mean_step_ms"] = 1e3 * s.step_s;
}

const StrainLimit kEveryStep{LimitMode::equality, 0, 0.01}, kThesis{LimitMode::equality, 0, 0.01, 40, false};

/// `kind` 0: limited, at least one projection a step; 1: limited by the tolerance alone, as the thesis; 2: k/rho 5000;
/// 3: k/rho 100.
void CornerHeldSheet(benchmark::State& state) {
  omp_set_num_threads(1);
  const int cells = static_cast<int>(state.range(0)) - 2;
  for (auto _ : state) {
    const Swing s = state.range(1) == 0   ? swing(cells, 100, kEveryStep)
                    : state.range(1) == 1 ? swing(cells, 100, kThesis)
                    : state.range(1) == 2 ? swing(cells, 5000, {})
                                          : swing(cells, 100, {});
    say(state, s);
    state.counters["projections_per_step"] = s.projections;
    state.SetIterationTime(s.frame_s);
  }
}

/// The least k/rho, by factors of two, whose largest strain is not above that of the run limited as in the thesis.
void AsStiffAsLimited(benchmark::State& state) {
  omp_set_num_threads(1);
  const int cells = static_cast<int>(state.range(0)) - 2;
  for (auto _ : state) {
    const double wanted = swing(cells, 100, kThesis).most;
    double k = 5000;
    Swing s = swing(cells, k, {});
    while (s.most > wanted && k < 1e6) s = swing(cells, k *= 2, {});
    say(state, s);
    state.counters["k_over_rho"] = k;
    state.counters["wanted_strain"] = wanted;
    state.SetIterationTime(s.frame_s);
  }
}

BENCHMARK(CornerHeldSheet)
    ->ArgNames({"points", "kind"})
    ->ArgsProduct({{10, 34}, {0, 1, 2, 3}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
BENCHMARK(AsStiffAsLimited)
    ->ArgName("points")
    ->Arg(10)
    ->Arg(34)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);

}  // namespace
}  // namespace gambeson
