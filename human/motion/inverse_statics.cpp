#include "human/motion/inverse_statics.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "human/body/ground.hpp"

namespace gambeson {
namespace {

constexpr double gravity_m_per_s2 = 9.81;

/// The moment of a force about a joint's axis; of a sliding joint the force along it.
double aboutJoint(const Joint& joint, std::span<const Pose> X_WL, const Vec3& x_W, const Vec3& force) {
  const Pose X_WJ = X_WL[joint.parent] * joint.X_PJ;
  const Vec3 axis = X_WJ.rotation * joint.axis;
  return joint.type == JointType::prismatic ? dot(axis, force) : dot(axis, cross(x_W - X_WJ.origin, force));
}

}  // namespace

Vec3 centreOfMass(const Human& human, std::span<const Pose> X_WL, std::span<const CarriedMass> carried) {
  double m = 0;
  Vec3 mx;
  const auto add = [&](double mass, const Vec3& x) { m += mass, mx += mass * x; };
  for (std::size_t l = 0; l < human.skeleton.links.size(); ++l)
    add(human.skeleton.links[l].mass_kg, X_WL[l] * human.skeleton.links[l].center_of_mass);
  for (const CarriedMass& c : carried) add(c.mass_kg, X_WL[c.link] * c.point_L);
  if (!(m > 0)) throw InputError({"", 0, "human"}, "has no mass");
  return mx / m;
}

GroundReaction groundReaction(const Human& human, std::span<const Pose> X_WL, std::span<const CarriedMass> carried,
                              double reach_m) {
  GroundReaction out;
  double lowest = 1e300;
  for (const char* side : {"right", "left"}) {
    const BodyShape& foot = footOf(human, side, "inverse statics");
    const Pose X = X_WL[foot.link] * foot.X_LS;
    out.feet.push_back({foot.link, X * lowestPoint(foot.shape, X.rotation), 0});
    lowest = std::min(lowest, out.feet.back().centre_W.z);
  }
  std::erase_if(out.feet, [&](const GroundReaction::Foot& f) { return f.centre_W.z > lowest + reach_m; });

  double mass = 0;
  for (const Link& l : human.skeleton.links) mass += l.mass_kg;
  for (const CarriedMass& c : carried) mass += c.mass_kg;
  const double weight = gravity_m_per_s2 * mass;
  const Vec3 com = centreOfMass(human, X_WL, carried);
  Vec3 resultant = out.feet[0].centre_W;
  out.feet[0].force_N = weight;
  if (out.feet.size() == 2) {
    Vec3 d = out.feet[1].centre_W - out.feet[0].centre_W, r = com - out.feet[0].centre_W;
    d.z = r.z = 0;
    const double share = norm2(d) > 0 ? std::clamp(dot(r, d) / norm2(d), 0.0, 1.0) : 0.5;
    out.feet[0].force_N = (1 - share) * weight;
    out.feet[1].force_N = share * weight;
    resultant += share * d;
  }
  const Vec3 shift{com.x - resultant.x, com.y - resultant.y, 0};
  for (GroundReaction::Foot& f : out.feet) f.centre_W += shift;
  out.shift_m = norm(shift);
  return out;
}

std::vector<double> jointMoments(const Human& human, std::span<const Pose> X_WL, std::span<const CarriedMass> carried,
                                 const GroundReaction& ground) {
  const Skeleton& s = human.skeleton;
  struct Force {
    int link;
    Vec3 x, f;
  };
  std::vector<Force> forces;
  for (std::size_t l = 0; l < s.links.size(); ++l)
    forces.push_back(
        {static_cast<int>(l), X_WL[l] * s.links[l].center_of_mass, {0, 0, -gravity_m_per_s2 * s.links[l].mass_kg}});
  for (const CarriedMass& c : carried)
    forces.push_back({c.link, X_WL[c.link] * c.point_L, {0, 0, -gravity_m_per_s2 * c.mass_kg}});
  for (const GroundReaction::Foot& f : ground.feet) forces.push_back({f.link, f.centre_W, {0, 0, f.force_N}});

  std::vector<double> tau(s.joints.size(), 0.0);
  for (std::size_t j = 0; j < s.joints.size(); ++j) {
    const Joint& joint = s.joints[j];
    if (joint.type == JointType::fixed || joint.mimic_of) continue;
    for (const Force& f : forces)
      if (s.isDistal(f.link, joint.child)) tau[j] -= aboutJoint(joint, X_WL, f.x, f.f);
  }
  return tau;
}

std::vector<CarriedMass> rifleInHands(const Human& human, double mass_kg) {
  std::vector<CarriedMass> out;
  for (const char* name : {"hand_right", "hand_left"}) {
    const int l = human.skeleton.link(name);
    if (l < 0) throw InputError({"", 0, "human"}, std::string("a rifle needs the link '") + name + "'");
    out.push_back({l, human.skeleton.links[l].center_of_mass, 0.5 * mass_kg});
  }
  return out;
}

std::vector<double> hundredthsOf(const Motion& motion) {
  std::vector<double> times_s;
  for (int i = 0; i <= 100; ++i) times_s.push_back(motion.duration() * i / 100);
  return times_s;
}

std::vector<StaticMoment> peakStaticMoments(const Human& human, const Motion& motion,
                                            std::span<const CarriedMass> carried) {
  const Skeleton& skeleton = human.skeleton;
  std::vector<StaticMoment> peak(skeleton.joints.size());
  bool stood = false;
  for (const double time_s : hundredthsOf(motion)) {
    const Posture p = motion.at(time_s);
    const auto X = linkPoses(skeleton, p.q, p.root);
    const GroundReaction ground = groundReaction(human, X, carried);
    if (ground.feet.size() < 2) continue;
    stood = true;
    const auto tau = jointMoments(human, X, carried, ground);
    for (std::size_t j = 0; j < tau.size(); ++j) {
      if (!(std::abs(tau[j]) > std::abs(peak[j].moment_Nm))) continue;
      peak[j] = {tau[j], 0, 0};
      for (const GroundReaction::Foot& f : ground.feet) {
        if (!skeleton.isDistal(f.link, skeleton.joints[j].child) || !(f.force_N > 0)) continue;
        peak[j].foot_part = f.force_N / (ground.feet[0].force_N + ground.feet[1].force_N);
        peak[j].lever_m = std::abs(aboutJoint(skeleton.joints[j], X, f.centre_W, {0, 0, 1}));
      }
    }
  }
  if (!stood)
    throw InputError({"", 0, "human.motion"}, "never has both feet on the ground, so nothing can be held still");
  return peak;
}

}  // namespace gambeson
