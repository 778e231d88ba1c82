/// Distance to an ellipsoid: closed forms, an independent solution in extended precision, and the laws of a distance.
#include "core/contact/ellipsoid.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "core/error.hpp"

namespace gambeson {
namespace {

SurfacePoint closest(const Vec3& axes, const Vec3& p) { return closestOnEllipsoid(ellipsoidMetric({axes}), p); }

Vec3 randomDirection(std::mt19937& rng) {
  std::normal_distribution<double> g;
  return normalized({g(rng), g(rng), g(rng)});
}

/// Signed distance by plain bisection of sum (e_i p_i/(t + e_i^2))^2 = 1 in extended precision (all p_i != 0).
double referenceDistance(const Vec3& e, const Vec3& p) {
  long double min2 = std::numeric_limits<long double>::infinity(), hi = 0;
  for (int i = 0; i < 3; ++i) {
    min2 = std::min(min2, static_cast<long double>(e[i]) * e[i]);
    hi += std::abs(static_cast<long double>(e[i]) * p[i]);
  }
  // w = t + min e^2 > 0 so that points near the focal disc keep their digits.
  long double lo = 0;
  for (int k = 0; k < 400; ++k) {
    const long double w = 0.5L * (lo + hi);
    long double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const long double q =
          static_cast<long double>(e[i]) * p[i] / (w + (static_cast<long double>(e[i]) * e[i] - min2));
      sum += q * q;
    }
    (sum > 1 ? lo : hi) = w;
  }
  long double d2 = 0, f = 0;
  for (int i = 0; i < 3; ++i) {
    const long double e2 = static_cast<long double>(e[i]) * e[i];
    const long double x = e2 * p[i] / (hi + (e2 - min2));
    d2 += (p[i] - x) * (p[i] - x);
    f += (p[i] / static_cast<long double>(e[i])) * (p[i] / static_cast<long double>(e[i]));
  }
  return static_cast<double>(f < 1 ? -std::sqrt(d2) : std::sqrt(d2));
}

TEST(Ellipsoid, SphereIsExactEverywhere) {
  std::mt19937 rng(1);
  for (double r : {1e-3, 0.1, 7.0}) {
    for (double d : {0.0, 1e-9, 0.3, 0.999999, 1.0, 1.000001, 2.0, 1e4}) {
      const Vec3 u = randomDirection(rng), p = d * r * u;
      const SurfacePoint c = closest({r, r, r}, p);
      EXPECT_NEAR(c.distance_m, (d - 1) * r, 4e-16 * r * (1 + d));
      EXPECT_NEAR(norm(c.normal), 1, 1e-15);
      if (d > 0) {
        EXPECT_NEAR(norm(c.normal - u), 0, 1e-14);
      }
    }
  }
}

TEST(Ellipsoid, PointsOnAxesFollowTheClosedForm) {
  const Vec3 e{3, 2, 1};
  // Outside, and inside beyond the focal distance (a^2 - c^2)/a, the vertex of the axis is closest.
  EXPECT_DOUBLE_EQ(closest(e, {5, 0, 0}).distance_m, 2);
  EXPECT_DOUBLE_EQ(closest(e, {-5, 0, 0}).position.x, -3);
  EXPECT_NEAR(closest(e, {2.9, 0, 0}).distance_m, -0.1, 1e-15);
  EXPECT_DOUBLE_EQ(closest(e, {0, 0, 0.25}).distance_m, -0.75);
  EXPECT_DOUBLE_EQ(closest(e, {0, 0, -4}).distance_m, 3);
  EXPECT_DOUBLE_EQ(closest(e, {0, 0, 0}).distance_m, -1);
  // On the long axis nearer the centre: x/a = a p/(a^2 - c^2), z/c = sqrt(1 - (x/a)^2).
  const double p = 1.3, xa = 3 * p / 8, z = std::sqrt(1 - xa * xa);
  const SurfacePoint c = closest(e, {p, 0, 0});
  EXPECT_NEAR(c.position.x, 3 * xa, 1e-14);
  EXPECT_NEAR(c.position.z, z, 1e-14);
  EXPECT_NEAR(c.distance_m, -std::hypot(p - 3 * xa, z), 1e-14);
  // In the plane of the two long axes, inside the focal ellipse.
  const SurfacePoint q = closest(e, {0.5, -0.4, 0});
  EXPECT_NEAR(q.position.x, 9 * 0.5 / 8, 1e-14);
  EXPECT_NEAR(q.position.y, -4 * 0.4 / 3, 1e-14);
  EXPECT_GT(q.position.z, 0);
}

TEST(Ellipsoid, AgreesWithBisectionInExtendedPrecision) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(0, 1);
  for (int trial = 0; trial < 20000; ++trial) {
    const double aspect = trial % 3 == 0 ? 1e3 : trial % 3 == 1 ? 5 : 1.0001;
    const Vec3 e{0.1 * std::pow(aspect, u(rng)), 0.1 * std::pow(aspect, u(rng)), 0.1 * std::pow(aspect, u(rng))};
    const double far = std::pow(10, 6 * u(rng) - 5);  // 1e-5 to 10 of the ellipsoid
    Vec3 p = far * randomDirection(rng);
    for (int i = 0; i < 3; ++i) p[i] *= e[i];
    const double scale = std::max(norm(p), std::max({e.x, e.y, e.z}));
    const SurfacePoint c = closest(e, p);
    ASSERT_NEAR(c.distance_m, referenceDistance(e, p), 1e-14 * scale) << trial;
    const Vec3 s{c.position.x / e.x, c.position.y / e.y, c.position.z / e.z};
    ASSERT_NEAR(norm(s), 1, 4e-15);
    ASSERT_NEAR(norm(p - c.position - c.distance_m * c.normal), 0, 1e-9 * scale) << trial;
  }
}

