#pragma once
/// Variants run as processes of the command itself, several at a time.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace gambeson::study {

struct Job {
  std::vector<std::string> command;  ///< the first is the program
  std::filesystem::path log;         ///< takes what it says
};

struct Ended {
  bool good = false;
  std::string why;  ///< where it is not good
  double seconds = 0;
};

struct Pool {
  int parallel = 1;
  /// After each job, in the order in which they end.
  std::function<void(std::size_t job, const Ended&)> ended;
  /// About five times a second, with the jobs that run.
  std::function<void(const std::vector<std::size_t>& running)> watch;
};

/// SIGINT, SIGTERM and SIGHUP are held back while this lives, and told by the descriptor instead: a pool ends its jobs
/// before the command ends.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
  /// Waits up to `ms`; the signal that came, or 0.
  int wait(int ms) const;
  /// In a process that was made: signals come again.
  void release() const;

 private:
  struct State;
  State* state_;
};

/// Runs all jobs; false where a signal stopped it, all jobs ended by then (SIGTERM, SIGKILL where that does not help).
/// A job dies with this process, however that ends. What jobs inherit: descriptor `lock`, where it is not negative.
bool runJobs(const std::vector<Job>& jobs, const Pool& pool, const Signals& signals, int lock);

/// A folder that one study at a time may write. Jobs inherit the descriptor: while one of them lives, whatever became
/// of its study, the folder is taken.
class FolderLock {
 public:
  /// Waits some seconds for jobs that are just dying; throws InputError ("command line", "--out") where it is taken.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

}  // namespace gambeson::study
