/// Runs of structures from file to results, against closed forms.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cases/structure/run.hpp"
#include "core/error.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/structure/example.hpp"

namespace gambeson {
namespace {

const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";

/// Runs and gives path.csv by columns.
std::map<std::string, std::vector<double>> runTable(const StructureCase& c, const std::filesystem::path& out,
                                                    int threads = 1) {
  RunOptions options;
  options.out = out;
  options.threads = threads;
  runStructure(c, options);
  std::istringstream lines(content(out / "path.csv"));
  std::string line, cell;
  std::getline(lines, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::map<std::string, std::vector<double>> table;
  while (std::getline(lines, line)) {
    std::size_t k = 0;
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) table[names[k++]].push_back(std::stod(cell));
  }
  return table;
}

const std::vector<std::string> no_shapes{"output.shapes=none", "output.pictures=[]"};

std::vector<std::string> with(std::vector<std::string> more) {
  more.insert(more.end(), no_shapes.begin(), no_shapes.end());
  return more;
}

std::vector<std::vector<double>> rowsOf(const std::filesystem::path& csv) {
  std::istringstream lines(content(csv));
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

/// A disc of nine points: at the four corners of its patch the edges run on in one line, and the surface has no area.
TEST(StructureRun, ADiscOfNinePointsHasStressAtItsCorners) {
  const Folder folder;
  const auto file = folder.write("disc.json", R"json({"kind": "static", "name": "disc",
    "sheet": {"nurbs": {"patches": [{"degree": [2, 2], "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
      "points": [[-0.07071067811865477, -0.07071067811865477, 0], [0, -0.1414213562373095, 0],
                 [0.07071067811865477, -0.07071067811865477, 0], [-0.1414213562373095, 0, 0], [0, 0, 0],
                 [0.1414213562373095, 0, 0], [-0.07071067811865477, 0.07071067811865477, 0],
                 [0, 0.1414213562373095, 0], [0.07071067811865477, 0.07071067811865477, 0]],
      "weights": [1, 0.7071067811865476, 1, 0.7071067811865476, 1, 0.7071067811865476, 1, 0.7071067811865476, 1]}]},
      "degree": 3, "split": 4},
    "material": {"isotropic": {"young": "1 GPa", "poisson": 0.3, "thickness": "1 mm"}},
    "supports": [{"edge": "u0", "hold": "z"}, {"edge": "u1", "hold": "z"}, {"edge": "v0", "hold": "z"},
                 {"edge": "v1", "hold": "z"}, {"point": [0.5, 0.5], "hold": "xy"}, {"point": [0, 0.5], "hold": "y"}],
    "loads": [{"edge": "u0", "moment_per_length": 0.001}, {"edge": "u1", "moment_per_length": 0.001},
              {"edge": "v0", "moment_per_length": 0.001}, {"edge": "v1", "moment_per_length": 0.001}],
    "solver": {"linear": true},
    "output": {"points": [{"name": "corner", "point": [0, 0]}, {"name": "centre", "point": [0.5, 0.5]}],
               "shapes": "none", "pictures": []}})json");
  const auto t = runTable(readStructureCase(file), folder.path() / "out");
  for (const char* column : {"corner_n1_N_per_m", "corner_e1"})
    EXPECT_TRUE(std::isfinite(t.at(column).back())) << column;
  for (const auto& row : rowsOf(folder.path() / "out/shape.csv"))
    for (const double x : row) EXPECT_TRUE(std::isfinite(x));
}

/// Half a cylinder whose weft, along its middle, stands across it at both ends.
TEST(StructureRun, AWeftAcrossTheSheetAtAnEdgeDoesNotEndTheProgram) {
  const std::string arch = R"json({"kind": "static", "name": "arch",
    "sheet": {"nurbs": {"patches": [{"degree": [2, 1], "knots_u": [0, 0, 0, 0.5, 0.5, 1, 1, 1], "knots_v": [0, 0, 1, 1],
      "points": [[-1, 0, 0], [-1, 0, 1], [0, 0, 1], [1, 0, 1], [1, 0, 0],
                 [-1, 1, 0], [-1, 1, 1], [0, 1, 1], [1, 1, 1], [1, 1, 0]],
      "weights": [1, 0.7071067811865476, 1, 0.7071067811865476, 1, 1, 0.7071067811865476, 1, 0.7071067811865476, 1]}]},
      "degree": 2, "split": 3, "weft": [1, 0, 0]},
    "material": {"isotropic": {"young": "1 GPa", "poisson": 0.3, "thickness": "1 cm"}},
    "supports": [{"edge": "u0", "hold": "xyz"}, {"edge": "u1", "hold": "xyz"}],
    "loads": [{"force_per_area": [0, 0, -10]}], "solver": {"linear": true},
    "output": {"shapes": "none", "pictures": []}})json";
  for (const char degree : {'2', '3'}) {
    const Folder folder;
    std::string text = arch;
    text[text.find("\"degree\": 2,") + 10] = degree;
    const auto file = folder.write("arch.json", text);
    runTable(readStructureCase(file), folder.path() / "out");
    for (const auto& row : rowsOf(folder.path() / "out/shape.csv"))
      for (const double x : row) EXPECT_TRUE(std::isfinite(x)) << degree;
  }
}

