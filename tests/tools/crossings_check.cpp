/// Counts the pairs of triangles that intersect in a run, by exact predicates: cloth with itself and with the bodies.
///
///   crossings_check RESULTS             the frames of a recording. It holds single precision; in double precision are
///                                       the frames at a checkpoint (record them all so with output.checkpoint =
///                                       output.frame)
///   crossings_check RESULTS --again     every frame in double precision: steps the case again, which gives the same
///                                       bits, and compares them with those recorded
///   crossings_check CASE.json           steps a case, and records nothing
///
/// --every-step looks after every step too. Prints a line for each frame (for steps only where something intersects):
/// time, precision, pairs of cloth with cloth, pairs of cloth with a body, collapsed triangles. --numbers FILE: what
/// was counted, as JSON, with what the steps reported of themselves where the case was stepped. --free-by TIME: for
/// scenes that start tangled; what intersects until then is no failure. Exit: 0 nothing intersects; 1 something does,
/// or stepping again gave other bits; 2 bad input or a run that fails.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/recording/state_checkpoint.hpp"
#include "cases/wear/recording/windows.hpp"
#include "cases/wear/run/dress.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/recording.hpp"
#include "core/motion/free_steps.hpp"
#include "exact/scene_intersections.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path path;
  std::vector<std::string> overrides;
  bool again = false, every_step = false;
  int named = 3;
  double free_by_s = -1e300;
  fs::path numbers;
};

/// Looks, prints and counts.
class Looker {
 public:
  Looker(const Scenario& scenario, const Options& options)
      : check_(*scenario.model, *scenario.stage),
        cloth_(static_cast<int>(scenario.model->surface.triangles.size())),
        named_(options.named),
        free_by_s_(options.free_by_s) {
    fmt::print("{:>13}  {:<9}{:>12}{:>12}{:>11}\n", "time [s]", "precision", "with cloth", "with body", "collapsed");
  }

  void state(const State& s, bool always) { show(check_.at(s), s.time_s, "double", always); }
  void samples(std::span<const Vec3> x, double time_s) { show(check_.ofSamples(x, time_s), time_s, "single", true); }

  /// 1 where something intersects that should not.
  int verdict(const char* looked_at) const {
    fmt::print("{} {}, {} with intersections, {} pairs at most\n", looks_, looked_at, intersecting_, most_);
    if (across_seams_ > 0)
      fmt::print("and up to {} pairs of both sides of a sewn seam, which touch each other there\n", across_seams_);
    if (intersecting_ > 0 && !late_) fmt::print("free from {:.6f} s on\n", free_from_s_);
    return late_;
  }

  nlohmann::ordered_json numbers() const {
    nlohmann::ordered_json j{
        {"looks", looks_}, {"looks_with_intersections", intersecting_}, {"most_pairs", most_}, {"late", late_}};
    // Null while it is not free.
    if (intersecting_ > 0)
      j["free_from_s"] = std::isfinite(free_from_s_) ? nlohmann::ordered_json(free_from_s_) : nullptr;
    return j;
  }

 private:
  void show(const exact::Intersections& found, double time_s, const char* precision, bool always) {
    ++looks_;
    intersecting_ += !found.none();
    late_ = late_ || (!found.none() && time_s > free_by_s_);
    if (!found.none())
      free_from_s_ = std::numeric_limits<double>::infinity();
    else if (!std::isfinite(free_from_s_))
      free_from_s_ = time_s;
    most_ = std::max(most_, found.pairs.size());
    across_seams_ = std::max(across_seams_, found.across_seams.size());
    if (!always && found.none()) return;
    const auto with_cloth = std::count_if(found.pairs.begin(), found.pairs.end(),
                                          [&](const exact::IntersectingPair& p) { return p.b < cloth_; });
    fmt::print("{:>13.9f}  {:<9}{:>12}{:>12}{:>11}\n", time_s, precision, with_cloth,
               static_cast<long>(found.pairs.size()) - with_cloth, found.collapsed.size());
    for (int k = 0; k < named_ && k < static_cast<int>(found.pairs.size()); ++k)
      fmt::print("    {}\n", check_.name(found.pairs[k]));
    for (int k = 0; k < named_ && k < static_cast<int>(found.collapsed.size()); ++k)
      fmt::print("    {} has no area\n", check_.name(found.collapsed[k]));
    std::fflush(stdout);
  }

  exact::SceneIntersections check_;
  int cloth_, named_;
  long looks_ = 0, intersecting_ = 0;
  std::size_t most_ = 0, across_seams_ = 0;
  double free_by_s_;
  bool late_ = false;
  double free_from_s_ = -1e300;  ///< infinite while something intersects
};

/// What the steps of a run report of themselves.
struct Steps {
  long steps = 0, frames = 0, flagged_frames = 0, pinched = 0, cloth_contacts = 0, contacts = 0;
  double largest_way_cells = 0, way_time_s = 0;
  long pinched_in_frame = 0;

  void add(const State& after, const StepReport& r) {
    ++steps;
    pinched_in_frame += r.pinched;
    contacts = std::max<long>(contacts, r.contacts);
    cloth_contacts = std::max<long>(cloth_contacts, r.cloth_contacts);
    if (r.largest_way > largest_way_cells) largest_way_cells = r.largest_way, way_time_s = after.time_s;
  }
  void closeFrame() {
    ++frames;
    flagged_frames += pinched_in_frame > 0;
    pinched += std::exchange(pinched_in_frame, 0);
  }
  void print() const {
    fmt::print(
        "{} steps, {} frames, {} of them flagged; contacts at most {}, {} of cloth with cloth; no sample went "
        "farther than {:.3f} cells in a step (at {:.4f} s)\n",
        steps, frames, flagged_frames, contacts, cloth_contacts, largest_way_cells, way_time_s);
  }
};

