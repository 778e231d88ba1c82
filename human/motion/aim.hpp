#pragma once
/// Taking aim at the ground.

#include "human/motion/motion.hpp"

namespace gambeson {

/// What taking aim is made of.
struct AimOptions {
  double stand_s = 0;  ///< time at low ready before it
  double duration_s = 1.5;
  double hold_s = 0;           ///< time aiming after it
  double rifle_mass_kg = 3.5;  ///< enters natural moments, not contact
};
/// From low ready to aiming at the ground, leaning left (Zheng 2013, 6.6; human/motion/aim.cpp).
std::unique_ptr<Motion> makeAim(const Human& human, const AimOptions& options);

}  // namespace gambeson
