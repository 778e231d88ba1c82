// A structure that is stretched past what the card of its fabric allows fails a check that names the card.
#include "cases/structure/stretch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/structure/run.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

const std::string card_of_strip = R"json({
  "name": "Limited cloth", "source": "made up for a test", "description": "what no laboratory measured",
  "weight": "200 g/m^2",
  "tensile": {"modulus_weft": "4000 N/m", "modulus_warp": "2000 N/m"},
  "shear": {"G": "50 N/(m rad)"}, "bending": {"B": "1e-5 N m"},
  "elongation_weft": "4 %", "elongation_warp": "9 %"
})json";

/// Held at one end and pulled by a part of its length at the other; it keeps its width.
const std::string pulled_strip = R"json({
  "kind": "static", "name": "strip",
  "sheet": {"plate": {"width": 0.2, "height": 0.05}, "cells_u": 4, "cells_v": 2, "weft_angle": "ANGLE deg"},
  "material": {"fabric": {"card": "limited.card.json"}},
  "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz", "move": [PULL, 0, 0]},
               {"edge": "v0", "hold": "yz"}, {"edge": "v1", "hold": "yz"}],
  "solver": {"steps": 2},
  "output": {"shapes": "none"}
})json";

struct PulledStrip {
  nlohmann::json checks;
  std::string page;

  const nlohmann::json* check(const std::string& name) const {
    for (const auto& k : checks)
      if (k.at("check") == name) return &k;
    return nullptr;
  }
};

PulledStrip pulledBy(double part, const char* angle, const std::vector<std::string>& set = {}) {
  const Folder folder;
  folder.write("limited.card.json", card_of_strip);
  const std::string text = replaced(replaced(pulled_strip, "ANGLE", angle), "PULL", std::to_string(0.2 * part));
  RunOptions options;
  options.out = folder.path() / "out";
  options.threads = 1;
  EXPECT_EQ(runStructure(readStructureCase(folder.write("strip.json", text), set), options), 0);
  return {nlohmann::json::parse(content(options.out / "summary.json")).at("checks"),
          content(options.out / "report.html")};
}

const std::string along_weft = "Stretch along the weft, Limited cloth (card limited.card.json)",
                  along_warp = "Stretch along the warp, Limited cloth (card limited.card.json)";

TEST(StructureStretch, PastTheCardsLimitACheckFailsByName) {
  for (const auto& [part, angle, name, limit] :
       {std::tuple(0.05, "0", along_weft, 0.04), std::tuple(0.1, "90", along_warp, 0.09)}) {
    const PulledStrip past = pulledBy(part, angle);
    ASSERT_TRUE(past.check(name)) << past.checks;
    EXPECT_FALSE(past.check(name)->at("holds").get<bool>());
    EXPECT_NEAR(past.check(name)->at("value").get<double>(), 100 * (part + part * part / 2), 1e-6);
    EXPECT_NEAR(past.check(name)->at("limit").get<double>(), 100 * (limit + limit * limit / 2), 1e-9);
    EXPECT_NE(past.page.find("Limited cloth (card limited.card.json) is stretched by"), std::string::npos);
    const PulledStrip within = pulledBy(0.9 * limit, angle);
    EXPECT_TRUE(within.check(name)->at("holds").get<bool>());
    EXPECT_EQ(within.page.find("is stretched by"), std::string::npos);
  }
}

TEST(StructureStretch, TheOtherDirectionAndCasesWithoutLimitsAreLeftAlone) {
  const PulledStrip past = pulledBy(0.05, "0");
  EXPECT_TRUE(past.check(along_warp)->at("holds").get<bool>());
  // The case's own limit goes before the card's; what was written out is read again with it.
  const PulledStrip own = pulledBy(0.05, "0", {"material.fabric.limit_strain_weft=0.2"});
  EXPECT_TRUE(own.check(along_weft)->at("holds").get<bool>());
  EXPECT_NEAR(own.check(along_weft)->at("limit").get<double>(), 20, 1e-12);
}

// What is written out has the limits, and no need of the card any more.
TEST(StructureStretch, LimitsArePartOfTheCase) {
  const Folder folder;
  folder.write("limited.card.json", card_of_strip);
  const StructureCase c =
      readStructureCase(folder.write("strip.json", replaced(replaced(pulled_strip, "ANGLE", "0"), "PULL", "0.001")));
  const StructureCase again = readRecordedStructureCase(folder.write("case.json", writeCase(c)));
  EXPECT_DOUBLE_EQ(*again.material.limit_strain_weft, 0.04 + 0.0008);
  EXPECT_DOUBLE_EQ(*again.material.limit_strain_warp, 0.09 + 0.00405);
  EXPECT_EQ(writeCase(again), writeCase(c));
}

}  // namespace
}  // namespace gambeson
