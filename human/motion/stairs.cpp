/// Climbing stairs. Hip angles follow the curves of human/motion/walk_curves.hpp exactly. The pelvis goes where the leg
/// takes it that carries: its foot, an ellipsoid, rolls on its tread without slip. Shortly before the other foot
/// strikes, the velocity passes smoothly to what that foot will give, so from foot strike on the new leg moves as the
/// data say; the rear foot stays on its tread until foot off, by its knee, ankle and adduction (inverse kinematics),
/// and what that changes dies out in the swing. The knee comes to rest on foot strike, so the foot lands softly. In the
/// swing knee and ankle flex as much more as the feet need to clear the steps. Rise and tread of the stairs are those
/// of the steps.

#include "human/motion/stairs.hpp"

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

/// Phases, of a leg since its own foot strike or of the stride.
constexpr double pass = 0.06;             ///< before a foot strike the velocity passes to the new leg
constexpr double settled = 0.12;          ///< after foot off the correction has died out
constexpr double landing = 0.90;          ///< from here to foot strike the knee comes to rest
constexpr double unlanding[2]{0.3, 0.4};  ///< back to the data, where the curves differ by less than 1e-4 rad
constexpr double lift[2]{0.78, 1.0};      ///< knee and ankle flex more to clear the steps
constexpr double knee_share = 0.3;        ///< of the knee in that
/// Parts of the lead-in after which the standing leg, and the hip of the leg that steps up, have come to full
/// amplitude.
constexpr double full = 0.85, hip_full = 0.7;

constexpr double clearance_m = 0.010;  ///< of the swinging foot from the steps at its middle
constexpr double sink_m = 5e-5;        ///< that a foot may sink at its strike
constexpr double heel_m = 0.010;       ///< from a tread's edge to the rear end of the foot that strikes
constexpr double most_lift = 30 * rad_per_deg;

/// What inverse kinematics adds to a leg.
using Correction = Vec3;  ///< knee, ankle, adduction [rad]

struct Leg {
  int flexion, adduction, rotation, knee, ankle, shoulder, elbow;  ///< joints; the arm's may be -1
  double shift;                                                    ///< phase of the stride at which it strikes
  const BodyShape* foot;
};

class Climb final : public Motion {
 public:
  Climb(const Human& human, const StairOptions& options)
      : human_(human), options_(options), curves_(stairAscent()), arms_(naturalWalk()), standing_(standing(human)) {
    for (const bool right : {true, false}) {
      const std::string side = right ? "right" : "left";
      const auto joint = [&](const char* name, bool needed = true) {
        const int j = human_.skeleton.joint(std::string(name) + "_" + side);
        if (j < 0 && needed)
          throw InputError({"", 0, "human"}, std::string("stairs need the joint '") + name + "_" + side + "'");
        return j;
      };
      legs_[right ? 0 : 1] = {
          joint("hip_flexion"),          joint("hip_adduction"), joint("hip_rotation"),
          joint("knee_flexion"),         joint("ankle_flexion"), joint("shoulder_flexion", false),
          joint("elbow_flexion", false), right ? 0.0 : 0.5,      &footOf(human_, side, "climbing stairs")};
    }
    lumbar_ = {human_.skeleton.joint("lumbar_flexion"), human_.skeleton.joint("lumbar_bending"),
               human_.skeleton.joint("lumbar_rotation")};
    lead_in_ = integrate(0, options_.lead_in_s, standing_.root.origin);
    stride_ = integrate(options_.lead_in_s, options_.stride_time_s, lead_in_.x.back());
    holdRearFoot();
    placeStairs();
    clearSteps();
  }

  double duration() const override {
    return options_.stand_s + options_.lead_in_s + options_.strides * options_.stride_time_s;
  }
  std::optional<Stairs> stairs() const override { return stairs_; }
  Vec3 meanVelocity() const { return (stride_.x.back() - stride_.x.front()) / options_.stride_time_s; }
  Posture at(double time_s) const override { return stepping(std::clamp(time_s, 0.0, duration()) - options_.stand_s); }

