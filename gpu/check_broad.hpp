#pragma once
/// The part of gambeson_gpu_check that compares broad phases: what they test, take and find.

#include <span>
#include <string>
#include <vector>

#include "gpu/scenes/scene.hpp"

namespace gambeson::gpu {

struct BroadSettings {
  std::vector<std::string> names;  ///< as `--broad` has them
  int passes = 15;
  bool cuda = false, stages = false;
  bool against_reference = true;  ///< on CUDA: the reference finds it all again, which takes minutes
};

/// What `--broad` may be.
std::vector<std::string> broadNames();

/// How many comparisons differ: of candidates and hits with those of trees, of CUDA with the reference.
int checkBroad(std::span<const Scene> scenes, const BroadSettings& settings);

}  // namespace gambeson::gpu
