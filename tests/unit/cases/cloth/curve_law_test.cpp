// Cases with fabrics whose law is curves: what they pull with, and what is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cases/structure/run.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// A strip 20 cm long and 5 cm wide is drawn out by 10 %; the first line below is line 1 of the file.
// clang-format off
const std::string strip = R"json({
  "kind": "static",
  "name": "strip",
  "sheet": {"plate": {"width": 0.2, "height": 0.05, "corner": [0, 0, 0], "axis_u": [1, 0, 0], "axis_v": [0, 1, 0]},
            "cells_u": 4, "cells_v": 2},
  "material": {"fabric": {
    "thickness": 0.001, "density": 400,
    "law": {"curves": {
      "weft": [["5 %", "20 N/m"], ["10 %", "90 N/m"], ["12 %", "200 N/m"]],
      "warp": [["10 %", "100 N/m"]],
      "shear": "60 N/m",
      "rigidity_weft": 1e-5, "rigidity_warp": 1e-5, "twist": 5e-6}}
  }},
  "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz", "move": [0.02, 0, 0.0]}],
  "solver": {"steps": 4},
  "output": {"shapes": "none", "edges": [{"name": "end", "edge": "u1"}]}
})json";
// clang-format on

nlohmann::json summaryOf(const Folder& folder, const std::string& name, const std::string& text) {
  RunOptions options;
  options.out = folder.path() / name;
  options.threads = 1;
  runStructure(readStructureCase(folder.write(name + ".json", text)), options);
  return nlohmann::json::parse(content(options.out / "summary.json"));
}

/// "missing", or whether it holds.
std::string checkOf(const nlohmann::json& summary, const std::string& name) {
  for (const auto& check : summary["checks"])
    if (check["check"] == name) return check["holds"].get<bool>() ? "holds" : "fails";
  return "missing";
}

TEST(LawOfCurves, AStripPullsAsItsTestDid) {
  const Folder folder;
  const auto s = summaryOf(folder, "strip", strip);
  EXPECT_NEAR(std::abs(s["edges"][0]["rx_N"].get<double>()), 90 * 0.05, 1e-6);
  EXPECT_EQ(s["law_range"]["most_beyond"], 0);
  EXPECT_EQ(checkOf(s, "Law range"), "holds");
  const auto beyond = summaryOf(folder, "beyond", replaced(strip, "0.02, 0, 0.0", "0.03, 0, 0.0"));
  EXPECT_EQ(checkOf(beyond, "Law range"), "fails");
}

TEST(LawOfCurves, ACardsCurvesTakeNoOtherLaw) {
  const Folder folder;
  folder.write("c.card.json", R"({"name": "c", "source": "s", "weight": "400 g/m^2",
    "tensile": {"law": "curve", "EMT": "6 %", "LT": 0.6}, "bending": {"B": "0.1 gf cm^2/cm"}})");
  const std::size_t from = strip.find("    \"thickness\""), to = strip.find("  }},\n  \"supports");
  const auto read = [&](const std::string& more) {
    return readStructureCase(folder.write(
        "case.json", strip.substr(0, from) + "    \"card\": \"c.card.json\"" + more + "\n" + strip.substr(to)));
  };
  const StructureCase c = read(""), thick = read(", \"thickness\": 0.002");
  EXPECT_TRUE(c.material.energy_source);
  const Fabric a = std::get<Fabric>(c.material.law), b = std::get<Fabric>(thick.material.law);
  EXPECT_NEAR(a.young_weft_Pa * a.thickness_m, b.young_weft_Pa * b.thickness_m, 1e-9 * a.young_weft_Pa * a.thickness_m);
  EXPECT_EQ(writeCase(readStructureCase(folder.write("again.json", writeCase(c)))), writeCase(c));
  EXPECT_THROW(read(", \"poisson\": 0.3"), InputError);
}

TEST(LawOfCurves, WhatIsNoCurveIsRefused) {
  expectRefused(
      strip,
      {{"[\"10 %\", \"90 N/m\"]", "[\"4 %\", \"90 N/m\"]", 9, "material.fabric.law.curves.weft[1][0]", "ascends"},
       {"\"90 N/m\"", "\"20 N/m\"", 9, "material.fabric.law.curves.weft[1][1]", "ascends"},
       {"\"20 N/m\"", "\"20 gf\"", 9, "material.fabric.law.curves.weft[0][1]", "wrong unit"},
       {"[[\"10 %\", \"100 N/m\"]]", "[]", 10, "material.fabric.law.curves.warp", "expected a list"},
       {"[[\"10 %\", \"100 N/m\"]]", "[[0.1]]", 10, "material.fabric.law.curves.warp[0]", "expected a pair"},
       {"\"60 N/m\"", "\"0 N/m\"", 11, "material.fabric.law.curves.shear", "> 0"},
       {"\"rigidity_weft\": 1e-5, ", "", 8, "material.fabric.law.curves.rigidity_weft", "required"},
       {"\"thickness\": 0.001", "\"thickness\": 0.001, \"young\": 1e5", 7, "material.fabric.young", "remove it"}});
}

}  // namespace
}  // namespace gambeson
