#pragma once
/// The numbers of a recording: what summary.json, the tables and the report show. Only the motion counts (windows that
/// start at time 0 or later, frames after it), dressing and settling do not, unless a name says otherwise.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "analysis/compare.hpp"
#include "analysis/contact_table.hpp"
#include "analysis/series.hpp"
#include "analysis/stress.hpp"
#include "analysis/torque.hpp"
#include "analysis/trust.hpp"
#include "analysis/turning.hpp"
#include "cases/runs/frame_field.hpp"
#include "cases/wear/case/strides.hpp"
#include "cases/wear/results/body_map.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"
#include "human/motion/inverse_statics.hpp"
#include "tryon/girth.hpp"

namespace gambeson {

/// Of a skin, beside the generalised force: the added torque by segments (SkinLedger), when the generalised one peaks.
struct SegmentsMeasure {
  Peak peak;  ///< of its own course
  double at_peak = 0;
  double border_proximal = 0, border_distal = 0;  ///< at_peak with the border moved by SkinLedger::kBorder_m
};

/// The added torque: what the wearer's actuators must give on top, the opposite of the contact torque. Positive:
/// towards positive joint values (flexion, adduction, internal rotation).
struct JointMeasure {
  int joint = 0;
  std::string name, part, movement, side;  ///< "hip_flexion_left", "hip", "flexion", "left"
  bool prismatic = false;
  Peak peak;
  double rms = 0;
  std::optional<double> standing;                 ///< mean over the last 0.1 s before the motion: dressed, at rest
  double drag_at_peak = 0;                        ///< part of the peak that air drag has, in the unit of the peak
  double friction_at_peak = 0, friction_rms = 0;  ///< of the contact's tangential part; the rest is of what presses
  double position_at_peak = 0, rate_at_peak = 0;  ///< of the joint [rad, rad/s or m, m/s]
  std::optional<SegmentsMeasure> segments;
  std::optional<double> natural_Nm;     ///< peak moment of the task without the garment
  std::optional<StaticMoment> held;     ///< where that is of holding still: what makes it
  double normal_N = 0, friction_N = 0;  ///< mean sums of magnitudes over the counted bodies
  std::optional<double> phase_at_peak,
      phase_of_highest;                   ///< of the peak, and of the largest joint value, in its side's stride
  std::optional<Peak> lead_in_peak;       ///< before the strides
  std::vector<Peak> stride_peaks;         ///< of each stride that was recorded
  std::optional<Likeness> second_stride;  ///< against the first
  std::optional<Likeness> other_side;     ///< left, half a stride later, against this right
};

/// Whether the garment touches anything that the joint moves: else there is no torque to speak of.
inline bool isTouched(const JointMeasure& m) { return m.peak.value != 0 || m.normal_N != 0; }

/// The added torque against the task's own moment; the joint has one.
inline Light effortOf(const ComfortCase& c, const JointMeasure& m) {
  return lightOf(std::abs(m.peak.value) / *m.natural_Nm, c.effort_amber, c.effort_red);
}

/// Of one body beside its ContactShare.
struct BodyMeasure {
  ContactShare contact;
  double normal_N = 0, friction_N = 0;  ///< means of the sums of magnitudes; opposite pressures do not cancel here
};

/// What the bodies bear from one part of the garments.
struct RegionMeasure {
  std::string name;
  Vec3 mean_N;                          ///< on the bodies
  double normal_N = 0, friction_N = 0;  ///< means of the sums of magnitudes
};

/// Sums of magnitudes over contacts, which opposite pressures do not cancel, of a window or in the mean over time; and
/// the sum of the forces on the body, in which they do.
struct ZoneForce {
  double force_N = 0, normal_N = 0, friction_N = 0;
  Vec3 resultant_N;
  ZoneForce& operator+=(const ZoneForce& o) {
    force_N += o.force_N, normal_N += o.normal_N, friction_N += o.friction_N, resultant_N += o.resultant_N;
    return *this;
  }
};

/// What the parts of the body bear (zoneNames), from Measured::counted_from_s on.
struct ZonesMeasure {
  std::vector<std::string> names;
  std::vector<ContactGroup> groups;
  std::vector<std::vector<ZoneForce>> mean;  ///< [group][zone], over time
  std::vector<double> time_s;                ///< of the windows of the motion, and in each [zone]
  std::vector<std::vector<ZoneForce>> all, free;
  /// Time means of the norm of each zone's resultant, of all and of what presses freely.
  std::vector<double> mean_resultant_N, mean_free_resultant_N;

