#pragma once
/// Static equilibrium: Newton with line search, load stepping, arc length through limit points.

#include <functional>

#include "core/cloth/law_range.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

struct StaticOptions {
  bool linear = false;  ///< one solve about the rest shape
  int steps = 10;       ///< equal load steps from factor 0 to 1; a step that fails is halved, at most `halvings` times,
                        ///< and then descends to a stable state if there is one (a snap-through)
  int halvings = 8;
  int iterations = 30;      ///< Newton iterations of a step
  double tolerance = 1e-8;  ///< of the residual's norm against that of the forces that balance (loads, reactions)
  bool arc_length =
      false;  ///< Crisfield's cylindrical arc length; `steps` then sets the first step, 1/steps of the load
  double largest_arc_m = 0;  ///< arc length only: no unknown is to move farther in a step; 0: as the path curves
  int max_points = 200;      ///< of the path, arc length only
  double stop_factor = 1;    ///< arc length ends where the factor first reaches this, or at max_points
};

/// A converged point of the path.
struct StaticPoint {
  double factor = 0;  ///< the programs' argument
  std::vector<double> y;
  int iterations = 0;
  double residual = 0;      ///< relative
  bool rounded = false;     ///< above the tolerance, but rounding (NewtonReport::rounded)
  int negative_pivots = 0;  ///< of the tangent: 0 where the equilibrium is stable
  /// Load steps: the state lies on another branch than the last one; over a limit point, say. Found so: where the
  /// displacement is not what the tangents at both ends of the step make of it, the step is bisected, always into the
  /// half that moves more; it is a jump where after 6 bisections (1/64 of the load) the displacement is still more
  /// than 1/4 of the step's, or where there is no equilibrium close by at a bisection's load. A continuous path moves
  /// less, even next to a limit point or a bifurcation (like the root of the load: 1/8). Not looked at: moves of less
  /// than 1e-4 of the structure's length, and a first step of less than 1/5 of what the start's tangent predicted (a
  /// slack sheet stiffens).
  ///
  /// Arc length: the path between the last point and this one may not be the short way that their tangents say, and no
  /// shorter arc mended that (core/statics/arc_length.cpp).
  bool jumped = false;
  std::vector<double> history = {};  ///< committed here; empty where the laws remember nothing
  double lost_J = 0;                 ///< by the laws since the start
  // Arc length only, of the way from the last point to this one.
  bool limit_point = false;  ///< the factor turned
  bool bifurcation = false;  ///< the tangent's negative pivots changed and the factor did not turn, or the reverse
};

struct StaticReport {
  bool reached = false;   ///< the end of the path
  bool no_start = false;  ///< no equilibrium was found at factor 0
  std::string why;        ///< else: the step, the residual and the likeliest cause
  int points = 0, factorisations = 0;
  /// Of laws that are an energy at a point: of the last state tried beyond the end of the path that had no answer, and
  /// how many such states were tried on all of it.
  LawRange unanswered;
  long unanswered_tries = 0;
};

/// Returns false to stop early.
using StaticObserver = std::function<bool(const StaticPoint&)>;

/// Starts from `start` (empty: the rest shape) at factor 0. Throws RunError where a support is missing (a mechanism:
/// names the direction and the place that moves freely). Laws commit what they remember at each point of the path.
StaticReport solveStatic(const Structure& structure, const StaticOptions& options, const StaticObserver& observe,
                         std::vector<double> start = {});

/// Control points q of the unknowns y at a time (or, with programs that go on beyond their ends, at a factor).
std::vector<Vec3> controlPoints(const Structure& structure, std::span<const double> y, double t,
                                ProgramEnds ends = ProgramEnds::constant);
/// Values of the inner unknowns there.
std::vector<double> innerValues(const Structure& structure, std::span<const double> y, double t,
                                ProgramEnds ends = ProgramEnds::constant);
/// f_int - f_ext on the control points: what supports (and inertia) take up there [N]. `history`: committed there;
/// empty: of new cloth.
std::vector<Vec3> reactions(const Structure& structure, std::span<const double> y, double t,
                            ProgramEnds ends = ProgramEnds::constant, std::span<const double> history = {});
/// The same of a state.
std::vector<Vec3> reactions(const Structure& structure, const ClothState& state, double t, ProgramEnds ends);
/// Stored energy [J], loads not counted.
double strainEnergy(const Structure& structure, const ClothState& state);
double strainEnergy(const Structure& structure, std::span<const double> y, double t,
                    ProgramEnds ends = ProgramEnds::constant, std::span<const double> history = {});

}  // namespace gambeson