 private:
  double phase(double t) const {
    const double T = options_.stride_time_s, L = options_.lead_in_s;
    return t > L ? (t - L) / T : (smootherArea(t / L) - 0.5) * L / T;
  }
  double ownPhase(const Leg& leg, double t) const {
    const double p = phase(t) - leg.shift;
    return p - std::floor(p);
  }

  double kneeAt(double p) const {
    const double landed = p < 0.5 ? 1 - smootherStep((p - unlanding[0]) / (unlanding[1] - unlanding[0]))
                                  : smootherStep((p - landing) / (1 - landing));
    return landed * curves_.knee_flexion_landed.at(p) + (1 - landed) * curves_.knee_flexion.at(p);
  }

  Correction correctionAt(double p) const {
    Correction c;
    const double begin = 0.5 - pass;
    if (!rear_.x.empty() && p > begin && p < begin + rear_.step_s * static_cast<double>(rear_.x.size() - 1))
      c = rear_.at(p - begin);
    const double bump = lift_ * smoothBump((p - lift[0]) / (lift[1] - lift[0]));
    return c + Vec3{knee_share * bump, bump, 0};
  }

  /// Joints and orientation of the root; its origin is left at 0. `landed`: a leg whose knee moves as if its foot had
  /// struck already; `corrected`: with what inverse kinematics adds.
  Posture postureAt(double t, bool corrected, int landed = -1) const {
    const double L = options_.lead_in_s, p = phase(t), s = smootherStep(t / (full * L));
    Posture posture{standing_.q, {}};
    for (int l = 0; l < 2; ++l) {
      const Leg& leg = legs_[l];
      const double own = ownPhase(leg, t);
      const bool steps_up = l == 0 && t < L && landed != 0;
      const double hip = steps_up ? smootherStep(t / (hip_full * L)) : s, rest = steps_up ? smootherStep(t / L) : s;
      const Correction c = corrected ? correctionAt(own) : Correction{};
      const auto blend = [&](int joint, double amplitude, double value) {
        if (joint >= 0) posture.q[joint] += amplitude * (value - posture.q[joint]);
      };
      blend(leg.flexion, hip, curves_.hip_flexion.at(own));
      blend(leg.adduction, rest, curves_.hip_adduction.at(own) - held_hip_abduction_rad + c.z);
      blend(leg.rotation, rest, curves_.hip_rotation.at(own));
      blend(leg.knee, rest, (l == landed ? curves_.knee_flexion_landed.at(own) : kneeAt(own)) + c.x);
      blend(leg.ankle, rest, curves_.ankle_flexion.at(own) + c.y);
      blend(leg.shoulder, s, arms_.shoulder_flexion.at(own));
      blend(leg.elbow, s, arms_.elbow_flexion.at(own));
      if (steps_up && corrected) {
        const double bump = first_lift_ * smoothBump(t / L);
        posture.q[leg.knee] += knee_share * bump;
        posture.q[leg.ankle] += bump;
      }
    }
    const double yaw = s * curves_.pelvis_yaw.at(p), roll = s * curves_.pelvis_roll.at(p),
                 pitch = s * curves_.pelvis_pitch.at(p);
    posture.root.rotation =
        rotationAbout({0, 0, 1}, yaw) * rotationAbout({1, 0, 0}, roll) * rotationAbout({0, 1, 0}, pitch);
    const std::array<double, 3> turn{pitch, roll, yaw};  // the trunk keeps upright
    for (int i = 0; i < 3; ++i)
      if (lumbar_[i] >= 0) posture.q[lumbar_[i]] = -turn[i];
    return posture;
  }

  /// The motion from the lead-in on.
  Posture stepping(double t) const {
    Posture p = postureAt(t, true);
    if (t <= options_.lead_in_s) {
      p.root.origin = lead_in_.at(std::max(t, 0.0));
    } else {
      const double T = options_.stride_time_s, walked = t - options_.lead_in_s;
      const int k = std::min(static_cast<int>(walked / T), options_.strides - 1);
      p.root.origin = stride_.at(walked - k * T) + k * (stride_.x.back() - stride_.x.front());
    }
    return p;
  }

