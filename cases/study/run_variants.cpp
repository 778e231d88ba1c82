#include "cases/study/run_variants.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ostream>

#include "cases/kinds/any_case.hpp"
#include "cases/runs/progress.hpp"
#include "cases/runs/results_folder.hpp"
#include "cases/study/files.hpp"
#include "cases/study/time_left.hpp"
#include "cases/study/together.hpp"
#include "cases/wear/case/references.hpp"
#include "cases/wear/results/results.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "core/io/recording.hpp"

namespace gambeson::study {
namespace {

/// Checkpoints that a whole run leaves, about; 0 where that is not known (structures).
double checkpointsOf(const AnyCase& any) {
  const auto* c = std::get_if<Case>(&any);
  if (!c) return 0;
  const double dressing = (c->dressing.projecting ? c->dressing.projecting->grow_s : 0) + c->dressing.settle_s;
  return 1 + (dressing + plannedDuration(*c)) / c->output.checkpoint_s;
}

/// A folder of a variant that holds anything but a run, finished, cut or only begun, is not ours to fill.
void refuseForeign(const std::filesystem::path& folder, const Variant& v) {
  std::error_code error;
  if (!std::filesystem::exists(folder, error) || holdsRecording(folder) || holdsOnlyABegunRun(folder)) return;
  throw InputError({"command line", 0, "--out"},
                   fmt::format("{} is in the way of the variant {}: it holds no run; allowed: a new folder, or that "
                               "of an earlier study",
                               folder.string(), v.label));
}

std::vector<std::string> commandOf(const Variant& v, const Options& o, int threads, Stand stand) {
  std::vector<std::string> command{o.binary,
                                   "run",
                                   caseFile(o.out, v).string(),
                                   "--out",
                                   (o.out / v.folder).string(),
                                   "--threads",
                                   std::to_string(threads),
                                   "--device",
                                   wordOf(o.device)};
  if (stand == Stand::interrupted && goesOn(v)) command.push_back("--resume");
  return command;
}

/// One line for all, and on what is no terminal a line for each variant that ends.
class Line {
 public:
  explicit Line(int parallel) : parallel_(parallel), terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Line() { clear(); }
  void clear() {
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
  }
  void update(const std::vector<RunTime>& runs) {
    if (!terminal_) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < std::chrono::milliseconds(200)) return;
    last_ = now;
    std::size_t done = 0, running = 0;
    for (const RunTime& r : runs) done += r.done, running += !r.done && r.running_s >= 0;
    const std::optional<double> left_s = timeLeft(runs, parallel_);
    const std::string left = left_s ? fmt::format(", {} left", durationText(*left_s)) : "";
    std::fprintf(stderr, "\r\033[K%zu of %zu variants done, %zu running%s", done, runs.size(), running, left.c_str());
    std::fflush(stderr);
    drawn_ = true;
  }

 private:
  int parallel_;
  bool terminal_, drawn_ = false;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// What a run that is done took; nothing where another number of threads did it, or only its end is known.
std::optional<double> tookBefore(const std::filesystem::path& folder, int threads) {
  try {
    const RunFacts f = readRunFacts(folder);
    return f.wall_s > 0 && f.threads == threads && !f.resumed ? std::optional(f.wall_s) : std::nullopt;
  } catch (const InputError&) {
    return {};
  }
}

}  // namespace

std::filesystem::path caseFile(const std::filesystem::path& out, const Variant& v) {
  return out / files::cases / (v.folder + ".json");
}

std::filesystem::path logFile(const std::filesystem::path& out, const Variant& v) {
  return out / files::logs / (v.folder + ".log");
}

void writeVariant(const std::filesystem::path& out, const Variant& v) {
  writeOwnFile(caseFile(out, v), std::visit([](const auto& c) { return writeCase(c); }, v.definition));
}

std::vector<Stand> standsOf(const Study& s, const Options& o) {
  std::vector<Stand> stands;
  for (const Variant& v : s.variants)
    stands.push_back(o.resume || o.compare ? standOf(o.out / v.folder, v.identity, o.device, o.slurm || o.compare)
                                           : Stand::fresh);
  return stands;
}

void checkFolder(const Study& s, const Options& o, const std::vector<Stand>& stands) {
  std::error_code error;
  if (!std::filesystem::exists(o.out, error)) return;
  if (!std::filesystem::is_directory(o.out, error))
    throw InputError({"command line", 0, "--out"}, o.out.string() + " is not a folder");
  Paths inputs{s.file};
  for (const Variant& v : s.variants) std::visit([&](const auto& c) { inputs.push_back(c.file); }, v.definition);
  std::sort(inputs.begin(), inputs.end());
  inputs.erase(std::unique(inputs.begin(), inputs.end()), inputs.end());
  // What compares leaves the scripts as they are, also those that somebody changed.
  const auto kept = [&](std::string_view name) {
    return o.compare && (name == files::script || name == files::compare_script || name == files::submit);
  };
  for (const std::string_view name : files::written)
    if (!kept(name)) requireFreeOf(o.out / name, inputs, "--out");
  for (const std::string_view name : files::folders) requireFolder(o.out / name);
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    requireFolder(o.out / v.folder);
    requireFreeOf(caseFile(o.out, v), inputs, "--out");
    requireFreeOf(logFile(o.out, v), inputs, "--out");
    for (std::size_t w = 0; w < s.pictures.size(); ++w)
      requireFreeOf(o.out / files::pictures / files::pictureName(v.folder, w), inputs, "--out");
    if (stands[i] == Stand::done) continue;
    checkResultsFolder(o.out / v.folder, inputsOf(v.definition), stands[i] == Stand::interrupted);
    refuseForeign(o.out / v.folder, v);
  }
}

