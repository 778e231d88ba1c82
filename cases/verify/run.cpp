/// Detail of verify.hpp: runs references as processes of the command itself, a pool of them, and writes what came of
/// it.

#include <fmt/format.h>
#include <fnmatch.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "cases/input/message.hpp"
#include "cases/input/schema.hpp"
#include "cases/runs/folder_lock.hpp"
#include "cases/runs/process_pool.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/runs/shell_word.hpp"
#include "cases/verify/examples.hpp"
#include "cases/verify/verify.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"

namespace gambeson::verify {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char *kNumbers = "verify.json", *kPage = "verify.html";

std::string pageOf(const Work& work) { return work.id + ".html"; }

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The outcome of a run that is complete already, looked for where the options say.
std::optional<Outcome> keptRun(const Reference& reference, const Run& run, const Options& options) {
  if (options.results.empty()) return {};
  const auto hash = caseHash(reference, run);
  if (!hash) return {};
  for (const std::filesystem::path& folder : {options.results / reference.id / run.name, options.results / run.name}) {
    const auto seconds = completeRun(folder, *hash);
    if (seconds) return Outcome{"", *seconds, std::filesystem::absolute(folder), true};
  }
  return {};
}

/// Where things of a run stand.
struct RunFiles {
  std::filesystem::path folder, log;
  std::filesystem::path written_case;  ///< of a case that is written in the reference; else empty
};

RunFiles filesOf(const Reference& reference, const Run& run, const Options& options) {
  const std::filesystem::path base = options.out / reference.id;
  const bool own = !run.file.empty() || run.inline_case.type != JsonNode::Type::null;
  const bool inline_case = (own ? run.file : reference.case_file).empty();
  return {base / run.name, base / (run.name + ".log"), inline_case ? base / (run.name + ".json") : ""};
}

/// Whether a run of the same case that was interrupted there is to go on.
bool goesOn(const Reference& reference, const Run& run, const Options& options) {
  return !options.results.empty() && interruptedRun(options.out / reference.id / run.name, caseHash(reference, run));
}

/// All that would be written, before anything is made or computed: files of others and inputs are refused (InputError).
void checkFolder(const std::vector<Reference>& references, const std::vector<Work>& works,
                 const std::vector<std::pair<std::size_t, std::size_t>>& runs, const Options& options) {
  std::error_code error;
  for (const Reference& r : references)
    if (r.id == kNumbers || r.id == kPage ||
        std::any_of(works.begin(), works.end(), [&](const Work& w) { return r.id == pageOf(w); }))
      throw InputError({r.file.string(), 0, "id"}, "the results have a file of that name; allowed: another name");
  if (!std::filesystem::exists(options.out, error)) return;
  if (!std::filesystem::is_directory(options.out, error))
    throw InputError({"command line", 0, "--out"}, options.out.string() + " is not a folder");
  Paths inputs;
  for (const Reference& r : references) {
    inputs.insert(inputs.end(), {r.file, r.case_file});
    for (const Run& run : r.runs) inputs.push_back(run.file);
  }
  std::erase_if(inputs, [](const std::filesystem::path& p) { return p.empty(); });
  for (const char* name : {kNumbers, kPage}) requireFreeOf(options.out / name, inputs, "--out");
  for (const Work& work : works) requireFreeOf(options.out / pageOf(work), inputs, "--out");
  for (const auto& [i, k] : runs) {
    const Reference& reference = references[i];
    const RunFiles files = filesOf(reference, reference.runs[k], options);
    requireFolder(options.out / reference.id);
    requireFolder(files.folder);
    requireFreeOf(files.log, inputs, "--out");
    if (!files.written_case.empty()) requireFreeOf(files.written_case, inputs, "--out");
    checkResultsFolder(files.folder, inputs, goesOn(reference, reference.runs[k], options));
  }
}

/// The process of a run. A case that is written in the reference becomes a file beside the results, values set, so that
/// it can be run again by hand.
Process processOf(const Reference& reference, const Run& run, const Options& options) {
  const RunFiles files = filesOf(reference, run, options);
  const bool goes_on = goesOn(reference, run, options);
  makeFolder(files.folder);
  if (!goes_on) removeEarlierResults(files.folder);  // nor are they taken where the run never begins
  const bool own = !run.file.empty() || run.inline_case.type != JsonNode::Type::null;
  const std::filesystem::path& file = own ? run.file : reference.case_file;
  JsonNode inline_case = own ? run.inline_case : reference.inline_case;
  std::vector<std::string> changes;
  std::filesystem::path written = file;
  if (file.empty()) {
    written = files.written_case;
    for (const auto& [path, value] : run.changes) {
      try {
        overrideValue(inline_case, path, value);
      } catch (const InputError& e) {
        throw InputError({reference.file.string(), 0, "runs." + run.name + ".set." + path}, e.reason());
      }
    }
    writeOwnFile(written, schema::toText(inline_case) + "\n");
  } else {
    for (const auto& [path, value] : run.changes) changes.insert(changes.end(), {"--set", path + "=" + value});
  }
  claimFile(files.log);
  Process process{
      {options.binary, "run", written.string(), "--out", files.folder.string(), "--threads", "1", "--device", "cpu"},
      files.log,
      run.limit_s};
  if (goes_on) process.command.emplace_back("--resume");
  process.command.insert(process.command.end(), changes.begin(), changes.end());
  return process;
}

std::string commandOf(const Options& o) {
  std::string s = "gambeson verify";
  for (const std::string& f : o.filters) s += " --filter " + shellWord(f);
  if (o.quick) s += " --quick";
  if (!o.results.empty()) s += " --results " + shellWord(o.results.string());
  return s + fmt::format(" --dir {} --jobs {}", shellWord(o.dir.string()), o.jobs);
}

/// " (0.33 within 0.12)", " (at least 0.9)".
std::string goalText(const Result& r) {
  if (!r.reference) return "";
  if (r.tolerance) return fmt::format(" ({:.4g} within {:.3g})", *r.reference, *r.tolerance);
  return fmt::format(" ({} {:.4g})", r.note.starts_with("at least") ? "at least" : "at most", *r.reference);
}

/// "passed  sze_3_1  4 of 4 checks, largest deviation 12 % of its tolerance, 3 s"
void say(std::ostream& out, const Verified& v) {
  int gated = 0, good = 0, reported = 0, off = 0;
  std::string failures;
  std::string claims;
  for (const Result& r : v.results()) {
    if (!r.item.empty())
      claims += fmt::format("    {:<8} {:<7} {:<6} {}: {}{}\n", r.item, r.priority,
                            !r.measured ? "none"
                            : r.passed  ? "holds"
                            : r.gated   ? "FAILED"
                                        : "off",
                            r.quantity, r.measured ? fmt::format("{:.4g}", *r.measured) : r.note,
                            r.measured ? goalText(r) : "");
    if (!r.gated) {
      reported += !r.other_run;
      off += !r.other_run && !r.passed;
      continue;
    }
    ++gated;
    good += r.passed;
    // A run that failed is said once, not again with every number that it does not give.
    if (!r.item.empty()) continue;  // said among the claims
    if (r.passed || (!r.measured && r.note.starts_with("run ") && r.note.find(" failed: ") != std::string::npos))
      continue;
    failures += fmt::format("    {}: ", r.quantity);
    failures += r.measured ? fmt::format("{:.7g}", *r.measured) : std::string("no number");
    if (r.reference) failures += fmt::format(", reference {:.7g}", *r.reference);
    if (r.tolerance) failures += fmt::format(", tolerance {:.2g}", *r.tolerance);
    failures += (r.note.empty() ? "" : " (" + r.note + ")") + "\n";
  }
  const std::string checks =
      v.gates() ? fmt::format("{} of {} checks", good, gated)
                : fmt::format("gates nothing: {} of {} numbers are off, which is no failure here", off, reported);
  out << fmt::format("{}  {}  {}, {}\n{}",
                     !v.passed() ? "FAILED"
                     : v.gates() ? "passed"
                                 : "reported",
                     v.reference.id, checks, durationText(v.seconds), claims + failures)
      << std::flush;
}

/// A reference that this call does not run, where an earlier one left all its runs in the same folder (or where
/// --results says).
std::optional<Verified> keptReference(const Options& options, const std::string& id) {
  const Reference reference = readReference(options.dir / (id + ".json"));
  Options earlier = options;
  if (earlier.results.empty()) earlier.results = options.out;
  std::vector<Outcome> outcomes;
  for (const Run& run : reference.runs) {
    auto kept = keptRun(reference, run, earlier);
    if (!kept) return {};
    outcomes.push_back(std::move(*kept));
  }
  return assess(reference, outcomes);
}

/// Writes the page of each work that a reference of this call belongs to.
std::vector<PageLink> writeWorks(const std::vector<Work>& works, const std::vector<Verified>& all,
                                 const Options& options) {
  std::vector<PageLink> pages;
  for (const Work& work : works) {
    std::vector<Verified> done;
    std::vector<std::string> others;
    for (const std::string& id : referencesOf(work)) {
      const auto v = std::find_if(all.begin(), all.end(), [&](const Verified& x) { return x.reference.id == id; });
      if (v != all.end())
        done.push_back(*v);
      else
        others.push_back(id);
    }
    if (done.empty()) continue;
    for (const std::string& id : others)
      if (auto kept = keptReference(options, id)) done.push_back(std::move(*kept));
    pages.push_back({pageOf(work), work.title});
    writeOwnFile(options.out / pages.back().file, formatWork(work, done, commandOf(options)));
  }
  return pages;
}

}  // namespace

