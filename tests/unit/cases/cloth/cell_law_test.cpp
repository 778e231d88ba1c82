// Cases with fabrics whose law is a cell of yarns, solved at every point.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <vector>

#include "cases/structure/run.hpp"
#include "cases/wear/case/case.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// A strip of four points a cell; the first line below is line 1 of the file.
// clang-format off
const std::string strip = R"json({
  "kind": "static",
  "name": "strip",
  "sheet": {"plate": {"width": 0.02, "height": 0.01, "corner": [0, 0, 0], "axis_u": [1, 0, 0], "axis_v": [0, 1, 0]},
            "cells_u": 2, "cells_v": 2, "degree": 2},
  "material": {"fabric": {
    "thickness": 0.00064, "density": 400,
    "law": LAW
  }},
  "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "x", "move": [0.0006, 0, 0], "program": "pull"},
               {"edge": "u1", "hold": "yz", "move": [0, 0.0004, 0.0005], "program": "aside"}],
  "programs": {"pull": [[0, 0], [0.5, 1], [1, 1]], "aside": [[0, 0], [0.5, 0], [1, 1]]},
  "solver": {"steps": 2},
  "output": {"shapes": "none", "edges": [{"name": "end", "edge": "u1"}]}
})json";
/// That of cases/library/cell_spun.json, on coarser rods.
const std::string spun = R"json({
  "kind": "cell",
  "name": "spun",
  "description": "coarse",
  "weave": {"pattern": "plain"},
  "weft": {"spacing": "1 mm", "amplitude": "0.16 mm", "half_width": "0.24 mm", "half_thickness": "0.16 mm",
           "section": {"stretch": "1 kN", "shear_across": "50 N", "shear_through": "40 N",
                       "torsion": 1e-6, "bending_through": 3e-6, "bending_in_plane": 5e-6}},
  "compression": {"half_force": "10 N", "exponent": 3},
  "loads": [{"name": "pull", "biaxial": {"extension": 0.05}}],
  "solver": {"pieces_per_spacing": 8}
})json";
// clang-format on
const std::string by_cell = R"({"cell": "spun.json"})";

std::string stripOf(const std::string& law) { return replaced(strip, "LAW", law); }

void runTo(const std::filesystem::path& out, const StructureCase& c, int threads = 1) {
  RunOptions options;
  options.out = out;
  options.threads = threads;
  runStructure(c, options);
}

TEST(CellLaw, ThreadsChangeNoBitAndARunIsRepeatedFromItsOwnCase) {
  const Folder folder;
  const std::filesystem::path file = folder.write("spun.json", spun);
  const StructureCase c = readStructureCase(folder.write("case.json", stripOf(by_cell)), {"output.shapes=last"});
  runTo(folder.path() / "one", c, 1);
  runTo(folder.path() / "two", c, 2);
  const std::string path = content(folder.path() / "one/path.csv"), shape = content(folder.path() / "one/shape.csv");
  EXPECT_EQ(content(folder.path() / "two/path.csv"), path);
  EXPECT_EQ(content(folder.path() / "two/shape.csv"), shape);
  // What a run keeps of the cell is enough, whatever has become of its file.
  folder.write("spun.json", "{}");
  runTo(folder.path() / "again", readStructureCase(folder.path() / "one/case.json"));
  EXPECT_EQ(content(folder.path() / "again/path.csv"), path);
  std::filesystem::remove(file);
  EXPECT_EQ(writeCase(readRecordedStructureCase(folder.path() / "one/case.json")), writeCase(c));
}

TEST(CellLaw, APointWhoseCellFindsNoEquilibriumIsNamed) {
  const Folder folder;
  folder.write("spun.json", spun);
  const StructureCase c =
      readStructureCase(folder.write("case.json", replaced(stripOf(by_cell), "[0.0006, 0, 0]", "[0.012, 0, 0]")));
  try {
    runTo(folder.path() / "out", c);
    ADD_FAILURE() << "reached its end";
  } catch (const RunError& e) {
    const std::string said = e.what();
    EXPECT_NE(said.find("points find no answer of their law, the first in patch 0 at "), std::string::npos) << said;
    EXPECT_NE(said.find("E11 = "), std::string::npos) << said;
  }
}

