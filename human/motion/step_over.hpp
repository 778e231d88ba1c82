#pragma once
/// Walking up to an obstacle, over it and on.

#include "human/body/ground.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

/// What stepping over an obstacle is made of. It begins and ends standing.
struct StepOverOptions {
  double stand_s = 0.2;         ///< time at rest before it
  int before = 2;               ///< strides (of two steps each) up to the obstacle
  int after = 1;                ///< strides after the one that leads over it; the last step puts the feet side by side
  double height_m = 0.5;        ///< of the obstacle
  double depth_m = 0.05;        ///< of the obstacle, along the way
  double clearance_m = 0.025;   ///< of the feet from the obstacle, at least
  double stride_time_s = 1.10;  ///< of a stride on the level; the one over the obstacle takes 2.2 times as long
};

/// Four strides, the third over an obstacle 0.5 m high, unless the options say otherwise (Man 2006, 5.4;
/// human/motion/step_over.cpp). `hurdle` returns where the obstacle stands. Throws InputError with the key "height"
/// where the legs cannot clear it.
std::unique_ptr<Motion> makeStepOver(const Human& human, const StepOverOptions& options, Hurdle* hurdle = nullptr);

}  // namespace gambeson
