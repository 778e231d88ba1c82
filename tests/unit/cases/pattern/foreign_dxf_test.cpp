/// DXF patterns as the known programs write them, in files of our own making: boundaries in parts, splines, halves,
/// nested sizes, pieces without blocks; areas in closed form.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "cases/pattern/import.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

constexpr double dxf_pi = std::numbers::pi;

struct DxfPoint {
  double x, y, bulge = 0;
};

std::string dxfAt(double x, double y) { return fmt::format(" 10\n{:.4f}\n 20\n{:.4f}\n", x, y); }
std::string dxfTextOf(const std::string& words, double x = 0, double y = 0) {
  return "  0\nTEXT\n  8\n1\n" + dxfAt(x, y) + " 40\n0.250\n 50\n0.0000\n  1\n" + words + "\n  7\nSTANDARD\n";
}
/// A polyline of the old style.
std::string dxfLine(const std::string& layer, const std::vector<DxfPoint>& points, bool closed = false) {
  std::string out = "  0\nPOLYLINE\n  8\n" + layer + "\n 66\n1\n 70\n" + (closed ? "1" : "0") + "\n";
  for (const DxfPoint& p : points)
    out +=
        "  0\nVERTEX\n  8\n" + layer + "\n" + dxfAt(p.x, p.y) + (p.bulge != 0 ? fmt::format(" 42\n{}\n", p.bulge) : "");
  return out + "  0\nSEQEND\n  8\n" + layer + "\n";
}
/// One of the newer.
std::string dxfLwLine(const std::string& layer, const std::vector<DxfPoint>& points) {
  std::string out = fmt::format(
      "  0\nLWPOLYLINE\n  5\n1A\n100\nAcDbEntity\n  8\n{}\n100\nAcDbPolyline\n 90\n{}\n 70\n1\n", layer, points.size());
  for (const DxfPoint& p : points) out += dxfAt(p.x, p.y) + fmt::format(" 42\n{}\n", p.bulge);
  return out;
}
std::string dxfBlock(const std::string& name, const std::string& entities) {
  return "  0\nBLOCK\n  8\n0\n  2\n" + name + "\n 70\n64\n" + dxfAt(0, 0) + entities + "  0\nENDBLK\n";
}
std::string dxfWhole(const std::string& blocks, const std::string& entities, const std::string& header = "") {
  return "  0\nSECTION\n  2\nHEADER\n" + header + "  0\nENDSEC\n  0\nSECTION\n  2\nBLOCKS\n" + blocks +
         "  0\nENDSEC\n  0\nSECTION\n  2\nENTITIES\n" + entities + "  0\nENDSEC\n  0\nEOF\n";
}

ImportedPattern importDxf(const Folder& folder, const std::string& text, const ImportChoices& choices = {}) {
  return importPattern(folder.write("p.dxf", text), choices);
}
bool dxfSays(const std::vector<std::string>& list, const std::string& word) {
  return std::any_of(list.begin(), list.end(), [&](const auto& s) { return s.find(word) != std::string::npos; });
}

