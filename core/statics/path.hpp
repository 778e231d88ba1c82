#pragma once
/// Equilibrium paths of any system: load steps and arc length.

#include "core/statics/newton.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/system.hpp"

namespace gambeson {

/// A system at one t.
class EquilibriumAt : public Equations {
 public:
  EquilibriumAt(System& system, double t) : system_(system), t_(t) {}
  double residual(std::span<const double> y, std::span<double> r) override { return system_.residual(y, t_, r); }
  void tangent(std::span<const double> y, SymmetricMatrix& K) override { system_.stiffness(y, t_, K); }
  void retract(std::span<const double> y, std::span<const double> dy, double s, std::span<double> out) const override {
    system_.retract(y, dy, s, t_, out);
  }

 private:
  System& system_;
  double t_;
};

/// Where a path stands: the last converged point with the tangent there, factorised.
struct PathState {
  explicit PathState(System& system);

  std::vector<double> y;
  double factor = 0;
  double largest_force = 0;  ///< met so far
  double lost_J = 0;         ///< by the laws so far
  SymmetricMatrix K;
  SymmetricFactor solver;
  Definiteness definite = Definiteness::positive;
  /// Of the start, until the first step: the solver's matrix is K with its diagonal raised, because only the stress
  /// that the loads bring holds a motion there (a strip that hangs from a hinge).
  bool raised = false;
};

/// Equilibrium at factor 0 and the tangent there; false (report.why) where there is no equilibrium.
///
/// A motion n without stiffness (K n = 0) is a missing support, RunError, unless the first step's loads p hold it:
///   n . p = 0 for all such n, that is K x = p has a solution x, and
///   K(e x), e small, is regular: the stress that the loads bring is the missing stiffness.
/// So a strip that hangs from a hinge along its weight goes on (and one that stands on it, as an unstable equilibrium);
/// a free sheet under balanced loads, or a hinged strip across its weight, does not.
bool startPath(System& system, const StaticOptions& options, PathState& state, StaticReport& report);
/// Tangent at the state's y, factorised; the point as it is reported, but for what it remembers.
StaticPoint acceptPoint(System& system, PathState& state, const NewtonReport& newton, StaticReport& report);
/// The laws remember the point from now on: once nothing more is asked of the way to it.
void commitPoint(System& system, PathState& state, StaticPoint& point);
/// K of the state and its factor again, after other tangents have used them.
void restoreTangent(System& system, PathState& state, StaticReport& report);
NewtonOptions newtonOptions(const System& system, const StaticOptions& options, const PathState& state);

/// The whole of solveStatic for any system.
StaticReport followPath(System& system, const StaticOptions& options, const StaticObserver& observe,
                        std::vector<double> start = {});
void followLoadSteps(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
                     StaticReport& report);
/// Whether the state (its factor is that of K) lies on another branch than `before` at `factor_before`, in the sense of
/// StaticPoint::jumped; `ahead` is what the tangent there predicted. Leaves the state's tangent factorised.
bool hasJumped(System& system, const StaticOptions& options, std::span<const double> before, double factor_before,
               std::span<const double> ahead, PathState& state, StaticReport& report);
void followArc(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
               StaticReport& report);

/// A motion of the unknowns that meets next to no stiffness, by inverse iteration on K shifted by a little of its
/// diagonal.
std::vector<double> weakestMotion(const SymmetricMatrix& K);

}  // namespace gambeson
