#include "cases/cell/solid_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/yarn/solid_response.hpp"
#include "core/yarn/solid_stress.hpp"

namespace gambeson {
namespace {

class SolidSpecimen : public CellSpecimen {
 public:
  SolidSpecimen(const SolidCell& cell, const SolidLoadOptions& options, double height_m, const SolidSkin& skin)
      : cell_(cell), options_(options), height_m_(height_m), skin_(skin), work_(cell), state_(restOf(cell)) {}

  CellStep bring(const CellTarget& to) override {
    CellLoad next = to.load;
    // The strain that is free goes on from where it is.
    if (to.free)
      (*to.free == along_warp ? next.e22 : next.e11) = *to.free == along_warp ? state_.load.e22 : state_.load.e11;
    const SolidCellState before = state_;
    SolidLoadReport report;
    report.reached = true;
    if (next != state_.load) report = changeLoad(cell_, next, state_, work_, optionsFor(next));
    if (report.reached && to.free) {
      try {
        const YarnDirection pulled = *to.free == along_warp ? along_weft : along_warp;
        const bool rubs = cell_.design().friction > 0;
        report.add(freeAcross(cell_, state_, work_, kFree, optionsFor(next), pulled, rubs ? &before : nullptr));
      } catch (const RunError& e) {
        report.reached = false;
        report.why = e.what();
      }
    }
    return {report.reached, report.why, pointOf(report)};
  }

  YarnShape shape() const override { return skin_.shape(cell_, state_); }

  std::optional<std::array<double, 9>> membraneTangent() override {
    return gambeson::membraneTangent(cell_, state_, work_, options_.method);
  }

  std::optional<std::array<double, 3>> bendingStiffness() override { return {}; }

 private:
  static constexpr double kFree = 1e-6;       ///< what a free direction may carry, of what the other does
  static constexpr double kLongest = 0.0101;  ///< a step's change of a strain

  SolidLoadOptions optionsFor(const CellLoad& to) const {
    const CellLoad& from = state_.load;
    const double change =
        std::max({std::abs(to.e11 - from.e11), std::abs(to.e22 - from.e22), 0.5 * std::abs(to.g12 - from.g12)});
    SolidLoadOptions options = options_;
    options.steps = std::max(1, static_cast<int>(std::ceil(change / kLongest)));
    return options;
  }

  BalancedCell pointOf(const SolidLoadReport& report) const {
    BalancedCell point;
    point.load = state_.load;
    point.resultants = resultantsOf(cell_, state_);
    // Springs of friction are there with penalties alone.
    if (options_.method == SolidContactMethod::penalty)
      point.resultants.energy_J_per_m2 += cell_.contact().held(state_.points) / cell_.area_m2();
    point.lost_J_per_m2 = state_.lost_J / cell_.area_m2();
    point.tension_N = largestTension(cell_, state_.x);
    point.stable = report.stable;
    point.iterations = report.iterations;
    point.residual = report.residual;
    point.rounded = report.rounded;
    point.mean_stress_Pa = meanStress(cell_, state_.x);
    for (double& s : point.mean_stress_Pa) s *= cell_.height_m() / height_m_;
    point.passed_m = report.deepest_m;
    return point;
  }

