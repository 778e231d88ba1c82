#pragma once
/// The audit of a step: momentum and work, each term from its own source. Nothing here enters the motion. Internal to
/// core/motion.

#include "core/motion/model.hpp"

namespace gambeson {

/// Where hardly anything acts from outside, velocities and internal forces still round: the scale of the momentum's
/// error is at least this part of the momenta of all points and of what a weight would add. At the limit of 1e-9 of the
/// scale, some 500 times the rounding of a velocity.
constexpr double kScaleFloor = 1e-4, kWeight_m_per_s2 = 9.81;

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

/// Contact's part, and the impulses on bodies. Impulses act at once, on the mean of the predicted and the solved
/// velocity, less half a step's `foreseen` accelerations that these hold in advance (empty: none).
void contactLedger(const Model& model, const State& in, double dt_s, std::span<const Vec3> foreseen, StepReport& report,
                   StepWork& work);

/// What velocity Verlet itself makes or takes in a step of worn cloth [J] (WorkAudit::integrator), by its own formula:
/// with the accelerations a of the forces, c of what lasts of contacts and limits, D of their impulses and d the way of
/// the step,
///   dv = dt/2 (a0 + a1) + D + dt/2 (c1 - c0),
///   m dv . (v0 + v1)/2 + change of what is stored + lost - m g . d - works,
/// which is (dt^2/8) m |a + c|^2 at the end less that at the start, and what the trapezium rule of the forces misses of
/// their work on d. After auditStep.
double verletWork(const Model& model, const State& in, const State& out, double elastic_before_J, const WorkAudit& work,
                  const StepWork& w);

inline Vec3 sumOf(std::span<const Vec3> values) {
  Vec3 s{};
  for (const Vec3& v : values) s += v;
  return s;
}

}  // namespace gambeson
