/// Velocity Verlet (central differences) in the unknowns with the lumped mass, damping by mass and drag implicit:
///
///   v' = v0 + h/2 a0,  y1 = y0 + h v',  (M + h/2 D) a1 = -g(y1, t1) - D v',  v1 = v' + h/2 a1
///
/// With strain limits (core/motion/strain_limit.hpp) y1 is projected onto them, v' changed by what that moves over h;
/// c = M^-1 times their force is in the velocities with its half step, as that of every other force, and taken out
/// before the next impulse: v' = v0 + h/2 (a0 - c0) + ..., v1 = v' + h/2 (a1 + c1).
///
/// M = Cᵀ M_lumped C: diagonal where supports hold components, with small blocks where they couple them. Stable for h <
/// 2/omega, omega the largest frequency.
///
/// omega changes as the sheet deforms: cloth crushed at the rim of a hole doubles it within fifty steps, and one step
/// at 1.1 of the stable length more than doubles what moves in that mode. So steps run in windows; omega is estimated
/// at the end of each, and a window whose step was too long there is done again from its start, shorter. What is
/// observed has passed. A window is as long as omega is steady.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/lanczos.hpp"
#include "core/motion/time_integration.hpp"
#include "core/statics/newton.hpp"

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

/// Steps of one length between two estimates of the largest frequency.
constexpr long kFirstWindow = 25, kLongestWindow = 100;
/// Doubles that the states of a window may hold.
constexpr double kWindowMemory = 2e7;
constexpr int kMostRejections = 30;

/// One run of explicit steps.
class ExplicitRun {
 public:
  ExplicitRun(System& system, const DynamicOptions& o, DynamicState& state)
      : system_(system),
        o_(o),
        state_(state),
        M_(withDiagonalMass(system)),
        D_(M_),
        mass_(M_),
        g_(state.y.size()),
        f_(g_.size()),
        damping_(g_.size()),
        limit_(system.limit()),
        pulled_(g_.size()),
        change_(g_.size()) {
    system_.damping(state.y, state.time_s, true, false, D_);
    damped_ = std::any_of(D_.values.begin(), D_.values.end(), [](double v) { return v != 0; });
    if (limit_ && !state.limit_J.empty()) limit_->acceleration(state.y, state.time_s, state.limit_J, pulled_);
  }

  DynamicReport run(const DynamicObserver& observe);

 private:
  static SymmetricMatrix withDiagonalMass(System& system) {
    SymmetricMatrix M = system.pattern();
    system.mass(true, M);
    return M;
  }
  double estimate() {
    ++report_.factorisations;
    return largestFrequency(system_, M_, mass_, state_.y, state_.time_s, mode_);
  }
  /// All forces but the inertia, with the damping of state.v.
  void forces() {
    system_.residual(state_.y, state_.time_s, g_);
    system_.supportForce(state_.time_s, h_, true, f_);
    if (damped_) multiply(D_, state_.v, damping_);
    for (std::size_t i = 0; i < f_.size(); ++i) f_[i] = -(f_[i] + g_[i] + damping_[i]);
  }
  /// Equal steps to the end, none longer than `wanted` [s].
  void setStep(double wanted) {
    const double span = o_.end_s - state_.time_s;
    left_ = std::max(1L, static_cast<long>(std::ceil(span / wanted - 1e-6)));
    h_ = span / static_cast<double>(left_);
    if (!damped_) return;
    SymmetricMatrix sum = M_;
    for (std::size_t k = 0; k < sum.values.size(); ++k) sum.values[k] += 0.5 * h_ * D_.values[k];
    effective_ = std::make_unique<MassSolver>(sum);
  }
  double stableStep(double omega) const { return omega > 0 ? o_.safety * 2 / omega : o_.end_s - state_.time_s; }
  bool step();
  /// Onto the limits, after the positions of a step.
  LimitReport limit();

  System& system_;
  const DynamicOptions& o_;
  DynamicState& state_;
  SymmetricMatrix M_, D_;
  MassSolver mass_;
  std::unique_ptr<MassSolver> effective_;  ///< M + h/2 D
  std::vector<double> mode_, g_, f_, damping_;
  MotionLimit* limit_;
  std::vector<double> pulled_, change_;  ///< c, and what a projection has moved
  LimitReport limited_;                  ///< of the step
  bool damped_ = false;
  double h_ = 0;
  long left_ = 0;  ///< steps to the end
  DynamicReport report_;
};

LimitReport ExplicitRun::limit() {
  const LimitReport report = limit_->project(state_.time_s, h_, state_.y, change_, state_.limit_J);
  limit_->acceleration(state_.y, state_.time_s, state_.limit_J, pulled_);
  for (std::size_t i = 0; i < f_.size(); ++i) state_.v[i] += change_[i] / h_ + 0.5 * h_ * pulled_[i];
  return report;
}

