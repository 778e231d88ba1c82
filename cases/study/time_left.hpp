#pragma once
/// How long the rest of a study takes, from what its runs take.

#include <optional>
#include <span>
#include <vector>

namespace gambeson::study {

/// One run of a study, as far as it is.
struct RunTime {
  std::vector<int> levels;         ///< of each axis
  bool done = false;               ///< or failed: nothing is left of it
  std::optional<double> took_s{};  ///< of one that is done, with as many threads as the others have
  double running_s = -1;           ///< since it started; negative: it waits
  double from = 0, part = 0;       ///< parts of it that were recorded when it went on, and are now
};

/// Seconds until all are done, `parallel` at a time, in their order. One under way goes on as fast as it went; one that
/// waits takes what those took, or seem to take, that differ from it on the fewest axes. Nothing where no run tells.
std::optional<double> timeLeft(std::span<const RunTime> runs, int parallel);

}  // namespace gambeson::study
