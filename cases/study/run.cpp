#include "cases/study/run.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "cases/input/message.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/runs/folder_lock.hpp"
#include "cases/runs/process_pool.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/run_identity.hpp"
#include "cases/runs/run_log.hpp"
#include "cases/runs/shell_word.hpp"
#include "cases/study/compare.hpp"
#include "cases/study/files.hpp"
#include "cases/study/map_runs.hpp"
#include "cases/study/run_variants.hpp"
#include "cases/wear/case/references.hpp"
#include "cases/wear/results/results.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/io/recording.hpp"
#include "core/math/instruction_sets.hpp"

namespace gambeson::study {
namespace {

int machineThreads() {
  cpu_set_t set;
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : omp_get_num_procs();
}

/// A job of Slurm goes on from what stands in its folder, whenever and however often it starts: an earlier run that is
/// not to be gone on from is taken away before.
void clearForJob(const std::filesystem::path& folder, const Variant& v, Stand stand) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error)) return;
  const ResultsFolder held(folder, inputsOf(v.definition), stand == Stand::interrupted);
  if (stand == Stand::interrupted) return;
  removeEarlierResults(folder);
  for (const std::filesystem::path& file : recordedFiles(folder)) removeOwnFile(file);  // the layout before segments
}

void writeForSlurm(const Study& s, const Options& o, const std::vector<Stand>& stands, std::ostream& out) {
  const std::size_t to_do = s.variants.size() - static_cast<std::size_t>(std::ranges::count(stands, Stand::done));
  if (to_do == 0) {
    out << "all variants are done: the same command with --compare, in place of --engine and what is Slurm's, compares "
           "them\n";
    return;
  }
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    if (stands[i] != Stand::done) clearForJob(o.out / s.variants[i].folder, s.variants[i], stands[i]);
  writeOwnFile(o.out / files::script, slurmScript(s, o, stands));
  claimFile(o.out / files::compare_log);
  writeOwnFile(o.out / files::compare_script, compareScript(s, o));
  writeOwnFile(o.out / files::submit, submitScript(o));
  out << fmt::format("{} of {} variants to do. This hands them to Slurm, and what compares them: bash {}\n", to_do,
                     s.variants.size(), shellWord((o.out / files::submit).string()));
}

/// Compares what the runs left; exit status as runStudy.
int compareRuns(const Study& s, const Options& o, std::vector<Outcome> outcomes,
                std::chrono::steady_clock::time_point begin, std::ostream& out) {
  const std::vector<Outcome> ran = outcomes;
  compareVariants(s, outcomes, o.out);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (ran[i].good && !outcomes[i].good)
      out << fmt::format("FAILED  {}  {}\n", s.variants[i].folder, messageText(outcomes[i].why));
  std::size_t failures = 0;
  for (const Outcome& v : outcomes) failures += !v.good;
  const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (failures > 0) out << fmt::format("{} of {} variants failed: the report says why\n", failures, s.variants.size());
  out << fmt::format("Report, after {}: {}\n", durationText(wall_s), (o.out / files::report).string());
  return failures > 0 ? 1 : 0;
}

/// What became of a variant that a job of Slurm ran, by what the job left.
Outcome outcomeOf(Stand stand, const std::filesystem::path& log) {
  std::ifstream stream(log);
  bool failed = false;
  for (std::string line; std::getline(stream, line);) failed = failed || line.starts_with("gambeson failed: ");
  const std::string last = lastMessage(log);
  // A signal may come to what has left all its results.
  if (stand == Stand::done && (!failed || last.starts_with("stopped by a signal"))) return {true, ""};
  if (failed) return {false, last};
  return {false, last.empty() ? "is not done: nothing stands in its log" : "is not done; its log ends with: " + last};
}

