#pragma once
/// Errors of CUDA as errors of ours.

#include <cuda_runtime.h>

#include <string>

#include "core/error.hpp"

namespace gambeson::gpu {

/// Throws RunError with what failed, the device's word for it and what to do, unless all is well.
inline void check(cudaError_t result, const std::string& what) {
  if (result == cudaSuccess) return;
  std::string advice;
  switch (result) {
    case cudaErrorMemoryAllocation:
      advice = "the device has too little free memory: close what else uses it, or take a smaller mesh";
      break;
    case cudaErrorNoDevice:
    case cudaErrorInsufficientDriver:
      advice = "a device and a driver for CUDA 12.4 or newer are needed: see nvidia-smi";
      break;
    case cudaErrorNoKernelImageForDevice:
      advice = "the program was built for devices of compute capability 8.0 and newer";
      break;
    default:
      advice = "the device may have been lost: start again from the last checkpoint";
  }
  throw RunError("CUDA: " + what + ": " + cudaGetErrorString(result) + " (" + cudaGetErrorName(result) + "); " +
                 advice);
}

}  // namespace gambeson::gpu
