#include "cases/wear/scene/garments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <ostream>

#include "cases/cloth/noise.hpp"
#include "cases/input/overloaded.hpp"
#include "cases/input/places.hpp"
#include "core/cloth/shell/seams.hpp"
#include "core/cloth/shell/shell_law.hpp"
#include "core/cloth/shell/surface.hpp"
#include "core/cloth/triangles/obj_mesh.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "tryon/pattern/garment_file.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

constexpr double least_area_m2 = 1e-8;

/// How the case calls a shape.
const char* wordOf(const decltype(GarmentCase::shape)& shape) {
  static constexpr std::array words{"sheet", "disc", "tube", "shorts", "belt", "shirt", "skirt", "file", "mesh_file"};
  return words[shape.index()];
}

/// Cells that a shape is known to get before it is made; 0 for what is drafted on the body or read.
long cellsOf(const decltype(GarmentCase::shape)& shape) {
  return std::visit(Overloaded{[](const SheetGarment& s) { return long{s.cells_u} * s.cells_v; },
                               [](const DiscGarment& d) { return long{d.cells} * d.cells; },
                               [](const TubeGarment& t) { return long{t.cells_around} * t.cells_along; },
                               [](const SkirtGarment& s) { return long{s.cells_around} * s.cells_along; },
                               [](const auto&) { return long{0}; }},
                    shape);
}
long cellsOf(const Garment& g) {
  long cells = 0;
  for (const NurbsPatch& p : g.patches)
    cells += static_cast<long>((breakpoints(p.u).size() - 1) * (breakpoints(p.v).size() - 1));
  return cells;
}

/// Cells and contact samples of all garments: about 25 kB each cell of four samples.
struct ClothSize {
  long cells = 0, samples = 0;

  void add(long more, int samples_per_cell, const std::string& key) {
    cells += more;
    samples += more * std::max(1, samples_per_cell * samples_per_cell);
    if (cells > 40000 || samples > 160000)
      throw InputError({"", 0, key},
                       fmt::format("makes {} cells with {} contact samples of the garments so far; allowed: at "
                                   "most 40,000 cells and 160,000 samples together",
                                   cells, samples));
  }
};

/// What the garment keeps from others where it is thickest.
double layerOf(const Case& c, const GarmentCase& worn) {
  return c.contact.layer_m.value_or(largestThickness(fabricOf(c, worn), otherFabrics(worn), worn.fields));
}

/// `form` is null without a human.
Garment makeGarment(const Case& c, const GarmentCase& worn, const BodyForm* form, std::span<const Worn> under) {
  const double layer = layerOf(c, worn);
  Garment garment = std::visit(
      Overloaded{
          [&](const SheetGarment& s) {
            return makeSheet({s.width_m, s.height_m, s.cells_u, s.cells_v, s.degree, s.corner, s.axis_u, s.axis_v});
          },
          [&](const DiscGarment& d) {
            return makeDisc({d.radius_m, d.cells, d.degree, d.center, d.axis_u, d.axis_v});
          },
          [&](const TubeGarment& t) {
            return makeTube({t.radius_m, t.length_m, t.cells_around, t.cells_along, t.degree, t.patches, t.start,
                             t.axis, SeamKind::G1, 0});
          },
          [&](const ShortsGarment& s) {
            ShortsPattern pattern;
            pattern.inseam_m = s.inseam_m;
            pattern.rise_m = s.rise_m;
            pattern.crotch_below_pelvis_m = s.crotch_ease_m;
            pattern.ease = s.ease;
            pattern.waist_ease = s.waist_ease;
            pattern.cell_m = s.cell_m;
            pattern.degree = s.degree;
            pattern.seam_stiffness_N = worn.seam_stiffness_N;
            return makeShorts(pattern, *form);
          },
          [&](const BeltGarment& b) { return makeBelt(b, *form, fabricOf(c, worn), layer, under); },
          [&](ShirtGarment s) {
            s.seam_stiffness_N = worn.seam_stiffness_N;
            return makeShirt(s, *form, layer, under);
          },
          [&](const SkirtGarment& s) { return makeSkirt(s, *form, layer, under); },
          [&](const FileGarment& f) { return loadGarment(f.path); },
          [&](const MeshGarment& m) {
            Garment mesh;  // of no patches: its cloth reads the file
            mesh.name = "mesh";
            mesh.patch_names = readObj(m.path).patch_names;
            return mesh;
          },
      },
      worn.shape);
  for (std::size_t p = garment.patch_names.size(); p < garment.patches.size(); ++p)
    garment.patch_names.push_back("patch_" + std::to_string(p));
  garment.fabric = fabricOf(c, worn);
  garment.other_fabrics = otherFabrics(worn);
  applyFields(worn.fields, garment);
  for (NurbsPatch& patch : garment.patches)
    for (Vec3& point : patch.points) point += worn.position_m;
  for (auto& points : garment.placed)
    for (Vec3& point : points) point += worn.position_m;
  if (worn.weft_angle_rad != 0)
    for (std::size_t p = 0; p < garment.patches.size(); ++p) {
      const NurbsPatch& patch = garment.patches[p];
      const auto d =
          surfaceDerivatives(patch, 0.5 * (patch.u.front() + patch.u.back()), 0.5 * (patch.v.front() + patch.v.back()));
      garment.weft[p] = rotationAbout(normalized(cross(d[1], d[2])), worn.weft_angle_rad) * garment.weft[p];
    }
  return garment;
}

}  // namespace

std::vector<Garment> draftGarments(const Case& c, const Human* human) {
  std::optional<BodyForm> form;
  if (human) form.emplace(*human);
  std::vector<Garment> garments;
  garments.reserve(c.garments.size());  // those above point to those below
  std::vector<Worn> under;
  ClothSize size;
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    const GarmentCase& worn = c.garments[k];
    const std::string at = fmt::format("garments[{}]", k), shape = at + "." + wordOf(worn.shape);
    underKey(worn.fabric ? at + ".fabric" : "fabric", [&] { checkFabric(fabricOf(c, worn), "fabric"); });
    ClothSize(size).add(cellsOf(worn.shape), worn.samples_per_cell, shape);
    garments.push_back(underKey(shape, [&] { return makeGarment(c, worn, form ? &*form : nullptr, under); }));
    size.add(cellsOf(garments.back()), worn.samples_per_cell, shape);
    if (std::holds_alternative<MeshGarment>(worn.shape)) continue;
    double area = 0;
    for (const double a : underKey(shape, [&] { return controlAreas(garments.back()); })) area += a;
    if (!(area >= least_area_m2))
      throw InputError({"", 0, shape},
                       fmt::format("has an area of {:.3g} m^2; allowed: at least {:g} m^2", area, least_area_m2));
    under.push_back({&garments.back(), layerOf(c, worn)});
  }
  return garments;
}

std::vector<Vec3> startDisplacements(const Case& c, const std::vector<Garment>& garments) {
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < garments.size(); ++k) {
    const Garment& g = garments[k];
    std::vector<Vec3> own(static_cast<std::size_t>(controlOffsets(g).back()));
    if (c.garments[k].noise_m > 0)
      own = noiseOf(Sheet{g}, {c.garments[k].noise_m, c.garments[k].noise_seed, 0, 0, false});
    std::size_t at = 0;
    for (std::size_t p = 0; p < g.patches.size(); ++p)
      for (std::size_t i = 0; i < g.patches[p].points.size(); ++i, ++at)
        if (!g.placed.empty() && !g.placed[p].empty()) own[at] += g.placed[p][i] - g.patches[p].points[i];
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

}  // namespace gambeson
