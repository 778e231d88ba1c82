#pragma once
/// The only reader of the live State: sums what the steps did over windows, and appends windows and frames to the
/// recording.
///
/// Tables, one row per window; the first two columns are start_s and end_s:
///   bodies    per body <name>_Jx_Ns .. Jz (impulse received from the cloth), <name>_Lx_Nms .. Lz (its moment about the
///   body
///             frame's origin), <name>_n_Ns (sum of normal impulses), <name>_t_Ns (sum of tangential magnitudes)
///   regions   per contact region of the scenario <name>_Jx_Ns .. Jz (impulse on the bodies), <name>_n_Ns, <name>_t_Ns
///   normal    per body <name>_Jx_Ns .. Lz_Nms: the part of `bodies` that presses; the rest rubs
///   body_zones  what each part of the body gets from each garment (cases/wear/recording/zone_ledger.hpp)
///   drag      per body <name>_Jx_Ns .. Lz_Nms: air drag on the cloth nearest to that body, as if the body carried it
///   supports  per support <name>_x_Ns .. z: impulse on the cloth, of a held edge on its own points too (their weight
///             and inertia are its); <name>_drop_m: mean sinking of the edge against its
///   link,
///             from where the springs were attached
///   skin      where the human has a skin: what its contact is at the joints (cases/wear/recording/skin_ledger.hpp)
///   memory    where the cloth's laws have friction in bending: what they remember (ClothMemoryView::columns), at the
///             window's end
///   sticking  sums of the normal impulses of contacts: <bodies|cloth>_n_Ns of all, _stuck_Ns of those that stick,
///   whose
///             sides move along each other by no more than ContactParameters::still
/// Frames hold of each sample the mean contact force over the window, the pressure (sum of the normal forces over the
/// sample's area as it is at the window's end, stretched) and that area; stress and strain. Those of a human with a
/// skin also hold the skin's vertices, the contact force on each and the pressure on it, over the skin's own area then.
///   steps     what the steps of the window reported (columns: stepColumns())

#include <array>
#include <optional>
#include <vector>

#include "cases/wear/recording/cloth_memory.hpp"
#include "cases/wear/recording/skin_ledger.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/scene/placed_bodies.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/cloth/stress.hpp"
#include "core/device_kind.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// Columns of the table "steps" after start_s and end_s.
const std::vector<std::string>& stepColumns();
/// Behind these where the cloth remembers or damps: what it has lost in the window.
constexpr const char* lost_column = "lost_energy_J";
/// Columns of "steps" of runs that keep account of the scheme's own energy, and of those that solve for velocities.
constexpr const char* integrator_column = "work_integrator_J";
constexpr const char* solve_columns[] = {"solve_iterations", "largest_missed_impulse"};

/// What stands before the parts of a column's name in the tables "regions" and "supports": of each the name, and of
/// what has the name of an earlier one its number behind it.
std::vector<std::string> regionNames(const Scenario& scenario);
std::vector<std::string> supportNames(const Scenario& scenario);

RecordingLayout recordingLayout(const Scenario& scenario, DeviceKind device = DeviceKind::cpu);

class Recorder {
 public:
  Recorder(const Scenario& scenario, RecordingWriter& writer);

  void observe(const State& before, const State& after, const StepReport& report, const StepResult& work,
               const Frequency& frequency);
  /// Work of supports beside what they do in steps [J].
  void addSupportWork(double J);
  /// Ends the window that began at start_s; appends a frame where `frame` says so.
  void closeWindow(const State& state, double start_s, bool frame, StepWork& work);

 private:
  struct Body {
    Vec3 force, moment;
    Vec3 pressing, pressing_moment;  ///< their normal parts
    double normal = 0, tangential = 0;
  };
  /// What sticks of the contacts of a step.
  void addSticking(const State& before, const State& after, const StepReport& report, const StepResult& work);
  void appendFrame(const State& state, double window_s);
  void addSkin(const State& state, double window_s, Frame& frame) const;

  const Scenario& scenario_;
  std::unique_ptr<const StressView> stress_;
  RecordingWriter& writer_;
  PlacedBodies placed_;
  ZoneLedger zones_;
  ClothMemoryView memory_;
  std::array<double, 4> sticking_{};  ///< as the table has them
  std::optional<SkinLedger> skin_;
  std::vector<Body> bodies_;
  std::vector<Body> regions_;  ///< without moments
  std::vector<Vec3> supports_;
  std::vector<Vec3> contact_;   ///< impulse per sample over the window
  std::vector<double> normal_;  ///< its normal part
  std::vector<double> limit_;   ///< multipliers of the strain limits times time, over the window
  std::vector<double> steps_;   ///< sums and extremes, in the order of stepColumns()
  double lost_J_ = 0;           ///< by laws that remember
  double integrator_J_ = 0;     ///< made or taken by the scheme
  long solve_iterations_ = 0;
  double largest_missed_ = 0;  ///< impulse that a solve for velocities has missed, of the momentum's scale
};

}  // namespace gambeson
