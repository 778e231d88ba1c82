/// Does a load step stay on its branch? A jump is a displacement that does not shrink with the load step.

#include <algorithm>
#include <cmath>

#include "core/statics/path.hpp"

namespace gambeson {
namespace {

constexpr int kBisections = 6;
constexpr double kShare = 0.25;      ///< of the step's displacement, left after them: a jump
constexpr double kMisfit = 0.25;     ///< of the trapezoidal rule, against the displacement: else not looked at
constexpr double kStiffer = 5;       ///< nor the first step where the start's tangent predicted so much more
constexpr double kLeastMove = 1e-4;  ///< nor below this share of the length

/// Of the unknowns of two states.
double distance(std::size_t unknowns, std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < unknowns; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

/// The tangents at both ends do not explain the displacement between them.
bool isSuspicious(System& system, std::span<const double> before, double factor_before, std::span<const double> ahead,
                  const PathState& state, bool first) {
  const auto n = static_cast<std::size_t>(system.size());
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) largest = std::max(largest, std::abs(state.y[i] - before[i]));
  const double moved = distance(n, state.y, before);
  if (!(largest > kLeastMove * system.length()) || (first && norm(ahead) > kStiffer * moved)) return false;
  if (!state.solver.solvable()) return true;
  std::vector<double> dg(n), back(n);
  system.change(state.y, state.factor, factor_before, dg);
  state.solver.solve(dg, back);
  double misfit = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double d = state.y[i] - before[i] - 0.5 * (ahead[i] + back[i]);
    misfit += d * d;
  }
  return std::sqrt(misfit) > kMisfit * moved;
}

}  // namespace

bool hasJumped(System& system, const StaticOptions& options, std::span<const double> before, double factor_before,
               std::span<const double> ahead, PathState& state, StaticReport& report) {
  if (!isSuspicious(system, before, factor_before, ahead, state, report.points == 1)) return false;
  std::vector<double> low(before.begin(), before.end()), high = state.y, middle;
  double low_factor = factor_before, high_factor = state.factor;
  const auto n = static_cast<std::size_t>(system.size());
  const double moved = distance(n, low, high);
  bool jumped = true;
  for (int k = 0; k < kBisections; ++k) {
    const double factor = 0.5 * (low_factor + high_factor);
    middle = low;
    EquilibriumAt equilibrium(system, factor);
    NewtonOptions newton = newtonOptions(system, options, state);
    newton.iterations = 20;
    newton.line_search = true;
    const NewtonReport r = solveNewton(equilibrium, newton, middle, state.K, state.solver);
    report.factorisations += r.factorisations;
    if (!r.converged) break;
    const double below = distance(n, low, middle), above = distance(n, middle, high);
    if (below >= above) {
      high.swap(middle);
      high_factor = factor;
    } else {
      low.swap(middle);
      low_factor = factor;
    }
    if (std::max(below, above) <= kShare * moved) {
      jumped = false;
      break;
    }
  }
  restoreTangent(system, state, report);
  return jumped;
}

}  // namespace gambeson
