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

/// Rows of the hits of a round, w.hits and w.pair_hits, no two of which are of the same sample and obstacle or the same
/// pair: each replaces the row of its own.
void addImpacts(const Model& m, const State& in, double dt, int round, StepWork& w);

}  // namespace gambeson
