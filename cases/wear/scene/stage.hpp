#pragma once
/// Bodies and air of a case over time.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cases/contact/stage.hpp"
#include "core/motion/model.hpp"
#include "human/body/body.hpp"
#include "human/body/bridged_folds.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

/// The human through dressing, settling and the motion, and the case's own obstacles.
class CaseStage : public Stage {
 public:
  const Human* human = nullptr;
  const Motion* motion = nullptr;
  std::vector<Placement> shrunk;  ///< of the human's shapes, empty without projecting
  std::vector<Vec3> shrunk_skin;  ///< of the human's skin, the same
  double grow_start_s = 0, grow_s = 0;
  BridgedFolds bridged;                     ///< of the human's skin
  std::vector<int> feet;                    ///< of the human's shapes, those that are left out until feet_back_s
  double feet_back_s = 0, feet_grow_s = 0;  ///< from then on they grow to their size
  std::optional<Posture> dressed;           ///< posture that the garments are put on in, left from settle_start_s on
  double settle_start_s = 0;
  ObstacleStage own;               ///< the case's obstacles
  int first_own = 0;               ///< of them
  std::vector<Drive> held_drives;  ///< of what supports hold
  Vec3 air_velocity;
  double air_ramp_s = 0;

  void placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const override;
  void vertices(int obstacle, double t, std::span<Vec3> x) const override;
  const Skin* skin(int obstacle, double t, std::vector<Pose>& poses) const override;
  void heldMotions(double t, std::span<HeldMotion> motions) const override;
  /// Starts with the motion, smoothly over the lead-in.
  Vec3 air(double t) const override;
  /// From the posture of dressing into that in which the motion starts, in the first two thirds of the time to settle.
  Posture postureAt(double t) const;
  /// Whether it is a foot that has not begun to come back.
  bool leavesOut(int obstacle, double t) const;

 private:
  /// Of feet that are left out, each about the origin of its shape.
  double footScale(double t) const;
};

}  // namespace gambeson
