/// Specifications of GarmentCode in all the forms that its versions write.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cases/pattern/import.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

/// One square panel, 20 units wide, whose edge 0 (or its last, backwards) is curved; `more`: further members.
std::string squarePanel(const std::string& curve, const std::string& properties = "\"units_in_meter\": 100",
                        bool clockwise = false, const std::string& more = "") {
  return fmt::format(
      R"({{"pattern": {{"panels": {{"p": {{"vertices": [[0, 0], [20, 0], [20, 20], [0, 20]], "edges": [{}]{}}}}}, "stitches": []}},
          "properties": {{{}}}}})",
      clockwise
          ? fmt::format(
                R"({{"endpoints": [0, 3]}}, {{"endpoints": [3, 2]}}, {{"endpoints": [2, 1]}}, {{"endpoints": [1, 0]{}}})",
                curve)
          : fmt::format(
                R"({{"endpoints": [0, 1]{}}}, {{"endpoints": [1, 2]}}, {{"endpoints": [2, 3]}}, {{"endpoints": [3, 0]}})",
                curve),
      more, properties);
}

Panel onlyPanel(const Folder& folder, const std::string& text) {
  return importPattern(folder.write("a_specification.json", text), {}).pattern.panels.at(0);
}

TEST(ForeignGarmentCode, EveryFormOfACurve) {
  const Folder folder;
  const double chord = 0.2, whole = 0.04;
  const auto area = [&](const std::string& curve) {
    return areaOf(onlyPanel(folder, squarePanel(", \"curvature\": " + curve)));
  };
  // A control point at (1/2, y) of the chord c lifts a parabola of area 1/3 c^2 y; to the left of the edge, into the
  // cloth.
  const double parabola = chord * chord * 0.3 / 3;
  EXPECT_NEAR(area("[0.5, 0.3]"), whole - parabola, 1e-15);
  EXPECT_NEAR(area(R"({"type": "quadratic", "params": [[0.5, 0.3]]})"), whole - parabola, 1e-15);
  EXPECT_NEAR(area(R"({"type": "quadratic", "params": [[0.5, -0.3]]})"), whole + parabola, 1e-15);
  // A cubic whose controls lie 2/3 towards the quadratic's is the same curve.
  EXPECT_NEAR(area(fmt::format(R"({{"type": "cubic", "params": [[{0}, 0.2], [{1}, 0.2]]}})", 1.0 / 3, 2.0 / 3)),
              whole - parabola, 1e-15);
  // Arcs: radius 12.5 on a chord of 20, the half angle is asin 0.8. To the right of a chord along x lies below.
  const double r = 0.125, half = std::asin(0.8), segment = r * r * (half - std::sin(half) * std::cos(half)),
               large = std::numbers::pi * r * r - segment;
  EXPECT_NEAR(area(R"({"type": "circle", "params": [12.5, 0, 1]})"), whole + segment, 1e-15);
  EXPECT_NEAR(area(R"({"type": "circle", "params": [12.5, false, true]})"), whole + segment, 1e-15);
  EXPECT_NEAR(area(R"({"type": "circle", "params": [12.5, 0, 0]})"), whole - segment, 1e-15);
  EXPECT_NEAR(area(R"({"type": "circle", "params": [12.5, 1, 1]})"), whole + large, 1e-15);
  // A radius that is too short for its chord is that of the half circle, as in SVG.
  EXPECT_NEAR(area(R"({"type": "circle", "params": [9.9999999, 0, 1]})"), whole + 0.5 * std::numbers::pi * 0.01, 1e-12);
  // Control points in the panel's own coordinates.
  const std::string absolute = "\"units_in_meter\": 100, \"curvature_coords\": \"absolute\"";
  EXPECT_NEAR(
      areaOf(onlyPanel(folder, squarePanel(R"(, "curvature": {"type": "quadratic", "params": [[10, 6]]})", absolute))),
      whole - parabola, 1e-15);
  EXPECT_NEAR(areaOf(onlyPanel(folder, squarePanel(R"(, "curvature": [10, 6])", absolute))), whole - parabola, 1e-15);
}

