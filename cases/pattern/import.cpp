#include "cases/pattern/import.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <ostream>

#include "cases/cad/cad_file.hpp"
#include "cases/cad/tidy.hpp"
#include "cases/input/json.hpp"
#include "cases/input/message.hpp"
#include "cases/pattern/cad_panels.hpp"
#include "cases/pattern/dxf.hpp"
#include "cases/pattern/garmentcode.hpp"
#include "cases/pattern/mesh_import.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/seam_text.hpp"
#include "cases/pattern/svg.hpp"
#include "cases/runs/results_folder.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/flat/place_panels.hpp"
#include "tryon/pattern/flat/regions.hpp"
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {
namespace {

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// "shirt" of shirt_specification.json and of shirt/specification.json.
std::string nameOf(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  if (name == "specification") name = std::filesystem::absolute(file).parent_path().filename().string();
  if (name.ends_with("_specification")) name.resize(name.size() - 14);
  return name.empty() ? "pattern" : name;
}

/// What a terminal shows of a name from a file.
std::string shown(const std::string& text) { return messageText(text); }

std::string sideText(const FlatPattern& pattern, const std::vector<SeamPart>& side) {
  std::string out;
  for (const SeamPart& p : side) out += (out.empty() ? "" : " + ") + partText(pattern, p);
  return shown(out);
}

void say(const std::vector<std::string>& notes, const std::vector<std::string>& dropped, std::ostream& out) {
  if (!notes.empty()) out << "\nNotes:\n";
  for (const std::string& note : notes) out << "  " << shown(note) << "\n";
  if (!dropped.empty()) out << "\nNot kept:\n";
  for (const std::string& what : dropped) out << "  " << shown(what) << "\n";
}

/// Regions that names of panels tell, for panels that have none: "front: of panel \"Vorderteil\""; and which of those
/// without placement still have none.
std::vector<std::string> proposeRegions(FlatPattern& pattern) {
  std::vector<std::string> said, open;
  for (Panel& panel : pattern.panels) {
    if (regionOf(panel.region)) continue;
    if (const std::string word = proposedRegion(panel.name); !word.empty()) {
      said.push_back(fmt::format("{}: \"{}\", by its name{}", panel.name, word,
                                 panel.region.empty() ? "" : fmt::format(" (the file says \"{}\")", panel.region)));
      panel.region = word;
    } else if (!panel.placement) {
      open.push_back(panel.name);
    }
  }
  if (!open.empty()) {
    std::string names, allowed;
    for (const std::string& name : open) names += (names.empty() ? "" : ", ") + name;
    for (const std::string& name : regionNames()) allowed += (allowed.empty() ? "" : ", ") + name;
    said.push_back(
        fmt::format("not told by the name: {}. Say \"region\" of each in the written file, or it cannot be "
                    "worn; allowed: {}",
                    names, allowed));
  }
  return said;
}

/// Where nothing says how panels are cut out of the cloth, and what is assumed: that the warp runs along y, which of a
/// sleeve that is drawn lying is across the arm.
std::string grainText(const FlatPattern& p) {
  std::vector<std::string> across;
  std::size_t without = 0;
  const std::vector<SeamPair> pairs = seamPairs(p);
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    if (p.panels[k].grain) continue;
    ++without;
    const std::optional<PanelRegion> region = regionOf(p.panels[k]);
    if (!region || region->part != RegionPart::sleeve) continue;
    std::vector<int> sleeve;
    for (std::size_t i = 0; i < p.panels.size(); ++i)
      if (const auto r = regionOf(p.panels[i]); r && r->part == RegionPart::sleeve && r->side == region->side)
        sleeve.push_back(static_cast<int>(i));
    const LaidPanel laid = upright(p, static_cast<int>(k), pairs, sleeve);
    if (std::abs(laid.up.x) > std::abs(laid.up.y)) across.push_back(shown(p.panels[k].name));
  }
  if (without == 0) return "";
  return fmt::format(
      "{} no grain line: the warp is taken to run along y of the drawing{}. Where that is wrong, say it of the panel "
      "in the written file: \"grain\": {{\"from\": [0, 0], \"to\": [\"10 cm\", 0]}} lays it along x",
      without == p.panels.size() ? "the panels have" : fmt::format("{} panels have", without),
      across.empty() ? "" : fmt::format(", which is across the arm in {}", fmt::join(across, ", ")));
}

void say(const ImportedPattern& in, const std::vector<std::string>& regions, std::ostream& out) {
  const FlatPattern& p = in.pattern;
  double area = 0;
  std::size_t widest = 5;
  for (const Panel& panel : p.panels) {
    area += areaOf(panel);
    widest = std::max(widest, std::min<std::size_t>(40, shown(panel.name).size()));
  }
  out << fmt::format(
      "{}: {} panels, {:.1f} cm^2, {} seams{}\n\n", shown(p.name), p.panels.size(), 1e4 * area, p.seams.size(),
      p.source.format.empty()
          ? ""
          : fmt::format(" ({}{}{})", p.source.format, p.source.unit.empty() ? "" : ", ", shown(p.source.unit)));
  out << fmt::format("{:{}}  {:>10}  {:>10}  {:>5}  {:>7}  {}\n", "panel", widest, "area cm^2", "outline cm", "edges",
                     "notches", "grain");
  for (const Panel& panel : p.panels) {
    out << fmt::format("{:{}}  {:10.3f}  {:10.3f}  {:5}  {:7}  {}", shown(panel.name), widest, 1e4 * areaOf(panel),
                       100 * perimeterOf(panel.outline), edgeCount(panel), panel.notches.size(),
                       panel.grain ? "yes" : "no");
    if (!panel.cut_line.empty())
      out << fmt::format("; cut line {:.3f} cm^2, {:.3f} cm", 1e4 * areaOf(panel.cut_line),
                         100 * perimeterOf(panel.cut_line));
    out << "\n";
  }
  const bool proposed = std::any_of(p.seams.begin(), p.seams.end(), [](const PanelSeam& s) { return s.proposed; });
  if (!p.seams.empty()) out << fmt::format("\n{:6}{:>8}  {:>8}   sides\n", "seam", "a cm", "b cm");
  for (const PanelSeam& s : p.seams)
    out << fmt::format("{:6}{:8.3f}  {:8.3f}   {}, {}{}{}\n", shown(s.name), 100 * lengthOf(p, s.a),
                       100 * lengthOf(p, s.b), sideText(p, s.a), sideText(p, s.b),
                       s.use == SeamUse::dart      ? ", dart"
                       : s.use == SeamUse::opening ? ", opening"
                                                   : "",
                       s.proposed ? ", proposed" : "");
  if (proposed)
    out << "\nSeams are proposed by length and notches: the format has none. Correct them in \"seams\" of the written "
           "file, and look again:\n  gambeson import GARMENT.json --svg PATTERN.svg\n";
  if (!regions.empty()) out << "\nRegions of the body:\n";
  for (const std::string& region : regions) out << "  " << shown(region) << "\n";
  std::vector<std::string> notes = in.notes;
  for (std::string& doubt : doubtsAbout(p)) notes.push_back(std::move(doubt));
  if (std::string grain = grainText(p); !grain.empty()) notes.push_back(std::move(grain));
  say(notes, in.dropped, out);
}

/// What was read of a CAD file with curved faces.
void say(const CadShape& shape, const CadGarment& in, std::ostream& out) {
  const Garment& g = in.garment;
  double area = 0;
  std::size_t widest = 5;
  for (const CadFace& f : shape.faces) area += areaOf(f.patch, trimOf(f));
  for (const std::string& name : g.patch_names)
    widest = std::max(widest, std::min<std::size_t>(40, shown(name).size()));
  out << fmt::format("{}: {} patches, {:.7g} cm^2, {} seams ({})\n\n", shown(g.name), g.patches.size(), 1e4 * area,
                     in.seams.size(), shape.unit.empty() ? "CAD" : "CAD, " + shown(shape.unit));
  out << fmt::format("{:{}}  {:>10}  {:>6}  {:>7}  {:>5}  {}\n", "patch", widest, "area cm^2", "degree", "points",
                     "loops", "border");
  for (std::size_t k = 0; k < g.patches.size(); ++k) {
    const NurbsPatch& p = g.patches[k];
    const CadFace& f = shape.faces[k];
    out << fmt::format("{:{}}  {:10.7g}  {:>6}  {:>7}  {:5}  {}\n", shown(g.patch_names[k]), widest,
                       1e4 * areaOf(p, trimOf(f)), fmt::format("{} x {}", p.u.degree, p.v.degree),
                       fmt::format("{}x{}", p.u.count(), p.v.count()), f.loops.size(),
                       isWhole(f) ? "whole" : "trimmed");
  }
  if (!in.seams.empty()) out << fmt::format("\n{:6}{:>9}   sides\n", "seam", "cm");
  std::vector<std::string> dropped = shape.dropped;
  for (std::size_t k = 0; k < in.seams.size(); ++k) {
    const CadSeamUse& s = in.seams[k];
    const std::string name = fmt::format("s{}", k + 1);
    out << fmt::format("{:6}{:9.6g}   {}, {}\n", name, 100 * s.length_m, shown(s.a), shown(s.b));
    if (!s.reason.empty()) dropped.push_back(fmt::format("seam {}: it {}", name, s.reason));
  }
  say(shape.notes, dropped, out);
}

CadShape readShape(const std::filesystem::path& file, const ImportChoices& choices) {
  if (!choices.size.empty())
    throw InputError({"command line", 0, "--size"}, "has no meaning for " + file.string() + "; only DXF has sizes");
  return readCad(file, choices.unit.empty() ? 0 : metresOf(choices.unit));
}

ImportedPattern flatPattern(const CadShape& shape, const std::filesystem::path& file) {
  try {
    ImportedPattern out = panelsOf(shape);
    out.pattern.name = nameOf(file);
    out.pattern.source = {file.filename().string(), "CAD", shape.unit};
    return out;
  } catch (const InputError& e) {
    throw InputError({file.string(), e.where().line, e.where().key}, e.reason());
  }
}

/// Curved faces: a garment of patches.
int importSurfaces(const ImportArguments& a, const CadShape& shape, std::ostream& out) {
  if (!a.svg.empty())
    throw InputError({"command line", 0, "--svg"},
                     a.file.string() + " has curved faces, which have no drawing at 1:1; leave it out");
  CadGarment in;
  try {
    in = garmentOf(shape);
  } catch (const InputError& e) {
    throw InputError({a.file.string(), e.where().line, e.where().key}, e.reason());
  }
  in.garment.name = nameOf(a.file);
  say(shape, in, out);
  writeGarment(in.garment, a.output);
  out << "\nGarment: " << a.output.string() << "\n";
  return 0;
}

/// A mesh: a garment of triangles.
int importTriangles(const ImportArguments& a, std::ostream& out) {
  const ImportedMesh in = importMesh(a.file, a.choices, nameOf(a.file));
  if (!a.svg.empty() && in.flat.panels.empty())
    throw InputError({"command line", 0, "--svg"},
                     a.file.string() +
                         " has no uv that is a flat shape of its cloth, so nothing is drawn at 1:1; leave it "
                         "out, or save the mesh with the uv of its pattern");
  sayMesh(in, out);
  say(in.notes, in.dropped, out);
  if (!a.output.empty()) {
    writeOwnFile(a.output, clothMeshText(in.file));
    out << "\nMesh: " << a.output.string() << "\nA case wears it as \"garment\": {\"mesh_file\": {\"path\": \""
        << a.output.filename().string() << (in.flat.panels.empty() ? "\"}" : "\", \"rest\": \"uv\"}")
        << ", \"model\": \"triangles\"}\n";
  }
  if (!a.svg.empty()) {
    writeOwnFile(a.svg, patternSvg(in.flat));
    out << "Drawing: " << a.svg.string() << "\n";
  }
  return 0;
}

/// JSON that says that it is a mesh of ours; what is no JSON is somebody else's to say.
bool isOurMesh(const std::filesystem::path& file) {
  if (endingOf(file) != ".json") return false;
  std::ifstream in(file);
  std::string start(200, ' ');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return start.find(std::string("\"") + kClothMeshFormat) != std::string::npos;
}

}  // namespace

