#include "cases/cell/paths.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cases/input/overloaded.hpp"

namespace gambeson {
namespace {

double degrees(double rad) { return rad * 180 / std::numbers::pi; }

std::string after(double extension) {
  return extension == 0 ? "" : fmt::format(", after {:.3g} % of extension", 100 * extension);
}

}  // namespace

CellTarget targetOf(const PathLoads& load, double t) {
  return std::visit(Overloaded{
                        [&](const BiaxialPath& p) {
                          return CellTarget{loadOf({1 + t * p.extension, 0, 0, 1 + t * p.ratio * p.extension}), {}};
                        },
                        [&](const UniaxialPath& p) {
                          const double stretch = 1 + t * p.extension;
                          const bool weft = p.along == along_weft;
                          CellTarget to{weft ? loadOf({stretch, 0, 0, 1}) : loadOf({1, 0, 0, stretch}), {}};
                          if (p.free_sides) to.free = weft ? along_warp : along_weft;
                          return to;
                        },
                        [&](const CompressionPath& p) {
                          const double stretch = 1 - t * p.shortening;
                          return CellTarget{loadOf({stretch, 0, 0, stretch}), {}};
                        },
                        [&](const ShearPath& p) {
                          return CellTarget{shearAsPrinted(t * p.shear, 1 + p.extension), {}};
                        },
                        [&](const TrellisPath& p) {
                          return CellTarget{trellis(t * p.angle_rad, 1 + p.extension), {}};
                        },
                        [&](const BendingPath& p) {
                          CellLoad to;
                          to.curvature_per_m = t * p.curvature_per_m;
                          to.direction_rad = p.direction_rad;
                          return CellTarget{to, {}};
                        },
                    },
                    load);
}

std::vector<double> partsOf(const PathCase& path) {
  std::vector<double> parts;
  const auto at = [&](int k) { return static_cast<double>(k) / path.steps; };
  for (int k = 0; k <= path.steps; ++k) parts.push_back(at(k));
  for (int c = 0; c < path.cycles; ++c) {
    for (int k = path.steps - 1; k >= 0; --k) parts.push_back(at(k));
    if (c + 1 < path.cycles)
      for (int k = 1; k <= path.steps; ++k) parts.push_back(at(k));
  }
  return parts;
}

PathAbscissa abscissaOf(const PathLoads& load) {
  if (std::holds_alternative<BendingPath>(load)) return {"curvature_per_m", "curvature [1/m]"};
  if (std::holds_alternative<ShearPath>(load) || std::holds_alternative<TrellisPath>(load))
    return {"e12", "shear strain E12"};
  const auto* uniaxial = std::get_if<UniaxialPath>(&load);
  if (uniaxial && uniaxial->along == along_warp) return {"e22", "strain E22"};
  return {"e11", "strain E11"};
}

std::string inWords(const PathLoads& load) {
  return std::visit(
      Overloaded{
          [](const BiaxialPath& p) {
            return p.ratio == 1 ? fmt::format("stretched along both directions by {:.3g} %", 100 * p.extension)
                                : fmt::format("stretched along the weft by {:.3g} % and along the warp by {:.3g} %",
                                              100 * p.extension, 100 * p.ratio * p.extension);
          },
          [](const UniaxialPath& p) {
            const bool weft = p.along == along_weft;
            return fmt::format("stretched along the {} by {:.3g} %, {}", weft ? "weft" : "warp", 100 * p.extension,
                               p.free_sides ? "its sides free" : "its sides held");
          },
          [](const CompressionPath& p) {
            return fmt::format("shortened along both directions by {:.3g} %", 100 * p.shortening);
          },
          [](const ShearPath& p) {
            return fmt::format("sheared by Phi12 = Phi21 = {:.3g}{}", p.shear, after(p.extension));
          },
          [](const TrellisPath& p) {
            return fmt::format("sheared as a trellis by {:.3g} degrees{}", degrees(p.angle_rad), after(p.extension));
          },
          [](const BendingPath& p) {
            return fmt::format("bent to {:.3g} 1/m, arcs at {:.3g} degrees from the weft", p.curvature_per_m,
                               degrees(p.direction_rad));
          },
      },
      load);
}

}  // namespace gambeson
