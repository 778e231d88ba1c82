/// Detail of gpu.hpp: as the driver tells it.
#include <cuda_runtime.h>

#include <fstream>
#include <sstream>

#include "gpu/device/cuda_error.hpp"
#include "gpu/device/gpu.hpp"

namespace gambeson::gpu {
namespace {

std::string cudaText(int version) {
  return "CUDA " + std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

/// "580.82.07", as its module says; empty where the system does not show it.
std::string driverVersion() {
  std::ifstream stream("/proc/driver/nvidia/version");
  std::string line, word;
  std::getline(stream, line);
  std::istringstream words(line);
  while (words >> word)
    if (word.find_first_not_of("0123456789.") == std::string::npos && word.find('.') != std::string::npos) return word;
  return "";
}

/// The first call to CUDA, which tells what there is.
void requireDevice() {
  int known = 0, needed = 0, devices = 0;
  cudaRuntimeGetVersion(&needed);
  const cudaError_t asked = cudaDriverGetVersion(&known);
  if (asked != cudaSuccess || known == 0) throw DeviceError(DeviceFault::no_driver, "");
  const cudaError_t result = cudaGetDeviceCount(&devices);
  if (result == cudaErrorInsufficientDriver)
    throw DeviceError(DeviceFault::old_driver,
                      "it knows " + cudaText(known) + ", this program has " + cudaText(needed));
  if (result == cudaErrorNoDevice || (result == cudaSuccess && devices == 0))
    throw DeviceError(DeviceFault::no_device, "");
  if (result != cudaSuccess) throw DeviceError(DeviceFault::no_device, cudaGetErrorString(result));
}

}  // namespace

Gpu findGpu() {
  requireDevice();
  Gpu gpu;
  int device = 0, known = 0, runtime = 0;
  cudaDeviceProp properties{};
  cudaError_t result = cudaGetDevice(&device);
  if (result == cudaSuccess) result = cudaGetDeviceProperties(&properties, device);
  if (result != cudaSuccess) throw DeviceError(DeviceFault::no_device, cudaGetErrorString(result));
  gpu.name = properties.name;
  if (properties.major < 8)
    throw DeviceError(DeviceFault::old_device, gpu.name + ", compute capability " + std::to_string(properties.major) +
                                                   "." + std::to_string(properties.minor));
  cudaDriverGetVersion(&known);
  cudaRuntimeGetVersion(&runtime);
  const std::string driver = driverVersion();
  gpu.driver = driver + (driver.empty() ? "" : ", ") + cudaText(known);
  gpu.runtime = cudaText(runtime);
  return gpu;
}

GpuMemory gpuMemory() {
  GpuMemory memory;
  const cudaError_t result = cudaMemGetInfo(&memory.free_bytes, &memory.all_bytes);
  check(result, "asking for its memory");
  return memory;
}

}  // namespace gambeson::gpu
