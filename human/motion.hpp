#pragma once
/// Motion: joint values and root pose over time, with continuous velocity.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "human/body.hpp"

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
};

/// The skeleton's zero posture with the root where the manikin stands on the ground (z = 0).
Posture standing(const Human& human);

/// Joint trajectories from CSV: a header "time_s,hip_flexion_right_deg,..." (joint names with the unit _deg, _rad or
/// _m; root_x_m, root_y_m, root_z_m, root_roll_rad, root_pitch_rad, root_yaw_rad optional), then rows in ascending
/// time. Resampled by a monotone cubic with continuous velocity. Throws InputError with file, line and column.
std::unique_ptr<Motion> loadTrajectory(const std::filesystem::path& csv, const Human& human);

/// What walking is made of.
struct WalkOptions {
  double stand_s = 0;      ///< time at rest before the lead-in
  double lead_in_s = 0.5;  ///< smooth start from standing
  int strides = 2;
  double stride_time_s = 1.10;
};
/// Walking at natural speed (Bovi et al. 2011, closed to a period). `mean_velocity` returns the pelvis's mean velocity
/// over a stride [m/s].
std::unique_ptr<Motion> makeWalk(const Human& human, const WalkOptions& options, Vec3* mean_velocity = nullptr);

}  // namespace gambeson
