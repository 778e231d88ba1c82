#pragma once
/// How far from bodies samples stay, so that the cloth between them stays out too. Internal to core/motion.

#include "core/motion/model.hpp"

namespace gambeson {

/// Of the contacts with bodies w.near, sorted by sample: the layer lies between the body and the surface where this
/// comes nearest to it between the samples, at most kLargestClearance_m.
void findClearances(const Model& model, StepWork& work);

}  // namespace gambeson
