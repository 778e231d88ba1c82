/// The certified impact test against exact integer arithmetic (tests/exact) and closed forms.
#include "core/contact/certified_impact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "exact/exact_impact.hpp"
#include "exact/query_generator.hpp"

namespace gambeson {
namespace {

using exact::MovingPoints;
using exact::QueryGenerator;
using exact::QueryKind;

const std::array<Vec3, 3> kFlat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

FourPoints over(const Vec3& p) { return {p, kFlat[0], kFlat[1], kFlat[2]}; }

std::optional<ImpactTime> impact(const MovingPoints& q, bool edges, double separation_m, double tolerance_m) {
  return (edges ? edgeEdgeImpact : pointTriangleImpact)(q.x0, q.x1, separation_m, tolerance_m);
}
bool within(const MovingPoints& q, bool edges, const ImpactTime& h, double distance_m) {
  return (edges ? exact::edgeEdgeWithin : exact::pointTriangleWithin)(q.x0, q.x1, h.time, h.u, h.v, distance_m);
}
double extent(const MovingPoints& q) {
  double e = 0;
  for (const auto* x : {&q.x0, &q.x1})
    for (const Vec3& a : *x)
      for (const Vec3& b : *x)
        for (int k = 0; k < 3; ++k) e = std::max(e, std::abs(a[k] - b[k]));
  return e;
}

std::string print(const MovingPoints& q) {
  std::string s;
  char line[100];
  for (const auto* x : {&q.x0, &q.x1})
    for (const Vec3& a : *x) std::snprintf(line, sizeof line, "  {%a, %a, %a}\n", a.x, a.y, a.z), s += line;
  return s;
}

/// 10^5 queries, or GAMBESON_IMPACT_QUERIES of them.
int queryCount() {
  const char* set = std::getenv("GAMBESON_IMPACT_QUERIES");
  return set ? std::atoi(set) : 100000;
}

TEST(CertifiedImpact, PointFallsOnATriangle) {
  const auto hit = pointTriangleImpact(over({0.25, 0.5, 1}), over({0.25, 0.5, -3}), 0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->time, 0.25, 1e-12);
  EXPECT_LE(hit->time, 0.25);
  EXPECT_NEAR(hit->u, 0.25, 1e-12);
  EXPECT_NEAR(hit->v, 0.5, 1e-12);
  EXPECT_FALSE(pointTriangleImpact(over({0.6, 0.6, 1}), over({0.6, 0.6, -3}), 0));
  EXPECT_FALSE(pointTriangleImpact(over({0.25, 0.5, 1}), over({0.25, 0.5, 1e-6}), 0));
  EXPECT_TRUE(pointTriangleImpact(over({0.5, 0.5, 1}), over({0.5, 0.5, -1}), 0)) << "through an edge";
  EXPECT_TRUE(pointTriangleImpact(over({0, 0, 1}), over({0, 0, -1}), 0)) << "through a corner";
}

TEST(CertifiedImpact, SeparationIsEuclidean) {
  // Beside an edge, a corner and the face: the time at which the distance is s, in closed form.
  const double s = 0.01;
  const auto face = pointTriangleImpact(over({0.2, 0.2, 1}), over({0.2, 0.2, 0}), s, 1e-12);
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->time, 1 - s, 1e-11);
  // p falls beside the edge y = 0 at a distance of 0.006: height 0.008.
  const auto edge = pointTriangleImpact(over({0.5, -0.006, 1}), over({0.5, -0.006, 0}), s, 1e-12);
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->time, 1 - 0.008, 1e-9);
  const auto corner = pointTriangleImpact(over({-0.002, -0.006, 1}), over({-0.002, -0.006, 0}), s, 1e-12);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->time, 1 - std::sqrt(6e-5), 1e-9);
  EXPECT_FALSE(pointTriangleImpact(over({-0.008, -0.0061, 1}), over({-0.008, -0.0061, 0}), s, 1e-12));
  // Edges that cross at right angles, one falling.
  const FourPoints x0{Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0.3, -1, 1}, Vec3{0.3, 1, 1}};
  FourPoints x1 = x0;
  x1[2].z = x1[3].z = -1;
  const auto edges = edgeEdgeImpact(x0, x1, s, 1e-12);
  ASSERT_TRUE(edges);
  EXPECT_NEAR(edges->time, 0.5 * (1 - s), 1e-11);
  EXPECT_NEAR(edges->u, 0.65, 1e-12);
  EXPECT_NEAR(edges->v, 0.5, 1e-12);
}

