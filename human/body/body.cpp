#include "human/body/body.hpp"

#include "human/body/skin.hpp"

namespace gambeson {

std::vector<Obstacle> obstaclesOf(const Human& human) {
  std::vector<Obstacle> obstacles;
  if (human.skin) {
    TriangleMesh mesh = human.skin->rest;
    if (!human.skin->off.empty()) {
      mesh.triangles.clear();
      for (std::size_t t = 0; t < human.skin->off.size(); ++t)
        if (!human.skin->off[t]) mesh.triangles.push_back(human.skin->rest.triangles[t]);
    }
    return {{std::move(mesh), "skin", true}};
  }
  for (const BodyShape& s : human.shapes) obstacles.push_back({s.shape, human.skeleton.links[s.link].name});
  return obstacles;
}

std::vector<Placement> obstaclePlacementsOf(const Human& human, std::span<const Pose> link_poses) {
  if (human.skin) return {Placement{}};
  return placementsOf(human, link_poses);
}

std::vector<Placement> placementsOf(const Human& human, std::span<const Pose> link_poses) {
  std::vector<Placement> placements;
  for (const BodyShape& s : human.shapes) {
    const Pose X_WS = link_poses[s.link] * s.X_LS;
    placements.push_back({X_WS.rotation, X_WS.origin, 1.0});
  }
  return placements;
}

}  // namespace gambeson
