// Cases with fabrics whose law is a table.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "cases/structure/run.hpp"
#include "cases/wear/case/case.hpp"
#include "unit/cases/cloth/small_law.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// A strip that is drawn out; the first line below is line 1 of the file.
// clang-format off
const std::string strip = R"json({
  "kind": "static",
  "name": "strip",
  "sheet": {"plate": {"width": 0.2, "height": 0.05, "corner": [0, 0, 0], "axis_u": [1, 0, 0], "axis_v": [0, 1, 0]},
            "cells_u": 4, "cells_v": 2},
  "material": {"fabric": {
    "thickness": 0.001, "density": 400,
    FABRIC
  }},
  "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz", "move": [0.015, 0, 0.0]}],
  "solver": {"steps": 3},
  "output": {"shapes": "none", "edges": [{"name": "end", "edge": "u1"}]}
})json";
// clang-format on
const std::string by_moduli = R"("young_weft": 1e5, "young_warp": 1e5, "shear": 5e4, "jam_area": 0,
    "bending": {"law": "linear", "rigidity": 1e-5, "twist": 5e-6})";

std::string stripOf(const std::string& fabric) { return replaced(strip, "FABRIC", fabric); }

std::string inlined() { return "\"law\": {\"values\": " + small_law + "}"; }

nlohmann::json summaryOf(const StructureCase& c, const std::filesystem::path& out) {
  RunOptions options;
  options.out = out;
  options.threads = 1;
  runStructure(c, options);
  return nlohmann::json::parse(content(out / "summary.json"));
}

TEST(LawOfAFabric, AStripOfATableStretchesAsThatOfItsModuli) {
  const Folder folder;
  folder.write("law.json", small_law);
  const auto run = [&](const std::string& name, const std::string& fabric, const std::vector<std::string>& set = {}) {
    return summaryOf(readStructureCase(folder.write(name + ".json", stripOf(fabric)), set), folder.path() / name);
  };
  const auto table = run("table", R"("law": {"table": "law.json"})"), moduli = run("moduli", by_moduli);
  EXPECT_NEAR(table["edges"][0]["rx_N"].get<double>(), moduli["edges"][0]["rx_N"].get<double>(), 1e-9);
  EXPECT_NEAR(table["strain_energy_J"].get<double>(), moduli["strain_energy_J"].get<double>(),
              1e-8 * moduli["strain_energy_J"].get<double>());
  EXPECT_EQ(table["law_range"]["most_beyond"], 0);
  EXPECT_GT(table["law_range"]["points"], 0);
  EXPECT_FALSE(moduli.contains("law_range"));

  const auto beyond = run("beyond", R"("law": {"table": "law.json"})", {"supports[1].move=[0.03, 0, 0]"});
  EXPECT_GT(beyond["law_range"]["most_beyond"], 0);
  bool said = false;
  for (const auto& check : beyond["checks"]) said |= check["check"] == "Law range" && !check["holds"].get<bool>();
  EXPECT_TRUE(said);
  const std::string page = content(folder.path() / "beyond/report.html");
  EXPECT_NE(page.find("beyond the range of the law"), std::string::npos);
  EXPECT_NE(page.find("table of energy over strain"), std::string::npos);
}

TEST(LawOfAFabric, ItsFileIsPartOfTheCase) {
  const Folder folder;
  const std::filesystem::path law = folder.write("law.json", small_law);
  const std::filesystem::path file = folder.write("case.json", stripOf(R"("law": {"table": "law.json"})"));
  const StructureCase c = readStructureCase(file);
  const std::string before = caseIdentity(c);
  EXPECT_EQ(inputsOf(c).size(), 2u);
  // What is written holds the table, and is read without the file's content.
  const StructureCase again = readStructureCase(folder.write("again.json", writeCase(c)));
  EXPECT_EQ(writeCase(again), writeCase(c));
  EXPECT_EQ(caseIdentity(again), before);
  folder.write("law.json", replaced(small_law, "5e-6", "6e-6"));
  EXPECT_NE(caseIdentity(readStructureCase(file)), before);
  std::filesystem::remove(law);
  EXPECT_NO_THROW(readStructureCase(folder.write("inline.json", stripOf(inlined()))));
}

TEST(LawOfAFabric, OtherLawsBesideItAreRefused) {
  const std::string good = stripOf("\"name\": \"x\",\n    " + inlined());
  const std::string allowed = "\"name\": \"x\",";
  std::vector<Bad> bad;
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"young", "1e5"},
                                                        {"young_weft", "1e5"},
                                                        {"shear", "1e5"},
                                                        {"poisson", "0.3"},
                                                        {"jam_area", "0.5"},
                                                        {"shear_loop", "{\"hysteresis\": 1}"},
                                                        {"bending", "{\"law\": \"linear\", \"rigidity\": 1e-5}"}})
    bad.push_back({allowed, allowed + " \"" + key + "\": " + value + ",", 8, "material.fabric." + key, "remove it"});
  bad.push_back(
      {"\"cells_u\": 4", "\"model\": \"triangles\", \"cells_u\": 4", 5, "sheet.model", "allowed with it: \"nurbs\""});
  bad.push_back(
      {"\"cells_u\": 4", "\"model\": \"springs\", \"cells_u\": 4", 5, "sheet.model", "allowed with it: \"nurbs\""});
  bad.push_back({"\"cells_u\": 4", "\"cell_rule\": \"assumed\", \"cells_u\": 4", 5, "sheet.cell_rule", "automatic"});
  bad.push_back({"\"version\": 1", "\"version\": 3", 10, "material.fabric.law.values.version", "out of range"});
  expectRefused(good, bad);
  const Folder folder;
  EXPECT_THROW(readStructureCase(folder.write("none.json", stripOf("\"law\": {}"))), InputError);
  EXPECT_THROW(readStructureCase(folder.write("gone.json", stripOf(R"("law": {"table": "gone.json"})"))), InputError);
}

TEST(LawOfAFabric, WornClothHasTheRangeForItsLimit) {
  const Folder folder;
  const std::string moduli = R"("young": "1.2 MPa",
    "poisson": 0.3,
    "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"})";
  const std::string worn = replaced(example, moduli, inlined());
  const Case c = readCase(folder.write("case.json", worn));
  EXPECT_TRUE(c.fabric.energy);
  EXPECT_EQ(c.fabric.limit_strain_weft, 0.1);
  EXPECT_EQ(c.fabric.limit_strain_warp, 0.2);
  EXPECT_NEAR(c.fabric.young_weft_Pa, 1e5, 1e-4);
  EXPECT_EQ(writeCase(readCase(folder.write("again.json", writeCase(c)))), writeCase(c));
  try {
    readCase(folder.path() / "case.json", {"factors.thickness=2"});
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "factors.thickness");
  }
}

}  // namespace
}  // namespace gambeson
