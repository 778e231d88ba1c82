#include "cases/study/map_search.hpp"

#include <nlopt.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <exception>
#include <memory>
#include <numeric>

#include "core/error.hpp"

namespace gambeson::study {
namespace {

/// Steps shorter than this change no torque by more than runs scatter.
constexpr double kShortestStep = 0.01;

/// A search for the least mass ends on its limit, on whose side chance decides: it keeps this share of it off.
constexpr double kOffLimit = 0.01;

std::size_t heaviest(const MapProblem& p) {
  return static_cast<std::size_t>(std::max_element(p.mass_kg.begin(), p.mass_kg.end()) - p.mass_kg.begin());
}

std::vector<double> rounded(std::vector<double> map) {
  for (double& factor : map) factor = roundedFactor(factor);
  return map;
}

/// What NLopt's functions of C are given.
class Search {
 public:
  Search(const MapProblem& p, const std::function<double(const std::vector<double>&)>& torque)
      : p_(p), torque_(torque), heaviest_(heaviest(p)), mass_kg_(p.massOf(p.start)) {}

  std::vector<TriedMap> run() {
    ask(p_.start);
    const auto n = static_cast<unsigned>(p_.aim == Aim::torque ? p_.start.size() - 1 : p_.start.size());
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt(nlopt_create(NLOPT_LN_COBYLA, n), nlopt_destroy);
    opt_ = opt.get();
    nlopt_set_lower_bounds1(opt_, p_.least);
    nlopt_set_upper_bounds1(opt_, p_.most);
    nlopt_set_initial_step1(opt_, p_.step);
    nlopt_set_xtol_abs1(opt_, kShortestStep);
    nlopt_set_maxeval(opt_, static_cast<int>(50 * p_.runs));  // maps that were tried cost nothing
    std::vector<double> y;
    for (std::size_t i = 0; i < p_.start.size(); ++i)
      if (p_.aim == Aim::mass || i != heaviest_) y.push_back(p_.start[i]);
    constexpr double slack = 1e-9;
    if (p_.aim == Aim::torque) {
      nlopt_set_min_objective(
          opt_, [](unsigned, const double* x, double*, void* s) { return of(s).torqueAt(x); }, this);
      // What the heaviest region is left with lies within its bounds.
      nlopt_add_inequality_constraint(
          opt_, [](unsigned, const double* x, double*, void* s) { return of(s).p_.least - of(s).restAt(x); }, this,
          slack);
      nlopt_add_inequality_constraint(
          opt_, [](unsigned, const double* x, double*, void* s) { return of(s).restAt(x) - of(s).p_.most; }, this,
          slack);
    } else {
      nlopt_set_min_objective(
          opt_, [](unsigned, const double* x, double*, void* s) { return of(s).massAt(x); }, this);
      nlopt_add_inequality_constraint(
          opt_, [](unsigned, const double* x, double*, void* s) { return of(s).excessAt(x); }, this, 0);
    }
    double value = 0;
    const nlopt_result result = nlopt_optimize(opt_, y.data(), &value);
    if (failure_) std::rethrow_exception(failure_);
    // Rounding that leaves no better step is an end as another.
    if (result < 0 && result != NLOPT_FORCED_STOP && result != NLOPT_ROUNDOFF_LIMITED)
      throw RunError("the search for a thickness map cannot go on: NLopt says " +
                     std::string(nlopt_result_to_string(result)));
    return std::move(tried_);
  }

 private:
  static Search& of(void* s) { return *static_cast<Search*>(s); }

  /// All factors of what NLopt varies, with Aim::torque before the heaviest has its own.
  std::vector<double> whole(const double* y) const {
    std::vector<double> map = p_.start;
    for (std::size_t i = 0, k = 0; i < map.size(); ++i)
      if (p_.aim == Aim::mass || i != heaviest_) map[i] = std::round(1e4 * y[k++]) / 1e4;  // hairs make no new map
    return map;
  }
  double restAt(const double* y) const {
    const std::vector<double> map = whole(y);
    return map[heaviest_] + (mass_kg_ - p_.massOf(map)) / p_.mass_kg[heaviest_];
  }
  double torqueAt(const double* y) { return ask(mapOfMass(p_, whole(y), mass_kg_)) / tried_[0].torque_Nm; }
  double massAt(const double* y) const { return p_.massOf(whole(y)) / mass_kg_; }
  double excessAt(const double* y) { return ask(whole(y)) / p_.limit_Nm - (1 - kOffLimit); }

  double ask(const std::vector<double>& wanted) {
    const std::vector<double> map = rounded(wanted);
    for (const TriedMap& t : tried_)
      if (t.map == map) return t.torque_Nm;
    if (failure_ || tried_.size() >= p_.runs) {
      if (opt_) nlopt_force_stop(opt_);
      return tried_.back().torque_Nm;  // no more is made of it
    }
    try {
      tried_.push_back({map, torque_(map)});
    } catch (...) {
      // NLopt is C, which no exception passes through.
      if (!opt_) throw;
      failure_ = std::current_exception();
      nlopt_force_stop(opt_);
    }
    return tried_.back().torque_Nm;
  }

  const MapProblem& p_;
  const std::function<double(const std::vector<double>&)>& torque_;
  std::size_t heaviest_;
  double mass_kg_;
  nlopt_opt opt_ = nullptr;
  std::vector<TriedMap> tried_;
  std::exception_ptr failure_;
};

}  // namespace

double MapProblem::massOf(const std::vector<double>& map) const {
  return std::inner_product(map.begin(), map.end(), mass_kg.begin(), 0.0);
}

double roundedFactor(double factor) { return std::round(1e6 * factor) / 1e6; }

std::vector<double> mapOfMass(const MapProblem& p, const std::vector<double>& map, double wanted_kg) {
  std::vector<double> out = map;
  const std::size_t h = heaviest(p);
  out[h] += (wanted_kg - p.massOf(out)) / p.mass_kg[h];
  if (out[h] >= p.least && out[h] <= p.most) return out;
  const auto moved = [&](double by) {
    std::vector<double> m = out;
    for (double& factor : m) factor = std::clamp(factor + by, p.least, p.most);
    return m;
  };
  // The mass grows with `by`: halved until doubles have nothing between.
  double low = p.least - *std::max_element(out.begin(), out.end());
  double high = p.most - *std::min_element(out.begin(), out.end());
  for (int k = 0; k < 100; ++k) {
    const double middle = 0.5 * (low + high);
    (p.massOf(moved(middle)) < wanted_kg ? low : high) = middle;
  }
  return moved(high);
}

std::vector<TriedMap> searchMap(const MapProblem& p, const std::function<double(const std::vector<double>&)>& torque) {
  assert(p.start.size() == p.mass_kg.size() && p.start.size() >= (p.aim == Aim::torque ? 2u : 1u) && p.runs > 0);
  return Search(p, torque).run();
}

std::size_t bestOf(const MapProblem& p, const std::vector<TriedMap>& tried) {
  std::size_t best = 0;
  const auto below = [&](std::size_t i) { return p.aim == Aim::mass && tried[i].torque_Nm <= p.limit_Nm; };
  for (std::size_t i = 1; i < tried.size(); ++i) {
    const bool lighter = below(i) && below(best)   ? p.massOf(tried[i].map) < p.massOf(tried[best].map)
                         : below(i) != below(best) ? below(i)
                                                   : tried[i].torque_Nm < tried[best].torque_Nm;
    if (lighter) best = i;
  }
  return best;
}

}  // namespace gambeson::study