  /// In the mean, of the zones that are called `zone` or "<zone>_left" and "<zone>_right" ("": of all); `free`: without
  /// belt and edges on springs. A zone that the body lacks bears nothing.
  ZoneForce of(const std::string& zone, bool free_only) const;
  /// Sum of the means of the norms of the resultants of those zones.
  double resultantOf(const std::string& zone, bool free_only) const;
};

/// Pressure on one part of the body, from Measured::counted_from_s on, of the places that bear most.
struct ComfortMeasure {
  std::string zone;
  ComfortLimit limit;
  double mean_Pa = 0;                   ///< over time, at the place where that is largest
  double peak_Pa = 0, peak_time_s = 0;  ///< at any place and time
  double amber_m2 = 0;                  ///< area whose mean lies above amber
  double dose_kPa_min = 0;              ///< mean_Pa over the time that the case says it is worn
  std::string peak_during{};            ///< phase of the stride: of its own side's, of the left leg's in the middle
  Light light() const {
    return mean_Pa > limit.red_Pa || peak_Pa > limit.peak_Pa ? Light::red
           : mean_Pa > limit.amber_Pa                        ? Light::amber
                                                             : Light::green;
  }
};

/// How one body is touched in the last frame, seen from its origin: angles are from up, radii from the vertical axis.
struct TouchMeasure {
  std::string body;
  double normal_N = 0;        ///< sum of normal forces
  double area_m2 = 0;         ///< of the samples nearer than 1.01 layers
  double force_radius_m = 0;  ///< root mean square radius of the normal force
  /// In bands of kBandDegrees: normal force and area of the touching samples.
  std::vector<double> band_N, band_m2;
  static constexpr int kBandDegrees = 3;
  /// Of a circle with the contact's area.
  double radius_m() const;
};

struct SupportMeasure {
  std::string name;
  bool springs = false;
  Vec3 mean_N;  ///< on the cloth
  double peak_N = 0, peak_time_s = 0, largest_drop_m = 0;
};

/// What collided in a window.
struct CollisionWindow {
  double start_s = 0, end_s = 0;
  long contacts = 0, cloth_contacts = 0;  ///< the most of a step
  long impacts = 0, impact_zones = 0, cut_steps = 0, pinched = 0;
  long intersections = 0;  ///< contours, the most of a step
  double smallest_gap_m = 0, residual_m_per_s = 0, iterations = 0;
  double way_cells = 0;  ///< of a sample in a step, in sides of its cell, the largest
  /// Part of the normal impulses on bodies, and of cloth on cloth, that contacts have which stick; NaN where none
  /// press.
  double sticking = std::numeric_limits<double>::quiet_NaN(), cloth_sticking = sticking;
};

/// Over all windows of the run, dressing included, but for what says otherwise.
struct StepMeasure {
  long steps = 0, unconverged = 0, impacts = 0;
  long yielded = 0;  ///< steps whose contacts contradicted each other (cloth is pinched) and gave way
  double shortest_s = 0, mean_s = 0, longest_s = 0;
  double frequency_rad_per_s = 0, frequency_time_s = 0;  ///< largest
  std::array<double, 4> shares{};                        ///< membrane, bending, seam, spring, at the largest frequency
  std::string governing;
  double largest_residual_m_per_s = 0, momentum_error = 0, momentum_error_time_s = 0;
  double deepest_m = 0, deepest_time_s = 0;  ///< of a sample, in the motion
  double mean_iterations = 0;
  std::vector<CollisionWindow> collisions;
  long projections = 0;               ///< of strain limits
  long limited = 0, unlimited = 0;    ///< steps after settling, and those of them in which limits did not hold
  double largest_limit_residual = 0;  ///< of the strain, after settling
  double largest_limit_residual_settling = 0;
  long solves = 0;  ///< of velocities, by implicit schemes
  double solve_iterations = 0, largest_missed_impulse = 0;
};

/// Change of the total energy from the end of the first window of the motion, against the works since [J].
struct EnergyMeasure {
  double change = 0, contact = 0, friction = 0, separation = 0, restoring = 0, drag = 0, supports = 0, limit = 0,
         absolute = 0;
  double lost = 0;  ///< in the cloth: to what its laws remember, and to its damping
  /// Below it a sum of works is rounding: what moves the cloth's mass at a micrometre per second.
  double negligible = 0;
  /// What lifts the cloth by lift_m, m g h. Cloth that hangs still has next to no work done on it, of which any drift
  /// is a large share; what counts then is how far the cloth could have sunk or risen by it. 0 without gravity.
  double lift = 0;
  static constexpr double lift_m = 1e-3;
  double dissipated = 0;  ///< by friction, inelastic impact, drag and in the cloth
  /// What the scheme itself made (positive) or took, where the run has kept account of it.
  std::optional<double> integrator;
  double drift() const { return change - (contact + drag + supports + limit - lost + integrator.value_or(0)); }
  std::vector<std::array<double, 11>> rows;  ///< of the windows of the motion, as energy.csv has them
  /// The drift, of the works or of the lift, whichever is more: 5 % are 5 % of the work of a motion, and of cloth at
  /// rest what moves it by 0.05 mm.
  double relative() const { return ofWorks(drift()); }
  /// What the scheme made, likewise.
  double made() const { return ofWorks(std::max(0.0, integrator.value_or(0))); }
  double ofWorks(double energy) const {
    const double works = std::max(absolute, lift);
    return works <= negligible ? 0 : energy / works;  // NaN fails
  }
};

/// As the recording stores it, in single precision.
struct RecordedRange {
  std::array<float, 3> low{}, high{};                                                ///< of the last frame's samples
  float stress_low = 0, stress_high = 0, last_stress_low = 0, last_stress_high = 0;  ///< of all frames, of the last
};

/// Of the surface itself, evaluated four times finer than the samples in each direction, at every frame of the motion.
struct SurfaceDepth {
  double deepest_m = 0, time_s = 0;
  int points = 0;
};
SurfaceDepth surfaceDepth(const Scenario& scenario, const RecordingReader& recording);
/// The widest gap between both sides of a sewn seam, at points all along (SewnRows::pairs), at every frame of the
/// motion.
struct SeamGap {
  double gap_m = 0, cells = 0;  ///< and in sides of the smaller cell there
  double time_s = 0;
  Vec3 at_m;
};
/// None where nothing is sewn so.
std::optional<SeamGap> widestSeamGap(const Scenario& scenario, const RecordingReader& recording);
/// The control points of a frame. Throws RunError where they are not `count`.
std::vector<Vec3> controlPointsOf(const Frame& frame, std::size_t count);

/// One garment of the case.
struct GarmentMeasure {
  std::string name, fabric;
  double mass_kg = 0, area_m2 = 0, thickness_m = 0;  ///< the mean where it varies
  int control_points = 0;
  double least_thickness_m = 0, largest_thickness_m = 0;
  bool varies() const { return largest_thickness_m > least_thickness_m; }
};
std::vector<GarmentMeasure> garmentMeasuresOf(const Scenario& scenario);
/// Of the cloth at each sample [m].
std::vector<double> thicknessOf(const Scenario& scenario);

/// Of one patch in one frame: the first principal stress resultant, and how it is bent. NaN where there is no such
/// sample.
struct PatchMeasure {
  double inner_p95_N_per_m = 0, inner_max_N_per_m = 0;  ///< without the cells at free edges (analysis/sheet_cells.hpp)
  double clear_max_N_per_m = 0;                         ///< without the cells at re-entrant corners
  double curvature_rms_1_per_m = 0;                     ///< root of the mean of k11^2 + k22^2 + 2 k12^2
  Turning turning;                                      ///< about its centre (analysis/turning.hpp)
};

/// What the straps carry (tryon/strap_cut.hpp); without cuts where there are none, or strains are limited.
struct StrapsMeasure {
  struct Cut {
    std::string name;  ///< "shirt strap_left start"
    double width_m = 0;
  };
  struct At {
    double time_s = 0;
    std::vector<Vec3> pull_N;          ///< of each cut, on what hangs from it
    Vec3 weight_N, contact_N;          ///< of the straps' garment but the straps' middles; of bodies on it
    Vec3 all_weight_N, all_contact_N;  ///< the same of all garments: what cloth does to cloth cancels
    Vec3 supports_N;                   ///< on all garments
  };
  std::vector<Cut> cuts;
  std::vector<At> at;  ///< the frames of the motion
  At mean;             ///< of those that count
  double width_m() const {
    double sum = 0;
    for (const Cut& c : cuts) sum += c.width_m;
    return sum;
  }
};

/// How far a garment falls along gravity, in the mean over its area, against the part of the body that it goes with
/// best, of those that it lay on when the recording began: in the motion, and while it is put on by more than 0.1 m.
struct FallMeasure {
  std::string garment;  ///< empty where there is one only
  double largest_m = 0, time_s = 0;
};

/// The girth of a part of the body by the tape (human/body/girths.hpp), and how long the cloth of each garment is that
/// goes around it in the same plane [m], as the motion begins: as it is worn, and as it was cut, at rest. What it was
/// cut to be wider than the body is the ease.
struct GirthMeasure {
  std::string zone;
  double body_m = 0;
  struct Worn {
    std::string garment;  ///< empty where there is one only
    double length_m = 0, rest_m = 0;
  };
  std::vector<Worn> worn;  ///< those that go around it
};

/// A garment of flat panels that is put on but too small: where it is stretched the most around the body as the motion
/// begins (tryon/girth.hpp).
struct ShortMeasure {
  std::string garment;
  std::vector<Girth> at;
};

/// The share of a garment that lies inside of one that belongs under it, by area, of what of it has that one within 30
/// mm along its normal; the largest of up to 40 frames of the motion. Such garments need not cross.
struct GarmentOrderMeasure {
  std::string lower, higher;
  double largest = 0, time_s = 0;
};

/// What the cloth of each patch remembers (cases/wear/recording/cloth_memory.hpp), at the ends of the windows of the
/// motion. Empty where it remembers nothing.
struct MemoryMeasure {
  struct Of {
    double set_per_m = 0, largest_set_per_m = 0, friction_left = 1, least_friction_left = 1;
  };
  std::vector<std::string> patches;
  std::vector<double> time_s;
  std::vector<std::vector<Of>> rows;  ///< [window][patch]
};

/// Of the normal impulses of the motion, the part that sticking contacts have; NaN where nothing presses.
struct StickingMeasure {
  double bodies = std::numeric_limits<double>::quiet_NaN(), cloth = bodies;
};

struct Measured {
  double recorded_end_s = 0;
  double counted_from_s = 0;       ///< peaks and mean squares of torques count from here on
  std::optional<Strides> strides;  ///< of the motion, which may go on beyond what was recorded
  /// How far the motion was played: it did not begin, it ended before its first stride began, or before that had ended.
  enum class Played { nothing, lead_in, part_of_a_stride, strides } played = Played::strides;
  Human bodies;  ///< every body of the scenario as a link without joints, for the tables per segment
  std::vector<ContactWindow> windows, drag;  ///< one link per body
  TorqueSeries added, added_drag;
  /// Of a skin, by segments, and with the border moved (SkinLedger); without a skin they have no windows.
  TorqueSeries added_segments, added_proximal, added_distal;
  TorqueSeries added_friction;  ///< the part of `added` that friction has
  std::vector<JointMeasure> joints;
  std::vector<BodyMeasure> contact;
  std::vector<RegionMeasure> contact_regions;
  ZonesMeasure zones;
  std::vector<ComfortMeasure> comfort;  ///< of the parts that are touched
  std::shared_ptr<const BodyMap> body;  ///< with its loads; null without a human
  BodyLoads body_loads;
  std::vector<double> cloth_time_s;              ///< of the frames of the motion
  std::vector<std::vector<PatchMeasure>> cloth;  ///< [frame][patch]
  StrapsMeasure straps;
  double peak_time_s = 0;  ///< of the largest added torque; without joints of the largest sum of contact forces
  std::vector<SupportMeasure> supports;
  std::vector<TouchMeasure> touch;  ///< of each body; empty without frames
  Regions regions;
  std::vector<StressFrame> frames;
  std::vector<StressSummary> stress;
  std::vector<Stretch> stretch;                    ///< of each garment, against what its fabric is meant for
  std::vector<GirthMeasure> girths;                ///< of a human
  std::vector<ShortMeasure> too_short;             ///< of those that do not fit
  std::vector<FallMeasure> falls;                  ///< of each garment that a human wears
  std::vector<GarmentOrderMeasure> garment_order;  ///< of each two garments that a human wears
  StepMeasure steps;
  EnergyMeasure energy;
  MemoryMeasure memory;
  StickingMeasure sticking;
  double cloth_kg = 0;                        ///< mass of all garments
  bool limited = false;                       ///< whether the case limits strain
  std::optional<SurfaceDepth> surface_depth;  ///< costs seconds: only where asked for
  std::optional<SeamGap> seam_gap;            ///< the same
  /// Of each frame of the motion, ThreadStrains::columns: only where asked for.
  std::vector<std::vector<double>> thread_strains;
  std::optional<RecordedRange> recorded;
  LawRange law_range;  ///< of cloth whose law is a table: of the frame with the most points beyond it

