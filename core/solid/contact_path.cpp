#include "core/solid/contact_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr int kLeastAugmentations = 2;  ///< with friction
/// Where the facets of a shallow groove share a node, how they do settles slowly: after so many augmentations the step
/// is made again with one facet for each node.
constexpr int kSharedPasses = 15;

[[noreturn]] void reject(const char* key, const std::string& why) { throw InputError({"", 0, key}, why); }

void check(const ContactPathOptions& o, const SolidContactLaw& law) {
  if (o.steps < 1) reject("steps", fmt::format("{} is not allowed: >= 1", o.steps));
  if (o.halvings < 0 || o.halvings > 20) reject("halvings", fmt::format("{} is not allowed: 0 to 20", o.halvings));
  if (o.iterations < 1) reject("iterations", fmt::format("{} is not allowed: >= 1", o.iterations));
  if (o.passes < 1) reject("passes", fmt::format("{} is not allowed: >= 1", o.passes));
  if (!(o.raise >= 0 && o.raise < 1)) reject("raise", fmt::format("{} is not allowed: 0 to 1, 1 excluded", o.raise));
  if (!(o.tolerance > 0)) reject("tolerance", fmt::format("{} is not allowed: > 0", o.tolerance));
  if (o.method == SolidContactMethod::multipliers && law.friction > 0)
    reject("friction", fmt::format("{} is not allowed with multipliers: 0", law.friction));
  if (o.method == SolidContactMethod::penalty && law.friction > 0 && law.bound != FrictionBound::coupled)
    reject("bound", "symmetrised is not allowed with penalties, which have no multipliers: coupled");
  if (o.method == SolidContactMethod::augmented) {
    if (!(o.change > 0)) reject("change", fmt::format("{} is not allowed: > 0", o.change));
    if (!(o.deepest_m > 0)) reject("deepest_m", fmt::format("{} is not allowed: > 0", o.deepest_m));
  }
}

double deepestOf(std::span<const ContactPoint> points) {
  double deepest = 0;
  for (const ContactPoint& p : points) deepest = std::max(deepest, p.over.gap_m);
  return deepest;
}

/// One load, from a state to the next.
class LoadStep {
 public:
  LoadStep(SolidSystem& solids, const SolidContact& contact, const ContactPathOptions& options,
           const ContactState& from, TangentSolver& solver, double to, double largest_force)
      : solids_(solids),
        contact_(contact),
        solver_(solver),
        options_(options),
        from_(from),
        to_(to),
        newton_{options.iterations, options.tolerance, 1e-3 * largest_force, options.raise},
        system_(solids, contact, solver, to, solids.positions(from.y, from.factor)) {}

  /// False where it failed; `why` then.
  bool take() {
    if (!attempt()) {
      if (!(contact_.law().touch.keep > 0) || options_.method != SolidContactMethod::augmented) return false;
      share_ = false;
      if (!attempt()) return false;
    }
    done.deepest_m = deepestOf(done.points);
    done.state.multipliers = contact_.settled(solids_.positions(done.state.y, to_), std::move(done.state.multipliers));
    return true;
  }

  ContactStep done;
  std::string why;
  double force = 0;

 private:
  bool attempt() {
    done.state = {to_, from_.y, from_.multipliers};
    if (!share_) contact_.moveOn(solids_.positions(from_.y, from_.factor), done.state.multipliers, false);
    startAhead();
    return options_.method == SolidContactMethod::penalty       ? penalty()
           : options_.method == SolidContactMethod::multipliers ? tried()
                                                                : augment();
  }

