#include "cases/wear/scene/placed_bodies.hpp"

#include <limits>

namespace gambeson {

PlacedBodies::PlacedBodies(const Scenario& scenario) : scenario_(scenario), surfaces_(scenario.model->obstacles) {}

void PlacedBodies::moveTo(double time_s) {
  placements_ = scenario_.obstaclePlacements(time_s);
  if (surfaces_.empty()) return;
  vertices_ = deformedVertices(*scenario_.model, *scenario_.stage, time_s);
  surfaces_.move(vertices_);
}

TriangleMesh PlacedBodies::deformedMesh(int obstacle) const {
  const auto o = static_cast<std::size_t>(obstacle);
  return {{vertices_[o].begin(), vertices_[o].end()},
          std::get<TriangleMesh>(scenario_.model->obstacles[o].shape).triangles};
}

PlacedBodies::Nearest PlacedBodies::nearest(const Vec3& x) const {
  const Model& m = *scenario_.model;
  Nearest best{-1, std::numeric_limits<double>::infinity()};
  for (int o = 0; o < static_cast<int>(m.obstacles.size()); ++o) {
    const auto k = static_cast<std::size_t>(o);
    if (m.obstacles[k].deforms) {
      const Contact c = m.proximity->nearest(o, x, surfaces_);
      if (c.gap_m < best.distance_m) best = {scenario_.bodyOf(o, c.touched), c.gap_m};
    } else {
      const double d = m.proximity->signedDistance(o, placements_[k], x);
      if (d < best.distance_m) best = {scenario_.bodyOf(o, {}), d};
    }
  }
  return best;
}

}  // namespace gambeson
