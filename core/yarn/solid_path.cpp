#include "core/yarn/solid_path.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {

void SolidLoadReport::add(const SolidLoadReport& next) {
  const int before[3] = {steps, passes, iterations};
  const SolidLoadReport last = *this;
  *this = next;
  if (next.steps == 0)
    deepest_m = last.deepest_m, residual = last.residual, rounded = last.rounded, stable = last.stable;
  steps += before[0];
  passes += before[1];
  iterations += before[2];
}

SolidCellState restOf(const SolidCell& cell) {
  SolidCellState state;
  state.x = cell.solids().mesh.nodes;
  return state;
}

SolidLoadReport changeLoad(const SolidCell& cell, const CellLoad& to, SolidCellState& state, SolidCellWork& work,
                           const SolidLoadOptions& options) {
  checkLoad(to);
  const CellLoad from = state.load;
  work.system.setPrograms(cell.programs(from, to));
  double thin = INFINITY;
  for (const WovenYarn& y : cell.yarns().yarn) thin = std::min(thin, y.half_thickness_m);
  ContactPathOptions path;
  path.method = options.method;
  path.steps = options.steps;
  path.halvings = options.halvings;
  path.iterations = options.iterations;
  path.tolerance = options.tolerance;
  path.passes = options.passes;
  path.change = options.change;
  path.deepest_m = options.deepest * thin;
  path.raise = kSolidCellRaise;
  ContactState at = contactStart(work.system);
  if (!state.y.empty()) at.y = state.y;
  at.multipliers = state.multipliers;
  SolidLoadReport report;
  const auto keep = [&](const ContactStep& step) {
    state.points = step.points;
    state.lost_J += cell.contact().lost(step.points);
    report.passes += step.passes;
    report.iterations += step.iterations;
    report.deepest_m = step.deepest_m;
    report.residual = step.residual;
    report.rounded = step.rounded;
    report.stable = step.stable;
    return true;
  };
  const ContactReport contact = followContact(work.system, cell.contact(), path, at, work.solver, keep);
  state.load = cell.between(from, to, at.factor);
  state.x = work.system.positions(at.y, at.factor);
  state.y = std::move(at.y);
  state.multipliers = std::move(at.multipliers);
  report.reached = contact.reached;
  report.why = contact.why;
  report.steps = contact.steps;
  return report;
}

}  // namespace gambeson