std::vector<Outcome> runVariants(const Study& s, const Options& o, const std::vector<Stand>& stands,
                                 const Signals& signals, int lock, std::ostream& out) {
  std::vector<Outcome> outcomes(s.variants.size());
  std::vector<std::size_t> waiting;
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Variant& v = s.variants[i];
    writeVariant(o.out, v);
    if (stands[i] == Stand::done) {
      outcomes[i].good = true;
    } else {
      waiting.push_back(i);
      claimFile(logFile(o.out, v));
    }
  }
  const int threads = o.threads;
  // Runs on a GPU wait for it most of the time; what waits for its memory has been built already.
  constexpr int most_on_gpu = 16;
  const int usual = o.device == DeviceKind::cuda ? most_on_gpu : threads;
  const int parallel = std::clamp(o.jobs > 0 ? o.jobs : usual, 1, std::max(1, static_cast<int>(waiting.size())));
  const int each = std::max(1, threads / parallel);
  // Those interrupted first: they are nearest to their end.
  std::stable_partition(waiting.begin(), waiting.end(), [&](std::size_t i) { return stands[i] == Stand::interrupted; });
  std::vector<Process> jobs;
  std::vector<double> checkpoints;
  for (const std::size_t i : waiting) {
    jobs.push_back({commandOf(s.variants[i], o, each, stands[i]), logFile(o.out, s.variants[i])});
    checkpoints.push_back(checkpointsOf(s.variants[i].definition));
  }
  if (waiting.size() < s.variants.size())
    out << fmt::format("{} of {} variants are done already\n", s.variants.size() - waiting.size(), s.variants.size())
        << std::flush;
  bool whole = true;
  {
    Line line(parallel);
    std::vector<RunTime> times;
    for (std::size_t i = 0; i < s.variants.size(); ++i) {
      const bool done = stands[i] == Stand::done;
      times.push_back(
          {s.variants[i].levels, done, done ? tookBefore(o.out / s.variants[i].folder, each) : std::nullopt});
    }
    std::vector<std::chrono::steady_clock::time_point> started(s.variants.size());
    ProcessPool pool;
    pool.parallel = parallel;
    pool.ended = [&](std::size_t job, const Ended& e) {
      const Variant& v = s.variants[waiting[job]];
      outcomes[waiting[job]] = {e.good, e.why};
      RunTime& time = times[waiting[job]];
      time.done = true;
      // What went on from a checkpoint, or failed, does not tell how long a whole one takes.
      if (e.good && stands[waiting[job]] == Stand::fresh) time.took_s = e.seconds;
      line.clear();
      out << (e.good ? fmt::format("done    {}  {}\n", v.folder, durationText(e.seconds))
                     : fmt::format("FAILED  {}  {}\n", v.folder, e.why))
          << std::flush;
    };
    pool.watch = [&](const std::vector<std::size_t>& running) {
      const auto now = std::chrono::steady_clock::now();
      for (const std::size_t job : running) {
        RunTime& time = times[waiting[job]];
        auto& start = started[waiting[job]];
        const double n = checkpoints[job];
        const double part = n > 0 ? std::min(1.0, closedSegments(o.out / s.variants[waiting[job]].folder) / n) : 0;
        if (time.running_s < 0) start = now, time.from = part;
        time.running_s = std::chrono::duration<double>(now - start).count();
        time.part = part;
      }
      line.update(times);
    };
    if (o.device == DeviceKind::cpu) {
      whole = runProcesses(jobs, pool, signals, lock);
    } else {
      std::vector<TogetherRun> runs;
      for (const std::size_t i : waiting)
        runs.push_back({caseFile(o.out, s.variants[i]), o.out / s.variants[i].folder, logFile(o.out, s.variants[i]),
                        stands[i] == Stand::interrupted});
      whole = runInOneProcess(std::move(runs), {o.binary, o.out, o.device, threads}, pool, signals, lock);
    }
  }
  if (!whole)
    throw RunError(
        fmt::format("stopped by a signal; what is done stands in {}, and --resume goes on from there", o.out.string()));
  return outcomes;
}

}  // namespace gambeson::study
