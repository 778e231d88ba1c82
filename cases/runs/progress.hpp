#pragma once
/// A line that says how far long work is and how long it still takes: on the terminal (quiet where the output is none),
/// and in a file that whoever started it in the background can look at.

#include <chrono>
#include <cstdio>
#include <filesystem>
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
  /// `file`: also holds the line, written anew every two seconds; empty: none does. What cannot be written is left out.
  explicit Progress(double total, double already_done = 0, std::FILE* stream = stderr, std::string unit = " s",
                    std::filesystem::path file = {});
  /// Ends the line. The file stays.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Redraws the terminal's at most five times a second.
  void update(double done, const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  bool isDue(Clock::time_point& last, std::chrono::milliseconds every, Clock::time_point now, double done) const;

  double total_, already_done_;
  std::FILE* stream_;
  std::string unit_;
  std::filesystem::path file_;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_ - std::chrono::hours(1), written_ = last_;
};

}  // namespace gambeson
