#include "core/cloth/shell/stress_field.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/plane_stress.hpp"
#include "core/math/carried_error.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

void add(StressField::Sample& sum, double w, const StressField::Sample& s) {
  addScaled(sum.stress, w, s.stress);
  addScaled(sum.strain, w, s.strain);
}

/// The tensor in the basis that is turned by - angle.
PlaneTensor turnedBack(const PlaneTensor& t, double angle) {
  if (angle == 0) return t;
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c * t.t11 + s * s * t.t22 - 2 * c * s * t.t12, s * s * t.t11 + c * c * t.t22 + 2 * c * s * t.t12,
          c * s * (t.t11 - t.t22) + (c * c - s * s) * t.t12};
}

/// The cells whose closure holds t, first and last.
std::array<int, 2> cellsAt(const std::vector<double>& ends, double t) {
  const int cells = static_cast<int>(ends.size()) - 1;
  const auto next = std::upper_bound(ends.begin(), ends.end(), t);
  const int k = std::clamp(static_cast<int>(next - ends.begin()) - 1, 0, cells - 1);
  return {t == ends[static_cast<std::size_t>(k)] && k > 0 ? k - 1 : k, k};
}

double middle(const std::vector<double>& ends, int k) {
  const auto i = static_cast<std::size_t>(k);
  return 0.5 * (ends[i] + ends[i + 1]);
}

/// How the shell integrates whole cells of a patch.
struct Rule {
  int gu = 0, gv = 0;
  bool assumed = false;
};
std::vector<Rule> rulesOf(const Shell& shell) {
  const std::vector<int> offsets = controlOffsets(shell.garment());
  std::vector<Rule> rules(shell.garment().patches.size());
  for (const ShellPart& part : shell.parts()) {
    const ShellBlock& b = part.block;
    if (b.scattered) continue;
    const long L = b.lanes, nn = b.nodeCount();
    for (long cell = 0; cell < part.cell_count; ++cell) {
      const int node = b.nodes[static_cast<std::size_t>((cell / L) * nn * L + cell % L)];
      const auto patch = std::upper_bound(offsets.begin(), offsets.end(), node) - offsets.begin() - 1;
      rules[static_cast<std::size_t>(patch)] = {b.gu, b.gv, b.assumed};
    }
  }
  return rules;
}

}  // namespace

StressField::StressField(const Shell& shell) : shell_(shell) {
  const Garment& g = shell.garment();
  const std::vector<Rule> rules = rulesOf(shell);
  for (const NurbsPatch& p : g.patches) {
    Grid grid{breakpoints(p.u), breakpoints(p.v), {}};
    grid.cell.assign((grid.u.size() - 1) * (grid.v.size() - 1), kOutside);
    grids_.push_back(std::move(grid));
  }
  for (const SheetCell& cell : sheetCells(g)) {
    const NurbsPatch& patch = g.patches[static_cast<std::size_t>(cell.patch)];
    Grid& grid = grids_[static_cast<std::size_t>(cell.patch)];
    const auto place = [](const std::vector<double>& ends, double t) {
      return static_cast<std::size_t>(std::lower_bound(ends.begin(), ends.end(), t) - ends.begin());
    };
    int& number = grid.cell[place(grid.u, cell.u0) + (grid.u.size() - 1) * place(grid.v, cell.v0)];
    if (cell.cut || patch.u.degree != 2 || patch.v.degree != 2) {
      number = kHere;
      continue;
    }
    number = static_cast<int>(cells_.size());
    const Rule& rule = rules[static_cast<std::size_t>(cell.patch)];
    Cell mean{cell.patch, {}};
    if (rule.assumed) {
      for (double v : {cell.v0, cell.v1})
        for (double u : {cell.u0, cell.u1}) mean.points.push_back({{u, v}, 0.25});
    } else {
      const double area = (cell.u1 - cell.u0) * (cell.v1 - cell.v0);
      for (const CellPoint& p : cellRule(cell, rule.gu, rule.gv)) mean.points.push_back({{p.u, p.v}, p.weight / area});
    }
    cells_.push_back(std::move(mean));
  }
}

