#pragma once
/// What may be wrong with a GPU, before a run and on its way.

#include <string>

#include "core/error.hpp"

namespace gambeson::gpu {

enum class DeviceFault {
  // Before anything runs.
  not_built,      ///< the program has no CUDA
  no_driver,      ///< of NVIDIA's
  old_driver,     ///< than this program's CUDA
  no_device,      ///< that the driver knows of
  old_device,     ///< compute capability below 8.0
  little_memory,  ///< free for what the steps need
  // On the way.
  device_lost,
  out_of_memory,
  kernel_limit,  ///< a kernel ran into a limit: its time, a list that cannot grow
};

/// What is wrong and what to do about it, as a clause without a full stop. `detail`: what the device says of it; may be
/// empty.
std::string faultText(DeviceFault fault, const std::string& detail);

class DeviceError : public RunError {
 public:
  DeviceError(DeviceFault fault, const std::string& detail) : RunError(faultText(fault, detail)), fault_(fault) {}
  DeviceFault fault() const { return fault_; }

 private:
  DeviceFault fault_;
};

}  // namespace gambeson::gpu
