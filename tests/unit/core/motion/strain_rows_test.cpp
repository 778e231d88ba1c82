/// The constraints of strain limits (Zheng 2013, section 5.2): where they are, what they see and what they miss.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/cloth/draft/areas.hpp"
#include "core/error.hpp"
#include "core/motion/strain_limit.hpp"
#include "unit/core/motion/strain_net.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Mobility unitMobility(const FreeMap& map) { return {std::vector<double>(map.T.column_count, 1.0), {}}; }

TEST(StrainRows, VanishAtRestAndGrowAsACovarianceOfTheStretch) {
  for (const Garment& g :
       {seamed(), squareSheet(5, 0.3, 0), fourPatches(2, 2, false, SeamKind::C0, 1, plainFabric())}) {
    Net net(g);
    std::vector<Vec3> e;
    strainVectors(net.rows, net.p, e);
    for (int i = 0; i < net.rows.rows(); ++i) EXPECT_NEAR(strainOf(e[i]), 0, 1e-11);
    for (const StrainPoint& p : net.rows.points) EXPECT_NEAR(dot(e[p.row[0]], e[p.row[1]]), 0, 1e-11);
    for (Vec3& x : net.p) x *= 1.1;
    strainVectors(net.rows, net.p, e);
    for (const Vec3& f : e) EXPECT_NEAR(strainOf(f), 0.5 * (1.21 - 1), 1e-11);
  }
}

/// A flat sheet with the weft turned by 30 degrees, stretched by s along x: E_weft = (s^2 - 1)/2 cos^2, E_warp = ...
/// sin^2.
TEST(StrainRows, FollowTheTurnedWeft) {
  Garment g = squareSheet(4, 0.2, 0);
  g.weft = {turnedWeft()};
  Net net(g);
  for (Vec3& x : net.p) x.x *= 1.2;
  std::vector<Vec3> e;
  strainVectors(net.rows, net.p, e);
  const double E = 0.5 * (1.44 - 1), c2 = 0.75, s2 = 0.25;
  for (const StrainPoint& p : net.rows.points) {
    EXPECT_NEAR(strainOf(e[p.row[0]]), E * c2, 1e-12);
    EXPECT_NEAR(strainOf(e[p.row[1]]), E * s2, 1e-12);
  }
}

TEST(StrainRows, PointsOnJoinedEdgesAreOneAndCarryTheWholeArea) {
  const Garment g = seamed();
  const Net net(g);
  // 3 x 2 cells over the whole, cut at inner knots: 4 x 3 vertices.
  EXPECT_EQ(net.rows.points.size(), 12u);
  double area = 0, control = 0;
  for (const StrainPoint& p : net.rows.points) {
    EXPECT_GT(p.area_m2, 0);
    area += p.area_m2;
  }
  for (double a : controlAreas(g)) control += a;
  EXPECT_NEAR(area, control, 1e-12 * control);
}

/// Along the seam both sides have one strain, across it each its own. A uniform stress on rows by their areas is that
/// stress in every cell.
TEST(StrainRows, BothSidesOfASeamHaveTheirs) {
  const Net net(folded());
  EXPECT_EQ(net.rows.points.size(), 20u + 35u);
  EXPECT_EQ(net.rows.rows(), 2 * (20 + 35) - 5);
  std::vector<double> multiplier;
  double area = 0;
  for (const StrainPoint& p : net.rows.points) area += p.area_m2;
  EXPECT_NEAR(area, 0.02, 1e-12);
  for (double a : net.rows.area_m2) multiplier.push_back(3 * a);
  for (const Vec2& n : limitStress(net.rows, multiplier)) {
    EXPECT_NEAR(n.x, 3, 1e-12);
    EXPECT_NEAR(n.y, 3, 1e-12);
  }
}

