#pragma once
/// Runs of a device: one process of the command makes the steps of all side by side, since processes would take turns
/// on the device, and the results of each are made by a process of its own once its steps are over.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/runs/process_pool.hpp"
#include "cases/runs/together_list.hpp"
#include "core/device_kind.hpp"

namespace gambeson::study {

struct OneProcess {
  std::string binary;
  std::filesystem::path out;  ///< folder of the study, for the files between the processes
  DeviceKind device = DeviceKind::reference;
  int threads = 1;  ///< of all runs together, and of all results that are made at a time
};

/// As runProcesses, with `pool.parallel` runs at a time. Where the process dies (the device was lost), what had not
/// ended goes on from its checkpoints in a new one.
bool runInOneProcess(std::vector<TogetherRun> runs, const OneProcess& how, const ProcessPool& pool,
                     const Signals& signals, int lock);

}  // namespace gambeson::study