/// As the programs of markers do: the border edge by edge, in inches; numbers of grade rules at points; nested sizes of
/// which the sample has the texts; no coordinates of the grain's z.
TEST(ForeignDxf, BordersInPartsOfNestedSizes) {
  const Folder folder;
  std::string blocks;
  for (const int size : {8, 10, 12}) {
    const double w = size, h = 20;
    std::string piece = dxfTextOf("Piece Name: C-FRONT") + dxfTextOf(fmt::format("SIZE: {}", size));
    if (size == 10) piece += dxfTextOf("Quantity: 2") + dxfTextOf("Fabric: A") + dxfTextOf("ANNOTATION: CUT 2");
    piece += dxfLine("1", {{0, 0}, {w, 0}}) + dxfLine("1", {{w, h}, {w, 0}}) +
             dxfLine("1", {{w, h}, {w / 2, h}, {0, h}}) + dxfLine("1", {{0, h}, {0, 0}});
    for (const auto& [x, y] : {std::pair(0.0, 0.0), {w, 0.0}, {w, h}, {0.0, h}})
      piece += "  0\nPOINT\n  8\n2\n" + dxfAt(x, y) + "  0\nTEXT\n  8\n2\n" + dxfAt(x, y) +
               " 40\n0.25\n  1\n# 12\n  7\nSTANDARD\n";
    piece += "  0\nLINE\n  8\n7\n" + dxfAt(2, 5) + " 11\n2.0\n 21\n15.0\n  0\nLINE\n  8\n5\n" + dxfAt(2, 5) +
             " 11\n2.0\n 21\n15.0\n";
    piece += "  0\nATTDEF\n  8\n1\n" + dxfAt(0, 0) + " 40\n.25\n  1\nLink:4\n  2\nDependency\n  3\n\n 70\n2\n 72\n3\n";
    blocks += dxfBlock(fmt::format("C-FRONT_{}", size), piece);
  }
  const std::string text =
      dxfWhole(blocks, dxfTextOf("Style Name: C") + dxfTextOf("Sample Size: 10") + dxfTextOf("Units: ENGLISH") +
                           dxfTextOf("TOLERANCE: .006") + "  0\nINSERT\n  8\n1\n  2\nC-FRONT_8\n" + dxfAt(0, 0));
  const ImportedPattern in = importDxf(folder, text);
  ASSERT_EQ(in.pattern.panels.size(), 1u);
  const Panel& p = in.pattern.panels[0];
  EXPECT_EQ(p.name, "C-FRONT");
  EXPECT_EQ(p.size, "10");
  EXPECT_EQ(p.quantity, 2);
  EXPECT_EQ(p.material, "A");
  ASSERT_EQ(p.annotations.size(), 1u);
  EXPECT_NEAR(areaOf(p), 10 * 20 * 0.0254 * 0.0254, 1e-7);
  EXPECT_EQ(p.outline.size(), 4u);
  EXPECT_TRUE(dxfSays(in.dropped, "2 pieces of other sizes than 10"));
  EXPECT_TRUE(dxfSays(in.dropped, "numbers of grade rules (texts # 1), 4 times"));
  EXPECT_TRUE(dxfSays(in.dropped, "TOLERANCE"));
  ImportChoices small;
  small.size = "8";
  EXPECT_NEAR(areaOf(importDxf(folder, text, small).pattern.panels[0]), 8 * 20 * 0.0254 * 0.0254, 1e-7);
  folder.write("p.rul", "GRADE RULE\n");
  EXPECT_TRUE(dxfSays(importDxf(folder, text).dropped, "grade rules (p.rul beside it)"));
}

