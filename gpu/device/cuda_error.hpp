#pragma once
/// Errors of CUDA as errors of ours.

#include <cuda_runtime.h>

#include <string>

#include "gpu/device/device_error.hpp"

namespace gambeson::gpu {

/// Which fault it is. After what is not told apart here no call of this process works any more.
inline DeviceFault faultOf(cudaError_t result) {
  switch (result) {
    case cudaErrorMemoryAllocation:
      return DeviceFault::out_of_memory;
    case cudaErrorNoDevice:
      return DeviceFault::no_device;
    case cudaErrorInsufficientDriver:
      return DeviceFault::old_driver;
    case cudaErrorNoKernelImageForDevice:
      return DeviceFault::old_device;
    case cudaErrorLaunchTimeout:
    case cudaErrorLaunchOutOfResources:
      return DeviceFault::kernel_limit;
    default:
      return DeviceFault::device_lost;
  }
}

/// Throws DeviceError with what failed and the device's word for it, unless all is well.
inline void check(cudaError_t result, const std::string& what) {
  if (result == cudaSuccess) return;
  throw DeviceError(faultOf(result),
                    "CUDA: " + what + ": " + cudaGetErrorString(result) + ", " + cudaGetErrorName(result));
}

}  // namespace gambeson::gpu
