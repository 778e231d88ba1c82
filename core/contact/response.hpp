#pragma once
/// The contact impulses of one step, all contacts solved together (Zheng 2013, sections 3.2.2, 3.3.2 and 3.5, with
/// consistent impulses and effective masses).

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/contact/proximity.hpp"
#include "core/material/laws/friction.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

struct ContactRow;

/// How the impulses of a step's contacts with bodies are found: all contacts at once (solveContacts), or by a box of
/// Man 2006, section 3.3 (method.hpp).
enum class ContactMethod { together, penalty, forward_increment, projection };

struct ContactParameters {
  double layer_m = 0;       ///< delta: the distance at which persistent contact begins and which it restores
  FrictionLaw friction;     ///< between cloth and bodies
  double relaxation_s = 0;  ///< tau: the correction of the distance takes this time, k = 1 - exp(-dt/tau) of eq. 3.17
  double tolerance_m_per_s2 = 1e-2;  ///< a solve is done at a residual velocity of this times dt
  int max_iterations = 8000;
  double compliance_m_per_Pa = 1e-9;                   ///< c: how much a pressure that lasts compresses the layer
  std::optional<FrictionLaw> on_cloth = std::nullopt;  ///< between cloth and cloth, if that differs
  /// Of obstacles and of garments that have their own, which with a body an obstacle's is before; shorter lists mean
  /// none.
  std::vector<std::optional<FrictionLaw>> of_obstacle = {}, of_garment = {};
  std::vector<int> garment_of_sample = {};  ///< where garments have their own
  ContactMethod method = ContactMethod::together;
  double penalty_Pa_per_m = 0;  ///< eps_N of ContactMethod::penalty
  bool newton = false;          ///< islands that sweeps have not solved for long go on by newton_rows.hpp

  const FrictionLaw& frictionOf(const ContactRow& row) const;
  /// Whether any friction is more than Coulomb's.
  bool followsMotion() const;
  /// Whether any goes with the direction of the cloth.
  bool followsThreads() const;
  /// Speed below which a contact counts as one that sticks, in a step [m/s].
  double still(double dt_s) const { return 4 * tolerance_m_per_s2 * dt_s; }
};

/// How a contact whose friction depends on the motion moves, from step to step and within one.
struct RowSlip {
  bool slips = false;
  bool broke = false;  ///< it began to slip in this step, and does so once
  double speed_m_per_s = 0;
  double friction = 0;  ///< mu that goes with it
  double drag = 0;      ///< traction of viscosity, times dt [N s/m^2]
  Vec3 weft{};          ///< of the cloth there, unit, where friction goes with the direction
};

/// Samples whose weighted velocities make up the velocity that a contact acts on: one sample on a body (weight 1), a
/// sample and a triangle, two edges; weights of one side are positive, of the other negative.
struct Stencil {
  int count = 0;
  std::array<int, 5> sample{};
  std::array<double, 5> weight{};

  void add(int s, double w) {
    sample[count] = s;
    weight[count++] = w;
  }
};

/// A contact with what the solve needs to know of it. Its relative velocity is sum w v(sample) - body_velocity, its
/// impulse lambda acts on each sample as w lambda.
struct ContactRow {
  Contact contact;
  Stencil stencil;
  Vec3 body_velocity;                   ///< of the touched material point, mean over the step [m/s]
  double target_m_per_s = 0;            ///< least normal velocity relative to the body that the step must end with
  bool impact = false;                  ///< found by trajectory (section 3.3), not by distance (section 3.2)
  double compliance = 0;                ///< of the layer in this step (layerUnder) [m/s per N s/m^2]
  double mean_Pa = 0;                   ///< pressure that has lasted, at the start of the step (lastingPressure)
  bool slippery = false;                ///< without friction
  bool fixed = false;                   ///< nothing can move it along its normal: it gets no impulse
  int partner = -1;                     ///< of two samples that are nearest to each other, one contact: the other one
  std::array<int, 3> pair{-1, -1, -1};  ///< of an impact of triangles: 0 or 1 for edges, and the two primitives
};

static_assert(std::is_trivially_copyable_v<ContactRow>, "an array of rows goes to a device as it lies");

