#pragma once
/// Rigid impact zones: what contacts solved one by one cannot keep apart moves as one body.

#include <span>
#include <vector>

#include "core/contact/contact_mesh.hpp"
#include "core/contact/response.hpp"
#include "core/math/sparse.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Free points that move together, ascending; with a body where a pair of the impact zone has one (`body` >= 0), with
/// two where it is pinched between bodies.
struct ImpactZone {
  std::span<const int> points;
  int body = -1;
  bool pinched = false;
  std::span<const int> touched;  ///< vertices of the body where it deforms, ascending
};

/// Some of them, in flat arrays.
struct ImpactZones {
  Lists points, touched;  ///< of each zone
  std::vector<int> body;
  std::vector<char> pinched;

  int size() const { return static_cast<int>(body.size()); }
  ImpactZone operator[](int i) const { return {points[i], body[i], pinched[i] != 0, touched[i]}; }
  void add(const ImpactZone& zone);
  void clear();
};

/// Joins the pairs of `rows` that share free points, and what `impact_zones` joined before: these are closed over the
/// support of their samples, so that each sample of a pair moves rigidly (Harmon et al. 2008, for samples in place of
/// vertices). Sorted by first point.
void joinImpactZones(std::span<const ContactRow> rows, const SparseRows& WT, ImpactZones& impact_zones);

/// v + omega x (p - centre)
struct RigidVelocity {
  Vec3 centre, mean, spin;
  Vec3 at(const Vec3& p) const { return mean + cross(spin, p - centre); }
};
/// The rigid motion nearest to the velocities of some points in the norm of the masses. Where the points lie on a line,
/// no rotation about it.
RigidVelocity nearestRigid(std::span<const int> points, std::span<const Vec3> p, std::span<const double> mass,
                           std::span<const Vec3> velocity);

/// Replaces the velocities of an impact zone by those of the nearest rigid motion, which keeps linear and angular
/// momentum.
void makeRigid(const ImpactZone& zone, std::span<const Vec3> p, std::span<const double> mass, std::span<Vec3> velocity);

}  // namespace gambeson
