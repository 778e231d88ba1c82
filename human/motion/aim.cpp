/// Taking aim at the ground, leaning left: from human/data/aim_at_ground.json, in which hips, ankles and trunk are
/// given but posture and feet do not agree. Hip flexion, abduction of the right hip, trunk and arms go from start to
/// end with minimum jerk. The left foot steps forward, level, while the body lowers and is flat on the ground before
/// and after; the right foot stays and rolls onto its ball. Knees, ankles, hip rotations and the left hip's abduction
/// follow by inverse kinematics. Standing, the feet are tilted across by the abduction; that goes, so at the end the
/// hip rotations have put both flat. The feet turn a little about their contact points. The pelvis's height is that of
/// the left leg with its foot on the ground and its ankle as the data have it; while the foot is lifted, the left hip
/// flexes a little more.

#include "human/motion/aim.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/files/data.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/path.hpp"
#include "human/motion/smooth_step.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk_curves.hpp"
#include "human/skeleton/within.hpp"

namespace gambeson {
namespace {

constexpr double step_begin = 0.1, step_end = 0.65;  ///< when the left foot is in the air, of the duration
constexpr double step_height_m = 0.03;               ///< of the left foot at the middle of its step

constexpr int count = 9;
/// What inverse kinematics finds, in this order: x and y of the pelvis; knee, ankle, rotation of the right leg;
/// abduction, rotation, knee, ankle of the left one.
using Unknown = std::array<double, count>;

/// Solves A x = b with partial pivoting; A by columns.
Unknown solve(std::array<Unknown, count> a, Unknown b) {
  for (int k = 0; k < count; ++k) {
    int pivot = k;
    for (int i = k + 1; i < count; ++i)
      if (std::abs(a[k][i]) > std::abs(a[k][pivot])) pivot = i;
    for (int j = 0; j < count; ++j) std::swap(a[j][k], a[j][pivot]);
    std::swap(b[k], b[pivot]);
    for (int i = k + 1; i < count; ++i) {
      const double f = a[k][i] / a[k][k];
      for (int j = k; j < count; ++j) a[j][i] -= f * a[j][k];
      b[i] -= f * b[k];
    }
  }
  for (int k = count - 1; k >= 0; --k) {
    for (int j = k + 1; j < count; ++j) b[k] -= a[j][k] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}

class Aim final : public Motion {
 public:
  Aim(const Human& human, const AimOptions& options) : human_(human), options_(options), standing_(standing(human)) {
    const nlohmann::json data = nlohmann::json::parse(data::aim_at_ground);
    const nlohmann::json &start = data.at("start_low_ready"), &end = data.at("end_aim_at_ground_lean_left");
    const auto drive = [&](const std::string& joint, const char* key, double sign, bool needed) {
      const int j = human_.skeleton.joint(joint);
      // Arms, trunk and neck go as near to the data as they may.
      const auto of = [&](const nlohmann::json& posture) {
        const double value = sign * rad_per_deg * posture.at(key).get<double>();
        return needed ? value : within(human_.skeleton.joints[j], value);
      };
      if (j >= 0)
        drives_.push_back({j, of(start), of(end)});
      else if (needed)
        throw InputError({"", 0, "human"}, "taking aim needs the joint '" + joint + "'");
    };
    drive("hip_flexion_right", "hip_flexion_R", 1, true);
    drive("hip_flexion_left", "hip_flexion_L", 1, true);
    drive("hip_adduction_right", "hip_abduction_R", -1, true);
    drive("hip_adduction_left", "hip_abduction_L", -1, true);
    drive("hip_rotation_right", "hip_rotation_ext_R", -1, true);
    drive("hip_rotation_left", "hip_rotation_ext_L", -1, true);
    drive("ankle_flexion_right", "ankle_dorsi_R", 1, true);
    drive("ankle_flexion_left", "ankle_dorsi_L", 1, true);
    drive("lumbar_flexion", "lumbar_flexion", 1, false);
    drive("lumbar_bending", "lumbar_lateral_left", -1, false);
    drive("lumbar_rotation", "lumbar_rotation_left", 1, false);
    drive("neck_flexion", "neck_flexion", 1, false);
    for (const auto& [side, letter] : {std::pair{"right", "R"}, {"left", "L"}})
      for (const char* joint : {"shoulder_flexion", "shoulder_abduction", "elbow_flexion"})
        drive(std::string(joint) + "_" + side, (std::string(joint) + "_" + letter).c_str(), 1, false);
    // Standing, the thighs of the manikins need the abduction that they are held at.
    for (const int k : {2, 3}) drives_[k].begin = std::min(drives_[k].begin, -held_hip_abduction_rad);
    const double zero = pelvisZero_deg();
    pitch_ = {0, (zero - start.at("pelvis_tilt").get<double>()) * rad_per_deg,
              (zero - end.at("pelvis_tilt").get<double>()) * rad_per_deg};

    for (const bool right : {true, false}) {
      const std::string side = right ? "right" : "left";
      const auto joint = [&](const char* name) { return human_.skeleton.joint(std::string(name) + "_" + side); };
      const BodyShape& foot = footOf(human_, side, "taking aim");
      Leg leg{joint("hip_flexion"),
              joint("hip_adduction"),
              joint("hip_rotation"),
              joint("knee_flexion"),
              joint("ankle_flexion"),
              0,
              0,
              &foot};
      if (leg.knee < 0) throw InputError({"", 0, "human"}, "taking aim needs the joint 'knee_flexion_" + side + "'");
      leg.thigh = norm(human_.skeleton.joints[leg.knee].X_PJ.origin);
      leg.shank = norm(human_.skeleton.joints[leg.ankle].X_PJ.origin);
      (right ? right_ : left_) = leg;
    }
    // To the side the right foot's rolling counts too: the step is corrected until the left abduction is the data's.
    Step step = stepOfLeftFoot();
    const double wanted = drives_[3].end;
    solvePath(step);
    double error = path_[5].x.back() - wanted, slope = -left_.thigh;  // [m per rad]
    for (int i = 0; i < 4 && std::abs(error) > 1e-4; ++i) {
      const double dy = -error * slope;
      step.y += dy;
      solvePath(step);
      const double now = path_[5].x.back() - wanted;
      slope = dy / (now - error);
      error = now;
    }
  }

  double duration() const override { return options_.stand_s + options_.duration_s + options_.hold_s; }
  Posture at(double time_s) const override {
    const double t = std::clamp(time_s - options_.stand_s, 0.0, options_.duration_s);
    Unknown x;
    for (int k = 0; k < count; ++k) x[k] = path_[k].at(t);
    return withUnknown(given(t / options_.duration_s), x);
  }

 private:
  struct Drive {
    int joint;
    double begin, end;
    double at(double s) const { return begin + s * (end - begin); }
  };
  struct Leg {
    int flexion, adduction, rotation, knee, ankle;
    double thigh, shank;  ///< lengths [m]
    const BodyShape* foot;
  };

  static double stepped(double u) { return smootherStep((u - step_begin) / (step_end - step_begin)); }
  static double lifted(double u) { return step_height_m * smoothBump((u - step_begin) / (step_end - step_begin)); }

  Pose footPose(const Leg& leg, const Posture& p) const {
    return linkPoses(human_.skeleton, p.q, p.root)[leg.foot->link] * leg.foot->X_LS;
  }
  double lowest(const Leg& leg, const Posture& p) const {
    const Pose X = footPose(leg, p);
    return (X * lowestPoint(leg.foot->shape, X.rotation)).z;
  }

  /// The data's posture at the share u of the duration; the left knee such that the foot is level with the data's
  /// ankle, and the height of the pelvis with which it then stands. `lift`: with what the left hip flexes more in the
  /// step.
  Posture given(double u, bool lift = true) const {
    const double s = smootherStep(u);
    Posture p{standing_.q, {}};
    for (const Drive& d : drives_) p.q[d.joint] = d.at(s);
    const double pitch = pitch_.at(s);
    p.root.rotation = rotationAbout({0, 1, 0}, pitch);
    const double thigh = p.q[left_.flexion] - pitch, shank = -p.q[left_.ankle];  // swing forward from the vertical
    p.q[left_.knee] = thigh - shank;
    p.q[right_.knee] = p.q[right_.flexion] - pitch + p.q[right_.ankle];
    p.root.origin.z = -lowest(left_, p);
    if (lift && lifted(u) > 0) {
      // Two links whose end rises by lifted(u): the knee from the cosine rule, the thigh from the end's direction.
      const double a = left_.thigh, b = left_.shank, x = a * std::sin(thigh) + b * std::sin(shank),
                   z = a * std::cos(thigh) + b * std::cos(shank) - lifted(u);
      const double knee = std::acos((x * x + z * z - a * a - b * b) / (2 * a * b));
      p.q[left_.flexion] += std::atan2(x, z) + std::atan2(b * std::sin(knee), a + b * std::cos(knee)) - thigh;
    }
    return p;
  }

  Posture withUnknown(Posture p, const Unknown& x) const {
    p.root.origin.x = x[0], p.root.origin.y = x[1];
    p.q[right_.knee] = x[2], p.q[right_.ankle] = x[3], p.q[right_.rotation] = x[4];
    p.q[left_.adduction] = x[5], p.q[left_.rotation] = x[6], p.q[left_.knee] = x[7], p.q[left_.ankle] = x[8];
    return p;
  }

  /// How far the left foot goes: with the data's angles at the end, the rotations that
  /// put the feet flat across, the right knee such that its foot stands, and the right foot rolled on the ground by its
  /// pitch.
  struct Step {
    double x, y;
  };
  Step stepOfLeftFoot() const {
    const Posture begin = given(0, false);
    Posture end = given(1, false);
    const auto zeroOf = [](double lo, double hi, auto rising) {
      for (int i = 0; i < 60; ++i) (rising(0.5 * (lo + hi)) < 0 ? lo : hi) = 0.5 * (lo + hi);
      return 0.5 * (lo + hi);
    };
    for (const Leg* leg : {&right_, &left_}) {
      const double out = leg == &right_ ? -1 : 1;  // side on which a foot turned inwards at the hip rises
      zeroOf(-0.5, 0.5, [&](double rotation) {
        end.q[leg->rotation] = rotation;
        return out * footPose(*leg, end).rotation.b.z;
      });
    }
    zeroOf(0.5, 2.6, [&](double knee) {
      end.q[right_.knee] = knee;
      return lowest(right_, end);
    });
    const Pose r0 = footPose(right_, begin), r1 = footPose(right_, end), l0 = footPose(left_, begin),
               l1 = footPose(left_, end);
    const double pitch = -std::asin(r1.rotation.a.z);
    double rolled = 0;  // x of the right foot's centre
    constexpr int n = 200;
    for (int i = 0; i < n; ++i) {
      const Mat3 a = rotationAbout({0, 1, 0}, pitch * i / n), b = rotationAbout({0, 1, 0}, pitch * (i + 1) / n);
      const Vec3 m = 0.5 * (lowestPoint(right_.foot->shape, a) + lowestPoint(right_.foot->shape, b));
      rolled += (a * m - b * m).x;
    }
    const Vec3 d = (l1.origin - l0.origin) - (r1.origin - r0.origin);
    return {d.x + rolled, d.y};
  }

  /// From one instant to the next the points of the feet midway between both lowest ones go the prescribed way (second
  /// order): the right one's stays.
  void solvePath(const Step& step) {
    const double T = options_.duration_s;
    const int n = std::max(100, static_cast<int>(std::ceil(T / 0.002)));
    const Posture start = given(0);
    Unknown x{0,
              0,
              start.q[right_.knee],
              start.q[right_.ankle],
              start.q[right_.rotation],
              start.q[left_.adduction],
              start.q[left_.rotation],
              start.q[left_.knee],
              start.q[left_.ankle]};
    Pose last_r = footPose(right_, start), last_l = footPose(left_, start);
    Vec3 low_r = lowestPoint(right_.foot->shape, last_r.rotation),
         low_l = lowestPoint(left_.foot->shape, last_l.rotation);
    const double roll_r = last_r.rotation.b.z, roll_l = last_l.rotation.b.z, pitch_l = last_l.rotation.a.z;
    std::vector<Unknown> found{x};
    for (int i = 1; i <= n; ++i) {
      const double u = static_cast<double>(i) / n, du = stepped(u) - stepped(u - 1.0 / n), tilted = 1 - smootherStep(u);
      const Posture known = given(u);
      Pose r, l;
      const auto residual = [&](const Unknown& at) {
        const Posture p = withUnknown(known, at);
        const auto X = linkPoses(human_.skeleton, p.q, p.root);
        r = X[right_.foot->link] * right_.foot->X_LS, l = X[left_.foot->link] * left_.foot->X_LS;
        const Vec3 a = lowestPoint(right_.foot->shape, r.rotation), b = lowestPoint(left_.foot->shape, l.rotation);
        const Vec3 m = 0.5 * (a + low_r), k = 0.5 * (b + low_l);
        const Vec3 slip = r * m - last_r * m, way = l * k - last_l * k;
        return Unknown{slip.x,
                       slip.y,
                       (r * a).z,
                       r.rotation.b.z - tilted * roll_r,
                       way.x - step.x * du,
                       way.y - step.y * du,
                       (l * b).z - lifted(u),
                       l.rotation.b.z - tilted * roll_l,
                       l.rotation.a.z - tilted * pitch_l};
      };
      const auto size = [](const Unknown& v) {
        double s = 0;
        for (const double c : v) s = std::max(s, std::abs(c));
        return s;
      };
      if (i > 1)
        for (int k = 0; k < count; ++k) x[k] = 2 * found[i - 1][k] - found[i - 2][k];
      Unknown f = residual(x);
      for (int it = 0; it < 30 && size(f) > 1e-13; ++it) {
        constexpr double h = 1e-6;
        std::array<Unknown, count> columns;
        for (int k = 0; k < count; ++k) {
          Unknown y = x;
          y[k] += h;
          columns[k] = residual(y);
          for (int c = 0; c < count; ++c) columns[k][c] = (columns[k][c] - f[c]) / h;
        }
        const Unknown dx = solve(columns, f);
        for (int k = 0; k < count; ++k) x[k] -= dx[k];
        f = residual(x);
      }
      if (!(size(f) < 1e-10))
        throw RunError("taking aim: the feet do not reach the ground at " + std::to_string(100 * u) +
                       " % of the motion");
      found.push_back(x);
      last_r = r, last_l = l;
      low_r = lowestPoint(right_.foot->shape, r.rotation), low_l = lowestPoint(left_.foot->shape, l.rotation);
    }
    for (int k = 0; k < count; ++k) {
      path_[k].step_s = T / n;
      path_[k].x.clear();
      for (const Unknown& v : found) path_[k].x.push_back(v[k]);
      path_[k].v = slopesOf(path_[k].x, T / n);
      path_[k].v.front() = path_[k].v.back() = 0;  // at rest
    }
  }

  Human human_;
  AimOptions options_;
  Posture standing_;
  std::vector<Drive> drives_;
  Drive pitch_{};
  Leg right_{}, left_{};  ///< feet point into human_
  std::array<HermitePath<double>, count> path_;
};

}  // namespace

std::unique_ptr<Motion> makeAim(const Human& human, const AimOptions& o) {
  const auto check = [](const char* key, double value, bool good, const char* allowed) {
    if (!good) throw InputError({"", 0, key}, std::to_string(value) + " is not allowed: " + allowed);
  };
  check("stand_s", o.stand_s, o.stand_s >= 0 && o.stand_s <= 3600, "0 to 3600");
  check("duration_s", o.duration_s, o.duration_s >= 0.2 && o.duration_s <= 60, "0.2 to 60");
  check("hold_s", o.hold_s, o.hold_s >= 0 && o.hold_s <= 3600, "0 to 3600");
  check("rifle_mass_kg", o.rifle_mass_kg, o.rifle_mass_kg >= 0 && o.rifle_mass_kg <= 50, "0 to 50");
  return std::make_unique<Aim>(human, o);
}

}  // namespace gambeson
