#pragma once
/// Runs of cases as processes of the command itself, several at a time.

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace gambeson {

struct Process {
  std::vector<std::string> command;                          ///< the first is the program
  std::filesystem::path log;                                 ///< takes what it says
  double limit_s = std::numeric_limits<double>::infinity();  ///< it is stopped when it takes longer
  bool goes_on = false;                                      ///< with the log, which others began
};

struct Ended {
  bool good = false;
  std::string why;  ///< where it is not good
  double seconds = 0;
};

struct ProcessPool {
  int parallel = 1;
  /// "NAME=value" that stand in place of what the environment has of that name.
  std::vector<std::string> environment;
  /// Called after each process, in the order in which they end.
  std::function<void(std::size_t process, const Ended&)> ended;
  /// Called about twenty times a second, with the processes that run.
  std::function<void(const std::vector<std::size_t>& running)> watch;
  /// Asked before any process starts, and after each call of `watch`: what else is to run, after all that there is.
  std::function<std::vector<Process>()> more;
};

/// SIGINT, SIGTERM and SIGHUP are held back while this lives, and told by a descriptor instead: a pool ends its
/// processes before the command ends.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  /// Waits up to `ms`, or until a child ends; the signal that came, or 0.
  int wait(int ms) const;
  /// In a process that was made: signals come again.
  void release() const;

 private:
  struct State;
  State* state_;
};

/// Runs all; false where a signal stopped it, all processes ended by then (SIGTERM, SIGKILL where that does not help).
/// A process dies with this one, however that ends. What they inherit: descriptor `lock`, where it is not negative.
bool runProcesses(std::vector<Process> processes, const ProcessPool& pool, const Signals& signals, int lock);

}  // namespace gambeson