ImportedPattern importPattern(const std::filesystem::path& file, const ImportChoices& choices) {
  const std::string ending = endingOf(file);
  if (ending == ".dxf") return readDxf(file, choices);
  if (CadFormat format; isCadFile(file, format)) {
    const CadShape shape = readShape(file, choices);
    if (!isFlat(shape)) throw InputError({file.string(), 0, ""}, "has curved faces, which are no pattern");
    return flatPattern(shape, file);
  }
  const char* const read =
      "read are specification.json of GarmentCode, DXF-AAMA or ASTM D6673 (.dxf), STEP, IGES and .brep surfaces "
      "(.step, .stp, .igs, .iges, .brep), meshes (.obj, .ply), and what gambeson import wrote";
  if (ending != ".json") {
    if (!std::filesystem::exists(file)) throw InputError({file.string(), 0, ""}, "no such file");
    throw InputError({file.string(), 0, ""}, std::string("is of no format that is read; ") + read);
  }
  const JsonNode root = readJson(file, {.bytes = kPatternBytes});
  if (!choices.size.empty())
    throw InputError({"command line", 0, "--size"}, "has no meaning for " + file.string() + "; only DXF has sizes");
  ImportedPattern out;
  if (isPattern(root)) {
    if (!choices.unit.empty())
      throw InputError({"command line", 0, "--unit"}, "has no meaning for a pattern of ours: it is in m");
    out.pattern = readPattern(root, file.string());
    return out;
  }
  if (!isGarmentCode(root))
    throw InputError({file.string(), 0, ""},
                     std::string("has neither pattern.panels nor \"format\": \"gambeson pattern "
                                 "1\"; ") +
                         read);
  out = readGarmentCode(root, file.string(), choices);
  out.pattern.name = nameOf(file);
  out.pattern.source.file = file.filename().string();
  return out;
}

