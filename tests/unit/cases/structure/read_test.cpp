/// Cases of structures: what is read, written back, and the shapes that they mean.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "cases/command/documents.hpp"
#include "cases/kinds/any_case.hpp"
#include "cases/structure/build.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "unit/cases/structure/example.hpp"

namespace gambeson {
namespace {

const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";
const std::vector<std::string> structures{"cantilever",   "roll_up",   "hinged_roof", "plate_modes",
                                          "flag_dynamic", "man_plate", "man_roll_up"};

TEST(StructureCase, FieldsArriveInSi) {
  const Folder folder;
  const StructureCase c = readStructureCase(folder.write("example.json", structure_example));
  EXPECT_EQ(c.kind, StructureKind::statics);
  EXPECT_EQ(std::get<PlateShape>(c.sheet.shape).width_m, 2);
  EXPECT_EQ(*c.sheet.cells_u, 8);
  EXPECT_EQ(c.sheet.trim.size(), 2u);
  EXPECT_FALSE(c.sheet.trim[0].keep_inside);
  EXPECT_EQ(c.sheet.fields[0].fields.thickness->values, (std::vector<double>{1, 1.5, 1, 1.5}));
  const auto& laminate = std::get<LaminateMaterial>(c.material.law);
  EXPECT_DOUBLE_EQ(laminate.plies[1].angle_rad, std::numbers::pi / 2);
  EXPECT_DOUBLE_EQ(fabricOf(c.material).surfaceDensity(), 2);
  EXPECT_EQ(c.supports[0].hold.size(), 3u);
  EXPECT_TRUE(c.supports[0].clamp);
  EXPECT_EQ(c.supports[1].move_m, (Vec3{0, 0, 0.1}));
  EXPECT_EQ(c.loads[1].sort, LoadSort::force);
  EXPECT_EQ(std::get<PointAt>(c.loads[2].where).at.x, 1);
  EXPECT_EQ(c.programs[0].value, (std::vector<double>{0, 1, 1}));
  EXPECT_EQ(c.statics.steps, 4);
  EXPECT_EQ(c.output.points[1].where.at.y, 1);
}

TEST(StructureCase, WrittenAndReadAgainIsTheSame) {
  const Folder folder;
  std::vector<std::filesystem::path> files{folder.write("example.json", structure_example)};
  for (const std::string& name : structures) files.push_back(library / (name + ".json"));
  for (const std::filesystem::path& file : files) {
    SCOPED_TRACE(file);
    const StructureCase c = readStructureCase(file);
    const std::string written = writeCase(c);
    const StructureCase again = readStructureCase(folder.write("again.json", written));
    EXPECT_EQ(writeCase(again), written);
    EXPECT_EQ(caseIdentity(again), caseIdentity(c));
  }
}

TEST(StructureCase, OneReaderForAllKinds) {
  EXPECT_TRUE(std::holds_alternative<StructureCase>(readAnyCase(library / "cantilever.json")));
  EXPECT_TRUE(std::holds_alternative<Case>(readAnyCase(library / "sphere_drape.json")));
  const StructureCase c = readStructureCase(library / "cantilever.json", {"sheet.cells_u=4", "loads[0].force=[0,0,1]"});
  EXPECT_EQ(*c.sheet.cells_u, 4);
  EXPECT_EQ(c.loads[0].vector, (Vec3{0, 0, 1}));
  try {
    readStructureCase(library / "cantilever.json", {"loads[0].forces=[0,0,1]"});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, "command line");
    EXPECT_EQ(e.where().key, "loads[0].forces");
  }
  const auto schema = nlohmann::json::parse(caseSchema());
  EXPECT_EQ(schema.at("properties").at("kind").at("enum").size(), 5u);
}

/// A sheet of this shape; the rest as in the cantilever.
Sheet sheetWith(const std::string& shape, const std::string& cells) {
  const Folder folder;
  return sheetOf(readStructureCase(
      folder.write("case.json", R"({"kind": "modal", "name": "x", "sheet": {)" + shape + ", " + cells +
                                    R"(}, "material": {"isotropic": {"young": 1, "thickness": 0.1, "density": 1}}})")));
}

double areaOf(const Garment& g) {
  double area = 0;
  for (const double a : controlAreas(g)) area += a;
  return area;
}

/// All control points' surfaces on the exact shape at points that are no knots, and the exact area.
TEST(StructureSheet, ShapesAreExact) {
  const auto check = [](const Sheet& s, double area, auto distance) {
    EXPECT_NEAR(areaOf(s.garment) / area, 1, 1e-6);
    for (const NurbsPatch& p : s.garment.patches)
      for (const double u : {0.0, 0.137, 0.5, 0.771, 1.0})
        for (const double v : {0.0, 0.239, 0.93, 1.0}) EXPECT_NEAR(distance(surfaceDerivatives(p, u, v)[0]), 0, 1e-13);
    EXPECT_NO_THROW(buildFreeMap(s.garment));
  };
  const double pi = std::numbers::pi;
  check(sheetWith(R"("cylinder": {"radius": 2, "length": 3, "end_angle": "270 deg"})", R"("cells_u": 9, "cells_v": 2)"),
        1.5 * pi * 2 * 3, [](const Vec3& x) { return std::hypot(x.y, x.z) - 2; });
  check(sheetWith(R"("cylinder": {"radius": 2, "length": 3})", R"("cells_u": 8, "cells_v": 2)"), 2 * pi * 2 * 3,
        [](const Vec3& x) { return std::hypot(x.y, x.z) - 2; });
  check(sheetWith(R"("sphere": {"radius": 2, "longitude_end": "100 deg", "latitude_start": "-60 deg",
                    "latitude_end": "72 deg"})",
                  R"("cells_u": 12, "cells_v": 12)"),
        100. / 180 * pi * 4 * (std::sin(72 * pi / 180) + std::sin(60 * pi / 180)),
        [](const Vec3& x) { return norm(x) - 2; });
  check(sheetWith(R"("annulus": {"inner_radius": 1, "outer_radius": 2})", R"("cells_u": 2, "cells_v": 8)"), 3 * pi,
        [](const Vec3& x) { return x.z; });
}

