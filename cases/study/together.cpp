#include "cases/study/together.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

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

}  // namespace

bool runInOneProcess(std::vector<TogetherRun> runs, const OneProcess& how, const ProcessPool& pool,
                     const Signals& signals, int lock) {
  std::vector<std::size_t> left(runs.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  while (!left.empty()) {
    std::vector<TogetherRun> now;
    for (const std::size_t i : left) now.push_back(runs[i]);
    writeOwnFile(how.out / kList, togetherList(now));
    writeOwnFile(how.out / kEnded, "");
    claimFile(how.out / kEnded);
    claimFile(how.out / kLog);
    const Process process{
        {how.binary, "together", (how.out / kList).string(), "--ended", (how.out / kEnded).string(), "--device",
         wordOf(how.device), "--jobs", std::to_string(pool.parallel), "--threads", std::to_string(how.threads)},
        how.out / kLog};
    Events events(how.out / kEnded);
    std::vector<char> begun(now.size(), false), over(now.size(), false);
    const auto listen = [&] {
      for (const TogetherEvent& e : events.next()) {
        if (e.run >= now.size() || over[e.run]) continue;
        begun[e.run] = true;
        if (!e.ended) continue;
        over[e.run] = true;
        pool.ended(left[e.run], {e.good, e.why, e.seconds});
      }
    };
    ProcessPool one;
    one.environment = pool.environment;
    one.watch = [&](const std::vector<std::size_t>&) {
      listen();
      std::vector<std::size_t> running;
      for (std::size_t k = 0; k < now.size(); ++k)
        if (begun[k] && !over[k]) running.push_back(left[k]);
      if (pool.watch) pool.watch(running);
    };
    Ended end;
    one.ended = [&](std::size_t, const Ended& e) { end = e; };
    if (!runProcesses({process}, one, signals, lock)) return false;
    listen();
    std::vector<std::size_t> rest;
    for (std::size_t k = 0; k < now.size(); ++k)
      if (!over[k]) rest.push_back(left[k]);
    // A process that dies without a word would die again.
    if (rest.size() == left.size()) {
      for (const std::size_t i : rest) pool.ended(i, {false, end.good ? "the run was lost" : end.why, end.seconds});
      rest.clear();
    }
    for (const std::size_t i : rest) runs[i].resume = closedSegments(runs[i].out) > 0;
    left = std::move(rest);
  }
  for (const char* file : {kList, kEnded}) removeOwnFile(how.out / file);
  return true;
}

}  // namespace gambeson::study
