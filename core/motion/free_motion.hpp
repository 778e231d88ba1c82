#pragma once
/// A step as a scheme makes it before contact, and the step with contact around it.

#include <memory>

#include "core/motion/model.hpp"

namespace gambeson {

/// The motion over a step that nothing touches: what contact then acts on, and the impulses of which it is made.
struct FreeMotion {
  std::vector<Vec3> way;       ///< of each free point [m]
  std::vector<Vec3> velocity;  ///< at the end
  // Impulses on each free point, also where it is held [N s].
  std::vector<Vec3> elastic;  ///< of the cloth, its springs and stitches
  std::vector<Vec3> drag;
  std::vector<Vec3> damping;  ///< of the cloth's own; empty: it has none
  std::vector<Vec3> loads;   ///< of a structure's; empty elsewhere
  std::vector<Vec3> missed;  ///< by which a solve has given less than these say; empty: none
  std::vector<Vec3> spring;  ///< of each spring
  double drag_work_J = 0, drag_lost_J = 0;  ///< of the forces of drag on the velocities at which they are taken
  double damping_lost_J = 0;                ///< by that damping, likewise
  VelocitySolve solve;
};

/// A scheme that makes a whole step without contact.
class FreeScheme {
 public:
  virtual ~FreeScheme() = default;
  /// Writes `free`, and inner unknowns and their rates into `out`. False where it fails: the report says why. Reads the
  /// stage at both ends from work.stage. `in` has the accelerations, sums and forces on held points that a step leaves.
  virtual bool move(const Model& model, const Stage& stage, const State& in, double dt_s, FreeMotion& free, State& out,
                    StepReport& report, StepWork& work) = 0;
};

/// A step by dt_s. Contact follows the free motion: impulses act on the mean velocity of the way, u = way/dt, so that
/// nothing passes through anything; points go where the changed velocity takes them, x1 = x0 + dt (u + D), and the
/// velocity at the end changes alike, v1 = v + D. On failure `out` is not to be used.
StepReport freeStep(const Model& model, const Stage& stage, FreeScheme& scheme, const State& in, double dt_s,
                    State& out, FreeMotion& free, StepWork& work);

/// Completes momentum and works of a step that freeStep made. `elastic_J`: change of what is stored. Internal to
/// core/motion.
void auditFreeStep(const Model& model, const State& in, const State& out, double dt_s, const FreeMotion& free,
                   double elastic_J, StepReport& report, StepWork& work);

}  // namespace gambeson