std::vector<Reference> chooseReferences(const Options& options) {
  std::error_code error;
  if (!std::filesystem::is_directory(options.dir, error))
    throw InputError({"command line", 0, "--dir"}, fmt::format("there is no folder {}", options.dir.string()));
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(options.dir))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  if (files.empty())
    throw InputError({"command line", 0, "--dir"}, fmt::format("{} holds no references", options.dir.string()));
  std::vector<Reference> chosen;
  for (const auto& file : files) {
    const std::string id = file.stem().string();
    const bool named = !options.filters.empty();
    bool wanted = options.filters.empty();
    for (const std::string& f : options.filters) wanted = wanted || fnmatch(f.c_str(), id.c_str(), 0) == 0;
    if (!wanted) continue;
    Reference r = readReference(file);
    if (r.on_demand && !named) continue;
    if (!options.quick || r.quick) chosen.push_back(std::move(r));
  }
  if (chosen.empty())
    throw InputError({"command line", 0, "--filter"},
                     fmt::format("no {}reference of {} fits", options.quick ? "quick " : "", options.dir.string()));
  return chosen;
}

std::string formatJson(const std::vector<Verified>& all) {
  using Json = nlohmann::ordered_json;
  Json list = Json::array();
  const auto number = [](const std::optional<double>& v) { return v && std::isfinite(*v) ? Json(*v) : Json(nullptr); };
  for (const Verified& v : all)
    for (const Result& r : v.results()) {
      Json j{{"id", r.id},
             {"source", r.source},
             {"item", r.item},
             {"priority", r.priority},
             {"quantity", r.quantity},
             {"unit", r.unit},
             {"measured", number(r.measured)},
             {"reference", number(r.reference)},
             {"tolerance", number(r.tolerance)},
             {"passed", r.passed},
             {"gated", r.gated},
             {"seconds", std::round(100 * r.seconds) / 100}};
      if (!r.why.empty()) j["why"] = r.why;
      if (!r.note.empty()) j["note"] = r.note;
      list.push_back(j);
    }
  return list.dump(1) + "\n";
}