  Pose footPose(const BodyShape& foot, const Posture& p) const {
    return linkPoses(human_.skeleton, p.q, p.root)[foot.link] * foot.X_LS;
  }

  /// Velocity that a foot at rest gives the pelvis: minus that of the foot's lowest point relative to it, by central
  /// differences.
  Vec3 velocityOn(int l, double t, int landed = -1) const {
    constexpr double h = 1e-5;
    const BodyShape& foot = *legs_[l].foot;
    const Pose now = footPose(foot, postureAt(t, false, landed)),
               before = footPose(foot, postureAt(t - h, false, landed)),
               after = footPose(foot, postureAt(t + h, false, landed));
    const Vec3 low = lowestPoint(foot.shape, now.rotation);
    return (before * low - after * low) / (2 * h);
  }

  Vec3 velocityAt(double t) const {
    const double p = phase(t) - std::floor(phase(t));
    const int stance = p < 0.5 ? 0 : 1;
    const double w = smootherStep((std::fmod(p, 0.5) - (0.5 - pass)) / pass);
    Vec3 v = (1 - w) * velocityOn(stance, t);
    if (w > 0) v += w * velocityOn(1 - stance, t, 1 - stance);
    return v;
  }

  HermitePath<Vec3> integrate(double begin, double length, const Vec3& x) const {
    return integrated(begin, length, x, [this](double t) { return velocityAt(t); });
  }

  /// The right foot from `pass` before the left one strikes until foot off: its lowest point stays at the tread's
  /// height and does not slip. From one instant to the next the point of the foot midway between both lowest ones keeps
  /// its x and y (second order).
  void holdRearFoot() {
    const Leg& leg = legs_[0];
    const double begin = 0.5 - pass, T = options_.stride_time_s;
    const int n = static_cast<int>(std::ceil((curves_.foot_off - begin) * 600));
    const double step = (curves_.foot_off - begin) / n;
    const auto pose = [&](double p, const Correction& c) {
      Posture posture = postureAt(options_.lead_in_s + p * T, false);
      posture.q[leg.knee] += c.x;
      posture.q[leg.ankle] += c.y;
      posture.q[leg.adduction] += c.z;
      posture.root.origin = stride_.at(p * T);
      return footPose(*leg.foot, posture);
    };
    Pose last = pose(begin, {});
    Vec3 last_low = lowestPoint(leg.foot->shape, last.rotation);
    const double height = (last * last_low).z;
    std::vector<Correction> c{{}};
    for (int i = 1; i <= n; ++i) {
      const double p = begin + i * step;
      const auto residual = [&](const Correction& x) {
        const Pose X = pose(p, x);
        const Vec3 low = lowestPoint(leg.foot->shape, X.rotation), middle = 0.5 * (low + last_low);
        Vec3 r = X * middle - last * middle;
        r.z = (X * low).z - height;
        return r;
      };
      Correction x = i > 1 ? 2 * c[i - 1] - c[i - 2] : c[0];
      Vec3 r = residual(x);
      for (int k = 0; k < 20 && norm(r) > 1e-13; ++k) {
        constexpr double h = 1e-6;
        const Vec3 a = (residual(x + Vec3{h, 0, 0}) - r) / h, b = (residual(x + Vec3{0, h, 0}) - r) / h,
                   d = (residual(x + Vec3{0, 0, h}) - r) / h;
        const double det = dot(a, cross(b, d));
        x -= Vec3{dot(r, cross(b, d)), dot(a, cross(r, d)), dot(a, cross(b, r))} / det;
        r = residual(x);
      }
      if (!(norm(r) < 1e-9))
        throw RunError("stairs: the rear leg does not reach its tread at " + std::to_string(100 * p) +
                       " % of the stride");
      c.push_back(x);
      last = pose(p, x);
      last_low = lowestPoint(leg.foot->shape, last.rotation);
    }
    rear_ = {step, c, slopesOf(c, step)};
    rear_.v[0] = {};
    const int m = static_cast<int>(std::ceil(settled / step));
    for (int i = 1; i <= m; ++i) {
      const double u = static_cast<double>(i) / m, w = 1 - u;
      const Correction x = rear_.x[n], v = m * step * rear_.v[n];
      rear_.x.push_back(w * w * ((1 + 2 * u) * x + u * v));
      rear_.v.push_back((-6 * u * w * x + w * (1 - 3 * u) * v) / (m * step));
    }
  }

