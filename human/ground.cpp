#include "human/ground.hpp"

#include <limits>

namespace gambeson {

Vec3 lowestPoint(const Shape& shape, const Mat3& R_WS) {
  const Vec3 down = transposeTimes(R_WS, {0, 0, -1});
  if (const auto* e = std::get_if<Ellipsoid>(&shape)) {
    const Vec3 a = e->semi_axes, ad{a.x * down.x, a.y * down.y, a.z * down.z};
    return Vec3{a.x * ad.x, a.y * ad.y, a.z * ad.z} / norm(ad);
  }
  const auto& mesh = std::get<TriangleMesh>(shape);
  Vec3 lowest = mesh.vertices.front();
  for (const Vec3& v : mesh.vertices)
    if (dot(v, down) > dot(lowest, down)) lowest = v;
  return lowest;
}

double lowestHeight(const Human& human, std::span<const Pose> link_poses) {
  double z = std::numeric_limits<double>::infinity();
  for (const BodyShape& s : human.shapes) {
    const Pose X_WS = link_poses[s.link] * s.X_LS;
    z = std::min(z, (X_WS * lowestPoint(s.shape, X_WS.rotation)).z);
  }
  return z;
}

}  // namespace gambeson