/// Fractions of the whole sheet are fractions of its angle; edges of the whole consist of those of the pieces.
TEST(StructureSheet, PlacesOfTheWhole) {
  const Sheet s = sheetWith(R"("cylinder": {"radius": 1, "length": 1, "start_angle": 0, "end_angle": "240 deg"})",
                            R"("cells_u": 6, "cells_v": 1)");
  EXPECT_EQ(s.count_u, 3);
  for (const double f : {0.0, 0.1, 1.0 / 3, 0.5, 0.77, 1.0}) {
    const auto [patch, uv] = locate(s, {-1, {f, 0.25}});
    const Vec3 x = surfaceDerivatives(s.garment.patches[static_cast<std::size_t>(patch)], uv.x, uv.y)[0];
    const double angle = f * 240 * std::numbers::pi / 180;
    // zero is z, the axis x: right-handed from z about x goes to -y.
    EXPECT_NEAR(norm(x - Vec3{0.25, -std::sin(angle), std::cos(angle)}), 0, 1e-13) << f;
  }
  EXPECT_EQ(edgesOf(s, {-1, Side::v1}).size(), 3u);
  EXPECT_EQ(edgesOf(s, {-1, Side::u1})[0].patch, 2);
  EXPECT_NEAR(edgeLength(s, {-1, Side::v0}), 240 * std::numbers::pi / 180, 1e-9);
  const Sheet closed = sheetWith(R"("cylinder": {"radius": 1, "length": 1})", R"("cells_u": 8, "cells_v": 1)");
  EXPECT_THROW(edgesOf(closed, {-1, Side::u0}), InputError);
}

/// Circle and square holes, in lengths of a plate of other proportions than its parameters.
TEST(StructureSheet, TrimmingInLengths) {
  const Folder folder;
  const Sheet s = sheetOf(readStructureCase(folder.write("example.json", structure_example), {"sheet.trim_points=8"}));
  EXPECT_NEAR(areaOf(s.garment), 2 - std::numbers::pi * 0.04 - 0.16, 1e-8);
}

/// The same waves on other meshes, the largest value as stated; another seed is another pattern.
TEST(StructureSheet, NoiseIsOfTheCaseAlone) {
  const Sheet coarse =
      sheetWith(R"("annulus": {"inner_radius": 1, "outer_radius": 2})", R"("cells_u": 2, "cells_v": 64)");
  const Sheet fine =
      sheetWith(R"("annulus": {"inner_radius": 1, "outer_radius": 2})", R"("cells_u": 4, "cells_v": 256)");
  const NoiseCase noise{1e-3, 3, 2, 8, true};
  const auto at = [&](const Sheet& s, const NoiseCase& n, double angle_fraction) {
    Sheet moved = s;
    const std::vector<Vec3> d = noiseOf(s, n);
    std::size_t k = 0;
    for (NurbsPatch& p : moved.garment.patches)
      for (Vec3& x : p.points) x += d[k++];
    const auto [patch, uv] = locate(moved, {-1, {1, angle_fraction}});
    return surfaceDerivatives(moved.garment.patches[static_cast<std::size_t>(patch)], uv.x, uv.y)[0].z;
  };
  double largest = 0, difference = 0;
  for (int i = 0; i < 100; ++i) {
    largest = std::max(largest, std::abs(at(fine, noise, (i + 0.5) / 100)));
    difference = std::max(difference, std::abs(at(fine, noise, (i + 0.5) / 100) - at(coarse, noise, (i + 0.5) / 100)));
  }
  EXPECT_NEAR(largest, 1e-3, 1e-4);
  EXPECT_LT(difference, 2e-6);
  EXPECT_GT(std::abs(at(fine, noise, 0.3) - at(fine, {1e-3, 4, 2, 8, true}, 0.3)), 1e-5);
}

}  // namespace
}  // namespace gambeson