/// The inextensible elastica at P L^2/(E I) = 2 and 4 (theta'' = -(P L^2/EI) cos theta, DOP853 to 1e-12): the strip
/// itself stretches by 3e-5. Its root carries force and moment.
TEST(StructureRun, CantileverFollowsTheElastica) {
  const Folder folder;
  auto t = runTable(readStructureCase(library / "cantilever.json", no_shapes), folder.path() / "out");
  ASSERT_EQ(t["factor"].size(), 21u);
  EXPECT_NEAR(t["tip_ux_m"][10], -1.60642, 1e-4 * 3.3);
  EXPECT_NEAR(t["tip_uz_m"][10], 4.93457, 1e-4 * 6.7);
  EXPECT_NEAR(t["tip_ux_m"][20], -3.28941, 1e-4 * 3.3);
  EXPECT_NEAR(t["tip_uz_m"][20], 6.69964, 1e-4 * 6.7);
  EXPECT_NEAR(t["root_rz_N"][20], -4, 1e-6);
  // The moment about the root's middle balances the force at its current arm.
  EXPECT_NEAR(t["root_my_Nm"][20], 4 * (10 + t["tip_ux_m"][20]), 1e-4);
  const auto s = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  EXPECT_EQ(s.at("points")[0].at("uz_m").get<double>(), t["tip_uz_m"][20]);
  EXPECT_TRUE(s.at("finished").get<bool>());
}

/// The same bits for any run and any number of threads.
TEST(StructureRun, TwiceTheSameBits) {
  const Folder folder;
  const StructureCase c = readStructureCase(library / "cantilever.json", with({"solver.steps=4"}));
  runTable(c, folder.path() / "a");
  runTable(c, folder.path() / "b", 2);
  for (const char* file : {"path.csv", "shape.csv"})
    EXPECT_EQ(content(folder.path() / "a" / file), content(folder.path() / "b" / file)) << file;
}

/// w = F L^3/(3 E I) (linear, poisson 0), energy F w/2, reactions of the linear problem.
TEST(StructureRun, LinearCantilever) {
  const Folder folder;
  auto t = runTable(readStructureCase(library / "cantilever.json", with({"solver={\"linear\":true}"})),
                    folder.path() / "out");
  const double w = 4 * 1000 / (3 * 1.2e6 * 1e-3 / 12);
  EXPECT_NEAR(t["tip_uz_m"].back(), w, 1e-6 * w);
  EXPECT_NEAR(t["strain_energy_J"].back(), 4 * w / 2, 1e-6 * w);
  EXPECT_NEAR(t["root_rz_N"].back(), -4, 1e-7);
  EXPECT_NEAR(t["root_my_Nm"].back(), 40, 1e-6);
}

/// A moved end: the force on it is that of the same displacement under a load.
TEST(StructureRun, MovedSupportPushes) {
  const Folder folder;
  const StructureCase c = readStructureCase(
      library / "cantilever.json", with({R"(supports[1]={"edge":"u1","hold":"z","move":[0,0,6.699736746]})", "loads=[]",
                                         R"(output.edges[1]={"name":"end","edge":"u1"})"}));
  auto t = runTable(c, folder.path() / "out");
  EXPECT_NEAR(t["end_rz_N"].back(), 4, 1e-5);
  EXPECT_NEAR(t["root_rz_N"].back(), -4, 1e-5);
}

