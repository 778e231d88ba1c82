#pragma once
/// The steps of several runs by one process, a thread each, for a device that processes would have to take turns on.

#include <filesystem>
#include <string>

#include "core/device_kind.hpp"

namespace gambeson {

struct TogetherOptions {
  std::filesystem::path list;   ///< what to run (cases/runs/together_list.hpp)
  std::filesystem::path ended;  ///< takes a line for each that begins or whose steps end
  DeviceKind device = DeviceKind::reference;
  int jobs = 1;     ///< at a time, as far as memory goes
  int threads = 1;  ///< of all together
};

/// Leaves the results to others. Exit status: 0 all have ended, well or not, and `ended` says how; 1 the device was
/// lost and took the others with it, which go on from their checkpoints in a process that is new.
int runTogether(const TogetherOptions& options);

}  // namespace gambeson
