#pragma once
/// What the solvers see of a structure: forces and their derivatives in the unknowns y. Scratch lives in the system, so
/// each solver makes its own.

#include <span>
#include <string>
#include <vector>

#include "core/math/cholesky.hpp"

namespace gambeson {

/// What of the forces by which moving supports drag what they hold: of its mass, of its damping, or both.
enum class SupportForces { all, inertia, damping };

/// Equilibrium is g(y, t) = 0 with g = f_int - f_ext; t is the time, or the load factor in statics.
///
/// A state y has a number for each unknown, and behind these what turns (directors), which no sum of changes tells: a
/// change dy, an unknown each, takes y to another state by `retract`. Systems without such things add.
class System {
 public:
  virtual ~System() = default;
  virtual int size() const = 0;  ///< of unknowns: of g, and of a change dy
  /// The state at rest.
  virtual std::vector<double> start() const { return std::vector<double>(static_cast<std::size_t>(size()), 0.0); }
  /// Writes the state y (+) s dy, at t. K is the slope of g along it where dy is 0. `out` may be y.
  virtual void retract(std::span<const double> y, std::span<const double> dy, double s, double t,
                       std::span<double> out) const {
    static_cast<void>(t);
    for (std::size_t i = 0; i < y.size(); ++i) out[i] = y[i] + s * dy[i];
  }
  /// The sparsity that all matrices of the system share.
  virtual const SymmetricMatrix& sparsity() const = 0;
  /// Writes g; returns the size of the forces that balance in it (loads, reactions), what a residual is small against.
  virtual double residual(std::span<const double> y, double t, std::span<double> g) = 0;
  /// K = dg/dy. `steepest`: every law at its steepest slope, what an explicit step must allow for.
  virtual void stiffness(std::span<const double> y, double t, SymmetricMatrix& K, bool steepest = false) = 0;
  /// K for a matrix to which mass is added: what has neither force nor stiffness has none in it.
  virtual void stiffnessInMotion(std::span<const double> y, double t, SymmetricMatrix& K) { stiffness(y, t, K); }
  /// What of the largest stiffness may be rounding where a motion meets none: what resists less is not held. Strains at
  /// rest are rounding, and their stress is a stiffness of eps of the membrane's in every direction.
  virtual double looseness() const { return 1e-15; }
  /// How g changes from t0 to t1 with y held: loads exactly, moving supports to first order (through the stiffness).
  virtual void change(std::span<const double> y, double t0, double t1, std::span<double> dg) = 0;
  /// A length of the structure [m].
  virtual double length() const { return 1; }
  /// How large its coordinates are [m], at least `length`: positions, strains and forces are rounded in proportion to
  /// them, however small the structure is that stands there.
  virtual double reach() const { return length(); }
  /// What the laws remember, as of the last commit: forces and stiffnesses are of it. Nothing else changes it, so that
  /// a step or an iterate that is given up leaves no trace.
  virtual std::span<const double> history() const { return {}; }
  /// Goes on from a history of before, committed at t.
  virtual void setHistory(std::span<const double> history, double t = 0) {
    static_cast<void>(history), static_cast<void>(t);
  }
  /// Accepts y at t: its laws remember it from now on. Returns the energy that they have lost since the last commit
  /// [J], never negative. Forces at (y, t) stay what they are.
  virtual double commit(std::span<const double> y, double t) { return static_cast<void>(y), static_cast<void>(t), 0; }
  /// In words: where forces were last not finite, of what was tried since the last commit; empty: nowhere, or unknown.
  virtual std::string whyNotFinite() const { return {}; }
  /// In words: what moves in a motion of the unknowns that meets no stiffness.
  virtual std::string describe(std::span<const double> motion) const = 0;

  // Dynamics: M a + D v + g(y, t) + (inertia and damping of moving supports) = 0.
  virtual void mass(bool lumped, SymmetricMatrix& M) = 0;
  /// D = a M + b K(y, t) + drag; without its stiffness part where `stiffness_part` is false.
  virtual void damping(std::span<const double> y, double t, bool lumped, bool stiffness_part, SymmetricMatrix& D) = 0;
  /// Takes from rates of the unknowns at y what has neither force nor stiffness, which steps might let grow.
  virtual void dropIdle(std::span<const double> y, double t, std::span<double> rate) const {
    static_cast<void>(y), static_cast<void>(t), static_cast<void>(rate);
  }
  /// Whether D changes with y.
  virtual bool hasStiffnessDamping() const { return false; }
  /// Forces of the inertia and damping of what supports move, from central differences of their programs over dt; the
  /// damping is that of the last call of `damping`.
  virtual void supportForce(double t, double dt, bool lumped, SupportForces which, std::span<double> f) {
    static_cast<void>(t), static_cast<void>(dt), static_cast<void>(lumped), static_cast<void>(which);
    for (double& v : f) v = 0;
  }
};

}  // namespace gambeson
