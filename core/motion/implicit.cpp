/// Newmark's method and the generalised-alpha method (Chung and Hulbert 1993) with Newton's method.
///
///   M ((1 - am) a1 + am a0) + (1 - af) (D(y1) v1 + g(y1, t1)) + af (D(y0) v0 + g(y0, t0)) = 0
///   y1 = y0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1),   v1 = v0 + h ((1 - gamma) a0 + gamma a1)
///
/// am = af = 0 is Newmark; am = (2 r - 1)/(r + 1), af = r/(r + 1), gamma = 1/2 - am + af, beta = (1 - am + af)^2/4 with
/// r the spectral radius at infinite frequency. Both are of second order (Newmark for gamma = 1/2). With am = af = 0
/// and D = a M + b K_M this is box 2 of Man 2006 (eq. 2.85 with the sign of its internal force turned). Newton's matrix
/// has D where it is, but not how it changes: each iteration leaves of the damping's part about what the step turns.

#include "core/motion/implicit.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "core/motion/structure_motion.hpp"
#include "core/statics/newton.hpp"

namespace gambeson {
namespace {

struct Scheme {
  double beta, gamma, am, af;
};

Scheme schemeOf(const ImplicitOptions& o) {
  if (o.scheme == ImplicitScheme::newmark) {
    if (!(o.beta > 0)) throw InputError({"", 0, "beta"}, "must be > 0");
    if (!(o.gamma >= 0.5)) throw InputError({"", 0, "gamma"}, "must be >= 1/2: below, the scheme feeds energy in");
    return {o.beta, o.gamma, 0, 0};
  }
  const double r = o.spectral_radius;
  if (!(r >= 0 && r <= 1)) throw InputError({"", 0, "spectral_radius"}, "must be 0 to 1");
  const double am = (2 * r - 1) / (r + 1), af = r / (r + 1);
  return {(1 - am + af) * (1 - am + af) / 4, 0.5 - am + af, am, af};
}

/// Writes D(y) v, with what moving supports drag along, and D itself.
void dampingAt(System& system, std::span<const double> y, std::span<const double> v, double t, double h, bool lumped,
               SymmetricMatrix& D, std::span<double> out) {
  system.damping(y, t, lumped, true, D);
  std::vector<double> support(out.size());
  system.supportForce(t, h, lumped, SupportForces::damping, support);
  multiply(D, v, out);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += support[i];
}

/// The equations of one step, in y1.
class Step : public Equations {
 public:
  /// `g0`: forces at the start, with those of a damping that changes. Such a D is that of the last residual.
  Step(System& system, const Scheme& scheme, const SymmetricMatrix& M, SymmetricMatrix& D, const SystemState& from,
       std::span<const double> g0, double h, bool lumped)
      : system_(system),
        scheme_(scheme),
        M_(M),
        D_(D),
        from_(from),
        h_(h),
        lumped_(lumped),
        known_(g0.begin(), g0.end()),
        support_(g0.size()) {
    for (double& v : known_) v *= scheme.af;
    system.supportForce(from.time_s + (1 - scheme.af) * h, h, lumped,
                        system.hasStiffnessDamping() ? SupportForces::inertia : SupportForces::all, support_);
    for (std::size_t i = 0; i < known_.size(); ++i) known_[i] += support_[i];
  }

  /// v and a at the end, of y1.
  void kinematics(std::span<const double> y1, std::vector<double>& v1, std::vector<double>& a1) const {
    v1.resize(from_.v.size());
    a1.resize(v1.size());
    for (std::size_t i = 0; i < v1.size(); ++i) {
      a1[i] = (y1[i] - from_.y[i] - h_ * from_.v[i]) / (scheme_.beta * h_ * h_) - (0.5 / scheme_.beta - 1) * from_.a[i];
      v1[i] = from_.v[i] + h_ * ((1 - scheme_.gamma) * from_.a[i] + scheme_.gamma * a1[i]);
    }
  }

  double residual(std::span<const double> y1, std::span<double> r) override {
    const std::size_t n = r.size();
    const double am = scheme_.am, af = scheme_.af;
    kinematics(y1, v_, a_);
    damping_.resize(n);
    if (system_.hasStiffnessDamping()) {
      dampingAt(system_, y1, v_, from_.time_s + h_, h_, lumped_, D_, damping_);
      for (double& v : damping_) v *= 1 - af;
    }
    for (std::size_t i = 0; i < n; ++i) {
      a_[i] = (1 - am) * a_[i] + am * from_.a[i];
      v_[i] = (1 - af) * v_[i] + af * from_.v[i];
    }
    inertia_.resize(n);
    multiply(M_, a_, inertia_);
    if (!system_.hasStiffnessDamping()) multiply(D_, v_, damping_);
    double size = system_.residual(y1, from_.time_s + h_, r);
    for (std::size_t i = 0; i < n; ++i) r[i] = (1 - af) * r[i] + known_[i] + inertia_[i] + damping_[i];
    return std::max({size, norm(inertia_), norm(damping_), norm(known_)});
  }

