#include "cases/study/together.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "core/io/own_file.hpp"
#include "core/io/recording.hpp"

namespace gambeson::study {
namespace {

/// Of the files between the processes; a variant cannot be called so.
constexpr const char *kList = ".together.json", *kEnded = ".together.ended", *kLog = ".together.log";

/// What the process has told so far; lines that are not whole yet come later.
class Events {
 public:
  explicit Events(std::filesystem::path file) : file_(std::move(file)) {}

  std::vector<TogetherEvent> next() {
    std::vector<TogetherEvent> events;
    std::ifstream stream(file_, std::ios::binary);
    stream.seekg(at_);
    for (std::string line; std::getline(stream, line) && !stream.eof();
         at_ += static_cast<std::streamoff>(line.size()) + 1)
      if (auto event = readEvent(line)) events.push_back(std::move(*event));
    return events;
  }

 private:
  std::filesystem::path file_;
  std::streamoff at_ = 0;
};

/// The process that makes the steps of all runs, and one for the results of each run whose steps are made.
class Variants {
 public:
  Variants(std::vector<TogetherRun> runs, const OneProcess& how, const ProcessPool& pool)
      : runs_(std::move(runs)), how_(how), pool_(pool), stages_(runs_.size()), seconds_(runs_.size(), 0) {}

  /// Results that are made at a time.
  int writers() const { return std::clamp(pool_.parallel, 1, how_.threads); }

  /// What can be started by now.
  std::vector<Process> more() {
    std::vector<Process> processes;
    if (!stepping_)
      if (std::vector<std::size_t> left = runsAt(Stage::waiting); !left.empty()) {
        processes.push_back(steps(std::move(left)));
        of_process_.push_back(kSteps);
      }
    for (const std::size_t run : runsAt(Stage::stepped)) {
      if (static_cast<int>(runsAt(Stage::written).size()) == writers()) break;
      stages_[run] = Stage::written;
      processes.push_back(results(run));
      of_process_.push_back(run);
    }
    return processes;
  }

  void ended(std::size_t process, const Ended& e) {
    const std::size_t run = of_process_[process];
    if (run == kSteps) return stepsEnded(e);
    over(run, {e.good, e.why, seconds_[run] + e.seconds});
  }

  void watch() {
    if (stepping_) listen();
    std::vector<std::size_t> running;
    for (std::size_t run = 0; run < runs_.size(); ++run)
      if (stages_[run] != Stage::waiting && stages_[run] != Stage::over) running.push_back(run);
    if (pool_.watch) pool_.watch(running);
  }

 private:
  enum class Stage { waiting, stepping, stepped, written, over };

  std::vector<std::size_t> runsAt(Stage stage) const {
    std::vector<std::size_t> runs;
    for (std::size_t run = 0; run < runs_.size(); ++run)
      if (stages_[run] == stage) runs.push_back(run);
    return runs;
  }

  void over(std::size_t run, const Ended& e) {
    stages_[run] = Stage::over;
    pool_.ended(run, e);
  }

  Process steps(std::vector<std::size_t> left) {
    std::vector<TogetherRun> list;
    for (const std::size_t run : left) list.push_back(runs_[run]);
    writeOwnFile(how_.out / kList, togetherList(list));
    writeOwnFile(how_.out / kEnded, "");
    claimFile(how_.out / kEnded);
    claimFile(how_.out / kLog);
    events_.emplace(how_.out / kEnded);
    listed_ = std::move(left);
    stepping_ = true;
    return {{how_.binary, "together", (how_.out / kList).string(), "--ended", (how_.out / kEnded).string(), "--device",
             wordOf(how_.device), "--jobs", std::to_string(pool_.parallel), "--threads", std::to_string(how_.threads)},
            how_.out / kLog};
  }

  Process results(std::size_t run) const {
    Process process{{how_.binary, "results", runs_[run].out.string(), "--threads",
                     std::to_string(std::max(1, how_.threads / writers()))},
                    runs_[run].log};
    process.goes_on = true;
    return process;
  }

  void listen() {
    for (const TogetherEvent& e : events_->next()) {
      if (e.run >= listed_.size()) continue;
      const std::size_t run = listed_[e.run];
      if (stages_[run] != Stage::waiting && stages_[run] != Stage::stepping) continue;
      stages_[run] = e.ended ? Stage::stepped : Stage::stepping;
      seconds_[run] = e.seconds;
      if (e.ended && !e.good) over(run, {false, e.why, e.seconds});
    }
  }

  void stepsEnded(const Ended& e) {
    listen();
    stepping_ = false;
    std::vector<std::size_t> rest;
    for (const std::size_t run : listed_)
      if (stages_[run] == Stage::waiting || stages_[run] == Stage::stepping) rest.push_back(run);
    // A process that dies without a word would die again.
    if (rest.size() == listed_.size()) {
      for (const std::size_t run : rest) over(run, {false, e.good ? "the run was lost" : e.why, e.seconds});
      rest.clear();
    }
    for (const std::size_t run : rest) {
      stages_[run] = Stage::waiting;
      runs_[run].resume = closedSegments(runs_[run].out) > 0;
    }
  }

  static constexpr std::size_t kSteps = std::size_t(-1);  ///< in place of a run: the process of the steps

  std::vector<TogetherRun> runs_;
  const OneProcess& how_;
  const ProcessPool& pool_;
  std::vector<Stage> stages_;
  std::vector<double> seconds_;          ///< that the steps of each took
  std::vector<std::size_t> of_process_;  ///< the run whose results each process makes
  std::vector<std::size_t> listed_;      ///< runs of the process of the steps
  std::optional<Events> events_;         ///< what it tells
  bool stepping_ = false;
};

}  // namespace

bool runInOneProcess(std::vector<TogetherRun> runs, const OneProcess& how, const ProcessPool& pool,
                     const Signals& signals, int lock) {
  Variants variants(std::move(runs), how, pool);
  ProcessPool all;
  all.parallel = 1 + variants.writers();
  all.environment = pool.environment;
  all.more = [&] { return variants.more(); };
  all.ended = [&](std::size_t process, const Ended& e) { variants.ended(process, e); };
  all.watch = [&](const std::vector<std::size_t>&) { variants.watch(); };
  if (!runProcesses({}, all, signals, lock)) return false;
  for (const char* file : {kList, kEnded}) removeOwnFile(how.out / file);
  return true;
}

}  // namespace gambeson::study
