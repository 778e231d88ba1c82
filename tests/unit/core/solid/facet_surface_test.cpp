/// Where a point meets a surface of facets: always the nearest feature, and all facets of a groove at once.

#include "core/solid/facet_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <string>

#include "core/contact/triangle.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

double uniform(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A feature by its nodes: one of a corner, two of an edge, three or more of a face.
using Feature = std::set<int>;

Feature featureOf(const Facet& f, int feature) {
  if (feature < kFacetEdge) return {f[feature]};
  if (feature < kFacetFace) return {f[feature - kFacetEdge], f[(feature - kFacetEdge + 1) % 4]};
  return {f.begin(), f.end()};
}

/// Four plane facets around node 0, whose edges to nodes 1 to 4 are up to `off` degrees off a cross and rise by the
/// given slopes; nodes 5 to 8 complete parallelograms.
struct Fan {
  std::vector<Vec3> x{{0, 0, 0}};
  std::vector<Facet> facets;
  double least = 1e9;  ///< height of a facet over its outer edges
  Fan(std::mt19937& random, double off_deg, const std::array<double, 4>& slope) {
    for (int k = 0; k < 4; ++k) {
      const double a = (90.0 * k + uniform(random, -off_deg, off_deg)) * std::numbers::pi / 180;
      const double length = uniform(random, 0.5, 1.5);
      x.push_back({length * std::cos(a), length * std::sin(a), length * slope[k]});
    }
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      const Vec3 a = x[1 + k], b = x[1 + next];
      x.push_back(a + b);
      facets.push_back({0, 1 + k, 5 + k, 1 + next});
      const double area = norm(cross(a, b));
      least = std::min({least, area / norm(a), area / norm(b)});
    }
  }
};

/// By the triangles of the parallelograms, each alone.
struct Reference {
  double dist2 = 1e300;
  Vec3 position;
  Feature feature;
  Reference(const Fan& fan, const Vec3& p) {
    for (const Facet& f : fan.facets)
      for (const auto& t : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        const TrianglePoint c = closestOnTriangle({fan.x[f[t[0]]], fan.x[f[t[1]]], fan.x[f[t[2]]]}, p);
        if (!(c.dist2_m2 < dist2)) continue;
        dist2 = c.dist2_m2;
        position = c.position;
        if (c.feature < kEdge0) {
          feature = {f[t[c.feature]]};
        } else {
          const int k = c.feature - kEdge0;
          feature = {f[t[k % 3]], f[t[(k + 1) % 3]]};
          if (c.feature == kFace || feature == Feature{f[0], f[2]}) feature = {f.begin(), f.end()};
        }
      }
  }
};

TEST(FacetSurface, TheNearestFeatureIsFoundOnAnyFan) {
  std::mt19937 random(1);
  std::set<int> cases;         // signs of p . c_i
  std::array<int, 5> found{};  // by the size of the feature
  int queries = 0, wrong = 0;
  const double steep[2] = {0.1, 1.5};
  for (int trial = 0; trial < 10000; ++trial) {
    const double off = uniform(random, 0, 30);
    std::array<double, 4> slope{};
    for (int k = 0; k < 4; ++k) {
      const double s = uniform(random, steep[0], steep[1]);
      slope[k] = trial % 3 == 0 ? -s : trial % 3 == 1 ? s : k % 2 == 0 ? s : -s;  // convex, concave, saddle
    }
    const Fan fan(random, off, slope);
    const FacetSurface surface(fan.facets, 9);
    const FacetSurface::Spheres spheres = surface.spheres(fan.x);
    for (int q = 0; q < 10; ++q, ++queries) {
      Vec3 p{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
      p *= fan.least;
      int signs = 0;
      for (int k = 0; k < 4; ++k) signs |= (dot(p, fan.x[1 + k]) > 0) << k;
      cases.insert(signs);
      const Reference expected(fan, p);
      const NearestFacet near = surface.nearest(fan.x, spheres, p, 10);
      ASSERT_GE(near.facet, 0);
      const Feature feature = featureOf(fan.facets[near.facet], near.at.feature);
      ++found[feature.size()];
      if (feature != expected.feature || norm(near.at.position - expected.position) > 1e-12) ++wrong;
    }
  }
  EXPECT_EQ(queries, 100000);
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(cases.size(), 16u);
  for (const int k : {1, 2, 4}) EXPECT_GT(found[k], 1000);
}

/// A sheet of n by n twisted facets.
struct Waves {
  std::vector<Vec3> x;
  std::vector<Facet> facets;
  Waves(int n, std::mt19937& random) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        x.push_back({i + uniform(random, -0.25, 0.25), j + uniform(random, -0.25, 0.25),
                     0.8 * std::sin(0.9 * i) * std::cos(0.7 * j) + uniform(random, -0.15, 0.15)});
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = i + (n + 1) * j;
        facets.push_back({a, a + 1, a + n + 2, a + n + 1});
      }
  }
};

