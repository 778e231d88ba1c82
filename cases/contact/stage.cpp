#include "cases/contact/stage.hpp"

#include <fmt/format.h>

#include "cases/input/wrong_entry.hpp"

namespace gambeson {

std::vector<MadeObstacle> makeObstacles(std::span<const ObstacleCase> cases, const Hurdle* stepped_over) {
  std::vector<MadeObstacle> made;
  for (std::size_t k = 0; k < cases.size(); ++k)
    made.push_back(
        underKey(fmt::format("obstacles[{}]", k), [&] { return kindOf(cases[k]).make(cases[k], stepped_over); }));
  return made;
}

std::vector<Obstacle> ObstacleStage::place(std::span<const ObstacleCase> cases, std::vector<MadeObstacle> made) {
  std::vector<Obstacle> obstacles;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    obstacles.push_back({std::move(made[k].shape), cases[k].name, made[k].sequence != nullptr});
    sequence_.push_back(std::move(made[k].sequence));
    Placement at;
    at.origin = made[k].origin_m;
    start_.push_back(at);
    velocity_.push_back(cases[k].velocity_m_per_s);
    drive_.push_back(cases[k].drive);
  }
  return obstacles;
}

void ObstacleStage::placements(double t, std::span<Placement> obstacles, std::span<Placement>) const {
  for (std::size_t k = 0; k < start_.size(); ++k) {
    obstacles[k] = start_[k];
    if (sequence_[k]) continue;
    if (!drive_[k].empty()) {
      const Pose moved = drive_[k].at(t);
      obstacles[k].rotation = moved.rotation * obstacles[k].rotation;
      obstacles[k].origin = moved * obstacles[k].origin;
    }
    obstacles[k].origin += t * velocity_[k];
  }
}

void ObstacleStage::vertices(int obstacle, double t, std::span<Vec3> x) const {
  const auto k = static_cast<std::size_t>(obstacle);
  sequence_[k]->at(t, x);
  if (!drive_[k].empty()) {
    const Pose moved = drive_[k].at(t);
    for (Vec3& p : x) p = moved * p;
  }
  for (Vec3& p : x) p += t * velocity_[k];
}

}  // namespace gambeson
