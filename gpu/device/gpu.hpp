#pragma once
/// The GPU of this machine, before anything runs on it.

#include <cstddef>
#include <optional>
#include <string>

namespace gambeson::gpu {

struct Gpu {
  std::string name;     ///< "NVIDIA H100 80GB HBM3"
  std::string driver;   ///< "580.82.07, CUDA 13.0": its version where the system tells it, and the newest CUDA it knows
  std::string runtime;  ///< "CUDA 13.0", which this program has in it
};

/// Throws DeviceError where steps cannot run on it.
Gpu findGpu();
/// Its name, if this program could use one; asks for no memory of it.
std::optional<std::string> gpuName();

struct GpuMemory {
  std::size_t free_bytes = 0, all_bytes = 0;
};
/// Throws DeviceError.
GpuMemory gpuMemory();

/// What the kernels find on the scenes of gpu/manifest.json, as a hash: kernels that find anything else have another.
std::string kernelsVersion();

}  // namespace gambeson::gpu