TEST(CellLaw, ItsFileIsPartOfTheCase) {
  const Folder folder;
  folder.write("spun.json", spun);
  const std::filesystem::path file = folder.write("case.json", stripOf(by_cell));
  const StructureCase c = readStructureCase(file);
  EXPECT_EQ(inputsOf(c).size(), 2u);
  const std::string before = caseIdentity(c);
  EXPECT_EQ(caseIdentity(readStructureCase(folder.write("again.json", writeCase(c)))), before);
  folder.write("spun.json", replaced(spun, "\"10 N\"", "\"11 N\""));
  EXPECT_NE(caseIdentity(readStructureCase(file)), before);
}

TEST(CellLaw, WhatDoesNotCarryCellsSaysSo) {
  const Folder folder;
  const std::string good = stripOf("{\"yarns\": " + replaced(spun, "\"kind\": \"cell\",\n", "\n") + "}");
  const std::string law = "material.fabric.law.yarns";
  expectRefused(
      good,
      {{"\"cells_u\": 2", "\"model\": \"triangles\", \"cells_u\": 2", 5, "sheet.model", "allowed with it: \"nurbs\""},
       {"\"cells_u\": 2", "\"model\": \"springs\", \"cells_u\": 2", 5, "sheet.model", "allowed with it: \"nurbs\""},
       {"\"cells_u\": 2", "\"model\": \"shell\", \"cells_u\": 2", 5, "sheet.model", "allowed with it: \"nurbs\""},
       {"\"density\": 400,", "\"density\": 400, \"young\": 1,", 7, "material.fabric.young", "remove it"},
       {"{\"yarns\": {", "{\"table\": \"x\", \"yarns\": {", 8, "material.fabric.law.table", ""},
       {"\"compression\"", "\"faces\": \"held\", \"compression\"", 16, law + ".faces", "must be glide"},
       {"\"compression\"", "\"friction\": {\"coefficient\": 0.3}, \"compression\"", 16, law + ".friction",
        "no friction"},
       {"\"compression\"", "\"compresion\"", 16, law + ".compresion", "did you mean"},
       {"\"pieces_per_spacing\": 8", "\"pieces_per_spacing\": 9", 18, law + ".solver.pieces_per_spacing", "is odd"},
       {"\"0.24 mm\"", "\"0.6 mm\"", 13, law + ".weft.half_width", "must be"}});
  // Explicit and implicit motion, and worn cloth.
  const std::string moving = replaced(replaced(good, "\"kind\": \"static\"", "\"kind\": \"dynamic\""), "\"steps\": 2",
                                      "\"step\": 0.01, \"end\": 0.1");
  const std::string worn_law = "\"law\": {\"yarns\": " + replaced(spun, "\"kind\": \"cell\",\n", "\n") + "}";
  const std::string worn = replaced(example, R"("young": "1.2 MPa",
    "poisson": 0.3,
    "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"})",
                                    worn_law);
  const std::string modal = replaced(
      replaced(replaced(good, "\"kind\": \"static\"", "\"kind\": \"modal\""), "\"solver\": {\"steps\": 2},", ""),
      ", \"edges\": [{\"name\": \"end\", \"edge\": \"u1\"}]", "");
  for (const std::string& text : {moving, worn, modal}) {
    try {
      readAnyCase(folder.write("case.json", text));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_TRUE(e.where().key.ends_with("fabric.law.yarns")) << e.what();
      EXPECT_NE(e.reason().find("\"table\", which gambeson homogenise makes"), std::string::npos) << e.what();
    }
  }
  // Files: what is no cell, and what of a cell's file is wrong is said there.
  folder.write("spun.json", spun);
  folder.write("other.json", stripOf(by_cell));
  folder.write("truss.json", replaced(spun, R"("solver": {"pieces_per_spacing": 8})", R"("yarns": "truss")"));
  for (const auto& [named, key, reason] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"other.json", "kind", "allowed: cell"},
           {"truss.json", "yarns", "allowed where a fabric's law is a cell: rod"},
           {"none.json", "material.fabric.law.cell", ""}})
    try {
      readAnyCase(folder.write("case.json", stripOf("{\"cell\": \"" + named + "\"}")));
      ADD_FAILURE() << "accepted " << named;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
      EXPECT_NE(e.reason().find(reason), std::string::npos) << e.what();
    }
  folder.write("spun.json", replaced(spun, "\"10 N\"", "\"-1 N\""));
  try {
    readAnyCase(folder.write("case.json", stripOf(by_cell)));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, (folder.path() / "spun.json").string());
    EXPECT_EQ(e.where().line, 9);
    EXPECT_EQ(e.where().key, "compression.half_force");
  }
}

}  // namespace
}  // namespace gambeson
