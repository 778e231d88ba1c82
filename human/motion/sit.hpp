#pragma once
/// Sitting down and standing up.

#include "human/motion/motion.hpp"

namespace gambeson {

/// What sitting down and standing up is made of.
struct SitOptions {
  double stand_s = 0.2;         ///< at rest before it
  double duration_s = 4;        ///< down, seated, and up again
  double seat_height_m = 0.45;  ///< of the lowest point of the pelvis where it sits
  int repeats = 1;
};
/// Sits down and stands up with both feet where they stand (human/motion/sit.cpp). Throws InputError where legs and
/// trunk do not allow it.
std::unique_ptr<Motion> makeSit(const Human& human, const SitOptions& options);

}  // namespace gambeson
