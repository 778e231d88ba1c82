#pragma once
/// Motion: joint values and root pose over time, with continuous velocity.

#include <memory>
#include <optional>
#include <vector>

#include "human/body/body.hpp"
#include "human/body/ground.hpp"

namespace gambeson {

struct Posture {
  std::vector<double> q;  ///< one per joint of the skeleton [rad or m]
  Pose root;              ///< X_WR
};

/// A C¹ motion. Before 0 and after duration() the ends hold, with zero velocity only where the motion ends at rest.
class Motion {
 public:
  virtual ~Motion() = default;
  virtual double duration() const = 0;
  virtual Posture at(double time_s) const = 0;
  /// The stairs that it climbs; none: level ground z = 0.
  virtual std::optional<Stairs> stairs() const { return {}; }
};

}  // namespace gambeson