TEST(ForeignGarmentCode, ClockwisePanelsAndOtherUnits) {
  const Folder folder;
  for (const double per_metre : {100.0, 1000.0, 300.0, 1.0e2 / 2.54}) {
    const double unit = 1 / per_metre;
    const std::string units = fmt::format("\"units_in_meter\": {:.17g}", per_metre);
    for (const bool clockwise : {false, true}) {
      // The same curve run the other way round lies to the other side.
      const std::string curve =
          fmt::format(R"(, "curvature": {{"type": "quadratic", "params": [[0.5, {}]]}})", clockwise ? -0.3 : 0.3);
      EXPECT_NEAR(areaOf(onlyPanel(folder, squarePanel(curve, units, clockwise))), (400 - 40) * unit * unit,
                  1e-12 * 400 * unit * unit);
    }
  }
  EXPECT_FALSE(onlyPanel(folder, squarePanel("")).placement);
  EXPECT_FALSE(onlyPanel(folder, squarePanel("", "\"units_in_meter\": 100", true)).placement);
}

/// R = Rz Ry Rx in degrees, in axes with y up and z forward.
TEST(ForeignGarmentCode, RotationsInSpace) {
  const Folder folder;
  const Panel p = onlyPanel(folder, squarePanel("", "\"units_in_meter\": 100", false,
                                                R"(, "translation": [10, 120, -30], "rotation": [30, -40, 75])"));
  ASSERT_TRUE(p.placement);
  const double a = 30 * std::numbers::pi / 180, b = -40 * std::numbers::pi / 180, c = 75 * std::numbers::pi / 180;
  const auto turned = [&](Vec3 v) {
    v = {v.x, std::cos(a) * v.y - std::sin(a) * v.z, std::sin(a) * v.y + std::cos(a) * v.z};
    v = {std::cos(b) * v.x + std::sin(b) * v.z, v.y, -std::sin(b) * v.x + std::cos(b) * v.z};
    v = {std::cos(c) * v.x - std::sin(c) * v.y, std::sin(c) * v.x + std::cos(c) * v.y, v.z};
    return Vec3{v.z, v.x, v.y};  // x forward, y to the left, z up
  };
  EXPECT_LT(norm(p.placement->along_x - turned({1, 0, 0})), 1e-15);
  EXPECT_LT(norm(p.placement->along_y - turned({0, 1, 0})), 1e-15);
  EXPECT_LT(norm(p.placement->origin_m - Vec3{-0.3, 0.1, 1.2}), 1e-15);
  const Panel only_turned =
      onlyPanel(folder, squarePanel("", "\"units_in_meter\": 100", false, R"(, "rotation": [0, 90, 0])"));
  EXPECT_LT(norm(only_turned.placement->origin_m), 1e-15);
}

/// Two panels; a stitch of 20 with 30, one reversed, and one edge that two stitches want.
TEST(ForeignGarmentCode, Stitches) {
  const Folder folder;
  const auto two = [](const std::string& stitches) {
    return R"({"pattern": {"panels": {
      "a": {"vertices": [[0, 0], [20, 0], [20, 20], [0, 20]], "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 0]}]},
      "b": {"vertices": [[0, 0], [30, 0], [30, 20], [0, 20]], "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]}, {"endpoints": [3, 0]}]}},
      "stitches": [)" +
           stitches + R"(]}, "properties": {"units_in_meter": 100}})";
  };
  const auto stitch = [](int a, int b, const char* more = "") {
    return fmt::format(R"([{{"panel": "a", "edge": {}}}, {{"panel": "b", "edge": {}}}{}])", a, b, more);
  };
  const FlatPattern p =
      importPattern(folder.write("s.json", two(stitch(2, 0) + ", " + stitch(1, 3, ", \"right_wrong\""))), {}).pattern;
  ASSERT_EQ(p.seams.size(), 2u);
  EXPECT_NEAR(lengthOf(p, p.seams[0].a), 0.2, 1e-15);
  EXPECT_NEAR(lengthOf(p, p.seams[0].b), 0.3, 1e-15);  // eased
  EXPECT_EQ(p.seams[0].b[0].from, 1);
  EXPECT_EQ(p.seams[1].b[0].from, 0);
  try {
    importPattern(folder.write("s.json", two(stitch(2, 0) + ", " + stitch(2, 1))), {});
    FAIL() << "an edge was sewn twice";
  } catch (const InputError& e) {
    EXPECT_NE(e.reason().find("sewn already"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace gambeson
