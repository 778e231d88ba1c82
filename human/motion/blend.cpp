#include "human/motion/blend.hpp"

#include <Eigen/Geometry>

namespace gambeson {
namespace {

Eigen::Matrix3d matrixOf(const Mat3& m) {
  Eigen::Matrix3d e;
  e << m.a.x, m.b.x, m.c.x, m.a.y, m.b.y, m.c.y, m.a.z, m.b.z, m.c.z;
  return e;
}

}  // namespace

Posture blend(const Posture& from, const Posture& to, double share) {
  Posture p = from;
  for (std::size_t j = 0; j < p.q.size(); ++j) p.q[j] += share * (to.q[j] - from.q[j]);
  p.root.origin += share * (to.root.origin - from.root.origin);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(matrixOf(from.root.rotation).transpose() * matrixOf(to.root.rotation)));
  const Eigen::Vector3d axis = turn.axis();
  p.root.rotation = from.root.rotation * rotationAbout({axis.x(), axis.y(), axis.z()}, share * turn.angle());
  return p;
}

}  // namespace gambeson
