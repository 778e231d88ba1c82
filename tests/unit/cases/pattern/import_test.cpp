/// Patterns of other programs: what is read of small files of our own making, what is refused, what comes back to the
/// bit.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <sstream>

#include "cases/pattern/import.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/svg.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/pattern/small_patterns.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

constexpr double pi = std::numbers::pi;

/// "key: reason" of the refusal; "accepted" where there is none.
std::string refusal(const std::filesystem::path& file, const ImportChoices& choices = {}) {
  try {
    importPattern(file, choices);
  } catch (const InputError& e) {
    EXPECT_TRUE(e.where().file == file.string() || e.where().file == "command line") << e.what();
    return e.where().key + ": " + e.reason();
  }
  return "accepted";
}
void expectSaid(const std::string& answer, const std::string& word) {
  EXPECT_NE(answer.find(word), std::string::npos) << answer;
}
bool said(const std::vector<std::string>& list, const std::string& word) {
  return std::any_of(list.begin(), list.end(), [&](const auto& s) { return s.find(word) != std::string::npos; });
}

/// A panel of 20 x 30 cm with a half circle of 10 cm cut out of its top, one of 20 x 30 with a bulged side, clockwise.
TEST(GarmentCode, IsReadAsItsFormatSays) {
  const Folder folder;
  const ImportedPattern in = importPattern(folder.write("skirt_specification.json", kGarmentCode), {});
  const FlatPattern& p = in.pattern;
  EXPECT_EQ(p.name, "skirt");
  EXPECT_EQ(p.source.unit, "cm");
  ASSERT_EQ(p.panels.size(), 2u);
  const Panel &front = p.panels[0], &back = p.panels[1];  // as panel_order has them
  EXPECT_EQ(front.name, "front");
  EXPECT_EQ(back.region, "body");
  ASSERT_EQ(front.outline.size(), 6u);
  EXPECT_NEAR(areaOf(front), 0.06 - 0.5 * pi * 0.0025, 1e-15);
  EXPECT_NEAR(lengthOf(front, 3), pi * 0.05, 1e-15);
  // A quadratic of height 2 h relative to its chord c encloses 2/3 c h: here h = 0.1 c / 2.
  EXPECT_NEAR(areaOf(back), 0.06 + 2.0 / 3 * 0.3 * 0.015, 1e-15);
  EXPECT_GT(areaOf(back), 0.06);
  EXPECT_EQ(front.outline[5].name, "side");
  // Where they stand: front 25 cm before the body, turned by 90 degrees about the vertical axis of GarmentCode.
  const auto at = [](const Panel& q, Vec2 x) {
    return q.placement->origin_m + x.x * q.placement->along_x + x.y * q.placement->along_y;
  };
  EXPECT_LT(norm(at(front, {0, 0}) - Vec3{0.25, 0.1, 0.9}), 1e-15);
  EXPECT_LT(norm(at(front, {0.2, 0.3}) - Vec3{0.25 - 0.2, 0.1, 0.9 + 0.3}), 1e-15);
  // The back ran clockwise: it is mirrored, and every corner stands where it stood; its right side faces back.
  EXPECT_LT(norm(at(back, back.outline[2].start_m) - Vec3{-0.2, 0.4, 0.3}), 1e-15);
  EXPECT_LT(norm(cross(back.placement->along_x, back.placement->along_y) - Vec3{-1, 0, 0}), 1e-15);
  // Seams: end to start; "right_wrong" start to start.
  ASSERT_EQ(p.seams.size(), 2u);
  EXPECT_EQ(p.seams[0].b[0].from, 1);
  EXPECT_EQ(p.seams[0].use, SeamUse::sewn);
  EXPECT_EQ(p.seams[1].b[0].from, 0);
  EXPECT_TRUE(said(in.dropped, "\"colour\" of panels")) << in.dropped.size();
  EXPECT_TRUE(said(in.dropped, "parameters of the template"));
}

