#pragma once
/// Taking aim on one knee.

#include "human/motion/motion.hpp"

namespace gambeson {

/// What aiming on one knee is made of.
struct KneelOptions {
  double stand_s = 0;       ///< time at low ready before it
  double duration_s = 1.5;  ///< down onto the right knee
  double hold_s = 1;        ///< time aiming
  double rise_s = 1.5;      ///< back to low ready; 0: stays down
};
/// From low ready down onto the right knee, aiming, and back up (human/motion/kneel.cpp). Throws InputError where a
/// joint of the legs is missing or the legs do not allow it.
std::unique_ptr<Motion> makeKneel(const Human& human, const KneelOptions& options);

}  // namespace gambeson
