#include "human/skeleton/skeleton.hpp"

namespace gambeson {

int Skeleton::link(const std::string& n) const {
  for (int i = 0; i < static_cast<int>(links.size()); ++i)
    if (links[i].name == n) return i;
  return -1;
}

int Skeleton::joint(const std::string& n) const {
  for (int i = 0; i < static_cast<int>(joints.size()); ++i)
    if (joints[i].name == n) return i;
  return -1;
}

bool Skeleton::isDistal(int a, int b) const {
  while (a != b && links[a].parent_joint >= 0) a = joints[links[a].parent_joint].parent;
  return a == b;
}

std::vector<Pose> linkPoses(const Skeleton& skeleton, std::span<const double> q, const Pose& root) {
  std::vector<Pose> X_WL(skeleton.links.size());
  X_WL[0] = root;
  for (int l = 1; l < static_cast<int>(skeleton.links.size()); ++l) {
    const int j = skeleton.links[l].parent_joint;
    const Joint& joint = skeleton.joints[j];
    const double value = joint.mimic_of ? joint.mimic_multiplier * q[*joint.mimic_of] + joint.mimic_offset : q[j];
    Pose motion;
    if (joint.type == JointType::revolute) motion.rotation = rotationAbout(joint.axis, value);
    if (joint.type == JointType::prismatic) motion.origin = value * joint.axis;
    X_WL[l] = X_WL[joint.parent] * joint.X_PJ * motion;
  }
  return X_WL;
}

}  // namespace gambeson
