#pragma once
/// The part of gambeson_gpu_check that compares and times contact solves.

#include <filesystem>

namespace gambeson::gpu {

struct SolveSettings {
  std::filesystem::path recorded;  ///< folder of solve0.bin to solve9.bin; where it has none, made up ones alone
  int passes = 15;
  bool cuda = false, large = true, variants = false;
};

/// How many solves differ between core, the reference and CUDA; prints what they take.
int checkSolves(const SolveSettings& settings);

}  // namespace gambeson::gpu
