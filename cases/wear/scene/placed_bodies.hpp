#pragma once
/// The bodies of a scenario at one instant, for all that looks at recorded frames.

#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

class PlacedBodies {
 public:
  explicit PlacedBodies(const Scenario& scenario);

  void moveTo(double time_s);
  const std::vector<Placement>& placements() const { return placements_; }
  const DeformedVertices& vertices() const { return vertices_; }  ///< of obstacles that deform
  const DeformedSurfaces* surfaces() const { return &surfaces_; }

  /// An obstacle's surface, in the world where it deforms.
  TriangleMesh deformedMesh(int obstacle) const;

  struct Nearest {
    int body = -1;          ///< index in Scenario::bodies; -1 where there are none
    double distance_m = 0;  ///< signed; infinite where there are none
  };
  Nearest nearest(const Vec3& x) const;

 private:
  const Scenario& scenario_;
  std::vector<Placement> placements_;
  DeformedVertices vertices_;
  DeformedSurfaces surfaces_;
};

}  // namespace gambeson
