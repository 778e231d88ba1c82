/// What the pages of structures say of their own numbers: checks, failing ones at the top; what a path by arc length
/// went by.

#include "cases/structure/checks.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cases/structure/run.hpp"
#include "core/error.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";

struct Ran {
  nlohmann::json summary;
  std::string page, error;
  /// Names of the checks that fail, in their order.
  std::string failing() const {
    std::string names;
    for (const auto& k : summary.at("checks"))
      if (!k.at("holds").get<bool>()) names += (names.empty() ? "" : ", ") + k.at("check").get<std::string>();
    return names;
  }
};

Ran ranOf(const std::string& name, std::vector<std::string> changes) {
  const Folder folder;
  changes.emplace_back("output.pictures=[]");
  changes.emplace_back("output.shapes=none");
  Ran r;
  try {
    runStructure(readStructureCase(library / (name + ".json"), changes), {.out = folder.path() / "out", .threads = 1});
  } catch (const RunError& e) {
    r.error = e.what();
  }
  r.summary = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  r.page = content(folder.path() / "out/report.html");
  return r;
}

/// The shipped cases meet all their checks, and say so where the reader asks why to trust them.
TEST(StructureChecks, TheLibrarysCasesMeetTheirs) {
  for (const auto& [name, changes] :
       std::vector<std::pair<std::string, std::vector<std::string>>>{{"cantilever", {}},
                                                                     {"roll_up", {}},
                                                                     {"hinged_roof", {}},
                                                                     {"plate_modes", {}},
                                                                     {"man_plate", {}},
                                                                     {"man_roll_up", {}},
                                                                     {"flag_dynamic", {"solver.end=0.1 s"}}}) {
    const Ran r = ranOf(name, changes);
    EXPECT_EQ(r.error, "") << name;
    EXPECT_EQ(r.failing(), "") << name;
    EXPECT_GE(r.summary.at("checks").size(), 2u) << name;
    EXPECT_NE(r.page.find("Why to trust these numbers"), std::string::npos) << name;
    EXPECT_EQ(r.page.find("class=\"alarm\""), std::string::npos) << name;
  }
}

/// A load a billion times too large: a linear solution knows no better, so the page says it above its headline.
TEST(StructureChecks, AHugeLinearSolutionIsNoResult) {
  const Ran r = ranOf("cantilever",
                      {"sheet.cells_u=4", R"(solver={"linear":true})", R"(loads=[{"edge":"u1","force":[0,0,1e9]}])"});
  EXPECT_EQ(r.error, "");
  EXPECT_EQ(r.failing(), "Strain, Size");
  const std::size_t alarm = r.page.find("class=\"alarm\""), headline = r.page.find("class=\"headline");
  ASSERT_NE(alarm, std::string::npos);
  EXPECT_LT(alarm, headline);
  EXPECT_NE(r.page.find("times the sheet"), std::string::npos);
}

TEST(StructureChecks, WhatMovesFartherThanItCanIsNoResult) {
  const Ran r = ranOf("flag_dynamic",
                      {"sheet.cells_u=6", "sheet.cells_v=6", "solver.end=0.1 s", R"(loads=[{"gravity":[0,0,-1e9]}])"});
  EXPECT_NE(r.failing().find("Strain"), std::string::npos) << r.failing();
  EXPECT_NE(r.failing().find("Size"), std::string::npos) << r.failing();
}