/// The row of a sample at an obstacle.
ContactRow bodyRow(const Contact& contact, const Vec3& body_velocity, double target_m_per_s, bool impact);

/// Impulse of one contact on the cloth, world axes [N s]; the body receives the opposite.
struct ContactImpulse {
  int sample = 0, obstacle = 0, feature = 0;
  Vec3 impulse;
  Vec3 normal;            ///< unit, from the body to the cloth
  Vec3 point;             ///< where the body is touched, world [m], at the start of the step
  MaterialPoint touched;  ///< the same, where the body deforms
};

struct ContactSolve {
  double residual_m_per_s = 0;
  int iterations = 0;
  bool converged = true;
  bool yielded = false;  ///< the rows contradicted each other; the rest is of rows that give way (step_contact.cpp)
};

/// What else holds the points of the cloth while contacts are solved, strain limits say: velocities M^-1 i of impulses
/// i on the free points become P i with a symmetric 0 <= P <= M^-1, so that bounds of M^-1 are bounds of P.
class MotionHold {
 public:
  virtual ~MotionHold() = default;
  /// Whether it bears tensions far beyond the impulses that stop cloth (solveContacts).
  virtual bool bearsTension() const { return true; }
  /// Whether it is a ProjectingHold, which sweeps over the rows see.
  virtual bool projects() const { return false; }
  /// `change`: of all free points, M^-1 i in, P i out.
  virtual void hold(std::span<Vec3> change) const = 0;
  /// The same where impulses act on some points alone and only their changes matter: sets which (free points), and
  /// holds these, in their order.
  virtual void touch(std::span<const int> points) = 0;
  virtual void holdTouched(std::span<Vec3> change) const = 0;
};

/// Scratch of solveContacts. The rows that are iterated on are some of all; what is said of rows is of these, in
/// their order, where it does not say otherwise.
struct ContactWork {
  // Of all rows.
  std::vector<double> area_of;                ///< that each stands for
  std::vector<RowSlip> slip;                  ///< of rows whose friction depends on the motion; of the others mu alone
  bool any_slips = false;                     ///< whether there are such rows
  std::vector<char> in;                       ///< is iterated on
  std::vector<char> joins;                    ///< is left out and would be penetrated
  std::vector<int> on_body;                   ///< contacts of each sample of the cloth with bodies
  std::vector<int> first_on_cloth, on_cloth;  ///< rows of each sample on cloth
  std::vector<Vec3> start, impulses;          ///< traction that the iteration starts from, and its impulse
  /// Of a row that is or was iterated on: the free points that it moves with and that can move, with their weights
  /// B W_T, from `first` on, `count` of them; -1: not asked for yet. And v - drift as the points would move without any
  /// contact.
  struct Reach {
    int first = 0, count = -1;
    Vec3 start;
  };
  std::vector<Reach> reach;
  std::vector<int> reach_point;
  std::vector<double> reach_weight;

  /// Rows that no point of the cloth that can move ties to the others: each island is a solve of its own, and iterates
  /// only until it is done. Ranges of `order`, of `free_points` and of `chunks`.
  struct Island {
    int row = 0, row_end = 0, free_point = 0, free_end = 0, chunk = 0, chunk_end = 0;
    double beta = 0, momentum = 1;  ///< of Nesterov's sequence
    double caution = 1;             ///< by which steps are shorter where the sequence does not settle
    double best = 0;                ///< residual that counts as progress, 0: none yet
    int waiting = 0;                ///< iterations since
    int iterations = 0;
    double residual_m_per_s = 0;
    bool done = false;
    bool held = false;  ///< has points that a ProjectingHold takes hold of; all such rows are one island
  };
  std::vector<Island> islands, kept_islands;
  std::vector<int> kept_island;  ///< of all rows; -1 for one that was not iterated on
  std::vector<int> tied_to;      ///< of all free points, a forest
  std::vector<int> island_of, number, unsorted, by_size;

