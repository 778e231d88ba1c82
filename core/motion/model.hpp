#pragma once
/// The constant model of a run, its state, and what a step reports.

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/cloth.hpp"
#include "core/cloth/sewn_projection.hpp"
#include "core/contact/impact_zones.hpp"
#include "core/contact/method.hpp"
#include "core/contact/proximity.hpp"
#include "core/contact/response.hpp"
#include "core/motion/collisions.hpp"
#include "core/motion/stage_work.hpp"
#include "core/motion/stitch.hpp"
#include "core/motion/strain_limit.hpp"
#include "core/motion/supports.hpp"

namespace gambeson {

struct Skin;

/// How what a support holds is moved at some time: x = pose X from where X stood before it moved, and its velocities.
struct HeldMotion {
  Pose pose;
  RigidVelocity rate;
};

/// What is prescribed over time: where the obstacles and the frames that supports hang on stand.
class Stage {
 public:
  virtual ~Stage() = default;
  virtual void placements(double time_s, std::span<Placement> obstacles, std::span<Placement> anchors) const = 0;
  /// Where the vertices of an obstacle that deforms are, in the world. A motion with continuous velocity.
  virtual void vertices(int obstacle, double time_s, std::span<Vec3> x) const;
  /// The skin whose vertices an obstacle's are at a time, skinPositions of these poses of its links; null: they are not
  /// these alone.
  virtual const Skin* skin(int /*obstacle*/, double /*time_s*/, std::vector<Pose>& /*poses*/) const { return nullptr; }
  /// How held points are moved, Model::held_motion_count motions.
  virtual void heldMotions(double, std::span<HeldMotion>) const {}
  /// Velocity of the air, for the drag [m/s].
  virtual Vec3 air(double) const { return {}; }
};

/// An elastic spring from a sample to a point fixed in an anchor frame; force = -stiffness (x - anchor). Above an
/// obstacle that deforms it acts along that only, without its part along the normal of the given triangle: a waistband
/// is held by the hips' bones, and what lifts the skin under it lifts the band.
struct SpringSupportPoint {
  int sample = 0;
  int anchor = 0;  ///< frame
  double stiffness_N_per_m = 0;
  int obstacle = -1;              ///< that deforms, or none
  std::array<int, 3> triangle{};  ///< its vertices
};

/// How sewn seams that are apart are closed (core/motion/sewing.hpp).
struct SewingOptions {
  double close_per_s = 20;      ///< part of a gap
  double close_m_per_s = 0.25;  ///< at most
};

struct Environment {
  Vec3 gravity_m_per_s2{0, 0, -9.81};
  double drag_kg_per_m2s = 0;  ///< eta: force per area -eta (v - air), Zheng 2013, section 2.2.3
};

/// Constant after it is built.
struct Model {
  std::shared_ptr<const Cloth> cloth;
  Surface surface;
  Bulges bulges;
  std::vector<double> mass_kg, inverse_mass, area_m2;  ///< of the free points; inverse_mass is 0 where held
  std::vector<char> held;                              ///< free points that do not move, or as is prescribed
  std::vector<int> held_points;  ///< free points that something takes hold of, in whole or in part, ascending
  /// Of each of held_points which motion of the Stage's moves it, or -1; empty: nothing is moved. Of worn cloth.
  std::vector<int> held_motion;
  int held_motion_count = 0;
  std::vector<double> density_kg_per_m2;  ///< of the samples
  std::vector<int> place;                 ///< of the samples, so that neighbours at rest stand together (halvedPlaces)
  std::vector<double> cell_m;   ///< of the samples: the shorter side of their cell at rest, through its middle
  std::vector<double> layer_m;  ///< of the samples: least distance to a body; of cloth to cloth, half the sum of both
  SparseRows weft;  ///< samples x free points: along the weft at rest, where friction goes with the direction
  Environment environment;
  ContactParameters contact;
  std::unique_ptr<const BodyMethod> method;  ///< of contacts with bodies; null: all contacts are solved together
  std::vector<Obstacle> obstacles;
  std::unique_ptr<ProximityQuery> proximity;
  CollisionModel collisions;
  std::vector<SpringSupportPoint> springs;
  int anchor_count = 0;
  /// How far above its sample each spring is anchored, so that the springs of a garment carry it where they were
  /// attached: -g M / sum k, M the mass of the garment [m].
  std::vector<Vec3> spring_rise_m;
  std::vector<Vec3> dead_force_N;  ///< constant forces of the free points; empty where there are none
  StrainLimit strain_limit;
  StrainRows strain_rows;  ///< without points where strain is not limited
  SewnProjection sewing;   ///< of the free points; empty: no seams are projected
  SewingOptions sewing_options;
  SparseRows sewn_ties;           ///< SewnProjection::ties, which contacts see
  std::vector<int> sewn_garment;  ///< of each row of `sewing`
  SparseRows sewn_pairs;          ///< SewnRows::pairs of the free points
  std::vector<double> sewn_cell_m;
  std::vector<NetEdge> net;
  std::vector<Stitch> stitches;
  std::vector<double> inner_mass;  ///< of the rates of the inner unknowns (Cloth::innerMasses)
  double inner_drag_per_s = 0;     ///< of these over their mass: what drag and damping take from a mean point
  /// Of the free points: eta times area, what damps stitches, and damping by mass of a structure.
  std::vector<double> drag_kg_per_s;
  // Of cloth that is a structure; null for worn cloth.
  const Structure* structure = nullptr;  ///< whose loads act
  std::unique_ptr<const Supports> supports;

