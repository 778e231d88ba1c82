/// Sitting down and standing up. Knees and shanks follow smooth courses (minimum jerk), each leg in a plane through its
/// hip and its ankle; the ankles stay where they stand, so the pelvis goes where the legs take it. As the hips come
/// down the planes tilt, and the feet roll by some degrees about their long axes: their lowest points stay on the
/// ground. While nothing but the feet carries, trunk and pelvis lean forward just so far that the centre of mass stays
/// over them, moving back to a part of their length; seated, trunk and pelvis straighten up: a pelvis that stayed
/// inclined would press belly and thighs together and hollow the back. The deepest bend of the knees is the one at
/// which the lowest point of the pelvis is at the height of the seat.

#include "human/motion/sit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/inverse_statics.hpp"
#include "human/motion/path.hpp"
#include "human/motion/smooth_step.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

/// Parts of the time at which he sits, has straightened, leans forward again, and rises.
constexpr double kSits = 0.3, kStraight = 0.42, kLeans = 0.58, kRises = 0.7;
constexpr double kShank = 25 * rad_per_deg;     ///< its lean forward, seated
constexpr double kShankMore = 4 * rad_per_deg;  ///< and half way
constexpr double kBehind = 0.25;                ///< of the foot's length from the heel: the centre of mass, seated
constexpr double kPelvis = 0.55;                ///< of the lean, that the pelvis has while the feet carry
constexpr double kMostLean = 75 * rad_per_deg;
constexpr double kSeatedLean = 0.1;                       ///< of the trunk, seated; the pelvis is upright then [rad]
constexpr double kArms = 0.6, kElbows = 25 * rad_per_deg;  ///< forward of hanging; bent, seated [rad]
constexpr int kNodes = 200;

struct Leg {
  int flexion, adduction, rotation, knee, ankle, shoulder, elbow;  ///< joints; the arm's may be -1
  double side;                                                     ///< 1: left
  Vec3 knee_T, ankle_S;                                            ///< in the links' frames
  const BodyShape* foot;
};

class Sit final : public Motion {
 public:
  Sit(const Human& human, const SitOptions& options)
      : human_(human),
        options_(options),
        standing_(standing(human_)),
        lumbar_(human_.skeleton.joint("lumbar_flexion")) {
    for (const bool right : {true, false}) {
      const std::string side = right ? "right" : "left";
      const auto joint = [&](const char* name, bool needed = true) {
        const int j = human_.skeleton.joint(std::string(name) + "_" + side);
        if (j < 0 && needed)
          throw InputError({"", 0, "human"}, std::string("sitting down needs the joint '") + name + "_" + side + "'");
        return j;
      };
      Leg leg{joint("hip_flexion"),
              joint("hip_adduction"),
              joint("hip_rotation"),
              joint("knee_flexion"),
              joint("ankle_flexion"),
              joint("shoulder_flexion", false),
              joint("elbow_flexion", false),
              right ? -1.0 : 1.0,
              {},
              {},
              &footOf(human_, side, "sitting down")};
      leg.knee_T = human_.skeleton.joints[leg.knee].X_PJ.origin;
      leg.ankle_S = human_.skeleton.joints[leg.ankle].X_PJ.origin;
      legs_[right ? 0 : 1] = leg;
    }
    const std::vector<Pose> X = linkPoses(human_.skeleton, standing_.q, standing_.root);
    ankle_ = X[human_.skeleton.joints[legs_[1].ankle].child].origin;
    hip_y_ = X[human_.skeleton.joints[legs_[1].flexion].child].origin.y;
    const Pose foot = X[legs_[1].foot->link] * legs_[1].foot->X_LS;
    const double half = std::get<Ellipsoid>(legs_[1].foot->shape).semi_axes.x;
    stands_at_ = centreOfMass(human_, X, {}).x;
    sits_at_ = foot.origin.x - half + 2 * kBehind * half;
    findDepth();
    path_.step_s = 1.0 / kNodes;
    for (int i = 0; i <= kNodes; ++i) path_.x.push_back(leanAt(static_cast<double>(i) / kNodes));
    path_.v = slopesOf(path_.x, path_.step_s);
    if (!(*std::max_element(path_.x.begin(), path_.x.end()) < kMostLean - 1e-6))
      throw InputError({"", 0, "seat_height"}, "the trunk cannot lean so far that the feet carry him on the way down; "
                                               "allowed: a higher seat");
    checkLimits();
  }

