#pragma once
/// One step of the explicit scheme with contact (Zheng 2013, section 3.1), and the length that it may have.

#include "core/motion/model.hpp"

namespace gambeson {

/// The garment at rest as a state at `time_s`: positions of the rest shape, no velocity; accelerations evaluated.
/// Springs are anchored where their samples are (`attachSprings` does so again later).
State initialState(const Model& model, const Stage& stage, double time_s, StepWork& work);

/// Moves the inner unknowns to where nothing acts on them, points and history as they are: cloth that starts bent would
/// swing there else. No supports of a structure.
void settleInner(const Model& model, State& state, StepWork& work);

/// Anchors every spring above where its sample is now (Model::spring_rise_m), and evaluates the forces again.
void attachSprings(const Model& model, const Stage& stage, State& state, StepWork& work);

/// Hangs the springs on the given points of their anchor frames, and evaluates the forces again.
void hangSprings(const Model& model, const Stage& stage, std::span<const Vec3> anchors, State& state, StepWork& work);

/// Evaluates the forces again, after supports let go. Positions, velocities and what limits and contacts have left stay.
void evaluateForces(const Model& model, const Stage& stage, State& state, StepWork& work);

/// Velocity Verlet with the contact split, eq. 3.11 to 3.13, by `dt_s`. Drag is implicit in the second half as in
/// eq. 3.13. On failure `out` is not to be used.
///
/// Where strain is limited (Zheng 2013, section 5.2), the end positions p + dt v are projected, v being the velocity of
/// the first half step after drag-free forces; what the projection moves is an impulse of that velocity, dq/dt, as the
/// contacts' impulses are. Section 5.1 lets contact follow as the next substep. But contact stretches again what it
/// pushes, and a projection pulls into what the cloth touches, so limits of equality and contacts are one problem
/// (StrainHold). Upper limits, which may slacken, and contacts take turns, each with the other's impulses in place,
/// until the strains hold after the contacts; the contacts have the last word. StepReport gives both residuals.
StepReport step(const Model& model, const Stage& stage, const State& in, double dt_s, State& out, StepWork& work);

/// Sample positions W T p and velocities W T v.
void samplePositions(const Model& model, std::span<const Vec3> p, std::vector<Vec3>& x);

struct Energy {
  double kinetic = 0, internal = 0, gravity = 0, springs = 0, dead = 0;
  double total() const { return kinetic + internal + gravity + springs + dead; }
};
/// Energy of the free points and the cloth [J]; the zero of gravity and of dead forces is at the origin.
Energy energyOf(const Model& model, const Stage& stage, const State& state, StepWork& work);

/// What holds the step down.
struct Frequency {
  double largest_rad_per_s = 0;
  double membrane_share = 0, bending_share = 0, seam_share = 0, spring_share = 0;  ///< of the mode's stiffness, sum 1
  const char* governing() const;
};

/// What an estimate of the frequency moves: all, by bending alone, or the inner unknowns alone.
enum class FrequencyOf { all, bending, inner };

/// The largest eigenfrequency of M^-1 K at the state's positions by Lanczos with full orthogonalisation, K from
/// differences of the force with the steepest bending law, and D of the cloth's own damping as
/// core/motion/frequency.cpp says; starts from state.mode where it is not empty and leaves the new mode there. The
/// stable step of the scheme is 2 / frequency. Accurate from below; 40 iterations are within about 1 % cold.
Frequency largestFrequency(const Model& model, const Stage& stage, State& state, int iterations, StepWork& work,
                           FrequencyOf of = FrequencyOf::all);

}  // namespace gambeson