TEST(Ellipsoid, NothingSampledOnTheSurfaceIsCloser) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(0.2, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec3 e{u(rng), trial % 2 ? 0.5 : u(rng), 0.5};
    Vec3 p = 1.5 * u(rng) * randomDirection(rng);
    if (trial % 4 == 0) p[trial / 4 % 3] = 0;
    const double d = std::abs(closest(e, p).distance_m);
    double best = 1e9;
    for (int i = 0; i <= 300; ++i)
      for (int j = 0; j < 600; ++j) {
        const double th = M_PI * i / 300, ph = 2 * M_PI * j / 600;
        best = std::min(best, norm(p - Vec3{e.x * std::sin(th) * std::cos(ph), e.y * std::sin(th) * std::sin(ph),
                                            e.z * std::cos(th)}));
      }
    EXPECT_LE(d, best + 1e-14);
    EXPECT_GT(d, best - 0.01) << "spacing of the samples is 0.01";
  }
}

TEST(Ellipsoid, GradientOfTheDistanceIsTheNormal) {
  std::mt19937 rng(4);
  const Vec3 e{0.3, 0.09, 0.12};
  const double h = 1e-6;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec3 u = randomDirection(rng);
    const Vec3 p = (0.9 + 0.01 * trial) * Vec3{u.x * e.x, u.y * e.y, u.z * e.z};
    const SurfacePoint c = closest(e, p);
    for (int i = 0; i < 3; ++i) {
      Vec3 a = p, b = p;
      a[i] -= h, b[i] += h;
      EXPECT_NEAR((closest(e, b).distance_m - closest(e, a).distance_m) / (2 * h), c.normal[i], 1e-7);
    }
  }
}

TEST(Ellipsoid, TheRejectIsCertainAndSharp) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> u(0.05, 1.0);
  int close = 0, sharp = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const EllipsoidMetric m = ellipsoidMetric({{u(rng), u(rng), u(rng)}});
    const Vec3 p = 3 * u(rng) * randomDirection(rng);
    const double d = closestOnEllipsoid(m, p).distance_m;
    if (d <= 0) {
      ASSERT_FALSE(surelyBeyond(m, p, 0));
      continue;
    }
    ASSERT_FALSE(surelyBeyond(m, p, d)) << trial;
    ASSERT_FALSE(surelyBeyond(m, p, 2 * d));
    if (d > 0.1 * m.min_axis_m) continue;
    ++close;
    sharp += surelyBeyond(m, p, 0.8 * d);
  }
  EXPECT_GT(close, 200);
  EXPECT_GT(sharp, 0.95 * close);
}

TEST(Ellipsoid, EntryFollowsTheQuadratic) {
  const EllipsoidMetric m = ellipsoidMetric({{2, 1, 1}});
  EXPECT_NEAR(ellipsoidEntry(m, {-3, 0, 0}, {1, 0, 0}).value(), 0.25, 1e-15);
  EXPECT_NEAR(ellipsoidEntry(m, {-3, 0, 0}, {5000, 0, 0}).value(), 1.0 / 5003, 1e-15);  // through and out again
  EXPECT_NEAR(ellipsoidEntry(m, {0, 0, 2}, {0, 0, 1}).value(), 1, 1e-15);
  EXPECT_FALSE(ellipsoidEntry(m, {0, 0, 2}, {0, 0, 1.0001}));
  EXPECT_FALSE(ellipsoidEntry(m, {0, 0, 2}, {0, 0, 3}));
  EXPECT_FALSE(ellipsoidEntry(m, {-2, 0, 1}, {2, 0, 1})) << "grazing";
  EXPECT_FALSE(ellipsoidEntry(m, {0, 0, 0.9}, {0, 0, 0.1})) << "starts inside";
  EXPECT_FALSE(ellipsoidEntry(m, {0, 0, 1}, {0, 0, 1})) << "at rest on the surface";
  EXPECT_FALSE(ellipsoidEntry(m, {0, 0, 1}, {0, 0, 1.1}));
  EXPECT_EQ(ellipsoidEntry(m, {0, 0, 1}, {0, 0, 0.9}).value(), 0) << "touching, moving inward";
  EXPECT_EQ(ellipsoidEntry(m, {0, 0, 1 - 1e-13}, {0, 0, 0.9}).value(), 0) << "touching but for rounding";
}

TEST(Ellipsoid, RejectsBadAxes) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (double bad : {0.0, -1.0, nan, inf}) EXPECT_THROW(ellipsoidMetric({{1, bad, 1}}), InputError) << bad;
}

}  // namespace
}  // namespace gambeson
