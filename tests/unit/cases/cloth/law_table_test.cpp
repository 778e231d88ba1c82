// Files of law tables, and fabrics whose law is one.
#include "cases/cloth/law_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/structure/run.hpp"
#include "cases/wear/case/case.hpp"
#include "core/material/table/law_table.hpp"
#include "unit/cases/cloth/small_law.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"

namespace gambeson {
namespace {

TEST(LawFile, IsReadAsItWasWritten) {
  const Folder folder;
  LawFile law{tableOf({}, 5, 3), {}};
  law.provenance = {"hash", "weave 7", "Gambeson 1", "range 0.1", "", 1e-3, std::nullopt, 0.1 / 3, {}, 40};
  const std::filesystem::path file = folder.path() / "law.json";
  writeLawTable(file, law);
  EXPECT_EQ(readLawTable(file), law);
}

TEST(LawFile, LinearClothFromAFile) {
  const Folder folder;
  const LawFile law = readLawTable(folder.write("law.json", small_law));
  const SheetAnswer a = LawTable(law.table).at({{0.03, -0.02, 0.1}, {3, 0, -4}});
  EXPECT_NEAR(a.resultant[0], 3, 1e-12);
  EXPECT_NEAR(a.resultant[1], -2, 1e-12);
  EXPECT_NEAR(a.resultant[2], 5, 1e-12);
  EXPECT_NEAR(a.moment[2], -2e-5, 1e-18);
  EXPECT_EQ(law.provenance.cell_name, "weave 7");
}

TEST(LawFile, SaysWhereAFileIsNoTable) {
  const Folder folder;
  for (const Bad& bad : std::vector<Bad>{
           {"\"version\": 1", "\"version\": 2", 2, "version", "out of range"},
           {"\"J/m^2\"", "\"mJ/m^2\"", 3, "units.energy", "allowed: J/m^2"},
           {"\"N m\"", "\"gf cm\"", 3, "units.rigidity", "allowed: N m"},
           {"\"moment\": \"N\", ", "", 3, "units.moment", "required"},
           {"\"g12\": [0, 0.2],", "\"g12\": [0, 0.2], \"g21\": [0],", 6, "membrane.g21", "unknown key"},
           {"[-0.1, 0, 0.1]", "[-0.1, 0.1, 0]", 6, "membrane.e11", "must ascend"},
           {"[-0.1, 0, 0.2]", "[-0.6, 0, 0.2]", 6, "membrane.e22", "allowed: > -1/2"},
           {"\"energy\": [1, ", "\"energy\": [", 7, "membrane.energy", "allowed: 18"},
           {"\"energy\": [1, ", "\"energy\": [1e999, ", 7, "", ""},
           {"\"energy\": [1, ", "\"energy\": [\"NaN\", ", 7, "membrane.energy[0]", ""},
           {"5e-6, 0, 0, 0]", "5e-6, 0, 0]", 11, "bending.rigidity", "allowed: 6 for each node"},
           {"[1e-5, 1e-5,", "[1e-5, -1e-5,", 11, "bending.rigidity", "positive definite"},
           {"\"error_tension\": 0.001", "\"error_tension\": -1", 13, "provenance.error_tension", "out of range"}}) {
    SCOPED_TRACE(bad.from + " -> " + bad.to);
    const std::filesystem::path file = folder.write("law.json", replaced(small_law, bad.from, bad.to));
    try {
      readLawTable(file);
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, file.string()) << e.what();
      EXPECT_EQ(e.where().line, bad.line) << e.what();
      if (!bad.key.empty()) {
        EXPECT_EQ(e.where().key, bad.key) << e.what();
      }
      EXPECT_NE(e.reason().find(bad.reason), std::string::npos) << e.what();
    }
  }
}

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
  EXPECT_NE(page.find("beyond the table of the law"), std::string::npos);
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