TEST(GarmentCode, SaysWhatIsWrongAndWhere) {
  const Folder folder;
  const auto broken = [&](const std::string& from, const std::string& to) {
    return refusal(folder.write("g.json", replaced(kGarmentCode, from, to)));
  };
  expectSaid(broken("\"units_in_meter\": 100, ", ""), "--unit cm");
  expectSaid(broken("[0, 1]}, {\"endpoints\": [1, 2], \"label\": \"hem\"}", "[0, 2]}, {\"endpoints\": [1, 2]}"),
             "panel \"back\" is open: edge 0 ends at vertex 2 and edge 1 starts at vertex 1");
  expectSaid(broken("[0, 0], [0, 30], [20, 30], [20, 0]", "[0, 0], [20, 30], [0, 30], [20, 0]"),
             "pattern.panels.back: panel \"back\" crosses itself at (");
  expectSaid(broken("\"quadratic\"", "\"cubic\""), "has 1 points; allowed: 2");
  expectSaid(broken("\"quadratic\"", "\"clothoid\""), "clothoid");
  expectSaid(broken("\"panel\": \"back\", \"edge\": 3", "\"panel\": \"bak\", \"edge\": 3"),
             "there is no panel \"bak\"");
  expectSaid(broken("\"panel\": \"back\", \"edge\": 3", "\"panel\": \"back\", \"edge\": 7"),
             "pattern.stitches[1][1].edge");
  expectSaid(broken("\"panel\": \"back\", \"edge\": 3", "\"panel\": \"back\", \"edge\": 1"), "sewn already");
  expectSaid(broken("\"units_in_meter\": 100", "\"units_in_meter\": 1"), "Is the unit right?");
  expectSaid(refusal(folder.write("other.json", "{\"a\": 1}")), "has neither pattern.panels");
  expectSaid(refusal(folder.write("other.zprj", "ISO-10303-21;")), "of no format that is read");
  ImportChoices choices;
  choices.unit = "kg";
  expectSaid(refusal(folder.write("g.json", kGarmentCode), choices), "no unit of length");
  choices.unit = "mm";
  EXPECT_NEAR(areaOf(importPattern(folder.write("g.json", kGarmentCode), choices).pattern.panels[0]),
              1e-2 * (0.06 - 0.5 * pi * 0.0025), 1e-16);
}

/// A sleeve that is drawn lying, as GarmentCode does, has its warp across the arm where no grain line says otherwise.
TEST(Import, SaysWhereTheWarpIsAssumed) {
  const auto report = [](const FlatPattern& pattern) {
    const Folder folder;
    std::ostringstream out;
    importToFiles({folder.write("in.json", patternText(pattern)), folder.path() / "out.json", {}, {}}, out);
    return out.str();
  };
  FlatPattern shirt = region_patterns::shirt({});
  expectSaid(report(shirt), "the panels have no grain line: the warp is taken to run along y of the drawing. Where");
  for (PanelEdge& e : shirt.panels[2].outline) e.start_m = {e.start_m.y, -e.start_m.x};
  expectSaid(report(shirt), "along y of the drawing, which is across the arm in left sleeve. Where");
  shirt.panels[2].grain = GrainLine{{0.1, 0}, {0.2, 0}};
  expectSaid(report(shirt), "3 panels have no grain line: the warp is taken to run along y of the drawing. Where");
}

