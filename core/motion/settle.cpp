/// Detail of step.hpp: where inner unknowns start.

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/step.hpp"

namespace gambeson {
namespace {

constexpr int kRounds = 150;
constexpr double kSettled = 1e-6;  ///< of what acts at first

double dotOf(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

/// Steps along the gradient of the energy by the inertia of each unknown, as long as the last one says (Barzilai and
/// Borwein, IMA J. Numer. Anal. 8, 1988).
void settleInner(const Model& m, State& state, StepWork& w) {
  const std::size_t n = m.inner_mass.size();
  if (n == 0) return;
  w.q.resize(m.cloth->points());
  w.f.resize(m.cloth->points());
  m.cloth->map().T.multiply<Vec3>(state.p, w.q);
  std::vector<double> root(n), gradient(n), last, step(n), rate(n), value = state.inner, next(value.size());
  for (std::size_t i = 0; i < n; ++i) root[i] = std::sqrt(m.inner_mass[i]);
  const auto gradientAt = [&](const std::vector<double>& inner) {
    w.inner_force.resize(n);
    m.cloth->force({w.q, inner, state.history}, {w.f, w.inner_force, {}, nullptr}, w.cloth);
    for (std::size_t i = 0; i < n; ++i) gradient[i] = -w.inner_force[i] / root[i];
  };
  gradientAt(value);
  const double first = std::sqrt(dotOf(gradient, gradient));
  if (!(first > 0)) return;
  double most = 0;
  for (std::size_t i = 0; i < n; ++i) most = std::max(most, std::abs(gradient[i]) / root[i]);
  double length = 1e-4 / most;  // a first step of 1e-4 rad
  std::vector<double> best = value;
  double least = first;
  for (int round = 0; round < kRounds && least > kSettled * first; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      step[i] = -length * gradient[i];
      rate[i] = step[i] / root[i];
    }
    m.cloth->advance(value, rate, 1.0, next);
    std::swap(value, next);
    last = gradient;
    gradientAt(value);
    for (std::size_t i = 0; i < n; ++i) last[i] = gradient[i] - last[i];
    const double turned = dotOf(step, last), size = std::sqrt(dotOf(gradient, gradient));
    if (size < least) least = size, best = value;
    if (!(turned > 0) || !std::isfinite(size)) break;
    length = dotOf(step, step) / turned;
  }
  state.inner = std::move(best);
  std::fill(state.inner_rate.begin(), state.inner_rate.end(), 0.0);
}

}  // namespace gambeson
