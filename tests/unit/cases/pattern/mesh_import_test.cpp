/// Garments of triangles from other programs: areas, borders and seams of a tube in closed form, what is refused and
/// where, what comes back to the bit.

#include "cases/pattern/mesh_import.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "cases/kinds/any_case.hpp"
#include "cases/pattern/import.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/weld_mesh.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/pattern/small_meshes.hpp"

namespace gambeson {
namespace {

ImportChoices inCentimetres() {
  ImportChoices c;
  c.unit = "cm";
  return c;
}

std::string meshRefusal(const std::filesystem::path& file, const ImportChoices& choices = {}) {
  try {
    importMesh(file, choices, "m");
  } catch (const InputError& e) {
    EXPECT_TRUE(e.where().file == file.string() || e.where().file == "command line") << e.what();
    return e.where().key + ": " + e.reason();
  }
  return "accepted";
}

bool saysOf(const std::vector<std::string>& list, const std::string& word) {
  return std::any_of(list.begin(), list.end(), [&](const auto& s) { return s.find(word) != std::string::npos; });
}

/// Six corners, and faces of them.
std::string sixCorners(const std::string& f) {
  return "v 0 0 0\nv 0.3 0 0\nv 0 0.3 0\nv 0 0 0.3\nv 0.3 0.3 0\nv 0.1 0 0\n" + f;
}

TEST(MeshImport, ATubeHasItsMeasures) {
  const Folder folder;
  const double radius = 15, height = 40, side = 2 * radius * std::sin(std::numbers::pi / 12);
  const ImportedMesh in = importMesh(folder.write("tube.obj", tubeObj(radius, height, 60)), inCentimetres(), "tube");
  const ClothMesh& m = in.file.mesh;
  ASSERT_EQ(m.patch_names, (std::vector<std::string>{"front", "back"}));
  EXPECT_EQ(m.vertices.size(), 48u);  // 56 of the file, 8 of them twice, to rounding
  EXPECT_EQ(m.triangles.size(), 72u);
  for (const int p : {0, 1}) EXPECT_NEAR(areaOf(m, p), 6 * side * height * 1e-4, 1e-14);
  ASSERT_EQ(in.borders.size(), 2u);
  for (const auto& border : in.borders) EXPECT_NEAR(lengthAround(m, border), 0.12 * side, 1e-14);
  // Laid flat: two rectangles with two seams.
  ASSERT_EQ(in.flat.panels.size(), 2u);
  for (const Panel& p : in.flat.panels) {
    EXPECT_NEAR(areaOf(p), 6 * side * height * 1e-4, 1e-14);
    EXPECT_EQ(p.outline.size(), 4u);
  }
  ASSERT_EQ(in.flat.seams.size(), 2u);
  for (const PanelSeam& s : in.flat.seams) {
    EXPECT_EQ(s.use, SeamUse::sewn);
    EXPECT_NEAR(lengthOf(in.flat, s.a), 0.4, 1e-14);
    EXPECT_NEAR(lengthOf(in.flat, s.b), 0.4, 1e-14);
  }
  EXPECT_TRUE(saysOf(in.notes, "within 0.01 mm of others"));
  EXPECT_TRUE(saysOf(in.notes, "a 1 of it is 0.6 m")) << in.notes.size();
  EXPECT_TRUE(saysOf(in.notes, "1 panel is mirrored"));
  EXPECT_TRUE(saysOf(in.dropped, "1 file of materials' looks"));
}

TEST(MeshImport, AxesAndUnits) {
  const Folder folder;
  const auto file = folder.write("tube.obj", tubeObj(0.15, 0.4, 1));
  ImportChoices y;
  y.up = "y";
  const ImportedMesh as_is = importMesh(file, {}, "t"), turned = importMesh(file, y, "t");
  EXPECT_TRUE(saysOf(as_is.notes, "say no unit: read in m, 40.0 cm"));
  EXPECT_EQ(as_is.file.mesh.vertices[1].x, turned.file.mesh.vertices[1].y);
  EXPECT_EQ(as_is.file.mesh.vertices[1].y, turned.file.mesh.vertices[1].z);
  EXPECT_EQ(as_is.file.mesh.vertices[1].z, turned.file.mesh.vertices[1].x);
  const std::string answer = meshRefusal(folder.write("big.obj", tubeObj(15, 40, 1)));
  EXPECT_NE(answer.find("largest extent is 40, which is 40 m in m"), std::string::npos) << answer;
  EXPECT_NE(answer.find("--unit cm (40 cm)"), std::string::npos) << answer;
  const auto far = folder.write("far.obj", "v 2000 0 0\nv 2000.3 0 0\nv 2000 0.3 0\nf 1 2 3\n");
  EXPECT_NE(meshRefusal(far).find("from the origin"), std::string::npos);
  // PLY in mm, beyond a thousand of them.
  ImportChoices mm;
  mm.unit = "mm";
  std::string ply = squarePly(true);
  for (std::size_t at = ply.find("0.2 "); at != std::string::npos; at = ply.find("0.2 ", at + 1))
    ply.replace(at, 4, "2000 ");
  const ImportedMesh large = importMesh(folder.write("mm.ply", ply), mm, "s");
  EXPECT_NEAR(areaOf(large.file.mesh, 0), 4, 1e-6);
  y.up = "x";
  EXPECT_NE(meshRefusal(file, y).find("allowed: y, z"), std::string::npos);
}

TEST(MeshImport, ComesBackToTheBitAndIsWorn) {
  const Folder folder;
  const ImportedMesh in = importMesh(folder.write("tube.obj", tubeObj(15, 40, 60)), inCentimetres(), "tube");
  const auto file = folder.write("garment.json", clothMeshText(in.file));
  const ClothMeshFile back = loadClothMesh(file);
  EXPECT_EQ(clothMeshText(back), clothMeshText(in.file));
  EXPECT_EQ(back.mesh.uv.size(), in.file.mesh.uv.size());
  EXPECT_EQ(back.mesh.lines.size(), 4u);  // two borders, each a part of both patches
  EXPECT_EQ(namedEdges(back.mesh).size(), 2u);
  // Drawn again, and worn, held at its upper border.
  EXPECT_EQ(importMesh(file, {}, "tube").flat.seams.size(), 2u);
  const auto worn = folder.write(
      "case.json",
      R"({"name": "t", "garment": {"mesh_file": {"path": "garment.json", "rest": "uv"}, "model": "triangles"},
          "fabric": {"name": "f", "thickness": "1 mm", "density": "400 kg/m^3", "young": "1 MPa", "poisson": 0.2,
                     "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
          "supports": [{"fixed": {"edge": "border_1"}}],
          "obstacles": [{"name": "ground", "plane": {"point": [0, 0, -1], "normal": [0, 0, 1]}}],
          "contact": {"friction": 0.3}, "time": {"duration": "0.1 s"}})");
  EXPECT_NO_THROW(readAnyCase(worn));
}

TEST(MeshImport, WithoutUvThereIsNothingFlat) {
  const Folder folder;
  const ImportedMesh in = importMesh(folder.write("tube.obj", tubeObj(0.15, 0.4, 1, false)), {}, "tube");
  EXPECT_TRUE(in.file.mesh.uv.empty());
  EXPECT_TRUE(in.flat.panels.empty());
  EXPECT_EQ(in.borders.size(), 2u);
  // A picture's uv: far from the lengths of the cloth.
  std::string stretched = tubeObj(0.15, 0.4, 1);
  for (std::size_t at = stretched.find("vt 0 "); at != std::string::npos; at = stretched.find("vt 0 ", at + 1))
    stretched.replace(at, 5, "vt -3 ");
  const ImportedMesh picture = importMesh(folder.write("picture.obj", stretched), {}, "tube");
  EXPECT_TRUE(picture.file.mesh.uv.empty());
  EXPECT_TRUE(saysOf(picture.dropped, "no flat shape of this cloth"));
  std::ostringstream out;
  ImportArguments arguments;
  arguments.file = folder.path() / "picture.obj";
  arguments.svg = folder.path() / "picture.svg";
  EXPECT_THROW(importToFiles(arguments, out), InputError);
}

TEST(MeshImport, PlyKeepsItsUv) {
  const Folder folder;
  const ImportedMesh bare = importMesh(folder.write("a.ply", squarePly(false)), {}, "a"),
                     flat = importMesh(folder.write("b.ply", squarePly(true)), {}, "b");
  EXPECT_TRUE(bare.flat.panels.empty());
  ASSERT_EQ(flat.flat.panels.size(), 1u);
  EXPECT_NEAR(areaOf(flat.flat.panels[0]), 0.04, 1e-8);  // single precision
  EXPECT_EQ(flat.flat.panels[0].outline.size(), 4u);
  EXPECT_EQ(flat.file.mesh.patch_names, std::vector<std::string>{"cloth"});
}

TEST(MeshImport, SaysWhatIsNoClothAndWhere) {
  const Folder folder;
  const auto answer = [&](const std::string& f) { return meshRefusal(folder.write("m.obj", sixCorners(f))); };
  const auto expect = [&](const std::string& f, const std::string& word) {
    const std::string said = answer(f);
    EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  EXPECT_EQ(answer("f 1 2 3\n"), "accepted");
  expect("g front\nf 1 2 3\nf 1 2 6\n", "patch \"front\": the triangle at (13.33, 0.00, 0.00) cm has no area");
  expect("f 1 2 3\nf 2 1 4\nf 1 2 5\n",
         "3 triangles meet in the edge from (0.00, 0.00, 0.00) cm to (30.00, 0.00, 0.00)");
  expect("f 1 2 3\nf 1 4 5\n", "meets itself in one point alone, at (0.00, 0.00, 0.00) cm");
  expect("v 1 0 0\nv 1.2 0 0\nv 1 0.2 0\nf 1 2 3\nf 7 8 9\n",
         "is in 2 pieces that hang together nowhere (1: 1 triangle about");
  ImportChoices second;
  second.piece = 2;
  const ImportedMesh one = importMesh(
      folder.write("two.obj", sixCorners("v 1 0 0\nv 1.2 0 0\nv 1 0.2 0\nf 7 8 9\nf 1 2 3\nf 1 3 4\n")), second, "m");
  EXPECT_EQ(one.file.mesh.triangles.size(), 1u);
  EXPECT_TRUE(saysOf(one.dropped, "2 triangles of other pieces"));
  // A ring of squares with half a turn.
  std::string strip;
  const int n = 9;
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, half = 0.5 * a;
    for (const double s : {-0.1, 0.1})
      strip += fmt::format("v {} {} {}\n", (0.4 + s * std::cos(half)) * std::cos(a),
                           (0.4 + s * std::cos(half)) * std::sin(a), s * std::sin(half));
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i + 1, b = a + 1, c = i + 1 < n ? a + 2 : 2, d = i + 1 < n ? a + 3 : 1;
    strip += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, d, a, d, c);
  }
  const std::string moebius = meshRefusal(folder.write("moebius.obj", strip));
  EXPECT_NE(moebius.find("has one side only"), std::string::npos) << moebius;
  // One triangle of many that faces the other side is turned.
  std::string turned = tubeObj(0.15, 0.4, 1);
  const std::size_t at = turned.find("f 1/1 2/2 9/9 8/8");
  ASSERT_NE(at, std::string::npos);
  turned.replace(at, 17, "f 8/8 9/9 2/2 1/1");
  EXPECT_TRUE(
      saysOf(importMesh(folder.write("turned.obj", turned), {}, "t").notes, "2 triangles faced the other side"));
  // A hole is said, with its place.
  std::string holed = tubeObj(0.015, 0.1, 1);
  holed.erase(holed.find("f 9/9 10/10"), std::string("f 9/9 10/10 17/17 16/16\n").size());
  const ImportedMesh in = importMesh(folder.write("holed.obj", holed), {}, "t");
  EXPECT_EQ(in.borders.size(), 3u);
}

TEST(MeshImport, FilesOfOursAreChecked) {
  const Folder folder;
  const ImportedMesh in = importMesh(folder.write("tube.obj", tubeObj(0.15, 0.4, 1)), {}, "tube");
  const std::string good = clothMeshText(in.file);
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& word) {
    std::string text = good;
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    const auto file = folder.write("g.json", text.replace(at, from.size(), to));
    try {
      loadClothMesh(file);
      FAIL() << to << " was taken";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, file.string());
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  expect("gambeson mesh 1", "gambeson mesh 9", "format");
  expect("\"triangles\": [[0, ", "\"triangles\": [[900, ", "patches[0].triangles[0][0]");
  expect("\"triangles\": [[0, ", "\"triangles\": [[0.5, ", "patches[0].triangles[0][0]");
  expect("\"uv_m\": [", "\"uv_m\": [1, ", "allowed: 216");
  expect("\"name\": \"back\"", "\"name\": \"front\"", "names two patches");
  expect("\"vertices_m\"", "\"vertices\"", "vertices");
  expect("\"patch\": \"front\"", "\"patch\": \"side\"", "names no patch");
  expect("[[", "[[1e5, ", "vertices_m[0]");
}

}  // namespace
}  // namespace gambeson
