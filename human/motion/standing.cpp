#include "human/motion/standing.hpp"

#include "core/error.hpp"
#include "human/body/ground.hpp"
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
    if (shoulder >= 0) p.q[shoulder] = held_shoulder_abduction_rad;
  }
  p.root.origin.z = -lowestHeight(human, linkPoses(human.skeleton, p.q, p.root));
  return p;
}

}  // namespace gambeson
