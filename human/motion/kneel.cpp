/// Taking aim on one knee, from human/data/kneel.json. Trunk, neck, arms and the pelvis's way go from start to end with
/// minimum jerk; the legs follow (human/motion/leg.hpp). The right foot stays and rolls without slip over its ball onto
/// its instep; the left foot steps forward, level. At the end the right hip's flexion and abduction and both ankles are
/// those of the data and the right knee lies on the ground: that says how far pelvis, left foot and right heel go, by
/// Newton's method. The knees and the left hip come out. Feet point ahead: the data's rotations of the hips, 5 degrees
/// outward at both ends, are left out. Arms that may not go where the data have them go as near as they may. He gets up
/// the same way back.

#include "human/motion/kneel.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/files/data.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/leg.hpp"
#include "human/motion/path.hpp"
#include "human/motion/rolling_foot.hpp"
#include "human/motion/smooth_step.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk_curves.hpp"
#include "human/skeleton/within.hpp"

namespace gambeson {
namespace {

constexpr double step_begin = 0.05, step_end = 0.8;  ///< when the left foot is in the air, of the way down
constexpr double step_height_m = 0.05;               ///< of the left foot at the middle of its step
constexpr int nodes = 400;

/// How far things go on the way down: pelvis forward, to the left and down [m], the right sole's pitch [rad], the left
/// foot forward [m].
using Way = Eigen::Matrix<double, 5, 1>;

class Kneel final : public Motion {
 public:
  Kneel(const Human& human, const KneelOptions& options)
      : human_(human),
        options_(options),
        standing_(standing(human_)),
        legs_{legOf(human_, "right", "kneeling"), legOf(human_, "left", "kneeling")} {
    const nlohmann::json data = nlohmann::json::parse(data::kneel);
    const nlohmann::json &start = data.at("start_low_ready"), &end = data.at("end_high_kneel");
    const auto drive = [&](const std::string& joint, const std::string& key) {
      const int j = human_.skeleton.joint(joint);
      const auto of = [&](const nlohmann::json& posture) {
        return within(human_.skeleton.joints[j], rad_per_deg * posture.at(key).get<double>());
      };
      if (j >= 0) drives_.push_back({j, of(start), of(end)});
    };
    drive("lumbar_flexion", "lumbar_flexion");
    drive("neck_flexion", "neck_flexion");
    for (const auto& [side, letter] : {std::pair{"right", "R"}, {"left", "L"}})
      for (const char* joint : {"shoulder_flexion", "shoulder_abduction", "elbow_flexion"})
        drive(std::string(joint) + "_" + side, std::string(joint) + "_" + letter);
    const auto angle = [&](const nlohmann::json& of, const char* key) {
      return rad_per_deg * of.at(key).get<double>();
    };
    const double zero = pelvisZero_deg() * rad_per_deg;
    pitch_ = {0, zero - angle(start, "pelvis_tilt"), zero - angle(end, "pelvis_tilt")};
    placeStart(angle(start, "hip_flexion_R"), angle(start, "ankle_dorsi_R"));
    findWay({angle(end, "hip_flexion_R"), -angle(end, "hip_abduction_R"), angle(end, "ankle_dorsi_R"),
             angle(end, "ankle_dorsi_L"), 0});
  }

  double duration() const override {
    return options_.stand_s + options_.duration_s +
           (options_.rise_s > 0 ? options_.hold_s + options_.rise_s : options_.hold_s);
  }
  Posture at(double time_s) const override {
    const double t = std::clamp(time_s, 0.0, duration()) - options_.stand_s,
                 up = t - options_.duration_s - options_.hold_s;
    const double u = options_.rise_s > 0 && up > 0 ? 1 - up / options_.rise_s : t / options_.duration_s;
    return postureAt(std::clamp(u, 0.0, 1.0));
  }

 private:
  struct Drive {
    int joint;
    double begin, end;
    double at(double s) const { return begin + s * (end - begin); }
  };

  Pose pelvisAt(double s, const Way& way) const {
    return {rotationAbout({0, 1, 0}, pitch_.at(s)), start_ + s * Vec3{way[0], way[1], way[2]}};
  }
  FootGoal goalAt(int leg, double u, const Way& way) const {
    if (leg == 0) return {smootherStep(u) * way[3], {}};
    const double v = (u - step_begin) / (step_end - step_begin);
    return {0, {way[4] * smootherStep(v), 0, step_height_m * smoothBump(v)}};
  }

  /// Feet flat and side by side, thighs and shanks as the data have them, as wide apart as in standing.
  void placeStart(double hip, double ankle) {
    for (std::size_t l = 0; l < 2; ++l) {
      Posture p{standing_.q, {}};
      ankles_[l] =
          linkPoses(human_.skeleton, p.q, standing_.root)[human_.skeleton.joints[legs_[l].joints[4]].child].origin;
    }
    const double thigh = hip - pitch_.begin;
    const Vec3 way =
        rotationAbout({0, 1, 0}, -thigh) * legs_[0].knee_T + rotationAbout({0, 1, 0}, ankle) * legs_[0].ankle_S;
    const Vec3 hips = rotationAbout({0, 1, 0}, pitch_.begin) * legs_[0].hip_P;
    const double across = ankles_[0].y - hips.y;
    start_ = {ankles_[0].x - way.x - hips.x, 0, 0};
    start_.z = ankles_[0].z + std::sqrt(way.z * way.z - across * across) - hips.z;
  }

