#include "cases/command/check_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "cases/cell/run.hpp"
#include "cases/cloth/card.hpp"
#include "cases/cloth/law_table.hpp"
#include "cases/cloth/usual.hpp"
#include "cases/input/json.hpp"
#include "cases/input/message.hpp"
#include "cases/pattern/garmentcode.hpp"
#include "cases/pattern/import.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/runs/recorded_case.hpp"
#include "cases/structure/run.hpp"
#include "cases/study/study.hpp"
#include "cases/verify/verify.hpp"
#include "cases/wear/results/film.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/scene/dressed.hpp"
#include "core/error.hpp"
#include "human/body/urdf.hpp"
#include "human/files/mesh.hpp"
#include "human/recorded/bvh.hpp"
#include "human/recorded/markers.hpp"
#include "human/recorded/osim.hpp"
#include "human/recorded/storage.hpp"
#include "tryon/pattern/cloth_mesh_file.hpp"
#include "tryon/pattern/garment_file.hpp"

namespace gambeson {
namespace {

using Path = std::filesystem::path;

/// A sort of file: what it is called, how it is read whole, and what it is for.
struct Sort {
  std::string name;
  std::function<void(const Path&)> read;
  std::string use;
};

struct SortByEnding {
  std::vector<std::string> endings;
  Sort sort;
};

const std::vector<SortByEnding>& sortsByEnding() {
  static const std::vector<SortByEnding> all{
      {{".mot", ".sto"}, {"recorded motion of OpenSim", readStorage, "human.motion.file.path of a case takes it"}},
      {{".bvh"}, {"recorded motion (BVH)", readBvh, "human.motion.file.path of a case takes it"}},
      {{".trc"}, {"markers (TRC)", readTrc, "human.motion.file.path or markers.path of a case takes it"}},
      {{".osim"}, {"OpenSim model", readOsim, "human.motion.file.model of a case takes it"}},
      {{".urdf"}, {"skeleton (URDF)", loadUrdf, "human.urdf of a case takes it"}},
      {{".dxf"}, {"flat pattern (DXF)", [](const Path& f) { importPattern(f, {}); }, "gambeson import reads it"}},
      {{".obj", ".ply", ".stl", ".gltf", ".glb"},
       {"triangle mesh", [](const Path& f) { loadTriangles(f); },
        "obstacles, garment.mesh_file and human.scan of a case take it"}}};
  return all;
}

bool has(const JsonNode& root, const char* key) { return root.find(key) != nullptr; }

bool hasFormat(const JsonNode& root, const std::string& start) {
  const JsonNode* format = root.find("format");
  return format && format->type == JsonNode::Type::text && format->text.starts_with(start);
}

void readCardFile(const Path& file) {
  readCard(file);
  for (const InputError& w : unusualOfCard(file)) sayNote(w.what());
}

/// Refuses what is known by its keys, but has no reader that needs no other file.
Sort checkedWith(const std::string& name, const std::string& other) {
  return {name, [=](const Path& f) { throw InputError({f.string(), 0, ""}, "is " + name + "; " + other); }, ""};
}

struct SortByKeys {
  std::function<bool(const JsonNode&)> is;
  Sort sort;
};

bool isStudy(const JsonNode& root) {
  return has(root, "axes") || (has(root, "case") && (has(root, "variants") || has(root, "optimise")));
}

/// By what only cards have; a case of a structure has a sheet, and one of worn cloth a garment.
bool isCard(const JsonNode& root) {
  if (has(root, "garment") || has(root, "garments") || has(root, "human") || has(root, "fabric")) return false;
  return has(root, "tensile") || has(root, "weight") || has(root, "MIU") ||
         (has(root, "source") && has(root, "bending"));
}

const std::vector<SortByKeys>& sortsByKeys() {
  const auto keys = [](const char* first, const char* second) {
    return [=](const JsonNode& root) { return has(root, first) && has(root, second); };
  };
  const auto format = [](const char* start) { return [=](const JsonNode& root) { return hasFormat(root, start); }; };
  static const std::vector<SortByKeys> all{
      {isPattern, {"flat pattern", [](const Path& f) { readPattern(f); }, "gambeson import draws it"}},
      {isGarmentCode,
       {"pattern of GarmentCode", [](const Path& f) { importPattern(f, {}); }, "gambeson import reads it"}},
      {format("gambeson garment"), {"garment", loadGarment, "garment.file.path of a case takes it"}},
      {format(kClothMeshFormat), {"garment of triangles", loadClothMesh, "garment.mesh_file.path of a case takes it"}},
      {format("gambeson dressed"), {"dressed state", readDressed, "dressing.from of a case takes it"}},
      {keys("units", "membrane"), {"law table", readLawTable, "fabric.law.table of a case takes it"}},
      {keys("checks", "runs"), {"reference", verify::readReference, "gambeson verify runs it"}},
      {isStudy, {"study", study::readStudy, "gambeson study runs it"}},
      {isCard, {"fabric card", readCardFile, "gambeson fabric, or fabric.card of a case, takes it"}},
      {keys("shapes", "mass_kg"),
       checkedWith("a body file",
                   "it is checked with its URDF, by a case that has both under human.urdf and human.body")},
      {keys("reads", "reads"),
       checkedWith("a joint map", "it is checked with its motion or character, under human of a case")},
      {keys("case_hash", "timings"),
       checkedWith("the summary of a run", "check the folder that it stands in, which holds the whole run")},
      {keys("$schema", "properties"), checkedWith("a JSON Schema", "allowed: the files that it is about")}};
  return all;
}

std::string endingOf(const Path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// What was left by a run, read as `gambeson report` reads it.
std::string checkResults(const Path& dir) {
  const Path file = caseFile(dir);
  if (holdsCell(dir)) {
    readRecordedCellCase(file);
    return "results of a cell of yarns";
  }
  if (holdsStructure(dir)) {
    readRecordedStructureCase(file);
    return "results of a structure";
  }
  return "results of worn cloth, " + framesText(recordedRun(dir).recording);
}

/// JSON under any name; what is none and is not called so may be meant for another program.
JsonNode readNamed(const Path& file, const std::string& ending) {
  try {
    return readJson(file, {.bytes = kPatternBytes});
  } catch (const InputError& e) {
    if (ending == ".json") throw;
    std::vector<std::string> known;
    for (const SortByEnding& by : sortsByEnding()) known.insert(known.end(), by.endings.begin(), by.endings.end());
    throw InputError(e.where(), e.reason() + "; files that are checked are JSON, or end in " + schema::joined(known));
  }
}

void say(const Path& file, const Sort& sort, std::ostream& out) {
  sort.read(file);
  out << fmt::format("{}: {}, valid; {}\n", file.string(), sort.name, sort.use);
}

}  // namespace

bool checkFile(const std::filesystem::path& file, std::ostream& out) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) {
    if (!std::filesystem::exists(file / "case.json"))
      throw InputError({file.string(), 0, ""}, "this is a folder, not a file, and has no case.json as results have");
    out << fmt::format("{}: {}, valid; gambeson report and render read them\n", file.string(), checkResults(file));
    return true;
  }
  if (!std::filesystem::is_regular_file(file, error)) return false;
  const std::string ending = endingOf(file);
  for (const SortByEnding& by : sortsByEnding())
    if (std::find(by.endings.begin(), by.endings.end(), ending) != by.endings.end()) {
      say(file, by.sort, out);
      return true;
    }
  const JsonNode root = readNamed(file, ending);
  if (root.type != JsonNode::Type::object || root.find("kind")) return false;
  for (const SortByKeys& by : sortsByKeys())
    if (by.is(root)) {
      say(file, by.sort, out);
      return true;
    }
  return false;
}

}  // namespace gambeson
