/// Elimination of linear supports: hand cases, and the property that every y satisfies every equation.

#include "core/cloth/constraint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"

namespace gambeson {
namespace {

FreeMap plainMap(int points) {
  FreeMap map{identityRows(points), identityRows(points), {}};
  for (int i = 0; i < points; ++i) map.home.push_back(i);
  return map;
}

std::vector<double> displacements(const DofMap& dofs, const std::vector<double>& y, const std::vector<double>& s) {
  std::vector<double> u(dofs.C.rows());
  dofs.C.multiply<double>(y, u);
  for (std::size_t k = 0; k < s.size(); ++k)
    if (!dofs.shift[k].empty())
      for (std::size_t i = 0; i < u.size(); ++i) u[i] += s[k] * dofs.shift[k][i];
  return u;
}

/// The largest violation of the equations for a random y and the program values s.
double violation(const FreeMap& map, const DofMap& dofs, const std::vector<LinearConstraint>& constraints,
                 const std::vector<double>& s) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> d(-1, 1);
  std::vector<double> y(dofs.unknowns());
  for (double& v : y) v = d(random);
  const std::vector<double> u = displacements(dofs, y, s);
  double most = 0;
  for (const LinearConstraint& c : constraints) {
    double sum = c.amount_m == 0 ? 0 : -c.amount_m * s[c.program];
    for (const auto& [control, a] : c.terms)
      for (int k = map.T.offsets[control]; k < map.T.offsets[control + 1]; ++k)
        for (int i = 0; i < 3; ++i) sum += map.T.values[k] * a[i] * u[3 * map.T.columns[k] + i];
    most = std::max(most, std::abs(sum));
  }
  return most;
}

LinearConstraint hold(int point, const Vec3& direction, double amount = 0, int program = -1) {
  return {{{point, direction}}, amount, program, "support " + std::to_string(point)};
}

TEST(Constraint, HeldComponentsDropOutAndTheOthersAreSelected) {
  const FreeMap map = plainMap(3);
  const DofMap dofs = buildDofMap(map, std::vector{hold(0, {1, 0, 0}), hold(0, {0, 1, 0}), hold(2, {0, 0, 1})}, 0);
  ASSERT_EQ(dofs.unknowns(), 6);
  const std::vector<double> u = displacements(dofs, {1, 2, 3, 4, 5, 6}, {});
  EXPECT_EQ(u, (std::vector<double>{0, 0, 1, 2, 3, 4, 5, 6, 0}));
  EXPECT_EQ(dofs.Ct.rows(), 6);
}

/// u.n = 0 with n = (1, 2, 3)/sqrt 14: the motion left is the plane normal to n.
TEST(Constraint, ASlantedSupportLeavesItsPlane) {
  const FreeMap map = plainMap(1);
  const std::vector<LinearConstraint> c{hold(0, Vec3{1, 2, 3} / std::sqrt(14))};
  const DofMap dofs = buildDofMap(map, c, 0);
  ASSERT_EQ(dofs.unknowns(), 2);
  EXPECT_LT(violation(map, dofs, c, {}), 1e-15);
  // Pivot z: u = (y0, y1, -(y0 + 2 y1)/3).
  EXPECT_NEAR(displacements(dofs, {3, 6}, {})[2], -5, 1e-14);
  // Two directions leave a line, along their cross product.
  const std::vector<LinearConstraint> two{hold(0, {1, 2, 3}), hold(0, {1, 0, -1})};
  const DofMap line = buildDofMap(map, two, 0);
  ASSERT_EQ(line.unknowns(), 1);
  const std::vector<double> u = displacements(line, {1}, {});
  EXPECT_NEAR(norm(cross({u[0], u[1], u[2]}, cross({1, 2, 3}, {1, 0, -1}))), 0, 1e-14);
}

TEST(Constraint, ChainsOfTiesCollapseToOneUnknownAtTheRatioOfTheChain) {
  const int n = 50;
  const FreeMap map = plainMap(n);
  std::vector<LinearConstraint> c;
  for (int i = 0; i + 1 < n; ++i) c.push_back({{{i, {0, 1, 0}}, {i + 1, {0, -1, 0}}}, 0, -1, "tie"});
  for (const bool backwards : {false, true}) {
    if (backwards) std::reverse(c.begin(), c.end());
    const DofMap dofs = buildDofMap(map, c, 0);
    EXPECT_EQ(dofs.unknowns(), 3 * n - (n - 1));
    EXPECT_LT(violation(map, dofs, c, {}), 1e-15);
  }
  // Geared: u_i = 2 u_(i+1); the last held: all held.
  std::vector<LinearConstraint> geared;
  for (int i = 0; i < 8; ++i) geared.push_back({{{i, {1, 0, 0}}, {i + 1, {-2, 0, 0}}}, 0, -1, "gear"});
  const FreeMap nine = plainMap(9);
  EXPECT_EQ(buildDofMap(nine, geared, 0).unknowns(), 19);
  EXPECT_LT(violation(nine, buildDofMap(nine, geared, 0), geared, {}), 1e-13);
  geared.push_back(hold(8, {1, 0, 0}, 0.5, 0));
  const DofMap moved = buildDofMap(nine, geared, 1);
  EXPECT_EQ(moved.unknowns(), 18);
  EXPECT_NEAR(displacements(moved, std::vector<double>(18), {1})[0], 128, 1e-12);  // 2^8 0.5
}

TEST(Constraint, EquationsThatFollowFromOthersAreDropped) {
  const FreeMap map = plainMap(2);
  std::vector<LinearConstraint> c{hold(0, {1, 0, 0}, 0.1, 0),
                                  hold(0, {0, 1, 0}, 0.2, 0),
                                  hold(0, {3, -1, 0}, 0.1, 0),
                                  {{{0, {1, 0, 0}}, {1, {-1, 0, 0}}}, 0, -1, "tie"},
                                  hold(1, {2, 0, 0}, 0.2, 0)};
  const DofMap dofs = buildDofMap(map, c, 1);
  EXPECT_EQ(dofs.unknowns(), 3);
  EXPECT_LT(violation(map, dofs, c, {0.7}), 1e-15);
  c.push_back({{{1, {0, 0, 0}}}, 0, -1, "nothing"});
  EXPECT_EQ(buildDofMap(map, c, 1).unknowns(), 3);
}

TEST(Constraint, ContradictionsAreRejectedByName) {
  const FreeMap map = plainMap(2);
  std::vector<LinearConstraint> c{hold(0, {1, 0, 0}), {{{0, {1, 0, 0}}, {1, {-1, 0, 0}}}, 0, -1, "tie"}};
  c.push_back(hold(1, {1, 0, 0}, 0.3, 0));
  c.back().name = "pull";
  try {
    buildDofMap(map, c, 1);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "pull");
    EXPECT_NE(e.reason().find("contradicts"), std::string::npos);
  }
  // The same amount under another program is another motion.
  EXPECT_THROW(buildDofMap(map, std::vector{hold(0, {1, 0, 0}, 0.1, 0), hold(0, {1, 0, 0}, 0.1, 1)}, 2), InputError);
  EXPECT_THROW(buildDofMap(map, std::vector{hold(0, {1, 0, 0}, 0.1, 0)}, 0), InputError);
  EXPECT_THROW(buildDofMap(map, std::vector{hold(2, {1, 0, 0})}, 0), InputError);
  EXPECT_THROW(buildDofMap(map, std::vector{hold(0, {NAN, 0, 0})}, 0), InputError);
}

