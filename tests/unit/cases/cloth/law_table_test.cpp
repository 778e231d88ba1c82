// Files of law tables.
#include "cases/cloth/law_table.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cases/cloth/fabric_input.hpp"
#include "cases/cloth/fields.hpp"
#include "core/error.hpp"
#include "core/material/table/law_table.hpp"
#include "unit/cases/cloth/small_law.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"

namespace gambeson {
namespace {

TEST(LawFile, IsReadAsItWasWritten) {
  const Folder folder;
  LawFile law{tableOf({}, 5, 3), {}, {}};
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

/// The fabric that a text of a file says.
FabricCase fabricOf(const Folder& folder, const std::string& text) {
  const std::filesystem::path file = folder.write("fabric.json", text);
  const JsonNode root = readJson(file);
  const std::string name = file.string();
  const schema::Entry entry{root, "", name};
  schema::FabricInput in;
  schema::readObject(schema::fabricTable(), entry, &in);
  return schema::resolveFabric(entry, in);
}

TEST(LawFile, AFabricHasItsLawAndTheModuliAtRest) {
  const Folder folder;
  folder.write("law.json", small_law);
  const FabricCase f = fabricOf(
      folder, R"({"thickness": 0.001, "density": 400, "limit_strain_warp": 0.05, "law": {"table": "law.json"}})");
  ASSERT_TRUE(f.energy);
  EXPECT_NEAR(f.energy->at({{0.01, 0, 0}, {}}).resultant[0], 1, 1e-12);
  EXPECT_NEAR(f.young_weft_Pa, 1e5, 1e-6);
  EXPECT_NEAR(f.shear_Pa, 5e4, 1e-6);
  EXPECT_NEAR(f.poisson, 0, 1e-12);
  EXPECT_EQ(f.jam_area, 0);
  EXPECT_EQ(givenRigidities(f.law)->twist_Nm, 5e-6);
  EXPECT_EQ(f.limit_strain_weft, 0.1) << "the table's range";
  EXPECT_EQ(f.limit_strain_warp, 0.05);
  // Written out it needs the file's content no more.
  const schema::FabricInput in = schema::restoreFabric(f);
  const std::string text = schema::toText(schema::writeObject(schema::fabricTable(), &in));
  folder.write("law.json", "{}");
  const FabricCase again = fabricOf(folder, text);
  EXPECT_EQ(again.energy_source->table(), f.energy_source->table());
  const schema::FabricInput both = schema::restoreFabric(again);
  EXPECT_EQ(schema::toText(schema::writeObject(schema::fabricTable(), &both)), text);
  EXPECT_NE(schema::lawInWords(*f.energy_source).find("weave 7"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
