/// Solids in equilibrium: patch test, closed forms, convergence, load steps, and what cannot stand.

#include "core/solid/solid_system.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"
#include "core/statics/path.hpp"
#include "unit/core/solid/solid_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const Vec3 kAxes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

bool onSkin(const Vec3& X) {
  for (int d = 0; d < 3; ++d)
    if (X[d] < 1e-9 || X[d] > 1 - 1e-9) return true;
  return false;
}

SolidMesh crooked(int n) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> d(-0.15 / n, 0.15 / n);
  SolidMesh m = block(n, n, n, [&](const Vec3& p) {
    return onSkin(p) ? p : p + Vec3{d(random), d(random), d(random)};
  });
  m.materials = {{kevlar(), 0}};
  m.fibres.assign(m.cells.size(), {1, 2, -0.5});
  return m;
}

struct Solution {
  StaticReport report;
  StaticPoint last;
};

Solution solved(SolidSystem& system, StaticOptions options) {
  Solution s;
  s.report = followPath(system, options, [&](const StaticPoint& p) {
    s.last = p;
    return true;
  });
  return s;
}

TEST(SolidSystem, FindsTheUniformStrainOfAPatch) {
  const SolidBody body(crooked(3));
  const Mat3 F{{1.1, 0.05, -0.1}, {0.2, 0.9, 0.03}, {-0.04, 0.1, 1.05}};
  SolidSupports supports;
  for (int i = 0; i < static_cast<int>(body.mesh().nodes.size()); ++i) {
    const Vec3 X = body.mesh().nodes[i], u = F * X - X;
    if (!onSkin(X)) continue;
    for (int d = 0; d < 3; ++d) supports.constraints.push_back(prescribed(i, kAxes[d], u[d], 0));
  }
  SolidSystem system(body, supports);
  StaticOptions options;
  options.steps = 2;
  options.tolerance = 1e-13;
  const Solution s = solved(system, options);
  ASSERT_TRUE(s.report.reached) << s.report.why;
  EXPECT_LE(s.last.iterations, 6);
  const std::vector<Vec3> x = system.positions(s.last.y, 1);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT(norm(x[i] - F * body.mesh().nodes[i]), 1e-12);
}

TEST(SolidSystem, AStretchedYarnPullsAsItsLawSays) {
  // Along the fibres to 1.05, free across: one unknown stretch b with S22 = 0, found by Newton on the law alone.
  const double a = 1.05;
  double b = 1;
  Elasticity D;
  for (int k = 0; k < 20; ++k) {
    const SolidAnswer s = evaluate(kevlar(), {1, 0, 0}, {a * a, b * b, b * b, 0, 0, 0}, D);
    b -= s.stress_Pa[1] / (b * (D[7] + D[8]));
  }
  const double force = a * evaluate(kevlar(), {1, 0, 0}, {a * a, b * b, b * b, 0, 0, 0}).stress_Pa[0];

  SolidMesh m = block(2, 2, 2, [](const Vec3& p) { return p; });
  m.materials = {{kevlar(), 0}};
  m.fibres.assign(m.cells.size(), {1, 0, 0});
  const SolidBody body(m);
  SolidSupports supports;
  const std::vector<int> end = nodesWhere(m, [](const Vec3& X) { return X.x > 0.99; });
  for (int d = 0; d < 3; ++d)
    for (const int i : nodesWhere(m, [&](const Vec3& X) { return X[d] < 0.01; }))
      supports.constraints.push_back(prescribed(i, kAxes[d]));
  for (const int i : end) supports.constraints.push_back(prescribed(i, kAxes[0], a - 1, 0));
  SolidSystem system(body, supports);
  StaticOptions options;
  options.steps = 4;
  options.tolerance = 1e-11;
  const Solution s = solved(system, options);
  ASSERT_TRUE(s.report.reached) << s.report.why;
  double pull = 0;
  const std::vector<Vec3> reactions = system.reactions(s.last.y, 1);
  for (const int i : end) pull += reactions[i].x;
  EXPECT_NEAR(pull, force, 1e-9 * force);
  EXPECT_NEAR(system.positions(s.last.y, 1)[26].y, b, 1e-10);
}

/// Energy of a unit cube bent to the curvature k, over that of the exact solution of small strain,
/// u = k (-x z, nu y z, (x² + nu (z² - y²))/2), its skin held there.
double bentEnergy(int n) {
  const double E = 1e9, nu = 0.3, k = 1e-5;
  SolidMesh m = block(n, n, n, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(E, nu), 0}};
  const SolidBody body(m);
  SolidSupports supports;
  for (int i = 0; i < static_cast<int>(m.nodes.size()); ++i) {
    if (!onSkin(m.nodes[i])) continue;
    const Vec3 p = m.nodes[i] - Vec3{0.5, 0.5, 0.5};
    const Vec3 u{-k * p.x * p.z, k * nu * p.y * p.z, 0.5 * k * (p.x * p.x + nu * (p.z * p.z - p.y * p.y))};
    for (int d = 0; d < 3; ++d) supports.constraints.push_back(prescribed(i, kAxes[d], u[d], 0));
  }
  SolidSystem system(body, supports);
  StaticOptions options;
  options.steps = 1;
  const Solution s = solved(system, options);
  EXPECT_TRUE(s.report.reached) << s.report.why;
  return system.energy(s.last.y, 1) / (E * k * k / 24);
}