/// All variants by what stands in the folder, none of which is run.
int compareOnly(const Study& s, const Options& o, const std::vector<Stand>& stands,
                std::chrono::steady_clock::time_point begin, std::ostream& out) {
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    outcomes.push_back(outcomeOf(stands[i], logFile(o.out, s.variants[i])));
    if (!outcomes[i].good) out << fmt::format("FAILED  {}  {}\n", s.variants[i].folder, outcomes[i].why);
  }
  return compareRuns(s, o, std::move(outcomes), begin, out);
}

}  // namespace

bool goesOn(const Variant& v) { return !std::holds_alternative<StructureCase>(v.definition); }

Stand standOf(const std::filesystem::path& folder, const std::string& identity, DeviceKind device, bool elsewhere) {
  std::optional<RunIdentity> recorded;
  try {
    // Structures may keep no shapes, and so no segments; a segment that is damaged throws.
    recorded.emplace(closedSegments(folder) > 0 ? RecordingReader(folder).layout().identity
                                                : readLayout(folder).identity);
  } catch (const InputError&) {
    return Stand::fresh;
  }
  // Cloth whose kernels are the same everywhere says so wherever it runs.
  const bool anywhere = elsewhere || recorded->kernels == kOneForAll;
  const RunIdentity whole(identity, anywhere ? recorded->kernels : widestInstructionSet(), device);
  if (recorded->case_hash == whole.case_hash) requireSameDevice(*recorded, device, folder.string());
  if (*recorded != whole) return Stand::fresh;
  try {
    std::ifstream stream(folder / "summary.json");
    // The page is written last.
    if (!stream || !std::filesystem::exists(folder / "report.html"))
      return closedSegments(folder) > 0 ? Stand::interrupted : Stand::fresh;
    const auto j = nlohmann::json::parse(stream);
    if (!j.contains("planned_to_s")) return Stand::done;
    return j.at("recorded_to_s").get<double>() >= j.at("planned_to_s").get<double>() - 1e-9 ? Stand::done
                                                                                            : Stand::interrupted;
  } catch (const nlohmann::json::exception&) {
    return Stand::interrupted;
  }
}

int runStudy(const Study& s, const Options& chosen, std::ostream& out) {
  const auto begin = std::chrono::steady_clock::now();
  Options o = chosen;
  const Signals signals;
  o.out = std::filesystem::absolute(o.out).lexically_normal();
  checkPath(o.out, "--out");
  if (std::error_code error; o.compare && !std::filesystem::is_directory(o.out / files::cases, error))
    throw InputError({"command line", 0, "--compare"},
                     fmt::format("{} holds no study; allowed: --out with the folder of one", o.out.string()));
  if (s.optimise && o.slurm)
    throw InputError({"command line", 0, "--engine"},
                     "slurm cannot search a map, whose runs follow from each other; allowed: local");
  checkFolder(s, o, standsOf(s, o));
  for (const auto& folder : {o.out, o.out / files::cases, o.out / files::logs}) makeFolder(folder);
  const FolderLock lock(o.out);
  const std::vector<Stand> stands = standsOf(s, o);
  checkFolder(s, o, stands);  // what another command has left meanwhile
  if (o.threads <= 0) o.threads = machineThreads();
  useThreads(o.threads);
  if (s.optimise) {
    Study found = s;
    std::vector<Outcome> outcomes = runOptimisation(found, o, signals, lock.descriptor(), out);
    return compareRuns(found, o, std::move(outcomes), begin, out);
  }
  if (o.compare) return compareOnly(s, o, stands, begin, out);

  if (o.slurm) {
    for (const Variant& v : s.variants) writeVariant(o.out, v);
    for (std::size_t i = 0; i < s.variants.size(); ++i)
      if (stands[i] != Stand::done) claimFile(logFile(o.out, s.variants[i]));
    writeForSlurm(s, o, stands, out);
    return 0;
  }
  std::vector<Outcome> outcomes = runVariants(s, o, stands, signals, lock.descriptor(), out);
  return compareRuns(s, o, std::move(outcomes), begin, out);
}

}  // namespace gambeson::study