StressField::Sample StressField::sampleAt(std::span<const Vec3> q, int patch, Vec2 uv, const More& more) const {
  const PointState state = shell_.stateAt(patch, uv, q);
  Vec2 extra{};
  if (more) extra = more(patch, uv);
  const PlaneTensor E{state.strain.x, state.strain.y, 0.5 * state.strain.z},
      T = cauchyStress(state.strain, {state.n.x + extra.x, state.n.y + extra.y, state.n.z});
  const double angle = fibreAngleAt(shell_.garment(), patch, uv);
  return {turnedBack(T, angle), turnedBack(E, angle)};
}

StressField::Sample StressField::meanOf(std::span<const Vec3> q, const Cell& cell, const More& more) const {
  Sample sum;
  for (const Point& p : cell.points) add(sum, p.weight, sampleAt(q, cell.patch, p.uv, more));
  return sum;
}

std::vector<StressField::Sample> StressField::means(const ClothState& state, const More& more) const {
  std::vector<Sample> all(cells_.size());
  const long count = static_cast<long>(all.size());
  CarriedError error;
  forAll(Each::much, count, [&](long k) {
    error.guard(k,
                [&] { all[static_cast<std::size_t>(k)] = meanOf(state.q, cells_[static_cast<std::size_t>(k)], more); });
  });
  error.rethrow();
  return all;
}

std::pair<StressField::Sample, int> StressField::shownAt(std::span<const Vec3> q, int patch, Vec2 uv,
                                                         std::span<const Sample> means, const More& more) const {
  const Grid& grid = grids_[static_cast<std::size_t>(patch)];
  const int nu = static_cast<int>(grid.u.size()) - 1, nv = static_cast<int>(grid.v.size()) - 1;
  const auto cellAt = [&](int i, int j) {
    return i < 0 || j < 0 || i >= nu || j >= nv ? kOutside : grid.cell[static_cast<std::size_t>(i + nu * j)];
  };
  const auto mean = [&](int cell) {
    const auto k = static_cast<std::size_t>(cell);
    return means.empty() ? meanOf(q, cells_[k], more) : means[k];
  };
  const auto us = cellsAt(grid.u, uv.x), vs = cellsAt(grid.v, uv.y);
  Sample sum;
  int cells = 0;
  bool here = false;
  for (int j = vs[0]; j <= vs[1]; ++j)
    for (int i = us[0]; i <= us[1]; ++i) {
      const int number = cellAt(i, j);
      here = here || number == kHere;
      if (number < 0) continue;
      ++cells;
      // The neighbour on this side of the middle, else the one on the other side.
      const double du = uv.x - middle(grid.u, i), dv = uv.y - middle(grid.v, j);
      int a = i + (du < 0 ? -1 : 1), b = j + (dv < 0 ? -1 : 1);
      if (cellAt(a, j) < 0) a = 2 * i - a;
      if (cellAt(i, b) < 0) b = 2 * j - b;
      const bool along_u = cellAt(a, j) >= 0, along_v = cellAt(i, b) >= 0;
      const double s = along_u ? du / (middle(grid.u, a) - middle(grid.u, i)) : 0,
                   t = along_v ? dv / (middle(grid.v, b) - middle(grid.v, j)) : 0;
      const double both = along_u && along_v && cellAt(a, b) >= 0 ? s * t : 0;
      add(sum, 1 - s - t + both, mean(number));
      if (along_u) add(sum, s - both, mean(cellAt(a, j)));
      if (along_v) add(sum, t - both, mean(cellAt(i, b)));
      if (both != 0) add(sum, both, mean(cellAt(a, b)));
    }
  if (here || cells == 0) {  // or no cell at all: beyond a trimming curve by rounding
    add(sum, 1, sampleAt(q, patch, uv, more));
    ++cells;
  }
  return {sum, cells};
}

PrincipalStress StressField::at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                                const More& more) const {
  const auto [sum, cells] = shownAt(state.q, patch, uv, means, more);
  const auto stress = principalValues(sum.stress), strain = principalValues(sum.strain);
  return {stress[0] / cells, stress[1] / cells, strain[0] / cells, strain[1] / cells};
}

PlaneTensor StressField::strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const {
  const auto [sum, cells] = shownAt(state.q, patch, uv, means, {});
  const PlaneTensor E = turnedBack(sum.strain, -fibreAngleAt(shell_.garment(), patch, uv));
  return {E.t11 / cells, E.t22 / cells, E.t12 / cells};
}

}  // namespace gambeson
