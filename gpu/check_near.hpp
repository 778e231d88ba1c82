#pragma once
/// What is near: CUDA against the reference and core, and times. Part of gambeson_gpu_check.

#include <string>

namespace gambeson::gpu {

struct NearCheck {
  std::string armour;  ///< a recorded mesh; none where the file is not there
  int passes = 15;
  bool stages = false, cuda = false;
};

/// How many comparisons differ. `manifest`: counts and hashes of the small scenes, as gpu/manifest.json has them.
int checkNear(const NearCheck& settings, std::string& manifest);

}  // namespace gambeson::gpu
