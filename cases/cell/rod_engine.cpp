#include "cases/cell/rod_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "core/yarn/cell_bending.hpp"

namespace gambeson {
namespace {

/// A tube for each yarn, one section more than it has pieces: its two ends are images of one section.
std::vector<YarnTube> tubesOf(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections) {
  const CellFaces faces = facesOf(cell.yarns(), load);
  std::vector<YarnTube> tubes;
  for (const int d : {along_weft, along_warp}) {
    const WovenYarn& yarn = cell.yarns().yarn[d];
    const double area_m2 = std::numbers::pi * yarn.half_width_m * yarn.half_thickness_m;
    for (int k = 0; k < cell.yarns().count(d); ++k) {
      const int n = cell.sectionsOf(d), first = cell.firstSection(d, k);
      YarnTube tube{d, {}, {}, yarn.half_width_m, yarn.half_thickness_m};
      std::vector<double> tension;
      for (int i = 0; i < n; ++i) tension.push_back(cell.pieceAt(faces, sections, d, k, i).tension_N);
      for (int i = 0; i <= n; ++i) {
        tube.sections.push_back(i < n ? sections[first + i] : faces.step[d] * sections[first]);
        tube.stress_Pa.push_back(0.5 * (tension[i % n] + tension[(i + n - 1) % n]) / area_m2);
      }
      tubes.push_back(std::move(tube));
    }
  }
  return tubes;
}

class RodSpecimen : public CellSpecimen {
 public:
  RodSpecimen(const RodCell& cell, const EquilibriumOptions& options)
      : cell_(cell), options_(options), work_(cell), sections_(cell.rest().begin(), cell.rest().end()) {
    if (cell.design().friction.coefficient > 0) work_.history = &history_;
  }

  CellStep bring(const CellTarget& to) override {
    CellLoad next = to.load;
    // The strain that is free goes on from where it is.
    if (to.free) (*to.free == along_warp ? next.e22 : next.e11) = *to.free == along_warp ? load_.e22 : load_.e11;
    LoadReport report = changeLoad(cell_, load_, next, sections_, work_, options_);
    load_ = report.reached;
    CellStep step;
    step.reached = report.converged();
    step.why = report.reason();
    if (step.reached && to.free) {
      try {
        const YarnDirection pulled = *to.free == along_warp ? along_weft : along_warp;
        const LoadReport freed = freeAcross(cell_, load_, sections_, work_, kFree, options_, pulled);
        step.reached = freed.converged();
        step.why = freed.reason();
        report.iterations += freed.iterations;
        if (freed.iterations > 0) report.residual = freed.residual, report.stable = freed.stable;
      } catch (const RunError& e) {
        step.reached = false;
        step.why = e.what();
      }
    }
    step.point.load = load_;
    step.point.resultants = resultantsOf(cell_, load_, sections_, work_.history);
    step.point.stable = report.stable;
    step.point.iterations = report.iterations;
    step.point.residual = report.residual;
    step.point.rounded = report.converged() && report.residual > options_.tolerance;
    const CellFaces faces = facesOf(cell_.yarns(), load_);
    if (work_.history && step.reached) {
      accept(cell_, faces, sections_, history_);
      step.point.resultants.energy_J_per_m2 =
          resultantsOf(cell_, load_, sections_).energy_J_per_m2 + history_.stored_J / cell_.area_m2();
      step.point.lost_J_per_m2 = history_.lost_J / cell_.area_m2();
    }
    for (const int d : {along_weft, along_warp}) {
      double& most = step.point.tension_N[d];
      most = cell_.pieceAt(faces, sections_, d, 0, 0).tension_N;
      for (int k = 0; k < cell_.yarns().count(d); ++k)
        for (int i = 0; i < cell_.sectionsOf(d); ++i)
          most = std::max(most, cell_.pieceAt(faces, sections_, d, k, i).tension_N);
    }
    return step;
  }

  YarnShape shape() const override { return shapeOf(tubesOf(cell_, load_, sections_)); }

  std::optional<std::array<double, 9>> membraneTangent() override {
    return gambeson::membraneTangent(cell_, load_, sections_, work_);
  }

  std::optional<std::array<double, 3>> bendingStiffness() override {
    const RodCellDesign& design = cell_.design();
    if (design.faces == FaceSupport::held || design.extent == CellExtent::quarter) return {};
    EquilibriumWork smooth(cell_);  // at rest nothing presses
    const std::array<double, 6> D = bendingOf(cell_, load_, sections_, smooth).rigidity_Nm;
    return std::array<double, 3>{D[0], D[1], D[3] + 2 * D[2]};
  }

 private:
  static constexpr double kFree = 1e-6;  ///< what a free direction may carry, of what the other does

  const RodCell& cell_;
  EquilibriumOptions options_;
  EquilibriumWork work_;
  CellHistory history_;  ///< of friction
  std::vector<Pose> sections_;
  CellLoad load_;
};

}  // namespace

RodEngine::RodEngine(const RodCellDesign& design, const EquilibriumOptions& options)
    : cell_(design), options_(options), surface_(surfaceOf(tubesOf(cell_, {}, cell_.rest()))) {}

std::unique_ptr<CellSpecimen> RodEngine::specimen() const { return std::make_unique<RodSpecimen>(cell_, options_); }

std::vector<std::string> RodEngine::assumptions() const {
  std::vector<std::string> all{
      "Yarns are rods: they stretch, shear, bend and twist, at any rotation, and keep the shape of their sections.",
      "At rest they lie in half sine waves and are without force."};
  const RodCellDesign& design = cell_.design();
  const double mu = design.friction.coefficient;
  all.push_back(
      !design.contact
          ? "Yarns pass through each other."
          : fmt::format("Yarns that cross press on each other {}, by the law of lateral compression; yarns side by "
                        "side do not, so that what their width locks is not seen.",
                        mu > 0 ? fmt::format("and rub with Coulomb's coefficient {:g}", mu) : "without friction"));
  if (design.extent == CellExtent::quarter)
    all.push_back(
        "A quarter of the repeat moves by itself; the others are its images, mirrored in the middle of the cloth.");
  all.push_back(design.faces == FaceSupport::glide
                    ? "Sections in the faces of the cell may move through the cloth."
                    : "Sections in the faces of the cell do not move through the cloth.");
  return all;
}

}  // namespace gambeson
