#pragma once
/// What a run left, read back from its folder.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/trust.hpp"

namespace gambeson::study {

struct JointNumbers {
  std::string name;   ///< "hip_flexion_left"
  std::string label;  ///< "left hip (flexion)"
  bool prismatic = false;
  double peak_Nm = 0, peak_time_s = 0, rms_Nm = 0;  ///< of the added torque; the peak is signed
  double rate_at_peak = 0;                          ///< of the joint [rad/s]
  std::string cause;                                ///< completes "during ...", of the peak; empty where not known
  std::optional<double> standing_Nm;                ///< dressed at rest before the motion
  std::optional<double> natural_Nm;                 ///< peak moment of the task without the garment
  std::optional<double> foot_part, lever_m;         ///< of a natural moment of holding still: StaticMoment
  double normal_N = 0, friction_N = 0;              ///< mean sums of magnitudes of what counts at the joint
  std::optional<double> friction_Nm;                ///< the part of the peak that friction has
  std::vector<double> torque_Nm;                    ///< at RunNumbers::time_s

  std::string movement() const;        ///< of the label: "flexion"; empty where it has none
  std::optional<double> part() const;  ///< |peak| of the natural moment
  /// Nothing touches what lies beyond the joint: no sleeves, no torque.
  bool applies() const { return peak_Nm != 0 || normal_N != 0; }
};

struct GarmentNumbers {
  std::string name;
  double mass_kg = 0, area_m2 = 0, thickness_m = 0;
  int control_points = 0;
};

struct ContactNumbers {
  std::string segment;
  double share = 0, mean_N = 0, peak_N = 0, normal_N = 0, friction_N = 0;
};

/// A part of the body, both sides together, without belt and edges on springs.
struct ZoneNumbers {
  std::string zone;
  double force_N = 0, normal_N = 0, friction_N = 0;  ///< means of the sums of magnitudes
};

/// Pressure on a part of the body against what the case calls comfortable.
struct ComfortNumbers {
  std::string zone, light;
  double mean_Pa = 0, peak_Pa = 0, red_Pa = 0, peak_limit_Pa = 0, dose_kPa_min = 0, peak_time_s = 0;
  double amber_Pa = 0;        ///< the comfortable mean
  std::string peak_during{};  ///< phase of the stride; empty in other motions
  /// Over RunNumbers::pressure_time_s, as pressures.csv has them.
  std::vector<double> largest_Pa{}, mean_so_far_Pa{};
  /// Of the limit that is nearest or furthest surpassed: of the mean over time, or of the peak.
  double part_of_limit() const;
};

struct StressNumbers {
  std::string region;
  double p50_N_per_m = 0, p95_N_per_m = 0, p99_N_per_m = 0, max_N_per_m = 0, p99_strain = 0, max_strain = 0;
};

struct CheckNumbers {
  std::string name;
  double value = 0, limit = 0;
  std::string unit;
  bool holds = true;
};

struct RunNumbers {
  bool good = false;
  std::string why;     ///< where it is not good
  bool played = true;  ///< the motion went beyond its lead-in
  double recorded_to_s = 0, planned_to_s = 0, counted_from_s = 0;
  int control_points = 0;
  std::vector<GarmentNumbers> garments;
  std::vector<JointNumbers> joints;
  std::vector<double> time_s, pressure_time_s;  ///< of torques and of pressures
  std::vector<ContactNumbers> contact;
  std::vector<ZoneNumbers> zones;
  std::vector<ComfortNumbers> comfort;
  std::vector<StressNumbers> stress;
  double largest_strain = 0;
  double p99_strain() const;     ///< of the region where it is largest: 99 % of its area stretches no further
  std::vector<Stretch> stretch;  ///< of its fabrics, against what they are meant for
  bool natural() const;          ///< the natural moment of a joint is known
  std::vector<CheckNumbers> checks;
  /// Places where cloth passes through cloth as it has been put on, before the motion; nothing where that is not known.
  std::optional<int> crossings_dressed;

  double mass_kg() const;
  int failing() const;
  /// How far the run is to be trusted, as its own page says.
  Trust trust() const;
  double thinnest_mm() const;  ///< garment, 0 without one
  /// What the value of a check is to be held against, ", thinnest cloth 0.38 mm" for depths; else empty.
  std::string heldAgainst(const std::string& check) const;
  double sinking_mm() const;  ///< of the edge on springs that sinks most, NaN without one
  /// The joint of the largest |peak|, null without joints that turn and that the garment touches something beyond.
  const JointNumbers* highest() const;
  /// The joint that decides: of the largest part of its natural moment, or of the largest torque where none is known.
  const JointNumbers* decisive() const;
  const JointNumbers* joint(const std::string& name) const;
  const ComfortNumbers* comfortOf(const std::string& zone) const;
  /// The part of the body that is furthest from comfortable, null where nothing presses on one.
  const ComfortNumbers* leastComfortable() const;
  double pressing_N() const;  ///< of all zones
};

/// Reads summary.json, torques.csv and pressures.csv of a run's folder; a run of a structure has no joints. What cannot
/// be read makes the run not good, with its reason.
RunNumbers readRun(const std::filesystem::path& folder);

}  // namespace gambeson::study
