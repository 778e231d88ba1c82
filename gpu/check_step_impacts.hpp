#pragma once
/// Impacts of a step with their rows: CUDA against the reference and core, and times. Part of gambeson_gpu_check.

#include <string>

namespace gambeson::gpu {

struct StepImpactCheck {
  std::string armour;  ///< a recorded mesh; none where the file is not there
  int passes = 15;
  bool stages = false, cuda = false;
};

/// How many comparisons differ.
int checkStepImpacts(const StepImpactCheck& settings);

}  // namespace gambeson::gpu
