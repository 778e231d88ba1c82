#include "core/yarn/cell_bending.hpp"

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/statics/newton.hpp"
#include "core/yarn/cell_response.hpp"

namespace gambeson {
namespace {

/// Takes the force that shifts a yarn as a whole up or down out of a force on the unknowns.
void holdHeights(const RodCell& cell, std::vector<double>& force) {
  const SparseRows& C = cell.freedoms();
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < cell.yarns().count(d); ++k) {
      const auto forHeights = [&](const auto& visit) {
        const int first = cell.firstSection(d, k);
        for (int i = first; i < first + cell.sectionsOf(d); ++i)
          for (int row = 6 * i + 2, e = C.offsets[row]; e < C.offsets[row + 1]; ++e) visit(C.columns[e]);
      };
      double sum = 0;
      int count = 0;
      forHeights([&](int column) { sum += force[column], ++count; });
      forHeights([&](int column) { force[column] -= sum / count; });
    }
}

/// d²W/dk² by area, of an arc in one direction; `work` is settled there.
double rigidityAlong(const RodCell& cell, const CellLoad& flat, double direction, std::span<const Pose> sections,
                     const EquilibriumWork& work) {
  const double h = 1e-4 / std::max(cell.yarns().period_m(along_weft), cell.yarns().period_m(along_warp));
  std::array<CellAnswer, 2> answer;
  for (const int side : {0, 1}) {
    CellLoad bent = flat;
    bent.curvature_per_m = side == 0 ? -h : h, bent.direction_rad = direction;
    cell.evaluate(facesOf(cell.yarns(), bent), carried(sections, flat, bent), answer[side]);
  }
  const double second = (answer[0].energy_J - 2 * work.answer.energy_J + answer[1].energy_J) / (h * h);
  std::vector<double> g = work.residual(answer[1]);
  const std::vector<double> before = work.residual(answer[0]);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] = (g[i] - before[i]) / (2 * h);
  holdHeights(cell, g);
  return (second - dot(g, work.follow(g))) / cell.area_m2();
}

}  // namespace

CellBending bendingOf(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections,
                      EquilibriumWork& work) {
  if (load.curvature_per_m != 0) throw RunError("how a cell begins to bend is asked of a flat one");
  if (cell.design().extent == CellExtent::quarter)
    throw InputError({"", 0, "extent"}, "quarter, must be full where the cloth bends");
  const CellFaces faces = facesOf(cell.yarns(), load);
  if (work.history) throw RunError("the rigidity of a cell is of yarns without friction");
  cell.evaluate(faces, sections, work.answer);
  if (!work.settle(faces, sections, work.answer)) throw RunError("the cell of yarns is not stable");

  constexpr double kHalf = 0.5 * std::numbers::pi, kBias = 0.5 * kHalf, kBetween = 0.5 * kBias;
  const auto toward = [&](double direction) {
    CellLoad l = load;
    l.direction_rad = direction;
    return l;
  };
  const auto moment = [&](double direction) { return resultantsOf(cell, toward(direction), sections).moment_N; };
  const auto rigidity = [&](double direction) { return rigidityAlong(cell, load, direction, sections, work); };

  CellBending out;
  auto& [b1, b2, b3] = out.moment_N;
  b1 = moment(0), b2 = moment(kHalf), b3 = moment(kBias) - 0.5 * (b1 + b2);

  auto& [D11, D22, D33, D12, D13, D23] = out.rigidity_Nm;
  D11 = rigidity(0), D22 = rigidity(kHalf);
  const double plus = rigidity(kBias), minus = rigidity(-kBias), both = 0.5 * (plus - minus);  // D13 + D23
  const double middle = 2 * (plus + minus) - D11 - D22;
  const double c = std::cos(kBetween), s = std::sin(kBetween), cs = c * s;
  const double odd = (rigidity(kBetween) - D11 * c * c * c * c - D22 * s * s * s * s - middle * cs * cs) / (4 * cs);
  D12 = 0, D33 = 0.25 * middle;
  D13 = (odd - both * s * s) / (c * c - s * s), D23 = both - D13;
  return out;
}

}  // namespace gambeson
