#include "cases/fabric/bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/error.hpp"

namespace gambeson::laboratory {

StructureCase caseOf(const Fabric& fabric, const Specimen& s, double length_m) {
  StructureCase c;
  c.name = "specimen";
  const int across = s.cloth.kind == ClothKind::triangles ? 4 : 1;
  PlateShape plate;
  plate.width_m = length_m;
  plate.height_m = length_m * across / s.cells;
  c.sheet.shape = plate;
  c.sheet.cells_u = s.cells;
  c.sheet.cells_v = across;
  c.sheet.degree = s.degree;
  c.sheet.weft_angle_rad = -s.direction_rad;
  c.sheet.cloth = s.cloth;
  c.material.law = fabric;
  StructureSupport still;
  still.where = EdgeAt{-1, Side::u0};
  still.hold = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  c.supports.push_back(still);
  return c;
}

void tieAcross(const Cloth& cloth, const Vec3& direction, Constraints& out) {
  std::map<long, int> first;  // of each place along the length, in picometres
  for (int i = 0; i < cloth.points(); ++i) {
    const auto [it, is_new] = first.emplace(std::lround(1e12 * cloth.rest()[static_cast<std::size_t>(i)].x), i);
    if (is_new) continue;
    LinearConstraint l = supportEquation("the width", direction, {});
    l.terms = {{i, direction}, {it->second, -direction}};
    out.push_back(std::move(l));
  }
}

void keepFrom(const Cloth& cloth, const Vec3& direction, Constraints& out) {
  for (int i = 0; i < cloth.points(); ++i) {
    out.push_back(supportEquation("the plane", direction, {}));
    out.back().terms = {{i, direction}};
  }
}

void Bench::begin(std::shared_ptr<const Cloth> cloth, const StructureOptions& options) {
  structure_ = buildStructure(std::move(cloth), options);
  system_.emplace(*structure_, ends_);
  state_.emplace(*system_);
  for (const double a : structure_->area_m2) area_m2_ += a;
}

const std::vector<double>& Bench::settle(double t) {
  EquilibriumAt equations(*system_, t);
  StaticOptions options;
  options.tolerance = 1e-11;  // so that curvatures are known far better than the gauge asks
  NewtonOptions newton = newtonOptions(*system_, options, *state_);
  std::vector<double> y = state_->y;
  NewtonReport report = solveNewton(equations, newton, y, state_->K, state_->solver);
  if (!report.converged) {
    newton.line_search = true;
    newton.iterations = 100;
    y = state_->y;
    report = solveNewton(equations, newton, y, state_->K, state_->solver);
  }
  if (!report.converged)
    throw RunError(
        fmt::format("the specimen finds no equilibrium under a load of {:.4g} after one of {:.4g} (the "
                    "residual is {:.2e} of the forces); take more cells, or another model",
                    t, state_->factor, report.residual));
  state_->largest_force = std::max(state_->largest_force, report.force);
  state_->y = std::move(y);
  state_->factor = t;
  return state_->y;
}

}  // namespace gambeson::laboratory
