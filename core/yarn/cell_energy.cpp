#include "core/yarn/cell_energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/yarn/cell_response.hpp"
#include "core/yarn/cell_state.hpp"

namespace gambeson {
namespace {

/// Three strains and a mark that says that something is remembered.
constexpr std::size_t kOfLoad = 4, kOfSection = 12;

SheetAnswer noAnswer() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  SheetAnswer none;
  none.energy_J_per_m2 = kNone;
  none.resultant.fill(kNone);
  none.moment.fill(kNone);
  none.slope.fill(kNone);
  return none;
}

CellLoad loadOf(const SheetStrain& point) {
  constexpr double kRounding = 1e-13;
  const auto& [e11, e22, g12] = point.strain;
  if (std::max({std::abs(e11), std::abs(e22), std::abs(g12)}) < kRounding) return {};
  return {e11, e22, g12, 0, 0};
}

const RodCellDesign& checked(const RodCellDesign& design) {
  if (design.faces == FaceSupport::held)
    throw InputError({"", 0, "faces"}, "held, must be glide where the cloth bends");
  return design;
}

}  // namespace

CellEnergy::CellEnergy(const RodCellDesign& design, const EquilibriumOptions& options)
    : cell_(checked(design)), options_(options) {
  EquilibriumWork work(cell_);
  std::vector<Pose> sections(cell_.rest().begin(), cell_.rest().end());
  bending_ = bendingOf(cell_, {}, sections, work);
}

std::string CellEnergy::whyNone(const SheetStrain& point, std::span<const double> history) const {
  EquilibriumWork work(cell_);
  std::vector<Pose> sections;
  const CellLoad from = remembered(history, sections), to = loadOf(point);
  const std::string way = inWords(from) + " to " + inWords(to);
  try {
    const LoadReport report = changeLoad(cell_, from, to, sections, work, options_);
    if (!report.converged())
      return fmt::format("on the way from {} the cell finds no equilibrium beyond {}: {}", way, inWords(report.reached),
                         report.reason());
    if (!report.stable)
      return fmt::format("on the way from {} the cell's yarns leave their places at the least push", way);
    membraneTangent(cell_, to, sections, work);
  } catch (const std::runtime_error& e) {
    return fmt::format("on the way from {}: {}", way, e.what());
  }
  return {};
}

std::size_t CellEnergy::historySize() const {
  return kOfLoad + kOfSection * static_cast<std::size_t>(cell_.sections());
}

std::array<double, 36> CellEnergy::steepest(const StrainBox&) const {
  throw RunError("nothing bounds the stiffness of cells of yarns: they are of static cases");
}

CellLoad CellEnergy::remembered(std::span<const double> history, std::vector<Pose>& sections) const {
  sections.assign(cell_.rest().begin(), cell_.rest().end());
  if (history.empty() || history[0] == 0) return {};
  const double* at = history.data() + kOfLoad;
  for (Pose& s : sections) {
    for (Vec3* v : {&s.rotation.a, &s.rotation.b, &s.rotation.c, &s.origin}) {
      *v = {at[0], at[1], at[2]};
      at += 3;
    }
  }
  return {history[1], history[2], history[3], 0, 0};
}

void CellEnergy::remember(const CellLoad& load, std::span<const Pose> sections, std::span<double> history) const {
  history[0] = 1, history[1] = load.e11, history[2] = load.e22, history[3] = load.g12;
  double* at = history.data() + kOfLoad;
  for (const Pose& s : sections)
    for (const Vec3* v : {&s.rotation.a, &s.rotation.b, &s.rotation.c, &s.origin})
      for (int i = 0; i < 3; ++i) *at++ = (*v)[i];
}

SheetAnswer CellEnergy::answer(const SheetStrain& point, SheetParts parts, CellLoad& load, std::vector<Pose>& sections,
                               EquilibriumWork& work) const {
  const CellLoad to = loadOf(point);
  const LoadReport report = changeLoad(cell_, load, to, sections, work, options_);
  if (!report.converged() || !report.stable) return noAnswer();
  load = to;
  const CellResultants flat = resultantsOf(cell_, to, sections);
  SheetAnswer out;
  out.energy_J_per_m2 = flat.energy_J_per_m2;
  out.resultant = {flat.n11, flat.n22, flat.n12};
  constexpr std::size_t voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double D = bending_.rigidity_Nm[voigt[i][j]];
      out.moment[i] += D * point.curvature[j];
      out.slope[6 * (3 + i) + 3 + j] = D;
    }
    out.energy_J_per_m2 += point.curvature[i] * (bending_.moment_N[i] + 0.5 * out.moment[i]);
    out.moment[i] += bending_.moment_N[i];
  }
  if (parts == SheetParts::resultants) return out;
  const std::array<double, 9> A = membraneTangent(cell_, to, sections, work);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) out.slope[6 * i + j] = A[3 * i + j];
  return out;
}

void CellEnergy::evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                          std::span<double> remembered, std::span<SheetAnswer> out) const {
  EquilibriumWork work(cell_);
  std::vector<Pose> sections;
  const std::size_t each = historySize();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::span<const double> own = history.empty() ? history : history.subspan(i * each, each);
    CellLoad load = this->remembered(own, sections);
    try {
      out[i] = answer(points[i], parts, load, sections, work);
    } catch (const std::runtime_error&) {  // a strain of no plane, a cell that is not stable
      out[i] = noAnswer();
    }
    if (!remembered.empty()) remember(load, sections, remembered.subspan(i * each, each));
  }
}

}  // namespace gambeson