/// The middle of a plate, a quarter of it with symmetry on two edges: under a load no support acts there; moved, the
/// support's force is that load, symmetry's ties and all.
TEST(StructureRun, AMovedPointPushesAcrossSymmetry) {
  const Folder folder;
  const std::string plate = R"({"kind": "static", "name": "quarter",
    "sheet": {"plate": {"width": 1, "height": 1}, "degree": 3, "cells_u": 4, "cells_v": 4},
    "material": {"isotropic": {"young": 1e6, "poisson": 0.3, "thickness": 0.05}},
    "supports": [{"edge": "u1", "hold": "xyz"}, {"edge": "v1", "hold": "xyz"},
                 {"edge": "u0", "symmetry": [1, 0, 0]}, {"edge": "v0", "symmetry": [0, 1, 0]} MORE],
    "loads": [LOAD], "solver": {"steps": 2},
    "output": {"points": [{"name": "middle", "corner": "u0v0"}], "shapes": "none"}})";
  const auto run = [&](const char* name, const std::string& more, const std::string& load) {
    std::string text = plate;
    text.replace(text.find("MORE"), 4, more);
    text.replace(text.find("LOAD"), 4, load);
    const std::filesystem::path file = folder.path() / (std::string(name) + ".json");
    std::ofstream(file) << text;
    return runTable(readStructureCase(file), folder.path() / name);
  };
  auto loaded = run("loaded", "", R"({"corner": "u0v0", "force": [0, 0, -3]})");
  const double w = loaded["middle_uz_m"].back();
  EXPECT_LT(w, -0.01);
  EXPECT_NEAR(loaded["middle_rz_N"].back(), 0, 1e-6);
  auto moved = run("moved", fmt::format(R"(, {{"corner": "u0v0", "hold": "z", "move": [0, 0, {:.12g}]}})", w), "");
  EXPECT_NEAR(moved["middle_rz_N"].back(), -3, 1e-6);
}

/// omega = pi^2 (m^2 + n^2) sqrt(D/(rho h)), a thin plate simply supported on all edges.
TEST(StructureRun, PlateFrequencies) {
  const Folder folder;
  auto t = runTable(readStructureCase(library / "plate_modes.json", with({"sheet.cells_u=8", "sheet.cells_v=8"})),
                    folder.path() / "out");
  const double pi = std::numbers::pi, d = 70e9 * std::pow(0.005, 3) / (12 * (1 - 0.33 * 0.33));
  const double unit = pi * pi * std::sqrt(d / (2700 * 0.005));
  const double expected[] = {2, 5, 5, 8, 10, 10};
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(t["omega_rad_per_s"][k] / (unit * expected[k]), 1, 0.01) << "mode " << k + 1;
}

/// An unsupported sheet falls: z = -g t^2/2 exactly for Newmark with constant acceleration.
TEST(StructureRun, FreeFall) {
  const Folder folder;
  const std::filesystem::path file = folder.write("fall.json", R"({
    "kind": "dynamic", "name": "fall",
    "sheet": {"plate": {"width": 1, "height": 1}, "degree": 2, "cells_u": 2, "cells_v": 2},
    "material": {"isotropic": {"young": 1e6, "thickness": 0.01, "density": 1000}},
    "loads": [{"gravity": [0, 0, -10]}],
    "solver": {"scheme": "newmark", "end": 0.5, "step": 0.05},
    "initial": {"velocity": [2, 0, 0]},
    "output": {"points": [{"name": "p", "point": [0.3, 0.6]}], "interval": 0.05, "shapes": "none"}})");
  auto t = runTable(readStructureCase(file), folder.path() / "out");
  ASSERT_EQ(t["time_s"].size(), 11u);
  EXPECT_DOUBLE_EQ(t["time_s"].back(), 0.5);
  EXPECT_NEAR(t["p_uz_m"].back(), -1.25, 1e-9);
  EXPECT_NEAR(t["p_ux_m"].back(), 1, 1e-9);
  EXPECT_NEAR(t["p_vz_m_per_s"].back(), -5, 1e-9);
  EXPECT_NEAR(t["total_energy_J"].back(), 20, 1e-7);  // 10 kg at 2 m/s
}

