#include "cases/cell/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/ticks.hpp"
#include "cases/cell/loops.hpp"

namespace gambeson {
namespace {

/// A number of a path, and whose it is.
struct Worst {
  double value = 0;
  std::string path;
  /// NaN is the worst.
  void see(double v, const std::string& name) {
    if (std::isnan(value) || v <= value) return;
    value = v;
    path = name;
  }
};

bool rubs(const RecordedCell& cell) {
  const std::optional<YarnFriction>& friction = cell.definition().friction;
  return friction && friction->coefficient > 0;
}

template <class Measure>
Worst worstOf(const RecordedCell& cell, Measure measure) {
  Worst worst;
  for (std::size_t k = 0; k < cell.paths().size(); ++k)
    worst.see(measure(cell.definition().paths[k], cell.paths()[k].rows), cell.definition().paths[k].name);
  return worst;
}

AuditCheck reachedCheck(const RecordedCell& cell) {
  long failed = 0;
  std::string which;
  for (std::size_t k = 0; k < cell.definition().paths.size(); ++k) {
    const bool walked = k < cell.paths().size();
    if (walked && cell.paths()[k].reached) continue;
    ++failed;
    which += fmt::format("{}{} {}", which.empty() ? "" : "; ", cell.definition().paths[k].name,
                         walked ? "ends " + cell.paths()[k].why : "was not begun");
  }
  return {"Loads reached",
          static_cast<double>(failed),
          0,
          "",
          "loads that were not walked to their ends",
          fmt::format("not all loads were reached: {}", which)};
}

AuditCheck finiteCheck(const RecordedCell& cell) {
  const Worst worst = worstOf(cell, [&](const PathCase&, const RecordedTable& rows) {
    double count = 0;
    for (const std::string& column : curveColumns(cell.definition()))
      for (const double v : rows.column(column)) count += !std::isfinite(v);
    return count;
  });
  AuditCheck check{"Finite numbers",
                   worst.value,
                   0,
                   "",
                   "numbers of a load that are not finite; the most",
                   fmt::format("{:.0f} numbers of the load {} are not finite", worst.value, worst.path)};
  check.spoils = true;
  return check;
}

AuditCheck residualCheck(const RecordedCell& cell) {
  const Worst worst = worstOf(cell, [](const PathCase&, const RecordedTable& rows) {
    Worst most;
    for (std::size_t k = 0; k < rows.rows(); ++k)
      if (rows.column("rounded")[k] == 0) most.see(rows.column("residual")[k], "");
    return most.value;
  });
  return {"Residual",
          worst.value,
          std::max(cell.definition().solver.tolerance, 1e-6),
          "",
          "forces out of balance at a step, of the forces that balance; the largest, where there is more than rounding",
          fmt::format("forces do not balance: up to {} of them is left on the load {}", formatNumber(worst.value, 2),
                      worst.path)};
}

AuditCheck stableCheck(const RecordedCell& cell) {
  const Worst worst = worstOf(cell, [](const PathCase&, const RecordedTable& rows) {
    const std::vector<double>& stable = rows.column("stable");
    return static_cast<double>(std::count(stable.begin(), stable.end(), 0.0));
  });
  return {
      "Stable",
      worst.value,
      0,
      "steps",
      "steps of a load at which the yarns balance and would leave at the least push; the most",
      fmt::format("the yarns are not stable at {:.0f} steps of the load {}: they would slip to another place there, "
                  "which was not followed",
                  worst.value, worst.path)};
}

/// What forces do along the steps, less what is stored and lost of it: of yarns that rub on all of the way, else there.
double workError(const RecordedCell& cell, const PathCase& path, const RecordedTable& rows) {
  constexpr int kFew = 8;  // steps that are too long for trapezia
  const std::size_t there = static_cast<std::size_t>(path.steps) + 1;
  const std::size_t n = rubs(cell) ? rows.rows() : std::min(rows.rows(), there);
  if (path.steps < kFew || n < 2) return 0;
  const std::vector<CellWork> along = workAlong(rows);
  double error = 0, most = 0;
  for (std::size_t k = 1; k < n; ++k) {
    const CellWork& w = along[k];
    most = std::max(most, std::abs(w.stored) + w.lost);
    error = std::max(error, std::abs(w.work - w.stored - w.lost));
  }
  return most > 0 ? 100 * error / most : 0;
}

AuditCheck workCheck(const RecordedCell& cell) {
  const Worst worst =
      worstOf(cell, [&](const PathCase& path, const RecordedTable& rows) { return workError(cell, path, rows); });
  const char* lost = rubs(cell) ? " and lost by friction" : "";
  return {"Work",
          worst.value,
          2,
          "%",
          fmt::format("work of the forces along a load, by trapezia of its steps, less the energy stored{0}, of the "
                      "most that is stored{0}; of loads with eight steps or more{1}",
                      lost, rubs(cell) ? "" : ", on the way there"),
          fmt::format("on the load {} the forces do {} % more or less work than the yarns store{}: steps are too long, "
                      "or the yarns jumped",
                      worst.path, formatNumber(worst.value, 2), lost)};
}

/// Where the load comes back to a part of its way, the energy should be what it was: nothing rubs.
double loopError(const PathCase& path, const RecordedTable& rows) {
  const std::vector<double>& energy = rows.column("energy_J_per_m2");
  const auto steps = static_cast<std::size_t>(path.steps);
  if (path.cycles == 0 || energy.size() <= steps) return 0;
  double low = energy[0], high = energy[0], error = 0;
  for (const double w : energy) low = std::min(low, w), high = std::max(high, w);
  for (std::size_t k = steps + 1; k < energy.size(); ++k) {
    const std::size_t at = k % (2 * steps), same = at <= steps ? at : 2 * steps - at;
    error = std::max(error, std::abs(energy[k] - energy[same]));
  }
  return high > low ? error / (high - low) : 0;
}

/// Around a loop of yarns that rub: what forces do more or less than friction loses and yarns keep, of what is lost.
/// Next to nothing is lost where all pairs stick: there of a hundredth of what is stored.
double lossError(const PathCase& path, const RecordedTable& rows) {
  constexpr int kFew = 8;
  constexpr double kLittle = 0.01;
  if (path.steps < kFew || rows.empty()) return 0;
  const std::vector<double>& energy = rows.column("energy_J_per_m2");
  const auto [low, high] = std::minmax_element(energy.begin(), energy.end());
  double error = 0;
  for (const CellWork& loop : loopsOf(path, rows)) {
    const double of = std::max(loop.lost, kLittle * (*high - *low));
    if (of > 0) error = std::max(error, 100 * std::abs(loop.work - loop.stored - loop.lost) / of);
  }
  return error;
}

AuditCheck lossCheck(const RecordedCell& cell) {
  const Worst worst = worstOf(cell, lossError);
  return {
      "Energy lost in loops",
      worst.value,
      10,
      "%",
      "work of the forces around a closed loop, by trapezia of its steps, less what friction loses and what more is "
      "stored, of what is lost; of loads with cycles and eight steps or more",
      fmt::format("around a loop of the load {} the forces do {} % more or less work than friction loses: steps "
                  "are too long, or the yarns jumped",
                  worst.path, formatNumber(worst.value, 2))};
}

AuditCheck loopCheck(const RecordedCell& cell) {
  const Worst worst = worstOf(cell, loopError);
  return {
      "Closed loops",
      worst.value,
      1e-4,
      "",
      "energy where a load comes back, less what it was there on the first way, of the most that is stored",
      fmt::format("the load {} comes back to another state: {} of the energy differs, so the yarns jumped on the way",
                  worst.path, formatNumber(worst.value, 2))};
}

/// How far neighbours of a direction overlap, of their width; they do not feel it.
double overlapOf(const CellCase& c, const RecordedTable& rows) {
  double most = 0;
  for (std::size_t k = 0; k < rows.rows(); ++k) {
    const double c11 = 1 + 2 * rows.column("e11")[k], c22 = 1 + 2 * rows.column("e22")[k],
                 c12 = 2 * rows.column("e12")[k], area = std::sqrt(std::max(0.0, c11 * c22 - c12 * c12));
    for (const int d : {along_weft, along_warp}) {
      const WovenYarn& yarn = c.yarn(d).shape;
      const double apart_m = yarn.spacing_m * area / std::sqrt(d == along_weft ? c11 : c22);
      most = std::max(most, 100 * (1 - apart_m / (2 * yarn.half_width_m)));
    }
  }
  return most;
}

AuditCheck besideCheck(const RecordedCell& cell) {
  const Worst worst =
      worstOf(cell, [&](const PathCase&, const RecordedTable& rows) { return overlapOf(cell.definition(), rows); });
  return {"Side by side",
          worst.value,
          1,
          "% of the width",
          "by how much yarns of one direction overlap their neighbours, which they do not feel; the most",
          fmt::format("on the load {} neighbouring yarns overlap by up to {} % of their width, which they do not feel: "
                      "the cloth is stiffer there than these numbers",
                      worst.path, formatNumber(worst.value, 2))};
}

/// Of solids: how far surfaces have passed through each other, of half the thickness of the thinner yarn.
AuditCheck passedCheck(const RecordedCell& cell) {
  const CellCase& c = cell.definition();
  const SolidsCase solids = c.solids.value_or(SolidsCase{});
  const double thin_m = std::min(c.weft.shape.half_thickness_m, c.warp->shape.half_thickness_m);
  const double bound = solids.method == SolidContactMethod::augmented ? 100 * solids.deepest
                       : solids.method == SolidContactMethod::penalty ? 5
                                                                      : 1e-6;
  const Worst worst = worstOf(cell, [&](const PathCase&, const RecordedTable& rows) {
    const std::vector<double>& passed = rows.column("passed_m");
    return passed.empty() ? 0 : 100 * *std::max_element(passed.begin(), passed.end()) / thin_m;
  });
  return {"Penetration",
          worst.value,
          bound,
          "% of half a thickness",
          "how far a node of one yarn has passed the surface of another; the most",
          fmt::format("on the load {} yarns pass through each other by up to {} % of half a thickness: contact is too "
                      "soft",
                      worst.path, formatNumber(worst.value, 2))};
}

AuditCheck restCheck(const RecordedCell& cell) {
  return {"Stiffness at rest",
          cell.rest().why.empty() ? 0. : 1.,
          0,
          "",
          "whether the cell at rest has a stiffness",
          fmt::format("the stiffness at rest is not known: {}", cell.rest().why)};
}

}  // namespace

std::vector<AuditCheck> cellChecks(const RecordedCell& cell) {
  std::vector<AuditCheck> checks{finiteCheck(cell), reachedCheck(cell), residualCheck(cell),
                                 stableCheck(cell), workCheck(cell),    rubs(cell) ? lossCheck(cell) : loopCheck(cell)};
  const CellCase& c = cell.definition();
  if (!c.by_section) checks.push_back(besideCheck(cell));
  checks.push_back(restCheck(cell));
  if (c.yarns == YarnModel::solid && c.contact) checks.push_back(passedCheck(cell));
  return checks;
}

}  // namespace gambeson
