#include "cases/wear/run/run.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include "cases/cloth/usual.hpp"
#include "cases/input/message.hpp"
#include "cases/runs/disk_space.hpp"
#include "cases/runs/folder_lock.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/runs/stop_message.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/case/fields.hpp"
#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/recording/recording_size.hpp"
#include "cases/wear/recording/state_checkpoint.hpp"
#include "cases/wear/recording/windows.hpp"
#include "cases/wear/results/girths.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/run/company.hpp"
#include "cases/wear/run/draft.hpp"
#include "cases/wear/run/dress.hpp"
#include "cases/wear/run/run_steps.hpp"
#include "cases/wear/scene/worn.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/motion/step.hpp"

namespace gambeson {
namespace {

/// The phases that a page names; limits of strain only where the case has them.
std::vector<std::pair<std::string, double>> phasesOf(const PhaseTimes& t, bool limited) {
  std::vector<std::pair<std::string, double>> phases{{"body motion", t.stage},
                                                     {"finding contacts", t.proximity},
                                                     {"solving contacts", t.contact},
                                                     {"finding impacts", t.impact},
                                                     {"finding intersections", t.tangles},
                                                     {"freeing intersections", t.freeing},
                                                     {"cloth forces", t.force},
                                                     {"other", t.other}};
  if (limited) phases.insert(phases.end() - 1, {"limiting strain", t.limit});
  return phases;
}

std::string phaseName(const Scenario& s, double time_s) {
  if (time_s >= 0) return s.human ? "moving" : "running";
  return time_s < -s.definition.dressing.settle_s ? "dressing" : "settling";
}

/// A recorded motion knows nothing of how thick our limbs are.
const char* limbsHint(const Case& c) {
  return c.human && kindOf(*c.human).holds_apart
             ? "; where limbs meet or a limb meets the trunk, cloth between them is crushed: hips_apart and arms_apart "
               "of the "
               "motion hold them apart"
             : "";
}

/// Supports that let go after from_s, up to to_s, do so at to_s, where the state is, and cords are drawn as they are
/// then: steps are made anew. What the energy of the cloth gains by that is theirs, as when points that were held
/// belong to it. Whether anything changed.
bool changeSupports(double from_s, double to_s, Scenario& s, State& state, Recorder& recorder, StepWork& work) {
  const std::vector<std::size_t> gone = lettingGo(s.definition, from_s, to_s);
  const bool cords = std::any_of(s.supports.begin(), s.supports.end(), [](const auto& g) { return !g.cord.empty(); });
  if (gone.empty() && !cords) return false;
  const double before = energyOf(*s.model, *s.stage, state, work).total();
  const bool drawn = drawCords(s.definition, to_s, s.supports, *s.model);
  if (gone.empty() && !drawn) return false;
  if (!gone.empty()) letGo(gone, *s.model, s.supports);
  evaluateForces(*s.model, *s.stage, state, work);
  state.steps_to_estimate = -1;
  if (drawn) state.elastic_J.reset();
  recorder.addSupportWork(energyOf(*s.model, *s.stage, state, work).total() - before);
  return true;
}

std::string easeText(double cut_m, double body_m) {
  return fmt::format("ease {:.1f} cm ({:.1f} %)", 100 * (cut_m - body_m), 100 * (cut_m / body_m - 1));
}

/// The body's zone ("thigh_left") as panels are measured there ("left thigh").
std::string zoneOfPanels(std::string zone) {
  for (const std::string side : {"left", "right"})
    if (zone.ends_with("_" + side)) zone = side + " " + zone.substr(0, zone.size() - side.size() - 1);
  std::replace(zone.begin(), zone.end(), '_', ' ');
  return zone;
}

/// In centimetres as tailors say them: "girth of the hip: body 98.3 cm; shorts 106.2 cm, ease 7.9 cm (8.0 %)" for each
/// zone that a garment goes around. Flat panels are measured at a height of their own, where the body may be another:
/// "...; panels of shirt 112.0 cm at 1.25 m, where the body is 99.8 cm: ease 12.2 cm (12.2 %)". Then one line of the
/// zones that nothing goes around.
std::vector<std::string> girthLines(const Scenario& s, const std::vector<GirthMeasure>& girths) {
  std::vector<std::string> lines;
  std::string bare;
  for (const GirthMeasure& g : girths) {
    const std::string zone = zoneOfPanels(g.zone);
    std::string worn;
    for (const GirthMeasure::Worn& w : g.worn)
      worn += fmt::format("; {} {:.1f} cm, {}", w.garment.empty() ? "garment" : w.garment, 100 * w.rest_m,
                          easeText(w.rest_m, g.body_m));
    for (std::size_t k = 0; k < s.panel_girths.size(); ++k)
      for (const PanelGirth& p : s.panel_girths[k])
        if (p.where == zone) {
          const std::string& name = s.definition.garments[k].name;
          worn += fmt::format("; panels{} {:.1f} cm at {:.2f} m, where the body is {:.1f} cm: {}",
                              name.empty() ? "" : " of " + name, 100 * p.panels_m, p.height_m, 100 * p.body_m,
                              easeText(p.panels_m, p.body_m));
        }
    const std::string body = fmt::format("{:.1f} cm", 100 * g.body_m);
    if (worn.empty())
      bare += (bare.empty() ? "" : ", ") + zone + " " + body;
    else
      lines.push_back(fmt::format("girth of the {}: body {}{}", zone, body, worn));
  }
  if (!bare.empty()) lines.push_back("girths that nothing is seen to go around: " + bare);
  return lines;
}

/// What is to be known before results: what bears on them, and what was found in files.
void sayNotes(const Scenario& s) {
  for (const std::string& note : s.notes) sayNote(note);
  for (const std::string& fact : s.facts) sayNote(fact);
}

/// A device that fails says so, and how the run goes on; all that a shell needs stands in a line of its own.
[[noreturn]] void failOnDevice(const gpu::DeviceError& e, const std::string& phase, const Case& c,
                               const RunOptions& options) {
  const std::string line = resumeLine(c, options);
  const bool whole = unfitText(line).empty();
  if (whole) fmt::print(notes(), "To go on from the last checkpoint: {}\n", line);
  const std::string text =
      fmt::format("{} ({})\nThe results up to the last checkpoint are in {}{}", e.what(), phase, options.out.string(),
                  whole ? "" : ": the same command with --resume goes on from there");
  if (e.fault() != gpu::DeviceFault::out_of_memory) throw DeviceLost(text);
  throw RunError(text);
}

}  // namespace

std::vector<std::string> checkRun(const Case& c) {
  const std::unique_ptr<Scenario> scenario = buildScenario(c);
  recordingLayout(*scenario);
  StepWork work;
  const State state = startOf(*scenario, work);
  if (c.dressing.layer_by_layer && c.dressing.from.empty()) buildApart(c);
  // Unusual numbers come first among the notes; whoever checks a file has said them with their lines.
  const auto unusual = unusualNumbers(schema::caseTable(), schema::writeObject(schema::caseTable(), &c));
  std::vector<std::string> lines(scenario->notes.begin() + static_cast<std::ptrdiff_t>(unusual.size()),
                                 scenario->notes.end());
  for (const std::string& uncut : uncutText(c, scenario->wardrobe.drafts)) lines.push_back(uncut);
  lines.insert(lines.end(), scenario->facts.begin(), scenario->facts.end());
  std::vector<Vec3> x(static_cast<std::size_t>(scenario->model->surface.size()));
  scenario->model->surface.WT.multiply<Vec3>(state.p, x);
  const std::vector<std::string> girths = girthLines(*scenario, girthsAt(*scenario, x, scenario->start_s));
  lines.insert(lines.end(), girths.begin(), girths.end());
  return lines;
}

int runCase(const Case& c, const RunOptions& options) {
  const auto clock_start = std::chrono::steady_clock::now();
  useThreads(options.threads);
  checkDevice(c, options);
  const ResultsFolder folder(options.out, inputsOf(c), options.resume);
  const bool resume = folder.resumes();
  std::optional<StopMessage> stopped;  // of several runs of a process it speaks for all
  if (!options.company)
    stopped.emplace(fmt::format(
        "stopped by a signal. What is recorded up to the last checkpoint stays in {}: the same command with "
        "--resume goes on from there",
        options.out.string()));
  const std::unique_ptr<Scenario> scenario = buildScenario(c);
  const Model& model = *scenario->model;
  const Company::Share memory = requireRoom(c, options, model);
  sayNotes(*scenario);

  StepWork work;
  State state;
  Frequency frequency;
  Checkpoint checkpoint;
  const RecordingLayout layout = recordingLayout(*scenario, options.device);
  if (resume) {
    const RunIdentity recorded(readLayout(options.out).identity);
    if (recorded.case_hash == RunIdentity(layout.identity).case_hash)  // else it is another case that is refused
      requireSameDevice(recorded, options.device, options.out.string());
  }
  if (const std::string note = sizeNote(recordingSize(*scenario, layout).bytes, freeBytes(options.out)); !note.empty())
    sayNote(note);
  DressingProgress dressing(options.out / kDressingFile,
                            RunIdentity(caseIdentity(c), model.cloth->kernels(), DeviceKind::cpu).text(),
                            options.resume && !resume);
  if (dressing.resumes())
    fmt::print(notes(), "{}: dressing goes on, with {} of {} garments on\n", options.out.string(),
               dressing.worn().garments.size(), c.garments.size());
  else if (options.resume && !resume)
    fmt::print(notes(), "{} holds no checkpoint to resume from: starting at the beginning\n", options.out.string());
  // The case is written once there is a recording and before its first segment: a recording with a segment has its
  // case, whenever the run is killed.
  if (!resume) removeEarlierResults(options.out);
  RecordingWriter writer =
      resume ? RecordingWriter::resume(options.out, layout, checkpoint) : RecordingWriter::create(options.out, layout);
  claimFile(options.out / kProgressFile);
  if (resume)
    requireRecordedCase(options.out, readLayout(options.out));
  else
    writeOwnFile(options.out / "case.json", writeCase(c));
  if (!resume) putOn(*scenario, dressing);
  state = resume ? stateOf(checkpoint, frequency) : startOf(*scenario, work);

  const Windows windows(scenario->start_s, scenario->end_s, c.output.window_s);
  long k = 0;
  while (k < windows.count() && windows.bound(k) < state.time_s) ++k;
  Recorder recorder(*scenario, writer);
  // A run that is killed early starts again from the start itself.
  if (!resume) {
    writer.closeSegment(checkpointOf(state, frequency));
    dressing.finish();
  }
  // What was let go and drawn before the checkpoint: at its own time the run had not done so yet.
  if (k > 1) {
    if (const auto gone = lettingGo(c, windows.bound(0), windows.bound(k - 1)); !gone.empty())
      letGo(gone, *scenario->model, scenario->supports);
    drawCords(c, windows.bound(k - 1), scenario->supports, *scenario->model);
  }
  const bool finished = k == windows.count();
  RunSteps steps(c, options, *scenario, frequency, work);
  std::vector<WindowTimes> times;
  auto before_s = phasesOf(work.times, c.strain_limit.has_value());
  {
    Progress progress(scenario->end_s - scenario->start_s, state.time_s - scenario->start_s, stderr, " s",
                      options.out / kProgressFile);
    try {
      steps.make();
      for (; k < windows.count(); ++k) {
        if (k > 0 && changeSupports(windows.bound(k - 1), windows.bound(k), *scenario, state, recorder, work))
          steps.make();
        steps.advance(windows.bound(k + 1), state,
                      [&](const State& before, const State& after, const StepReport& report, const StepResult& w,
                          const Frequency& f) { recorder.observe(before, after, report, w, f); });
        auto after_s = phasesOf(work.times, c.strain_limit.has_value());
        times.push_back({windows.bound(k), state.time_s, {}});
        for (std::size_t p = 0; p < after_s.size(); ++p)
          times.back().phases_s.push_back(after_s[p].second - before_s[p].second);
        before_s = std::move(after_s);
        recorder.closeWindow(state, windows.bound(k), windows.completes(k + 1, c.output.frame_s), work);
        if (scenario->human && std::abs(state.time_s) < 1e-9)
          writeDressed(dressedOf(*scenario, state), options.out / "dressed.json");
        if (windows.completes(k + 1, c.output.checkpoint_s)) writer.closeSegment(checkpointOf(state, frequency));
        progress.update(state.time_s - scenario->start_s, phaseName(*scenario, state.time_s));
      }
    } catch (const gpu::DeviceError& e) {
      failOnDevice(e, phaseName(*scenario, state.time_s), c, options);
    } catch (const RunError& e) {
      throw RunError(fmt::format("{} ({}{})\nThe results up to the last checkpoint are in {}", e.what(),
                                 phaseName(*scenario, state.time_s), limbsHint(c), options.out.string()));
    }
  }

  RunFacts facts;
  facts.threads = omp_get_max_threads();
  facts.kernels = model.cloth->kernels();
  facts.resumed = resume;
  facts.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - clock_start).count();
  facts.phases_s = phasesOf(work.times, c.strain_limit.has_value());
  facts.windows = std::move(times);
  facts.recording = layout.identity;
  facts.device = steps.facts();
  facts.searches = work.times.searches;
  facts.searched_steps_s = work.times.searched_steps;
  // Resuming a finished run only writes its results again; what was measured of the run itself stays.
  if (!finished || !std::filesystem::exists(options.out / "run.json")) writeRunFacts(facts, options.out);
  removeOwnFile(options.out / kProgressFile);
  return options.company ? 0 : finishRun(options.out);
}

int finishRun(const std::filesystem::path& out) {
  writeResults(out);
  fmt::print("Report: {}\n", (out / "report.html").string());
  return 0;
}

int finishApart(const FinishOptions& o) {
  useThreads(o.threads);
  const FolderLock lock(o.out);
  const StopMessage stopped(
      fmt::format("stopped by a signal; {} holds what is recorded, and gambeson run with --resume makes its results",
                  o.out.string()));
  return finishRun(o.out);
}

}  // namespace gambeson
