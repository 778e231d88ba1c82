// NURBS basis and surfaces against closed forms: Piegl and Tiller, The NURBS Book (1997), and Zheng 2013, section 2.1.
#include "core/nurbs/nurbs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/error.hpp"

namespace gambeson {
namespace {

std::vector<double> samples(const KnotVector& k, int per_cell) {
  std::vector<double> out;
  const auto b = breakpoints(k);
  for (std::size_t c = 0; c + 1 < b.size(); ++c)
    for (int i = 0; i < per_cell; ++i) out.push_back(b[c] + (b[c + 1] - b[c]) * i / per_cell);
  out.push_back(b.back());
  return out;
}

/// A wavy rational patch with uneven knots and one repeated inner knot.
NurbsPatch wavyPatch(int p, int q) {
  NurbsPatch s;
  s.u = {p, {}};
  s.u.knots.assign(p + 1, -0.5);
  for (double k : {0.1, 0.35, 0.8}) s.u.knots.push_back(k);
  s.u.knots.insert(s.u.knots.end(), p + 1, 1.25);
  s.v = {q, {}};
  s.v.knots.assign(q + 1, 0.0);
  for (double k : {0.3, 0.6}) s.v.knots.push_back(k);
  if (q > 1) s.v.knots.push_back(0.6);
  s.v.knots.insert(s.v.knots.end(), q + 1, 1.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> d(-0.2, 0.2);
  const auto gu = grevillePoints(s.u), gv = grevillePoints(s.v);
  for (double y : gv)
    for (double x : gu) {
      s.points.push_back({x + 0.2 * d(random), y + 0.2 * d(random), std::sin(3 * x) * y + d(random)});
      s.weights.push_back(1 + d(random) * 3);
    }
  return s;
}

/// A quarter of a cylinder, exact with the weight 1/sqrt(2) (The NURBS Book, section 7.3).
NurbsPatch quarterCylinder(double radius, double length) {
  NurbsPatch s;
  s.u = uniformKnots(2, 1);
  s.v = uniformKnots(1, 1);
  for (int j = 0; j < 2; ++j) {
    const double z = j * length;
    s.points.insert(s.points.end(), {{radius, 0, z}, {radius, radius, z}, {0, radius, z}});
    s.weights.insert(s.weights.end(), {1, std::sqrt(0.5), 1});
  }
  return s;
}

std::string rejection(const std::function<void()>& f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.where().key.empty() ? "?" : e.where().key;
  }
  return "accepted";
}

TEST(Knots, UniformBreakpointsAndGreville) {
  const auto k = uniformKnots(2, 4);
  EXPECT_EQ(k.knots, (std::vector<double>{0, 0, 0, .25, .5, .75, 1, 1, 1}));
  EXPECT_EQ(k.count(), 6);
  EXPECT_EQ(breakpoints(k), (std::vector<double>{0, .25, .5, .75, 1}));
  EXPECT_EQ(grevillePoints(k), (std::vector<double>{0, .125, .375, .625, .875, 1}));
}

TEST(Knots, SpanAtKnotsRepeatedKnotsAndEnds) {
  const KnotVector k{2, {0, 0, 0, 1, 2, 2, 3, 3, 3}};
  EXPECT_EQ(findSpan(k, 0), 2);
  EXPECT_EQ(findSpan(k, 1), 3);
  EXPECT_EQ(findSpan(k, std::nextafter(2, 0)), 3);
  EXPECT_EQ(findSpan(k, 2), 5);
  EXPECT_EQ(findSpan(k, 3), 5);
  const KnotVector unclamped{2, {0, 1, 2, 3, 4, 5, 6, 7}};
  EXPECT_EQ(findSpan(unclamped, 2), 2);
  EXPECT_EQ(findSpan(unclamped, 5), 4);
}

TEST(Basis, BookExample2_3) {
  // The NURBS Book, examples 2.3 and 2.4: U = {0,0,0,1,2,3,4,4,5,5,5}, p = 2, u = 5/2.
  const KnotVector k{2, {0, 0, 0, 1, 2, 3, 4, 4, 5, 5, 5}};
  const int s = findSpan(k, 2.5);
  ASSERT_EQ(s, 4);
  double b[9];
  basisDerivatives(k, s, 2.5, 2, b);
  const double want[9] = {1. / 8, 6. / 8, 1. / 8, -.5, 0, .5, 1, -2, 1};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(b[i], want[i], 1e-15) << i;
}

TEST(Basis, PartitionOfUnityAndZeroBeyondDegree) {
  for (int p = 1; p <= 5; ++p) {
    const KnotVector k = wavyPatch(p, 2).u;
    std::vector<double> b(7 * (p + 1));
    for (double u : samples(k, 7)) {
      basisDerivatives(k, findSpan(k, u), u, 6, b);
      for (int d = 0; d <= 6; ++d) {
        double sum = 0, size = 1;
        for (int i = 0; i <= p; ++i) {
          sum += b[d * (p + 1) + i];
          size += std::abs(b[d * (p + 1) + i]);
          if (d == 0) {
            EXPECT_GE(b[i], 0);
          }
          if (d > p) {
            EXPECT_EQ(b[d * (p + 1) + i], 0);
          }
        }
        EXPECT_NEAR(sum, d == 0 ? 1 : 0, 1e-14 * size) << "degree " << p << " derivative " << d << " at " << u;
      }
    }
  }
}

TEST(Basis, DerivativesAgainstFiniteDifferences) {
  const double h = 1e-5;
  for (int p = 1; p <= 5; ++p) {
    const KnotVector k = wavyPatch(p, 2).u;
    const int w = p + 1;
    std::vector<double> a(4 * w), b(4 * w), c(4 * w);
    for (double u : {-0.4, 0.0, 0.2, 0.5, 0.9, 1.2}) {
      const int s = findSpan(k, u);
      basisDerivatives(k, s, u - h, 3, a);
      basisDerivatives(k, s, u, 3, b);
      basisDerivatives(k, s, u + h, 3, c);
      for (int d = 0; d < 3; ++d)
        for (int i = 0; i < w; ++i)
          EXPECT_NEAR((c[d * w + i] - a[d * w + i]) / (2 * h), b[(d + 1) * w + i], 2e-6) << p << " " << d;
    }
  }
}

TEST(Surface, RationalDerivativesAgainstFiniteDifferences) {
  const double h = 1e-5;
  for (int p = 1; p <= 5; ++p) {
    const NurbsPatch s = wavyPatch(p, 6 - p);
    validate(s);
    for (double u : {-0.3, 0.2, 0.6, 1.0})
      for (double v : {0.1, 0.45, 0.85}) {
        const auto x = surfaceDerivatives(s, u, v);
        const auto xa = surfaceDerivatives(s, u - h, v), xb = surfaceDerivatives(s, u + h, v);
        const auto ya = surfaceDerivatives(s, u, v - h), yb = surfaceDerivatives(s, u, v + h);
        const auto near = [&](const Vec3& a, const Vec3& b, int d) {
          EXPECT_LT(norm(a - b), 1e-6) << "degrees " << p << " " << 6 - p << " derivative " << d;
        };
        near((xb[0] - xa[0]) / (2 * h), x[1], 1);
        near((yb[0] - ya[0]) / (2 * h), x[2], 2);
        near((xb[1] - xa[1]) / (2 * h), x[3], 3);
        near((yb[2] - ya[2]) / (2 * h), x[4], 4);
        near((yb[1] - ya[1]) / (2 * h), x[5], 5);
        const auto basis = surfaceBasis(s, u, v);
        double sum = 0;
        for (double r : basis.values[0]) sum += r;
        EXPECT_NEAR(sum, 1, 1e-14);
      }
  }
}

TEST(Surface, QuarterCylinderIsExact) {
  const double R = 0.37, L = 1.3;
  const NurbsPatch s = quarterCylinder(R, L);
  for (double u : samples(s.u, 17))
    for (double v : {0.0, 0.4, 1.0}) {
      const auto x = surfaceDerivatives(s, u, v);
      EXPECT_NEAR(std::hypot(x[0].x, x[0].y), R, 1e-15);
      EXPECT_NEAR(x[0].z, L * v, 1e-15);
      // Curvature of a circle: (x,uu . n) / |x,u|^2 = -1/R with the outward normal; straight along v.
      const Vec3 n{x[0].x / R, x[0].y / R, 0};
      EXPECT_NEAR(dot(x[3], n) / norm2(x[1]), -1 / R, 1e-12);
      EXPECT_NEAR(norm(x[4]), 0, 1e-12);
      EXPECT_NEAR(norm(x[5]), 0, 1e-12);
    }
}

/// Largest difference of position and of derivatives over the same parameters, over the size of the value.
double largestChange(const NurbsPatch& a, const NurbsPatch& b) {
  double worst = 0;
  for (double u : samples(a.u, 5))
    for (double v : samples(a.v, 5)) {
      const auto xa = surfaceDerivatives(a, u, v), xb = surfaceDerivatives(b, u, v);
      for (int d = 0; d < 3; ++d) worst = std::max(worst, norm(xa[d] - xb[d]) / (1 + norm(xa[d])));
    }
  return worst;
}

TEST(Refine, KnotInsertionKeepsGeometry) {
  for (int p = 1; p <= 5; ++p) {
    const NurbsPatch s = wavyPatch(p, 6 - p);
    NurbsPatch t = insertKnot(s, Direction::u, 0.5, p);
    t = insertKnots(t, Direction::v, std::vector<double>{0.2, 0.35, 0.9});
    if (p > 1) t = insertKnot(t, Direction::u, 0.1);
    validate(t);
    EXPECT_EQ(t.u.count(), s.u.count() + p + (p > 1));
    EXPECT_EQ(t.v.count(), s.v.count() + 3);
    EXPECT_LT(largestChange(s, t), 1e-13) << p;
  }
}

TEST(Refine, KnotInsertionIntoUnclampedKnots) {
  NurbsPatch s = wavyPatch(3, 1);
  s.u.knots = {0, 0.1, 0.25, 0.5, 0.7, 1, 1.1, 1.3, 1.4, 1.7, 2};
  validate(s);
  const NurbsPatch inserted = insertKnot(s, Direction::u, 0.6, 2), elevated = elevateDegree(s, Direction::u);
  EXPECT_EQ(std::count(inserted.u.knots.begin(), inserted.u.knots.end(), 0.6), 2);
  EXPECT_EQ(inserted.u.count(), s.u.count() + 2);
  EXPECT_EQ(inserted.points.size(), s.points.size() + static_cast<std::size_t>(2 * s.v.count()));
  EXPECT_LT(largestChange(s, inserted), 1e-13);
  EXPECT_EQ(elevated.u.degree, s.u.degree + 1);
  EXPECT_GT(elevated.points.size(), s.points.size());
  EXPECT_LT(largestChange(s, elevated), 1e-13);
}

TEST(Refine, InsertionToFullMultiplicityPutsAControlPointOnTheSurface) {
  const NurbsPatch s = quarterCylinder(0.5, 1), t = insertKnot(s, Direction::u, 0.25, 2);
  EXPECT_LT(norm(t.points[t.index(2, 0)] - surfaceDerivatives(s, 0.25, 0)[0]), 1e-15);
}

TEST(Refine, DegreeElevationKeepsGeometryAndContinuity) {
  for (int p = 1; p <= 5; ++p) {
    const NurbsPatch s = wavyPatch(p, 6 - p);
    const NurbsPatch t = elevateDegree(elevateDegree(s, Direction::u, 2), Direction::v);
    validate(t);
    EXPECT_EQ(t.u.degree, p + 2);
    EXPECT_EQ(t.v.degree, 7 - p);
    // Three inner knots of multiplicity 1 become 3: the continuity stays p - 1.
    EXPECT_EQ(std::count(t.u.knots.begin(), t.u.knots.end(), 0.35), 3);
    EXPECT_LT(largestChange(s, t), 1e-13) << p;
  }
}

TEST(Refine, ElevatedCircleHasTheBookWeights) {
  // (1, w, 1) of degree 2 becomes (1, (1 + 2 w)/3, (1 + 2 w)/3, 1) of degree 3 (The NURBS Book, eq. 5.36).
  const NurbsPatch t = elevateDegree(quarterCylinder(1, 1), Direction::u);
  const double w = (1 + 2 * std::sqrt(0.5)) / 3;
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(t.weights[i], i % 3 ? w : 1, 1e-15);
}

TEST(Refine, RejectsBadRequests) {
  const NurbsPatch s = wavyPatch(2, 3);
  EXPECT_EQ(rejection([&] { insertKnot(s, Direction::u, -0.5); }), "knot");
  EXPECT_EQ(rejection([&] { insertKnot(s, Direction::u, 1.25); }), "knot");
  EXPECT_EQ(rejection([&] { insertKnot(s, Direction::u, std::nan("")); }), "knot");
  EXPECT_EQ(rejection([&] { insertKnot(s, Direction::u, 0.35, 2); }), "knot");
  EXPECT_EQ(rejection([&] { insertKnot(s, Direction::u, 0.36, -1); }), "times");
  EXPECT_EQ(rejection([&] { elevateDegree(s, Direction::u, -1); }), "by");
}

TEST(Surface, RejectsBadPatches) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto broken = [](const std::function<void(NurbsPatch&)>& damage) {
    NurbsPatch s = wavyPatch(2, 2);
    damage(s);
    return rejection([&] { validate(s); });
  };
  EXPECT_EQ(broken([](auto&) {}), "accepted");
  EXPECT_EQ(broken([](auto& s) { s.u.degree = 0; }), "u.degree");
  EXPECT_EQ(broken([](auto& s) { s.u.degree = std::numeric_limits<int>::max(); }), "u.knots");
  EXPECT_EQ(broken([](auto& s) { s.v.knots.resize(5); }), "v.knots");
  EXPECT_EQ(broken([](auto& s) { std::swap(s.u.knots[3], s.u.knots[4]); }), "u.knots[4]");
  EXPECT_EQ(broken([&](auto& s) { s.u.knots[3] = nan; }), "u.knots[3]");
  EXPECT_EQ(broken([](auto& s) { s.u.knots[4] = s.u.knots[5] = s.u.knots[3]; }), "u.knots[3]");
  EXPECT_EQ(broken([](auto& s) { s.u.knots[3] = s.u.knots[0]; }), "u.knots[0]");
  EXPECT_EQ(broken([](auto& s) { s.points.pop_back(); }), "points");
  EXPECT_EQ(broken([](auto& s) { s.weights.push_back(1); }), "weights");
  EXPECT_EQ(broken([&](auto& s) { s.points[7].y = nan; }), "points[7]");
  EXPECT_EQ(broken([](auto& s) { s.weights[3] = 0; }), "weights[3]");
  EXPECT_EQ(broken([&](auto& s) { s.weights[3] = nan; }), "weights[3]");
  EXPECT_EQ(rejection([] { uniformKnots(0, 3); }), "degree");
  EXPECT_EQ(rejection([] { uniformKnots(2, 0); }), "cells");
}

}  // namespace
}  // namespace gambeson
