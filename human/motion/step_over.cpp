/// Walking up to an obstacle, over it and on. Feet and pelvis go prescribed ways; hips, knees and ankles follow
/// (human/motion/leg.hpp). A foot that stands rolls on the ground without slip, a foot that swings is carried to its
/// next place (human/motion/rolling_foot.hpp). The pelvis is as high as it can be with no knee of a standing leg
/// straighter than `soft`, smoothed. Over the obstacle knees stretch up to `softest`, the standing foot rises onto its
/// ball and the pelvis lifts the side that swings. The leg that leads is carried over in an arc while the pelvis stays
/// behind; the one that trails folds its knee behind and is turned out to its side, by bumps that are added to its
/// joints. Arcs and bumps are the least with which the feet clear the obstacle, and legs do as well as with the whole
/// of them; who would still be deep in the obstacle with a leg is refused. Arms and the pelvis's turns are those of
/// natural walking.
///
/// Nobody was recorded: ways, times and bumps were sought by hand and by random search such that feet clear 0.5 m,
/// thighs and shanks keep out of it as far as may be, and joints stay within their limits for all manikins.

#include "human/motion/step_over.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "human/files/units.hpp"
#include "human/motion/curve.hpp"
#include "human/motion/leg.hpp"
#include "human/motion/path.hpp"
#include "human/motion/rolling_foot.hpp"
#include "human/motion/rounded_line.hpp"
#include "human/motion/smooth_step.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk_curves.hpp"

