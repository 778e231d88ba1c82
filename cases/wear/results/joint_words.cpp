#include "cases/wear/results/joint_words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace gambeson {

MovementWords movementWords(const std::string& movement) {
  if (movement == "flexion") return {"flexes", "extends", "flexion", "extension", "flexion", "extension"};
  if (movement == "adduction") return {"adducts", "abducts", "adduction", "abduction", "adduction", "abduction"};
  if (movement == "abduction") return {"abducts", "adducts", "abduction", "adduction", "abduction", "adduction"};
  if (movement == "rotation")
    return {"turns inwards",     "turns outwards",    "internal rotation",
            "external rotation", "internal rotation", "external rotation"};
  return {"moves to higher joint values",
          "moves to lower joint values",
          "the joint value",
          "minus the joint value",
          "motion",
          "motion"};
}

Push pushOf(double added_torque, double rate_rad_per_s) {
  constexpr double still_rad_per_s = 0.02;
  if (std::abs(rate_rad_per_s) < still_rad_per_s || added_torque == 0) return Push::held;
  return (added_torque > 0) == (rate_rad_per_s > 0) ? Push::against : Push::along;
}

const char* nameOf(Push push) {
  switch (push) {
    case Push::against:
      return "against the motion";
    case Push::along:
      return "with the motion";
    case Push::held:
      break;
  }
  return "joint held still";
}

std::string signOf(const std::string& movement) {
  const MovementWords w = movementWords(movement);
  const bool named = std::string(w.to_above) != w.to_below;
  const std::string up = named ? w.to_above : "higher joint values", down = named ? w.to_below : "lower ones";
  return fmt::format(
      "Above 0 the muscles must pull more towards {} because of the garment, below 0 more towards {}. So above 0 it "
      "hinders while the joint {} and helps while it {}; below 0 the other way round.",
      up, down, w.rises, w.falls);
}

std::string naturalMeaning(Task task) {
  switch (task) {
    case Task::natural_walk:
      return "Natural moments are the peaks of net joint moments in level walking of healthy adults (Bovi et al. "
             "2011), in proportion to body mass, and the same on both sides.";
    case Task::natural_stairs:
      return "Natural moments are the peaks of net joint moments in stair ascent of healthy adults (Bovi et al. "
             "2011), in proportion to body mass, and the same on both sides.";
    case Task::aiming:
      return "Natural moments are the largest that hold the motion's postures still, with the rifle's weight in the "
             "hands: statics of the segments' weights, at the times when both feet stand. The feet share the weight "
             "in proportion to where the centre of mass projects between them. A leg's moment is mostly the ground's "
             "force on its foot times how far that passes from the joint: the sides differ where one leg bears more "
             "weight, or has its foot farther from below the joint.";
    case Task::none:
      break;
  }
  return "";
}

}  // namespace gambeson
