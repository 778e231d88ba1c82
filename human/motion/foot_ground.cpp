#include "human/motion/foot_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/body/ground.hpp"

namespace gambeson {

std::array<std::vector<const BodyShape*>, 2> footShapes(const Human& human) {
  std::array<std::vector<const BodyShape*>, 2> feet;
  for (int side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "ankle_flexion_right" : "ankle_flexion_left";
    const int j = human.skeleton.joint(name);
    if (j < 0) throw InputError({"", 0, "human"}, "feet on the ground need the joint '" + name + "'");
    for (const BodyShape& s : human.shapes)
      if (human.skeleton.isDistal(s.link, human.skeleton.joints[j].child)) feet[side].push_back(&s);
    if (feet[side].empty()) throw InputError({"", 0, "human"}, "there is no shape beyond the joint '" + name + "'");
  }
  return feet;
}

LowestOfFoot lowestOfFoot(const std::vector<const BodyShape*>& foot, const std::vector<Pose>& X_WL) {
  LowestOfFoot lowest{std::numeric_limits<double>::infinity(), nullptr, {}};
  for (const BodyShape* s : foot) {
    const Pose X = X_WL[s->link] * s->X_LS;
    const Vec3 p = lowestPoint(s->shape, X.rotation);
    if (const double z = (X * p).z; z < lowest.z) lowest = {z, s, p};
  }
  return lowest;
}

FeetReport feetOnGround(const Human& human, const Motion& motion, double from_s, double step_s) {
  constexpr double carries_m = 0.010, h = 1e-4;
  const auto feet = footShapes(human);
  const auto posesAt = [&](double t) {
    const Posture p = motion.at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  };
  FeetReport r;
  double slip2 = 0, slip_path = 0, path = 0;
  int carrying = 0;
  const int n = std::max(1, static_cast<int>((motion.duration() - from_s) / step_s));
  Vec3 before{};
  for (int i = 0; i <= n; ++i) {
    const double t = std::min(from_s + i * step_s, motion.duration() - h);
    const auto X = posesAt(t), next = posesAt(t + h);
    double lower = std::numeric_limits<double>::infinity();
    for (const auto& foot : feet) {
      const LowestOfFoot l = lowestOfFoot(foot, X);
      lower = std::min(lower, l.z);
      if (l.z > carries_m) continue;
      Vec3 v = (next[l.shape->link] * l.shape->X_LS * l.point_S - X[l.shape->link] * l.shape->X_LS * l.point_S) / h;
      v.z = 0;
      slip2 += norm2(v), slip_path += norm(v) * step_s, ++carrying;
    }
    r.deepest_m = std::max(r.deepest_m, -lower), r.highest_m = std::max(r.highest_m, lower);
    Vec3 root = X[0].origin;
    root.z = 0;
    if (i > 0) path += norm(root - before);
    before = root;
  }
  if (carrying > 0) r.slip_m_per_s = std::sqrt(slip2 / carrying);
  if (path > 0.1) r.slip_of_travel = slip_path / path;
  return r;
}

}  // namespace gambeson
