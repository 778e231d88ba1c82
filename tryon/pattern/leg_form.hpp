#pragma once
/// The left leg as a pattern maker measures it for shorts and trousers.

#include <optional>

#include "tryon/pattern/form.hpp"

namespace gambeson {

/// Cross-sections of the left leg, level, of the standing body.
///
/// Of a leg that ends above the knee they are hulls of the thigh. A longer one hangs: its hem is as wide as all that
/// lies between it and the knee, seen along the shank's axis from knee to ankle, and it goes up from there to the
/// crotch without hollows, as the wrap of such cross-sections does (Wrap). A cut across the axis is cos(lean) as long
/// in the direction of the lean as a level one: 0.4 % at 5 degrees.
class LegForm {
 public:
  /// The leg from the crotch down to the hem, both heights in the world; hem < crotch. Throws InputError: "inseam_m"
  /// where the hem is not above the ankle (of a leg that ends above the knee: never), "garment.shorts" where a human
  /// for whom it is longer has no shank or foot.
  LegForm(const BodyForm& form, double crotch_z, double hem_z);
  /// crotch >= z >= hem.
  ClosedCurve at(double z) const;

  /// How the shank's axis moves for each metre upward; 0 for a leg that ends above the knee.
  const Vec2& lean() const { return lean_; }

 private:
  const BodyForm& form_;
  Links thigh_;
  std::optional<Wrap> hanging_;  ///< none: hulls of the thigh
  Vec2 lean_{};
};

}  // namespace gambeson