TEST(CertifiedImpact, GapsAtRestAreLowerBounds) {
  EXPECT_NEAR(pointTriangleGap(over({0.2, 0.2, 1e-3})), 1e-3, 1e-14);
  EXPECT_LE(pointTriangleGap(over({0.2, 0.2, 1e-3})), 1e-3);
  EXPECT_EQ(pointTriangleGap(over({0.2, 0.2, 0})), 0);
  EXPECT_EQ(pointTriangleGap(over(kFlat[1])), 0) << "a corner of the triangle itself";
  const FourPoints e{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{4, 4, 0}, Vec3{5, 4, 0}};
  EXPECT_NEAR(edgeEdgeGap(e), 5, 1e-13);
  EXPECT_LE(edgeEdgeGap(e), 5);
}

TEST(CertifiedImpact, WhatIsNotFiniteIsAHitAtOnce) {
  FourPoints x0 = over({0.2, 0.2, 1}), x1 = x0;
  x1[0].y = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < 2; ++k) {
    const auto hit = k ? edgeEdgeImpact(x0, x1, 0) : pointTriangleImpact(x0, x1, 0);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->time, 0);
    EXPECT_TRUE(hit->capped);
    x1[0].y = INFINITY;
  }
  EXPECT_TRUE(pointTriangleImpact(over({0.2, 0.2, 1}), over({0.2, 0.2, 1}), NAN)) << "a separation that is no number";
}

TEST(CertifiedImpact, FlatTrianglesThatFoldOntoEachOther) {
  // Triangles abc and abd share ab; d turns about ab by a half turn, in 60 straight steps. The free vertex meets the
  // face, not the queries with a shared vertex.
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0.4, 1, 0};
  const auto at = [](int k) {
    const double angle = std::numbers::pi * (1 - k / 60.0);
    return Vec3{0.5, 0.6 * std::cos(angle), 0.6 * std::sin(angle)};
  };
  int first = 0;
  for (int k = 0; k < 61 && !first; ++k) {
    const Vec3 end = k == 60 ? Vec3{0.5, 0.6, -1e-3} : at(k + 1);
    if (pointTriangleImpact({at(k), a, b, c}, {end, a, b, c}, 0)) first = k + 1;
  }
  EXPECT_GE(first, 60);
  EXPECT_TRUE(pointTriangleImpact({at(59), a, b, c}, {Vec3{0.5, 0.6, -1e-3}, a, b, c}, 1e-6));
}

/// A hit in exact arithmetic is found, not late. A hit that is not there is a pass as close as the tolerance says.
void againstExact(bool edges, std::uint64_t seed) {
  QueryGenerator make(seed, edges);
  const int n = queryCount() / 2;
  struct Count {
    int queries = 0, hits = 0, extra = 0, wrong = 0;
  };
  std::array<Count, exact::kQueryKinds> counts;
  for (int i = 0; i < n; ++i) {
    const double tolerance_m = i / exact::kQueryKinds % 2 ? 0 : 1e-10;
    const auto kind = static_cast<QueryKind>(i % exact::kQueryKinds);
    const MovingPoints q = make(kind);
    const auto truth = edges ? exact::edgeEdge(q.x0, q.x1) : exact::pointTriangle(q.x0, q.x1);
    const auto hit = impact(q, edges, 0, tolerance_m);
    Count& c = counts[kind];
    ++c.queries, c.hits += truth.hit();
    if (truth.hit()) {
      ASSERT_TRUE(hit) << "missed, kind " << kind << ", query " << i << "\n" << print(q);
      ASSERT_FALSE(truth.before(hit->time)) << "late, kind " << kind << ", query " << i << ", time " << hit->time
                                            << ", first " << truth.firstAbout() << "\n"
                                            << print(q);
    } else if (hit) {
      ++c.extra;
      c.wrong += !within(q, edges, *hit, tolerance_m + 0x1p-45 * extent(q));
    }
    if (i % 4) continue;
    // With a separation the first time is earlier.
    const auto apart = impact(q, edges, 1e-3, tolerance_m);
    if (truth.hit()) {
      ASSERT_TRUE(apart) << "missed with a separation, kind " << kind << "\n" << print(q);
      ASSERT_FALSE(truth.before(apart->time)) << "late with a separation, kind " << kind << "\n" << print(q);
    } else if (hit && !hit->capped) {
      ASSERT_TRUE(apart) << print(q);
    }
  }
  int wrong = 0;
  for (int k = 0; k < exact::kQueryKinds; ++k) {
    const Count& c = counts[k];
    std::printf("kind %2d: %6d queries, %6d hits, %5d extra, of these %d further than the bound\n", k, c.queries,
                c.hits, c.extra, c.wrong);
    wrong += c.wrong;
    EXPECT_GT(c.hits, c.queries / 200) << "kind " << k << " hardly ever meets: it tests nothing";
  }
  EXPECT_EQ(wrong, 0);
}
TEST(CertifiedImpact, PointTriangleMissesNothingThatIsExact) { againstExact(false, 11); }
TEST(CertifiedImpact, EdgeEdgeMissesNothingThatIsExact) { againstExact(true, 12); }