namespace gambeson {
namespace {

// On the level. Lengths are over that of the leg, times over that of the stride, where no unit stands.
constexpr double soft = 10 * rad_per_deg, softest = 2 * rad_per_deg;     ///< least bend of knees that stand, that swing
constexpr double unlock_s = 0.4;                                         ///< in which knees bend from standing
constexpr double shift = 0.23;                                           ///< in which the weight goes onto one leg
constexpr double step = 0.72;                                            ///< from foot to foot
constexpr double double_support = 0.12, swing = 0.38, heel_rises = 0.3;  ///< before the foot is lifted
constexpr double heel_off = 28 * rad_per_deg, strike = 10 * rad_per_deg;  ///< pitch of the sole
constexpr double lift_m = 0.03;                                           ///< of the foot that swings
constexpr double ahead = 0.56;    ///< where the pelvis is between rear and front foot in double support
constexpr double sway = 0.15;     ///< of the pelvis, over the standing foot's distance to the side
constexpr double smooth = 0.073;  ///< over which the pelvis's height is smoothed, to both sides
constexpr double round_x = 0.14, round_y = 0.18, round_phase = 0.09, round_pitch = 0.045;  ///< likewise, of ways

// Over the obstacle.
/// From the toes of the foot before the obstacle to its front, and from its back to the heel of the foot beyond it.
constexpr double toes_before = 0.314, heel_beyond = 0.088;
constexpr double cross_off = 43.3 * rad_per_deg, raised = 27.3 * rad_per_deg;  ///< sole of the rear, the standing foot
constexpr double cross_strike = 3.7 * rad_per_deg;
constexpr double cross_ahead = 0.75, cross_sway = 0.37;
constexpr double tilt_back = 9 * rad_per_deg, hike = 16.4 * rad_per_deg;  ///< of the pelvis
constexpr double cross_slower = 2.2;   ///< time of its stride, over that on the level
constexpr double tall_m = 0.5;         ///< height from which on feet are pitched, and the trailing one waits, in full
constexpr double legs_clear_m = 0.01;  ///< of thighs, knees and shanks from the obstacle, where a leg can
constexpr double legs_touch_m = 2e-3;  ///< by which thighs may brush it
constexpr double arms_out = 15 * rad_per_deg;

/// A bump over the swing: rises from the first to the second part of it, falls from the third to the fourth.
struct Bump {
  double amount;
  std::array<double, 4> u;
  double at(double s) const {
    return amount * (smootherStep((s - u[0]) / (u[1] - u[0])) - smootherStep((s - u[2]) / (u[3] - u[2])));
  }
};

/// How a leg crosses, over the parts of its swing.
struct Crossing {
  std::array<double, 2> go;                     ///< when the foot goes forward
  Bump arc;                                     ///< its height, over that of the obstacle
  double more_m;                                ///< and what is added to it
  std::array<std::array<double, 2>, 3> pitch;   ///< of the sole [part, degrees]
  std::array<std::array<double, 2>, 2> pelvis;  ///< ahead of the standing ankle [part, over the leg's length]
  std::array<Bump, 5> joints;                   ///< added to LegAngles [degrees]
};
constexpr Bump none{0, {0, 0.5, 0.5, 1}};
constexpr std::array<Crossing, 2> crossings{
    Crossing{{0.017, 0.749},
             {1.027, {0.094, 0.559, 0.573, 1}},
             0.081,
             {{{0.267, -69.5}, {0.424, -18.4}, {0.798, -0.8}}},
             {{{0.478, -0.221}, {0.764, 0.57}}},
             {none, Bump{-2.4, {0.003, 0.512, 0.605, 0.996}}, Bump{6.6, {0.045, 0.356, 0.52, 0.975}}, none, none}},
    Crossing{{0.15, 0.989},
             {0.593, {0.038, 0.559, 0.585, 0.935}},
             0,
             {{{0.26, -29}, {0.418, -66.9}, {0.882, -0.9}}},
             {{{0.38, -0.154}, {0.824, 0.513}}},
             {Bump{3, {0.02, 0.17, 0.25, 0.5}}, Bump{-42.9, {0.007, 0.255, 0.551, 0.776}},
              Bump{6.5, {0.107, 0.394, 0.526, 0.815}}, Bump{30.4, {0.019, 0.253, 0.276, 0.968}},
              Bump{-12.8, {0.059, 0.382, 0.686, 0.938}}}}};

constexpr double node_s = 0.0025, coarse_s = 0.01;  ///< between the instants that are solved; while arcs are sought

/// One foot is carried on.
struct Step {
  int leg;            ///< 0: right, 1: left
  double begin, end;  ///< of the swing [s]
  double from, to;    ///< along x [m]
  bool over;
  double at(double t) const { return (t - begin) / (end - begin); }
};

/// Why a body cannot step over the obstacle.
struct TooHigh {
  std::string why;
};

class StepOver final : public Motion {
 public:
  /// `steps`: their length on the level, over that of our men. Throws TooHigh.
  StepOver(const Human& human, const StepOverOptions& options, double steps)
      : human_(human),
        options_(options),
        step_(steps * step),
        curves_(naturalWalk()),
        standing_(standing(human_)),
        legs_{legOf(human_, "right", "stepping over an obstacle"), legOf(human_, "left", "stepping over an obstacle")} {
    const Skeleton& s = human_.skeleton;
    for (const std::string side : {"right", "left"})
      arms_.push_back({s.joint("shoulder_flexion_" + side), s.joint("shoulder_abduction_" + side),
                       s.joint("elbow_flexion_" + side)});
    lumbar_ = {s.joint("lumbar_flexion"), s.joint("lumbar_bending"), s.joint("lumbar_rotation")};
    planSteps();
    planPelvis();
    for (int l = 0; l < 2; ++l) planPitch(l);
    clearHurdle();
    solveLegs(node_s);
    checkLimits();
    checkLegs();
  }

  double duration() const override { return duration_; }
  const Hurdle& hurdle() const { return hurdle_; }

  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration_), s = amplitude(t), phase = phase_.at(t);
    Posture p{standing_.q, pelvisAt(t)};
    p.root.origin.z = height_.at(t);
    const auto blend = [&](int joint, double value) {
      if (joint >= 0) p.q[joint] += s * (value - p.q[joint]);
    };
    for (int l = 0; l < 2; ++l) {
      legs_[l].set(legAt(l, t), p);
      const auto& [shoulder, out, elbow] = arms_[l];
      blend(shoulder, curves_.shoulder_flexion.at(phase + 0.5 * l));
      blend(elbow, curves_.elbow_flexion.at(phase + 0.5 * l));
      if (out >= 0) p.q[out] += arms_out * crossingAmplitude(t);
    }
    const Vec3 turn = pelvisTurn(t);
    const std::array<double, 3> of{turn.y, turn.x, turn.z};  // the trunk keeps upright
    for (int i = 0; i < 3; ++i)
      if (lumbar_[i] >= 0) p.q[lumbar_[i]] = -of[i];
    return p;
  }