/// The alternating motion of LimitPoints: along the threads, any amount along them; vertices do not see it for odd and
/// even numbers of cells, points of threads do.
TEST(StrainRows, VerticesMissAMotionThatPointsOfThreadsSee) {
  for (int cells : {7, 8}) {
    const Garment g = squareSheet(cells, 1, 0);
    const FreeMap map = buildFreeMap(g);
    std::vector<Vec3> u(map.T.column_count), de;
    for (int j = 0; j < cells + 2; ++j)
      for (int i = 1; i <= cells; ++i) u[g.patches[0].index(i, j)] = {0, (i % 2 ? 1.0 : -1.0) * std::cos(0.3 * j), 0};
    const auto seen = [&](LimitPoints points) {
      const StrainRows rows = buildStrainRows(g, map, unitMobility(map), points);
      de.resize(rows.rows());
      rows.B.multiply<Vec3>(u, de);
      std::vector<Vec3> e, p;
      for (int home : map.home) p.push_back(g.patches[0].points[home]);
      strainVectors(rows, p, e);
      double most = 0;
      for (int i = 0; i < rows.rows(); ++i) most = std::max(most, std::abs(dot(e[i], de[i])));
      return most;
    };
    EXPECT_LT(seen(LimitPoints::vertices), 1e-10);
    EXPECT_GT(seen(LimitPoints::threads), 0.1);
  }
}

/// Zheng 2013, 5.4. Control points that move to and fro along the thread strain no middle of a cell, and the vertices
/// most of all; the four points of a cell hold more strains than the sheet has coordinates.
TEST(StrainRows, PointsOfCellsHourglassOrLock) {
  const Garment g = squareSheet(10, 1, 0);
  const FreeMap map = buildFreeMap(g);
  const NurbsPatch& patch = g.patches[0];
  std::vector<Vec3> motion(map.home.size());
  for (std::size_t k = 0; k < motion.size(); ++k) motion[k].x = map.home[k] % patch.u.count() % 2 ? 1 : -1;
  const std::vector<double> inverse(motion.size(), 1.0);
  const auto strained = [&](LimitPoints points) {
    const StrainRows rows = buildStrainRows(g, map, {inverse, {}}, points);
    std::vector<Vec3> change;
    strainVectors(rows, motion, change);
    double most = 0, area = 0;
    for (const StrainPoint& p : rows.points) {
      area += p.area_m2;
      if (p.uv.x > 0.25 && p.uv.x < 0.75 && p.row[0] >= 0) most = std::max(most, norm(change[p.row[0]]));
    }
    EXPECT_NEAR(area, points == LimitPoints::threads ? 2 : 1, 1e-12);
    return std::pair(most, rows.rows());
  };
  const auto [vertices, vertex_rows] = strained(LimitPoints::vertices);
  const auto [centres, centre_rows] = strained(LimitPoints::centres);
  const auto [gauss, gauss_rows] = strained(LimitPoints::gauss);
  EXPECT_NEAR(vertices, 20, 1e-9);  // 2 over a cell of 0.1 m
  EXPECT_LT(centres, 1e-9);
  EXPECT_GT(gauss, 5);
  EXPECT_EQ(centre_rows, 200);
  EXPECT_EQ(gauss_rows, 800);
  EXPECT_GT(gauss_rows, 3 * static_cast<int>(motion.size()));
  EXPECT_LT(vertex_rows, 2 * static_cast<int>(motion.size()));
}

/// As many rows as the strains have coefficients; areas of each thread sum to the sheet's and are positive; a linear
/// field of stress comes back exactly at the vertices. Weft along u or along v, seams, cubic patches.
TEST(StrainRows, PointsOfThreadsIntegrateTheirSplines) {
  Garment turned = squareSheet(5, 0.3, 0);
  turned.weft = {{0, 1, 0}};
  Garment cubic = squareSheet(5, 0.3, 0);
  cubic.patches[0] = flatPatch(uniformKnots(3, 4), uniformKnots(3, 5), 0.3, 0.3);
  struct Expected {
    Garment garment;
    int rows;
    double area;
  };
  for (const Expected& x : {Expected{squareSheet(5, 0.3, 0), 2 * 6 * 7, 0.09}, Expected{turned, 2 * 6 * 7, 0.09},
                            Expected{cubic, 6 * 8 + 7 * 7, 0.09},
                            // Along the fold both sides share their five warp points.
                            Expected{folded(), 4 * 6 + 5 * 5 + 7 * 6 + 8 * 5 - 5, 0.02}}) {
    const FreeMap map = buildFreeMap(x.garment);
    const StrainRows rows = buildStrainRows(x.garment, map, unitMobility(map), LimitPoints::threads);
    EXPECT_EQ(rows.rows(), x.rows);
    std::array<double, 2> area{0, 0};
    std::vector<double> multiplier(rows.rows());
    for (const StrainPoint& p : rows.points)
      for (int k : {0, 1})
        if (p.row[k] >= 0) {
          EXPECT_GT(p.area_m2, 0);
          area[k] += p.area_m2;
          const Vec3 at = surfaceDerivatives(x.garment.patches[p.patch], p.uv.x, p.uv.y)[0];
          multiplier[p.row[k]] = (2 + at.x - 3 * at.y) * rows.area_m2[p.row[k]];
        }
    EXPECT_NEAR(area[0], x.area, 1e-12);
    EXPECT_NEAR(area[1], x.area, 1e-12);
    const std::vector<Vec2> field = limitStress(rows, multiplier);
    for (std::size_t p = 0; p < x.garment.patches.size(); ++p) {
      std::size_t k = static_cast<std::size_t>(rows.grids[p].first_vertex);
      for (double v : rows.grids[p].vs)
        for (double u : rows.grids[p].us) {
          const Vec3 at = surfaceDerivatives(x.garment.patches[p], u, v)[0];
          EXPECT_NEAR(field[k].x, 2 + at.x - 3 * at.y, 1e-12);
          EXPECT_NEAR(field[k++].y, 2 + at.x - 3 * at.y, 1e-12);
        }
    }
  }
}

