/// Detail of gpu.hpp: what a build without CUDA has in its place.
#include "gpu/device/device_error.hpp"
#include "gpu/device/gpu.hpp"

namespace gambeson::gpu {

Gpu findGpu() { throw DeviceError(DeviceFault::not_built, ""); }
GpuMemory gpuMemory() { throw DeviceError(DeviceFault::not_built, ""); }

}  // namespace gambeson::gpu
