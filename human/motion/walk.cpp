/// Walking at natural speed. The joints follow the curves of human/motion/walk_curves.hpp; the pelvis goes where the
/// feet take it: the stance foot, an ellipsoid, rolls on the ground z = 0 without slip, that is, its material point at
/// the ground is at rest. In double support the velocity passes smoothly (C²) from the rear to the front foot; there
/// the two feet of the mean curves do not agree exactly, so both slip a little.

#include "human/motion/walk.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/path.hpp"
#include "human/motion/smooth_step.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk_curves.hpp"

namespace gambeson {
namespace {

/// A driven joint: which value of the posture, which curve, its shift in phase, and what is added.
struct Drive {
  int joint;
  const PeriodicSpline* curve;
  double shift, offset;
};

class Walk final : public Motion {
 public:
  Walk(const Human& human, const WalkOptions& options)
      : human_(human), options_(options), curves_(naturalWalk()), standing_(standing(human)) {
    const Skeleton& s = human_.skeleton;
    for (const double shift : {0.0, 0.5}) {
      const std::string side = shift == 0 ? "_right" : "_left";
      const auto drive = [&](const char* name, const PeriodicSpline& curve, double offset, bool needed) {
        const int j = s.joint(name + side);
        if (j >= 0)
          drives_.push_back({j, &curve, shift, offset});
        else if (needed)
          throw InputError({"", 0, "human"}, "walking needs the joint '" + (name + side) + "'");
      };
      drive("hip_flexion", curves_.hip_flexion, 0, true);
      drive("hip_adduction", curves_.hip_adduction, -held_hip_abduction_rad, true);
      drive("hip_rotation", curves_.hip_rotation, 0, true);
      drive("knee_flexion", curves_.knee_flexion, 0, true);
      drive("ankle_flexion", curves_.ankle_flexion, 0, true);
      drive("shoulder_flexion", curves_.shoulder_flexion, 0, false);
      drive("elbow_flexion", curves_.elbow_flexion, 0, false);
      feet_.push_back(&footOf(human_, shift == 0 ? "right" : "left", "walking"));
    }
    lumbar_ = {s.joint("lumbar_flexion"), s.joint("lumbar_bending"), s.joint("lumbar_rotation")};
    lead_in_ = integrate(0, options_.lead_in_s, {});
    stride_ = integrate(options_.lead_in_s, options_.stride_time_s, lead_in_.x.back());
  }

  double duration() const override {
    return options_.stand_s + options_.lead_in_s + options_.strideCount() * options_.stride_time_s;
  }
  Vec3 meanVelocity() const { return (stride_.x.back() - stride_.x.front()) / options_.stride_time_s; }

  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration()) - options_.stand_s;
    Posture p = postureAt(t);
    p.root.origin = t <= 0 ? Vec3{} : lead_in_.at(std::min(t, options_.lead_in_s));
    if (t > options_.lead_in_s) {
      const double walked = t - options_.lead_in_s;
      const int last = static_cast<int>(std::ceil(options_.strideCount())) - 1;
      const int k = std::min(static_cast<int>(walked / options_.stride_time_s), last);
      p.root.origin = stride_.at(walked - k * options_.stride_time_s) + k * (stride_.x.back() - stride_.x.front());
    }
    p.root.origin.z = heightAt(t, p);
    return p;
  }

 private:
  /// How far the lead-in has come (0 standing, 1 walking) and the phase of the stride, which speeds up from rest
  /// likewise and is 0 (right foot strike) at the end of the lead-in; t counts from its begin.
  double amplitude(double t) const { return smootherStep(t / options_.lead_in_s); }
  double phase(double t) const {
    const double T = options_.stride_time_s, L = options_.lead_in_s;
    return t > L ? (t - L) / T : (smootherArea(t / L) - 0.5) * L / T;
  }