  /// The legs' angles at an instant of the way down; throws where they do not reach.
  LegAngles anglesOf(int leg, const Pose& pelvis, const Vec3& ankle, double pitch) const {
    const auto q = reach(human_, legs_[leg], pelvis, ankle, pitch);
    if (!q) throw InputError({"", 0, "human"}, "kneeling: a leg is too short to reach the ground");
    return *q;
  }

  struct Course {
    std::vector<Pose> pelvis;
    std::array<std::vector<FootGoal>, 2> goals;
    std::array<std::vector<Vec3>, 2> ankles;
  };
  Course courseOf(const Way& way) const {
    Course c;
    for (int i = 0; i <= nodes; ++i) {
      const double u = static_cast<double>(i) / nodes;
      c.pelvis.push_back(pelvisAt(smootherStep(u), way));
      for (int l = 0; l < 2; ++l) c.goals[l].push_back(goalAt(l, u, way));
    }
    for (int l = 0; l < 2; ++l) c.ankles[l] = rolledAnkles(legs_[l], c.pelvis, c.goals[l], ankles_[l]);
    return c;
  }

  /// Right hip's flexion and adduction, right and left ankle, and the height of the right leg but for its foot.
  Way endOf(const Course& c) const {
    Posture p{standing_.q, c.pelvis.back()};
    std::array<LegAngles, 2> q;
    for (int l = 0; l < 2; ++l) {
      q[l] = anglesOf(l, c.pelvis.back(), c.ankles[l].back(), c.goals[l].back().pitch);
      legs_[l].set(q[l], p);
    }
    const auto X = linkPoses(human_.skeleton, p.q, p.root);
    const int thigh = human_.skeleton.joints[legs_[0].joints[2]].child, foot = legs_[0].foot->link;
    double low = std::numeric_limits<double>::infinity();
    for (const BodyShape& s : human_.shapes)
      if (human_.skeleton.isDistal(s.link, thigh) && !human_.skeleton.isDistal(s.link, foot))
        low = std::min(low, gapTo(s.shape, X[s.link] * s.X_LS, std::nullopt));
    return Way{q[0][0], q[0][1], q[0][4], q[1][4], low};
  }

  void findWay(const std::array<double, 5>& wanted) {
    const double a = norm(legs_[0].knee_T), b = norm(legs_[0].ankle_S);
    const double knee_low = 0.15 * a;  // of its centre, about
    Way way{0.85 * b + 0.15, 0, a + knee_low - start_.z, -2.2, 1.1 * b + 0.15 + a};
    const Way target = Eigen::Map<const Way>(wanted.data());
    for (int it = 0; it < 30; ++it) {
      const Way off = endOf(courseOf(way)) - target;
      if (off.cwiseAbs().maxCoeff() < 1e-11) break;
      if (it == 29) throw InputError({"", 0, "human"}, "kneeling: the legs do not come to the end that the data have");
      Eigen::Matrix<double, 5, 5> J;
      constexpr double h = 1e-6;
      for (int k = 0; k < 5; ++k) {
        Way more = way;
        more[k] += h;
        J.col(k) = (endOf(courseOf(more)) - target - off) / h;
      }
      const Way step = J.partialPivLu().solve(off);
      way -= std::min(1.0, 0.2 / step.cwiseAbs().maxCoeff()) * step;
    }
    const Course c = courseOf(way);
    way_ = way;
    for (int l = 0; l < 2; ++l)
      for (int i = 0; i <= nodes; ++i) {
        const LegAngles q = anglesOf(l, c.pelvis[i], c.ankles[l][i], c.goals[l][i].pitch);
        for (std::size_t k = 0; k < q.size(); ++k) path_[l][k].x.push_back(q[k]);
      }
    for (auto& leg : path_)
      for (auto& path : leg) {
        path.step_s = 1.0 / nodes;
        path.v = slopesOf(path.x, path.step_s);
        path.v.front() = path.v.back() = 0;
      }
  }

  Posture postureAt(double u) const {
    const double s = smootherStep(u);
    Posture p{standing_.q, pelvisAt(s, way_)};
    for (const Drive& d : drives_) p.q[d.joint] = d.at(s);
    for (int l = 0; l < 2; ++l) {
      LegAngles q{};
      for (std::size_t k = 0; k < q.size(); ++k) q[k] = path_[l][k].at(u);
      legs_[l].set(q, p);
    }
    return p;
  }

  Human human_;
  KneelOptions options_;
  Posture standing_;
  std::array<Leg, 2> legs_;  ///< right, left; feet point into human_
  std::vector<Drive> drives_;
  Drive pitch_{};
  std::array<Vec3, 2> ankles_;  ///< at the start
  Vec3 start_;                  ///< of the pelvis
  Way way_;
  std::array<std::array<HermitePath<double>, 5>, 2> path_;  ///< over the way down, 0 to 1
};

}  // namespace

std::unique_ptr<Motion> makeKneel(const Human& human, const KneelOptions& o) {
  const auto check = [](const char* key, double value, bool good, const char* allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600");
  check("duration_s", o.duration_s, o.duration_s >= 0.2 && o.duration_s <= 60, "0.2 to 60");
  check("hold_s", o.hold_s, o.hold_s >= 0 && o.hold_s <= 3600, "0 to 3600");
  check("rise_s", o.rise_s, o.rise_s == 0 || (o.rise_s >= 0.2 && o.rise_s <= 60), "0, or 0.2 to 60");
  return std::make_unique<Kneel>(human, o);
}

}  // namespace gambeson
