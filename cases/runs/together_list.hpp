#pragma once
/// What a process that makes the steps of several runs is told, and what it tells: the files between `study` and such a
/// process.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace gambeson {

struct TogetherRun {
  std::filesystem::path case_file, out, log;
  bool resume = false;
};

/// As JSON.
std::string togetherList(const std::vector<TogetherRun>& runs);
/// Throws InputError.
std::vector<TogetherRun> readTogetherList(const std::filesystem::path& file);

/// One line of what is told, by the number of the run in the list.
struct TogetherEvent {
  std::size_t run = 0;
  bool ended = false;  ///< its steps, and where it is good all is recorded; else it begins
  bool good = false;
  std::string why;  ///< where it is not good
  double seconds = 0;
};
std::string eventLine(const TogetherEvent& event);
/// Nothing where the line is none, or not whole yet.
std::optional<TogetherEvent> readEvent(const std::string& line);

}  // namespace gambeson
