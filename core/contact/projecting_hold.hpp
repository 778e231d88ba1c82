#pragma once
/// A hold of contact solves that sweeps over the rows can alternate with.

#include "core/contact/response.hpp"

namespace gambeson {

/// Rows C v = 0 for the velocities of the points, seams say: P M P = P, so that velocities that it has held it leaves
/// as they are, and what it takes follows from the change of all others at once. To a contact solve it is one more
/// block of the same problem: contact_iteration.hpp.
class ProjectingHold : public MotionHold {
 public:
  bool bearsTension() const override { return false; }
  bool projects() const override { return true; }
};

}  // namespace gambeson
