#include "cases/cell/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cases/cell/solid_engine.hpp"
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

/// Of solids on a coarse mesh, whose contact is exact.
CellCase solid(const std::vector<std::string>& changes = {}) {
  std::vector<std::string> all{"solids.across=2", "solids.along=5", "solids.change=1e-7", "solids.deepest=1e-7",
                               "solver.tolerance=1e-11"};
  all.insert(all.end(), changes.begin(), changes.end());
  return readCellCase(std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library/cell_solid.json", all);
}

/// What is written out in full is read again, whatever the engine has no use for.
TEST(CellEngine, CasesComeBack) {
  const Folder folder;
  for (const CellCase& c : {truss(), solid(), example({})}) {
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
    const BalancedCell weft = pulled(along_weft, free), warp = pulled(along_warp, free);
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
  for (const std::string& yarns : std::vector<std::string>{"rod", "truss", "solid", "quarter"}) {
    const CellCase c = yarns == "rod"     ? example({})
                       : yarns == "truss" ? truss()
                                          : solid({"extent=" + std::string(yarns == "solid" ? "full" : "quarter")});
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

CellTarget toLoad(const CellLoad& load) { return {load, {}}; }

/// A15: resultants are the derivatives of the energy, 1e-5 of the largest; and the mean stress stands beside them.
TEST(SolidEngine, ForcesAreDerivativesOfTheEnergy) {
  constexpr double h = 1e-5;
  const CellCase c = solid();
  const auto engine = makeEngine(c);
  const CellLoad load{0.02, 0.015, 0.05, 0, 0};
  const auto bring = [&](const CellLoad& to) {
    const auto specimen = engine->specimen();
    EXPECT_TRUE(specimen->bring(toLoad(load)).reached);
    const CellStep step = specimen->bring(toLoad(to));
    EXPECT_TRUE(step.reached) << step.why;
    return step.point;
  };
  const BalancedCell point = bring(load);
  const CellResultants& n = point.resultants;
  ASSERT_GT(n.n11, 0);
  const double forces[3] = {n.n11, n.n22, n.n12};
  for (int e = 0; e < 3; ++e) {
    double energy[2];
    for (const int side : {0, 1}) {
      CellLoad to = load;
      (e == 0 ? to.e11 : e == 1 ? to.e22 : to.g12) += side ? h : -h;
      energy[side] = bring(to).resultants.energy_J_per_m2;
    }
    EXPECT_NEAR((energy[1] - energy[0]) / (2 * h), forces[e], 1e-5 * n.n11) << e;
  }
  EXPECT_NEAR(point.mean_stress_Pa[0], n.n11 / *c.height_m, 0.05 * n.n11 / *c.height_m);
  EXPECT_NE(point.mean_stress_Pa[0], n.n11 / *c.height_m);
  EXPECT_LE(point.passed_m, 1e-7 * 0.16e-3);
  // Of each yarn, by spacing and stretch, and by how much crimp is left.
  EXPECT_NEAR(point.tension_N[along_weft], n.n11 * 1e-3 * std::sqrt(1 + 2 * load.e11), 0.15 * n.n11 * 1e-3);
}

/// A14: 1e-4 of the largest resultant; and the images of the quarter are the full cell.
TEST(SolidEngine, AQuarterAndItsImagesAreTheFullCell) {
  BalancedCell point[2];
  YarnShape shape[2];
  std::vector<char> direction[2];
  for (const int full : {0, 1}) {
    const auto engine = makeEngine(solid({full ? "extent=full" : "extent=quarter"}));
    const auto specimen = engine->specimen();
    const CellStep step = specimen->bring(toLoad({0.015, 0.015, 0.04, 0, 0}));
    ASSERT_TRUE(step.reached) << step.why;
    point[full] = step.point;
    shape[full] = specimen->shape();
    direction[full] = engine->surface().direction;
  }
  const double most = point[1].resultants.n11;
  EXPECT_NEAR(point[0].resultants.n11, most, 1e-4 * most);
  EXPECT_NEAR(point[0].resultants.n22, point[1].resultants.n22, 1e-4 * most);
  EXPECT_NEAR(point[0].resultants.n12, point[1].resultants.n12, 1e-4 * most);
  EXPECT_NEAR(point[0].mean_stress_Pa[0], point[1].mean_stress_Pa[0], 1e-4 * point[1].mean_stress_Pa[0]);
  EXPECT_NEAR(point[0].tension_N[along_warp], point[1].tension_N[along_warp], 1e-3 * point[1].tension_N[along_warp]);
  // Each vertex of the images lies on one of the full cell, with its stress; the cells differ by a shift of the whole.
  const auto middle = [](const YarnShape& s) {
    Vec3 low = s.vertices[0], high = low;
    for (const Vec3& x : s.vertices)
      for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
    return 0.5 * (low + high);
  };
  const Vec3 shift = middle(shape[1]) - middle(shape[0]);
  EXPECT_LT(std::hypot(shift.x, shift.y), 1e-4 * 1e-3);  // of the full cell one corner keeps its height
  double pressed = 0, most_stress = 0;
  for (const double s : shape[1].stress_Pa) most_stress = std::max(most_stress, s);
  for (std::size_t i = 0; i < shape[0].vertices.size(); ++i) {
    double nearest = INFINITY;
    std::size_t at = 0;
    for (std::size_t k = 0; k < shape[1].vertices.size(); ++k)
      if (const double d = norm2(shape[1].vertices[k] - shape[0].vertices[i] - shift);
          d < nearest && direction[1][k] == direction[0][i])
        nearest = d, at = k;
    EXPECT_LT(std::sqrt(nearest), 1e-4 * 1e-3);
    // At the cuts between images a node has hexahedra on one side alone.
    EXPECT_NEAR(shape[0].stress_Pa[i], shape[1].stress_Pa[at], 0.3 * most_stress);
    pressed = std::max(pressed, shape[0].pressure_Pa[i]);
  }
  EXPECT_GT(pressed, 1e6);
}

/// A10: what the forces do around a loop is lost by friction, or stored at its end; without friction it is nothing.
TEST(SolidEngine, WhatALoopLosesIsTheWorkOfItsForces) {
  for (const double mu : {0.0, 0.3}) {
    const auto engine = makeEngine(solid({"friction.coefficient=" + std::to_string(mu), "solids.along=7",
                                          "solids.change=1e-3", "solids.deepest=1e-2", "solver.tolerance=1e-9"}));
    const auto specimen = engine->specimen();
    constexpr int kSteps = 20;
    double work = 0, most = 0;
    BalancedCell begin, before;
    for (int k = 0; k <= 2 * kSteps; ++k) {
      const double part = k <= kSteps ? k : 2 * kSteps - k;
      const CellStep step = specimen->bring(toLoad(trellis(0.12 * part / kSteps, 1.01)));
      ASSERT_TRUE(step.reached) << step.why;
      const BalancedCell& p = step.point;
      if (k == 0) {
        begin = p;
      } else {
        EXPECT_GE(p.lost_J_per_m2, before.lost_J_per_m2);
        const CellResultants &a = before.resultants, &b = p.resultants;
        work +=
            0.5 * ((a.n11 + b.n11) * (p.load.e11 - before.load.e11) + (a.n22 + b.n22) * (p.load.e22 - before.load.e22) +
                   (a.n12 + b.n12) * (p.load.g12 - before.load.g12));
      }
      most = std::max(most, work);
      before = p;
    }
    const double lost = before.lost_J_per_m2 - begin.lost_J_per_m2;
    const double stored = before.resultants.energy_J_per_m2 - begin.resultants.energy_J_per_m2;
    if (mu == 0) {
      EXPECT_EQ(lost, 0);
      EXPECT_NEAR(work, 0, 1e-4 * most);
    } else {
      EXPECT_GT(lost, 0.2 * most);
      EXPECT_NEAR(work, lost + stored, 0.02 * lost);
    }
  }
}

/// Sides that are free carry nothing, pulled either way; with friction each step starts where the last was accepted.
TEST(SolidEngine, FreeSidesCarryNothing) {
  for (const char* mu : {"0", "0.2"}) {
    double narrowed[2];
    for (const YarnDirection along : {along_weft, along_warp}) {
      const auto engine = makeEngine(solid({std::string("friction.coefficient=") + mu}));
      const auto specimen = engine->specimen();
      CellStep step;
      for (const double part : {0.0, 0.5, 1.0}) {
        step = specimen->bring(targetOf(UniaxialPath{0.02, along, true}, part));
        ASSERT_TRUE(step.reached) << part << " " << step.why;
      }
      const CellResultants& n = step.point.resultants;
      const double pulled = along == along_weft ? n.n11 : n.n22, across = along == along_weft ? n.n22 : n.n11;
      ASSERT_GT(pulled, 0);
      EXPECT_LE(std::abs(across), 1e-6 * pulled);
      narrowed[along] = along == along_weft ? step.point.load.e22 : step.point.load.e11;
      EXPECT_LT(narrowed[along], -0.005);
      EXPECT_EQ(step.point.lost_J_per_m2 > 0, std::string(mu) != "0");
    }
    EXPECT_NEAR(narrowed[0], narrowed[1], 0.05 * std::abs(narrowed[0]));  // one side presses, the other has facets
  }
}

}  // namespace
}  // namespace gambeson