/// Units by $INSUNITS; borders of LWPOLYLINE, ARC, SPLINE and ELLIPSE; a coarse $MEASUREMENT alone says nothing.
TEST(ForeignDxf, CurvesOfNewerFiles) {
  const Folder folder;
  const auto header = [](int units) {
    return fmt::format("  9\n$ACADVER\n  1\nAC1015\n  9\n$INSUNITS\n 70\n{}\n", units);
  };
  const std::string tongue = dxfBlock("TONGUE", dxfLwLine("1", {{0, 0}, {30, 0}, {30, 20, 1}, {0, 20}}));
  for (const auto& [units, metres] : {std::pair(5, 0.01), {4, 0.001}, {1, 0.0254}})
    EXPECT_NEAR(areaOf(importDxf(folder, dxfWhole(tongue, "", header(units))).pattern.panels[0]),
                (600 + 0.5 * dxf_pi * 225) * metres * metres, 1e-6 * 600 * metres * metres);
  // A quarter of an ellipse, 200 by 100 mm; a spline of degree 2 that is a parabola; an arc of a quarter.
  const std::string ellipse =
      "  0\nELLIPSE\n  8\n1\n" + dxfAt(0, 0) + " 30\n0\n 11\n200\n 21\n0\n 31\n0\n 40\n0.5\n 41\n0\n 42\n1.5707963\n";
  const std::string sides = dxfLine("1", {{0, 100}, {0, 0}, {200, 0}});
  EXPECT_NEAR(areaOf(importDxf(folder, dxfWhole(dxfBlock("E", ellipse + sides), "", header(4))).pattern.panels[0]),
              0.25 * dxf_pi * 0.2 * 0.1, 1e-6);
  std::string spline = "  0\nSPLINE\n  8\n1\n 70\n8\n 71\n2\n 72\n6\n 73\n3\n 74\n0\n";
  for (const int k : {0, 0, 0, 1, 1, 1}) spline += fmt::format(" 40\n{}\n", k);
  for (const auto& [x, y] : {std::pair(200, 0), {200, 100}, {0, 100}}) spline += dxfAt(x, y) + " 30\n0\n";
  // The parabola cuts 1/3 off the triangle at its control point: 2/3 of half the rectangle lie beyond its chord.
  EXPECT_NEAR(areaOf(importDxf(folder, dxfWhole(dxfBlock("S", spline + sides), "", header(4))).pattern.panels[0]),
              0.01 + 2.0 / 3 * 0.01, 1e-6);
  const std::string arc = "  0\nARC\n  8\n1\n" + dxfAt(0, 0) + " 40\n100\n 50\n0\n 51\n90\n";
  EXPECT_NEAR(
      areaOf(importDxf(folder, dxfWhole(dxfBlock("A", arc + dxfLine("1", {{0, 100}, {0, 0}, {100, 0}})), "", header(4)))
                 .pattern.panels[0]),
      0.25 * dxf_pi * 0.01, 1e-8);
  try {
    importDxf(folder, dxfWhole(tongue, "", "  9\n$MEASUREMENT\n 70\n0\n"));
    FAIL() << "a unit was guessed";
  } catch (const InputError& e) {
    EXPECT_NE(e.reason().find("hints at inches"), std::string::npos) << e.what();
  }
}

/// Half a back, drawn up to its centre: a rectangle of 200 x 300 with a neck of radius 80 and a hole.
TEST(ForeignDxf, HalvesAreMadeWholeWhereAskedFor) {
  const Folder folder;
  const std::string half = dxfTextOf("PIECE NAME: BACK") +
                           dxfLine("1", {{0, 0}, {200, 0}, {200, 300}, {80, 300, -0.41421356}, {0, 220}}, true) +
                           dxfLine("6", {{0, 0}, {0, 220}}) + "  0\nCIRCLE\n  8\n11\n" + dxfAt(120, 100) + " 40\n10\n" +
                           "  0\nPOINT\n  8\n4\n" + dxfAt(50, 0) + dxfLine("8", {{20, 50}, {60, 50}}) +
                           dxfLine("7", {{100, 50}, {100, 250}});
  const std::string text = dxfWhole(dxfBlock("BACK", half), dxfTextOf("UNITS: METRIC"));
  const double area = 0.06 - 0.25 * dxf_pi * 0.0064 - dxf_pi * 1e-4;
  const ImportedPattern as_drawn = importDxf(folder, text);
  EXPECT_NEAR(areaOf(as_drawn.pattern.panels[0]), area, 1e-7);
  EXPECT_TRUE(dxfSays(as_drawn.notes, "--unfold makes it whole"));
  ImportChoices unfold;
  unfold.unfold = true;
  const ImportedPattern whole = importDxf(folder, text, unfold);
  const Panel& p = whole.pattern.panels[0];
  EXPECT_NEAR(areaOf(p), 2 * area, 2e-7);
  EXPECT_EQ(p.outline.size(), 8u);
  EXPECT_EQ(p.cutouts.size(), 2u);
  ASSERT_EQ(p.notches.size(), 2u);
  const auto at = [&](const Notch& n) { return MeasuredCurve(curveOf(p, n.edge)).at(n.at).point; };
  EXPECT_NEAR(at(p.notches[0]).x, 0.05, 1e-6);
  EXPECT_NEAR(at(p.notches[1]).x, -0.05, 1e-6);
  EXPECT_NEAR(at(p.notches[1]).y, 0, 1e-6);
  EXPECT_EQ(p.lines.size(), 3u);  // the fold once, the line twice
  // A mirror line within a piece that is drawn whole is a line on it.
  const std::string drawn =
      dxfLine("1", {{-200, 0}, {200, 0}, {200, 300}, {-200, 300}}, true) + dxfLine("6", {{0, 0}, {0, 300}});
  EXPECT_NEAR(
      areaOf(importDxf(folder, dxfWhole(dxfBlock("B", drawn), dxfTextOf("UNITS: METRIC")), unfold).pattern.panels[0]),
      0.12, 1e-7);
}

