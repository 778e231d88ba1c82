#include "cases/wear/scene/garments.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/cloth/noise.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/wear/scene/largest.hpp"
#include "core/cloth/block_law.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"
#include "human/files/units.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/flat/standing_body.hpp"
#include "tryon/pattern/turn.hpp"

namespace gambeson {
namespace {

constexpr double least_area_m2 = 1e-8;

long cellsOf(const Garment& g) {
  long cells = 0;
  for (const NurbsPatch& p : g.patches)
    cells += static_cast<long>((breakpoints(p.u).size() - 1) * (breakpoints(p.v).size() - 1));
  return cells;
}

/// Cells and contact samples of all garments: about 25 kB each cell of four samples, 7 GB where it ends.
struct ClothSize {
  long cells = 0, samples = 0;

  void add(long more, int samples_per_cell, const std::string& key) {
    cells += more;
    samples += more * std::max(1, samples_per_cell * samples_per_cell);
    if (cells > 1100000 || samples > 1100000)
      throw InputError({"", 0, key},
                       fmt::format("makes {} cells with {} contact samples of the garments so far; allowed: at "
                                   "most 1,100,000 cells and 1,100,000 samples together",
                                   cells, samples));
  }
};

/// What the garment keeps from others where it is thickest.
double layerOf(const Case& c, const GarmentCase& worn) {
  return c.contact.layer_m.value_or(largestThickness(fabricOf(c, worn), otherFabrics(worn), worn.fields) *
                                    largestFactor(worn.regions));
}

/// Of arms that are out of the way of panels: from the sides, as in an A-pose. A scan keeps its arms as it stood, where
/// they were as far aside: its skin is truest there.
constexpr double aside_rad = 50.0 * rad_per_deg, scan_aside_rad = 40.0 * rad_per_deg;

/// Who is dressed.
struct Wearer {
  const Human* human = nullptr;  ///< null without a surface
  std::optional<BodyForm> form;
};

GarmentMaking making(const Case& c, const GarmentCase& worn, const Wearer& w, std::span<const Worn> under,
                     GarmentFit* fit) {
  return {worn,
          fabricOf(c, worn),
          layerOf(c, worn),
          w.form ? &*w.form : nullptr,
          under,
          w.human,
          w.human ? puttingOnPosture(c, worn, *w.human) : Posture{},
          fit};
}

Garment makeGarment(const Case& c, const GarmentCase& worn, const Wearer& wearer, std::span<const Worn> under,
                    GarmentFit* fit = nullptr) {
  Garment garment = kindOf(worn).make(making(c, worn, wearer, under, fit));
  for (std::size_t p = garment.patch_names.size(); p < garment.patches.size(); ++p)
    garment.patch_names.push_back("patch_" + std::to_string(p));
  addFabric(c, worn, garment);
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

/// What messages call a wearer.
std::string wearerOf(const HumanCase& h) {
  if (!h.manikin.empty()) return h.manikin;
  if (h.measures) return "this manikin";
  if (h.character) return h.character->file.filename().string();
  return h.segments.empty() ? h.urdf.filename().string() : "the human between these markers";
}

/// Says where a cell of what was drafted is folded, and the largest cell of which none is.
void noteFolds(const Garment& garment, const Case& c, const GarmentCase& worn, const Wearer& wearer,
               std::span<const Worn> under, GarmentFit& fit) {
  if (!kindOf(worn).drafted) return;
  const auto turn = [](const Garment& g, std::size_t* at = nullptr) {
    double most = 0;
    for (std::size_t p = 0; p < g.patches.size(); ++p)
      if (const double own = largestTurn(g.patches[p]); own > most) {
        most = own;
        if (at) *at = p;
      }
    return most;
  };
  std::size_t at = 0;
  const double most = turn(garment, &at);
  if (!(most > kFoldedTurn_rad)) return;
  const std::string fine = largestOf(
      worn, "cell", [&](const GarmentCase& g) { return turn(makeGarment(c, g, wearer, under)) <= kFoldedTurn_rad; });
  fit.notes.push_back(
      fmt::format("{}a cell of \"{}\" turns by {:.0f} degrees and is folded: steps get short there, and it may cross "
                  "what is beside it; {}",
                  worn.name.empty() ? "" : worn.name + ": ", garment.patch_names[at], most / rad_per_deg,
                  fine.empty() ? "no smaller cell mends that" : "the largest \"cell\" without one is " + fine));
}

/// What cannot be drafted is said with what can.
Garment tryGarment(const Case& c, const GarmentCase& worn, const Wearer& wearer, std::span<const Worn> under,
                   GarmentFit* fit) {
  try {
    Garment garment = makeGarment(c, worn, wearer, under, fit);
    if (fit) noteFolds(garment, c, worn, wearer, under, *fit);
    return garment;
  } catch (const InputError& e) {
    if (!wearer.form || !c.human || !kindOf(worn).drafted || !e.where().file.empty()) throw;
    sayLargest(e, worn, wearerOf(*c.human), [&](const GarmentCase& g) { makeGarment(c, g, wearer, under); });
  }
}

}  // namespace

void addFabric(const Case& c, const GarmentCase& worn, Garment& garment) {
  garment.fabric = fabricOf(c, worn);
  garment.other_fabrics = otherFabrics(worn);
  applyFields(worn.fields, garment);
  applyRegions(worn.regions, garment);
}

std::vector<std::optional<MeshDraft>> readMeshes(const Case& c, const std::vector<Garment>& drafts) {
  std::vector<std::optional<MeshDraft>> meshes(drafts.size());
  for (std::size_t k = 0; k < drafts.size(); ++k) {
    const GarmentCase& worn = c.garments[k];
    if (kindOf(worn).isMesh())
      meshes[k] =
          underKey(fmt::format("garments[{}]", k), [&] { return kindOf(worn).triangles(worn, drafts[k].fabric); });
  }
  return meshes;
}

bool armsAside(const Case& c) {
  if (!c.human || !(c.dressing.settle_s > 0 || !c.dressing.from.empty())) return false;
  bool aside = false;
  for (const GarmentCase& g : c.garments) {
    const ArmsWanted wanted = kindOf(g).arms(g);
    if (wanted == ArmsWanted::hanging) return false;
    aside = aside || wanted == ArmsWanted::aside;
  }
  return aside;
}

Posture dressingPosture(const Case& c, const Human& human) {
  const Posture posture = standing(human);
  return armsAside(c) ? withArmsAside(human, posture, c.human->scan ? scan_aside_rad : aside_rad) : posture;
}

Posture puttingOnPosture(const Case& c, const GarmentCase& worn, const Human& human) {
  return kindOf(worn).as_scanned(worn) ? postureOfSkin(human) : dressingPosture(c, human);
}

std::vector<Garment> draftGarments(const Case& c, const Human* human, std::vector<GarmentFit>* fits) {
  Wearer wearer;
  if (human) wearer.form.emplace(*human);
  if (human && !human->shapes.empty()) wearer.human = human;
  std::vector<Garment> garments;
  garments.reserve(c.garments.size());  // those above point to those below
  std::vector<Worn> under;
  if (fits) fits->assign(c.garments.size(), {});
  ClothSize size;
  for (std::size_t k = 0; k < c.garments.size(); ++k) {
    const GarmentCase& worn = c.garments[k];
    const std::string at = fmt::format("garments[{}]", k), shape = at + "." + kindOf(worn).word;
    underKey(worn.fabric ? at + ".fabric" : "fabric", [&] { checkFabric(fabricOf(c, worn), "fabric"); });
    ClothSize(size).add(kindOf(worn).cells(worn), worn.samples_per_cell, shape);
    garments.push_back(
        underKey(shape, [&] { return tryGarment(c, worn, wearer, under, fits ? &(*fits)[k] : nullptr); }));
    size.add(cellsOf(garments.back()), worn.samples_per_cell, shape);
    if (kindOf(worn).isMesh()) continue;
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
