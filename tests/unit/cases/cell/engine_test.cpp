#include "cases/cell/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cases/cell/truss_engine.hpp"
#include "cases/yarns/design.hpp"
#include "unit/cases/cell/example.hpp"

namespace gambeson {
namespace {

CellCase example(const std::vector<std::string>& changes) {
  const Folder folder;
  return readCellCase(folder.write("cell.json", cell_example), changes);
}

/// Of two yarns that touch, one twice as wavy as the other.
CellCase truss() {
  return example({"yarns=truss", "solver={}", R"(loads=[{"name":"both","biaxial":{"extension":0.1}}])",
                  "output.pictures=[]", R"(weft.amplitude="0.2 mm")", R"(warp.amplitude="0.12 mm")",
                  R"(weft.half_width="0.12 mm")", R"(warp.half_width="0.1 mm")"});
}

/// What is written out in full is read again, whatever the engine has no use for.
TEST(CellEngine, CasesComeBack) {
  const Folder folder;
  for (const CellCase& c : {truss(), example({})}) {
    const CellCase again = readCellCase(folder.write("again.json", writeCase(c)));
    EXPECT_EQ(writeCase(again), writeCase(c));
    EXPECT_EQ(caseIdentity(again), caseIdentity(c));
  }
}

CellTarget at(double e11, double e22) { return {{e11, e22, 0, 0, 0}, {}}; }

/// Forces of the truss are the derivatives of what its yarns and crossings store.
TEST(CellEngine, ForcesOfATrussAreDerivativesOfItsEnergy) {
  const auto engine = makeEngine(truss());
  for (const auto& [e11, e22] : {std::pair(0.06, 0.05), std::pair(0.09, 0.01), std::pair(0.1, 0.1)}) {
    const auto specimen = engine->specimen();
    const CellResultants n = specimen->bring(at(e11, e22)).point.resultants;
    const double h = 1e-5;
    const auto energy = [&](double a, double b) { return specimen->bring(at(a, b)).point.resultants.energy_J_per_m2; };
    ASSERT_GT(n.n11, 0);
    EXPECT_NEAR((energy(e11 + h, e22) - energy(e11 - h, e22)) / (2 * h), n.n11, 1e-5 * n.n11) << e11;
    EXPECT_NEAR((energy(e11, e22 + h) - energy(e11, e22 - h)) / (2 * h), n.n22, 1e-5 * n.n11) << e22;
  }
}

/// With free sides a truss pulls its yarn straight, and then as that yarn alone: N11 = n EA (lambda_y - 1)/lambda.
TEST(CellEngine, ATrussWithFreeSidesPullsItsYarnStraight) {
  const CellCase c = truss();
  const KawabataCloth cloth = trussOf(c);
  const auto engine = makeEngine(c);
  const auto specimen = engine->specimen();
  const double stretch = 1.1;
  const CellStep step = specimen->bring({at(0.5 * (stretch * stretch - 1), 0).load, along_warp});
  EXPECT_LT(step.point.load.e22, -0.01);
  EXPECT_EQ(step.point.resultants.n22, 0);
  const KawabataYarn& y = cloth.yarn[along_weft];
  const double rest = std::hypot(2 * y.crimp_height_m, y.spacing_m);
  const double pull = y.yarns_per_m * y.stretch_N * (stretch * y.spacing_m / rest - 1) / stretch;
  ASSERT_GT(pull, 0);
  EXPECT_NEAR(step.point.resultants.n11, pull, 1e-6 * pull);
}

/// Of a balanced weave weft and warp are the same, pulled either way, sides held or free.
TEST(CellEngine, WeftAndWarpOfABalancedWeaveAreAlike) {
  const CellCase c = readCellCase(std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library/cell_spun.json");
  const auto engine = makeEngine(c);
  const auto pulled = [&](YarnDirection along, bool free) {
    const auto specimen = engine->specimen();
    CellStep step;
    for (const double part : {0.25, 0.5, 0.75, 1.0}) {
      step = specimen->bring(targetOf(UniaxialPath{0.05, along, free}, part));
      EXPECT_TRUE(step.reached) << part << " " << step.why;
    }
    return step.point;
  };
  for (const bool free : {false, true}) {
    const CellPoint weft = pulled(along_weft, free), warp = pulled(along_warp, free);
    EXPECT_NEAR(weft.resultants.n11, warp.resultants.n22, 1e-5 * weft.resultants.n11);
    ASSERT_GT(weft.resultants.n11, 1000);
    if (free) {
      EXPECT_LE(std::abs(weft.resultants.n22), 1e-6 * weft.resultants.n11);
    } else {
      EXPECT_GT(weft.resultants.n22, 0.01 * weft.resultants.n11);
    }
    EXPECT_NEAR(weft.load.e22, warp.load.e11, 1e-6);
    EXPECT_NEAR(weft.tension_N[along_weft], warp.tension_N[along_warp], 1e-4 * weft.tension_N[along_weft]);
  }
}

/// Turned outwards, and closed.
TEST(CellEngine, TubesEncloseTheYarns) {
  for (const char* yarns : {"rod", "truss"}) {
    const CellCase c = std::string(yarns) == "rod" ? example({}) : truss();
    const auto engine = makeEngine(c);
    const YarnSurface& surface = engine->surface();
    const YarnShape shape = engine->specimen()->shape();
    ASSERT_EQ(surface.direction.size(), shape.vertices.size());
    double volume = 0, exact = 0;
    for (const auto& t : surface.triangles)
      volume += dot(shape.vertices[t[0]], cross(shape.vertices[t[1]], shape.vertices[t[2]])) / 6;
    const WovenYarns woven = wovenYarns(c);
    for (const int d : {along_weft, along_warp})
      for (int k = 0; k < woven.count(d); ++k)
        exact += woven.arcLength_m(d, k, 0, woven.period_m(d)) * 3.14159265 * woven.yarn[d].half_width_m *
                 woven.yarn[d].half_thickness_m;
    EXPECT_NEAR(volume, exact, 0.08 * exact) << yarns;  // 24 corners of an ellipse: 1 %; sections that lean take more
  }
}

}  // namespace
}  // namespace gambeson
