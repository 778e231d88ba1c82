#pragma once
/// A scan made from our own manikin, so that its joints are known: the skin in an A- or T-pose without its skeleton, in
/// the axes and unit of a scanner (y up, facing z, millimetres).

#include <map>
#include <memory>
#include <string>

#include "human/body/girths.hpp"
#include "human/body/section.hpp"
#include "human/body/skin.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"

namespace gambeson::test {

struct ScanBody {
  TriangleMesh mesh;                     ///< [mm], y up, facing z
  std::map<std::string, Vec3> joints;    ///< by link [m]; x forward, y left, z up, the lowest point at 0
  std::map<std::string, double> girths;  ///< by zone [m], in planes through the known joints

  Vec3 file(const Vec3& x) const { return 1000 * Vec3{x.y, x.z, x.x}; }
};

/// `arms_deg` from hanging down; feet apart by so much more at the hips.
inline ScanBody scanBody(const std::string& manikin, double arms_deg, double cell_m = 0.02, double legs_deg = 0) {
  Human h = makeManikin(manikin);
  h.skin = std::make_shared<const Skin>(makeSkin(h, {.cell_m = cell_m}));
  const Skin& skin = *h.skin;
  Posture p = standing(h);
  for (const char* side : {"_left", "_right"}) {
    p.q[static_cast<std::size_t>(h.skeleton.joint(std::string("shoulder_abduction") + side))] = arms_deg * rad_per_deg;
    p.q[static_cast<std::size_t>(h.skeleton.joint(std::string("hip_adduction") + side))] -= legs_deg * rad_per_deg;
  }
  const std::vector<Pose> X = linkPoses(h.skeleton, p.q, p.root);
  ScanBody b;
  b.mesh.triangles = skin.rest.triangles;
  b.mesh.vertices.resize(skin.rest.vertices.size());
  skinPositions(skin, X, b.mesh.vertices);
  for (const GirthPlane& plane : girthPlanes(h, X))
    b.girths[plane.zone] = tapeGirth(bodySection(h, plane, X, b.mesh.vertices));
  double low = b.mesh.vertices[0].z;
  for (const Vec3& x : b.mesh.vertices) low = std::min(low, x.z);
  const Vec3 up{0, 0, -low};
  for (std::size_t l = 0; l < X.size(); ++l) b.joints[h.skeleton.links[l].name] = X[l].origin + up;
  for (Vec3& x : b.mesh.vertices) x = b.file(x + up);
  return b;
}

}  // namespace gambeson::test
