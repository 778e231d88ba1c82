/// Strain limiting by fast projection (Zheng 2013, chapter 5): the momentum, tolerance and complementarity of
/// projections.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/error.hpp"
#include "core/motion/closest_projection.hpp"
#include "core/motion/provot_projection.hpp"
#include "core/motion/strain_limit.hpp"
#include "unit/core/motion/strain_net.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

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

Vec3 momentum(const std::vector<double>& inverse, const std::vector<Vec3>& v) {
  Vec3 sum{};
  for (std::size_t k = 0; k < v.size(); ++k) sum += v[k] / inverse[k];
  return sum;
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

/// Provot's correction: strain after strain; momentum, what it gives and the limits hold.
TEST(Projection, OneByOneHoldsTheLimitAndKeepsTheMomentum) {
  Net net(seamed());
  net.shake(0.04, 2);
  const std::vector<Vec3> before = net.p;
  LimitWork work;
  LimitReport report;
  StrainLimit limit{LimitMode::upper_limit, 0.02, 1e-4, 1000};
  limit.method = LimitMethod::provot;
  startProjection(net.rows, {}, work);
  projectOneByOne(net.rows, limit, net.p, report, work);
  EXPECT_TRUE(report.converged);
  EXPECT_GT(report.projections, 3);
  EXPECT_GT(report.active, 3);
  std::vector<Vec3> e, moved;
  strainVectors(net.rows, net.p, e);
  for (int i = 0; i < net.rows.rows(); ++i) {
    EXPECT_LE(strainOf(e[i]), 0.02 + 1e-4);
    EXPECT_GE(work.multiplier[i], 0);
  }
  const std::vector<double>& inverse = net.rows.mobility.inverse_mass;
  Vec3 sum{};
  double scale = 0;
  for (std::size_t k = 0; k < net.p.size(); ++k) {
    EXPECT_LT(norm(net.p[k] - before[k] + inverse[k] * work.pull[k]), 1e-15);
    sum += work.pull[k];
    scale += norm(work.pull[k]);
  }
  EXPECT_LT(norm(sum), 1e-13 * scale);
  // A few sweeps leave something, and say how much.
  Net again(seamed());
  again.shake(0.04, 2);
  limit.max_projections = 2;
  LimitReport some;
  startProjection(again.rows, {}, work);
  projectOneByOne(again.rows, limit, again.p, some, work);
  EXPECT_FALSE(some.converged);
  EXPECT_EQ(some.projections, 2);
  EXPECT_GT(some.residual, 1e-4);
}

TEST(Projection, OneByOneGoesWithUpperLimits) {
  Net net(squareSheet(4, 0.2, 0));
  LimitWork work;
  LimitReport report;
  startProjection(net.rows, {}, work);
  EXPECT_THROW(projectOneByOne(net.rows, {LimitMode::equality}, net.p, report, work), InputError);
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

}  // namespace
}  // namespace gambeson