 private:
  double length() const { return legs_[0].length_m(); }
  double strideTime(const Step& s) const { return (s.over ? cross_slower : 1) * options_.stride_time_s; }
  const Step& lead() const { return steps_[2 * options_.before]; }
  const Step& trail() const { return steps_[2 * options_.before + 1]; }

  /// Of the obstacle: over lower ones feet go as they do on the level.
  double tallness() const { return std::min(1.0, options_.height_m / tall_m); }

  void planSteps() {
    const std::vector<Pose> X = linkPoses(human_.skeleton, standing_.q, standing_.root);
    for (int l = 0; l < 2; ++l) ankle_[l] = X[legs_[l].foot->link].origin;
    const double half = std::get<Ellipsoid>(legs_[0].foot->shape).semi_axes.x, L = length();
    const double toes = (X[legs_[0].foot->link] * legs_[0].foot->X_LS).origin.x + half;
    const int count = 2 * (options_.before + 1 + options_.after);
    double t = options_.stand_s + unlock_s + shift * options_.stride_time_s;
    std::array<double, 2> place{};
    for (int k = 0; k < count; ++k) {
      Step s{k % 2, 0, 0, place[k % 2], place[1 - k % 2], k / 2 == options_.before};
      if (s.over && s.leg == 0) {
        hurdle_ = {toes + s.to + toes_before * L, options_.depth_m, options_.height_m};
        s.to += 2 * half + (toes_before + heel_beyond) * L + options_.depth_m;
      } else if (k + 1 < count) {
        s.to += step_ * L;
      }
      const double T = strideTime(s);
      s.begin = k > 0 ? t + double_support * T : t;
      s.end = t = s.begin + swing * T;
      place[s.leg] = s.to;
      steps_.push_back(s);
    }
    begin_ = options_.stand_s + unlock_s;
    end_ = t + shift * options_.stride_time_s;
    duration_ = end_ + unlock_s;
  }

