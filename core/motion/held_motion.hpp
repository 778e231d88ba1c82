#pragma once
/// Held points of worn cloth that supports move (Model::held_motion). Each step carries them on from where they are, so
/// that nothing of it is part of the State. All functions do nothing where nothing is moved.

#include "core/motion/model.hpp"

namespace gambeson {

/// The motions at both ends of a step, into the work's held_start and held_end.
void findHeldMotions(const Model& model, const Stage& stage, double start_s, double end_s, StepScratch& work);

/// Where a point that moves with a motion, now at x, is at the end of the step.
Vec3 carried(const StepScratch& work, int motion, const Vec3& x);

/// Mean velocities over a step of dt_s of the moved points, that are at p at its start.
void driveHeld(const Model& model, std::span<const Vec3> p, double dt_s, const StepScratch& work, std::span<Vec3> v);

/// Positions of the moved points at the end of a step that starts at `before`.
void placeHeld(const Model& model, std::span<const Vec3> before, const StepScratch& work, std::span<Vec3> p);

/// Their velocities at the end of the step, where they are at p.
void rateHeld(const Model& model, std::span<const Vec3> p, const StepScratch& work, std::span<Vec3> v);

}  // namespace gambeson