int runVerify(const Options& chosen_options, std::ostream& out) {
  Options options = chosen_options;
  if (options.jobs < 1) options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Clock::time_point begin = Clock::now();
  const Signals signals;
  const std::vector<Reference> references = chooseReferences(options);
  const std::vector<Work> works = readWorks(options.dir);
  options.out = std::filesystem::absolute(options.out).lexically_normal();
  checkPath(options.out, "--out");

  // The long half starts first, and of each reference its last run, the finest mesh: so that no long run is left alone
  // at the end.
  std::vector<std::pair<std::size_t, std::size_t>> owner;  // reference and run of a job
  std::vector<std::vector<Outcome>> outcomes;
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < references.size(); ++i) {
    outcomes.emplace_back(references[i].runs.size());
    missing.push_back(0);
    for (std::size_t k = references[i].runs.size(); k-- > 0;) {
      if (auto kept = keptRun(references[i], references[i].runs[k], options)) {
        outcomes[i][k] = *kept;
        continue;
      }
      owner.emplace_back(i, k);
      ++missing[i];
    }
  }
  std::stable_partition(owner.begin(), owner.end(), [&](const auto& o) { return !references[o.first].quick; });
  checkFolder(references, works, owner, options);
  makeFolder(options.out);
  const FolderLock lock(options.out);
  checkFolder(references, works, owner, options);  // what another command has left meanwhile
  std::vector<Process> jobs;
  for (const auto& [i, k] : owner) jobs.push_back(processOf(references[i], references[i].runs[k], options));
  std::vector<std::optional<Verified>> verified(references.size());
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (missing[i] > 0) continue;
    verified[i] = assess(references[i], outcomes[i]);
    say(out, *verified[i]);
  }
  {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::size_t finished = 0;
    ProcessPool pool;
    pool.parallel = options.jobs;
    pool.environment = {"OMP_NUM_THREADS=1"};
    pool.ended = [&](std::size_t job, const Ended& e) {
      const auto [i, k] = owner[job];
      outcomes[i][k] = {e.why, e.seconds, filesOf(references[i], references[i].runs[k], options).folder};
      ++finished;
      if (terminal) std::fputs("\r\033[K", stderr);
      if (--missing[i] == 0) {
        verified[i] = assess(references[i], outcomes[i]);
        say(out, *verified[i]);
      }
      if (!terminal || finished == jobs.size()) return;
      const double left_s =
          secondsSince(begin) * (static_cast<double>(jobs.size()) / static_cast<double>(finished) - 1);
      std::fprintf(stderr, "%zu of %zu runs, about %s left", finished, jobs.size(), durationText(left_s).c_str());
    };
    if (!runProcesses(jobs, pool, signals, lock.descriptor()))
      throw RunError("stopped by a signal; nothing was compared. Runs that were done stay in " + options.out.string() +
                     ", and --results with that folder takes them");
  }
  std::vector<Verified> all;
  for (auto& v : verified) all.push_back(std::move(*v));
  const double wall_s = secondsSince(begin);
  writeOwnFile(options.out / kNumbers, formatJson(all));
  const std::vector<PageLink> pages = writeWorks(works, all, options);
  writeOwnFile(options.out / kPage, formatPage(all, commandOf(options), wall_s, pages));
  int passed = 0, gating = 0, failed = 0;
  std::string rest;
  for (const Verified& v : all) {
    failed += !v.passed();
    if (!v.gates()) rest += (rest.empty() ? "" : ", ") + v.reference.id;
    gating += v.gates();
    passed += v.gates() && v.passed();
  }
  out << fmt::format("{} of {} references passed{}, {}: {}\n", passed, gating,
                     rest.empty() ? "" : " (" + rest + " gate nothing: they report)", durationText(wall_s),
                     (options.out / kPage).string());
  return failed == 0 ? 0 : 1;
}

}  // namespace gambeson::verify