  /// Whether the run went on to where its case ends: what was found of the whole motion is of what was played.
  bool playedToTheEnd(const Scenario& s) const { return !(recorded_end_s < s.end_s - 1e-9); }
  const JointMeasure* highest() const;  ///< of joints that turn and that the garment touches something beyond; or null
};

Measured measure(const Scenario& scenario, const RecordingReader& recording);
/// With what costs seconds: SurfaceDepth, Stretch, FallMeasure and GarmentOrderMeasure, for summary and page.
Measured measureAll(const Scenario& scenario, const RecordingReader& recording);

// Its parts (steps.cpp): the table "steps", and the frames.
void measureSteps(const RecordingReader& recording, Measured& out);
void measureFrames(const RecordingReader& recording, Measured& out);
/// Of memory.cpp, after the steps: tables "memory" and "sticking", which recordings of before lack.
void measureMemory(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of comfort.cpp; after the joints too.
void measureComfort(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of zones.cpp; after the joints, which say from when on windows count.
void measureZones(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of cloth.cpp: costs seconds; after the joints.
void measureCloth(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Green-Lagrange strain along the weft, then the warp, at each sample of a frame.
std::array<std::vector<float>, 2> threadStrains(const Scenario& scenario, const StressView& field, const Frame& frame);
/// Of fit.cpp: cost seconds; after the frames.
void measureStretch(const Scenario& scenario, const RecordingReader& recording, Measured& out);
void measureFalls(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of girths.cpp.
void measureGirths(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of garment_order.cpp: costs seconds.
void measureGarmentOrder(const Scenario& scenario, const RecordingReader& recording, Measured& out);
/// Of touch.cpp.
void measureTouch(const Scenario& scenario, const RecordingReader& recording, Measured& out);

/// Three numbers each; and where a frame's control points stand.
std::vector<Vec3> vectorsOf(const std::vector<float>& numbers);
std::vector<Vec3> controlsOf(const Frame& frame);
/// Areas of the samples as they are in the frame [m^2], of which its pressures are forces. Recordings from before have
/// none: their pressures are over the areas at rest, which are returned.
std::vector<double> sampleAreas(const Scenario& s, const Frame& frame);
Regions regionsOf(const Scenario& scenario);
/// From when on torques, forces and pressures count: the strides' start where the last of them was recorded to its end,
/// else 0.
double countedFrom(const Scenario& scenario, const RecordingReader& recording);

}  // namespace gambeson
