/// Mutations of good files: whatever is read ends in success, or in an InputError that names a file (never a crash,
/// another exception, or endless work). Deterministic: the same mutations in every run.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "cases/cloth/card.hpp"
#include "cases/fabric/raw_loop.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/pattern/import.hpp"
#include "cases/pattern/mesh_import.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/svg.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "human/files/mesh.hpp"
#include "tryon/pattern/garment_file.hpp"
#include "tryon/pattern/pattern.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/pattern/small_meshes.hpp"
#include "unit/cases/pattern/small_patterns.hpp"

namespace gambeson {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers on every machine.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(next() % n); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A number, word or sign that files are made of, or break on.
const char* const kPieces[] = {
    "0",    "-1",        "1e999",   "-1e300", "1e-320",  "nan",  "inf",  "4294967296", "2147483648", "-0",   "0.5.5",
    "\"",   "'",         "{",       "}",      "[",       "]",    "<",    ">",          "/>",         ",",    ":",
    "null", "true",      "\n",      "\r",     "\t",      "\xff", "\xc3", "<!--",       "]]>",        "&lt;", "é",
    "/",    "f 1 1 1\n", "v 0 0\n", "#",      "\\u0000", "\\",   "%s%n", " m",         " kg",        "deg"};

/// Where a number starts, at or after `from`; npos where there is none.
std::size_t numberAt(const std::string& s, std::size_t from) { return s.find_first_of("0123456789", from); }

/// One to three changes of `text`: bits, bytes, pieces, numbers, cut and doubled parts, parts of `other` put in.
std::string mutated(std::string text, const std::string& other, Chance& chance) {
  for (std::size_t changes = 1 + chance.below(3); changes > 0; --changes) {
    if (text.empty()) return text;
    const std::size_t at = chance.below(text.size()),
                      length = 1 + chance.below(std::min<std::size_t>(60, text.size() - at));
    const std::string piece = kPieces[chance.below(std::size(kPieces))];
    switch (chance.below(10)) {
      case 0:
        text[at] = static_cast<char>(text[at] ^ (1 << chance.below(8)));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      case 3:
        text.insert(at, piece);
        break;
      case 4:
        text.resize(at);
        break;
      case 5: {
        const std::size_t from = chance.below(other.size());
        text.replace(at, length, other.substr(from, length));
        break;
      }
      default:  // mostly numbers: they get past the syntax
        if (const std::size_t n = numberAt(text, at); n != std::string::npos) {
          const std::size_t end = text.find_first_not_of("0123456789.eE+-", n);
          text.replace(n, end == std::string::npos ? std::string::npos : end - n, piece);
        }
    }
  }
  return text;
}

struct Counts {
  int good = 0, refused = 0;
};

/// Readers of what other programs write are asked more often than those of our own formats.
enum class Of { ours, others };

/// Mutates one file of a good set, and reads the set with `read`: `all` times by name (ctest -C verify -R
/// verify.fuzz_units), and always the first 500 of others' formats, the first third of ours.
template <class Read>
Counts fuzz(const std::string& name, const std::string& good, std::uint64_t seed, int all, Read read,
            Of formats = Of::ours) {
  const int times = std::getenv("GAMBESON_LONG") ? all : formats == Of::ours ? all / 3 : std::min(all, 500);
  const Folder folder;
  const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
  for (const char* file : {"arm.urdf", "arm_body.json", "arm_flex.csv", "sleeve_flex.json"})
    std::filesystem::copy_file(library / file, folder.path() / file);
  Chance chance(seed);
  Counts counts;
  for (int i = 0; i < times; ++i) {
    const std::string text = mutated(good, good, chance);
    const std::filesystem::path file = folder.write(name, text);
    try {
      read(file);
      ++counts.good;
    } catch (const InputError& e) {
      ++counts.refused;
      EXPECT_FALSE(e.where().file.empty()) << "mutation " << i << ": " << e.what() << "\n" << text;
      EXPECT_FALSE(e.reason().empty()) << "mutation " << i << "\n" << text;
    } catch (const std::exception& e) {
      ADD_FAILURE() << "mutation " << i << ": " << e.what() << "\n" << text;
    }
  }
  // A fuzzer that never gets past the syntax, or never breaks anything, tests nothing.
  EXPECT_GT(counts.good, times / 100) << name;
  EXPECT_GT(counts.refused, times / 4) << name;
  return counts;
}

std::string library(const char* name) {
  return content(std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library" / name);
}

const auto readSleeve = [](const std::filesystem::path& file) { readCase(file.parent_path() / "sleeve_flex.json"); };

TEST(Fuzz, Cases) {
  fuzz("sleeve_flex.json", library("sleeve_flex.json"), 1, 700, readSleeve);
  fuzz("sphere_drape.json", library("sphere_drape.json"), 2, 700, [](const auto& file) { readCase(file); });
}

TEST(Fuzz, Structures) {
  const auto read = [](const std::filesystem::path& file) { readAnyCase(file); };
  fuzz("cantilever.json", library("cantilever.json"), 11, 500, read);
  fuzz("roof.json", library("hinged_roof.json"), 12, 300, read);
}

TEST(Fuzz, Cells) {
  fuzz("cell.json", library("cell_spun.json"), 15, 300, [](const auto& file) { readAnyCase(file); });
}

TEST(Fuzz, HumansAndMotions) {
  fuzz("arm.urdf", library("arm.urdf"), 3, 700, readSleeve);
  fuzz("arm_body.json", library("arm_body.json"), 4, 500, readSleeve);
  fuzz("arm_flex.csv", library("arm_flex.csv").substr(0, 600), 5, 500, readSleeve);
}

TEST(Fuzz, Meshes) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n"
      "3 1 2 3\n";
  std::string stl = "solid t\n";
  for (int i = 0; i < 3; ++i)
    stl += "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 " + std::to_string(i) +
           "\nendloop\nendfacet\n";
  const auto read = [](const std::filesystem::path& file) { loadMesh(file); };
  fuzz("a.obj", obj, 6, 500, read);
  fuzz("a.ply", ply, 7, 500, read);
  fuzz("a.stl", stl + "endsolid t\n", 8, 500, read);
}

TEST(Fuzz, Garments) {
  const Folder folder;
  TubePattern tube;
  tube.radius_m = 0.1;
  tube.length_m = 0.2;
  tube.cells_around = 6;
  tube.cells_along = 2;
  tube.patches = 2;
  writeGarment(makeTube(tube), folder.path() / "tube.json");
  fuzz("garment.json", content(folder.path() / "tube.json"), 9, 700,
       [](const std::filesystem::path& file) { loadGarment(file); });
}

TEST(Fuzz, ClothMeshes) {
  const std::string obj =
      "o cloth\nv 0 0 0.01\nv 0.2 0 0.01\nv 0.2 0.2 0.01\nv 0 0.2 0.01\nv 0.4 0 0.01\nv 0.4 0.2 0.01\n"
      "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 2 0\nvt 2 1\ng front\nf 1/1 2/2 3/3 4/4\ng back\nf 2/2 5/5 6/6 3/3\n"
      "g edge hem front\nl 1 2\n";
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0.01\n0.2 0 0.01\n0.2 0.2 0.01\n0 0.2 0.01\n3 0 1 2\n"
      "3 0 2 3\n";
  for (const char* name : {"worn.obj", "worn.ply"}) {
    const auto read = [&](const std::filesystem::path& file) {
      std::ofstream(file.parent_path() / "worn.json")
          << R"({"name": "worn", "garment": {"mesh_file": {"path": ")" << name << R"("}, "model": "triangles"},
                 "fabric": {"name": "f", "thickness": "1 mm", "density": "400 kg/m^3", "young": "1 MPa", "poisson": 0.2,
                            "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
                 "obstacles": [{"name": "ground", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
                 "contact": {"friction": 0.3}, "time": {"duration": "0.1 s"}})";
      readCase(file.parent_path() / "worn.json");
    };
    const bool is_obj = std::string(name) == "worn.obj";
    fuzz(name, is_obj ? obj : ply, is_obj ? 13 : 14, 500, read);
  }
}

TEST(Fuzz, FabricCards) {
  fuzz(
      "denim.card.json", library("cards/denim_a.card.json"), 81, 600,
      [](const auto& file) { checkFabric(fabricOf(readCard(file)).fabric); }, Of::others);
  std::string loop = "curvature_per_cm,moment_gf_cm_per_cm\n";
  BentLine<kStops> line(stopsOf<kStops>(quadraticCurve(7.6e-6, 2.6e-6, -3.8e-8)));
  for (const int way : {1, -1, 1})
    for (int i = way < 0 ? -15 : -16; i <= 16; ++i)
      loop += fmt::format("{},{:.5f}\n", way * i * 0.15, line.bend(way * i * 15.0) / 9.80665e-3);
  fuzz(
      "loop.csv", loop, 82, 600, [](const auto& file) { readLoop(file); }, Of::others);
}

TEST(Fuzz, Patterns) {
  // What is let in can be drawn, and is read back from what is written.
  const auto read = [](const std::filesystem::path& file) {
    const FlatPattern p = importPattern(file, {}).pattern;
    patternSvg(p);
    const std::filesystem::path written = file.parent_path() / "written.json";
    std::ofstream(written) << patternText(p);
    readPattern(written);
  };
  const Folder folder;
  fuzz("a_specification.json", kGarmentCode, 91, 500, read, Of::others);
  fuzz("a.json", patternText(importPattern(folder.write("a.json", kGarmentCode), {}).pattern), 92, 500, read,
       Of::others);
  fuzz("a.dxf", dxfText("METRIC"), 93, 500, read, Of::others);
}

TEST(Fuzz, MeshesOfGarments) {
  // What is let in is drawn, and is read back from what is written.
  const auto read = [](const std::filesystem::path& file) {
    const ImportedMesh in = importMesh(file, {}, "fuzz");
    patternSvg(in.flat);
    const std::filesystem::path written = file.parent_path() / "written.json";
    std::ofstream(written) << clothMeshText(in.file);
    EXPECT_EQ(clothMeshText(loadClothMesh(written)), clothMeshText(in.file));
  };
  const Folder folder;
  const std::string obj = tubeObj(0.15, 0.4, 1);
  fuzz("a.obj", obj, 94, 500, read, Of::others);
  fuzz("a.ply", squarePly(true), 95, 500, read, Of::others);
  fuzz("b.json", clothMeshText(importMesh(folder.write("a.obj", obj), {}, "b").file), 96, 500, read, Of::others);
}

}  // namespace
}  // namespace gambeson
