#pragma once
/// Strain limiting by fast projection (Zheng 2013, sections 5.2 and 5.3; Goldenthal et al. 2007).

#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/cloth/strain_rows.hpp"
#include "core/contact/response.hpp"

namespace gambeson {

/// equality: C = E = 0 at every point, weft and warp (eq. 5.6). upper_limit: C = E - limit <= 0 with multipliers >= 0,
/// so that cloth may shorten freely and is only held where it would stretch beyond the limit.
enum class LimitMode { none, equality, upper_limit };

/// fast: eq. 5.21 and 5.22. closest: the whole Newton iteration, eq. 5.15 and 5.16 (projectClosest). provot: one strain
/// after the other (projectOneByOne).
enum class LimitMethod { fast, closest, provot };

struct StrainLimit {
  LimitMode mode = LimitMode::none;
  double limit = 0;         ///< upper_limit: the largest Green-Lagrange strain, >= 0
  double tolerance = 1e-3;  ///< epsilon: projections end at max |C| (upper_limit: max C) below it
  int max_projections = 40;
  /// Project at least once in a step (upper_limit: where any C > 0), so that multipliers are those of a constraint that
  /// holds and not of one that is met now and then. The thesis ends as soon as the tolerance is met.
  bool always = true;
  int max_rounds = 6;                   ///< of projections, and contacts solved together with limits of equality
  static constexpr int max_turns = 12;  ///< of projections and contacts by themselves, upper limits
  LimitPoints points = LimitPoints::vertices;
  LimitMethod method = LimitMethod::fast;
  /// Strain that a step begins with is taken back by at most this much a second where threads yield (Zheng 2013 takes
  /// all of it back at once, as threads do that do not). It is there where cloth starts stretched or contacts have had
  /// their way, and the velocities of a step that takes back some percent at once are those of a blow: 1 % of a cell of
  /// 25 mm in a millisecond is 0.25 m/s. 1 /s draws a belt together by 0.15 m/s, and is far above what a step leaves by
  /// itself.
  double restore_per_s = 1;
  /// k: threads that a limit holds resist as springs, with the tension k C [N/m] that the step ends with (implicit, so
  /// that it sets no bound to the step); infinity: whatever it takes. Yarns have 1e4 to 1e5 N/m. What holds cloth and
  /// pushes it may contradict each other (a ring that is too tight for the body that it slides onto): threads that
  /// do not yield then end in tensions without bound, and their strain creeps from step to step.
  double stiffness_N_per_m = std::numeric_limits<double>::infinity();
};

/// Throws InputError (key strain_limit.KEY).
void checkLimit(const StrainLimit& limit);

/// Forces of the limits on the free points [N]: - J^T lambda with the points at p.
void limitForce(const StrainRows& rows, std::span<const Vec3> p, std::span<const double> multiplier_J,
                std::span<Vec3> force);

/// What the projections of a step came to.
struct LimitReport {
  int projections = 0, factorisations = 0;
  int active = 0;         ///< rows that pull
  int rounds = 0;         ///< of projections and contacts
  double residual = 0;    ///< max |C| (upper_limit: max C, at least 0) at the end of the step, after the contacts
  bool converged = true;  ///< residual <= tolerance
  /// Whether limits and contacts agree on the step: strains are within tolerance of what was to be left of them, and
  /// the contacts are solved. A shorter step turns threads less (by its square); the integrator tries that.
  bool solved = true;
};

/// Scratch of projectStrain, and its result: `multiplier` is dt^2 lambda of each row [kg m^2], `pull` the sum of
/// dt^2 J^T dlambda over the iterations on all free points, held ones among them [kg m]: what has moved the free ones
/// by - P pull; `force` the sum of dt^2 dlambda F D of each row, with the F D of the iterates.
struct LimitWork {
  std::unique_ptr<SymmetricFactor> factor;
  SymmetricMatrix A, active_A;
  std::vector<Vec3> e, e_next, scaled, pull, force, end;
  std::vector<double> C, solution, right, moved;
  std::vector<char> active, factored_active;
  std::vector<int> slot;
  std::vector<double> left;    ///< of each row, strain beyond its limit that this step is to leave; empty: none
  std::vector<double> yields;  ///< of each row, 1/(k a dt^2) [1/(kg m^2)]: its part of C over its multiplier; empty: 0
  std::vector<Vec3> along;     ///< F D of all rows that threads pull along in this step; empty: of each iterate
  std::vector<Vec3> factored_e;  ///< F D of all rows where the matrix was made; empty: not in this step
  std::vector<double> multiplier;
  std::vector<Vec3> velocity, contact_change;
};

/// Starts a step: no multipliers, no pull. `warm` holds last step's multipliers (empty: none).
void startProjection(const StrainRows& rows, std::span<const double> warm, LimitWork& work);

/// Where threads yield, a step of dt from the positions p leaves of each strain beyond its limit what restore_per_s
/// cannot take back, and nothing of one within half of the tolerance. What a thread yields under the multipliers of the
/// last step `warm_J` is no part of it. Such threads pull along where they lie at the start of the step (SHAKE,
/// Ryckaert, Ciccotti and Berendsen, J. Comput. Phys. 23, 1977), as the forces of velocity Verlet do: what swings
/// across their tension keeps its energy then and is stable up to omega dt = 2. Along the iterates (eq. 5.21) it is
/// damped, and stable up to 1.15. Sets work.left, work.yields and work.along.
void leaveStrain(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p,
                 std::span<const double> warm_J, double dt_s, LimitWork& work);

/// The multipliers whose forces J^T lambda at the positions p are those of the step [J]: F D of the iterates is longer
/// than at the end, by what one step stretches, so that the plain sum of dlambda says too little.
void limitMultipliers(const StrainRows& rows, std::span<const Vec3> p, double dt_s, std::vector<double>& lambda_J,
                      LimitWork& work);

/// max |C| over the rows that a free point changes (upper_limit: max C, at least 0).
double limitResidual(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitWork& work);
/// The same of C less what the step is to leave and what its tension makes of it: what is to be taken back, work.C.
double unrestored(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitWork& work);
/// The tolerance of unrestored: that of the strain; where threads yield a twentieth of it, so that the rest does not
/// add up to strain from step to step.
double unrestoredTolerance(const StrainLimit& limit, const LimitWork& work);

/// The largest angular frequency of threads that swing across their tension, a bound from the sums of rows of M^-1 B^T
/// diag(lambda) B [rad/s]; multipliers of the last step [J]. It bounds the step as the cloth's own frequency does.
double tensionFrequency(const StrainRows& rows, std::span<const double> lambda_J);

/// Moves the positions p on the constraints by eq. 5.21 and 5.22,
///   (J M^-1 J^T) dt^2 dlambda = C,   dp = - M^-1 J^T dt^2 dlambda,
/// J at the iterates, or along work.along, until the residual (unrestored) is within tolerance, `most` times at most;
/// adds to work.multiplier and work.pull, and to the report. Threads that yield have C less what their tension stands
/// for, and 1/(k a dt^2) on the diagonal.
/// The matrix is factorised at the first iterate and again where the residual has not fallen by a factor of 4, or where
/// some F D has changed by more than a twentieth since; once in a step for threads that yield, whose directions stay.
/// The diagonal is raised by 1e-4 S_ii. Redundant rows (a line of points between two held edges, say) would make the
/// matrix singular; and multipliers that alternate from point to point move the cloth so little that a step's own
/// second-order stretch (omega dt)^2/2 would call up tensions a thousand times those of the load, whose chatter feeds
/// energy in (measured on section 5.6.1: absolute work of the limits 20 J against 0.002 J with the term). The term is a
/// compliance of the threads of 1e-4 S_ii dt^2 per row, that is a thread stiffness 1/(1e-4 S a dt^2): 1.5e8 N/m at 0.5
/// ms on the mesh of that section, well above any fabric. It slows convergence where the matrix is weak (a factor
/// ten more leaves steps of a 34 x 34 mesh unconverged), and changes no position that has converged. Near a solution
/// that redundant rows isolate (flat between held edges) convergence is linear. Where constraints cannot be met (held
/// edges too far apart) it ends unconverged. A step that would turn or stretch any F D by more than a half is
/// shortened. upper_limit: each iterate solves the linear complementarity problem lambda >= 0, C + J dp <= 0, of which
/// one is 0, by block principal pivoting (Judice and Pires 1994), whose fallback to single pivots ends for positive
/// definite matrices; multipliers of earlier iterates may fall to zero again, so that points are released. Rows of J
/// annihilate translations and, about p, rotations: momentum is kept where nothing is held.
void projectStrain(const StrainRows& rows, const StrainLimit& limit, bool at_least_once, std::span<Vec3> p,
                   LimitReport& report, LimitWork& work, int most = std::numeric_limits<int>::max());

/// Limits of equality as contacts see them: with S = J M^-1 J^T (its diagonal raised as above) at the last
/// factorisation of the step and J their gradients, impulses i move the free points by
///   P i = M^-1 i - M^-1 J^T S^-1 J M^-1 i,   0 <= P <= M^-1:
/// whatever the contacts do, the limits take back what of it would stretch threads. Contacts and limits are one problem
/// so, in which the limits' part is solved directly in each iteration.
class StrainHold : public MotionHold {
 public:
  /// Factorises at the positions p where nothing was factorised in this step.
  StrainHold(const StrainRows& rows, const StrainLimit& limit, std::span<const Vec3> p, LimitReport& report,
             LimitWork& work);
  void hold(std::span<Vec3> change) const override;
  void touch(std::span<const int> points) override;
  void holdTouched(std::span<Vec3> change) const override;
  /// What the limits do while the contacts move the free points by dp = `moved` [m]: adds to work.multiplier, force and
  /// pull.
  void follow(std::span<const Vec3> moved);

 private:
  void multipliersOf(std::span<const Vec3> change) const;  ///< into work.solution

  const StrainRows& rows_;
  LimitWork& w_;
  // Of the touched points and the rows that they change.
  SparseRows touched_, touched_t_;    ///< rows x points and back, of B
  std::vector<int> rows_of_touched_;  ///< of touched_
  std::vector<double> inverse_mass_;
  mutable std::vector<Vec3> stretch_, given_;
  mutable std::vector<double> right_, multiplier_;
};

}  // namespace gambeson
