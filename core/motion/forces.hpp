#pragma once
/// The forces of a state, with what prescribes them from outside. Internal to core/motion.

#include "core/motion/step_contact.hpp"

namespace gambeson {

/// What the springs hang on at one instant.
struct AnchorFrames {
  std::span<const Placement> of_stage;
  const DeformedVertices& vertices;

  /// Of the obstacle under the spring, unit; 0 where there is none.
  Vec3 normal(const SpringSupportPoint& spring) const {
    if (spring.obstacle < 0) return {};
    const std::span<const Vec3> x = vertices[spring.obstacle];
    const Vec3 a = x[spring.triangle[0]];
    return normalized(cross(x[spring.triangle[1]] - a, x[spring.triangle[2]] - a));
  }
};

/// The frames at an instant of no step.
struct AnchorInstant {
  std::vector<Placement> of_stage;
  DeformedVertices vertices;

  AnchorInstant(const Model& m, const Stage& stage, double time_s) : of_stage(m.anchor_count) {
    std::vector<Placement> obstacles(m.obstacles.size());
    stage.placements(time_s, obstacles, of_stage);
    for (const SpringSupportPoint& s : m.springs)
      if (s.obstacle >= 0 && vertices.empty()) vertices = deformedVertices(m, stage, time_s);
  }
  AnchorFrames frames() const { return {of_stage, vertices}; }
};

/// Internal force at s on the free points, Tᵀ f(T p), into `out`, and on the inner unknowns, into work.inner_force,
/// from the history committed `elapsed_s` ago; what laws would remember into `history` where that is not empty.
void internalForce(const Model& m, const State& s, std::span<const double> committed, double elapsed_s,
                   std::span<double> history, std::vector<Vec3>& out, StepWork& w, ClothEnergy* energy,
                   const ForceTerms& terms = {});

/// Takes w.inner_force, which internalForce has left, to what moves at time_s: with the loads of a structure, and what
/// acts on inner unknowns that its supports lead to `forces` on the points.
void leadInnerForce(const Model& m, double time_s, StepWork& w, std::vector<Vec3>& forces);

/// Work of a structure's loads on inner unknowns over a step [J].
double innerLoadWork(const Model& m, const State& in, const State& out);

/// Rates of the inner unknowns after w.inner_force has acted for dt, their drag implicit; returns what that takes [J].
double moveInnerRates(const Model& m, double dt_s, std::span<double> rates, const StepWork& w);

/// Forces of the springs [N]; anchors stand as `frames` say.
void springForces(const Model& m, const State& s, const AnchorFrames& frames, std::vector<Vec3>& forces);

/// Work that the motion of anchors and normals does on the springs in a step [J]: with the energy k/2 |P d|² of the
/// displacement d, P = I - n nᵀ, it is the integral of -k (P d) . da - k (d . n) (d . dn).
double springWork(const Model& m, const State& in, const State& out, const AnchorFrames& before,
                  const AnchorFrames& after, std::span<const Vec3> impulses, double dt);

/// The lengths of time that an evaluation of the forces knows of [s].
struct Around {
  double half_step_s = 0;     ///< over which drag is implicit
  double support_step_s = 0;  ///< over which the motion that supports prescribe is differentiated, on each side; 0: it
                              ///< begins now
  double elapsed_s = 0;       ///< since the history was committed
};

/// All forces at s.p; sets s.a and s.sums. `half_velocity` is v at n + 1/2 and `half_step_s` dt/2: the drag is implicit
/// there (eq. 3.13), v = half_velocity + half_step a. For an evaluation at a known velocity pass it with half_step 0.
/// With strain limits or contacts v = half_velocity + half_step (a + lasting), `lasting` being their acceleration in
/// the last step (empty: none): their force acts all the time though its impulse comes once a step, and without its
/// half cloth that hangs or lies still would have the velocity half_step a, on which drag would act.
/// `committed`: null, to evaluate at s with the history that it has; else the history that the step began with, from
/// which that of s is made. `energy`: null, or what the cloth has stored and lost. Returns what it has lost [J].
double accelerate(const Model& m, const AnchorFrames& anchor_frames, const Vec3& air,
                  std::span<const Vec3> half_velocity, std::span<const Vec3> lasting, const Around& around,
                  const std::vector<double>* committed, State& s, StepWork& w, ClothEnergy* energy = nullptr);

/// What the cloth stores, with springs and stitches, of which `stored` is the cloth's own [J].
double elasticEnergy(const Model& m, const State& s, const AnchorFrames& frames, double stored, StepWork& w);

/// The same, with an evaluation of what the cloth stores.
double elasticEnergyAt(const Model& m, const State& s, const AnchorFrames& frames, StepWork& w);

}  // namespace gambeson
