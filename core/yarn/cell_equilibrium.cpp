#include "core/yarn/cell_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "core/statics/newton.hpp"

namespace gambeson {
namespace {

constexpr double kLeastRaise = 1e-10;    ///< of the diagonal
constexpr double kStillDefinite = 1e-8;  ///< a raise that hides no instability but slides, which cost nothing
constexpr double kNear = 0.1;            ///< of the distance at which yarns touch: pairs that the sparsity has room for
constexpr double kSmallDiagonal = 1e-6;  ///< of the largest: what a raise takes for smaller entries

/// Sections moved by s times a change of the unknowns.
std::vector<Pose> movedBy(const RodCell& cell, std::span<const Pose> sections, std::span<const double> d, double s) {
  const SparseRows& C = cell.freedoms();
  std::vector<Pose> moved(sections.begin(), sections.end());
  for (int i = 0; i < cell.sections(); ++i) {
    Vec3 by[2];
    for (int c = 0; c < 6; ++c)
      for (int k = C.offsets[6 * i + c]; k < C.offsets[6 * i + c + 1]; ++k)
        by[c / 3][c % 3] += s * C.values[k] * d[C.columns[k]];
    moved[i].origin += by[0];
    moved[i].rotation = turned(moved[i].rotation, by[1] / cell.turnLength_m());
  }
  return moved;
}

/// The longest step that one iteration may make: yarns must not pass through each other, nor sections turn over.
double longestStep(const RodCell& cell) {
  double length = 4 * cell.turnLength_m();
  for (const WovenYarn& y : cell.yarns().yarn) length = std::min({length, 0.25 * y.spacing_m, y.half_thickness_m});
  return length;
}

CellLoad between(const CellLoad& a, const CellLoad& b, double t) {
  const auto mix = [&](double x, double y) { return x + t * (y - x); };
  return {mix(a.e11, b.e11), mix(a.e22, b.e22), mix(a.g12, b.g12), mix(a.curvature_per_m, b.curvature_per_m),
          b.direction_rad};
}

}  // namespace

std::string EquilibriumReport::reason() const {
  switch (end) {
    case End::converged:
      return "converged";
    case End::too_many_iterations:
      return "the forces do not balance within the iterations";
    case End::no_descent:
      return "no step lowers the energy";
    case End::not_finite:
      return "a force is not finite";
    case End::friction:
      return "friction and the forces that press do not settle";
  }
  return {};
}

std::vector<double> EquilibriumWork::residual(const CellAnswer& of) const {
  const SparseRows& C = cell_.freedoms();
  std::vector<double> r(static_cast<std::size_t>(C.column_count), 0.0);
  for (int row = 0; row < C.rows(); ++row)
    for (int k = C.offsets[row]; k < C.offsets[row + 1]; ++k)
      r[C.columns[k]] += C.values[k] * of.gradient[row / 3][row % 3];
  return r;
}

void EquilibriumWork::evaluate(const CellFaces& faces, std::span<const Pose> sections, CellAnswer& out) const {
  cell_.evaluate(faces, sections, out, nullptr, false, friction());
}

void EquilibriumWork::pressAsAccepted() {
  if (!history) return;
  friction_ = {history->grips, {}};
  for (const PairGrip& g : history->grips) friction_.normal_N.push_back(g.normal_N);
}

double EquilibriumWork::press(const CellFaces& faces, std::span<const Pose> sections) {
  if (!history) return 0;
  CellFriction now = frictionAt(cell_, faces, sections, *history);
  double change2 = 0;
  for (std::size_t g = 0; g < std::min(now.normal_N.size(), friction_.normal_N.size()); ++g) {
    const double change = now.normal_N[g] - friction_.normal_N[g];
    change2 += change * change;
  }
  friction_ = std::move(now);
  return std::sqrt(change2);
}

void EquilibriumWork::assemble(const CellFaces& faces, std::span<const Pose> sections, const CellAnswer& at,
                               bool downhill) {
  if (!factor_ || !std::includes(pairs_.begin(), pairs_.end(), at.touching.begin(), at.touching.end())) {
    const std::vector<int> near = cell_.nearPairs(faces, sections, kNear);
    pairs_.clear();
    std::set_union(near.begin(), near.end(), at.touching.begin(), at.touching.end(), std::back_inserter(pairs_));
    blocks_ = cell_.sparsity(pairs_);
    reduction_ = std::make_unique<Reduction>(blocks_, cell_.freedoms());
    reduced_ = reduction_->sparsity();
    factor_ = std::make_unique<SymmetricFactor>(reduced_, Elimination::entries);
  }
  CellAnswer again;
  cell_.evaluate(faces, sections, again, &blocks_, downhill, friction());
  reduction_->reduce(blocks_, reduced_);
}

bool EquilibriumWork::factorise(double raise) {
  raised_ = reduced_;
  double largest = 0;
  for (int c = 0; c < raised_.size; ++c) largest = std::max(largest, std::abs(raised_.values[raised_.offsets[c]]));
  for (int c = 0; c < raised_.size; ++c) {
    double& d = raised_.values[raised_.offsets[c]];
    d += raise * std::max(std::abs(d), kSmallDiagonal * largest);
  }
  return factor_->factorise(raised_) == Definiteness::positive;
}

bool EquilibriumWork::settle(const CellFaces& faces, std::span<const Pose> sections, const CellAnswer& at) {
  assemble(faces, sections, at);
  return factorise(kLeastRaise) || factorise(kStillDefinite);
}

std::vector<double> EquilibriumWork::onUnknowns(std::span<const double> blocks) const {
  const SparseRows& C = cell_.freedoms();
  std::vector<double> r(static_cast<std::size_t>(C.column_count), 0.0);
  for (int row = 0; row < C.rows(); ++row)
    for (int k = C.offsets[row]; k < C.offsets[row + 1]; ++k) r[C.columns[k]] += C.values[k] * blocks[row];
  return r;
}

std::vector<double> EquilibriumWork::follow(std::span<const double> force) const {
  constexpr int kRefinements = 60;
  constexpr double kSettled = 1e-11, kStalled = 0.5, kHeld = 1e-3;
  std::vector<double> x(force.size(), 0.0), left(force.begin(), force.end()), d(force.size()), kx(force.size());
  double size = norm(force), before = 2 * size / kStalled;
  const double enough = kSettled * size;
  for (int k = 0; k < kRefinements && size > enough && size < kStalled * before; ++k) {
    factor_->solveOnce(left, d);
    for (std::size_t i = 0; i < d.size(); ++i) x[i] += d[i];
    multiply(reduced_, x, kx);
    for (std::size_t i = 0; i < d.size(); ++i) left[i] = force[i] - kx[i];
    before = size, size = norm(left);
  }
  if (size > kHeld * norm(force)) throw RunError("a force moves yarns that nothing holds");
  return x;
}

namespace {

/// Downhill in the energy, and in friction's potential under the forces that press. `rounding`: of the residual, before
/// and after [N].
EquilibriumReport descend(const RodCell& cell, const CellFaces& faces, std::vector<Pose>& sections,
                          EquilibriumWork& work, const EquilibriumOptions& options, double& rounding) {
  using End = EquilibriumReport::End;
  constexpr double kMostRaise = 1e3, kArmijo = 1e-4;
  constexpr double kRounding = 1e-14;  ///< of the energy, and of what the forces do along the cell
  constexpr int kCuts = 40;
  EquilibriumReport report;
  const double longest = longestStep(cell);
  double raise = kLeastRaise;
  bool known = false;  // whether the tangent is definite, of the last iterate
  work.evaluate(faces, sections, work.answer);
  for (;; ++report.iterations) {
    const std::vector<double> r = work.residual(work.answer);
    const double size = norm(r);
    report.residual = size == 0 ? 0 : size / work.answer.balanced_N;
    report.energy_J = work.answer.energy_J;
    report.end = End::not_finite;
    if (!std::isfinite(size)) return report;
    report.end = End::converged;
    if (size <= std::max(options.tolerance * work.answer.balanced_N, rounding)) {
      if (!known) {
        work.assemble(faces, sections, work.answer);
        report.stable = work.factorise(kStillDefinite);
      }
      return report;
    }
    report.end = End::too_many_iterations;
    if (report.iterations == options.iterations) return report;

    report.end = End::not_finite;
    work.assemble(faces, sections, work.answer);
    if (!isFinite(work.unraised())) return report;
    rounding = roundingForce(work.unraised(), cell.reach_m());
    bool definite = work.factorise(raise);
    known = definite && raise <= kStillDefinite;
    if (!definite) work.assemble(faces, sections, work.answer, true);
    while (!definite && raise < kMostRaise) {
      definite = work.factorise(raise);
      if (!definite) raise = std::max(10 * raise, 1e-7);
    }
    report.end = End::no_descent;
    if (!definite) return report;
    std::vector<double> d(r.size());
    work.factor().solve(r, d);
    for (double& v : d) v = -v;
    double largest = 0;
    for (const double v : d) largest = std::max(largest, std::abs(v));
    double s = largest > longest ? longest / largest : 1;
    const double slope = dot(r, d), energy = work.answer.energy_J;
    const double blur = kRounding * (std::abs(energy) + work.answer.balanced_N * cell.reach_m());
    bool lower = false;
    for (int cut = 0; cut < kCuts && !lower; ++cut) {
      std::vector<Pose> moved = movedBy(cell, sections, d, s);
      work.evaluate(faces, moved, work.trial);
      lower = work.trial.energy_J <= energy + kArmijo * s * slope + blur;
      if (lower)
        sections.swap(moved);
      else
        s *= 0.5;
    }
    if (!lower) return report;
    std::swap(work.answer, work.trial);
    raise = std::max(kLeastRaise, 0.1 * raise);
  }
}

}  // namespace

EquilibriumReport findEquilibrium(const RodCell& cell, const CellFaces& faces, std::vector<Pose>& sections,
                                  EquilibriumWork& work, const EquilibriumOptions& options) {
  constexpr int kPasses = 100, kMostGrowths = 3;
  double rounding = 0;
  work.pressAsAccepted();
  EquilibriumReport report = descend(cell, faces, sections, work, options, rounding);
  if (!work.history || work.history->grips.empty()) return report;
  double before = std::numeric_limits<double>::infinity();
  for (int pass = 0, growths = 0; pass < kPasses && growths < kMostGrowths && report.converged(); ++pass) {
    const double change = work.press(faces, sections);
    growths += change >= before;
    before = change;
    const int iterations = report.iterations;
    report = descend(cell, faces, sections, work, options, rounding);
    const bool balanced = report.iterations == 0;
    report.iterations += iterations;
    if (balanced) return report;
  }
  if (report.converged()) report.end = EquilibriumReport::End::friction;
  return report;
}

LoadReport changeLoad(const RodCell& cell, const CellLoad& from, const CellLoad& to, std::vector<Pose>& sections,
                      EquilibriumWork& work, const EquilibriumOptions& options) {
  checkLoad(to);
  if (cell.design().faces == FaceSupport::held && to.curvature_per_m != 0)
    throw InputError({"", 0, "faces"}, "held, must be glide where the cloth bends");
  if (cell.design().extent == CellExtent::quarter && to.curvature_per_m != 0)
    throw InputError({"", 0, "extent"}, "quarter, must be full where the cloth bends");
  LoadReport report;
  report.reached = from;
  const double least = std::ldexp(1.0, -options.halvings);
  double done = 0, step = 1;
  while (true) {
    const double next = std::min(1.0, done + step);
    const CellLoad load = next == 1 ? to : between(from, to, next);
    std::vector<Pose> trial = carried(sections, report.reached, load);
    const EquilibriumReport part = findEquilibrium(cell, facesOf(cell.yarns(), load), trial, work, options);
    const int iterations = report.iterations + part.iterations;
    static_cast<EquilibriumReport&>(report) = part;
    report.iterations = iterations;
    if (!part.converged()) {
      step *= 0.5;
      if (step < least) return report;
      continue;
    }
    sections.swap(trial);
    report.reached = load;
    done = next;
    if (done == 1) return report;
  }
}

}  // namespace gambeson
