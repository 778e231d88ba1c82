#pragma once
/// Forces on devices, of gambeson_gpu_check.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace gambeson::gpu {

struct ForceCheck {
  int different = 0;  ///< forces that two devices, two ways or core do not have alike
  std::vector<std::pair<std::string, std::uint64_t>> hashes;  ///< of the scenes of the manifest
};

/// `large`: a sheet of a million control points too. Prints what it finds, and medians of so many passes.
ForceCheck checkForces(bool cuda, int passes, bool large);

}  // namespace gambeson::gpu