  const SolidCell& cell_;
  SolidLoadOptions options_;
  double height_m_;
  const SolidSkin& skin_;
  SolidCellWork work_;
  SolidCellState state_;
};

}  // namespace

SolidSkin::SolidSkin(const SolidCell& cell) {
  const int images = cell.design().quarter ? 2 : 1;
  for (int weft = 0; weft < images; ++weft)
    for (int warp = 0; warp < images; ++warp) addImage(cell, weft, warp);
}

void SolidSkin::addImage(const SolidCell& cell, int weft, int warp) {
  const bool mirrored = (weft + warp) % 2 != 0;
  const int last = cell.design().quarter ? 1 : 0, n = cell.design().meshing.across;
  const SolidYarns& yarns = cell.solids();
  for (const YarnBody& b : yarns.bodies) {
    // Ends have vertices of their own, so that pictures have edges there.
    const auto addFacets = [&](const std::vector<Facet>& facets) {
      std::vector<int> vertex_of(yarns.mesh.nodes.size(), -1);
      const auto vertex = [&](int node) {
        if (vertex_of[node] < 0) {
          vertex_of[node] = static_cast<int>(vertices_.size());
          vertices_.push_back({node, weft, warp});
          surface_.direction.push_back(static_cast<char>(b.direction));
        }
        return vertex_of[node];
      };
      for (const Facet& f : facets)
        for (const std::array<int, 3>& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
          std::array<int, 3> triangle{vertex(f[t[0]]), vertex(f[t[1]]), vertex(f[t[2]])};
          if (mirrored) std::swap(triangle[1], triangle[2]);
          surface_.triangles.push_back(triangle);
        }
    };
    const auto endOf = [&](int section, bool ahead) {
      std::vector<Facet> facets;
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const auto at = [&](int di, int dj) { return yarns.node(b, section, i + di, j + dj); };
          facets.push_back(ahead ? Facet{at(0, 0), at(1, 0), at(1, 1), at(0, 1)}
                                 : Facet{at(0, 0), at(0, 1), at(1, 1), at(1, 0)});
        }
      return facets;
    };
    addFacets(yarns.skin(b));
    const int place = b.direction == along_weft ? weft : warp;
    if (place == 0) addFacets(endOf(0, false));
    if (place == last) addFacets(endOf(b.sections - 1, true));
  }
}

YarnShape SolidSkin::shape(const SolidCell& cell, const SolidCellState& state) const {
  const CellFaces faces = facesOf(cell.yarns(), state.load);
  const std::vector<double> stress = fibreStress(cell, state.x), pressure = nodePressure(cell, state);
  YarnShape out;
  for (const Vertex& v : vertices_) {
    Vec3 x = state.x[v.node];
    if ((v.weft + v.warp) % 2 != 0) x.z = -x.z;
    x += 0.5 * (v.weft * faces.step[along_weft].origin + v.warp * faces.step[along_warp].origin);
    out.vertices.push_back(x);
    out.stress_Pa.push_back(stress[v.node]);
    out.pressure_Pa.push_back(pressure[v.node]);
  }
  return out;
}

SolidEngine::SolidEngine(const SolidCellDesign& design, const SolidLoadOptions& options, double height_m)
    : cell_(design), options_(options), height_m_(height_m), skin_(cell_) {}

std::unique_ptr<CellSpecimen> SolidEngine::specimen() const {
  return std::make_unique<SolidSpecimen>(cell_, options_, height_m_, skin_);
}

std::vector<std::string> SolidEngine::assumptions() const {
  const SolidCellDesign& design = cell_.design();
  std::vector<std::string> all{
      fmt::format("Yarns are solids, {0} x {0} hexahedra of a section and {1} from crossing to crossing, with fibres "
                  "along the yarn (the law of Bonet and Burton, Man 2006, 4.66 to 4.74).",
                  design.meshing.across, design.meshing.along),
      "At rest they lie in half sine waves and are without force; widths of their sections are such that they have the "
      "volume of elliptical ones."};
  if (!design.contact) {
    all.emplace_back("Yarns pass through each other.");
  } else {
    all.push_back(fmt::format(
        "The surfaces of yarns that cross do not pass through each other ({}), {}; yarns side by side do not touch.",
        options_.method == SolidContactMethod::augmented     ? "augmented Lagrangian"
        : options_.method == SolidContactMethod::multipliers ? "Lagrange multipliers"
                                                             : "penalties, which let some pass",
        design.friction > 0 ? fmt::format("and rub with Coulomb's coefficient {:g}", design.friction)
                            : "without friction"));
  }
  if (design.quarter)
    all.emplace_back(
        "A quarter of the repeat moves by itself; the others are its images, mirrored in the middle of the cloth.");
  all.emplace_back(design.faces == FaceSupport::glide ? "Sections in the faces of the cell may move through the cloth."
                                                      : "Points in the faces of the cell keep their height.");
  all.emplace_back("The cloth stays flat.");
  return all;
}

}  // namespace gambeson