  /// Where the pelvis goes over the feet, and the phase of arms and turns.
  void planPelvis() {
    std::vector<double> tx{begin_}, x{0}, ty{begin_}, y{0}, tp{begin_}, p{0.5};
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const Step& s = steps_[k];
      const double stance = k > 0 ? steps_[k - 1].to : 0, middle = 0.5 * (s.begin + s.end);
      if (k > 0)
        tx.push_back(0.5 * (steps_[k - 1].end + s.begin)),
            x.push_back(s.from + (s.over && s.leg == 1 ? cross_ahead : ahead) * (stance - s.from));
      if (s.over)
        for (const auto& [u, of_leg] : crossings[s.leg].pelvis)
          tx.push_back(s.begin + u * (s.end - s.begin)), x.push_back(stance + of_leg * length());
      else if (k > 0 && k + 1 < steps_.size())
        tx.push_back(middle), x.push_back(stance);
      ty.push_back(middle), y.push_back((s.over ? cross_sway : sway) * ankle_[1 - s.leg].y);
      tp.push_back(s.end), p.push_back(1 + 0.5 * static_cast<double>(k));
    }
    tx.push_back(end_), x.push_back(steps_.back().to), ty.push_back(end_), y.push_back(0);
    const double T = options_.stride_time_s;
    x_ = {tx, x, round_x * T}, y_ = {ty, y, round_y * T}, phase_ = {tp, p, round_phase * T};
  }

  void planPitch(int l) {
    std::vector<double> t{0}, pitch{0};
    const auto add = [&](double time_s, double angle) { t.push_back(time_s), pitch.push_back(angle); };
    for (std::size_t k = 0; k < steps_.size(); ++k) {
      const Step& s = steps_[k];
      const double in = s.end - s.begin;
      if (s.leg != l) {
        if (s.over) add(s.begin, 0), add(s.begin + 0.3 * in, -raised);
        continue;
      }
      if (k == 0)
        add(begin_, 0);
      else if (!steps_[k - 1].over)
        add(s.begin - heel_rises * strideTime(s), 0);
      add(s.begin + 0.1 * in, -(k == 0 ? 0.5 * heel_off : s.over && l == 1 ? cross_off : heel_off));
      if (s.over)
        for (const auto& [u, degrees] : crossings[l].pitch) {
          const double level = l == 0 ? strike : 0;
          add(s.begin + u * in, level + tallness() * (degrees * rad_per_deg - level));
        }
      add(s.end, k + 2 >= steps_.size() ? 0 : s.over && l == 0 ? cross_strike : strike);
      add(s.end + 0.8 * double_support * options_.stride_time_s, 0);
    }
    pitch_[l] = {t, pitch, round_pitch * options_.stride_time_s};
  }

  /// Of arms and turns of the pelvis.
  double amplitude(double t) const {
    const double in = steps_.front().end, out = steps_.back().begin;
    return smootherStep((t - options_.stand_s) / (in - options_.stand_s)) - smootherStep((t - out) / (end_ - out));
  }
  /// Least bend of knees that stand.
  double softAt(double t) const {
    return soft - (soft - softest) * (smootherStep(2 * lead().at(t)) - smootherStep(2 * trail().at(t) - 1));
  }
  double crossingAmplitude(double t) const {
    return smootherStep(2 * lead().at(t)) - smootherStep(2 * trail().at(t) - 1);
  }
  /// Roll, pitch and yaw of the pelvis.
  Vec3 pelvisTurn(double t) const {
    const double s = amplitude(t), p = phase_.at(t), u = lead().at(t), v = trail().at(t);
    const double right = smootherStep((u + 0.05) / 0.35) - smootherStep((u - 0.5) / 0.4),
                 left = smootherStep((v - 0.1) / 0.35) - smootherStep((v - 0.5) / 0.4);
    return {s * curves_.pelvis_roll.at(p) + hike * (left - right), s * curves_.pelvis_pitch.at(p) - tilt_back * right,
            s * curves_.pelvis_yaw.at(p)};
  }
  /// The height is left at 0.
  Pose pelvisAt(double t) const { return {rotationOf(pelvisTurn(t)), {x_.at(t), y_.at(t), 0}}; }

  FootGoal goalAt(int l, double t) const {
    FootGoal g{pitch_[l].at(t), {}};
    const Crossing& c = crossings[l];
    const double waits = tallness() * c.go[0];
    for (const Step& s : steps_) {
      if (s.leg != l) continue;
      const double u = s.at(t);
      g.way.x += (s.to - s.from) * smootherStep(s.over ? (u - waits) / (c.go[1] - waits) : u);
      g.way.z += lift_m * smoothBump(u);
      if (s.over) g.way.z += share_[l] * (options_.height_m + c.more_m / c.arc.amount) * c.arc.at(u);
    }
    return g;
  }

  /// The highest pelvis with which a leg's knee is bent by `knee`.
  double highest(int l, const Pose& pelvis, const Vec3& ankle, double knee) const {
    const double reach = norm(legs_[l].knee_T + rotationAbout({0, 1, 0}, knee) * legs_[l].ankle_S);
    const Vec3 hip = pelvis.rotation * legs_[l].hip_P;
    const double dx = ankle.x - pelvis.origin.x - hip.x, dy = ankle.y - pelvis.origin.y - hip.y;
    const double up2 = reach * reach - dx * dx - dy * dy;
    if (!(up2 > 0)) tooFar();
    return ankle.z + std::sqrt(up2) - hip.z;
  }
  [[noreturn]] static void tooFar() {
    throw InputError({"", 0, "human"}, "stepping over an obstacle: the legs are too short for its steps");
  }

  /// Feet and pelvis depend on each other a little, by the feet's roll: they are found in turns.
  void solveLegs(double every_s) {
    const int n = static_cast<int>(std::ceil(duration_ / every_s));
    const double h = duration_ / n;
    std::vector<Pose> pelvis;
    std::array<std::vector<FootGoal>, 2> goals;
    for (int i = 0; i <= n; ++i) {
      pelvis.push_back(pelvisAt(i * h));
      pelvis.back().origin.z = standing_.root.origin.z;
      for (int l = 0; l < 2; ++l) goals[l].push_back(goalAt(l, i * h));
    }
    std::array<std::vector<Vec3>, 2> ankles;
    constexpr int turns = 5;
    for (int turn = 0; turn < turns; ++turn) {
      for (int l = 0; l < 2; ++l) {
        ankles[l] = rolledAnkles(legs_[l], pelvis, goals[l], ankle_[l]);
        // A foot that rolls to the side as it pitches drifts by some tenths of a millimetre: its last step takes that
        // back, so that it ends beside the other.
        const Step& last = steps_[steps_.size() - 2 + static_cast<std::size_t>(l)];
        const Vec3 drift = ankles[l].back() - ankle_[l] - Vec3{last.to, 0, 0};
        for (int i = 0; i <= n; ++i) goals[l][i].way -= smootherStep(last.at(i * h)) * Vec3{drift.x, drift.y, 0};
      }
      std::vector<double> most(pelvis.size()), straighter(pelvis.size());
      for (int i = 0; i <= n; ++i) {
        most[i] = std::numeric_limits<double>::infinity();
        for (int l = 0; l < 2; ++l)
          most[i] = std::min(most[i],
                             highest(l, pelvis[i], ankles[l][i], goals[l][i].way.z > 1e-3 ? softest : softAt(i * h)));
        const double bent =
            smootherStep((i * h - options_.stand_s) / unlock_s) - smootherStep((i * h - end_) / unlock_s);
        if (bent < 1)
          straighter[i] = highest(0, pelvis[i], ankles[0][i], bent * soft) - highest(0, pelvis[i], ankles[0][i], soft);
      }
      const std::vector<double> z = smoothBelow(most, static_cast<int>(std::ceil(smooth * options_.stride_time_s / h)));
      for (int i = 0; i <= n; ++i) pelvis[i].origin.z = z[i] + straighter[i];
    }
    height_ = {h, {}, {}};
    for (const Pose& p : pelvis) height_.x.push_back(p.origin.z);
    height_.v = slopesOf(height_.x, h);
    for (int l = 0; l < 2; ++l) {
      path_[l].fill({h, {}, {}});
      for (int i = 0; i <= n; ++i) {
        const auto q = reach(human_, legs_[l], pelvis[i], ankles[l][i], goals[l][i].pitch);
        if (!q) tooFar();
        for (std::size_t k = 0; k < q->size(); ++k) path_[l][k].x.push_back((*q)[k]);
      }
      for (auto& path : path_[l]) path.v = slopesOf(path.x, h);
    }
  }

  /// A smooth course that is nowhere above another: its lowest value within `reach` instants to both sides, averaged
  /// over as many.
  static std::vector<double> smoothBelow(const std::vector<double>& most, int reach) {
    const int n = static_cast<int>(most.size());
    std::vector<double> low(most.size()), z(most.size());
    for (int i = 0; i < n; ++i)
      low[i] = *std::min_element(most.begin() + std::max(0, i - reach), most.begin() + std::min(n, i + reach + 1));
    for (int i = 0; i < n; ++i) {
      double sum = 0, weights = 0;
      for (int k = -reach; k <= reach; ++k) {
        const double weight = smoothBump(0.5 * (1 + static_cast<double>(k) / (reach + 1)));
        sum += weight * low[std::clamp(i + k, 0, n - 1)], weights += weight;
      }
      z[i] = sum / weights;
    }
    return z;
  }

  LegAngles legAt(int l, double t) const {
    LegAngles q{};
    const double u = std::clamp((l == 0 ? lead() : trail()).at(t), 0.0, 1.0);
    for (std::size_t k = 0; k < q.size(); ++k)
      q[k] = path_[l][k].at(t) + share_[l] * rad_per_deg * crossings[l].joints[k].at(u);
    return q;
  }

  /// The smallest distances of a foot, and of its thigh, knee and shank, from the obstacle while it crosses.
  struct Clearance {
    double foot = std::numeric_limits<double>::infinity(), leg = foot;
  };
  Clearance clearanceOf(int l) const {
    const Step& s = l == 0 ? lead() : trail();
    const auto& joints = legs_[l].joints;
    const int thigh = human_.skeleton.joints[joints[2]].child, shank = human_.skeleton.joints[joints[3]].child;
    Clearance least;
    constexpr int n = 150;
    for (int i = 0; i <= n; ++i) {
      const Posture p = at(s.begin + (s.end - s.begin) * i / n);
      const std::vector<Pose> X = linkPoses(human_.skeleton, p.q, p.root);
      for (const BodyShape& shape : human_.shapes) {
        const bool foot = shape.name == legs_[l].foot->name;
        if (!foot && shape.link != thigh && shape.link != shank) continue;
        double& gap = foot ? least.foot : least.leg;
        gap = std::min(gap, gapToHurdle(shape.shape, X[shape.link] * shape.X_LS, hurdle_));
      }
    }
    return least;
  }

  /// The smallest shares of arcs and bumps with which the feet clear the obstacle, and legs as far as they can.
  void clearHurdle() {
    constexpr double spare_m = 1e-3;  // of instants between those that are looked at
    constexpr double lost_m = 2e-3;   // that a leg which is in it anyway may go deeper
    const double wanted = options_.clearance_m + spare_m;
    for (int l = 0; l < 2; ++l) {
      const auto clearance = [&](double share) {
        share_[l] = share;
        solveLegs(coarse_s);
        return clearanceOf(l);
      };
      const Clearance most = clearance(1);
      if (!(most.foot >= wanted))
        throw TooHigh{fmt::format("a foot would pass it at {:.0f} mm and is to keep {:.0f} mm off", 1e3 * most.foot,
                                  1e3 * options_.clearance_m)};
      const double leg = std::min(legs_clear_m, most.leg - lost_m);
      double lo = 0, hi = 1;
      while (hi - lo > 0.01) {
        const double share = 0.5 * (lo + hi);
        const Clearance c = clearance(share);
        (c.foot >= wanted && c.leg >= leg ? hi : lo) = share;
      }
      share_[l] = hi;
    }
  }

  /// Thighs, knees and shanks, also of the leg that stands while the other one crosses.
  void checkLegs() const {
    constexpr double every_s = 0.01;
    double gap = std::numeric_limits<double>::infinity();
    for (double t = lead().begin; t < trail().end; t += every_s) {
      const Posture p = at(t);
      const std::vector<Pose> X = linkPoses(human_.skeleton, p.q, p.root);
      for (const BodyShape& shape : human_.shapes)
        for (const Leg& leg : legs_)
          if (shape.link == human_.skeleton.joints[leg.joints[2]].child ||
              shape.link == human_.skeleton.joints[leg.joints[3]].child)
            gap = std::min(gap, gapToHurdle(shape.shape, X[shape.link] * shape.X_LS, hurdle_));
    }
    if (!(gap >= -legs_touch_m))
      throw TooHigh{fmt::format("a thigh, knee or shank would be {:.0f} mm in it", -1e3 * gap)};
  }

  void checkLimits() const {
    for (int l = 0; l < 2; ++l)
      for (std::size_t i = 0; i < height_.x.size(); ++i) {
        const LegAngles q = legAt(l, static_cast<double>(i) * height_.step_s);
        for (std::size_t k = 0; k < q.size(); ++k) {
          const Joint& joint = human_.skeleton.joints[legs_[l].joints[k]];
          if (!(q[k] >= joint.lower - 1e-9 && q[k] <= joint.upper + 1e-9))
            throw TooHigh{fmt::format("it takes the joint '{}' to {:.1f} degrees, beyond its limit", joint.name,
                                      q[k] / rad_per_deg)};
        }
      }
  }

  Human human_;
  StepOverOptions options_;
  double step_;  ///< on the level, from foot to foot, over the length of the leg
  WalkCurves curves_;
  Posture standing_;
  std::array<Leg, 2> legs_;               ///< right, left; feet point into human_
  std::vector<std::array<int, 3>> arms_;  ///< shoulder's flexion and abduction, elbow; -1 where there is none
  std::array<int, 3> lumbar_{};           ///< flexion, bending, rotation; likewise
  std::array<Vec3, 2> ankle_;             ///< standing
  std::vector<Step> steps_;
  double begin_ = 0, end_ = 0, duration_ = 0;  ///< when the knees have bent, when they begin to straighten
  RoundedLine x_, y_, phase_;                  ///< of the pelvis; of a stride of natural walking
  std::array<RoundedLine, 2> pitch_;
  Hurdle hurdle_;
  std::array<double, 2> share_{1, 1};  ///< of arcs and bumps
  HermitePath<double> height_;         ///< of the pelvis
  std::array<std::array<HermitePath<double>, 5>, 2> path_;
};