  void placeStairs() {
    const double t = options_.lead_in_s;
    const BodyShape& foot = *legs_[0].foot;
    const Vec3 step = 0.5 * (stride_.x.back() - stride_.x.front());
    const Pose X = footPose(foot, stepping(t));
    const Vec3 l = transposeTimes(X.rotation, {1, 0, 0}), a = std::get<Ellipsoid>(foot.shape).semi_axes;
    const double heel = X.origin.x - norm({a.x * l.x, a.y * l.y, a.z * l.z});
    stairs_ = {step.z, step.x, heel - heel_m};
  }

  /// The smallest extra flexion with which the foot clears the steps: in the swing, then in the lead-in.
  void clearSteps() {
    const double T = options_.stride_time_s, L = options_.lead_in_s;
    const BodyShape& foot = *legs_[0].foot;
    const auto clears = [&](double begin, double end) {
      constexpr int n = 100;
      for (int i = 1; i < n; ++i) {
        const double u = static_cast<double>(i) / n;
        if (gapTo(foot.shape, footPose(foot, stepping(begin + u * (end - begin))), stairs_) <
            clearance_m * smoothBump(u) - sink_m)
          return false;
      }
      return true;
    };
    const auto least = [&](double& lifted, double begin, double end, const char* when) {
      double lo = 0, hi = most_lift;
      lifted = lo;
      if (clears(begin, end)) return;
      lifted = hi;
      if (!clears(begin, end)) throw RunError(std::string("stairs: the foot does not clear the steps ") + when);
      while (hi - lo > 1e-4) {
        lifted = 0.5 * (lo + hi);
        (clears(begin, end) ? hi : lo) = lifted;
      }
      lifted = hi;
    };
    least(lift_, L + curves_.foot_off * T, L + T, "in the swing");
    least(first_lift_, 0, L, "in the lead-in");
  }

  Human human_;
  StairOptions options_;
  StairCurves curves_;
  WalkCurves arms_;
  Posture standing_;
  std::array<Leg, 2> legs_{};  ///< right, left; feet point into human_
  std::array<int, 3> lumbar_{};
  HermitePath<Vec3> lead_in_, stride_;
  HermitePath<Correction> rear_;  ///< over the phase since 0.5 - pass
  double lift_ = 0, first_lift_ = 0;
  std::optional<Stairs> stairs_;
};

}  // namespace

std::unique_ptr<Motion> makeStairs(const Human& human, const StairOptions& o, Vec3* mean_velocity) {
  const auto check = [](const char* key, double value, bool good, const std::string& allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600");
  check("stride_time_s", o.stride_time_s, o.stride_time_s >= 0.5 && o.stride_time_s <= 10, "0.5 to 10");
  check("lead_in_s", o.lead_in_s, o.lead_in_s >= 0.4 * o.stride_time_s && o.lead_in_s <= 0.7 * o.stride_time_s,
        "0.4 to 0.7 of the stride's time");
  check("strides", o.strides, o.strides >= 1 && o.strides <= 100000, "1 to 100000");
  check("lead_in_strides", o.lead_in_strides, o.lead_in_strides >= 0 && o.lead_in_strides < o.strides,
        "0 to one less than the strides");
  auto climb = std::make_unique<Climb>(human, o);
  if (mean_velocity) *mean_velocity = climb->meanVelocity();
  return climb;
}

}  // namespace gambeson
