#pragma once
/// Joint trajectories from CSV.

#include <filesystem>

#include "human/motion/motion.hpp"

namespace gambeson {

/// Joint trajectories from CSV: a header "time_s,hip_flexion_right_deg,..." (joint names with the unit _deg, _rad or
/// _m; root_x_m, root_y_m, root_z_m, root_roll_rad, root_pitch_rad, root_yaw_rad optional), then rows in ascending
/// time. Resampled by a monotone cubic with continuous velocity. Throws InputError with file, line and column.
std::unique_ptr<Motion> loadTrajectory(const std::filesystem::path& csv, const Human& human);

}  // namespace gambeson