TEST(FacetSurface, NoPointOfTwistedFacetsIsNearer) {
  std::mt19937 random(2);
  const Waves waves(6, random);
  const FacetSurface surface(waves.facets, static_cast<int>(waves.x.size()));
  const FacetSurface::Spheres spheres = surface.spheres(waves.x);
  for (int q = 0; q < 300; ++q) {
    const Vec3 p{uniform(random, -1, 7), uniform(random, -1, 7), uniform(random, -1.5, 1.5)};
    double sampled = 1e9;
    constexpr int n = 24;
    for (int f = 0; f < static_cast<int>(waves.facets.size()); ++f)
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
          sampled = std::min(sampled,
                             norm(p - facetPosition(surface.corners(f, waves.x), {2.0 * i / n - 1, 2.0 * j / n - 1})));
    const NearestFacet near = surface.nearest(waves.x, spheres, p, 10);
    const double distance = std::sqrt(near.at.dist2_m2);
    EXPECT_LE(distance, sampled + 1e-12);
    EXPECT_GE(distance, sampled - 0.1);
    EXPECT_NEAR(norm(p - facetPosition(surface.corners(near.facet, waves.x), near.at.local)), distance, 1e-12);
    EXPECT_LT(surface.nearest(waves.x, spheres, p, 0.99 * distance).facet, 0);
    EXPECT_EQ(surface.nearest(waves.x, spheres, p, 1.01 * distance + 1e-9).facet, near.facet);
  }
}

TEST(FacetSurface, AProjectionStandsUprightOnTheFacetContinued) {
  const FacetCorners c{{{0, 0, 0}, {1, 0.1, 0.1}, {1.2, 1, -0.1}, {-0.1, 0.9, 0.2}}};
  std::mt19937 random(3);
  for (int q = 0; q < 100; ++q) {
    const Vec2 at{uniform(random, -1.5, 1.5), uniform(random, -1.5, 1.5)};
    const Vec3 p = facetPosition(c, at) + uniform(random, -0.2, 0.2) * facetNormal(c, at);
    const std::optional<Vec2> found = projectOnFacet(c, p, 2);
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->x, at.x, 1e-10);
    EXPECT_NEAR(found->y, at.y, 1e-10);
  }
  EXPECT_FALSE(projectOnFacet(c, {9, 0, 0}, 2));
}

/// Two facets that meet along y at the angle, each sloping by `slope` away from it.
FacetSurface valley(std::vector<Vec3>& x, double slope) {
  x = {{-1, -1, slope}, {0, -1, 0}, {1, -1, slope}, {-1, 1, slope}, {0, 1, 0}, {1, 1, slope}};
  return FacetSurface({{0, 1, 4, 3}, {1, 2, 5, 4}}, 6);
}

std::vector<FacetTouch> touches(const FacetSurface& s, const std::vector<Vec3>& x, const Vec3& p,
                                bool simultaneous = true) {
  TouchOptions options;
  options.reach_m = 0.5;
  options.simultaneous = simultaneous;
  return s.touching(x, s.spheres(x), p, options);
}

TEST(FacetSurface, AGrooveHoldsAPointByBothSides) {
  std::vector<Vec3> x;
  const FacetSurface s = valley(x, 1);
  const double r = std::sqrt(0.5);
  for (const Vec3& p : {Vec3{0, 0, -0.1}, Vec3{0.05, 0.3, -0.1}, Vec3{-0.1, 0, 0.05}, Vec3{0.1, 0, 0.2}}) {
    std::vector<FacetTouch> t = touches(s, x, p);
    ASSERT_EQ(t.size(), 2u);
    for (const FacetTouch& touch : t)
      EXPECT_NEAR(touch.gap_m, touch.facet == 0 ? -r * (p.x + p.z) : -r * (p.z - p.x), 1e-12);
    EXPECT_EQ(touches(s, x, p, false).size(), 1u);
  }
  // Far up one side, the other is no neighbour any more.
  EXPECT_EQ(touches(s, x, {0.95, 0, 0.94}).size(), 1u);
}