TEST(SolidSystem, BendingConvergesWithTheSquareOfTheCells) {
  const double e2 = bentEnergy(2) - 1, e4 = bentEnergy(4) - 1, e8 = bentEnergy(8) - 1;
  EXPECT_GT(std::log2(e2 / e4), 1.9);
  EXPECT_GT(std::log2(e4 / e8), 1.9);
  EXPECT_LT(e8, 0.03);
}

TEST(SolidSystem, HalvesStepsThatAreTooLong) {
  // A bar stretched and turned by half a turn, with few iterations for a step.
  SolidMesh m = block(4, 1, 1, [](const Vec3& p) { return Vec3{4 * p.x, p.y - 0.5, p.z - 0.5}; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  const SolidBody body(m);
  SolidSupports supports;
  supports.programs = {{{0, 1}, {0, 1}}};
  for (const int i : nodesWhere(m, [](const Vec3& X) { return X.x < 0.01; }))
    for (int d = 0; d < 3; ++d) supports.constraints.push_back(prescribed(i, kAxes[d]));
  for (const int i : nodesWhere(m, [](const Vec3& X) { return X.x > 3.99; })) {
    const Vec3 X = m.nodes[i];
    supports.constraints.push_back(prescribed(i, kAxes[0], 6.0, 0));
    supports.constraints.push_back(prescribed(i, kAxes[1], -1.6 * X.y, 0));
    supports.constraints.push_back(prescribed(i, kAxes[2], -1.6 * X.z, 0));
  }
  SolidSystem system(body, supports);
  StaticOptions options;
  options.steps = 1;
  options.iterations = 3;
  const Solution s = solved(system, options);
  EXPECT_TRUE(s.report.reached) << s.report.why;
  EXPECT_GT(s.report.points, 1);
}

TEST(SolidSystem, CarriesForces) {
  SolidMesh m = block(1, 1, 2, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(1e6, 0), 100}};
  const SolidBody body(m);
  SolidSupports supports;
  for (const int i : nodesWhere(m, [](const Vec3& X) { return X.z < 0.01; }))
    for (int d = 0; d < 3; ++d) supports.constraints.push_back(prescribed(i, kAxes[d]));
  for (const int i : nodesWhere(m, [](const Vec3& X) { return X.z > 0.99; }))
    supports.forces.push_back({i, {0, 0, 0.25}, 0});
  SolidSystem system(body, supports);
  const Solution s = solved(system, {});
  ASSERT_TRUE(s.report.reached) << s.report.why;
  EXPECT_NEAR(system.positions(s.last.y, 1).back().z - 1, 1e-6, 1e-11);
  StaticOptions linear;
  linear.linear = true;
  EXPECT_NEAR(system.positions(solved(system, linear).last.y, 1).back().z - 1, 1e-6, 1e-15);
  SymmetricMatrix M = system.sparsity();
  system.mass(true, M);
  double mass = 0;  // of one direction, less the held nodes, which have a quarter
  for (int c = 0; c < M.size; ++c) mass += M.values[M.offsets[c]] / 3;
  EXPECT_NEAR(mass, 75, 1e-12);
}

TEST(SolidSystem, SaysWhatNothingHolds) {
  SolidMesh m = block(1, 1, 1, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  const SolidBody body(m);
  SolidSupports supports;
  for (const int i : nodesWhere(m, [](const Vec3& X) { return X.z < 0.01; }))
    for (int d = 1; d < 3; ++d) supports.constraints.push_back(prescribed(i, kAxes[d]));
  SolidSystem system(body, supports);
  try {
    solved(system, {});
    ADD_FAILURE() << "a block that slides stands";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("mechanism: node"), std::string::npos) << e.what();
  }
}

TEST(SolidSystem, GoesOnWithOtherPrograms) {
  SolidMesh m = block(1, 1, 1, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  const SolidBody body(m);
  SolidSystem system(body, {{prescribed(0, {1, 0, 0}, 0.5, 0)}, {}, {{{0, 1}, {0, 1}}}});
  const std::vector<double> y(system.size(), 0.0);
  EXPECT_EQ(system.positions(y, 1)[0].x, 0.5);
  system.setPrograms({{{0, 1}, {1, 3}}});
  EXPECT_EQ(system.positions(y, 0)[0].x, 0.5);
  EXPECT_EQ(system.positions(y, 1)[0].x, 1.5);
  EXPECT_THROW(system.setPrograms({}), InputError);
  EXPECT_THROW(system.setPrograms({{{0, 0}, {1, 3}}}), InputError);
}

TEST(SolidSystem, BadSupportsAreRefused) {
  SolidMesh m = block(1, 1, 1, [](const Vec3& p) { return p; });
  m.materials = {{isotropicLaw(1e6, 0.3), 0}};
  const SolidBody body(m);
  const auto refused = [&](const std::string& key, const SolidSupports& supports) {
    try {
      const SolidSystem system(body, supports);
      ADD_FAILURE() << key << " was accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
    }
  };
  refused("forces[0]", {{}, {{8, {1, 0, 0}}}, {}});
  refused("forces[0]", {{}, {{0, {1, 0, 0}, 1}}, {}});
  refused("forces[0]", {{}, {{0, {std::nan(""), 0, 0}}}, {}});
  refused("programs[0]", {{}, {}, {{{0, 0}, {0, 1}}}});
  refused("node 9", {{prescribed(9, {1, 0, 0})}, {}, {}});
  refused("node 0", {{prescribed(0, {1, 0, 0}), prescribed(0, {1, 0, 0}, 1, 0)}, {}, {}});
}

}  // namespace
}  // namespace gambeson
