// Cases with fabrics whose law is curves: what they pull with, what is refused, and limits of stretch by name.
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
  EXPECT_EQ(checkOf(s, "Stretch along the weft"), "holds");
  const auto beyond = summaryOf(folder, "beyond", replaced(strip, "0.02, 0, 0.0", "0.03, 0, 0.0"));
  EXPECT_EQ(checkOf(beyond, "Law range"), "fails");
  EXPECT_EQ(checkOf(beyond, "Stretch along the weft"), "fails") << "the range is the limit";
  EXPECT_EQ(checkOf(beyond, "Stretch along the warp"), "holds");
}

TEST(LawOfCurves, PastACardsLimitARunFailsByName) {
  const Folder folder;
  const auto cardOf = [&](const std::string& limit) {
    folder.write("c.card.json",
                 R"({"name": "c", "source": "s", "weight": "400 g/m^2", "tensile": {"modulus": "900 N/m"}, )" + limit +
                     R"( "bending": {"B": "0.1 gf cm^2/cm"}})");
    const std::size_t from = strip.find("    \"thickness\""), to = strip.find("  }},\n  \"supports");
    return summaryOf(folder, "run", strip.substr(0, from) + "    \"card\": \"c.card.json\"\n" + strip.substr(to));
  };
  EXPECT_EQ(checkOf(cardOf(""), "Stretch along the weft"), "missing");
  EXPECT_EQ(checkOf(cardOf(R"("elongation": "12 %",)"), "Stretch along the weft"), "holds");
  EXPECT_EQ(checkOf(cardOf(R"("elongation": "8 %",)"), "Stretch along the weft"), "fails");
  EXPECT_EQ(checkOf(cardOf(R"("strength": "60 N/m",)"), "Stretch along the weft"), "fails");
  EXPECT_EQ(checkOf(cardOf(R"("strength": "200 N/m",)"), "Stretch along the weft"), "holds");
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
       {"\"thickness\": 0.001", "\"thickness\": 0.001, \"young\": 1e5", 7, "material.fabric.young", "remove it"},
       {"\"law\": {", "\"law\": {\"table\": \"law.json\", ", 8, "material.fabric.law.curves", "excludes"}});
}

}  // namespace
}  // namespace gambeson