  /// Joints and orientation of the root; its origin is left at 0.
  Posture postureAt(double t) const {
    const double s = amplitude(t), p = phase(t);
    Posture posture{standing_.q, {}};
    for (const Drive& d : drives_) {
      double& q = posture.q[d.joint];
      q += s * (d.curve->at(p + d.shift) + d.offset - q);
    }
    const double yaw = s * curves_.pelvis_yaw.at(p), roll = s * curves_.pelvis_roll.at(p),
                 pitch = s * curves_.pelvis_pitch.at(p);
    posture.root.rotation =
        rotationAbout({0, 0, 1}, yaw) * rotationAbout({1, 0, 0}, roll) * rotationAbout({0, 1, 0}, pitch);
    // The trunk keeps upright: lumbar angles equal and opposite to the pelvis's.
    const std::array<double, 3> turn{pitch, roll, yaw};
    for (int i = 0; i < 3; ++i)
      if (lumbar_[i] >= 0) posture.q[lumbar_[i]] = -turn[i];
    return posture;
  }

  /// Share of the right foot in carrying the pelvis: 1 in its single support, 0 in the left's.
  double rightShare(double t) const {
    const double p = phase(t) - std::floor(phase(t)), d = curves_.double_support;
    return p < 0.5 ? smootherStep(p / d) : 1 - smootherStep((p - 0.5) / d);
  }

  /// Height of the pelvis at which a foot just touches the ground, and the lowest point of the foot in its frame.
  double heightOn(const BodyShape& foot, const std::vector<Pose>& X_WL, Vec3* lowest = nullptr) const {
    const Pose X = X_WL[foot.link] * foot.X_LS;
    const Vec3 p = lowestPoint(foot.shape, X.rotation);
    if (lowest) *lowest = p;
    return -(X * p).z;
  }

  double heightAt(double t, Posture p) const {
    p.root.origin = {};
    const auto X_WL = linkPoses(human_.skeleton, p.q, p.root);
    const double w = rightShare(t);
    return w * heightOn(*feet_[0], X_WL) + (1 - w) * heightOn(*feet_[1], X_WL);
  }

  /// Horizontal velocity of the pelvis: minus that of the foot's point at the ground relative to it, by central
  /// differences of the posture (error about h² x''' / 6 = 1e-8 m/s).
  Vec3 velocityAt(double t) const {
    constexpr double h = 1e-5;
    const Posture now = postureAt(t), before = postureAt(t - h), after = postureAt(t + h);
    const auto X0 = linkPoses(human_.skeleton, now.q, now.root);
    const auto X1 = linkPoses(human_.skeleton, before.q, before.root),
               X2 = linkPoses(human_.skeleton, after.q, after.root);
    const double w = rightShare(t);
    Vec3 v;
    for (int i = 0; i < 2; ++i) {
      const BodyShape& foot = *feet_[i];
      Vec3 p;
      heightOn(foot, X0, &p);
      v += (i == 0 ? w : 1 - w) * ((X1[foot.link] * foot.X_LS * p - X2[foot.link] * foot.X_LS * p) / (2 * h));
    }
    v.z = 0;
    return v;
  }

  HermitePath<Vec3> integrate(double begin, double length, const Vec3& x) const {
    return integrated(begin, length, x, [this](double t) { return velocityAt(t); });
  }

  Human human_;
  WalkOptions options_;
  WalkCurves curves_;
  Posture standing_;
  std::vector<Drive> drives_;
  std::array<int, 3> lumbar_{};         ///< joints of flexion, bending, rotation; -1 where there is none
  std::vector<const BodyShape*> feet_;  ///< right, left; into human_
  HermitePath<Vec3> lead_in_, stride_;
};

}  // namespace

std::unique_ptr<Motion> makeWalk(const Human& human, const WalkOptions& o, Vec3* mean_velocity) {
  const auto check = [](const char* key, double value, bool good, const char* allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600");
  check("lead_in_s", o.lead_in_s, o.lead_in_s >= 0.1 && o.lead_in_s <= 60, "0.1 to 60");
  check("strides", o.strides, o.strides >= 1 && o.strides <= 100000, "1 to 100000");
  check("paces", o.paces, o.paces >= 0 && o.paces <= 200000, "0 to 200000");
  check("stride_time_s", o.stride_time_s, o.stride_time_s >= 0.5 && o.stride_time_s <= 5, "0.5 to 5");
  auto walk = std::make_unique<Walk>(human, o);
  if (mean_velocity) *mean_velocity = walk->meanVelocity();
  return walk;
}

}  // namespace gambeson