/// Numbers that are not finite fail the run, after what there is was written.
TEST(StructureChecks, WhatIsNotFiniteFailsTheRun) {
  const StructureCase c = readStructureCase(library / "cantilever.json", {"sheet.cells_u=4", "sheet.cells_v=1"});
  const StructureModel model = buildModel(c);
  const PlaceMesh mesh = model.structure->cloth->placeMesh(1);
  const MeasuredState rest = measureStatic(
      *model.structure, std::vector<double>(static_cast<std::size_t>(model.structure->dofs.unknowns())), 0, false);
  PathTable path{{"factor", "residual"}, {{0, 0}, {1, 1e-9}}};
  const auto checks = [&] { return structureChecks(c, model, path, {}, rest, shapeOf(model, mesh, rest), {}); };
  for (const AuditCheck& k : checks()) EXPECT_TRUE(k.holds()) << k.name;
  path.rows[1][1] = 1e-3;
  EXPECT_FALSE(checks()[1].holds());
  path.rows[1][1] = std::nan("");
  EXPECT_EQ(checks()[0].value, 1);
  EXPECT_FALSE(checks()[0].holds());
  EXPECT_FALSE(checks()[1].holds());  // nor is NaN a residual
}

/// Energy that appears is seen, energy that is damped away is none.
TEST(StructureChecks, EnergyThatAppearsIsSeen) {
  const StructureCase c = readStructureCase(library / "flag_dynamic.json", {"sheet.cells_u=4", "sheet.cells_v=4"});
  const StructureModel model = buildModel(c);
  const PlaceMesh mesh = model.structure->cloth->placeMesh(1);
  MeasuredState rest;
  rest.q = model.structure->cloth->rest();
  PathTable path{{"time_s", "kinetic_energy_J", "strain_energy_J", "external_energy_J", "total_energy_J"},
                 {{0, 0, 0, 0, 0}, {1, 6, 1, -10, -3}, {2, 7, 1, -11, -3}}};
  const auto energy = [&] {
    for (const AuditCheck& k : structureChecks(c, model, path, {}, rest, shapeOf(model, mesh, rest), {}))
      if (k.name == "Energy") return k;
    return AuditCheck{};
  };
  EXPECT_TRUE(energy().holds());
  EXPECT_EQ(energy().value, 0);
  path.rows.push_back({3, 9, 1, -11, -1});  // 2 of 21
  EXPECT_NEAR(energy().value, 200. / 21, 1e-9);
  EXPECT_FALSE(energy().holds());
}

/// The page of an arc length path names the limit points that it went by.
TEST(StructureChecks, ThePageSaysWhatThePathPassed) {
  const Ran r = ranOf("hinged_roof", {"sheet.cells_u=4", "sheet.cells_v=4"});
  const auto& arc = r.summary.at("arc_length");
  ASSERT_EQ(arc.at("limit_points").size(), 2u);  // 0.742 and 0.173, Sze 2004, section 3.8
  EXPECT_NEAR(arc.at("limit_points")[0].get<double>(), 0.742, 0.02);
  EXPECT_NEAR(arc.at("limit_points")[1].get<double>(), 0.173, 0.02);
  EXPECT_TRUE(arc.at("bifurcations").empty() && arc.at("unknown_before").empty());
  EXPECT_NE(r.page.find("What the path passed"), std::string::npos);
  // A first step of the whole load is cut to what the path allows, and passes the same.
  const Ran coarse = ranOf("hinged_roof", {"sheet.cells_u=4", "sheet.cells_v=4", "solver.steps=1"});
  EXPECT_EQ(coarse.summary.at("arc_length").at("limit_points").size(), 2u);
  EXPECT_EQ(coarse.failing(), "");
}

/// The roof of the library on a finer mesh: unloaded it rests, to the rounding of its coordinates.
TEST(StructureChecks, RefiningTheRoofLeavesItsStartAtRest) {
  for (const int cells : {14, 16})
    for (const char* solver : {R"(solver={"steps":40})", R"(solver={"steps":40,"arc_length":true,"max_points":1})"}) {
      const Ran r =
          ranOf("hinged_roof", {"sheet.cells_u=" + std::to_string(cells), "sheet.cells_v=" + std::to_string(cells),
                                solver, "loads[0].force=[0,0,-20]"});
      EXPECT_EQ(r.error.find("not in equilibrium"), std::string::npos) << cells << ": " << r.error;
    }
}

}  // namespace
}  // namespace gambeson