/// With a separation: times at which the exact distance is within it, found by marching, are never before the answer.
void separationIsNeverLate(bool edges, std::uint64_t seed) {
  QueryGenerator make(seed, edges);
  int seen = 0;
  for (int i = 0; i < 4000; ++i) {
    const MovingPoints q = make(static_cast<QueryKind>(i % exact::kQueryKinds));
    const double s = std::pow(10.0, -1.0 - i % 7);
    const auto hit = impact(q, edges, s, 1e-12);
    // The nearest points at a time come from a query at rest there; the exact distance counts.
    const auto witness = [&](double t) {
      MovingPoints at;
      for (int k = 0; k < 4; ++k) at.x0[k] = at.x1[k] = (1 - t) * q.x0[k] + t * q.x1[k];
      auto near = impact(at, edges, 100, 1);
      near->time = t;
      return within(q, edges, *near, s);
    };
    double before = 0, first = 2;
    for (int k = 0; k <= 40 && first > 1; ++k) {
      const double t = k / 40.0;
      if (witness(t))
        first = t;
      else
        before = t;
    }
    if (first > 1) continue;
    ++seen;
    ASSERT_TRUE(hit) << print(q);
    for (int k = 0; k < 50 && first > 0; ++k) {
      const double m = 0.5 * (before + first);
      if (!(m > before && m < first)) break;
      (witness(m) ? first : before) = m;
    }
    ASSERT_LE(hit->time, first) << s << "\n" << print(q);
    if (!hit->capped) {
      ASSERT_TRUE(within(q, edges, *hit, s + 1e-12 + 0x1p-45 * extent(q))) << s << "\n" << print(q);
    }
  }
  EXPECT_GT(seen, 1000);
}
TEST(CertifiedImpact, PointTriangleSeparationIsNeverLate) { separationIsNeverLate(false, 21); }
TEST(CertifiedImpact, EdgeEdgeSeparationIsNeverLate) { separationIsNeverLate(true, 22); }

TEST(ExactImpact, AgreesWithClosedForms) {
  // Times 1/4 and, where three lattice motions make the cubic (4t - 1)(2t - 1)(4t - 3), the first of three.
  auto e = exact::pointTriangle(over({0.25, 0.5, 1}), over({0.25, 0.5, -3}));
  ASSERT_TRUE(e.hit());
  EXPECT_TRUE(e.before(std::nextafter(0.25, 1)));
  EXPECT_FALSE(e.before(0.25));
  e = exact::pointTriangle(over({0.25, 0.5, 1}), over({0.25, 0.5, -2}));  // 1/3 is no double
  ASSERT_TRUE(e.hit());
  const double third = 1.0 / 3;  // below 1/3
  EXPECT_FALSE(e.before(third));
  EXPECT_TRUE(e.before(std::nextafter(third, 1)));
  EXPECT_FALSE(exact::pointTriangle(over({0.5, 0.5, 1}), over({std::nextafter(0.5, 1), 0.5, -1})).hit())
      << "past the edge by half an ulp";
  EXPECT_TRUE(exact::pointTriangle(over({0.5, 0.5, 1}), over({0.5, 0.5, -1})).hit());
  using exact::Poly;
  auto roots = exact::rootsInUnit(Poly{-3, 22, -48, 32});
  ASSERT_EQ(roots.size(), 3u);
  EXPECT_EQ(exact::signAt(Poly{-1, 4}, roots[0]), 0);
  EXPECT_EQ(exact::signAt(Poly{-1, 2}, roots[1]), 0);
  EXPECT_EQ(exact::signAt(Poly{-3, 4}, roots[2]), 0);
  EXPECT_EQ(exact::signAt(Poly{-3, 4}, roots[1]), -1);
  roots = exact::rootsInUnit(Poly{1, -4, 4});  // double root 1/2
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_EQ(exact::signAt(Poly{1, -2}, roots[0]), 0);
  roots = exact::rootsInUnit(Poly{-1, 0, 2});  // sqrt(1/2): sign of 4 t^4 - 1 and of 7 t - 5 (t > 5/7 = 0.714? no)
  ASSERT_EQ(roots.size(), 1u);
  EXPECT_EQ(exact::signAt(Poly{-1, 0, 0, 0, 4}, roots[0]), 0);
  EXPECT_EQ(exact::signAt(Poly{-5, 7}, roots[0]), -1);
}

}  // namespace
}  // namespace gambeson
