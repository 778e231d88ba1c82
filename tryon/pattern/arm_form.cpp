#include "tryon/pattern/arm_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr const char* kGarment = "garment.shirt";
constexpr const char* kLength = "sleeve_length_m";
constexpr int levels = 121;
constexpr double level_m = 0.004;  ///< between heights at which the shoulder is looked for
constexpr double highest_m = 0.2;  ///< above the joint

std::vector<Vec2> grown(const std::vector<Vec2>& points, double factor, const Vec2& centre) {
  std::vector<Vec2> out;
  for (const Vec2& p : points)
    out.push_back({centre.x + factor * (p.x - centre.x), centre.y + factor * (p.y - centre.y)});
  return out;
}

}  // namespace

ArmAxes armAxes(const Vec3& up) {
  // Raised forward x by the least rotation that takes z to it; elsewhere x as near as it can stay.
  const Vec3 x{1, 0, 0}, z{0, 0, 1};
  const bool along_x = std::abs(up.x) > 0.5;
  const Vec3 forward = normalized(along_x ? x - (up.x / (1 + up.z)) * (up + z) : x - up.x * up);
  return {forward, cross(up, forward), up};
}

ArmForm::ArmForm(const BodyForm& form, const SleeveFit& fit, std::span<const Worn> under) {
  const Links arm = form.links({"upper_arm_left", "forearm_left", "hand_left"}, kGarment);
  const Vec3 shoulder = form.origin(arm[0]), elbow = form.origin(arm[1]), wrist = form.origin(arm[2]);
  const double length = norm(shoulder - wrist);
  if (!(length > 0)) throw InputError({"", 0, kGarment}, "needs a human whose arms have a length");
  const Vec3 up = (shoulder - wrist) / length;
  const ArmAxes axes = armAxes(up);
  X_AW_ = inverse(Pose{{axes.forward, axes.left, up}, shoulder});
  elbow_ = (X_AW_ * elbow).z;
  hem_ = -fit.length_m;
  if (!(fit.length_m < length))
    throw InputError({"", 0, kLength},
                     fmt::format("{:.4g} m, reaches below the wrist, where sleeves end; allowed: less than {:.4g} m",
                                 fit.length_m, length));

  const auto section = [&](double z) { return convexHull(form.across(X_AW_, z, arm)); };
  double shoulder_top = 0;
  while (shoulder_top + level_m < highest_m && section(shoulder_top + level_m).size() >= 3) shoulder_top += level_m;
  const double top = shoulder_top + level_m + fit.keep_m;  // what is kept lies over the shoulder too
  std::vector<std::vector<Vec2>> sections;
  std::vector<Vec2> below;  // all that lies below the elbow
  const auto height = [&](int k) { return hem_ + (top - hem_) * k / (levels - 1); };
  for (int k = 0; k < levels; ++k) {
    sections.push_back(section(std::min(height(k), shoulder_top)));
    if (sections.back().size() < 3)
      throw InputError({"", 0, kGarment},
                       fmt::format("the arm has no cross-section {:.1f} cm from the shoulder", -100 * height(k)));
    if (height(k) <= elbow_) below.insert(below.end(), sections[k].begin(), sections[k].end());
  }
  below = convexHull(std::move(below));
  for (int k = 0; k < levels && height(k) <= elbow_ && !fit.hem_ease; ++k) sections[k] = below;
  middle_ = ClosedCurve(sections[levels / 2]).centroid();

  const auto easeAt = [&](double z) {
    if (!fit.hem_ease) return fit.ease;
    const double way = std::max(elbow_, hem_ + 0.05) - hem_;  // from the hem up to where the ease is the sleeve's
    const double x = std::clamp((z - hem_) / way, 0.0, 1.0);
    return *fit.hem_ease + (fit.ease - *fit.hem_ease) * x * x * (3 - 2 * x);
  };
  std::vector<std::vector<Vec2>> eased;
  for (int k = 0; k < levels; ++k) {
    const ClosedCurve curve(sections[k]);  // the ease goes outward, away from the chest
    eased.push_back(grown(sections[k], 1 + easeAt(height(k)), {curve.centroid().x, -curve.extent({0, -1})}));
  }
  kept_ = Wrap(sections, hem_, top).widened(fit.keep_m).offset(fit.keep_m);
  Wrap over = *kept_;
  if (sleeveWrapOf(under, X_AW_, fit.layer_m, fit.gap_m, hem_, top, levels, over))
    kept_ = kept_->with(over.widened((top - hem_) / (levels - 1)));  // a hem at this one's height has no cut there
  sleeve_ = Wrap(eased, hem_, top).with(*kept_);
  if (std::isfinite(fit.shoulder_z_m)) {
    const Links torso = form.links({"torso"}, kGarment);
    const Pose X_WA = toWorld();
    std::vector<std::vector<Vec2>> shoulders(levels);
    for (int k = 0; k < levels; ++k)
      if (height(k) > elbow_)
        for (const Vec2& p : form.across(X_AW_, height(k), torso)) {
          const Vec3 x = X_WA * Vec3{p.x, p.y, height(k)};
          if (x.y > fit.shoulder_y_m && x.z > fit.shoulder_z_m) shoulders[k].push_back(p);
        }
    kept_ = kept_->with(Wrap::plain(shoulders, hem_, top).widened(fit.keep_m).offset(fit.keep_m));
  }
}

}  // namespace gambeson