  double duration() const override { return options_.stand_s + options_.repeats * options_.duration_s; }
  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration()) - options_.stand_s;
    if (t <= 0) return posture(0, 0, 0);
    const double T = options_.duration_s, u = t / T - std::min(std::floor(t / T), options_.repeats - 1.0);
    const double down = smootherStep(u / kSits) - smootherStep((u - kRises) / (1 - kRises));
    const double straight =
        smootherStep((u - kSits) / (kStraight - kSits)) - smootherStep((u - kLeans) / (kRises - kLeans));
    return posture(down, path_.at(down), straight);
  }

 private:
  /// `s`: how far down; `lean` of the trunk [rad]; `straight`: how far the trunk has straightened, seated.
  Posture posture(double s, double lean, double straight) const {
    Posture p = standing_;
    const double knee = depth_ * s, shank = kShank * s + kShankMore * 4 * s * (1 - s), thigh = knee - shank;
    const double pelvis = (1 - straight) * kPelvis * lean, trunk = lean + straight * (kSeatedLean - lean);
    p.root.rotation = rotationAbout({0, 1, 0}, pelvis);
    for (const Leg& leg : legs_) {
      const Vec3 way =
          rotationAbout({0, 1, 0}, -thigh) * leg.knee_T + rotationAbout({0, 1, 0}, knee - thigh) * leg.ankle_S;
      const double tilt = std::asin((ankle_.y - hip_y_) / -way.z);
      const Mat3 M = rotationAbout({0, 1, 0}, -pelvis) * rotationAbout({1, 0, 0}, leg.side * tilt) *
                     rotationAbout({0, 1, 0}, -thigh);
      // M = Ry(-flexion) Rx(-side adduction) Rz(-side rotation)
      const Vec3 x = M * Vec3{1, 0, 0}, y = M * Vec3{0, 1, 0}, z = M * Vec3{0, 0, 1};
      p.q[leg.flexion] = -std::atan2(z.x, z.z);
      p.q[leg.adduction] = leg.side * std::asin(std::clamp(z.y, -1.0, 1.0));
      p.q[leg.rotation] = -leg.side * std::atan2(x.y, y.y);
      p.q[leg.knee] = knee;
      p.q[leg.ankle] = knee - thigh;
      if (leg.shoulder >= 0) p.q[leg.shoulder] += trunk + kArms * s;
      if (leg.elbow >= 0) p.q[leg.elbow] += kElbows * s;
      p.root.origin.x = ankle_.x - way.x;
      p.root.origin.z = ankle_.z - std::cos(tilt) * way.z;
    }
    if (lumbar_ >= 0) p.q[lumbar_] = trunk - pelvis;
    const BodyShape& foot = *legs_[0].foot;
    const Pose X = linkPoses(human_.skeleton, p.q, p.root)[foot.link] * foot.X_LS;
    p.root.origin.z -= (X * lowestPoint(foot.shape, X.rotation)).z;
    return p;
  }

  /// The lean with which the centre of mass is where it belongs; kMostLean where none is enough.
  double leanAt(double s) const {
    if (s == 0) return 0;
    const double wanted = stands_at_ + s * (sits_at_ - stands_at_);
    const auto off = [&](double lean) {
      const Posture p = posture(s, lean, 0);
      return centreOfMass(human_, linkPoses(human_.skeleton, p.q, p.root), {}).x - wanted;
    };
    double lo = -0.2, hi = kMostLean;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (lo + hi);
      (off(middle) > 0 ? hi : lo) = middle;
    }
    return 0.5 * (lo + hi);
  }

  /// The lowest point of the pelvis while it straightens up.
  double seatHeight() const {
    double lowest = 1e9;
    const double lean = leanAt(1);
    for (const double straight : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Posture p = posture(1, lean, straight);
      const std::vector<Pose> X = linkPoses(human_.skeleton, p.q, p.root);
      for (const BodyShape& shape : human_.shapes) {
        if (shape.link != 0) continue;
        const Pose of = X[shape.link] * shape.X_LS;
        lowest = std::min(lowest, (of * lowestPoint(shape.shape, of.rotation)).z);
      }
    }
    return lowest;
  }

  /// The knees' deepest bend.
  void findDepth() {
    double lo = 40 * rad_per_deg, hi = std::min(human_.skeleton.joints[legs_[0].knee].upper, 125 * rad_per_deg);
    const auto heightAt = [&](double knee) {
      depth_ = knee;
      return seatHeight();
    };
    const double highest = heightAt(lo), lowest = heightAt(hi);
    if (!(options_.seat_height_m <= highest && options_.seat_height_m >= lowest))
      throw InputError({"", 0, "seat_height"},
                       std::to_string(options_.seat_height_m) + " m is not allowed for this body: " +
                           std::to_string(lowest) + " to " + std::to_string(highest));
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (lo + hi);
      (heightAt(middle) > options_.seat_height_m ? lo : hi) = middle;
    }
    depth_ = 0.5 * (lo + hi);
  }

  void checkLimits() const {
    for (const double straight : {0.0, 1.0})
      for (int i = 0; i <= kNodes; ++i) {
        const double s = static_cast<double>(i) / kNodes;
        if (straight > 0 && i < kNodes) continue;
        const Posture p = posture(s, path_.x[static_cast<std::size_t>(i)], straight);
        for (std::size_t j = 0; j < p.q.size(); ++j) {
          const Joint& joint = human_.skeleton.joints[j];
          if (joint.type == JointType::fixed || joint.mimic_of) continue;
          if (!(p.q[j] >= joint.lower - 1e-9 && p.q[j] <= joint.upper + 1e-9))
            throw InputError({"", 0, "seat_height"},
                             "sitting down takes the joint '" + joint.name + "' to " +
                                 std::to_string(p.q[j] / rad_per_deg) + " degrees, beyond its limit; allowed: a "
                                 "higher seat");
        }
      }
  }

  Human human_;
  SitOptions options_;
  Posture standing_;
  int lumbar_;
  std::array<Leg, 2> legs_{};  ///< right, left; feet point into human_
  Vec3 ankle_;                 ///< left, where it stays
  double hip_y_ = 0, stands_at_ = 0, sits_at_ = 0, depth_ = 0;
  HermitePath<double> path_;  ///< lean over how far down
};

}  // namespace

std::unique_ptr<Motion> makeSit(const Human& human, const SitOptions& o) {
  const auto check = [](const char* key, double value, bool good, const std::string& allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 60, "0 to 60");
  check("duration_s", o.duration_s, o.duration_s >= 1 && o.duration_s <= 60, "1 to 60");
  check("seat_height", o.seat_height_m, o.seat_height_m >= 0.2 && o.seat_height_m <= 0.8, "0.2 to 0.8");
  check("repeats", o.repeats, o.repeats >= 1 && o.repeats <= 100, "1 to 100");
  return std::make_unique<Sit>(human, o);
}

}  // namespace gambeson
