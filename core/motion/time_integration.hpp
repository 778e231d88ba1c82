#pragma once
/// Time integration of any system.

#include "core/motion/implicit.hpp"
#include "core/statics/system.hpp"

namespace gambeson {

/// The whole of solveDynamic for any system.
DynamicReport integrate(System& system, const DynamicOptions& options, DynamicState& state,
                        const DynamicObserver& observe);
DynamicReport integrateImplicit(System& system, const DynamicOptions& options, DynamicState& state,
                                const DynamicObserver& observe);
DynamicReport integrateExplicit(System& system, const DynamicOptions& options, DynamicState& state,
                                const DynamicObserver& observe);

/// The step to the state is accepted: its laws remember it.
void commitStep(System& system, DynamicState& state);

/// The entries of a matrix that are not zero, with its whole diagonal.
SymmetricMatrix withoutZeros(const SymmetricMatrix& a);

/// K s = omega^2 M s with a mass that is diagonal or nearly so.
class MassSolver {
 public:
  explicit MassSolver(const SymmetricMatrix& M);
  void solve(std::span<const double> f, std::span<double> a) const;

 private:
  SymmetricMatrix M_;
  bool diagonal_;
  SymmetricFactor factor_;
};

/// The largest eigenfrequency of M^-1 K at (y, t), K with every law at its steepest slope; `mode` is where the
/// iteration starts (empty: anywhere) and holds the mode afterwards.
double largestFrequency(System& system, const SymmetricMatrix& M, const MassSolver& solver, std::span<const double> y,
                        double t, std::vector<double>& mode);

}  // namespace gambeson
