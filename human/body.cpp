#include "human/body.hpp"

namespace gambeson {

std::vector<Obstacle> obstaclesOf(const Human& human) {
  std::vector<Obstacle> obstacles;
  for (const BodyShape& s : human.shapes) obstacles.push_back({s.shape, human.skeleton.links[s.link].name});
  return obstacles;
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
