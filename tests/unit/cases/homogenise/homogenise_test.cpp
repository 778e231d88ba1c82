#include "cases/homogenise/homogenise.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cases/cell/engine.hpp"
#include "cases/cloth/law_table.hpp"
#include "core/error.hpp"
#include "core/material/table/law_table.hpp"
#include "unit/cases/cell/example.hpp"
#include "unit/cases/content.hpp"

namespace gambeson {
namespace {

HomogeniseArguments quick(const Folder& folder) {
  HomogeniseArguments a;
  a.file = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library/cell_spun.json";
  a.law = folder.path() / "law.json";
  a.e11 = a.e22 = {0, 0.02};
  a.e12 = {0, 0.02};
  a.tension_error = a.shear_error = 0.2;
  a.rigidity_at_rest = true;
  return a;
}

/// The file is a law that says what the cell does: at a node, and between nodes within the error asked for.
TEST(Homogenise, TheLawIsThatOfTheCell) {
  const Folder folder;
  const HomogeniseArguments a = quick(folder);
  std::ostringstream out;
  EXPECT_EQ(homogeniseCell(a, out), 0);
  EXPECT_NE(out.str().find("Estimated errors"), std::string::npos);
  const LawFile law = readLawTable(a.law);
  const CellCase c = readCellCase(a.file, a.overrides);
  EXPECT_EQ(law.provenance.cell, caseIdentity(c));
  EXPECT_EQ(law.provenance.cell_name, "Plain weave of spun yarns");
  EXPECT_LE(*law.provenance.error_tension, 0.2);
  EXPECT_GT(law.provenance.compared_at, 0);
  const LawTable table(law.table);
  const auto engine = makeEngine(c);
  const auto cell = [&](double e11, double e22) {
    return engine->specimen()->bring({{e11, e22, 0, 0, 0}, {}}).point.resultants;
  };
  const double largest = cell(0.02, 0.02).n22;
  for (const double e : {0.02, 0.013}) {
    const CellResultants n = cell(e, 0.008);
    EXPECT_NEAR(table.at({{e, 0.008, 0}, {}}).resultant[0], n.n11, 0.2 * largest) << e;
  }
  // Once more, to the same bytes.
  const std::string first = content(a.law);
  homogeniseCell(a, out);
  EXPECT_EQ(content(a.law), first);
}

TEST(Homogenise, WhatItRefuses) {
  const Folder folder;
  std::ostringstream out;
  const auto refused = [&](const HomogeniseArguments& a, const std::string& key) {
    try {
      homogeniseCell(a, out);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
    }
    EXPECT_FALSE(std::filesystem::exists(a.law)) << key;
  };
  HomogeniseArguments a = quick(folder);
  a.e11 = {0.01, 0.02};
  refused(a, "--e11");
  a = quick(folder);
  a.e12 = {0, 0.7};
  refused(a, "--e12");
  a = quick(folder);
  a.overrides = {"yarns=truss", "loads=[]"};
  refused(a, "yarns");
  a = quick(folder);
  a.file = folder.write("cell.json", cell_example);
  a.law = a.file;
  EXPECT_THROW(homogeniseCell(a, out), InputError) << "the case itself";
}

/// Yarns that hardly resist torsion and touch lightly catch on sections where there are few; with more the table is
/// made, and its provenance is of the case with these.
TEST(Homogenise, LooseCellsTakeMorePieces) {
  const Folder folder;
  HomogeniseArguments a = quick(folder);
  a.file = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library/cell_plain.json";
  a.e11 = a.e22 = {-0.01, 0.01};
  a.e12 = {0, 0.05};
  std::ostringstream out;
  EXPECT_EQ(homogeniseCell(a, out), 0);
  const CellCase given = readCellCase(a.file), finer = readCellCase(a.file, {"solver.pieces_per_spacing=32"});
  EXPECT_EQ(given.solver.pieces_per_spacing, 16);
  EXPECT_EQ(readLawTable(a.law).provenance.cell, caseIdentity(finer));
}

/// Errors that cannot be reached are said, and the table is there with its own.
TEST(Homogenise, ErrorsThatAreNotReached) {
  const Folder folder;
  HomogeniseArguments a = quick(folder);
  a.tension_error = a.shear_error = 1e-6;
  a.most_nodes = 100;
  std::ostringstream out;
  EXPECT_THROW(homogeniseCell(a, out), RunError);
  EXPECT_GT(*readLawTable(a.law).provenance.error_tension, 1e-6);
}

}  // namespace
}  // namespace gambeson
