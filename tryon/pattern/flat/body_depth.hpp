#pragma once
/// Detail of place_panels.hpp and lift_panels.hpp: how deep points lie in a body that stands.

#include <string>
#include <vector>

#include "core/contact/proximity.hpp"
#include "tryon/pattern/flat/standing_body.hpp"

namespace gambeson {

/// depth_m < 0 outside, very low where no part of the body is near.
struct PanelDepth {
  double depth_m = -1e300;
  std::string segment;
};

class BodyDepth {
 public:
  /// `form` outlives it.
  explicit BodyDepth(const StandingBody& form);
  /// Of shapes that are nearer than 1 cm.
  PanelDepth at(const Vec3& x) const;

 private:
  const StandingBody& form_;
  ProximityQuery query_;
  std::vector<double> reach_m_;  ///< of each shape from its origin
};

}  // namespace gambeson