TEST(FacetSurface, ARidgeHoldsAPointByTheSideThatItPassedLeast) {
  std::vector<Vec3> x;
  const FacetSurface s = valley(x, -1);
  const auto only = [&](const Vec3& p) {
    const std::vector<FacetTouch> t = touches(s, x, p);
    EXPECT_EQ(t.size(), 1u);
    return t.front();
  };
  EXPECT_EQ(only({0.05, 0, -0.2}).facet, 1);
  EXPECT_NEAR(only({0.05, 0, -0.2}).gap_m, std::sqrt(0.5) * 0.15, 1e-12);
  EXPECT_EQ(only({-0.05, 0, -0.2}).facet, 0);
  EXPECT_LT(only({0.02, 0, 0.1}).gap_m, 0);  // above it
  EXPECT_EQ(only({0.02, 0, 0.1}).facet, 1);
}

TEST(FacetSurface, ASharpRidgeDoesNotHoldAPointBesideIt) {
  std::vector<Vec3> x;
  const FacetSurface s = valley(x, -3);
  const std::vector<FacetTouch> t = touches(s, x, {0.2, 0, 0.1});  // behind the plane of facet 0
  ASSERT_EQ(t.size(), 1u);
  EXPECT_LT(t[0].gap_m, 0);
}

TEST(FacetSurface, AFacetThatLooksAwayHoldsNothing) {
  // A floor, and a facet that touches it in a corner: it rises over the floor, which lies behind it.
  const Vec3 u = normalized(Vec3{-1, -1, 1}), v = normalized(Vec3{1, -1, 0});
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, 0.5 * (u - v), u, 0.5 * (u + v)};
  const FacetSurface s({{0, 1, 2, 3}, {0, 6, 5, 4}}, 7);
  ASSERT_LT(dot(facetNormal(s.corners(1, x), {}), Vec3{1, 1, 0}), 0);
  const std::vector<FacetTouch> t = touches(s, x, {0.1, 0.1, -0.02});
  ASSERT_EQ(t.size(), 1u);
  EXPECT_EQ(t[0].facet, 0);
}

TEST(FacetSurface, OneSurfaceHoldsAPointOnce) {
  std::vector<Vec3> x;
  const FacetSurface flat = valley(x, 0);
  EXPECT_EQ(touches(flat, x, {0, 0.2, -0.1}).size(), 1u);
  EXPECT_EQ(touches(flat, x, {0.1, 0.2, 0.1}).size(), 1u);
  // How shallow a groove counts as none is the caller's to say; by itself hardly any.
  const FacetSurface shallow = valley(x, 1e-4);
  const Vec3 p{0, 0.2, -0.01};
  EXPECT_EQ(touches(shallow, x, p).size(), 2u);
  TouchOptions options;
  options.reach_m = 0.5;
  for (const double groove_rad : {1.9e-4, 2.1e-4}) {
    options.groove_rad = groove_rad;
    EXPECT_EQ(shallow.touching(x, shallow.spheres(x), p, options).size(), groove_rad < 2e-4 ? 2u : 1u);
  }
}

TEST(FacetSurface, APocketHoldsAPointByThreeSides) {
  const std::vector<Vec3> x{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 1}};
  const FacetSurface s({{0, 1, 2, 3}, {0, 5, 4, 1}, {0, 3, 6, 5}}, 7);  // normals along z, y and x
  for (const Vec3& p : {Vec3{-0.1, -0.2, -0.05}, Vec3{0.1, 0.2, -0.05}, Vec3{0.3, -0.2, 0.3}}) {
    const std::vector<FacetTouch> t = touches(s, x, p);
    ASSERT_EQ(t.size(), 3u);
    for (const FacetTouch& touch : t) EXPECT_NEAR(touch.gap_m, -p[2 - touch.facet], 1e-12);
  }
}

