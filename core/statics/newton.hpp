#pragma once
/// Newton's method with a safeguarded line search on the energy's slope.

#include <span>
#include <string>
#include <vector>

#include "core/math/cholesky.hpp"

namespace gambeson {

/// r(y) = 0, with the symmetric tangent dr/dy.
class Equations {
 public:
  virtual ~Equations() = default;
  /// Writes r; returns the size of the forces that balance in it.
  virtual double residual(std::span<const double> y, std::span<double> r) = 0;
  virtual void tangent(std::span<const double> y, SymmetricMatrix& K) = 0;
  /// Writes y (+) s dy: System::retract.
  virtual void retract(std::span<const double> y, std::span<const double> dy, double s, std::span<double> out) const {
    for (std::size_t i = 0; i < y.size(); ++i) out[i] = y[i] + s * dy[i];
  }
};

struct NewtonOptions {
  int iterations = 30;
  double tolerance = 1e-8;  ///< of |r| against the forces that balance
  double least_force = 0;   ///< these count as at least so large [N]
  double length_m = 1;      ///< System::reach, for what is rounding
  bool line_search = false;
  /// Only downhill, to a stable equilibrium that may be far: as long as the tangent is not positive definite its
  /// diagonal is raised until it is, and lowered again step by step.
  bool descend = false;
};

struct NewtonReport {
  bool converged = false, singular = false;
  bool finite = true;  ///< false where any state that was tried had forces that are not
  /// Converged because what is left is rounding, and not within the tolerance.
  bool rounded = false;
  /// Not converged: the last correction was rounding, and the forces do not balance.
  bool stalled = false;
  int iterations = 0, factorisations = 0, negative_pivots = 0;
  double residual = 0;            ///< relative, the last
  double force = 0;               ///< the size it is relative to [N]
  std::vector<double> residuals;  ///< relative, of each iterate
};

/// Iterates the state y. `K` and `factor` are scratch with the sparsity of the tangent.
///
/// A thin shell's residual grows at first in a large step (transverse motion stretches the membrane to second order)
/// and falls quadratically afterwards, so |r| need not fall. With `line_search` a step s obeys |G(s)| <= 0.8 |G(0)|,
/// G(s) = dy . r(y + s dy) the slope of the energy (Crisfield 1991, section 9.2), by regula falsi where G changes sign
/// in (0, 1]; else the whole step is taken. Steps into states that are not finite are halved.
///
/// Rounding ends the iteration, too: a residual below roundingForce, or a correction below 1e-14 of that length. But
/// not while more than a thousandth of the forces is out of balance, unless these forces are themselves rounding.
NewtonReport solveNewton(Equations& equations, const NewtonOptions& options, std::vector<double>& y, SymmetricMatrix& K,
                         SymmetricFactor& factor);

/// What of |r| is rounding: eps |diag K| length, the length System::reach. A point's strains are sums of positions
/// times slopes of the basis, each rounded by eps of the coordinate; their force is K times that. Measured on sheets of
/// degree 2 to 4 with 4 to 24 cells along an edge, up to 300 of their lengths from the origin, at rest: 0.03 to 0.5 of
/// it.
double roundingForce(const SymmetricMatrix& K, double length_m);
/// Whether a residual of this size may end an iteration as rounding; `still`: the last correction was rounding.
bool endsByRounding(double size, double force, double rounding, bool still);

bool isFinite(const SymmetricMatrix& K);
double norm(std::span<const double> a);
double dot(std::span<const double> a, std::span<const double> b);

}  // namespace gambeson
