/// What strain limits cost and gain on the corner-held sheet of Zheng 2013, section 5.6.1 (1 m, 0.6 s, 50 frames per
/// second, full rule): seconds per frame of soft cloth that is limited, of stiff and of soft cloth that is not, at 100
/// and at 1,156 control points; and of the cloth that is stiff enough to stretch no more than the limited one. Then one
/// projection by itself, from a thousand to a hundred thousand control points.
#include <benchmark/benchmark.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench_time.hpp"
#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/motion/velocity_verlet.hpp"

namespace gambeson {
namespace {

const ShellOptions kFull{.rule = CellRule::full};

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
  f.law = ZhengBending{{3.3e-3, 3.3e-3}, 30, 1};
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
  const auto model = buildModel(std::make_unique<NurbsShell>(g, kFull), o, {{0, 0, -9.8}, 0.351}, {}, {});
  const StrainRows rows = model->cloth->strainRows({model->inverse_mass, {}});
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
  const auto now = [] { return bench::seconds(bench::Clock::processor); };
  const double start = now();
  VelocityVerlet(*model, stage, control, frequency, work)
      .advance(0.6, state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 const double pause = now();
                 ++steps;
                 result.projections += r.limit.projections;
                 strainVectors(rows, after.p, e);
                 for (const Vec3& d : e) result.most = std::max(result.most, strainOf(d));
                 looking += now() - pause;
               });
  result.frame_s = (now() - start - looking) / 30;
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

/// The control points on a cylinder of 0.5 m radius, which stretches nothing, and by 1 % where it is most along both
/// directions: what a step may leave to the projection.
std::vector<Vec3> stretched(const Garment& g) {
  constexpr double radius = 0.5, wave = 2 * std::numbers::pi;
  std::vector<Vec3> p;
  for (const Vec3& X : g.patches[0].points) {
    const double s = X.x + 0.01 / wave * std::sin(wave * X.x), t = X.y + 0.01 / wave * std::sin(wave * X.y);
    p.push_back({radius * std::sin(s / radius), t, radius * (1 - std::cos(s / radius))});
  }
  return p;
}

/// Control points each way, and what: 0 one projection with its factorisation, equality; 1 until every strain is within
/// 0.1 %; 2 until none is more than 0.1 % above a limit of 0.5 %; 3 the analysis, once a run. `forces`: the time in
/// those that one internal force of the sheet takes in the same run.
void Projection(benchmark::State& state) {
  omp_set_num_threads(1);
  const int cells = static_cast<int>(state.range(0)) - 2, what = static_cast<int>(state.range(1));
  const Garment g = sheet(cells, 100);
  ModelOptions o;
  o.held_control_points = {g.patches[0].index(0, 0), g.patches[0].index(cells + 1, 0)};
  o.strain_limit = what == 2 ? StrainLimit{LimitMode::upper_limit, 0.005, 1e-3} : StrainLimit{LimitMode::equality, 0};
  if (what == 0) o.strain_limit.max_projections = 1;
  const auto model = buildModel(std::make_unique<NurbsShell>(g, kFull), o, {}, {}, {});
  const StrainRows& rows = model->strain_rows;
  const std::vector<Vec3> start = stretched(g);
  std::vector<Vec3> p, f(start.size());
  ClothWork shell_work;
  model->cloth->force(start, f, shell_work);
  const double force_s = bench::medianOf(5, [&] { model->cloth->force(start, f, shell_work); });
  LimitWork work;
  LimitReport report;
  const auto project = [&] {
    p = start;
    report = {};
    startProjection(rows, {}, work);
    projectStrain(rows, o.strain_limit, true, p, report, work);
  };
  project();  // analyses the sparsity
  const std::vector<double> t = bench::times(state, bench::Clock::processor, [&] {
    if (what == 3) {
      benchmark::DoNotOptimize(SymmetricFactor(rows.S).negativePivots());
    } else {
      project();
    }
  });
  if (what == 1 || what == 2) {
    if (!report.converged) state.SkipWithError("not converged");
    state.counters["projections"] = report.projections;
    state.counters["factorisations"] = report.factorisations;
  }
  state.counters["rows"] = rows.rows();
  state.counters["forces"] = t[t.size() / 2] / force_s;
  state.counters["median_ms"] = 1e3 * t[t.size() / 2];
}

BENCHMARK(Projection)
    ->ArgNames({"points", "what"})
    ->ArgsProduct({{32, 100, 316}, {0, 1, 3}})
    ->ArgsProduct({{32, 100}, {2}})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5);
BENCHMARK(Projection)
    ->ArgNames({"points", "what"})
    ->Args({316, 2})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1);
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
