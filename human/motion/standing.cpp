#include "human/motion/standing.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

Posture standing(const Human& human) {
  if (human.shapes.empty()) throw InputError({"", 0, "human"}, "has no surface that could stand on the ground");
  Posture p;
  p.q.assign(human.skeleton.joints.size(), 0.0);
  for (const char* side : {"_right", "_left"}) {
    const int hip = human.skeleton.joint(std::string("hip_adduction") + side);
    const int shoulder = human.skeleton.joint(std::string("shoulder_abduction") + side);
    if (hip >= 0) p.q[hip] = -held_hip_abduction_rad;
    if (shoulder >= 0) p.q[shoulder] = std::max(held_shoulder_abduction_rad, human.skeleton.joints[shoulder].lower);
  }
  p.root.origin.z = -lowestHeight(human, linkPoses(human.skeleton, p.q, p.root));
  return p;
}

Posture postureOfSkin(const Human& human) {
  if (!human.skin) return standing(human);
  const std::vector<Pose>& at = human.skin->bind;
  Posture p;
  p.root = at[0];
  for (const Joint& joint : human.skeleton.joints) {
    const Pose from = at[static_cast<std::size_t>(joint.parent)] * joint.X_PJ;
    const Pose moved = inverse(from) * at[static_cast<std::size_t>(joint.child)];
    double value = 0;
    if (joint.type == JointType::prismatic) value = dot(joint.axis, moved.origin);
    if (joint.type == JointType::revolute) {
      const Mat3& R = moved.rotation;  // about the axis: its trace is 1 + 2 cos, what is not symmetric 2 sin times it
      const Vec3 twice_sine{R.b.z - R.c.y, R.c.x - R.a.z, R.a.y - R.b.x};
      value = std::atan2(dot(joint.axis, twice_sine), R.a.x + R.b.y + R.c.z - 1);
    }
    p.q.push_back(value);
  }
  return p;
}

}  // namespace gambeson
