#pragma once
/// A hold of contact solves that sweeps over the rows can see.

#include "core/contact/response.hpp"

namespace gambeson {

/// Entries of a row of a sparse matrix.
struct PointTies {
  std::span<const int> points;
  std::span<const double> values;
};

/// Rows C v = 0 for the velocities of the points, seams say: P = M^-1 - H with P M P = P, so that velocities that it
/// has held it leaves as they are. H is near to its entries between points that are near to each other along the seams,
/// and with these a sweep sees what holds a row (contact_iteration.hpp).
class ProjectingHold : public MotionHold {
 public:
  /// Of H the row of a free point, less what hardly counts; empty where nothing holds the point.
  virtual PointTies ties(int free_point) const = 0;
  bool bearsTension() const override { return false; }
  bool projects() const override { return true; }
};

}  // namespace gambeson
