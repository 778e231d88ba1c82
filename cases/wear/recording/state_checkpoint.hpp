#pragma once
/// The state of worn cloth as a recording keeps it, so that a run that was interrupted goes on with the same bits.

#include "core/io/recording.hpp"
#include "core/motion/step.hpp"

namespace gambeson {

Checkpoint checkpointOf(const State& state, const Frequency& frequency);
State stateOf(const Checkpoint& checkpoint, Frequency& frequency);

}  // namespace gambeson