  void retract(std::span<const double> y, std::span<const double> dy, double s, std::span<double> out) const override {
    system_.retract(y, dy, s, from_.time_s + h_, out);
  }

  void tangent(std::span<const double> y1, SymmetricMatrix& K) override {
    system_.stiffnessInMotion(y1, from_.time_s + h_, K);
    const double m = (1 - scheme_.am) / (scheme_.beta * h_ * h_), f = 1 - scheme_.af,
                 d = f * scheme_.gamma / (scheme_.beta * h_);
    for (std::size_t k = 0; k < K.values.size(); ++k)
      K.values[k] = f * K.values[k] + d * D_.values[k] + m * M_.values[k];
  }

 private:
  System& system_;
  const Scheme& scheme_;
  const SymmetricMatrix& M_;
  SymmetricMatrix& D_;
  const SystemState& from_;
  double h_;
  bool lumped_;
  std::vector<double> known_, support_, v_, a_, inertia_, damping_;
};

constexpr int kHalvings = 12;

/// The step to the state is accepted: its laws remember it.
void commitStep(System& system, SystemState& state) {
  state.lost_J += system.commit(state.y, state.time_s);
  state.history.assign(system.history().begin(), system.history().end());
}

ImplicitReport take(System& system, const ImplicitOptions& o, double end_s, SystemState& state,
                    const SystemObserver& observe) {
  const Scheme scheme = schemeOf(o);
  if (!(o.step_s > 0)) throw InputError({"", 0, "step_s"}, "must be > 0");
  const auto n = static_cast<std::size_t>(system.size());
  SymmetricMatrix K = system.sparsity(), M = K, D = K;
  for (SymmetricMatrix* m : {&K, &M, &D}) m->values.assign(m->rows.size(), 0.0);
  system.mass(o.lumped_mass, M);
  system.damping(state.y, state.time_s, o.lumped_mass, true, D);
  std::vector<double> g(n), f(n), ahead(n), trial;
  double largest = 0;
  ImplicitReport report;
  SymmetricFactor factor(K);
  {  // the acceleration at the start
    largest = system.residual(state.y, state.time_s, g);
    system.supportForce(state.time_s, o.step_s, o.lumped_mass, SupportForces::all, f);
    std::vector<double> damping(n);
    multiply(D, state.v, damping);
    for (std::size_t i = 0; i < n; ++i) f[i] = -(f[i] + g[i] + damping[i]);
    if (factor.factorise(M) != Definiteness::positive) throw InputError({"", 0, "mass"}, "is not positive");
    ++report.factorisations;
    factor.solve(f, state.a);
  }
  const double start = state.time_s, span = end_s - start;
  const long count = std::max(1L, static_cast<long>(std::ceil(span / o.step_s - 1e-6)));
  constexpr long units = 1L << kHalvings;
  const long total = count * units;
  const auto timeAt = [&](long position) {
    return position == total ? end_s : start + span * static_cast<double>(position) / static_cast<double>(total);
  };
  long position = 0, step = units;
  bool with_damping = false;  ///< g has the damping where the step starts
  NewtonOptions newton{o.iterations, o.tolerance, 0, system.reach(), false};
  while (position < total) {
    const double h = timeAt(position + step) - state.time_s;
    if (system.hasStiffnessDamping() && scheme.af > 0 && !with_damping) {
      dampingAt(system, state.y, state.v, state.time_s, h, o.lumped_mass, D, f);
      for (std::size_t i = 0; i < n; ++i) g[i] += f[i];
      with_damping = true;
    }
    Step equations(system, scheme, M, D, state, g, h, o.lumped_mass);
    newton.least_force = 1e-6 * largest;
    NewtonReport result;
    for (const bool careful : {false, true}) {
      trial = state.y;
      if (!careful) {
        for (std::size_t i = 0; i < n; ++i) ahead[i] = h * state.v[i] + 0.5 * h * h * state.a[i];
        system.retract(trial, ahead, 1, state.time_s + h, trial);
      }
      newton.line_search = careful;
      result = solveNewton(equations, newton, trial, K, factor);
      report.factorisations += result.factorisations;
      report.iterations += result.iterations;
      if (result.converged) break;
    }
    if (!result.converged) {
      if (step > 1) {
        step /= 2;
        continue;
      }
      report.why = fmt::format(
          "time {:.6g} s: Newton's residual is {:.2e} of the forces after {} iterations with a step of {:.2e} s, "
          "halved {} "
          "times; likeliest cause: {}. The last accepted state is at {:.6g} s",
          state.time_s, result.residual, result.iterations, h, kHalvings,
          !result.finite ? "forces that are not finite (a cell collapses)" : "a law or a contact that is not smooth",
          state.time_s);
      return report;
    }
    std::vector<double> v, a;
    equations.kinematics(trial, v, a);
    state.y.swap(trial);
    state.v.swap(v);
    state.a.swap(a);
    position += step;
    state.time_s = timeAt(position);
    system.dropIdle(state.y, state.time_s, state.v);
    system.dropIdle(state.y, state.time_s, state.a);
    commitStep(system, state);
    largest = std::max(largest, system.residual(state.y, state.time_s, g));
    with_damping = false;
    ++report.steps;
    if (!observe(state)) return report;
    while (step < units && position % (2 * step) == 0 && result.iterations <= o.iterations / 2) step *= 2;
  }
  report.reached = true;
  return report;
}

}  // namespace

ImplicitReport integrate(System& system, const ImplicitOptions& o, double end_s, SystemState& state,
                         const SystemObserver& observe) {
  if (state.y.empty()) state.y = system.start();
  for (std::vector<double>* part : {&state.v, &state.a})
    if (part->empty()) part->assign(static_cast<std::size_t>(system.size()), 0.0);
  const auto check = [](std::size_t size, std::size_t expected) {
    if (size != expected) throw InputError({"", 0, "state"}, fmt::format("{} unknowns, expected {}", size, expected));
  };
  check(state.y.size(), system.start().size());
  check(state.v.size(), static_cast<std::size_t>(system.size()));
  check(state.a.size(), static_cast<std::size_t>(system.size()));
  if (!state.history.empty()) {
    if (state.history.size() != system.history().size())
      throw InputError({"", 0, "state"},
                       fmt::format("remembers {} numbers, expected {}", state.history.size(), system.history().size()));
    system.setHistory(state.history, state.time_s);
  }
  state.history.assign(system.history().begin(), system.history().end());
  if (!(end_s > state.time_s)) throw InputError({"", 0, "end_s"}, "must be after the start");
  if (!(o.tolerance > 0) || o.iterations < 1) throw InputError({"", 0, "tolerance"}, "must be > 0");
  return take(system, o, end_s, state, observe);
}

ImplicitSteps::ImplicitSteps(const Structure& structure, const ImplicitOptions& options)
    : structure_(structure), options_(options), system_(structure, ProgramEnds::constant) {
  refuseProjectedSeams(structure);
}

void ImplicitSteps::advance(double until, State& state, const StepObserver& observe) {
  if (!(state.time_s < until)) return;
  const DofMap& dofs = structure_.dofs;
  SystemState now{state.time_s, state.y, {}, {}, state.history};
  const auto unknowns = [&](const std::vector<Vec3>& points, const std::vector<double>& inner,
                            std::vector<double>& out) {
    for (int k = 0; k < dofs.unknowns(); ++k) {
      const int c = dofs.component[static_cast<std::size_t>(k)];
      const double value = c < 3 * dofs.points ? points[static_cast<std::size_t>(c / 3)][c % 3]
                                               : inner[static_cast<std::size_t>(c - 3 * dofs.points)];
      out.push_back(dofs.unknownOf(k, value));
    }
  };
  if (now.y.empty()) {
    std::vector<Vec3> u = state.p;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] -= structure_.cloth->rest()[structure_.cloth->map().home[i]];
    std::vector<double> start(structure_.cloth->innerValues()), changed = state.inner;
    structure_.cloth->startInner(start);
    for (std::size_t k = 0; k < changed.size(); ++k) changed[k] -= start[k];
    if (structure_.cloth->turnsInner()) changed.assign(structure_.cloth->innerRates(), 0.0);
    unknowns(u, changed, now.y);
  }
  if (now.y.size() == static_cast<std::size_t>(dofs.unknowns())) {
    const std::vector<double> turned =
        turnedValues(structure_, state.inner, programValues(structure_, state.time_s, ProgramEnds::constant));
    now.y.insert(now.y.end(), turned.begin(), turned.end());
  }
  unknowns(state.v, state.inner_rate, now.v);
  const StepResult nothing;
  double lost_J = 0;
  const ImplicitReport report = integrate(system_, options_, until, now, [&](const SystemState& s) {
    StepReport step;
    step.step_s = s.time_s - state.time_s;
    step.work.cloth = s.lost_J - lost_J;
    lost_J = s.lost_J;
    State next = structureState(structure_, s.time_s, s.y, s.v, s.a, 2 * step.step_s);
    next.history = s.history;
    next.last_step_s = step.step_s;
    observe(state, next, step, nothing, {});
    state = std::move(next);
    return true;
  });
  report_.steps += report.steps;
  report_.factorisations += report.factorisations;
  report_.iterations += report.iterations;
  if (!report.reached) throw RunError(report.why);
}

}  // namespace gambeson