/// A missing support is named; the results say so.
/// Zheng 2013, 5.6.4: soft cloth whose threads keep their length carries 1 N/m to its support, in its stress as in its
/// reaction.
TEST(StructureRun, LimitedStrainCarriesTheLoad) {
  const Folder folder;
  const auto file = folder.write("pulled.json", R"json({
  "kind": "dynamic", "name": "pulled",
  "sheet": {"plate": {"width": 1, "height": 1}, "degree": 2, "cells_u": 4, "cells_v": 4},
  "material": {"isotropic": {"young": 10000, "thickness": 0.001, "density": 100}},
  "supports": [{"edge": "v1", "hold": "xyz"}],
  "loads": [{"edge": "v0", "force_per_length": [0, -1, 0]}],
  "solver": {"scheme": "explicit", "end": 3, "step": 0.002, "drag": 1},
  "strain_limit": {"mode": "equality", "tolerance": 1e-4},
  "output": {"points": [{"name": "a", "point": [0.5, 0.5]}, {"name": "b", "point": [0.1, 0.3]}],
    "edges": [{"name": "root", "edge": "v1"}], "interval": 0.5, "thread_strains": true, "shapes": "none"}
})json");
  const StructureCase c = readStructureCase(file);
  EXPECT_EQ(c.strain_limit->mode, LimitMode::equality);
  auto t = runTable(c, folder.path() / "out");
  EXPECT_NEAR(t["a_n1_N_per_m"].back(), 1, 1e-3);
  EXPECT_NEAR(t["b_n1_N_per_m"].back(), 1, 1e-3);
  EXPECT_NEAR(t["root_ry_N"].back(), 1, 1e-3);
  EXPECT_NEAR(t["root_rx_N"].back(), 0, 1e-3);
  EXPECT_LT(t["a_vy_m_per_s"].back(), 1e-4);
  ASSERT_EQ(t["vertex_warp_max"].size(), 7u);
  for (const char* column : {"vertex_warp_max", "vertex_weft_max", "vertex_warp_mean", "vertex_weft_mean"})
    for (double E : t[column]) EXPECT_LE(E, 1e-4) << column;
  EXPECT_EQ(t["gauss_warp_max"].size(), 7u);
  const auto s = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  EXPECT_LE(s.at("strain_limit").at("largest_residual").get<double>(), 1e-4);
  EXPECT_EQ(s.at("strain_limit").at("unconverged_steps").get<long>(), 0);
  EXPECT_GE(s.at("strain_limit").at("projections_per_step").get<double>(), 1);
  EXPECT_EQ(s.at("thread_strain").at("vertex").at("warp").at("mean").get<double>(), t["vertex_warp_mean"].back());
  const StructureCase again = readStructureCase(folder.path() / "out/case.json");
  EXPECT_EQ(writeCase(again), writeCase(c));
  EXPECT_NE(content(folder.path() / "out/report.html").find("Weft and warp keep their length"), std::string::npos);

  // Without the limit the threads stretch by a tenth, and the strains say so: (1 + 2 E)^(1/2) E h E = 1 with nu = 0.
  auto soft = runTable(readStructureCase(file, {"strain_limit={\"mode\":\"upper_limit\",\"limit\":1}"}),
                       folder.path() / "soft");
  double E = 0.1;
  for (int k = 0; k < 50; ++k) E = 0.1 / std::sqrt(1 + 2 * E);
  EXPECT_NEAR(soft["vertex_warp_max"].back(), E, 1e-4);
  EXPECT_NEAR(soft["gauss_warp_mean"].back(), E, 1e-4);
  EXPECT_NEAR(soft["gauss_weft_max"].back(), 0, 1e-4);
  EXPECT_NEAR(soft["root_ry_N"].back(), 1, 1e-3);
}

TEST(StructureRun, MechanismIsNamed) {
  const Folder folder;
  const StructureCase c =
      readStructureCase(library / "cantilever.json", with({R"(supports=[{"edge":"u0","hold":"xyz"}])"}));
  try {
    runTable(c, folder.path() / "out");
    ADD_FAILURE() << "a hinged strip is a mechanism";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("What converged before is in"), std::string::npos) << e.what();
  }
  const auto s = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  EXPECT_FALSE(s.at("finished").get<bool>());
  EXPECT_FALSE(s.at("why").get<std::string>().empty());
}

