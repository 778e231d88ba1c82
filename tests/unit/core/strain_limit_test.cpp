/// Strain limiting by fast projection (Zheng 2013, chapter 5): the constraints themselves, the projection's momentum,
/// tolerance and complementarity.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/dynamics/closest_projection.hpp"
#include "core/dynamics/strain_limit.hpp"
#include "core/error.hpp"
#include "motion_shapes.hpp"
#include "trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::vector<double> uniformInverse(const FreeMap& map, double mass = 0.01) {
  return std::vector<double>(map.T.column_count, 1 / mass);
}

struct Net {
  Garment garment;
  FreeMap map;
  std::vector<double> inverse;
  StrainRows rows;
  std::vector<Vec3> p;

  explicit Net(const Garment& g)
      : garment(g),
        map(buildFreeMap(g)),
        inverse(uniformInverse(map)),
        rows(buildStrainRows(g, map, {inverse, {}})),
        p(deformedFree(g, map, 0)) {}
  /// Each point at random by up to `size`.
  void shake(double size, unsigned seed = 5) { p = deformedFree(garment, map, size, seed); }
};

Garment seamed() { return fourPatches(2, 3, true, SeamKind::G1, 0, plainFabric()); }

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

/// Two flat patches of 0.1 m, joined along x = 0.1 with a fold allowed, the second with cells half as wide.
Garment folded() {
  NurbsPatch a = flatPatch(uniformKnots(2, 3), uniformKnots(2, 4), 0.1, 0.1), b = a;
  b = flatPatch(uniformKnots(2, 6), uniformKnots(2, 4), 0.1, 0.1);
  for (Vec3& x : b.points) x.x += 0.1;
  return garmentOf({a, b}, {{{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 0}}, plainFabric());
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

/// The strains of a patch at one of its own vertices, from its own surface.
std::array<double, 2> strainsAt(const Net& net, int patch, Vec2 uv) {
  std::vector<Vec3> q(controlOffsets(net.garment).back());
  net.map.T.multiply<Vec3>(net.p, q);
  const NurbsPatch& rest = net.garment.patches[patch];
  NurbsPatch now = rest;
  const int first = controlOffsets(net.garment)[patch];
  now.points.assign(q.begin() + first, q.begin() + first + static_cast<long>(now.points.size()));
  const auto A = surfaceDerivatives(rest, uv.x, uv.y), a = surfaceDerivatives(now, uv.x, uv.y);
  const Vec3 n = normalized(cross(A[1], A[2]));
  const Vec3 weft = normalized(net.garment.weft[patch] - dot(net.garment.weft[patch], n) * n), warp = cross(n, weft);
  std::array<double, 2> E;
  for (int k = 0; k < 2; ++k) {
    const Vec3& D = k == 0 ? weft : warp;
    // D = c1 A1 + c2 A2
    const double a11 = dot(A[1], A[1]), a12 = dot(A[1], A[2]), a22 = dot(A[2], A[2]), det = a11 * a22 - a12 * a12;
    const double d1 = dot(D, A[1]), d2 = dot(D, A[2]);
    const Vec3 FD = ((a22 * d1 - a12 * d2) / det) * a[1] + ((a11 * d2 - a12 * d1) / det) * a[2];
    E[k] = 0.5 * (norm2(FD) - 1);
  }
  return E;
}

TEST(Projection, HoldsBothSidesOfASeam) {
  for (const Garment& g : {folded(), fourPatches(2, 2, false, SeamKind::C0, 1, plainFabric()), seamed()}) {
    Net net(g);
    net.shake(0.01);
    const auto most = [&] {
      double strain = 0;
      for (int p = 0; p < static_cast<int>(g.patches.size()); ++p)
        for (double u : breakpoints(g.patches[p].u))
          for (double v : breakpoints(g.patches[p].v))
            for (double E : strainsAt(net, p, {u, v})) strain = std::max(strain, std::abs(E));
      return strain;
    };
    EXPECT_GT(most(), 0.05);
    LimitWork work;
    LimitReport report;
    startProjection(net.rows, {}, work);
    projectStrain(net.rows, {LimitMode::equality, 0, 1e-6}, true, net.p, report, work);
    std::printf("[ measured ] %zu points, %d rows, %d projections\n", net.rows.points.size(), net.rows.rows(),
                report.projections);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(most(), 1.01e-6);
  }
}

Mobility unitMobility(const FreeMap& map) { return {std::vector<double>(map.T.column_count, 1.0), {}}; }

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

/// Zheng 2013, 5.4. Control points that move to and fro along the thread strain no middle of a cell, and the vertices most
/// of all; the four points of a cell hold more strains than the sheet has coordinates.
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

Vec3 momentum(const std::vector<double>& inverse, const std::vector<Vec3>& v) {
  Vec3 sum{};
  for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] / inverse[k];
  return sum;
}

TEST(Projection, ReachesTheToleranceAndKeepsTheMomentum) {
  for (LimitMode mode : {LimitMode::equality, LimitMode::upper_limit}) {
    Net net(seamed());
    std::mt19937 random(2);
    std::uniform_real_distribution<double> d(0.5, 2);
    for (double& w : net.inverse) w *= d(random);
    net.rows = buildStrainRows(net.garment, net.map, {net.inverse, {}});
    net.shake(0.03);
    const std::vector<Vec3> before = net.p;
    LimitWork work;
    LimitReport report;
    StrainLimit limit{mode, 0.01, 1e-9};
    startProjection(net.rows, {}, work);
    EXPECT_GT(limitResidual(net.rows, limit, net.p, work), 0.05);
    projectStrain(net.rows, limit, true, net.p, report, work);
    EXPECT_TRUE(report.converged);
    EXPECT_LT(report.projections, 15);
    EXPECT_LE(limitResidual(net.rows, limit, net.p, work), 1e-9);
    std::vector<Vec3> moved;
    for (std::size_t k = 0; k < before.size(); ++k) moved.push_back(net.p[k] - before[k]);
    double size = 0;
    for (std::size_t k = 0; k < before.size(); ++k) size += norm(moved[k]) / net.inverse[k];
    EXPECT_GT(size, 1e-4);
    EXPECT_LT(norm(momentum(net.inverse, moved)), 1e-13 * size);
  }
}

/// Threads that yield end with the strain of springs, T = k C, whatever the step: C = lambda/(k a).
TEST(Projection, ThreadsThatYieldAreSprings) {
  for (LimitMode mode : {LimitMode::equality, LimitMode::upper_limit}) {
    Net net(seamed());
    net.shake(0.03);
    const double dt = 1e-3;
    StrainLimit limit{mode, 0.01, 1e-9};
    limit.stiffness_N_per_m = 2000;
    limit.restore_per_s = 1e6;  // leaves none
    LimitWork work;
    LimitReport report;
    startProjection(net.rows, {}, work);
    leaveStrain(net.rows, limit, net.p, {}, dt, work);
    projectStrain(net.rows, limit, true, net.p, report, work);
    EXPECT_TRUE(report.converged);
    const double largest = *std::max_element(net.rows.area_m2.begin(), net.rows.area_m2.end());
    std::vector<Vec3> e;
    strainVectors(net.rows, net.p, e);
    double worst = 0, most = 0;
    for (int i = 0; i < net.rows.rows(); ++i) {
      const double C = strainOf(e[i]) - (mode == LimitMode::equality ? 0 : limit.limit);
      const double area = std::max(net.rows.area_m2[i], 0.1 * largest);
      const double spring = work.multiplier[i] / (dt * dt * area * limit.stiffness_N_per_m);
      if (mode == LimitMode::upper_limit && work.multiplier[i] == 0) {
        EXPECT_LT(C, 1e-9);
        continue;
      }
      worst = std::max(worst, std::abs(C - spring));
      most = std::max(most, std::abs(spring));
    }
    EXPECT_LT(worst, 1e-9);
    EXPECT_GT(most, 1e-3);
  }
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

/// Eq. 5.15: C = 0 with the move -M^-1 J^T mu of the gradients at the end, so that no other point on the constraints is
/// closer; fast projection comes near it and is farther. Momentum is kept.
TEST(Projection, ClosestPointIsTheClosest) {
  Net net(seamed());
  net.shake(0.03);
  const std::vector<Vec3> start = net.p;
  StrainLimit limit{LimitMode::equality, 0, 1e-10};
  const auto distance = [&](const std::vector<Vec3>& p) {
    double sum = 0;
    for (std::size_t k = 0; k < p.size(); ++k) sum += norm2(p[k] - start[k]) / net.inverse[k];
    return sum;
  };
  LimitWork fast_work, work;
  LimitReport fast, report;
  std::vector<Vec3> fast_p = start, p = start;
  startProjection(net.rows, {}, fast_work);
  projectStrain(net.rows, limit, true, fast_p, fast, fast_work);
  startProjection(net.rows, {}, work);
  projectClosest(net.rows, limit, p, report, work);
  EXPECT_TRUE(fast.converged && report.converged);
  EXPECT_LT(report.projections, 15);
  std::vector<Vec3> e, forces(p.size());
  strainVectors(net.rows, p, e);
  for (int i = 0; i < net.rows.rows(); ++i) {
    EXPECT_LT(std::abs(strainOf(e[i])), 1e-10);
    e[i] *= work.multiplier[i];
  }
  net.rows.Bt.multiply<Vec3>(e, forces);
  double residual = 0, size = 0;
  std::vector<Vec3> moved;
  for (std::size_t k = 0; k < p.size(); ++k) {
    moved.push_back(p[k] - start[k]);
    residual = std::max(residual, norm(moved[k] / net.inverse[k] + forces[k]));
    size = std::max(size, norm(forces[k]));
  }
  std::printf("[ measured ] closest %.8g, fast %.8g, equilibrium within %.2g\n", distance(p), distance(fast_p),
              residual / size);
  EXPECT_LT(residual, 1e-6 * size);
  EXPECT_LT(distance(p), distance(fast_p) * (1 - 1e-6));
  EXPECT_GT(distance(p), 0.8 * distance(fast_p));
  EXPECT_LT(norm(momentum(net.inverse, moved)), 1e-12 * size);
  EXPECT_THROW(projectClosest(net.rows, {LimitMode::upper_limit, 0, 1e-9}, p, report, work), InputError);
}

/// One projection: the impulses have no moment about the positions at which their gradients were taken.
TEST(Projection, KeepsTheAngularMomentum) {
  Net net(seamed());
  net.shake(0.01);
  const std::vector<Vec3> before = net.p;
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  projectStrain(net.rows, {LimitMode::equality, 0, 1e-9, 1}, true, net.p, report, work);
  ASSERT_EQ(report.projections, 1);
  Vec3 sum{};
  double size = 0;
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Vec3 moment = cross(before[k], net.p[k] - before[k]) / net.inverse[k];
    sum += moment;
    size += norm(moment);
  }
  EXPECT_LT(norm(sum), 1e-12 * size);
}

TEST(Projection, PullsHeldPointsByWhatItGivesTheFree) {
  Net net(squareSheet(5, 0.3, 0));
  for (int k = 0; k < 7; ++k) net.inverse[k] = 0;
  net.rows = buildStrainRows(net.garment, net.map, {net.inverse, {}});
  net.shake(0.01);
  const std::vector<Vec3> before = net.p;
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  projectStrain(net.rows, {LimitMode::equality, 0, 1e-8}, true, net.p, report, work);
  EXPECT_TRUE(report.converged);
  Vec3 free{}, held{};
  for (std::size_t k = 0; k < before.size(); ++k) {
    if (net.inverse[k] == 0) {
      EXPECT_EQ(net.p[k], before[k]);
      held -= work.pull[k];
    } else {
      free += (net.p[k] - before[k]) / net.inverse[k];
    }
  }
  EXPECT_GT(norm(free), 1e-6);
  EXPECT_LT(norm(free + held), 1e-12 * norm(free));
}

/// Held on opposite edges at rest, the rows along each line between them are dependent: the telescoping sum of the
/// stretches is given. The positions do not suffer.
TEST(Projection, RedundantRowsDoNotSpoilIt) {
  Net net(squareSheet(6, 0.3, 0));
  for (int j = 0; j < 8; ++j) net.inverse[8 * j] = net.inverse[7 + 8 * j] = 0;
  net.rows = buildStrainRows(net.garment, net.map, {net.inverse, {}});
  const std::vector<Vec3> rest = net.p;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-1, 1);
  for (std::size_t k = 0; k < net.p.size(); ++k)
    if (net.inverse[k] > 0) net.p[k] += 1e-3 * Vec3{d(random), d(random), 0};
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  projectStrain(net.rows, {LimitMode::equality, 0, 1e-4}, true, net.p, report, work);
  EXPECT_TRUE(report.converged);
  EXPECT_LT(report.projections, 20);  // linear: the solution is isolated
  for (std::size_t k = 0; k < net.p.size(); ++k) EXPECT_LT(norm(net.p[k] - rest[k]), 5e-3);
}

