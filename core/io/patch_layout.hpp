#pragma once
/// The patches of a cloth as files hold them.

#include <string>
#include <vector>

namespace gambeson {

/// A NURBS surface but for its control points, which each frame has (control_fields, one patch after the other, u
/// fastest).
struct PatchLayout {
  struct Curve {
    int loop = 0;  ///< that it is part of; the curves of a loop follow each other
    int degree = 1;
    std::vector<double> knots, points, weights;  ///< points: u and v of each
    bool operator==(const Curve&) const = default;
  };
  std::string name;
  int degree_u = 0, degree_v = 0;
  std::vector<double> knots_u, knots_v, weights;
  std::vector<Curve> trims;
  bool operator==(const PatchLayout&) const = default;
};

}  // namespace gambeson
