#pragma once
/// The left arm as a pattern maker measures it for sleeves.

#include <cmath>
#include <optional>

#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

/// Axes of an arm along `up`, a unit vector from the wrist to the shoulder: those of one that hangs are x, y, z of the
/// world, and go with it where it is raised, sideways or forward.
struct ArmAxes {
  Vec3 forward, left, up;
};
ArmAxes armAxes(const Vec3& up);

/// How a sleeve is cut around the arm.
struct SleeveFit {
  double length_m = 0;             ///< from the shoulder joint to the hem, along the arm
  double ease = 0;                 ///< girth = (1 + ease) that of the arm
  std::optional<double> hem_ease;  ///< over the girth of the arm at the hem; without it the sleeve hangs
  double keep_m = 0;               ///< what it keeps from the arm at least
  double layer_m = 0, gap_m = 0;   ///< its thickness in contact; what it keeps more than that from garments under it
  /// Of the torso, what stands farther to the left and higher than this is part of the shoulder [m, in the world].
  double shoulder_y_m = HUGE_VAL, shoulder_z_m = HUGE_VAL;
};

/// Cross-sections of the left arm of the standing body, across a straight line from wrist to shoulder.
///
/// They stand in the arm's own frame: origin in the shoulder joint, z from wrist to shoulder, x forward, y outward. Of
/// a sleeve that ends above the elbow they are the wrap of the arm. A longer one hangs: its hem is as wide as all that
/// lies between it and the elbow, seen along the arm, and it goes up from there without hollows, so that there is room
/// for the elbow to bend. With a `hem_ease` it tapers to the arm at its hem instead, and the ease goes over into that
/// of the hem between elbow and hem. Sleeves of garments under it are part of the arm.
class ArmForm {
 public:
  /// Throws InputError: "sleeve_length_m" where the hem is not above the wrist, "garment.shirt" where a human has no
  /// arm.
  ArmForm(const BodyForm& form, const SleeveFit& fit, std::span<const Worn> under);

  const Pose& toArm() const { return X_AW_; }  ///< from the world
  Pose toWorld() const { return inverse(X_AW_); }
  double hem() const { return hem_; }           ///< z of the hem
  double elbow() const { return elbow_; }       ///< z of the elbow
  double top() const { return sleeve_->to(); }  ///< z where the arm ends at the shoulder
  /// The sleeve's cross-section, hem <= z <= top.
  std::vector<Vec2> at(double z) const { return sleeve_->crossSection(z); }
  /// What no sleeve may come into: the arm with what is kept from it, without ease.
  const Wrap& kept() const { return *kept_; }
  /// Where the middle of the arm stands.
  const Vec2& middle() const { return middle_; }

 private:
  Pose X_AW_;
  double hem_ = 0, elbow_ = 0;
  Vec2 middle_;
  std::optional<Wrap> sleeve_, kept_;
};

}  // namespace gambeson
