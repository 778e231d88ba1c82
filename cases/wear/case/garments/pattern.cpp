/// Detail of kind.hpp: flat panels and their seams, from a file of a pattern.

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/json.hpp"
#include "cases/input/table.hpp"
#include "cases/input/wrong_entry.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/seam_edits.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_fit.hpp"
#include "tryon/pattern/flat/panel_garment.hpp"
#include "tryon/pattern/flat/place_panels.hpp"

namespace gambeson {
namespace schema {
namespace {

Object patternGarmentTable() {
  using P = PatternGarment;
  return Table<P>("Garment of a pattern")
      .path("path", &P::path, "a pattern as gambeson import writes it, relative to the case's folder")
      .required()
      .number("cell", &P::cell_m, "m", between(0.001, 0.2), std::string(kCellDoc) + "; along weft and warp")
      .integer("degree", &P::degree, 2, 5, "polynomial degree")
      .number("close_within", &P::close_within_s, "s", aboveTo(0, 100),
              "by then its seams are closed around the wearer; else the run says which gape, and by how much")
      .list("seams", &P::seams, seamEditTable(),
            "which seams are otherwise than the file has them, in their order: changed, taken away, or new")
      .defaultsTo("as the file has them")
      .build();
}

}  // namespace
}  // namespace schema

namespace {

const PatternGarment& of(const GarmentCase& g) { return std::get<PatternGarment>(g.shape); }

/// Runs f; what is wrong with the pattern is said in its file, or of a seam that the case edits by its key there.
template <class F>
auto inFile(const GarmentCase& g, const EditedPattern& edited, F f) {
  try {
    return f();
  } catch (const InputError& e) {
    if (!e.where().file.empty() || e.where().key == "human") throw;
    if (std::string key; edited.isOfEdit(e, key)) throw InputError({"", 0, key}, e.reason());
    const JsonNode root = readJson(of(g).path, {.bytes = kPatternBytes});
    const std::string file = of(g).path.string();
    sayAt(schema::Entry{root, "", file}, edited.inFile(e));
  }
}

bool byRegions(const FlatPattern& pattern) {
  return pattern.placing == PanelPlacing::regions ||
         std::any_of(pattern.panels.begin(), pattern.panels.end(), [](const Panel& p) { return !p.placement; });
}

/// Throws where a panel has neither placement nor region, or no region where others are placed by theirs.
void checkPlaces(const FlatPattern& pattern) {
  if (!byRegions(pattern)) return;
  std::string allowed;
  for (const std::string& name : regionNames()) allowed += (allowed.empty() ? "" : ", ") + name;
  for (const bool placed : {false, true})
    for (std::size_t k = 0; k < pattern.panels.size(); ++k) {
      const Panel& panel = pattern.panels[k];
      if (regionOf(panel) || panel.placement.has_value() != placed) continue;
      const std::string near = schema::closest(panel.region, regionNames());
      throw InputError({"", 0, fmt::format("panels[{}]", k)},
                       fmt::format("panel \"{}\" has no {}{}: {}; allowed for \"region\": {}{}", panel.name,
                                   placed ? "region" : "placement",
                                   panel.region.empty()
                                       ? (placed ? "" : " and no region")
                                       : fmt::format(", and its region \"{}\" is no place on the body", panel.region),
                                   placed ? "panels of this pattern are placed by their regions"
                                          : "nothing says where it stands around its wearer",
                                   allowed, near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
    }
}

EditedPattern patternOf(const GarmentCase& g) {
  EditedPattern edited = editSeams(readPattern(of(g).path), of(g).seams);
  inFile(g, edited, [&] { checkPlaces(edited.pattern); });
  return edited;
}

/// Its patches and edges, wherever they will stand.
Garment lookAt(const GarmentCase& g) {
  EditedPattern edited = patternOf(g);
  for (Panel& p : edited.pattern.panels)
    if (!p.placement) p.placement = PanelPlace{};
  return inFile(g, edited, [&] { return panelGarment(edited.pattern, {of(g).cell_m, of(g).degree}); });
}

/// Where its panels start by their regions, those of its patches (`panel_of`): bent around the wearer.
std::vector<std::vector<Vec3>> bentPoints(const Garment& garment, const std::vector<int>& panel_of,
                                          const PlacedPanels& placed) {
  std::vector<std::vector<Vec3>> out(garment.patches.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto panel = static_cast<std::size_t>(panel_of[k]);
    const PanelPlace& flat = placed.flat[panel];
    for (const Vec3& x : garment.patches[k].points) {
      const Vec3 r = x - flat.origin_m;
      out[k].push_back(placed.bent[panel]({dot(r, flat.along_x), dot(r, flat.along_y)}));
    }
  }
  return out;
}

/// Which panels stand in the body, as placed for another.
void sayDepths(const FlatPattern& pattern, const std::string& name, const GarmentMaking& m, const StandingBody& body) {
  for (const Panel& panel : pattern.panels) {
    const PanelPlace& at = *panel.placement;
    const PanelDepth d = depthInBody(
        panel, [&](Vec2 x) { return m.worn.position_m + at.origin_m + x.x * at.along_x + x.y * at.along_y; }, body);
    if (d.depth_m > 0)
      m.fit->notes.push_back(
          fmt::format("panel \"{}\" of the garment \"{}\" starts {:.1f} cm deep in the body ({}): it is placed for "
                      "another wearer; \"placing\": \"regions\" in its file places all by their regions",
                      panel.name, name, 100 * d.depth_m, d.segment));
  }
}

Garment makePanels(const GarmentMaking& m) {
  EditedPattern edited = patternOf(m.worn);
  FlatPattern& pattern = edited.pattern;
  return inFile(m.worn, edited, [&] {
    const bool regions = byRegions(pattern);
    if (regions && !m.human)
      throw InputError({"", 0, "panels"},
                       "stand around a human by their regions, and the case has none; allowed: a placement for each");
    std::optional<StandingBody> body;
    if (m.human && (regions || m.fit)) body.emplace(*m.human, m.posture);
    std::optional<PlacedPanels> placed;
    if (regions) {
      placed = placePanels(pattern, *body);
      for (std::size_t k = 0; k < pattern.panels.size(); ++k) pattern.panels[k].placement = placed->flat[k];
    }
    std::vector<int> panel_of;
    Garment garment = panelGarment(pattern, {of(m.worn).cell_m, of(m.worn).degree}, &panel_of);
    if (placed) garment.placed = bentPoints(garment, panel_of, *placed);
    if (!m.fit || !body) return garment;
    const std::string name = m.worn.name.empty() ? pattern.name : m.worn.name;
    std::vector<LaidPanel> front, back;
    if (placed) {
      front = placed->front, back = placed->back;
    } else {
      layAsPlaced(pattern, m.worn.position_m, front, back);
      sayDepths(pattern, name, m, *body);
    }
    m.fit->girths = panelGirths(pattern, front, back, *body);
    if (const std::string text = shortText(m.fit->girths, standsOf(m.fabric)); !text.empty())
      m.fit->notes.push_back(
          fmt::format("garment \"{}\" is narrower than its wearer before anything is sewn: {}", name, text));
    return garment;
  });
}

}  // namespace

extern const GarmentKind pattern_garment;
const GarmentKind pattern_garment{
    .word = "pattern",
    .sewn = true,
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<PatternGarment>("pattern", &GarmentCase::shape, schema::patternGarmentTable(),
                                            "flat panels from a file, sewn around the wearer");
        },
    .make = makePanels,
    .arms =
        [](const GarmentCase& g) {
          const FlatPattern pattern = patternOf(g).pattern;
          return byRegions(pattern) && coversArms(pattern) ? ArmsWanted::aside : ArmsWanted::any;
        },
    .as_scanned = [](const GarmentCase& g) { return !byRegions(patternOf(g).pattern); },
    .look = lookAt,
    .files = [](GarmentCase& g, const GarmentKind::Take& take) { take(std::get<PatternGarment>(g.shape).path); },
};

}  // namespace gambeson
