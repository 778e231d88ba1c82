#pragma once
/// Equilibrium paths of any system: load steps and arc length.

#include "core/dynamics/newton.hpp"
#include "core/dynamics/statics.hpp"
#include "core/dynamics/system.hpp"

namespace gambeson {

/// A system at one t.
class EquilibriumAt : public Equations {
 public:
  EquilibriumAt(System& system, double t) : system_(system), t_(t) {}
  double residual(std::span<const double> y, std::span<double> r) override { return system_.residual(y, t_, r); }
  void tangent(std::span<const double> y, SymmetricMatrix& K) override { system_.stiffness(y, t_, K); }

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
  SymmetricMatrix K;
  SymmetricFactor solver;
  Definiteness definite = Definiteness::positive;
};

/// Equilibrium at factor 0 and the tangent there. Throws RunError for a mechanism; false (report.why) where there is no
/// equilibrium.
bool startPath(System& system, const StaticOptions& options, PathState& state, StaticReport& report);
/// Tangent at the state's y, factorised; the point as it is reported.
StaticPoint acceptPoint(System& system, PathState& state, const NewtonReport& newton, StaticReport& report);
NewtonOptions newtonOptions(const System& system, const StaticOptions& options, const PathState& state);

/// The whole of solveStatic for any system.
StaticReport followPath(System& system, const StaticOptions& options, const StaticObserver& observe,
                        std::vector<double> start = {});
void followLoadSteps(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
                     StaticReport& report);
void followArc(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
               StaticReport& report);

/// A motion of the unknowns that meets next to no stiffness, by inverse iteration on K shifted by a little of its
/// diagonal.
std::vector<double> weakestMotion(const SymmetricMatrix& K);

}  // namespace gambeson
