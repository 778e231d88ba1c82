#include "gpu/device/gpu.hpp"

#include "gpu/device/device_error.hpp"

namespace gambeson::gpu {

std::optional<std::string> gpuName() {
  try {
    return findGpu().name;
  } catch (const DeviceError&) {
    return {};
  }
}

std::string kernelsVersion() { return GAMBESON_KERNELS_VERSION; }

}  // namespace gambeson::gpu
