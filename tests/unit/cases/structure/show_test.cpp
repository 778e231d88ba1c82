/// What a run of a structure says of itself: causes, pictures of modes, threads; and what it adds up in motion.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "cases/runs/results_folder.hpp"
#include "cases/structure/measure.hpp"
#include "cases/structure/run.hpp"
#include "core/error.hpp"
#include "core/motion/implicit.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/structure/table.hpp"

namespace gambeson {
namespace {

const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";

/// Half a tube of flat cloth that is stiff in bending, held along one edge: no load holds it curved.
TEST(StructureShow, ASheetThatSpringsOpenIsNamed) {
  const Folder folder;
  const auto file = folder.write("springs.json", R"json({"kind": "static", "name": "springs",
    "sheet": {"cylinder": {"radius": 0.1, "length": 0.2, "end_angle": "180 deg"},
              "degree": 2, "cells_u": 8, "cells_v": 4},
    "material": {"fabric": {"thickness": "0.3 mm", "density": 500, "young": "10 MPa", "poisson": 0.2,
                 "bending": {"law": "linear", "rigidity": "0.05 N m", "twist": "0.03 N m"}}},
    "supports": [{"edge": "u0", "hold": "xyz", "clamp": true}],
    "loads": [{"gravity": [0, 0, -9.81]}],
    "solver": {"steps": 2, "iterations": 5}, "output": {"shapes": "none"}})json");
  try {
    runStructure(readStructureCase(file), {.out = folder.path() / "out", .threads = 1});
    ADD_FAILURE() << "it found its way open";
  } catch (const RunError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("not in equilibrium at factor 0"), std::string::npos) << what;
    EXPECT_NE(what.find("rest: zero"), std::string::npos) << what;
  }
}

/// A picture of a mode that asks for nothing shows its displacement.
TEST(StructureShow, PicturesOfModesShowDisplacements) {
  const Folder folder;
  const StructureCase c =
      readStructureCase(library / "plate_modes.json", {"sheet.cells_u=4", "sheet.cells_v=4", "solver.count=2",
                                                       R"(output.pictures=[{"mode":2,"width":400,"height":300}])"});
  EXPECT_EQ(c.output.pictures[0].field, StructureField::automatic);
  runStructure(c, {.out = folder.path() / "out", .threads = 1});
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/snapshots/01_displacement_front_right.png"));
}

TEST(StructureShow, NoNumberOfThreadsLeavesItToTheEnvironment) {
  const char* set = std::getenv("OMP_NUM_THREADS");
  const std::string before = set ? set : "";
  setenv("OMP_NUM_THREADS", "3,2", 1);
  useThreads(0);
  EXPECT_EQ(omp_get_max_threads(), 3);
  useThreads(2);
  EXPECT_EQ(omp_get_max_threads(), 2);
  unsetenv("OMP_NUM_THREADS");
  useThreads(0);
  EXPECT_GE(omp_get_max_threads(), 1);
  if (set) setenv("OMP_NUM_THREADS", before.c_str(), 1);
  useThreads(1);
}

std::string stripInMotion(const std::string& supports_and_loads, const std::string& solver) {
  return R"json({"kind": "dynamic", "name": "strip",
    "sheet": {"plate": {"width": 1, "height": 0.1}, "degree": 2, "cells_u": 8, "cells_v": 2},
    "material": {"isotropic": {"young": 1e6, "poisson": 0, "thickness": 0.01, "density": 1000}},
    )json" +
         supports_and_loads + R"json(, "solver": )json" + solver + R"json(,
    "output": {"edges": [{"name": "root", "edge": "u0"}], "interval": 0.01, "shapes": "none"}})json";
}

/// Loads that come and go, and a pressure that follows: what they do is in the strip, to the order of the steps.
TEST(StructureShow, LoadsThatChangeDoTheWorkThatTheStripHolds) {
  for (const char* load : {R"("loads": [{"edge": "u1", "force": [0, 0, 0.3], "program": "p"}],)",
                           R"("loads": [{"pressure": 5, "program": "p"}],)"}) {
    SCOPED_TRACE(load);
    const Folder folder;
    const auto file = folder.write(
        "strip.json", stripInMotion(std::string(R"("supports": [{"edge": "u0", "hold": "xyz", "clamp": true}],)") +
                                        load + R"("programs": {"p": [[0, 0], [0.2, 1], [0.4, 0.2], [1, 0.6]]})",
                                    R"({"scheme": "newmark", "end": 1, "step": 0.002})"));
    runStructure(readStructureCase(file), {.out = folder.path() / "out", .threads = 1});
    double most = 0, off = 0;
    for (auto& row : tableRows(folder.path() / "out/path.csv")) {
      most = std::max(most, row["kinetic_energy_J"] + row["strain_energy_J"]);
      off = std::max(off, std::abs(row["total_energy_J"]));
    }
    EXPECT_GT(most, 0);
    EXPECT_LT(off, 1e-4 * most);
  }
}

/// A support that pulls the strip along with 2 m/s^2, until damping has stilled it: 1 kg.
TEST(StructureShow, AMovingSupportFeelsAllOfTheMass) {
  const Folder folder;
  std::string path;
  for (int k = 0; k <= 100; ++k) path += fmt::format("{}[{}, {:.10g}]", k ? ", " : "", 0.01 * k, 1e-4 * k * k);
  const auto file = folder.write(
      "strip.json",
      stripInMotion(R"("supports": [{"edge": "u0", "hold": "xyz", "clamp": true, "move": [1, 0, 0], "program": "p"}],
                       "programs": {"p": [)" +
                        path + "]}",
                    R"({"end": 0.9, "step": 0.01, "rayleigh_stiffness": 0.02})"));
  runStructure(readStructureCase(file), {.out = folder.path() / "out", .threads = 1});
  EXPECT_NEAR(tableRows(folder.path() / "out/path.csv").back()["root_rx_N"], 2, 1e-5);
}

/// The forces on points that nothing holds are in balance, damping by stiffness and all.
TEST(StructureShow, DampingByStiffnessIsInTheBalance) {
  const Folder folder;
  const auto file = folder.write(
      "strip.json", stripInMotion(R"("supports": [{"edge": "u0", "hold": "xyz", "clamp": true}],
                                     "initial": {"velocity": [1e-4, 0, 0]})",
                                  R"({"scheme": "newmark", "end": 0.02, "step": 0.002, "rayleigh_stiffness": 0.02})"));
  const StructureCase c = readStructureCase(file);
  const StructureModel model = buildModel(c);
  const Structure& s = *model.structure;
  const Sheet sheet = sheetOf(c);
  const auto n = static_cast<std::size_t>(s.dofs.unknowns());
  State state = structureState(s, 0, std::vector<double>(n, 0.0), std::vector<double>(n, 1e-4), {});
  const DynamicOptions& d = c.dynamics;
  ImplicitSteps(s, {.scheme = ImplicitScheme::newmark, .step_s = d.step_s})
      .advance(d.end_s, state,
               [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  const MeasuredState m = measureDynamic(model, state, d.lumped_mass, d.step_s);
  std::vector<double> pushed(n);
  s.dofs.Ct.multiply<double>({&m.reaction_N.data()->x, 3 * m.reaction_N.size()}, pushed);
  double left = 0, all = 0;
  for (double f : pushed) left = std::max(left, std::abs(f));
  for (const Vec3& f : m.reaction_N) all = std::max(all, norm(f));
  EXPECT_GT(all, 0);
  EXPECT_LT(left, 1e-3 * all);
}

}  // namespace
}  // namespace gambeson