  /// The tangent's way, where it leads to a state that has forces.
  void startAhead() {
    ContactSystem before(solids_, contact_, solver_, from_.factor, solids_.positions(from_.y, from_.factor));
    const std::vector<double> way = before.ahead(from_.multipliers, from_.y, to_ - from_.factor, options_.raise);
    if (way.empty()) return;
    std::vector<double> y = from_.y, r(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += way[i];
    system_.residual(from_.multipliers, y, r);
    if (std::isfinite(norm(r))) done.state.y.swap(y);
  }

  bool converged(const NewtonReport& report) {
    ++done.passes;
    done.iterations += report.iterations;
    force = std::max(force, report.force);
    if (report.residuals.size() > 2 || done.residuals.empty()) done.residuals = report.residuals;
    done.residual = report.residual;
    done.rounded = report.rounded;
    if (report.factorisations > 0) done.stable = report.negative_pivots == 0;
    if (report.converged) return true;
    why = fmt::format("Newton's residual is {:.2e} of the forces after {} iterations of pass {}{}", report.residual,
                      report.iterations, done.passes,
                      report.singular  ? ", and the tangent is singular"
                      : !report.finite ? ", with forces that are not finite: a cell collapses or a node slides too far"
                                       : "");
    return false;
  }

  bool penalty() {
    std::vector<ContactMultipliers> multipliers = from_.multipliers;
    share_ = false;  // without multipliers both facets would press as one does
    for (ContactMultipliers& m : multipliers) m.pressure_Pa = 0;
    for (int k = 0; k <= options_.passes; ++k) {
      if (!converged(system_.solve(multipliers, newton_, done.state.y))) return false;
      multipliers = system_.known();
      done.points = system_.points(multipliers, done.state.y);
      if (moveOn(multipliers) > 0) continue;
      done.state.multipliers = contact_.augmented(done.points);
      return true;
    }
    why = fmt::format("after {} passes nodes still go on from facet to facet", options_.passes);
    return false;
  }

  int moveOn(std::vector<ContactMultipliers>& multipliers) {
    if (!(contact_.law().touch.keep > 0)) return 0;
    return contact_.moveOn(solids_.positions(done.state.y, to_), multipliers, share_);
  }

  bool augment() {
    std::vector<ContactMultipliers>& multipliers = done.state.multipliers;
    const int least = contact_.law().friction > 0 ? kLeastAugmentations : 0;
    double change = 0, largest = 0;
    const bool kept = contact_.law().touch.keep > 0;
    const int passes = kept && share_ ? std::min(options_.passes, kSharedPasses) : options_.passes;
    for (int k = 0; k <= passes; ++k) {
      if (!converged(system_.solve(multipliers, newton_, done.state.y))) return false;
      done.points = system_.points(system_.known(), done.state.y);
      std::vector<ContactMultipliers> next = contact_.augmented(done.points);
      const int moved = moveOn(next);
      change = largest = 0;
      for (const ContactPoint& p : done.points) {
        largest = std::max(largest, p.pressure_Pa);
        change = std::max(change, std::abs(p.pressure_Pa - p.multiplier_Pa));
        const Vec2 before = p.multiplier_N_per_m, t = p.traction_N_per_m;
        if (p.rubs) change = std::max(change, sizeOfTraction({t.x - before.x, t.y - before.y}, p.metric_m2));
      }
      multipliers = std::move(next);
      if (k >= least && moved == 0 && change <= options_.change * largest &&
          deepestOf(done.points) <= options_.deepest_m)
        return true;
    }
    why = fmt::format(
        "after {} augmentations multipliers still change by {:.2e} of the largest pressure, and nodes have "
        "passed by {:.2e} m",
        passes, largest > 0 ? change / largest : 0, deepestOf(done.points));
    return false;
  }

  bool tried() {
    std::vector<ContactMultipliers> pairs = from_.multipliers;
    for (int k = 0; k < options_.passes; ++k) {
      const std::optional<std::vector<ContactMultipliers>> next = nextSet(pairs);
      if (k > 0 && !next) {
        done.points = system_.points(pairs, done.state.y);
        done.state.multipliers = std::move(pairs);
        return true;
      }
      if (next) pairs = *next;
      if (!converged(system_.solveTogether(pairs, newton_, done.state.y))) return false;
    }
    why = fmt::format("the set of contacts still changes after {} trials", options_.passes);
    return false;
  }

  /// Without what pulls, with what has passed, each on the facet where it now is; none where that is the same set.
  std::optional<std::vector<ContactMultipliers>> nextSet(std::span<const ContactMultipliers> pairs) {
    constexpr double kRounding = 1e-12;  // of the solids' length
    const double passed_m = kRounding * solids_.length();
    const auto pushes = [](const ContactMultipliers& p) { return p.pressure_Pa >= 0; };
    std::vector<ContactMultipliers> kept, next;
    std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(kept), pushes);
    bool same = true;
    for (const ContactPoint& p : system_.points(kept, done.state.y, true)) {
      if (!p.known && !(p.over.gap_m > passed_m)) continue;
      same = same && std::any_of(pairs.begin(), pairs.end(), [&](const ContactMultipliers& m) {
               return m.side == p.side && m.slave == p.slave && m.facet == p.facet;
             });
      next.push_back({p.side, p.slave, p.facet, p.facet, p.multiplier_Pa, {}});
    }
    if (same && next.size() == pairs.size()) return std::nullopt;
    return next;
  }

  SolidSystem& solids_;
  const SolidContact& contact_;
  TangentSolver& solver_;
  const ContactPathOptions& options_;
  const ContactState& from_;
  double to_;
  ContactNewton newton_;
  ContactSystem system_;
  bool share_ = true;
};

}  // namespace

ContactState contactStart(const SolidSystem& solids) {
  return {0, std::vector<double>(static_cast<std::size_t>(solids.size()), 0.0), {}};
}

ContactReport followContact(SolidSystem& solids, const SolidContact& contact, const ContactPathOptions& options,
                            ContactState& state, TangentSolver& solver,
                            const std::function<bool(const ContactStep&)>& observe) {
  check(options, contact.law());
  if (static_cast<int>(state.y.size()) != solids.size())
    reject("start", fmt::format("{} unknowns, {} expected", state.y.size(), solids.size()));
  ContactReport report;
  const long units = 1L << options.halvings;
  const double first = state.factor;
  const auto factorAt = [&](long position) {
    return first + (1 - first) * static_cast<double>(position) / static_cast<double>(options.steps * units);
  };
  double largest_force = 0;
  long position = 0, step = units;
  while (position < options.steps * units) {
    LoadStep trial(solids, contact, options, state, solver, factorAt(position + step), largest_force);
    if (!trial.take()) {
      if (step == 1) {
        report.why =
            fmt::format("from factor {:.6g} to {:.6g}: {}", state.factor, factorAt(position + step), trial.why);
        return report;
      }
      step /= 2;
      continue;
    }
    largest_force = std::max(largest_force, trial.force);
    state = trial.done.state;
    position += step;
    ++report.steps;
    if (!observe(trial.done)) return report;
    while (step < units && position % (2 * step) == 0) step *= 2;
  }
  report.reached = true;
  return report;
}

ContactReport followContact(SolidSystem& solids, const SolidContact& contact, const ContactPathOptions& options,
                            ContactState& state, const std::function<bool(const ContactStep&)>& observe) {
  TangentSolver solver;
  return followContact(solids, contact, options, state, solver, observe);
}

}  // namespace gambeson
