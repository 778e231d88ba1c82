/// Runs references as processes of the command itself, a pool of them, and writes what came of it.

#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <mutex>
#include <nlohmann/json.hpp>
#include <ostream>
#include <thread>

#include "cases/progress.hpp"
#include "cases/run_log.hpp"
#include "cases/schema.hpp"
#include "cases/verify.hpp"
#include "cases/verify_examples.hpp"
#include "core/error.hpp"
#include "core/io/atomic_file.hpp"

namespace gambeson::verify {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

/// The environment with one OpenMP thread, whatever the user has set.
std::vector<std::string> environmentOfRuns() {
  std::vector<std::string> all{"OMP_NUM_THREADS=1"};
  for (char** e = environ; *e; ++e)
    if (!std::string_view(*e).starts_with("OMP_NUM_THREADS=")) all.emplace_back(*e);
  return all;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> p;
  for (std::string& t : texts) p.push_back(t.data());
  p.push_back(nullptr);
  return p;
}

/// Starts a process whose output goes to `log`; throws RunError.
pid_t start(const Job& job) {
  std::vector<std::string> command = job.command, environment = environmentOfRuns();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, job.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  pid_t pid = -1;
  const int error =
      posix_spawn(&pid, command[0].c_str(), &actions, nullptr, pointers(command).data(), pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw RunError(fmt::format("{} cannot be started: {}", command[0], std::strerror(error)));
  return pid;
}

Outcome runJob(const Job& job) {
  const Clock::time_point begin = Clock::now();
  Outcome o{"", 0, job.folder};
  try {
    const pid_t pid = start(job);
    int status = 0;
    bool late = false;
    for (pid_t got = 0; got == 0;) {
      got = waitpid(pid, &status, WNOHANG);
      if (got < 0) throw RunError(fmt::format("the run was lost: {}", std::strerror(errno)));
      if (got > 0) break;
      if (secondsSince(begin) > job.limit_s) {
        late = true;
        kill(pid, SIGKILL);
        waitpid(pid, &status, 0);
        break;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    const std::string said = lastMessage(job.log);
    if (late)
      o.why = fmt::format("stopped after {:.0f} s, its limit", job.limit_s);
    else if (WIFSIGNALED(status))
      o.why = fmt::format("ended by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) != 0)
      o.why = said.empty() ? fmt::format("exit status {}, without a message", WEXITSTATUS(status)) : said;
  } catch (const std::exception& e) {
    o.why = e.what();
  }
  o.seconds = secondsSince(begin);
  return o;
}

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

/// The job of a run. A case that is written in the reference becomes a file beside the results, values set, so that it
/// can be run again by hand. A run of the same case that was interrupted there goes on where the options ask for it.
Job jobOf(const Reference& reference, const Run& run, const Options& options) {
  const std::filesystem::path base = options.out / reference.id, folder = base / run.name;
  std::error_code error;
  const bool goes_on = !options.results.empty() && interruptedRun(folder, caseHash(reference, run));
  if (!goes_on) std::filesystem::remove_all(folder, error);
  std::filesystem::create_directories(folder, error);
  if (error) throw RunError(fmt::format("{}: {}", folder.string(), error.message()));
  const bool own = !run.file.empty() || run.inline_case.type != JsonNode::Type::null;
  const std::filesystem::path& file = own ? run.file : reference.case_file;
  JsonNode inline_case = own ? run.inline_case : reference.inline_case;
  std::vector<std::string> changes;
  std::filesystem::path written = file;
  if (file.empty()) {
    written = base / (run.name + ".json");
    for (const auto& [path, value] : run.changes) {
      try {
        overrideValue(inline_case, path, value);
      } catch (const InputError& e) {
        throw InputError({reference.file.string(), 0, "runs." + run.name + ".set." + path}, e.reason());
      }
    }
    writeFileAtomically(written, schema::toText(inline_case) + "\n");
  } else {
    for (const auto& [path, value] : run.changes) changes.insert(changes.end(), {"--set", path + "=" + value});
  }
  Job job{{options.binary, "run", written.string(), "--out", folder.string(), "--threads", "1"},
          base / (run.name + ".log"),
          folder,
          run.limit_s};
  if (goes_on) job.command.emplace_back("--resume");
  job.command.insert(job.command.end(), changes.begin(), changes.end());
  return job;
}

std::string commandOf(const Options& o) {
  std::string s = "gambeson verify";
  for (const std::string& f : o.filters) s += " --filter '" + f + "'";
  if (o.quick) s += " --quick";
  if (!o.results.empty()) s += " --results " + o.results.string();
  return s + fmt::format(" --dir {} --jobs {}", o.dir.string(), o.jobs);
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
    pages.push_back({work.id + ".html", work.title});
    writeFileAtomically(options.out / pages.back().file, formatWork(work, done, commandOf(options)));
  }
  return pages;
}

}  // namespace

std::vector<Outcome> runJobs(const std::vector<Job>& jobs, int parallel,
                             const std::function<void(std::size_t, const Outcome&)>& done) {
  std::vector<Outcome> outcomes(jobs.size());
  std::atomic<std::size_t> next{0};
  std::mutex reporting;
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size(); i = next++) {
      outcomes[i] = runJob(jobs[i]);
      const std::lock_guard lock(reporting);
      done(i, outcomes[i]);
    }
  };
  std::vector<std::jthread> pool;
  for (int k = 0; k < parallel && static_cast<std::size_t>(k) < jobs.size(); ++k) pool.emplace_back(work);
  pool.clear();
  return outcomes;
}

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
  const std::vector<Reference> references = chooseReferences(options);
  const std::vector<Work> works = readWorks(options.dir);
  std::error_code error;
  std::filesystem::create_directories(options.out, error);
  if (error) throw RunError(fmt::format("{}: {}", options.out.string(), error.message()));
  options.out = std::filesystem::absolute(options.out);

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
  std::vector<Job> jobs;
  for (const auto& [i, k] : owner) jobs.push_back(jobOf(references[i], references[i].runs[k], options));
  std::vector<std::optional<Verified>> verified(references.size());
  for (std::size_t i = 0; i < references.size(); ++i) {
    if (missing[i] > 0) continue;
    verified[i] = assess(references[i], outcomes[i]);
    say(out, *verified[i]);
  }
  {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::size_t finished = 0;
    runJobs(jobs, options.jobs, [&](std::size_t job, const Outcome& o) {
      const auto [i, k] = owner[job];
      outcomes[i][k] = o;
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
    });
  }
  std::vector<Verified> all;
  for (auto& v : verified) all.push_back(std::move(*v));
  const double wall_s = secondsSince(begin);
  writeFileAtomically(options.out / "verify.json", formatJson(all));
  const std::vector<PageLink> pages = writeWorks(works, all, options);
  writeFileAtomically(options.out / "verify.html", formatPage(all, commandOf(options), wall_s, pages));
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
                     (options.out / "verify.html").string());
  return failed == 0 ? 0 : 1;
}

}  // namespace gambeson::verify
