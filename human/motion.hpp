#pragma once
/// Motion: joint values and root pose over time, with continuous velocity.

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "human/body.hpp"
#include "human/ground.hpp"

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
  int paces = 0;  ///< single steps after the lead-in in place of strides; 0: strides count
  double stride_time_s = 1.10;
  double strideCount() const { return paces > 0 ? 0.5 * paces : strides; }
};
/// Walking at natural speed (Bovi et al. 2011, closed to a period). `mean_velocity` returns the pelvis's mean velocity
/// over a stride [m/s].
std::unique_ptr<Motion> makeWalk(const Human& human, const WalkOptions& options, Vec3* mean_velocity = nullptr);

/// What climbing stairs is made of.
struct StairOptions {
  double stand_s = 0;       ///< time at rest before the lead-in
  double lead_in_s = 0.6;   ///< the first step, from standing; 0.4 to 0.7 strides' time
  int strides = 2;          ///< of two steps each, after the lead-in
  int lead_in_strides = 1;  ///< how many of them come before what is measured
  double stride_time_s = 1.2;
  double measuredFrom_s() const { return stand_s + lead_in_s + lead_in_strides * stride_time_s; }
};
/// Climbing stairs (Bovi et al. 2011, human/stairs.cpp); Motion::stairs() has the stairs that the steps imply.
std::unique_ptr<Motion> makeStairs(const Human& human, const StairOptions& options, Vec3* mean_velocity = nullptr);

/// What taking aim is made of.
struct AimOptions {
  double stand_s = 0;  ///< time at low ready before it
  double duration_s = 1.5;
  double hold_s = 0;           ///< time aiming after it
  double rifle_mass_kg = 3.5;  ///< enters natural moments, not contact
};
/// From low ready to aiming at the ground, leaning left (Zheng 2013, 6.6; human/aim.cpp).
std::unique_ptr<Motion> makeAim(const Human& human, const AimOptions& options);

}  // namespace gambeson
