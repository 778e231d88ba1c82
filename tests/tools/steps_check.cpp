/// Steps a worn case in memory on a device, with nothing recorded, and says what that took and led to: for comparing
/// devices by their bits and their times.

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <cstring>

#include "cases/wear/run/dress.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/motion/free_steps.hpp"
#include "core/motion/step.hpp"
#include "gpu/device/gpu.hpp"
#include "gpu/step/device_steps.hpp"

namespace gambeson {
namespace {

struct Options {
  std::string path, device = "cpu";
  std::vector<std::string> overrides;
  double until_s = 1e9, window_s = 0.01, time_from_s = -1e9, room = 1;
  long steps = 1L << 60;
};

std::uint64_t mixed(std::uint64_t hash, const void* data, std::size_t bytes) {
  const auto* at = static_cast<const unsigned char*>(data);
  for (std::size_t i = 0; i + 8 <= bytes; i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at + i, 8);
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 29;
  }
  return hash;
}

std::uint64_t hashOf(const State& s) {
  std::uint64_t hash = 1;
  for (const auto* of_points : {&s.p, &s.v, &s.a, &s.pressed})
    hash = mixed(hash, of_points->data(), of_points->size() * sizeof(Vec3));
  hash = mixed(hash, s.history.data(), s.history.size() * sizeof(double));
  for (const WarmContact& c : s.warm) {
    hash = mixed(hash, &c.traction, sizeof c.traction);
    hash = mixed(hash, &c.mean_Pa, sizeof c.mean_Pa);
    const std::int64_t key[] = {static_cast<int>(c.kind), c.sample, c.obstacle, c.feature};
    hash = mixed(hash, key, sizeof key);
  }
  return mixed(hash, &s.time_s, sizeof s.time_s);
}

struct Watch {
  long steps = 0, unsolved = 0, impacts = 0, rounds = 0, with_impacts = 0;
  double iterations = 0, momentum = 0, contacts = 0;
  Vec3 on_bodies;  ///< impulses [N s]
  void operator()(const StepReport& r) {
    ++steps;
    unsolved += !r.contact.converged;
    impacts += r.impacts, rounds += r.impact_rounds, with_impacts += r.impact_rounds > 0;
    iterations += r.contact.iterations;
    contacts += r.contacts;
    if (r.momentum.scale > 0) momentum = std::max(momentum, r.momentum.error() / r.momentum.scale);
    on_bodies += r.momentum.obstacles;
  }
};

int check(int argc, char** argv) {
  Options o;
  CLI::App app{"Steps a case on a device and says what that took"};
  app.add_option("case", o.path)->required();
  app.add_option("--set", o.overrides, "PATH=VALUE")->allow_extra_args(false);
  app.add_option("--device", o.device, "cpu, reference or cuda")->check(CLI::IsMember({"cpu", "reference", "cuda"}));
  app.add_option("--until", o.until_s, "time in s");
  app.add_option("--from", o.time_from_s, "time in s from which times are taken");
  app.add_option("--steps", o.steps, "at most");
  app.add_option("--window", o.window_s, "time in s between lines");
  app.add_option("--room", o.room, "part of their usual room that lists on a device begin with");
  CLI11_PARSE(app, argc, argv);
  const bool on_gpu = o.device == "cuda";
  const std::size_t free_bytes = on_gpu ? gpu::gpuMemory().free_bytes : 0;
  const auto scenario = buildScenario(readCase(o.path, o.overrides));
  putOn(*scenario);
  StepWork work;
  Frequency frequency;
  State state = startOf(*scenario, work);
  const TimeCase& time = scenario->definition.time;
  std::unique_ptr<Integrator> integrator;
  const gpu::DeviceSteps* on_device = nullptr;
  if (o.device == "cpu") {
    integrator = makeIntegrator(time.motion, *scenario->model, *scenario->stage, time.control(), frequency, work);
  } else {
    auto steps = (o.device == "cuda" ? gpu::stepsOnCuda : gpu::stepsOnReference)(
        *scenario->model, *scenario->stage, time.control(), frequency, work, o.room);
    on_device = steps.get();
    integrator = std::move(steps);
  }
  std::printf("%d free points, %d samples, %zu triangles\n", scenario->model->freeCount(),
              scenario->model->surface.size(), scenario->model->collisions.mesh.triangles.size());
  Watch all;
  const double end = std::min(o.until_s, scenario->end_s);
  auto start = std::chrono::steady_clock::now();
  long from_step = 0;
  PhaseTimes from = work.times;
  bool taken = false;
  for (long k = 1; state.time_s < end; ++k) {
    if (!taken && state.time_s >= o.time_from_s) {
      taken = true, start = std::chrono::steady_clock::now(), from_step = all.steps, from = work.times;
    }
    Watch here;
    integrator->advance(
        std::min(scenario->start_s + static_cast<double>(k) * o.window_s, end), state,
        [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) { here(r), all(r); });
    std::printf(
        "%9.5f s %6ld steps, hash %016llx, %6.0f contacts, %5.1f iterations, %ld impacts in %ld steps, %ld unsolved, "
        "momentum %.1e, on bodies (%.6g %.6g %.6g) N s\n",
        state.time_s, all.steps, static_cast<unsigned long long>(hashOf(state)),
        here.contacts / std::max(1L, here.steps), here.iterations / std::max(1L, here.steps), here.impacts,
        here.with_impacts, here.unsolved, here.momentum, here.on_bodies.x, here.on_bodies.y, here.on_bodies.z);
    std::fflush(stdout);
    if (all.steps >= o.steps) break;
  }
  const double took = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const PhaseTimes& t = work.times;
  const double steps = static_cast<double>(std::max(1L, all.steps - from_step)), ms = 1e3 / steps;
  std::printf(
      "%s: %.3f ms a step over %.0f steps (stage %.3f, finding %.3f, solving %.3f, impacts %.3f, forces %.3f, other "
      "%.3f, tangles %.3f); %.1f iterations, %ld unsolved, momentum %.1e\n",
      o.device.c_str(), took * ms, steps, (t.stage - from.stage) * ms, (t.proximity - from.proximity) * ms,
      (t.contact - from.contact) * ms, (t.impact - from.impact) * ms, (t.force - from.force) * ms,
      (t.other - from.other) * ms, (t.tangles + t.freeing - from.tangles - from.freeing) * ms,
      all.iterations / static_cast<double>(std::max(1L, all.steps)), all.unsolved, all.momentum);
  if (on_device) {
    const gpu::DeviceCounts counts = on_device->counts();
    std::printf("%ld steps, %ld passes repeated for want of room, %ld steps by the CPU:", counts.steps, counts.repeated,
                counts.by_cpu);
    for (const auto& [why, count] : counts.reasons) std::printf(" %ld %s;", count, why.c_str());
    std::printf("\n");
    const std::size_t told = gpu::bytesOnDevice(*scenario->model);
    if (on_gpu)
      std::printf("%.1f MB of the device's memory, told before: %.1f MB\n",
                  1e-6 * static_cast<double>(free_bytes - gpu::gpuMemory().free_bytes),
                  1e-6 * static_cast<double>(told));
  }
  return 0;
}

}  // namespace
}  // namespace gambeson

int main(int argc, char** argv) {
  try {
    return gambeson::check(argc, argv);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "steps_check: %s\n", e.what());
    return 2;
  }
}
