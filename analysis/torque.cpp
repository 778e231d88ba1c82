#include "analysis/torque.hpp"

#include <algorithm>
#include <stdexcept>

namespace gambeson {
namespace {

bool isSegment(const Human& human, int link) {
  return human.skeleton.links[static_cast<std::size_t>(link)].mass_kg > 0 ||
         std::any_of(human.shapes.begin(), human.shapes.end(), [&](const BodyShape& s) { return s.link == link; });
}

/// Adds `link` and what is fixed to it.
void addRigid(const Skeleton& skeleton, int link, std::vector<int>& links) {
  links.push_back(link);
  for (const Joint& j : skeleton.joints)
    if (j.parent == link && j.type == JointType::fixed) addRigid(skeleton, j.child, links);
}

/// Adds the first segment at or below `link`, on each branch.
void addNearest(const Human& human, int link, std::vector<int>& links) {
  if (isSegment(human, link)) return addRigid(human.skeleton, link, links);
  for (const Joint& j : human.skeleton.joints)
    if (j.parent == link) addNearest(human, j.child, links);
}

}  // namespace

std::vector<int> countedLinks(const Human& human, int joint, TorqueCounting counting) {
  const Skeleton& skeleton = human.skeleton;
  const int child = skeleton.joints[static_cast<std::size_t>(joint)].child;
  std::vector<int> links;
  if (counting == TorqueCounting::distal_segment) {
    addNearest(human, child, links);
  } else {
    for (int l = 0; l < static_cast<int>(skeleton.links.size()); ++l)
      if (skeleton.isDistal(l, child)) links.push_back(l);
  }
  std::sort(links.begin(), links.end());
  return links;
}

std::vector<int> movingJoints(const Skeleton& skeleton) {
  std::vector<int> joints;
  for (int j = 0; j < static_cast<int>(skeleton.joints.size()); ++j) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    if (joint.type != JointType::fixed && !joint.mimic_of) joints.push_back(j);
  }
  return joints;
}

std::vector<double> contactTorques(const Human& human, const Posture& posture, std::span<const LinkImpulse> impulses,
                                   double duration_s, std::span<const int> joints, TorqueCounting counting) {
  const Skeleton& skeleton = human.skeleton;
  if (impulses.size() != skeleton.links.size()) throw std::logic_error("contact torques need one impulse per link");
  if (!(duration_s > 0)) throw std::logic_error("contact torques need a window that lasts");
  const std::vector<Pose> X_WL = linkPoses(skeleton, posture.q, posture.root);
  std::vector<double> torques;
  for (const int j : joints) {
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    const Pose X_WJ = X_WL[static_cast<std::size_t>(joint.parent)] * joint.X_PJ;
    const Vec3 axis = X_WJ.rotation * joint.axis;
    Vec3 sum;
    for (const int l : countedLinks(human, j, counting)) {
      const LinkImpulse& given = impulses[static_cast<std::size_t>(l)];
      if (joint.type == JointType::prismatic) {
        sum += given.force_Ns;
      } else {
        sum += given.moment_Nms + cross(X_WL[static_cast<std::size_t>(l)].origin - X_WJ.origin, given.force_Ns);
      }
    }
    torques.push_back(dot(axis, sum) / duration_s);
  }
  return torques;
}

std::vector<double> TorqueSeries::of(int joint) const {
  const auto found = std::find(joints.begin(), joints.end(), joint);
  if (found == joints.end()) throw std::out_of_range("no torques of this joint were asked for");
  const auto column = static_cast<std::size_t>(found - joints.begin());
  std::vector<double> values;
  for (const auto& row : value) values.push_back(row[column]);
  return values;
}

TorqueSeries torqueSeries(const Human& human, const Motion& motion, double motion_start_s,
                          std::span<const ContactWindow> windows, std::span<const int> joints,
                          TorqueCounting counting) {
  TorqueSeries series{{joints.begin(), joints.end()}, {}, {}};
  for (const ContactWindow& w : windows) {
    series.time_s.push_back(w.middle());
    series.value.push_back(
        contactTorques(human, motion.at(w.middle() - motion_start_s), w.links, w.duration(), joints, counting));
  }
  return series;
}

}  // namespace gambeson
