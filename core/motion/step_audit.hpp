#pragma once
/// The audit of a step: momentum and work, each term from its own source. Nothing here enters the motion. Internal to
/// core/motion.

#include "core/motion/model.hpp"

namespace gambeson {

/// What a step went from and to. `held_before`, `held_after`: what strain limits pull held points with at the ends [N];
/// empty where nothing pulls.
struct StepEnds {
  const State &in, &out;
  double step_s = 0;
  Vec3 air_before, air_after;
  std::span<const Vec3> held_before, held_after;
};

/// Completes report.momentum and report.work, and writes the impulses on bodies and on held points.
void auditStep(const Model& model, const StepEnds& ends, StepReport& report, StepWork& work);

inline Vec3 sumOf(std::span<const Vec3> values) {
  Vec3 s{};
  for (const Vec3& v : values) s += v;
  return s;
}

}  // namespace gambeson
