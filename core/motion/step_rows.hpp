#pragma once
/// Rows of the contacts of a step: persistent ones, and impacts that join them. Internal to core/motion.

#include "core/motion/model.hpp"

namespace gambeson {

/// How far the cloth between the samples stands out from them towards the body: its gap is so much smaller than theirs.
double standsOut(const Model& m, const ContactRow& row);

/// Where the obstacles stand at both ends of the step.
ObstacleMotion motionOf(const StepWork& w);

/// Rows of the persistent contacts with their warm tractions.
void persistentRows(const Model& m, const State& in, double dt, StepWork& w);

/// A sample's hit at an obstacle; replaces the row of the same pair.
void addImpact(const Model& m, const State& in, const Contact& hit, double dt, int round, StepWork& w);

/// A hit of triangles; replaces the row of the same pair.
void addImpact(const Model& m, const State& in, const PairHit& hit, double dt, int round, StepWork& w);

}  // namespace gambeson
