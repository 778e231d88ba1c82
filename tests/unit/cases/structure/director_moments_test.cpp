/// What supports turn a sheet with, where its directors are held: moments of edges in the table of a run.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "cases/structure/run.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/structure/table.hpp"

namespace gambeson {
namespace {

/// A strip along x, 1 x 0.2 x 0.05 m, clamped at x = 0: the last row of a run with these loads and this solver.
std::map<std::string, double> lastRow(const std::string& kind, const std::string& loads, const std::string& solver) {
  const Folder folder;
  const auto file = folder.write("strip.json", fmt::format(R"({{
    "kind": "{}", "name": "strip",
    "sheet": {{"plate": {{"width": 1, "height": 0.2}}, "cells_u": 4, "cells_v": 1, "model": "shell"}},
    "material": {{"isotropic": {{"young": 1e6, "poisson": 0, "thickness": 0.05, "density": 20}}}},
    "supports": [{{"edge": "u0", "hold": "xyz", "clamp": true}}],
    "loads": [{}], "solver": {},
    "output": {{"edges": [{{"name": "root", "edge": "u0"}}], "shapes": "none", "pictures": []}}
  }})",
                                                           kind, loads, solver));
  RunOptions options;
  options.out = folder.path() / "out";
  runStructure(readStructureCase(file), options);
  return tableRows(options.out / "path.csv").back();
}

TEST(DirectorMoments, AClampBearsTheMomentOfTheFreeEnd) {
  const double EI = 1e6 * 0.2 * 0.05 * 0.05 * 0.05 / 12;
  const std::string load = fmt::format(R"({{"edge": "u1", "moment": {}}})", -EI);  // one radian
  const auto row = lastRow("static", load, R"({"steps": 2})");
  EXPECT_NEAR(std::abs(row.at("root_my_Nm")), EI, 1e-6 * EI);
  EXPECT_NEAR(row.at("root_rz_N"), 0, 1e-6 * EI);
}

TEST(DirectorMoments, SmallDisplacementsToo) {
  const auto row = lastRow("static", R"({"edge": "u1", "force": [0, 0, 0.5]})", R"({"linear": true})");
  EXPECT_NEAR(row.at("root_rz_N"), -0.5, 1e-9);
  EXPECT_NEAR(row.at("root_my_Nm"), 0.5, 1e-9);  // r x F about y is - 0.5 at the tip
}

TEST(DirectorMoments, OfAMotionThatComesToRest) {
  // Damped by b K_M; omega = 3.52 sqrt(E t²/(12 rho))/L² = 11.4/s: of the lowest swing exp(-b omega² t/2) = 1e-7 is
  // left.
  const auto row = lastRow("dynamic", R"({"edge": "u1", "force": [0, 0, 0.05]})",
                           R"({"scheme": "generalised_alpha", "end": 5, "step": 0.025, "rayleigh_stiffness": 0.05})");
  EXPECT_NEAR(row.at("root_rz_N"), -0.05, 1e-5);
  EXPECT_NEAR(row.at("root_my_Nm"), 0.05, 2e-5);
}

}  // namespace
}  // namespace gambeson
