/// Where the time of a step of cases/library/shorts_walk.json goes: 0.3 s of walking after a shortened dressing.
#include <benchmark/benchmark.h>
#include <omp.h>

#include "bench_table.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/motion/step.hpp"

namespace gambeson {
namespace {

void StepOfShortsWalk(benchmark::State& state) {
  omp_set_num_threads(1);
  const Case c =
      readCase(GAMBESON_SOURCE_DIR "/cases/library/shorts_walk.json",
               {"dressing.projecting.grow=0.1 s", "dressing.settle=0.1 s", "human.motion.walk.lead_in=0.2 s"});
  const auto scenario = buildScenario(c);
  const StepControl control{c.time.step_safety, c.time.max_step_s};
  for (auto _ : state) {
    state.PauseTiming();
    StepWork work;
    Frequency frequency;
    State now = initialState(*scenario->model, *scenario->stage, scenario->start_s, work);
    long steps = 0, iterations = 0;
    const auto count = [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
      ++steps;
      iterations += r.contact.iterations;
    };
    VelocityVerlet(*scenario->model, *scenario->stage, control, frequency, work).advance(0, now, count);
    steps = iterations = 0;
    work.times = {};
    state.ResumeTiming();
    VelocityVerlet(*scenario->model, *scenario->stage, control, frequency, work).advance(0.3, now, count);
    const PhaseTimes& t = work.times;
    const std::pair<const char*, double> phases[] = {{"body motion", t.stage},        {"finding contacts", t.proximity},
                                                     {"solving contacts", t.contact}, {"finding impacts", t.impact},
                                                     {"cloth forces", t.force},       {"other", t.other}};
    double total = 0;
    for (const auto& phase : phases) total += phase.second;
    for (const auto& [name, seconds] : phases) {
      bench::note(std::string("phase ") + name, seconds);
      state.counters[name] = seconds / total;
    }
    state.counters["steps"] = static_cast<double>(steps);
    state.counters["solve_iterations_per_step"] = static_cast<double>(iterations) / static_cast<double>(steps);
  }
}

BENCHMARK(StepOfShortsWalk)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace gambeson
