/// Stiff fabric, 2 kN/m: semi-implicit steps of 2 ms beside explicit ones, one thread. Simulated time over that of the
/// processor, on a sheet that drapes over a sphere with self-contact (`contact` 1) and on one that falls and touches
/// nothing (0). Bending allows a step of 6 ms there, so that one substep is enough.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <omp.h>

#include <cmath>

#include "bench_table.hpp"
#include "bench_time.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/motion/free_steps.hpp"

namespace gambeson {
namespace {

constexpr double kThickness_m = 0.4e-3, kStiffness_N_per_m = 2e3;

Case stiffSheet(bool contact, bool triangles, const char* scheme, double tolerance) {
  std::vector<std::string> set{
      fmt::format("fabric.thickness={} m", kThickness_m),
      fmt::format("fabric.young={} Pa", kStiffness_N_per_m / kThickness_m),
      "fabric.surface_density=0.2 kg/m^2", "fabric.bending.rigidity=1e-5 N m", "contact.layer=1 mm",
      "time.duration=0.4 s", fmt::format("garment.model={}", triangles ? "triangles" : "nurbs"),
      fmt::format("time.scheme={}", scheme)};
  if (std::string(scheme) == "semi_implicit") {
    set.push_back("time.max_step=2 ms");
    set.push_back(fmt::format("time.solve_tolerance={}", tolerance));
  }
  if (!contact) set.push_back("garment.sheet.corner=[-0.2, -0.2, 2]");
  return readCase(GAMBESON_SOURCE_DIR "/cases/library/sphere_drape.json", set);
}

/// Simulated seconds over processor seconds, from 0.1 s on to 0.4 s.
double speedOf(const Case& c, benchmark::State& state, const std::string& name) {
  const auto scenario = buildScenario(c);
  StepWork work;
  Frequency frequency;
  State now = initialState(*scenario->model, *scenario->stage, scenario->start_s, work);
  long steps = 0, solves = 0, rows = 0;
  const auto integrator =
      makeIntegrator(c.time.motion, *scenario->model, *scenario->stage, c.time.control(), frequency, work);
  const auto watch = [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
    ++steps;
    solves += r.solve.iterations;
    rows += r.contacts;
  };
  integrator->advance(0.1, now, watch);
  steps = solves = rows = 0;
  work.times = {};
  const double start = bench::seconds(bench::Clock::processor);
  integrator->advance(0.4, now, watch);
  const double spent = bench::seconds(bench::Clock::processor) - start;
  state.counters[name + "_steps"] = static_cast<double>(steps);
  state.counters[name + "_ms_per_step"] = 1e3 * spent / static_cast<double>(steps);
  state.counters[name + "_force_ms"] = 1e3 * work.times.force / static_cast<double>(steps);
  state.counters[name + "_cg"] = static_cast<double>(solves) / static_cast<double>(steps);
  state.counters[name + "_rows"] = static_cast<double>(rows) / static_cast<double>(steps);
  state.counters[name + "_speed"] = 0.3 / spent;
  return 0.3 / spent;
}

void StiffFabric(benchmark::State& state) {
  omp_set_num_threads(1);
  const bool contact = state.range(0) != 0, triangles = state.range(1) != 0;
  const double tolerance = std::pow(10.0, -static_cast<double>(state.range(2)));
  for (auto _ : state) {
    const double own = speedOf(stiffSheet(contact, triangles, "semi_implicit", tolerance), state, "semi"),
                 verlet = speedOf(stiffSheet(contact, triangles, "verlet", tolerance), state, "verlet");
    state.counters["semi_over_verlet"] = own / verlet;
    bench::note(fmt::format("semi-implicit over Verlet, {}, {}", contact ? "draping" : "falling",
                            triangles ? "triangles" : "NURBS"),
                own / verlet);
  }
}
BENCHMARK(StiffFabric)
    ->ArgNames({"contact", "triangles", "digits"})
    ->ArgsProduct({{0, 1}, {0, 1}, {3, 6}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace gambeson
