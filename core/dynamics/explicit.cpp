/// Velocity Verlet (central differences) in the unknowns with the lumped mass, damping by mass and drag implicit:
///
///   v' = v0 + h/2 a0,  y1 = y0 + h v',  (M + h/2 D) a1 = -g(y1, t1) - D v',  v1 = v' + h/2 a1
///
/// M = Cᵀ M_lumped C: diagonal where supports hold components, with small blocks where they couple them. Stable for h <
/// 2/omega, omega the largest frequency.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/dynamics/newton.hpp"
#include "core/dynamics/time_integration.hpp"
#include "core/error.hpp"
#include "core/math/lanczos.hpp"

namespace gambeson {

SymmetricMatrix withoutZeros(const SymmetricMatrix& a) {
  SymmetricMatrix m;
  m.size = a.size;
  for (int c = 0; c < a.size; ++c) {
    for (int k = a.offsets[c]; k < a.offsets[c + 1]; ++k)
      if (a.rows[k] == c || a.values[k] != 0) m.rows.push_back(a.rows[k]), m.values.push_back(a.values[k]);
    m.offsets.push_back(static_cast<int>(m.rows.size()));
  }
  return m;
}

MassSolver::MassSolver(const SymmetricMatrix& M)
    : M_(withoutZeros(M)), diagonal_(static_cast<int>(M_.rows.size()) == M_.size), factor_(M_) {
  if (factor_.factorise(M_) != Definiteness::positive)
    throw InputError({"", 0, "mass"}, "a control point has no mass; explicit steps need one");
}

void MassSolver::solve(std::span<const double> f, std::span<double> a) const {
  if (diagonal_)
    for (int i = 0; i < M_.size; ++i) a[i] = f[i] / M_.values[i];
  else
    factor_.solve(f, a);
}

double largestFrequency(System& system, const SymmetricMatrix& M, const MassSolver& solver, std::span<const double> y,
                        double t, std::vector<double>& mode) {
  SymmetricMatrix K = system.pattern();
  system.stiffness(y, t, K, true);
  std::vector<double> f(y.size()), start = scatteredVector(static_cast<int>(y.size()), 1);
  if (!mode.empty()) {
    const double share = 0.1 * norm(mode) / norm(start);
    for (std::size_t i = 0; i < start.size(); ++i) start[i] = mode[i] + share * start[i];
  }
  const auto pairs = lanczosLargest(
      [&](std::span<const double> x, std::span<double> out) {
        multiply(K, x, f);
        solver.solve(f, out);
      },
      [&](std::span<const double> x, std::span<double> out) { multiply(M, x, out); }, std::move(start), {},
      {1, 1e-3, 60});
  if (pairs.empty()) return 0;
  mode = pairs[0].vector;
  return std::sqrt(std::max(pairs[0].value + pairs[0].error, 0.0));
}

namespace {
constexpr int kStepsToEstimate = 100;
}

DynamicReport integrateExplicit(System& system, const DynamicOptions& o, DynamicState& state,
                                const DynamicObserver& observe) {
  if (system.hasStiffnessDamping())
    throw InputError({"", 0, "rayleigh_stiffness_s"},
                     "explicit steps take no stiffness damping: it would cut the stable step; use an implicit scheme");
  if (!(o.step_s >= 0)) throw InputError({"", 0, "step_s"}, "must be >= 0");
  if (o.step_s == 0 && !(o.safety > 0 && o.safety <= 1))
    throw InputError({"", 0, "safety"}, "must be > 0 and at most 1");
  const std::size_t n = state.y.size();
  SymmetricMatrix M = system.pattern(), D = M;
  system.mass(true, M);
  system.damping(state.y, state.time_s, true, false, D);
  const MassSolver mass(M);
  const bool damped = std::any_of(D.values.begin(), D.values.end(), [](double v) { return v != 0; });
  std::unique_ptr<MassSolver> effective;  // M + h/2 D
  std::vector<double> mode, g(n), f(n), damping(n);
  DynamicState before;
  DynamicReport report;
  double h = 0;
  const auto forces = [&] {  // all but the inertia, with the damping of state.v
    system.residual(state.y, state.time_s, g);
    system.supportForce(state.time_s, h, true, f);
    if (damped) multiply(D, state.v, damping);
    for (std::size_t i = 0; i < n; ++i) f[i] = -(f[i] + g[i] + damping[i]);
  };
  const auto setStep = [&](double step) {
    h = step;
    if (!damped) return;
    SymmetricMatrix sum = M;
    for (std::size_t k = 0; k < sum.values.size(); ++k) sum.values[k] += 0.5 * h * D.values[k];
    effective = std::make_unique<MassSolver>(sum);
  };
  long left = 0;  // steps to the end
  while (state.time_s < o.end_s) {
    const double span = o.end_s - state.time_s;
    if (report.steps % kStepsToEstimate == 0 && (o.step_s == 0 || report.steps == 0)) {
      double wanted = o.step_s;
      if (o.step_s == 0) {
        const double omega = largestFrequency(system, M, mass, state.y, state.time_s, mode);
        ++report.factorisations;
        wanted = omega > 0 ? o.safety * 2 / omega : span;
      }
      // A change of step costs energy; keep it while it is neither too long nor far too short.
      if (h == 0 || wanted < h || 0.7 * wanted > h) {
        left = std::max(1L, static_cast<long>(std::ceil(span / wanted - 1e-6)));
        setStep(span / static_cast<double>(left));
      }
    }
    if (report.steps == 0) {
      forces();
      mass.solve(f, state.a);
    }
    before = state;
    for (std::size_t i = 0; i < n; ++i) {
      state.v[i] += 0.5 * h * state.a[i];
      state.y[i] += h * state.v[i];
    }
    --left;
    state.time_s = left == 0 ? o.end_s : o.end_s - static_cast<double>(left) * h;
    forces();
    if (damped)
      effective->solve(f, state.a);
    else
      mass.solve(f, state.a);
    for (std::size_t i = 0; i < n; ++i) state.v[i] += 0.5 * h * state.a[i];
    ++report.steps;
    if (!std::isfinite(norm(state.a))) {
      state = before;
      --report.steps;
      report.why = fmt::format(
          "time {:.6g} s, after {} steps of {:.3e} s: the motion is not finite; likeliest cause: the step "
          "is longer than the stable one (step_s 0 takes that)",
          state.time_s, report.steps, h);
      return report;
    }
    if (!observe(state)) return report;
  }
  report.reached = true;
  return report;
}

}  // namespace gambeson