int importToFiles(const ImportArguments& a, std::ostream& out) {
  if (a.output.empty() && a.svg.empty())
    throw InputError({"command line", 0, "--output"}, "is required, or --svg: what to write");
  if (!a.output.empty() && a.output == a.svg)
    throw InputError({"command line", 0, "--svg"}, "is the same file as --output");
  if (!a.choices.unit.empty()) metresOf(a.choices.unit);
  if (a.choices.unfold && endingOf(a.file) != ".dxf")
    throw InputError({"command line", 0, "--unfold"},
                     "has no meaning for " + a.file.string() + "; only DXF has halves");
  if (!a.output.empty()) checkOutput(a.output, "--output", {a.file});
  if (!a.svg.empty()) checkOutput(a.svg, "--svg", {a.file});
  if (isClothMesh(a.file) || isOurMesh(a.file)) return importTriangles(a, out);
  if (!a.choices.up.empty() || a.choices.piece > 0)
    throw InputError({"command line", 0, a.choices.up.empty() ? "--piece" : "--up"},
                     "has no meaning for " + a.file.string() + "; only meshes need it");
  ImportedPattern in;
  if (CadFormat format; isCadFile(a.file, format)) {
    const CadShape shape = readShape(a.file, a.choices);
    if (!isFlat(shape)) return importSurfaces(a, shape, out);
    in = flatPattern(shape, a.file);
  } else {
    in = importPattern(a.file, a.choices);
  }
  const std::vector<std::string> regions = proposeRegions(in.pattern);
  say(in, regions, out);
  out << "\n";
  if (!a.output.empty()) {
    writeOwnFile(a.output, patternText(in.pattern));
    out << "Pattern: " << a.output.string() << "\n";
  }
  if (!a.svg.empty()) {
    writeOwnFile(a.svg, patternSvg(in.pattern));
    out << "Drawing: " << a.svg.string() << "\n";
  }
  return 0;
}

}  // namespace gambeson
