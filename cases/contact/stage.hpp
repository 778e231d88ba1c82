#pragma once
/// The obstacles of a case over time.

#include <memory>
#include <span>
#include <vector>

#include "cases/contact/obstacles/kind.hpp"
#include "core/motion/model.hpp"

namespace gambeson {

/// Makes them in their order; `stepped_over` as in ObstacleKind. Throws InputError with a key such as
/// "obstacles[1].mesh".
std::vector<MadeObstacle> makeObstacles(std::span<const ObstacleCase> cases, const Hurdle* stepped_over = nullptr);

/// Obstacles with constant velocities and drives, some of which deform. No anchors.
class ObstacleStage : public Stage {
 public:
  /// Takes what was made of the cases; returns the obstacles as the engine sees them.
  std::vector<Obstacle> place(std::span<const ObstacleCase> cases, std::vector<MadeObstacle> made);

  std::size_t count() const { return start_.size(); }
  const Placement& start(std::size_t obstacle) const { return start_[obstacle]; }  ///< at time 0
  /// Of an obstacle that deforms; null for others.
  const MeshSequence* sequence(std::size_t obstacle) const { return sequence_[obstacle].get(); }
  void placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const override;
  void vertices(int obstacle, double t, std::span<Vec3> x) const override;

 private:
  std::vector<Placement> start_;
  std::vector<Vec3> velocity_;
  std::vector<Drive> drive_;
  std::vector<std::unique_ptr<const MeshSequence>> sequence_;  ///< null for those that do not deform
};

}  // namespace gambeson