int checkRecorded(const Scenario& scenario, const RecordingReader& recording, Looker& look) {
  int checkpoint = 0, in_double = 0;
  for (int f = 0; f < recording.frameCount(); ++f) {
    const double time = recording.time(f);
    while (checkpoint < recording.checkpointCount() && recording.checkpoint(checkpoint).time_s < time) ++checkpoint;
    if (checkpoint < recording.checkpointCount() && recording.checkpoint(checkpoint).time_s == time) {
      Frequency frequency;
      look.state(stateOf(recording.checkpoint(checkpoint), frequency), true);
      ++in_double;
      continue;
    }
    const std::vector<float> values = recording.frame(f).positions;
    std::vector<Vec3> x(values.size() / 3);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    if (static_cast<int>(x.size()) != scenario.model->surface.size())
      throw InputError({}, "the recording has another number of samples than its case");
    look.samples(x, time);
  }
  fmt::print("{} of {} frames are in double precision\n", in_double, recording.frameCount());
  return look.verdict("frames");
}

/// Does the frame hold these samples, rounded to single precision?
bool holds(const Frame& frame, const Model& model, const State& state) {
  std::vector<Vec3> x;
  samplePositions(model, state.p, x);
  if (frame.time_s != state.time_s || frame.positions.size() != 3 * x.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 3; ++c)
      if (frame.positions[3 * i + c] != static_cast<float>(x[i][c])) return false;
  return true;
}

int checkAgain(const Scenario& scenario, const RecordingReader* recording, const Options& options, Looker& look) {
  const Case& c = scenario.definition;
  StepWork work;
  Frequency frequency;
  State state = startOf(scenario, work);
  look.state(state, true);
  const Windows windows(scenario.start_s, scenario.end_s, c.output.window_s);
  int frame = 0, equal = 0;
  Steps steps;
  std::string failure;
  const std::unique_ptr<Integrator> integrator =
      makeIntegrator(c.time.motion, *scenario.model, *scenario.stage, c.time.control(), frequency, work);
  for (long k = 1; k <= windows.count(); ++k) {
    try {
      integrator->advance(
              windows.bound(k), state,
              [&](const State&, const State& after, const StepReport& report, const StepResult&, const Frequency&) {
                steps.add(after, report);
                if (options.every_step) look.state(after, false);
              });
    } catch (const RunError& e) {
      failure = e.what();
      break;
    }
    if (!windows.completes(k, c.output.frame_s)) continue;
    steps.closeFrame();
    look.state(state, true);
    if (!recording) continue;
    if (frame == recording->frameCount()) break;  // of a run that was cut off
    equal += holds(recording->frame(frame++), *scenario.model, state);
  }
  int status = 0;
  if (recording) {
    fmt::print("{} of {} frames are those recorded, bit for bit\n", equal, recording->frameCount());
    status = equal < recording->frameCount();
  }
  steps.print();
  status =
      std::max(status, look.verdict(options.every_step ? "looks after steps and at frames" : "frames and the start"));
  if (!options.numbers.empty()) {
    nlohmann::ordered_json j = look.numbers();
    j["steps"] = steps.steps;
    j["frames"] = steps.frames;
    j["flagged_frames"] = steps.flagged_frames;
    j["pinched_samples"] = steps.pinched;
    j["most_contacts"] = steps.contacts;
    j["most_contacts_of_cloth_with_cloth"] = steps.cloth_contacts;
    j["largest_way_cells"] = steps.largest_way_cells;
    j["until_s"] = state.time_s;
    if (!failure.empty()) j["failure"] = failure;
    writeFileAtomically(options.numbers, j.dump(2) + "\n");
  }
  if (!failure.empty()) throw RunError(failure);
  return status;
}

int check(int argc, char** argv) {
  Options options;
  CLI::App app{"Intersecting triangles in a run, by exact predicates"};
  app.add_option("path", options.path, "results folder, or case file")->required();
  app.add_option("--set", options.overrides, "PATH=VALUE, replaces a value of the case file")->allow_extra_args(false);
  app.add_flag("--again", options.again, "step the recorded case again, in double precision");
  app.add_flag("--every-step", options.every_step, "look after every step as well");
  app.add_option("--free-by", options.free_by_s, "time in s until which intersections are no failure");
  app.add_option("--numbers", options.numbers, "file for what was counted; not for a recording that is not stepped");
  app.add_option("--name", options.named, "how many pairs of a frame are named")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  const bool results = fs::is_directory(options.path);
  if (results && !options.overrides.empty()) throw InputError({}, "--set belongs to a case file, not to results");
  if (results && !options.again && !options.numbers.empty()) throw InputError({}, "--numbers needs --again");
  if (results && options.every_step && !options.again) throw InputError({}, "--every-step needs --again");
  const auto scenario = buildScenario(readCase(results ? options.path / "case.json" : options.path, options.overrides));
  if (!results || options.again) putOn(*scenario);
  if (!results) {
    Looker look(*scenario, options);
    return checkAgain(*scenario, nullptr, options, look);
  }
  const RecordingReader recording(options.path);
  Looker look(*scenario, options);
  return options.again ? checkAgain(*scenario, &recording, options, look) : checkRecorded(*scenario, recording, look);
}

}  // namespace
}  // namespace gambeson

int main(int argc, char** argv) {
  try {
    return gambeson::check(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "crossings_check: {}\n", e.what());
    return 2;
  }
}
