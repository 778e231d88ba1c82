#pragma once
/// A line on the terminal that says how far long work is and how long it still takes. Quiet where the output is not a
/// terminal.

#include <chrono>
#include <cstdio>
#include <string>

namespace gambeson {

/// "walking  42 %  1.13 of 2.70 s  3 min 10 s left": `done` of `total` simulated seconds, of which `already_done` came
/// from an interrupted run, after elapsed_s seconds of work. The time left supposes that the rest goes as fast as what
/// was done since; it is left out during the first two seconds. `unit` of done and total, with a blank before it.
std::string progressLine(const std::string& what, double done, double total, double already_done, double elapsed_s,
                         const std::string& unit = " s");

/// "3 min 10 s", "1 h 05 min", "12 s"
std::string durationText(double seconds);

class Progress {
 public:
  explicit Progress(double total, double already_done = 0, std::FILE* stream = stderr, std::string unit = " s");
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Redraws at most five times a second.
  void update(double done, const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  double total_, already_done_;
  std::FILE* stream_;
  std::string unit_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_ - std::chrono::seconds(1);
};

}  // namespace gambeson