  std::vector<int> order;  ///< rows in the order of the iteration, by island, phase, chunk and colour (row_order.hpp)
  /// Rows of one colour of a chunk share no free point. Of rows in the order of the iteration, and bits of each point.
  std::vector<int> colour, unsorted_colour;
  std::vector<std::array<std::uint64_t, 4>> taken;
  /// Rows that are taken one after the other: a whole island, or a part of a large one, which shares no free point
  /// with others of its phase. Begins here in `order`, and ends where the next one begins.
  struct Chunk {
    int row = 0, phase = 0;
  };
  std::vector<Chunk> chunks;
  std::vector<double> largest2, against;  ///< of the chunks

  std::vector<int> free_points, free_slot;
  SparseRows points, columns;  ///< rows x free points, B W_T; with a hold its transpose too
  SparseRows pushes;           ///< with a ProjectingHold: what a row's impulse does to these points, nearly B W_T P
  std::vector<int> push_at;    ///< place of each free point in a row of it, while that is made
  std::vector<double> row_area;
  std::vector<Vec3> traction;
  /// Sums of what rows have on samples, which go on to all free points.
  struct OnSamples {
    std::vector<char> marked;  ///< samples that rows have something on
    std::vector<double> area, free_area;
    std::vector<Vec3> sum, free_sum;
  };
  OnSamples spread;                   ///< of impulses
  std::array<OnSamples, 3> smoothed;  ///< of warm starts: of bodies, of each side of the cloth
  std::vector<Vec3> now;              ///< velocities of all free points
  // The iteration's own arrays, four lanes wide.
  struct alignas(32) Quad {
    double lane[4];
  };
  struct Row {
    Vec3 normal, drift;  ///< v_n - target = (v - drift) . normal
    double friction = 0, drag = 0, compliance = 0;
    double slope = 0;    ///< 1/rho, or for cloth on cloth the sum of both: the residual's measure
    double own = 0;      ///< what the row's own traction does to it, its diagonal entry of B W_T M^-1 W_T^T B^T a
    double largest = 0;  ///< with a hold: the bound if all rows carried something, at least the slope
  };
  std::vector<Row> facts;
  std::vector<Quad> point, candidate, previous;     ///< of rows
  std::vector<Quad> kept_candidate, kept_previous;  ///< of all rows, while the rows change
  std::vector<Quad> base, moved, moved_before;      ///< of free points: without contacts, now, a sweep ago
  std::vector<int> kept_points;                     ///< free points, while the rows change
  std::vector<Quad> kept_moved, kept_moved_before;  ///< of these
  std::vector<double> inverse_mass;
  MotionHold* hold = nullptr;  ///< ties all rows to each other, or those of an island that is held
  std::vector<Vec3> change;    ///< of the free points that the rows touch, or of all, for `hold`
};

/// The least normal velocity of eq. 3.15 to 3.18 as one unilateral condition. With g the gap and delta the layer,
///   g <= delta: v_n >= k (delta - g)/dt, k = 1 - exp(-dt/tau)   (the correction of eq. 3.17, d the remaining depth)
///   g >  delta: v_n >= (delta - g)/dt                            (may reach the layer in this step, not enter it)
/// and the impulse acts only where the condition would be violated. Eq. 3.18 pushes a separating point as well; that
/// impulse has no cause in mechanics and is left out.
double persistentTarget(double gap_m, double dt_s, const ContactParameters& parameters);

/// Whether a contact has come to its layer and presses on it, up to rounding; what is farther is on its way there.
GAMBESON_HD inline bool atLayer(double gap_m, double layer_m) { return gap_m <= layer_m * (1 + 1e-6); }

/// The pressure that has lasted, p_m, after a step in which the contact bore `pressure`: the mean over the relaxation
/// time, in which a pressure counts as at most twice the mean plus that of a weight, 2 p_m + rho 9.81 m/s². An impact,
/// of hundreds of Pa for a step or two, thus counts as little; a pressure that stays, whatever its size, counts in full
/// after some relaxation times (the mean may grow e-fold in each).
double lastingPressure(double mean_Pa, double pressure_Pa, double dt_s, double density_kg_per_m2,
                       const ContactParameters& parameters);

/// The part of a pressure that counts in that mean: 1 where it lasts, little in an impact. 0 where there is none.
double lastingShare(double mean_Pa, double pressure_Pa, double density_kg_per_m2);