TEST(Dxf, IsReadByItsLayers) {
  const Folder folder;
  const ImportedPattern in = importPattern(folder.write("blouse.dxf", dxfText("METRIC")), {});
  const FlatPattern& p = in.pattern;
  EXPECT_EQ(p.name, "TEST STYLE");
  ASSERT_EQ(p.panels.size(), 2u);
  const Panel &front = p.panels[0], &back = p.panels[1];
  EXPECT_EQ(front.name, "FRONT");
  EXPECT_EQ(front.size, "M");
  EXPECT_EQ(front.material, "SHELL");
  EXPECT_EQ(front.quantity, 2);
  // To the sew line, 10 mm inside of the cut line of 300 x 200 mm; single precision has 3e-5 mm here.
  EXPECT_NEAR(areaOf(front), 0.28 * 0.18, 1e-8);
  EXPECT_NEAR(areaOf(front.cut_line), 0.3 * 0.2, 1e-8);
  EXPECT_EQ(front.outline.size(), 4u);
  // The back ran clockwise and has a bulge (a half circle of 100 mm across) and a hole.
  EXPECT_NEAR(areaOf(back.outline), 0.3 * 0.2 + 0.5 * pi * 0.0025, 1e-8);
  ASSERT_EQ(back.cutouts.size(), 1u);
  EXPECT_NEAR(areaOf(back.cutouts[0]), -pi * 1e-4, 1e-8);
  ASSERT_EQ(front.notches.size(), 2u);
  EXPECT_EQ(front.notches[0].kind, NotchKind::slit);
  EXPECT_EQ(front.notches[1].kind, NotchKind::t);
  const Vec2 notch = MeasuredCurve(curveOf(front, front.notches[0].edge)).at(front.notches[0].at).point;
  EXPECT_NEAR(notch.x, 0.1, 1e-6);
  EXPECT_NEAR(notch.y, 0.01, 1e-6);
  ASSERT_TRUE(front.grain);
  EXPECT_NEAR(front.grain->to_m.y - front.grain->from_m.y, 0.1, 1e-7);
  ASSERT_EQ(front.annotations.size(), 1u);
  EXPECT_EQ(front.annotations[0].text, "pocket here");
  EXPECT_EQ(front.lines.size(), 2u);  // an internal line and a drill hole
  EXPECT_TRUE(said(in.dropped, "HATCH on layer 99") || said(in.dropped, "on layer 99"));
  EXPECT_TRUE(said(in.dropped, "AUTHOR"));
  EXPECT_TRUE(said(in.notes, "no turn points")) << "of the back";
}

TEST(Dxf, UnitsAreNeverGuessed) {
  const Folder folder;
  const auto file = folder.write("blouse.dxf", dxfText(""));
  const std::string answer = refusal(file);
  for (const char* word : {"does not say its unit", "300", "30 cm wide in mm", "762 cm in inches", "--unit in"})
    expectSaid(answer, word);
  ImportChoices choices;
  choices.unit = "in";
  const auto small = folder.write("inches.dxf", dxfText("", 1 / 25.4));
  EXPECT_NEAR(areaOf(importPattern(small, choices).pattern.panels[0]), 0.28 * 0.18, 1e-8);
  EXPECT_NEAR(areaOf(importPattern(folder.write("e.dxf", dxfText("ENGLISH", 1 / 25.4)), {}).pattern.panels[0]),
              0.28 * 0.18, 1e-8);
}

TEST(Dxf, DoubtsAUnitThatMakesNoClothes) {
  const Folder folder;
  EXPECT_FALSE(said(importPattern(folder.write("a.dxf", dxfText("METRIC")), {}).notes, "--unit"));
  EXPECT_TRUE(said(importPattern(folder.write("b.dxf", dxfText("METRIC", 0.1)), {}).notes,
                   "the largest panel measures 3.0 cm in mm"));
}