TEST(StrainRows, PointsOfThreadsRefuseWhatTheyCannotDo) {
  const auto refused = [](const Garment& g) {
    const FreeMap map = buildFreeMap(g);
    try {
      buildStrainRows(g, map, unitMobility(map), LimitPoints::threads);
      return std::string();
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, "strain_limit.points");
      return e.reason();
    }
  };
  Garment slanted = squareSheet(4, 1, 0), holed = slanted, linear = slanted, creased = slanted;
  slanted.weft = {turnedWeft()};
  holed.trims = {{{{circle({0.47, 0.53}, 0.21, 0.21, true)}}}};
  linear.patches[0] = flatPatch(uniformKnots(1, 4), uniformKnots(2, 4), 1, 1);
  const std::vector<double> knot{0.5};
  creased.patches[0] = insertKnots(creased.patches[0], Direction::v, knot);
  EXPECT_NE(refused(slanted).find("across its knot lines"), std::string::npos);
  EXPECT_NE(refused(holed).find("trimmed"), std::string::npos);
  EXPECT_NE(refused(linear).find("degree 1"), std::string::npos);
  EXPECT_NE(refused(creased).find("derivative jumps"), std::string::npos);
  EXPECT_EQ(refused(squareSheet(4, 1, 0)), "");
}

/// J (translation) = 0 and J (rotation about any axis) = 0, to rounding.
TEST(StrainRows, DoNotSeeRigidMotions) {
  for (const Garment& g : {seamed(), squareSheet(5, 0.3, 0)}) {
    Net net(g);
    net.shake(0.02);
    std::vector<Vec3> e, de(net.rows.rows()), u(net.p.size());
    strainVectors(net.rows, net.p, e);
    for (const Vec3& omega : {Vec3{1, 0, 0}, Vec3{0.3, -0.5, 0.8}}) {
      for (std::size_t k = 0; k < u.size(); ++k) u[k] = Vec3{0.2, -0.7, 0.4} + cross(omega, net.p[k]);
      net.rows.B.multiply<Vec3>(u, de);
      for (int i = 0; i < net.rows.rows(); ++i) EXPECT_NEAR(dot(e[i], de[i]), 0, 1e-12);
    }
  }
}

/// The constant S and the products of F D give J M^-1 J^T.
TEST(StrainRows, MobilityIsThatOfTheGradients) {
  Net net(squareSheet(3, 0.3, 0));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(0.5, 2);
  for (double& w : net.inverse) w = 100 * d(random);
  net.inverse[3] = net.inverse[4] = 0;
  net.rows = buildStrainRows(net.garment, net.map, {net.inverse, {}});
  net.shake(0.02);
  std::vector<Vec3> e;
  strainVectors(net.rows, net.p, e);
  const SymmetricMatrix& S = net.rows.S;
  std::vector<std::vector<Vec3>> J;  // by differences of the strain
  for (int i = 0; i < net.rows.rows(); ++i) J.emplace_back(net.p.size());
  std::vector<Vec3> plus, minus;
  for (std::size_t k = 0; k < net.p.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const double h = 1e-6;
      auto p = net.p;
      p[k][c] += h;
      strainVectors(net.rows, p, plus);
      p[k][c] -= 2 * h;
      strainVectors(net.rows, p, minus);
      for (int i = 0; i < net.rows.rows(); ++i) J[i][k][c] = (strainOf(plus[i]) - strainOf(minus[i])) / (2 * h);
    }
  double largest = 0, worst = 0;
  for (int c = 0; c < S.size; ++c) {
    std::vector<double> column(S.size, 0);
    for (int k = S.offsets[c]; k < S.offsets[c + 1]; ++k) column[S.rows[k]] = S.values[k] * dot(e[c], e[S.rows[k]]);
    if (!net.rows.live[c]) continue;
    for (int r = c; r < S.size; ++r) {
      double exact = 0;
      for (std::size_t k = 0; k < net.p.size(); ++k) exact += net.inverse[k] * dot(J[c][k], J[r][k]);
      largest = std::max(largest, std::abs(exact));
      worst = std::max(worst, std::abs(exact - column[r]));
    }
  }
  EXPECT_LT(worst, 1e-8 * largest);
}