/// A layer that gives way by c p_m under the pressure p_m that has lasted at the end of the step:
///   v_n >= k (delta - c p_m' - g)/dt,   p_m' = e p_m + (1 - e) s tau/dt,   e = exp(-dt/tau_r),
/// tau the normal impulse per area that is solved for and s the part of it that lastingPressure counts, or that is
/// beyond an impact at 5 m/s (rho 5 m/s / dt: cloth jammed in a fold), as in the last step (`last_Pa`, 0 after a
/// contact has begun). Sets target and compliance of the row; beyond the layer persistentTarget. Cloth has c about 1e-7
/// m/Pa. A rigid layer (c = 0) bears a strip that is stretched over a round body on the few samples that stand highest,
/// by nanometres, because a smooth surface cannot follow the body to the last of them. Which ones changes from step to
/// step; the impulses stir up vibrations along the strip as fast as it slides, and samples that stick for moments
/// drag less than mu p (tests/unit/core/motion/capstan_test.cpp).
void layerUnder(double last_Pa, double dt_s, double density_kg_per_m2, const ContactParameters& parameters,
                ContactRow& row);

/// Solves for impulses on the samples such that after the solve, with v = v_free + W_T M^-1 W_T^T lambda,
///   lambda_n >= 0,  v_n >= target,  lambda_n (v_n - target) = 0,   |lambda_t| <= mu lambda_n opposing the slip
///   (eq. 3.20).
/// Unknowns are impulses per area (tractions times dt): lambda = a tau, with the consistent areas a. In these unknowns
/// the operator A = B W_T M^-1 W_T^T B^T a is bounded by 1/rho because W_Tᵀ a = m/rho (rho: surface density, kg/m^2;
/// for contacts of cloth with cloth, whose stencils B have several samples, by the sum of both sides'), independent of
/// the mesh, and pressure is a smooth field over the surface also where samples outnumber control points. Rows are
/// solved one after the other, each for what the others leave of it (projected Gauss-Seidel), in an order in which
/// rows that share no point stand together, with Nesterov's acceleration between the sweeps and restarts, of each
/// island of rows by itself (contact_iteration.hpp). The residual is |tau - proj(tau - rho r)|/rho [m/s]. Each sample
/// on cloth stands for half its area, because the other side's samples stand for the other half; an edge for an eighth
/// of what its pair touches.
/// Rows that carry nothing are left out while they are not penetrated; the residual is that of all rows.
/// Samples that only held points carry get no impulse, and do not count in the residual: nothing can move them.
///
/// `hold`, where there is one, stands in the place of M^-1: what it holds is part of the same problem, whose rows can
/// no longer be taken one by one; all take a step along the gradient at once there, but for a ProjectingHold,
/// which sweeps see. Impulses may then be thousands of times what stops the cloth by itself (a ring that takes no
/// stretch, on a body); a solve is done at 2e-4 of the largest where that is more than the tolerance. Without such a
/// hold at 1e-6, and ten tolerances at most.
///
/// Friction that depends on the motion (FrictionLaw) is that of the velocities that the solve ends with: rows that
/// stick may take up to mu_s, those that slip take mu(v) and viscosity at the end speed, found in rounds of the same
/// iteration from the speed of the last step on; a row that breaks loose starts them from mu_c, so that of two speeds
/// that balance it takes the higher one. `slip`: how rows move at the start, and at the end; empty where all friction
/// is Coulomb's.
///
/// `WT`: samples x free points; `inverse_mass`: of the free points, 0 where held; `area`, `density`: per sample [m^2,
/// kg/m^2];
/// `place`: of the samples, so that neighbours stand together (halving.hpp); empty: no island is cut.
/// `velocity`: free velocities in, with impulses out; `warm`: tractions to start from, one per row, replaced by the
/// result.
ContactSolve solveContacts(std::span<const ContactRow> rows, const SparseRows& WT, std::span<const double> inverse_mass,
                           std::span<const double> area, std::span<const double> density, std::span<const int> place,
                           const ContactParameters& parameters, double dt_s, std::span<Vec3> velocity,
                           std::span<Vec3> warm, std::vector<Vec3>& impulses, ContactWork& work,
                           MotionHold* hold = nullptr, std::span<RowSlip> slip = {});

}  // namespace gambeson