TEST(Dxf, SaysWhatIsWrongAndWhere) {
  const Folder folder;
  const std::string good = dxfText("METRIC");
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return refusal(folder.write("b.dxf", text.replace(at, from.size(), to)));
  };
  expectSaid(broken("70\n1\n0\nVERTEX", "70\n0\n0\nVERTEX"), "block \"FRONT_M\", layer 1: the boundary is open");
  expectSaid(broken("10\n300\n20\n200\n", "10\n-100\n20\n100\n"), "crosses itself");
  expectSaid(refusal(folder.write("b.dxf", "no DXF at all\n")), "is no DXF file");
  expectSaid(refusal(folder.write("b.dxf", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n")), "holds no piece");
  expectSaid(refusal(folder.write("b.dxf", "")), "empty");
  // Two sizes of one piece.
  std::string two = dxfText("METRIC");
  two.replace(two.find("SIZE: M\n", two.find("BACK_M")), 8, "SIZE: L\n");
  const auto file = folder.write("g.dxf", replaced(two, "SAMPLE SIZE: M", "DESCRIPTION: x"));
  expectSaid(refusal(file), "there are 2 sizes and no SAMPLE SIZE; say which with --size: L or M");
  ImportChoices choices;
  choices.size = "L";
  EXPECT_EQ(importPattern(file, choices).pattern.panels.size(), 1u);
  choices.size = "XL";
  expectSaid(refusal(file, choices), "there is no size \"XL\"");
}

TEST(PatternFile, ComesBackToTheBit) {
  const Folder folder;
  for (const bool dxf : {false, true}) {
    FlatPattern p =
        importPattern(dxf ? folder.write("a.dxf", dxfText("METRIC")) : folder.write("a.json", kGarmentCode), {})
            .pattern;
    p.panels[0].outline[1].curve =
        SplineEdge{2, {0, 0, 0, 1.0 / 3, 1, 1, 1}, {{0.22, 0.1}, {0.21, 0.2}}, {1, 0.7, 1, 1}};
    p.panels[0].outline[0].curve = PolylineEdge{{{0.1, -0.01}}};
    if (dxf) p.panels[0] = importPattern(folder.path() / "a.dxf", {}).pattern.panels[0];
    p.seams.resize(1);
    p.seams[0].a = {{0, 2, 0.25, 1.0 / 3}};
    p.seams[0].b = {{1, 1, 1, 0}};
    p.seams[0].stiffness_N = 0.1;
    p.seams[0].use = SeamUse::opening;
    const std::string text = patternText(p);
    const FlatPattern q = readPattern(folder.write("p.json", text));
    EXPECT_EQ(patternText(q), text);
    for (std::size_t k = 0; k < p.panels.size(); ++k) {
      EXPECT_EQ(areaOf(q.panels[k]), areaOf(p.panels[k]));
      for (int e = 0; e < edgeCount(p.panels[k]); ++e) EXPECT_EQ(lengthOf(q.panels[k], e), lengthOf(p.panels[k], e));
      EXPECT_EQ(q.panels[k].notches.size(), p.panels[k].notches.size());
      EXPECT_EQ(q.panels[k].placement.has_value(), p.panels[k].placement.has_value());
      EXPECT_EQ(q.panels[k].quantity, p.panels[k].quantity);
    }
    EXPECT_EQ(q.seams[0].a[0].to, 1.0 / 3);
    EXPECT_EQ(q.seams[0].use, SeamUse::opening);
  }
}

TEST(PatternFile, NamesWhatIsWrong) {
  const Folder folder;
  const std::string text = patternText(importPattern(folder.write("a.json", kGarmentCode), {}).pattern);
  const auto broken = [&](const std::string& from, const std::string& to) {
    std::string t = text;
    const std::size_t at = t.find(from);
    EXPECT_NE(at, std::string::npos) << from << "\n" << text;
    return refusal(folder.write("p.json", t.replace(at, from.size(), to)));
  };
  expectSaid(broken("\"back.3\"", "\"bakc.3\""), "did you mean \"back\"?");
  expectSaid(broken("\"back.3\"", "\"back\""), "names no edge");
  expectSaid(broken("\"back.3\"", "\"back.3 from 0.5 to 2\""), "no part of the edge");
  expectSaid(broken("\"back.3\"", "\"back.9\""), "there is no edge 9");
  expectSaid(broken("\"outline\"", "\"outlin\""), "outlin");
  expectSaid(broken("\"start\": [0, 0]", "\"start\": [0, 0], \"arc\": 1, \"bezier\": []"), "arc");
  expectSaid(broken("\"start\": [0, 0]", "\"start\": [\"20 m\", 0]"), "Is the unit right?");
  EXPECT_EQ(broken("\"start\": [0, 0]", "\"start\": [\"0 cm\", 0]"), "accepted");
}

TEST(PatternSvg, ShowsPanelsSeamsAndMarks) {
  const Folder folder;
  for (const bool dxf : {false, true}) {
    const FlatPattern p =
        importPattern(dxf ? folder.write("a.dxf", dxfText("METRIC")) : folder.write("a.json", kGarmentCode), {})
            .pattern;
    const std::string svg = patternSvg(p);
    for (const char* word : {"<svg xmlns", "mm\" viewBox=\"0 0 ", "10 cm", "5 × 5 cm", "class=\"cloth\""})
      EXPECT_NE(svg.find(word), std::string::npos) << word;
    for (const Panel& panel : p.panels) EXPECT_NE(svg.find(">" + panel.name + "<"), std::string::npos);
    for (const PanelSeam& s : p.seams) EXPECT_NE(svg.find(">" + s.name + "<"), std::string::npos);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
  }
}

}  // namespace
}  // namespace gambeson