TEST(FacetSurface, WhatIsOutOfReachIsNotTouched) {
  std::vector<Vec3> x;
  const FacetSurface s = valley(x, 0);
  EXPECT_TRUE(touches(s, x, {0.2, 0, 0.51}).empty());
  EXPECT_TRUE(touches(s, x, {0.2, 0, -0.51}).empty());
  EXPECT_EQ(touches(s, x, {0.2, 0, -0.49}).size(), 1u);
}

/// A bumpy cushion of n by n facets, four times as long as wide.
FacetSurface cushion(std::vector<Vec3>& x, int n) {
  std::vector<Facet> facets;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) x.push_back({4.0 * i / n, double(j) / n, 0.02 * std::sin(7.0 * i + 3.0 * j)});
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j;
      facets.push_back({a, a + 1, a + n + 2, a + n + 1});
    }
  return {facets, (n + 1) * (n + 1)};
}

TEST(FacetSurface, TheGridOfBoxesLeavesOutNothing) {
  std::vector<Vec3> x;
  const FacetSurface s = cushion(x, 12);
  const FacetSurface::Spheres spheres = s.spheres(x);
  EXPECT_GT(spheres.boxes[0] * spheres.boxes[1] * spheres.boxes[2], 8);
  std::mt19937 random(7);
  int found = 0;
  for (int q = 0; q < 3000; ++q) {
    Vec3 p{uniform(random, -0.1, 4.1), uniform(random, -0.1, 1.1), uniform(random, -0.1, 0.1)};
    if (q % 5 == 0) p = x[q % x.size()];  // at a node several facets are equally near: the first
    const double reach = uniform(random, 0.01, 0.2);
    NearestFacet all;
    for (int f = 0; f < 144; ++f) {
      const FacetPoint at = closestOnFacet(s.corners(f, x), p);
      if (std::sqrt(at.dist2_m2) <= reach && (all.facet < 0 || at.dist2_m2 < all.at.dist2_m2)) all = {f, at};
    }
    const NearestFacet near = s.nearest(x, spheres, p, reach);
    ASSERT_EQ(near.facet, all.facet) << q;
    found += near.facet >= 0;
    if (near.facet >= 0) {
      EXPECT_EQ(near.at.dist2_m2, all.at.dist2_m2);
    }
  }
  EXPECT_GT(found, 1000);
}

TEST(FacetSurface, AFacetKeepsAPointAndSharesItInAGroove) {
  TouchOptions options;
  options.reach_m = 0.5;
  options.groove_rad = 0.5;
  options.keep = 0.3;
  const int first = 0;
  using Held = std::vector<int>;
  const auto heldBy = [&](const FacetSurface& s, const std::vector<Vec3>& x, double along, HeldFacet after) {
    Held facets;
    for (const FacetTouch& t :
         s.touching(x, s.spheres(x), {along, 0.2, 0.1 * std::abs(along)}, options, {&first, 1}, after))
      facets.push_back(t.facet);
    return facets;
  };
  std::vector<Vec3> x;
  for (const double slope : {0.1, -0.1}) {  // facets are 1 wide: 0.1 is 0.2 half widths beyond their edge at 0
    const FacetSurface s = valley(x, slope);
    EXPECT_EQ(heldBy(s, x, -0.1, HeldFacet::goes_on), Held{0});
    EXPECT_EQ(heldBy(s, x, 0.1, HeldFacet::goes_on), (slope > 0 ? Held{0, 1} : Held{1}));
    EXPECT_EQ(heldBy(s, x, 0.2, HeldFacet::goes_on), Held{1});
    EXPECT_EQ(heldBy(s, x, 0.2, HeldFacet::keeps), Held{0});
  }
  options.keep = 0;
  const FacetSurface s = valley(x, 0.1);
  EXPECT_EQ(heldBy(s, x, 0.1, HeldFacet::goes_on), Held{1});
  EXPECT_EQ(heldBy(s, x, 0.1, HeldFacet::keeps), Held{1});
}

TEST(FacetSurface, BadFacetsAreRefused) {
  EXPECT_THROW(FacetSurface({{0, 1, 2, 4}}, 4), InputError);
  EXPECT_THROW(FacetSurface({{0, 1, 2, 0}}, 4), InputError);
}

}  // namespace
}  // namespace gambeson
