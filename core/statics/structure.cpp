#include "core/statics/structure.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/shell/cells.hpp"
#include "core/cloth/shell/fields.hpp"
#include "core/error.hpp"

namespace gambeson {

double Program::operator()(double t) const {
  if (t <= at.front()) return value.front();
  if (t >= at.back()) return value.back();
  const std::size_t k = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), t) - at.begin());
  return value[k - 1] + (value[k] - value[k - 1]) * (t - at[k - 1]) / (at[k] - at[k - 1]);
}

double Program::extended(double t) const {
  const double low = std::min(0.0, at.front()), high = std::max(1.0, at.back());
  const auto slope = [&](double from, double to) { return ((*this)(to) - (*this)(from)) / (to - from); };
  // Inside the first or last piece, whose end lies at `low` or `high`, or the flat beyond it.
  double inner_low = high, inner_high = low;
  for (double a : at) {
    if (a > low) inner_low = std::min(inner_low, a);
    if (a < high) inner_high = std::max(inner_high, a);
  }
  if (t < low) return (*this)(low) + slope(low, inner_low) * (t - low);
  if (t > high) return (*this)(high) + slope(inner_high, high) * (t - high);
  return (*this)(t);
}

namespace {

void checkPrograms(const std::vector<Program>& programs) {
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const Program& p = programs[k];
    const auto reject = [&](const char* why) { throw InputError({"", 0, "programs[" + std::to_string(k) + "]"}, why); };
    if (p.at.empty() || p.at.size() != p.value.size()) reject("needs as many values as points, at least one");
    for (std::size_t i = 0; i < p.at.size(); ++i) {
      if (!std::isfinite(p.at[i]) || !std::isfinite(p.value[i])) reject("is not finite");
      if (i > 0 && !(p.at[i] > p.at[i - 1])) reject("points must ascend");
    }
  }
}

/// The rest mass of the control points: ∫ rho N N dA, and ∫ N dA.
struct MassIntegral {
  SparseRows mass;
  std::vector<double> area;
};

MassIntegral integrateMass(const Garment& g) {
  const std::vector<int> offsets = controlOffsets(g);
  std::vector<std::vector<std::pair<int, double>>> rows(offsets.back());
  MassIntegral m;
  m.area.assign(offsets.back(), 0.0);
  std::vector<double> local;
  for (const SheetCell& cell : sheetCells(g)) {
    const NurbsPatch& patch = g.patches[cell.patch];
    std::vector<int> columns;
    for (const CellPoint& point : cellRule(cell, patch.u.degree + 1, patch.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
      const std::size_t n = basis.columns.size();
      if (columns.empty()) columns = basis.columns, local.assign(n * n, 0.0);
      Vec3 A1{}, A2{};
      for (std::size_t k = 0; k < n; ++k) {
        A1 += basis.values[1][k] * patch.points[basis.columns[k]];
        A2 += basis.values[2][k] * patch.points[basis.columns[k]];
      }
      const double dA = norm(cross(A1, A2)) * point.weight;
      const double dm = surfaceDensityAt(g, cell.patch, {point.u, point.v}) * dA;
      for (std::size_t i = 0; i < n; ++i) {
        m.area[offsets[cell.patch] + columns[i]] += basis.values[0][i] * dA;
        for (std::size_t j = 0; j < n; ++j) local[i * n + j] += basis.values[0][i] * basis.values[0][j] * dm;
      }
    }
    const std::size_t n = columns.size();
    for (std::size_t i = 0; i < n; ++i) {
      auto& row = rows[offsets[cell.patch] + columns[i]];
      for (std::size_t j = 0; j < n; ++j) {
        const int column = offsets[cell.patch] + columns[j];
        const auto at =
            std::lower_bound(row.begin(), row.end(), column, [](const auto& entry, int c) { return entry.first < c; });
        if (at != row.end() && at->first == column)
          at->second += local[i * n + j];
        else
          row.insert(at, {column, local[i * n + j]});
      }
    }
  }
  m.mass.column_count = offsets.back();
  for (const auto& row : rows) {
    for (const auto& [column, value] : row) m.mass.add(column, value);
    m.mass.endRow();
  }
  return m;
}

}  // namespace

std::unique_ptr<Structure> buildStructure(const Garment& garment, const StructureOptions& o) {
  std::vector<Program> programs = o.programs;
  if (programs.empty()) programs.push_back({{0, 1}, {0, 1}});
  checkPrograms(programs);
  const int count = static_cast<int>(programs.size());
  const auto check = [&](const auto& loads, const char* key) {
    for (const auto& load : loads)
      if (load.program < 0 || load.program >= count)
        throw InputError({"", 0, key}, "program " + std::to_string(load.program) + " does not exist");
  };
  check(o.dead, "loads.dead");
  check(o.pressure, "loads.pressure");
  check(o.moments, "loads.moments");
  if (!(o.rayleigh_mass_per_s >= 0)) throw InputError({"", 0, "rayleigh_mass_per_s"}, "must be >= 0");
  if (!(o.rayleigh_stiffness_s >= 0)) throw InputError({"", 0, "rayleigh_stiffness_s"}, "must be >= 0");
  if (!(o.drag_kg_per_m2s >= 0)) throw InputError({"", 0, "drag_kg_per_m2s"}, "must be >= 0");

  Shell shell(garment, o.kernels ? *o.kernels : widestKernels(), o.gauss_extra, o.cell_rule);
  FreeMap map = buildFreeMap(garment);
  DofMap dofs = buildDofMap(map, o.constraints, count);
  Loads loads(garment, o.dead, o.pressure, o.moments);
  Tangent tangent(shell, map);
  Reduction reduction(tangent.pattern(), dofs.C);
  std::vector<Vec3> rest;
  for (const NurbsPatch& p : garment.patches) rest.insert(rest.end(), p.points.begin(), p.points.end());

  const MassIntegral integral = integrateMass(garment);
  SparseRows consistent = multiply(multiply(map.Tt, integral.mass), map.T);
  std::vector<double> lumped(map.home.size()), area(map.home.size());
  const std::vector<double> ones(map.home.size(), 1.0);
  consistent.multiply<double>(ones, lumped);
  map.Tt.multiply<double>(integral.area, area);
  std::optional<StructureLimit> limit;
  if (o.strain_limit.mode != LimitMode::none) limit = buildStructureLimit(garment, map, dofs, lumped, o.strain_limit);
  return std::make_unique<Structure>(Structure{
      std::move(shell), std::move(map), std::move(dofs), std::move(loads), std::move(programs), std::move(tangent),
      std::move(reduction), std::move(rest), o.dead, std::move(lumped), std::move(consistent), o.rayleigh_mass_per_s,
      o.rayleigh_stiffness_s, o.drag_kg_per_m2s, std::move(area), std::move(limit)});
}

}  // namespace gambeson
