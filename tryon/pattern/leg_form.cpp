#include "tryon/pattern/leg_form.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr const char* kGarment = "garment.shorts";
constexpr int levels = 121;

}  // namespace

LegForm::LegForm(const BodyForm& form, double crotch_z, double hem_z)
    : form_(form), thigh_(form.links({"thigh_left"}, kGarment)) {
  if (hem_z > form.lowest(thigh_)) return;
  const Links leg = form.links({"thigh_left", "shank_left", "foot_left"}, kGarment);
  const Vec3 knee = form.origin(leg[1]), ankle = form.origin(leg[2]);
  if (!(hem_z > ankle.z))
    throw InputError({"", 0, "inseam_m"},
                     fmt::format("{:.4g} m, reaches below the ankle, where the legs end; allowed: less than {:.4g} m",
                                 crotch_z - hem_z, crotch_z - ankle.z));
  const Vec3 shank = knee - ankle;
  if (shank.z > 0) lean_ = {shank.x / shank.z, shank.y / shank.z};
  std::vector<std::vector<Vec2>> hulls;
  std::vector<Vec2> below;  // the knee, moved along the shank's axis to its height
  const auto up = [&](int k) { return hem_z + (crotch_z - hem_z) * k / (levels - 1) - knee.z; };
  for (int k = 0; k < levels; ++k) {
    hulls.push_back(form.hull(knee.z + up(k), leg, false, "inseam_m"));
    if (up(k) <= 0)
      for (const Vec2& x : hulls.back()) below.push_back({x.x - up(k) * lean_.x, x.y - up(k) * lean_.y});
  }
  if (!below.empty()) below = convexHull(std::move(below));
  for (int k = 0; k < levels && up(k) <= 0; ++k) {
    hulls[k] = below;
    for (Vec2& x : hulls[k]) x = {x.x + up(k) * lean_.x, x.y + up(k) * lean_.y};
  }
  hanging_ = Wrap(hulls, hem_z, crotch_z);
}

ClosedCurve LegForm::at(double z) const {
  return ClosedCurve(hanging_ ? hanging_->crossSection(std::clamp(z, hanging_->from(), hanging_->to()))
                              : form_.hull(z, thigh_, false, "inseam_m"));
}

}  // namespace gambeson
