#pragma once
/// The tables that a run leaves: torques.csv, contact.csv, stress.csv. Each is replaced atomically; RunError where it
/// cannot be written.

#include <filesystem>

#include "analysis/contact_table.hpp"
#include "analysis/stress.hpp"
#include "analysis/torque.hpp"

namespace gambeson {

/// time_s, then one column per joint: hip_flexion_left_Nm (prismatic: _N). The contact torque; the wearer adds its
/// opposite. `variants` of the same joints and times follow, each joint's name with theirs behind:
/// hip_flexion_left_segments_Nm.
struct TorqueVariant {
  std::string name;
  const TorqueSeries* series = nullptr;
};
void writeTorques(const std::filesystem::path& csv, const Skeleton& skeleton, const TorqueSeries& series,
                  std::span<const TorqueVariant> variants = {});

/// time_s, then four columns per segment: thigh_left_N (magnitude), thigh_left_x_N, _y_N, _z_N in world axes.
void writeContact(const std::filesystem::path& csv, const Human& human, std::span<const ContactWindow> windows);

/// time_s, then five columns per region for each frame by itself: NAME_p50_N_per_m, _p95_, _p99_, _max_N_per_m,
/// NAME_max_strain.
void writeStress(const std::filesystem::path& csv, const Regions& regions, std::span<const StressFrame> frames);

}  // namespace gambeson
