#pragma once
/// Small patterns of the formats that are read, of our own making.

#include <fmt/format.h>

#include <array>
#include <string>
#include <vector>

namespace gambeson {

/// Front, counter-clockwise, with a half circle cut out of its top; back, clockwise, with a bulge to its right.
// clang-format off
inline const std::string kGarmentCode = R"json({
  "pattern": {
    "panels": {
      "back": {"translation": [20, 0, -20], "rotation": [0, 0, 0], "label": "body", "colour": "red",
               "vertices": [[0, 0], [0, 30], [20, 30], [20, 0]],
               "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2], "label": "hem"},
                         {"endpoints": [2, 3], "curvature": {"type": "quadratic", "params": [[0.5, 0.1]]}}, {"endpoints": [3, 0]}]},
      "front": {"translation": [10, 90, 25], "rotation": [0, 90, 0],
                "vertices": [[0, 0], [20, 0], [20, 30], [15, 30], [5, 30], [0, 30]],
                "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3]},
                          {"endpoints": [3, 4], "curvature": {"type": "circle", "params": [5, 0, 0]}},
                          {"endpoints": [4, 5]}, {"endpoints": [5, 0], "label": "side"}]}
    },
    "stitches": [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 1}],
                 [{"panel": "front", "edge": 5}, {"panel": "back", "edge": 3}, "right_wrong"]],
    "panel_order": ["front", "back"]
  },
  "parameters": {"length": 30}, "parameter_order": [],
  "properties": {"curvature_coords": "relative", "normalize_panel_translation": false, "units_in_meter": 100, "normalized_edge_loops": true}
})json";
// clang-format on

/// A DXF-ASTM file of two pieces of 300 x 200 (times `scale`): FRONT with a sew line, turn points, notches, grain; BACK
/// run clockwise, with a bulge and a round hole, without turn points. `units`: METRIC, ENGLISH, or empty: not said.
inline std::string dxfText(const std::string& units, double scale = 1) {
  std::string out = "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC\n0\nSECTION\n2\nBLOCKS\n";
  const auto add = [&](const std::string& text) { out += text; };
  const auto at = [&](double x, double y) { return fmt::format("10\n{}\n20\n{}\n", x * scale, y * scale); };
  const auto text = [&](const std::string& words, const std::string& layer) {
    add("0\nTEXT\n8\n" + layer + "\n" + at(50, 50) + "40\n5\n1\n" + words + "\n");
  };
  const auto polyline = [&](const std::string& layer, const std::vector<std::array<double, 3>>& points) {
    add("0\nPOLYLINE\n8\n" + layer + "\n66\n1\n70\n1\n");
    for (const auto& p : points)
      add("0\nVERTEX\n8\n" + layer + "\n" + at(p[0], p[1]) + (p[2] != 0 ? fmt::format("42\n{}\n", p[2]) : ""));
    add("0\nSEQEND\n8\n" + layer + "\n");
  };
  const auto point = [&](const std::string& layer, double x, double y) {
    add("0\nPOINT\n8\n" + layer + "\n" + at(x, y));
  };
  const auto line = [&](const std::string& layer, double x, double y, double u, double v) {
    add(fmt::format("0\nLINE\n8\n{}\n{}11\n{}\n21\n{}\n", layer, at(x, y), u * scale, v * scale));
  };
  add("0\nBLOCK\n8\n0\n2\nFRONT_M\n70\n64\n10\n0\n20\n0\n");
  for (const char* words : {"PIECE NAME: FRONT", "SIZE: M", "QUANTITY: 1,1", "MATERIAL: SHELL"}) text(words, "1");
  text("pocket here", "15");
  polyline("1", {{0, 0, 0}, {300, 0, 0}, {300, 200, 0}, {0, 200, 0}});
  polyline("14", {{10, 10, 0}, {150, 10, 0}, {290, 10, 0}, {290, 190, 0}, {10, 190, 0}});
  for (const double x : {0, 300})
    for (const double y : {0, 200}) {
      point("2", x, y);
      point("2", x == 0 ? 10 : 290, y == 0 ? 10 : 190);
    }
  point("3", 150, 10);
  point("4", 100, 0);
  point("80", 290, 100);
  line("7", 150, 50, 150, 150);
  line("8", 50, 50, 100, 50);
  point("13", 200, 150);
  add("0\nSOLID\n8\n99\n" + at(0, 0) + "11\n1\n21\n0\n12\n1\n22\n1\n13\n0\n23\n1\n");
  add("0\nENDBLK\n8\n0\n0\nBLOCK\n8\n0\n2\nBACK_M\n70\n64\n10\n0\n20\n0\n");
  for (const char* words : {"PIECE NAME: BACK", "SIZE: M", "QUANTITY: 1"}) text(words, "1");
  polyline("1", {{0, 0, 0}, {0, 200, 0}, {100, 200, -1}, {200, 200, 0}, {300, 200, 0}, {300, 0, 0}});
  add("0\nCIRCLE\n8\n11\n" + at(150, 100) + fmt::format("40\n{}\n", 10 * scale));
  add("0\nENDBLK\n8\n0\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
  for (const char* block : {"FRONT_M", "BACK_M"}) add(std::string("0\nINSERT\n8\n1\n2\n") + block + "\n10\n0\n20\n0\n");
  for (const char* words : {"STYLE NAME: TEST STYLE", "AUTHOR: nobody", "SAMPLE SIZE: M"}) text(words, "1");
  if (!units.empty()) text("UNITS: " + units, "1");
  return out + "0\nENDSEC\n0\nEOF\n";
}

}  // namespace gambeson
