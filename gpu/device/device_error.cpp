#include "gpu/device/device_error.hpp"

namespace gambeson::gpu {

std::string faultText(DeviceFault fault, const std::string& detail) {
  const std::string said = detail.empty() ? "" : " (" + detail + ")";
  switch (fault) {
    case DeviceFault::not_built:
      return "this program was built without CUDA" + said +
             "; allowed: a build with -DGAMBESON_CUDA=ON (nvcc 12.4 or newer), or \"reference\", which computes the "
             "same bits on the processor";
    case DeviceFault::no_driver:
      return "there is no driver of NVIDIA's" + said + "; allowed: one for CUDA 12.4 or newer, see nvidia-smi";
    case DeviceFault::old_driver:
      return "the GPU's driver is older than this program's CUDA" + said + "; allowed: a newer driver, see nvidia-smi";
    case DeviceFault::no_device:
      return "the driver finds no GPU" + said + "; allowed: one that nvidia-smi lists and CUDA_VISIBLE_DEVICES leaves";
    case DeviceFault::old_device:
      return "the GPU is too old" + said + "; allowed: compute capability 8.0 or newer";
    case DeviceFault::little_memory:
      return "the GPU has too little free memory" + said;
    case DeviceFault::device_lost:
      return "the GPU was lost" + said;
    case DeviceFault::out_of_memory:
      return "the GPU has no memory left" + said + ": close what else uses it, see nvidia-smi";
    case DeviceFault::kernel_limit:
      return "a kernel ran into its limit" + said;
  }
  return "the GPU failed" + said;
}

}  // namespace gambeson::gpu