/// A control point that the map T makes of two free points: the equation lands on both.
TEST(Constraint, GoesThroughTheMapOfFreePoints) {
  FreeMap map;
  map.T.column_count = 2;
  map.T.add(0, 1), map.T.endRow();
  map.T.add(0, 0.25), map.T.add(1, 0.75), map.T.endRow();
  map.T.add(1, 1), map.T.endRow();
  map.Tt = transpose(map.T);
  map.home = {0, 2};
  const std::vector<LinearConstraint> c{hold(1, {0, 0, 1}, 2, 0)};
  const DofMap dofs = buildDofMap(map, c, 1);
  EXPECT_EQ(dofs.unknowns(), 5);
  EXPECT_LT(violation(map, dofs, c, {0.3}), 1e-15);
}

/// Random equations on few points: every y satisfies them, and unknowns + rank = components.
TEST(Constraint, RandomEquationsAreSatisfiedToRounding) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> d(-1, 1);
  const FreeMap map = plainMap(20);
  std::vector<LinearConstraint> c;
  for (int k = 0; k < 35; ++k) {
    LinearConstraint e{{}, d(random), static_cast<int>(random() % 2), "e"};
    for (int i = 0; i < 3; ++i) e.terms.push_back({static_cast<int>(random() % 20), {d(random), d(random), d(random)}});
    c.push_back(e);
  }
  const DofMap dofs = buildDofMap(map, c, 2);
  EXPECT_EQ(dofs.unknowns(), 60 - 35);
  EXPECT_LT(violation(map, dofs, c, {0.4, -1.3}), 1e-12);
}

}  // namespace
}  // namespace gambeson