/// Against the largest eigenvalue of M^-1 B^T diag(lambda) B, by powers; threads that are pushed do not count.
TEST(StrainRows, TensionFrequencyBoundsTheSwingOfThreads) {
  Net net(seamed());
  std::vector<double> lambda(net.rows.rows());
  for (std::size_t i = 0; i < lambda.size(); ++i) lambda[i] = i % 3 == 0 ? -1.0 : 1e-3 * (1 + i % 5);
  const int n = net.rows.B.column_count;
  std::vector<double> x(n), stretched(lambda.size()), force(n);
  for (int k = 0; k < n; ++k) x[k] = std::sin(1.7 * k + 0.3);
  double value = 0;
  for (int turn = 0; turn < 3000; ++turn) {
    net.rows.B.multiply<double>(x, stretched);
    for (std::size_t i = 0; i < lambda.size(); ++i) stretched[i] *= std::max(0.0, lambda[i]);
    net.rows.Bt.multiply<double>(stretched, force);
    double size = 0;
    for (int k = 0; k < n; ++k) size = std::max(size, std::abs(force[k] *= net.inverse[k]));
    value = size;
    for (int k = 0; k < n; ++k) x[k] = force[k] / size;
  }
  const double bound = tensionFrequency(net.rows, lambda);
  std::printf("[ measured ] frequency %.5g, bound %.5g rad/s\n", std::sqrt(value), bound);
  EXPECT_GE(bound, std::sqrt(value));
  EXPECT_LT(bound, 2 * std::sqrt(value));
  EXPECT_EQ(tensionFrequency(net.rows, {}), 0);
}

TEST(StrainRows, TrimmedPatchesAreConstrainedWhereTheLoopsCrossKnotLines) {
  Garment g = squareSheet(8, 1, 0);
  g.trims = {{{{circle({0.47, 0.53}, 0.21, 0.21, true)}}}};
  const Net net(g);
  const auto crossings = trimIntersections(g.patches[0], g.trims[0]);
  std::size_t vertices = 0, on_loop = 0;
  double area = 0;
  for (const StrainPoint& p : net.rows.points) {
    const double r = std::hypot(p.uv.x - 0.47, p.uv.y - 0.53);
    EXPECT_GT(r, 0.21 - 1e-9);
    if (std::abs(r - 0.21) < 1e-9)
      ++on_loop;
    else
      ++vertices;
    area += p.area_m2;
    EXPECT_GT(p.area_m2, 0);
  }
  std::size_t kept = 0, alone = 0;
  for (int j = 0; j <= 8; ++j)
    for (int i = 0; i <= 8; ++i) kept += std::hypot(i / 8.0 - 0.47, j / 8.0 - 0.53) > 0.21;
  for (const Vec2& c : crossings) {
    double nearest = 1;
    for (int j = 0; j <= 8; ++j)
      for (int i = 0; i <= 8; ++i)
        if (std::hypot(i / 8.0 - 0.47, j / 8.0 - 0.53) > 0.21)
          nearest = std::min(nearest, std::hypot(i / 8.0 - c.x, j / 8.0 - c.y));
    alone += nearest > 0.05 / 8;
  }
  EXPECT_EQ(vertices, kept);
  EXPECT_GT(on_loop, 8u);
  EXPECT_LE(on_loop, alone);
  EXPECT_NEAR(area, 1 - kPi * 0.21 * 0.21, 1e-6);
}

}  // namespace
}  // namespace gambeson