/// Held edges pulled apart by 10 %: no answer exists; the report says so, and the positions stay where cloth can be.
TEST(Projection, SaysWhatItCannotDo) {
  Net net(squareSheet(6, 0.3, 0));
  for (int j = 0; j < 8; ++j) {
    net.inverse[8 * j] = net.inverse[7 + 8 * j] = 0;
    net.p[7 + 8 * j].x += 0.03;
  }
  net.rows = buildStrainRows(net.garment, net.map, {net.inverse, {}});
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  projectStrain(net.rows, {LimitMode::equality, 0, 1e-6}, true, net.p, report, work);
  EXPECT_FALSE(report.converged);
  EXPECT_GT(report.residual, 0.05);
  EXPECT_EQ(report.projections, 40);
  for (const Vec3& x : net.p) EXPECT_LT(norm(x), 2);
}

/// lambda >= 0, C <= 0, and one of them 0, whatever the start of the active set.
TEST(Projection, UpperLimitIsComplementary) {
  for (unsigned seed = 0; seed < 6; ++seed) {
    Net net(seamed());
    net.shake(0.04, seed);
    std::vector<double> warm;
    if (seed % 2) warm.assign(net.rows.rows(), 1.0);
    LimitWork work;
    LimitReport report;
    const StrainLimit limit{LimitMode::upper_limit, 0.02, 1e-9};
    startProjection(net.rows, warm, work);
    projectStrain(net.rows, limit, true, net.p, report, work);
    EXPECT_TRUE(report.converged);
    std::vector<Vec3> e;
    strainVectors(net.rows, net.p, e);
    int pulling = 0, slack = 0;
    for (int i = 0; i < net.rows.rows(); ++i) {
      EXPECT_GE(work.multiplier[i], 0);
      EXPECT_LE(strainOf(e[i]), 0.02 + 1e-9);
      if (work.multiplier[i] > 0) {
        ++pulling;
        EXPECT_NEAR(strainOf(e[i]), 0.02, 1e-7);
      } else {
        slack += strainOf(e[i]) < 0.02 - 1e-4;
      }
    }
    EXPECT_EQ(report.active, pulling);
    EXPECT_GT(pulling, 3);
    EXPECT_GT(slack, 3);
  }
}

TEST(Projection, ShortenedClothIsFree) {
  Net net(squareSheet(4, 0.2, 0));
  for (Vec3& x : net.p) x *= 0.9;
  const std::vector<Vec3> before = net.p;
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  projectStrain(net.rows, {LimitMode::upper_limit, 0, 1e-6}, true, net.p, report, work);
  EXPECT_EQ(report.projections, 0);
  EXPECT_EQ(net.p, before);
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
