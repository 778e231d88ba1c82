#pragma once
/// A cell of solid yarns from one load to the next.

#include <string>

#include "core/solid/contact_path.hpp"
#include "core/yarn/solid_cell.hpp"

namespace gambeson {

/// Yarns that touch nothing slide along the cloth, and a lattice's may leave it: so much of each diagonal entry is
/// added to what is factorised (ContactNewton::raise).
inline constexpr double kSolidCellRaise = 1e-10;

/// A cell at rest or in equilibrium: all that the next load starts from.
struct SolidCellState {
  CellLoad load;
  std::vector<Vec3> x;    ///< of all nodes [m]
  std::vector<double> y;  ///< empty: at rest
  std::vector<ContactMultipliers> multipliers;
  std::vector<ContactPoint> points;  ///< what presses and rubs
  double lost_J = 0;                 ///< to friction, since rest
};

struct SolidLoadOptions {
  /// Of yarns that touch; penalties alone know no friction unless the cell's bound is coupled.
  SolidContactMethod method = SolidContactMethod::augmented;
  int steps = 1;     ///< in which a load is reached, with friction the more the better
  int halvings = 8;  ///< of a step that does not come to rest
  int iterations = 30;
  double tolerance = 1e-9;  ///< of the residual against the forces that balance
  int passes = 40;          ///< augmentations of a step, at most
  /// Augmentations end where multipliers change by this part of the largest pressure and nodes have passed by this part
  /// of the thinner half thickness. 1e-2 and 1e-2 end them after one or two, 1e-6 and 1e-6 after ten or more.
  double change = 1e-3, deepest = 1e-2;
};

struct SolidLoadReport {
  bool reached = false;
  std::string why;  ///< else: what failed
  int steps = 0, passes = 0, iterations = 0;
  // Of the last step:
  double deepest_m = 0;  ///< of nodes that have passed a facet
  double residual = 0;   ///< of the forces that balance
  bool rounded = false;  ///< rounding kept it above the tolerance
  bool stable = true;    ///< the tangent, if it is symmetric, was positive definite

  /// This one, and then another.
  void add(const SolidLoadReport& next);
};

/// Scratch: the system whose supports move, and its factor.
class SolidCellWork {
 public:
  explicit SolidCellWork(const SolidCell& cell) : system(cell.body(), cell.supports()) {}
  SolidSystem system;
  TangentSolver solver;
};

SolidCellState restOf(const SolidCell& cell);

/// From an equilibrium under its load to one under another; the steps of the faces go straight (SolidCell::between).
/// Where it fails, `state` is the last equilibrium that was reached. Throws InputError as checkLoad, with the key
/// "load.curvature" where the cloth is to bend, and as followContact. The same bits for any number of threads.
SolidLoadReport changeLoad(const SolidCell& cell, const CellLoad& to, SolidCellState& state, SolidCellWork& work,
                           const SolidLoadOptions& options = {});

}  // namespace gambeson