TEST(ForeignDxf, PiecesWithoutBlocks) {
  const Folder folder;
  std::string entities = dxfTextOf("UNITS: METRIC", 900, 900);
  entities += dxfLine("1", {{0, 0}, {200, 0}, {200, 300}}) + dxfLine("1", {{200, 300}, {0, 300}, {0, 0}}) +
              dxfTextOf("PIECE NAME: FRONT", 50, 50) + dxfLine("1", {{20, 200}, {40, 200}, {40, 220}, {20, 220}}, true);
  entities += dxfLine("1", {{400, 0}, {500, 0}, {500, 300}, {400, 300}}, true) + dxfLine("7", {{450, 50}, {450, 250}});
  entities += dxfLine("1", {{700, 0}, {800, 0}, {800, 300}}) + dxfLine("8", {{700, 10}, {720, 10}}) +
              dxfTextOf("for pockets", 710, 20);  // in no piece
  const ImportedPattern in = importDxf(folder, dxfWhole("", entities));
  ASSERT_EQ(in.pattern.panels.size(), 2u);
  EXPECT_TRUE(dxfSays(in.dropped, "of layer 1 that lies in no closed line"));
  EXPECT_TRUE(dxfSays(in.dropped, "of layer 8 that lies in no closed line"));
  EXPECT_TRUE(dxfSays(in.dropped, "a text that lies in no closed line"));
  EXPECT_FALSE(dxfSays(in.dropped, "of layer 7"));
  EXPECT_TRUE(dxfSays(in.notes, "has no blocks"));
  EXPECT_EQ(in.pattern.panels[0].name, "FRONT");
  EXPECT_EQ(in.pattern.panels[0].cutouts.size(), 1u);
  EXPECT_NEAR(areaOf(in.pattern.panels[0]), 0.06 - 0.0004, 1e-8);
  EXPECT_EQ(in.pattern.panels[1].name, "piece_2");
  EXPECT_TRUE(in.pattern.panels[1].grain);
  EXPECT_FALSE(in.pattern.panels[0].grain);
}

/// The boundary of a mirrored insert, one that is turned, and one that is stretched.
TEST(ForeignDxf, InsertsThatChangePieces) {
  const Folder folder;
  const std::string block = dxfBlock("F", dxfLine("1", {{0, 0}, {200, 0}, {200, 300}, {0, 300}}, true));
  const auto insert = [](const std::string& more) { return "  0\nINSERT\n  8\n1\n  2\nF\n" + dxfAt(10, 10) + more; };
  const auto area = [&](const std::string& more) {
    return areaOf(importDxf(folder, dxfWhole(block, insert(more) + dxfTextOf("UNITS: METRIC"))).pattern.panels[0]);
  };
  EXPECT_NEAR(area(""), 0.06, 1e-8);
  EXPECT_NEAR(area(" 50\n30\n"), 0.06, 1e-8);
  EXPECT_NEAR(area(" 41\n2\n 42\n2\n 43\n2\n"), 0.24, 1e-7);
  EXPECT_THROW(area(" 41\n2\n 42\n1\n"), InputError);
}

}  // namespace
}  // namespace gambeson