constexpr double lowest_m = 0.05;  ///< that options may have

/// The largest height that the body steps over [m], to a centimetre; none where it is below what options may have.
std::optional<double> largestHeight(const Human& human, StepOverOptions o, double steps) {
  double lo = 0, hi = o.height_m;
  while (hi - lo > 0.01) {
    o.height_m = std::max(lowest_m, 0.5 * (lo + hi));
    try {
      const StepOver possible(human, o, steps);
      lo = o.height_m;
    } catch (const TooHigh&) {
      if (o.height_m == lowest_m) return std::nullopt;
      hi = o.height_m;
    }
  }
  return lo;
}

/// A body whose ankles or knees do not bear the steps of our men takes shorter ones, the longest with which it steps
/// over anything.
std::unique_ptr<StepOver> stepOver(const Human& human, const StepOverOptions& o) {
  std::string why;
  for (const double steps : {1.0, 0.95, 0.9, 0.85, 0.8, 0.7, 0.6}) {
    try {
      return std::make_unique<StepOver>(human, o, steps);
    } catch (const TooHigh& e) {
      if (why.empty()) why = e.why;
      if (const std::optional<double> largest = largestHeight(human, o, steps))
        throw InputError({"", 0, "height"},
                         fmt::format("{} m is not allowed for this body: {}; allowed: up to {:.2f} m", o.height_m,
                                     e.why, std::floor(100 * *largest) / 100));
    }
  }
  throw InputError({"", 0, "height"}, fmt::format("{} m is not allowed for this body: {}; allowed: another body, of "
                                                  "longer legs",
                                                  o.height_m, why));
}

}  // namespace

std::unique_ptr<Motion> makeStepOver(const Human& human, const StepOverOptions& o, Hurdle* hurdle) {
  const auto check = [](const char* key, double value, bool good, const char* allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600");
  check("before", o.before, o.before >= 1 && o.before <= 1000, "1 to 1000");
  check("after", o.after, o.after >= 1 && o.after <= 1000, "1 to 1000");
  check("height", o.height_m, o.height_m >= 0.05 && o.height_m <= 1, "0.05 to 1");
  check("depth", o.depth_m, o.depth_m >= 0 && o.depth_m <= 0.1, "0 to 0.1");
  check("clearance", o.clearance_m, o.clearance_m >= 0 && o.clearance_m <= 0.1, "0 to 0.1");
  check("stride_time_s", o.stride_time_s, o.stride_time_s >= 0.5 && o.stride_time_s <= 10, "0.5 to 10");
  auto motion = stepOver(human, o);
  if (hurdle) *hurdle = motion->hurdle();
  return motion;
}

}  // namespace gambeson