/// False: the motion is not finite.
bool ExplicitRun::step() {
  const std::size_t n = f_.size();
  for (std::size_t i = 0; i < n; ++i) {
    state_.v[i] += 0.5 * h_ * (state_.a[i] - pulled_[i]);
    state_.y[i] += h_ * state_.v[i];
  }
  --left_;
  state_.time_s = left_ == 0 ? o_.end_s : o_.end_s - static_cast<double>(left_) * h_;
  if (limit_) limited_ = limit();
  forces();
  commitStep(system_, state_);
  (damped_ ? *effective_ : mass_).solve(f_, state_.a);
  for (std::size_t i = 0; i < n; ++i) state_.v[i] += 0.5 * h_ * state_.a[i];
  return std::isfinite(norm(state_.a));
}

DynamicReport ExplicitRun::run(const DynamicObserver& observe) {
  const bool automatic = o_.step_s == 0;
  if (!(state_.time_s < o_.end_s)) {
    report_.reached = true;
    return report_;
  }
  double omega = automatic ? estimate() : 0;
  setStep(automatic ? stableStep(omega) : o_.step_s);
  forces();
  mass_.solve(f_, state_.a);
  const long longest =
      std::clamp(static_cast<long>(kWindowMemory / (3 * static_cast<double>(f_.size()))), 8L, kLongestWindow);
  long window = automatic ? std::min(kFirstWindow, longest) : 1;
  std::vector<DynamicState> passed;
  std::vector<LimitReport> limited;  // of the passed
  int rejections = 0;
  while (state_.time_s < o_.end_s) {
    const DynamicState start = state_;
    const std::vector<double> pulled = pulled_;
    passed.clear();
    limited.clear();
    bool finite = true;
    while (finite && left_ > 0 && static_cast<long>(passed.size()) < window) {
      finite = step();
      if (!finite) break;
      passed.push_back(state_);
      limited.push_back(limited_);
    }
    if (!automatic && !finite) {
      state_ = start;
      system_.setHistory(state_.history);
      report_.why = fmt::format(
          "time {:.6g} s, after {} steps of {:.3e} s: the motion is not finite; likeliest cause: the step "
          "is longer than the stable one (step_s 0 takes that)",
          state_.time_s, report_.steps, h_);
      return report_;
    }
    double after = omega;
    if (automatic) {
      if (finite) after = estimate();
      // Not for the last digits of an estimate whose error is part of it.
      if (!finite || !(h_ * after <= 2 || after <= 1.005 * omega)) {
        state_ = start;
        system_.setHistory(state_.history);
        pulled_ = pulled;
        if (++rejections > kMostRejections) {
          report_.why = fmt::format(
              "time {:.6g} s, after {} steps, the last of {:.3e} s: the stable step shrinks without end; likeliest "
              "cause: part of the sheet is crushed to nothing ({})",
              state_.time_s, report_.steps, h_, system_.describe(mode_));
          return report_;
        }
        omega = finite ? std::max(omega, after) : 2 * omega;
        window = std::max(1L, window / 2);
        setStep(stableStep(omega));
        continue;
      }
      rejections = 0;
    }
    for (std::size_t k = 0; k < passed.size(); ++k) {
      ++report_.steps;
      report_.projections += limited[k].projections;
      report_.limits_missed += !limited[k].converged;
      report_.limit_residual = std::max(report_.limit_residual, limited[k].residual);
      if (!observe(passed[k])) {
        state_ = passed[k];
        return report_;
      }
    }
    if (!automatic || left_ == 0) continue;
    if (after > 1.02 * omega)
      window = std::max(1L, window / 2);
    else if (after < 1.01 * omega)
      window = std::min(longest, 2 * window);
    // A warm estimate may have followed one mode while another rose: it falls only slowly.
    omega = std::max(after, 0.95 * omega);
    // A change of step costs energy; keep it while it is neither too long nor far too short.
    const double wanted = stableStep(omega);
    if (wanted < h_ || 0.7 * wanted > h_) setStep(wanted);
  }
  report_.reached = true;
  return report_;
}

}  // namespace

DynamicReport integrateExplicit(System& system, const DynamicOptions& o, DynamicState& state,
                                const DynamicObserver& observe) {
  if (system.hasStiffnessDamping())
    throw InputError({"", 0, "rayleigh_stiffness_s"},
                     "explicit steps take no stiffness damping: it would cut the stable step; use an implicit scheme");
  if (!(o.step_s >= 0)) throw InputError({"", 0, "step_s"}, "must be >= 0");
  if (o.step_s == 0 && !(o.safety > 0 && o.safety <= 1))
    throw InputError({"", 0, "safety"}, "must be > 0 and at most 1");
  return ExplicitRun(system, o, state).run(observe);
}

}  // namespace gambeson