/// A second step a thousand times the first, and few iterations: the first stays.
TEST(StructureRun, DivergedNewtonLeavesWhatConverged) {
  const Folder folder;
  const StructureCase c = readStructureCase(
      library / "cantilever.json", with({R"(solver={"steps":2,"halvings":0,"iterations":3,"tolerance":1e-6})",
                                         R"(programs={"late":[[0,0],[0.5,0.001],[1,1]]})", "loads[0].program=late"}));
  EXPECT_THROW(runTable(c, folder.path() / "out"), RunError);
  const auto s = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  EXPECT_FALSE(s.at("finished").get<bool>());
  EXPECT_NE(s.at("why").get<std::string>().find("residual"), std::string::npos);
  EXPECT_EQ(s.at("factor").get<double>(), 0.5);
  // F L^3/(3 E I), F = 0.004.
  EXPECT_NEAR(s.at("points")[0].at("uz_m").get<double>(), 0.004 * 1000 / 300, 1e-6);
}

/// The one load step that goes over the limit point at 0.742 (Sze, Liu and Lo 2004, section 3.8) is marked, and no
/// other, in the table and in the summary: where Newton crosses it by itself, and where it stops at every step and the
/// solver descends to a stable state, near or far.
TEST(StructureRun, JumpIsMarked) {
  for (const char* solver : {R"(solver={"steps":10})", R"(solver={"steps":10,"halvings":0,"iterations":2})"}) {
    SCOPED_TRACE(solver);
    const Folder folder;
    const StructureCase c =
        readStructureCase(library / "hinged_roof.json", with({solver, "sheet.cells_u=4", "sheet.cells_v=4"}));
    auto t = runTable(c, folder.path() / "out");
    for (std::size_t k = 1; k < t["jumped"].size(); ++k) {
      const bool over = t["centre_uz_m"][k - 1] > -15 && t["centre_uz_m"][k] < -20;
      EXPECT_EQ(t["jumped"][k], over ? 1 : 0) << k;
      if (over) {
        EXPECT_LT(t["factor"][k - 1], 0.75);
        EXPECT_GT(t["factor"][k], 0.74);
      }
    }
    EXPECT_EQ(std::count(t["jumped"].begin(), t["jumped"].end(), 1.), 1);
    EXPECT_EQ(nlohmann::json::parse(content(folder.path() / "out/summary.json")).at("jumps").get<long>(), 1);
    EXPECT_NE(content(folder.path() / "out/report.html").find("over a limit point"), std::string::npos);
    EXPECT_LT(t["centre_uz_m"].back(), -25);
  }
}

/// Pictures and page of a run, and again from its folder.
TEST(StructureRun, PicturesAndReport) {
  const Folder folder;
  runTable(readStructureCase(library / "cantilever.json", {"solver.steps=4", "output.shapes=all"}),
           folder.path() / "out");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/frames.xdmf"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/snapshots/01_stress_front_right.png"));
  const std::string page = content(folder.path() / "out/report.html");
  EXPECT_NE(page.find("Cantilever under an end force"), std::string::npos);
  EXPECT_NE(page.find("displacement of tip"), std::string::npos);
  ASSERT_TRUE(holdsStructure(folder.path() / "out"));
  EXPECT_EQ(reportStructureResults({folder.path() / "out", folder.path() / "again.html"}), 0);
  EXPECT_EQ(content(folder.path() / "again.html"), page);
  // What was damaged since is named.
  const auto damaged = [&](const char* file, const std::string& from, const std::string& to) {
    const std::string whole = content(folder.path() / "out" / file);
    const std::size_t at = whole.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    folder.write(std::string("out/") + file, std::string(whole).replace(at, from.size(), to));
    try {
      reportStructureResults({folder.path() / "out", folder.path() / "again.html"});
      ADD_FAILURE() << file << " was taken";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().file, (folder.path() / "out" / file).string());
      EXPECT_EQ(e.reason().find("json.exception"), std::string::npos) << e.reason();
    }
    folder.write(std::string("out/") + file, whole);
  };
  damaged("summary.json", "\"finished\": true", "\"finished\": null");
  damaged("summary.json", "\"points\": [", "\"points\": [null, ");
  damaged("summary.json", "{", "");
  damaged("path.csv", "\n0,", "\nx,");
  damaged("path.csv", "\n0,", "\n,");
  RenderOptions render;
  render.results = folder.path() / "out";
  render.png = folder.path() / "half.png";
  render.when = PictureTime::at;
  render.time_s = 0.5;
  EXPECT_EQ(renderStructureResults(render), 0);
  EXPECT_GT(std::filesystem::file_size(render.png), 1000u);
  render.field = PictureField::pressure;
  EXPECT_THROW(renderStructureResults(render), InputError);
}

}  // namespace
}  // namespace gambeson