  int freeCount() const { return static_cast<int>(mass_kg.size()); }
};

/// Where Model::held_points has the free point `i`, which is held.
inline std::size_t heldSlot(const Model& m, int i) {
  return static_cast<std::size_t>(std::lower_bound(m.held_points.begin(), m.held_points.end(), i) -
                                  m.held_points.begin());
}

struct ModelOptions {
  int samples_per_cell = 2;
  std::vector<int> patch_samples_per_cell;  ///< of each patch, in place of samples_per_cell; or empty
  std::vector<int> held_control_points;
  std::vector<int> held_motion;  ///< of each of these, which of the Stage's motions moves it, or -1; empty: none is
  std::vector<SpringSupportPoint> springs;
  int anchor_count = 0;
  std::vector<Vec3> dead_force_N;  ///< per control point, such as edgeForce gives; empty: none
  StrainLimit strain_limit;
  SewingOptions sewing;
  bool self_contact = true;  ///< cloth touches cloth
  std::vector<Stitch> stitches;
  /// Whose supports, loads and damping act, in the place of held points and dead forces; outlives the model.
  const Structure* structure = nullptr;
};

/// contact.layer_m = 0: each sample keeps the thickness of its fabric. Throws InputError.
std::unique_ptr<Model> buildModel(std::shared_ptr<const Cloth> cloth, const ModelOptions& options,
                                  const Environment& environment, const ContactParameters& contact,
                                  std::vector<Obstacle> obstacles);

/// Lets go of what is held but for these control points. Of worn cloth; a state needs evaluateForces then (step.hpp).
void holdOnly(std::span<const int> control_points, Model& model);

/// Sums over the free points of the forces that are not internal [N].
struct ForceSums {
  Vec3 drag, springs,
      held;  ///< `held`: what held points exert on the free ones, minus the internal force of their rows
  /// Of a structure. `held` is there what its supports exert on all points.
  Vec3 loads{};
};

/// What a contact leaves to the next step.
struct WarmContact {
  ContactKind kind = ContactKind::sample_on_body;
  int sample = 0, obstacle = 0, feature = 0;
  Vec3 traction;            ///< impulse per area that the next solve starts from [N s/m^2]
  double mean_Pa = 0;       ///< pressure that has lasted (lastingPressure)
  double slip_m_per_s = 0;  ///< of friction that depends on it; 0: it sticks
};

/// All that the next step depends on.
struct State {
  double time_s = 0;
  /// Free points: position, velocity, acceleration without contact and without strain limits; of a structure also
  /// without what supports prescribe.
  std::vector<Vec3> p, v, a;
  /// What an implicit scheme moves in their place, displacements u = C y + shifts (DofMap) [m], which have more digits
  /// than positions; empty elsewhere.
  std::vector<double> y;
  /// What the cloth's laws remember: committed by the step that ended here.
  std::vector<double> history;
  /// Unknowns that no sample sees: values, rates, and accelerations of these.
  std::vector<double> inner, inner_rate, inner_acceleration;
  std::vector<Vec3> anchors;  ///< of each spring, in its anchor frame
  ForceSums sums;             ///< at this time
  /// Force on each of Model::held_points that keeps it still, or on its way, without limits and contact; of worn cloth
  /// without the inertia and the drag of what is moved.
  std::vector<Vec3> held_N;
  std::vector<WarmContact> warm;
  bool tangled = true;          ///< cloth may pass through cloth or a mesh: look for intersections
  std::vector<int> pinched;     ///< samples that no step length frees: their impacts are let pass in the next step
  std::vector<double> limit_J;  ///< multipliers of the strain limits, mean of the last step (eq. 5.7)
  /// Acceleration of the free points by contacts that press, in the last step (pressingAccelerations), of which v holds
  /// the half step; empty: none [m/s^2].
  std::vector<Vec3> pressed;
  double damping_W = 0;  ///< power that the cloth's own damping takes at v (clothDampingPower)
  // Step control.
  double frequency_rad_per_s = 0;  ///< estimate of the largest
  std::vector<Vec3> mode;          ///< its mode, warm start of the next estimate
  int steps_to_estimate = 0;
  /// Within which the estimate takes slopes of laws that are an energy at a point; none where there are no such laws.
  std::optional<StrainBox> law_strains;
  double swing = 0;  ///< of the highest modes, its peaks held for a while (core/motion/resonance.hpp)
  double share = 0;  ///< of the stable step that this swing allows; 0 where there was no step yet
  double last_step_s = 0;
  // Of schemes that keep account of what they make or take of energy, and that solve for velocities.
  std::optional<double> elastic_J;  ///< stored in the cloth, its springs and stitches here; absent: not known
  std::vector<Vec3> free_change;    ///< what the last solve changed velocities by, where the next one starts [m/s]
};

/// Momentum of the free points over one step [N s]: change = gravity + dead + drag + supports + pressing - obstacles.
struct MomentumAudit {
  Vec3 change, gravity, drag;
  Vec3 supports;   ///< springs and what holds points, with the pull of strain limits on held points
  Vec3 dead;       ///< dead forces, and all loads of a structure
  Vec3 obstacles;  ///< the obstacles' own ledger: what they received
  Vec3 pressing;   ///< by how much more of the contacts' next impulses the velocities hold in advance, State::pressed
  Vec3 missed;     ///< what the solve for velocities has left over: impulses that the forces say and no point has got
  double error() const { return norm(change - (gravity + dead + drag + supports + pressing + missed - obstacles)); }
  /// Sum of the absolute impulses, the scale of `error`; at least what rounding is measured by (kScaleFloor in
  /// step.cpp).
  double scale = 0;
};

/// How the velocities of an implicit scheme were found.
struct VelocitySolve {
  int iterations = 0;   ///< of conjugate gradients
  double residual = 0;  ///< what is left of the right side, as its tolerance is
};

/// Work over one step [J].
struct WorkAudit {
  double contact = 0;     ///< of the contact impulses on the cloth
  double separation = 0;  ///< part of it: what restoring the layer's distance adds
  double restoring = 0;   ///< part of it: what freeing intersections adds (section 4.3)
  double friction = 0;    ///< part of it: tangential
  double drag = 0, supports = 0;
  double limit = 0;  ///< of the strain limits' impulses on the points that move; of a structure on all
  double loads = 0;  ///< of a structure's
  double cloth = 0;  ///< lost in the cloth itself: to hysteresis, at least 0, and to damping (clothDampingPower)
  /// What the scheme itself makes (positive) or takes: the change of the energy that forces taken at single instants
  /// give and their exact course would not. Not of velocity Verlet where nobody asks (StepControl::audits_energy).
  double integrator = 0;
  /// Lost to friction, inelastic impact, drag and in the cloth, at least 0: works relative to the bodies and the air,
  /// without what separation and restoring add.
  double dissipated = 0;
};

/// Why a step was not made. `impact`: pairs would pass through each other; `held`: one of them is of an obstacle and
/// cloth that is held against it, which no shorter step changes; `unsolved`: the velocities of an implicit scheme were
/// not found.
enum class StepFailure { none, not_finite, impact, held, unsolved };

struct StepReport {
  StepFailure failure = StepFailure::none;
  std::string why;
  double step_s = 0;
  MomentumAudit momentum;
  WorkAudit work;
  ContactSolve contact;
  LimitReport limit;
  VelocitySolve solve;
  int contacts = 0;        ///< persistent, with bodies and of cloth with cloth
  int cloth_contacts = 0;  ///< those of cloth with cloth
  int impacts = 0;         ///< pairs that would have passed through each other after the first solve
  int impact_rounds = 0;
  int impact_zones = 0;        ///< rigid impact zones
  double earliest_impact = 1;  ///< of the step, where it failed for impacts, held or not
  int cuts = 0;                ///< times that the step was cut or halved before it worked
  int pinched = 0;             ///< samples whose impacts were let pass
  int intersections = 0;       ///< contours at the start of the step
  bool searched = false;       ///< for them
  int inside = 0;              ///< samples inside of meshes at the start of the step
  double smallest_gap_m = 0;   ///< of the persistent contacts; negative inside bodies; the largest double where none
  double deepest_m = 0;        ///< largest penetration of a sample at the start of the step, 0 if none
  double largest_way = 0;      ///< of a sample during the step, in sides of its cell (Model::cell_m)
};

/// Wall time of the phases of the steps so far [s].
struct PhaseTimes {
  double stage = 0, proximity = 0, contact = 0, impact = 0, force = 0, limit = 0, other = 0;
  double tangles = 0, freeing = 0;  ///< finding intersections, and what frees them (its solve is among the contacts')
  /// Of all, the steps that looked for intersections: how many, and how long they took.
  long searches = 0;
  double searched_steps = 0;
};

/// What a step did, for the recorder and the ledger.
struct StepResult {
  std::vector<ContactRow> rows;  ///< contacts that were solved
  std::vector<Vec3> impulses;    ///< of these, per area of the rows' samples: on the cloth [N s]
  ImpactZones impact_zones;
  std::vector<Vec3> impact_zone_change;  ///< velocity of each free point that impact zones added, where there are any
  std::vector<ContactImpulse> contact_impulses;  ///< of bodies on the cloth
  std::vector<Vec3> spring_impulses;             ///< on the cloth, one per spring [N s]
  /// On each of Model::held_points by what holds it, with that point's own weight, contacts and limits [N s].
  std::vector<Vec3> held_impulses;
};

/// Scratch of a step. Nobody outside of core/motion reads it.
struct StepScratch {
  ClothWork cloth;
  ContactWork contact;
  MethodWork method;
  std::vector<RowLayer> row_layer;  ///< of the rows, where Model::method asks
  LimitWork limit;
  SewnProjection::Work sewn;
  std::vector<Vec3> sewn_rates, sewn_force, sewn_part, sewn_right;
  std::vector<char> sewn_open;  ///< of each row of Model::sewing, whether its garment's seams are far open
  /// What seams give all free points, held ones too, where they close, and with what they give under contact [N s].
  std::vector<Vec3> sewn_closing, sewn_impulse;
  StageWork stage;
  CollisionWork collisions;
  std::vector<double> inner_force;
  std::vector<Vec3> damping, net_velocity;  ///< of cloth that damps (core/motion/cloth_damping.hpp)
  double damping_power_W = 0;
  std::vector<HeldMotion> held_start, held_end;  ///< motions of held points at the ends of the step
  std::vector<Vec3> q, f, predictor, velocity, x0, x1, sample_velocity, sample_force, spring_force, warm;
  std::vector<RowSlip> slip;  ///< of the rows, where friction depends on the motion; else empty
  // Of a structure.
  Supports::Solver support_solver;
  std::vector<Vec3> load, load_before, external, support_force, prescribed, released, start, accelerations;
  std::vector<Vec3> row_mean;        ///< velocity that the impulse of each row works on, in the mean [m/s]
  std::vector<Vec3> jerk, net_jerk;  ///< changes of acceleration: of the free points, of the control points
  std::vector<Vec3> limit_end, moved, sample_impulse, pulled_before, pulled_after;
  std::vector<Vec3> lasting, sample_pressing;
  std::vector<double> reach;
  std::vector<Contact> near;
  std::vector<SampleHit> hits;
  std::vector<int> near_first;  ///< of each sample in `near`, sorted by sample
  std::vector<PairHit> pair_hits;
  std::vector<char> inside;  ///< samples that are behind a body's surface
  std::vector<ContactRow> restoring, edge_rows, yielding;
  std::vector<int> stuck;  ///< samples of the pairs that no impact zone kept apart, where the step failed for impacts
  std::vector<Vec3> unsolved;  ///< velocities before the contacts
  bool audits_energy = false;  ///< StepControl::audits_energy
};

/// What steps work with, one after the other.
struct StepWork : StepScratch, StepResult {
  PhaseTimes times;  ///< summed over the steps
};

}  // namespace gambeson
