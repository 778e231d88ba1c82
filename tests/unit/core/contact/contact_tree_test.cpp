#include "core/contact/contact_tree.hpp"
#include "core/contact/candidate_list.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <bit>
#include <random>

#include "core/cloth/constraint.hpp"
#include "core/cloth/surface_charts.hpp"
#include "core/contact/certified_impact.hpp"
#include "core/contact/pairs.hpp"
#include "core/contact/segment_pair.hpp"
#include "core/contact/triangle.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

/// A sheet of 0.4 m x 0.3 m, 20 x 16 samples' cells, and a body of four triangles.
class TreeTest : public testing::Test {
 protected:
  void SetUp() override {
    Garment g;
    std::vector<double> u, v;
    for (int i = 0; i <= 10; ++i) u.push_back(0.1 * i);
    for (int i = 0; i <= 8; ++i) v.push_back(0.125 * i);
    g.patches = {shapes::flatPatch(shapes::knotsAt(2, u), shapes::knotsAt(2, v), 0.4, 0.3)};
    g.weft = {{1, 0, 0}};
    const FreeMap map = buildFreeMap(g);
    surface = buildSurface(g, map, 2);
    rest.resize(surface.size());
    surface.W.multiply<Vec3>(g.patches[0].points, rest);
    cloth = surface.size();
    std::vector<std::array<int, 3>> triangles = surface.triangles;
    cloth_triangles = static_cast<int>(triangles.size());
    for (const Vec3& p : {Vec3{0.1, 0.1, -0.05}, Vec3{0.3, 0.1, -0.05}, Vec3{0.2, 0.25, -0.05}, Vec3{0.2, 0.15, 0.02}})
      rest.push_back(p);
    for (const std::array<int, 3>& t :
         {std::array{0, 1, 2}, std::array{0, 1, 3}, std::array{1, 2, 3}, std::array{2, 0, 3}})
      triangles.push_back({cloth + t[0], cloth + t[1], cloth + t[2]});
    mesh = contactMesh(static_cast<int>(rest.size()), triangles);
    const SurfaceCharts charts = surfaceCharts(surface, rest);
    const TriangleRange body{cloth_triangles, static_cast<int>(triangles.size())};
    tree = ContactTree(mesh, charts.charts, charts.corners, {&body, 1}, rest);
    collector = PairCollector(mesh);
  }

  CandidatePairs pairs(std::span<const Vec3> x, double margin, double least, std::span<const double> slack = {}) {
    CandidatePairs out;
    const ListedMotion motion{x, {}, slack, 0};
    tree.refit(mesh, motion);
    collector.collect(mesh, tree, motion, {margin, least}, out);
    std::ranges::sort(out.points);
    std::ranges::sort(out.edges);
    return out;
  }
  void serveManySteps(CandidateList& list, int kicked);
  /// Edges of the cloth far from each other along it that come within the margin at one of the ends.
  std::vector<std::array<int, 2>> nearEdges(std::span<const Vec3> x0, std::span<const Vec3> x1, double margin) const {
    std::vector<std::array<int, 2>> out;
    for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
      for (int f = e + 1; f < static_cast<int>(mesh.edges.size()); ++f) {
        const auto [a, b] = mesh.edges[e];
        const auto [c, d] = mesh.edges[f];
        if (a >= cloth || c >= cloth || norm(x0[a] - x0[c]) > 0.05) continue;
        const auto far = [&](std::span<const Vec3> x, double m) {
          return nearestOnSegments(x[a], x[b], x[c], x[d]).dist2_m2 > m * m;
        };
        if (far(rest, 0.03) && !(far(x0, margin) && far(x1, margin))) out.push_back({e, f});
      }
    return out;
  }
  bool isCloth(const PointTriangle& p) const { return p.vertex < cloth && p.triangle < cloth_triangles; }

  Surface surface;
  ContactMesh mesh;
  ContactTree tree;
  PairCollector collector;
  std::vector<Vec3> rest;
  int cloth = 0, cloth_triangles = 0;
};

/// The cloth rolled about the y axis with `turns` turns, radius growing, so that turns lie `gap` apart.
Vec3 rolled(const Vec3& X, double radius, double gap) {
  const double angle = X.x / radius;
  const double r = radius + gap * angle / (2 * M_PI);
  return {r * std::sin(angle), X.y, r * (1 - std::cos(angle))};
}

TEST_F(TreeTest, FlatAndGentlyBentClothIsCertifiedWithoutAPair) {
  std::vector<Vec3> x = rest;
  EXPECT_TRUE(std::ranges::none_of(pairs(x, 1e-3, 0.5).points, [&](auto& p) { return isCloth(p); }));
  for (int i = 0; i < cloth; ++i) x[i] = rolled(rest[i], 0.5, 0);  // 46 degrees in all
  const CandidatePairs bent = pairs(x, 1e-3, 0.5);
  EXPECT_TRUE(std::ranges::none_of(bent.points, [&](auto& p) { return isCloth(p); }));
  // The body comes near the sheet: those pairs are there.
  const CandidatePairs with_body = pairs(x, 0.025, 0.5);
  EXPECT_FALSE(with_body.points.empty());
  EXPECT_FALSE(with_body.edges.empty());
}

/// Boxes side by side are told as one by one, wherever a run of them starts.
TEST(BoxLanes, MeetAsOneBoxAfterTheOther) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<MovingBox> boxes;
  BoxLanes lanes;
  lanes.resize(40);
  for (int i = 0; i < 40; ++i) {
    std::vector<Vec3> x, v;
    for (int k = 0; k < 3; ++k) {
      x.push_back({unit(random), unit(random), unit(random)});
      v.push_back({unit(random) - 0.5, unit(random) - 0.5, unit(random) - 0.5});
    }
    const ListedMotion motion{x, v, {}, 0.4};
    boxes.emplace_back(motion, 0);
    for (int k = 1; k < 3; ++k) boxes.back().add(MovingBox(motion, k));
    lanes.set(i, boxes.back());
  }
  int met = 0;
  for (const MovingBox& one : boxes)
    for (int first = 0; first < 40; ++first)
      for (int count = 1; count <= std::min(BoxLanes::kMost, 40 - first); ++count) {
        int bits = 0;
        for (int k = 0; k < count; ++k) bits |= mayMeet(one, boxes[first + k], 0.01f) << k;
        ASSERT_EQ(lanes.meeting(one, first, count, 0.01f), bits) << first << " " << count;
        met += std::popcount(static_cast<unsigned>(bits));
      }
  EXPECT_GT(met, 1000);
}

TEST_F(TreeTest, PairsOfCoilsAreFoundAndOnlyThose) {
  std::vector<Vec3> x = rest;
  const double radius = 0.03, gap = 0.002, reach = 0.003;
  for (int i = 0; i < cloth; ++i) x[i] = rolled(rest[i], radius, gap);
  const CandidatePairs found = pairs(x, reach, 0.3);
  int near = 0;
  for (int v = 0; v < cloth; ++v)
    for (int t = 0; t < cloth_triangles; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      if (v == a || v == b || v == c) continue;
      const TrianglePoint foot = closestOnTriangle({x[a], x[b], x[c]}, x[v]);
      if (foot.dist2_m2 > reach * reach) continue;
      // Neighbours along the cloth are left out where the certificate says so.
      if (closestOnTriangle({rest[a], rest[b], rest[c]}, rest[v]).dist2_m2 < 0.03 * 0.03) continue;
      ++near;
      EXPECT_TRUE(std::ranges::binary_search(found.points, PointTriangle{v, t})) << v << " " << t;
    }
  EXPECT_GT(near, 400);
  EXPECT_LT(found.points.size(), 20u * near);
}

/// Whatever the cloth does, no passage of a point through a triangle is left out.
TEST_F(TreeTest, NoPassageIsLostInCrumplingCloth) {
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  int hits = 0, listed = 0;
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Vec3> x0 = rest, x1 = rest;
    const double size = 0.002 * (1 + trial % 4), jump = 0.004 * (1 + trial / 4);
    for (int i = 0; i < cloth; ++i) {
      x0[i] = rolled(rest[i], 0.04, 0.004) + size * Vec3{noise(random), noise(random), noise(random)};
      x1[i] = x0[i] + jump * Vec3{noise(random), noise(random), noise(random)};
    }
    std::vector<double> slack(rest.size(), 0);
    for (int i = 0; i < cloth; ++i) slack[i] = norm(x1[i] - x0[i]);
    const CandidatePairs found = pairs(x0, 0, 0, slack);
    std::vector<Vec3> way(rest.size());
    for (int i = 0; i < cloth; ++i) way[i] = x1[i] - x0[i];
    const ListedMotion along{x0, way, {}, 1};  // the same way, and no other
    tree.refit(mesh, along);
    CandidatePairs on_paths;
    collector.collect(mesh, tree, along, {0, 0}, on_paths);
    listed += static_cast<int>(found.points.size());
    for (int v = 0; v < cloth; ++v)
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (v == a || v == b || v == c) continue;
        Box path, swept;
        path.add(x0[v]), path.add(x1[v]);
        for (int k : {a, b, c}) swept.add(x0[k]), swept.add(x1[k]);
        if (!overlap(path, swept)) continue;
        if (!pointTriangleImpact({x0[v], x0[a], x0[b], x0[c]}, {x1[v], x1[a], x1[b], x1[c]}, 0)) continue;
        ++hits;
        EXPECT_TRUE(std::ranges::binary_search(found.points, PointTriangle{v, static_cast<int>(t)})) << v << " " << t;
        EXPECT_TRUE(std::ranges::binary_search(on_paths.points, PointTriangle{v, static_cast<int>(t)}))
            << v << " " << t;
      }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(listed, hits);
}

/// Of cloth that is certified as a whole, a few vertices leave their paths and fold over the cells beside them.
TEST_F(TreeTest, WhereAVertexStraysItsCellsMeetTheirNeighbours) {
  std::mt19937 random(13);
  std::normal_distribution<double> noise;
  const PairRules rules{0.004, 0.3};
  int asked = 0, listed = 0;
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<Vec3> x = rest;
    std::vector<double> slack(rest.size(), 1e-4);
    for (std::size_t i = cloth; i < x.size(); ++i) x[i] += Vec3{0, 0, 1};
    const ListedMotion motion{x, {}, slack, 0};
    tree.refit(mesh, motion);
    CandidatePairs found;
    collector.collect(mesh, tree, motion, rules, found);
    EXPECT_TRUE(found.points.empty());
    for (int round = 0; round < 2; ++round) {  // the second goes on from the paths of the first
      std::vector<int> strays;
      for (int k = 0; k < 3; ++k) strays.push_back(static_cast<int>(random() % cloth));
      for (int v : strays) x[v] += Vec3{0.02 * noise(random), 0.02 * noise(random), 0.002 * noise(random)};
      tree.refitSome(mesh, motion, strays);
      collector.mend(mesh, tree, motion, rules, found);
    }
    EXPECT_TRUE(std::ranges::is_sorted(found.points));
    listed += static_cast<int>(found.points.size());
    for (int v = 0; v < cloth; ++v)
      for (int t = 0; t < cloth_triangles; ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (v == a || v == b || v == c) continue;
        const double at_rest = std::sqrt(closestOnTriangle({rest[a], rest[b], rest[c]}, rest[v]).dist2_m2);
        const double reach = std::min(rules.margin_m, rules.least * at_rest);
        if (closestOnTriangle({x[a], x[b], x[c]}, x[v]).dist2_m2 >= reach * reach) continue;
        ++asked;
        EXPECT_TRUE(std::ranges::binary_search(found.points, PointTriangle{v, t})) << trial << " " << v << " " << t;
      }
  }
  EXPECT_GT(asked, 100);
  EXPECT_LT(listed, 20 * asked);
}

TEST_F(TreeTest, EveryPairComesOnceAndSharesNoVertex) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  std::vector<Vec3> x = rest;
  for (Vec3& p : x) p += 0.03 * Vec3{noise(random), noise(random), noise(random)};
  const double reach = 0.004;
  CandidatePairs found = pairs(x, reach, 0);
  std::ranges::sort(found.edges);
  EXPECT_EQ(std::ranges::adjacent_find(found.points), found.points.end());
  EXPECT_EQ(std::ranges::adjacent_find(found.edges), found.edges.end());
  // All edges in reach, by brute force: nothing is certified in such a heap.
  std::size_t edges = 0;
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    for (std::size_t f = e + 1; f < mesh.edges.size(); ++f) {
      const auto [v, w] = mesh.edges[e];
      const auto [y, z] = mesh.edges[f];
      if (v == y || v == z || w == y || w == z || v >= cloth) continue;
      if (nearestOnSegments(x[v], x[w], x[y], x[z]).dist2_m2 > reach * reach) continue;
      ++edges;
      EXPECT_TRUE(std::ranges::binary_search(found.edges, EdgeEdge{static_cast<int>(e), static_cast<int>(f)}));
    }
  EXPECT_GT(edges, 1000u);
  EXPECT_GE(found.edges.size(), edges);
  EXPECT_LE(found.edges.size(), edges + edges / 100 + 8);
}

/// The same pairs in the same order, whichever threads found them.
TEST_F(TreeTest, AnyNumberOfThreadsMakesTheSameList) {
  std::mt19937 random(17);
  std::normal_distribution<double> noise;
  std::vector<Vec3> x = rest;
  for (int i = 0; i < cloth; ++i)
    x[i] = rolled(rest[i], 0.03, 0.002) + 2e-4 * Vec3{noise(random), noise(random), noise(random)};
  const ListedMotion motion{x, {}, {}, 0};
  tree.refit(mesh, motion);
  const int before = omp_get_max_threads();
  std::vector<CandidatePairs> found;
  for (int threads : {1, 2, 3, 8}) {
    omp_set_num_threads(threads);
    found.emplace_back();
    collector.collect(mesh, tree, motion, {0.004, 0.3, true}, found.back());
  }
  omp_set_num_threads(before);
  EXPECT_GT(found[0].points.size(), 500u);
  EXPECT_TRUE(std::ranges::is_sorted(found[0].points));
  for (const CandidatePairs& f : found) {
    EXPECT_EQ(f.points, found[0].points);
    EXPECT_EQ(f.edges, found[0].edges);
    for (std::size_t k = 0; k < f.points.size(); ++k)
      ASSERT_EQ(f.points[k].apart.gap_m, found[0].points[k].apart.gap_m);
  }
}

/// Thick cloth over thin cloth and a body: what comes within the margin of its own is on the list, thin cloth lists
/// less.
TEST_F(TreeTest, ThinClothHasAMarginOfItsOwn) {
  std::mt19937 random(19);
  std::normal_distribution<double> noise;
  std::vector<float> half_reach_m(rest.size(), 0);
  for (int v = 0; v < cloth; ++v) half_reach_m[v] = rest[v].y < 0.15 ? 0.001f : 0.004f;
  ContactTree thin = tree;
  thin.setHalfReaches(half_reach_m);
  const PairRules rules{0.008, 0, true, 1e-4, 0.005};
  std::size_t listed = 0, listed_without = 0;
  int asked_cloth = 0, asked_body = 0;
  for (int trial = 0; trial < 10; ++trial) {
    std::vector<Vec3> x = rest;
    for (int i = 0; i < cloth; ++i)
      x[i] = rolled(rest[i], 0.03, 0.006) + 5e-4 * Vec3{noise(random), noise(random), noise(random)};
    for (std::size_t i = cloth; i < x.size(); ++i) x[i] += Vec3{-0.2, 0.01 * trial, 0.005 * trial};
    const ListedMotion motion{x, {}, {}, 0};
    tree.refit(mesh, motion);
    thin.refit(mesh, motion);
    CandidatePairs found;
    collector.collect(mesh, tree, motion, rules, found);
    listed_without += found.points.size() + found.edges.size();
    collector.collect(mesh, thin, motion, rules, found);
    listed += found.points.size() + found.edges.size();
    std::ranges::sort(found.edges);
    const auto marginOf = [&](std::initializer_list<int> a, std::initializer_list<int> b) {
      const auto most = [&](std::initializer_list<int> vertices) {
        double s = -1;
        for (int v : vertices) s = std::max(s, v < cloth ? static_cast<double>(half_reach_m[v]) : -1);
        return s;
      };
      const double of_a = most(a), of_b = most(b);
      return of_a < 0 || of_b < 0 ? std::max(2 * std::max(of_a, of_b), rules.obstacle_margin_m) : of_a + of_b;
    };
    for (int v = 0; v < mesh.vertex_count; ++v)
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const bool body = v >= cloth || t >= cloth_triangles;
        if (v == a || v == b || v == c || (v >= cloth && t >= cloth_triangles)) continue;
        const double margin = marginOf({v}, {a, b, c});
        if (closestOnTriangle({x[a], x[b], x[c]}, x[v]).dist2_m2 > margin * margin) continue;
        // With `least` 0 the certificate leaves out nothing but parts that are certainly apart by the margin.
        if (!body && norm(rest[v] - rest[a]) < 0.06) continue;
        ++(body ? asked_body : asked_cloth);
        ASSERT_TRUE(std::ranges::binary_search(found.points, PointTriangle{v, t, {}})) << trial << " " << v << " " << t;
      }
    for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
      for (int f = e + 1; f < static_cast<int>(mesh.edges.size()); ++f) {
        const auto [a, b] = mesh.edges[e];
        const auto [c, d] = mesh.edges[f];
        if (a >= cloth || a == c || a == d || b == c || b == d) continue;
        if (c < cloth && norm(rest[a] - rest[c]) < 0.06) continue;
        if (norm(x[a] - x[c]) > 0.06 && c < cloth) continue;
        const double margin = marginOf({a, b}, {c, d});
        if (nearestOnSegments(x[a], x[b], x[c], x[d]).dist2_m2 > margin * margin) continue;
        ASSERT_TRUE(std::ranges::binary_search(found.edges, EdgeEdge{e, f})) << trial << " " << e << " " << f;
      }
  }
  EXPECT_GT(asked_cloth, 100);
  EXPECT_GT(asked_body, 20);
  EXPECT_LT(listed, 0.8 * listed_without);
}

/// Of a blunt body's vertices and edges what comes within their own, smaller margin is on the list; all else within the
/// wide one: cloth vertices against the body's faces, sharp edges and corners of the body against cloth.
TEST_F(TreeTest, BluntFeaturesAreListedWithinTheirOwnMargin) {
  std::mt19937 random(13);
  std::normal_distribution<double> noise;
  BluntFeatures blunt{std::vector<char>(mesh.vertex_count, 0), std::vector<char>(mesh.edges.size(), 0)};
  for (int v = cloth; v < mesh.vertex_count - 1; ++v) blunt.vertex[v] = 1;  // the last corner is sharp
  for (std::size_t e = 0; e < mesh.edges.size(); ++e)
    blunt.edge[e] = mesh.edges[e][0] >= cloth && mesh.edges[e][1] < mesh.vertex_count - 1;
  const PairCollector with_blunt(mesh, blunt);
  const PairRules rules{0.012, 0, true, 0.003};
  const double horizon = 0.01;
  std::array<int, 2> asked_points{}, asked_edges{};
  std::size_t listed = 0, listed_without = 0;
  for (int trial = 0; trial < 30; ++trial) {
    std::vector<Vec3> x = rest, velocity(rest.size()), end;
    for (int i = 0; i < mesh.vertex_count; ++i) {
      if (i >= cloth) x[i].z += 0.003 * trial - 0.02;
      x[i] += 0.002 * Vec3{noise(random), noise(random), noise(random)};
      velocity[i] = 0.3 * Vec3{noise(random), noise(random), noise(random)};
    }
    for (int i = 0; i < mesh.vertex_count; ++i) end.push_back(x[i] + horizon * velocity[i]);
    const ListedMotion motion{x, velocity, {}, horizon};
    tree.refit(mesh, motion);
    CandidatePairs found;
    collector.collect(mesh, tree, motion, rules, found);
    listed_without += found.points.size() + found.edges.size();
    // Blunt always, or for this list.
    if (trial % 2)
      with_blunt.collect(mesh, tree, motion, rules, found);
    else
      collector.collect(mesh, tree, motion, rules, found, &blunt);
    listed += found.points.size() + found.edges.size();
    std::ranges::sort(found.edges);
    for (const std::vector<Vec3>* at : {&x, &end}) {
      const std::vector<Vec3>& y = *at;
      for (int v = 0; v < mesh.vertex_count; ++v)
        for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
          const auto& [a, b, c] = mesh.triangles[t];
          if ((v >= cloth) == (t >= cloth_triangles) || norm(y[v] - y[a]) > 0.3) continue;
          const double margin = blunt.vertex[v] ? rules.blunt_margin_m : rules.margin_m;
          if (closestOnTriangle({y[a], y[b], y[c]}, y[v]).dist2_m2 > margin * margin) continue;
          ++asked_points[blunt.vertex[v] != 0];
          ASSERT_TRUE(std::ranges::binary_search(found.points, PointTriangle{v, t})) << trial << " " << v << " " << t;
        }
      for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
        for (int f = e + 1; f < static_cast<int>(mesh.edges.size()); ++f) {
          const auto [a, b] = mesh.edges[e];
          const auto [c, d] = mesh.edges[f];
          if (a >= cloth || c < cloth || norm(y[a] - y[c]) > 0.3) continue;
          const bool narrow = blunt.edge[e] || blunt.edge[f];
          const double margin = narrow ? rules.blunt_margin_m : rules.margin_m;
          if (nearestOnSegments(y[a], y[b], y[c], y[d]).dist2_m2 > margin * margin) continue;
          ++asked_edges[narrow];
          ASSERT_TRUE(std::ranges::binary_search(found.edges, EdgeEdge{e, f})) << trial << " " << e << " " << f;
        }
    }
  }
  for (int asked : {asked_points[0], asked_points[1], asked_edges[0], asked_edges[1]}) EXPECT_GT(asked, 20);
  EXPECT_LT(listed, listed_without);
}

/// Cloth that rolls along, trembles and folds, over a body that moves, with `kicked` vertices in each step that jump by
/// a few millimetres: whenever two primitives come near in a step, the list has them once, with a distance that is not
/// too large, however old it is.
void TreeTest::serveManySteps(CandidateList& list, int kicked) {
  std::mt19937 random(11);
  std::normal_distribution<double> noise;
  const PairRules rules{0.003, 0.3, true};
  const double dt = 5e-4;
  std::vector<Vec3> x0 = rest, x1 = rest;
  const auto place = [&](double t, double tremor, std::vector<Vec3>& x) {
    for (int i = 0; i < cloth; ++i)
      x[i] = rolled(rest[i] + Vec3{0.3 * t, 0, 0}, 0.03, 0.002) +
             tremor * Vec3{noise(random), noise(random), noise(random)};
    for (std::size_t i = cloth; i < x.size(); ++i) x[i] = rest[i] + Vec3{0, 0, 0.5 * t};
    for (int k = 0; k < kicked; ++k) x[random() % cloth] += 1.5e-3 * Vec3{noise(random), noise(random), noise(random)};
  };
  place(0, 5e-5, x0);
  const auto near = [&](const PointTriangle& p, const std::vector<Vec3>& x) {
    const auto& [a, b, c] = mesh.triangles[p.triangle];
    return std::sqrt(closestOnTriangle({x[a], x[b], x[c]}, x[p.vertex]).dist2_m2);
  };
  const int steps = 24;
  std::size_t asked = 0;
  for (int step = 0; step < steps; ++step) {
    place((step + 1) * dt, 5e-5, x1);
    list.begin(step * dt, (step + 1) * dt, x0);
    list.cover(mesh, collector, rules, x1);
    std::vector<Vec3> middle;
    for (std::size_t i = 0; i < x0.size(); ++i) middle.push_back(0.5 * (x0[i] + x1[i]));
    for (int v = 0; v < static_cast<int>(x0.size()); ++v)
      for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        if (v == a || v == b || v == c || (v >= cloth && t >= cloth_triangles)) continue;
        if (norm(x0[v] - x0[a]) > 0.05) continue;
        if (v < cloth && t < cloth_triangles &&
            closestOnTriangle({rest[a], rest[b], rest[c]}, rest[v]).dist2_m2 < 0.03 * 0.03)
          continue;  // the certificate answers for neighbours
        const double least = std::min({near({v, t, {}}, x0), near({v, t, {}}, middle), near({v, t, {}}, x1)});
        if (least > rules.margin_m) continue;
        ++asked;
        const auto at = std::ranges::lower_bound(list.pairs().points, PointTriangle{v, t, {}});
        ASSERT_TRUE(at != list.pairs().points.end() && *at == (PointTriangle{v, t, {}}))
            << step << " " << v << " " << t;
        ASSERT_LE(list.apart(mesh, *at), least);
      }
    ASSERT_EQ(std::ranges::adjacent_find(list.pairs().points), list.pairs().points.end());
    std::vector<EdgeEdge> edges = list.pairs().edges;
    std::ranges::sort(edges);
    ASSERT_EQ(std::ranges::adjacent_find(edges), edges.end());
    for (const auto& [e, f] : nearEdges(x0, x1, rules.margin_m))
      ASSERT_TRUE(std::ranges::binary_search(edges, EdgeEdge{e, f})) << step << " " << e << " " << f;
    for (const EdgeEdge& e : edges) {
      const auto distance = [&](const std::vector<Vec3>& x) {
        const auto [a, b] = mesh.edges[e.a];
        const auto [c, d] = mesh.edges[e.b];
        return std::sqrt(nearestOnSegments(x[a], x[b], x[c], x[d]).dist2_m2);
      };
      ASSERT_LE(list.apart(mesh, e), std::min({distance(x0), distance(middle), distance(x1)}) + 1e-12);
      for (const double reach : {0.0, 0.5 * rules.margin_m, rules.margin_m})
        ASSERT_EQ(list.mayCome(mesh, e, reach), list.apart(mesh, e) < reach);
    }
    x0 = x1;
  }
  EXPECT_GT(asked, 10000u);
  EXPECT_LT(list.builds(), steps / 2);
}

TEST_F(TreeTest, AListServesManyStepsAndNeverMissesAPair) {
  CandidateList list(tree);
  serveManySteps(list, 0);
}

TEST_F(TreeTest, AListIsMendedAroundTheFewThatStray) {
  CandidateList list(tree);
  serveManySteps(list, 2);
  EXPECT_GT(list.mends(), 10);
}

/// The body comes at cloth that stands still, evenly: the list follows it and is made anew before its horizon is
/// passed.
TEST_F(TreeTest, AListEndsAtItsHorizon) {
  CandidateList list(tree);
  const PairRules rules{0.002, 0.3, true};
  const double dt = 5e-4, speed = 2, start = 0.27;
  std::vector<Vec3> x0 = rest, x1 = rest;
  const auto place = [&](int step, std::vector<Vec3>& x) {
    for (std::size_t i = cloth; i < x.size(); ++i) x[i] = rest[i] + Vec3{0, 0, speed * dt * step - start};
  };
  std::size_t asked = 0;
  for (int step = 0; step < 250; ++step) {
    place(step, x0);
    place(step + 1, x1);
    list.begin(step * dt, (step + 1) * dt, x0);
    list.cover(mesh, collector, rules, x1);
    for (int v = cloth; v < static_cast<int>(x0.size()); ++v)
      for (int t = 0; t < cloth_triangles; ++t) {
        const auto& [a, b, c] = mesh.triangles[t];
        const double at_start = std::sqrt(closestOnTriangle({x0[a], x0[b], x0[c]}, x0[v]).dist2_m2);
        const double at_end = std::sqrt(closestOnTriangle({x1[a], x1[b], x1[c]}, x1[v]).dist2_m2);
        if (std::min(at_start, at_end) > rules.margin_m) continue;
        ++asked;
        const auto at = std::ranges::lower_bound(list.pairs().points, PointTriangle{v, t, {}});
        ASSERT_TRUE(at != list.pairs().points.end() && *at == (PointTriangle{v, t, {}}))
            << step << " " << v << " " << t;
        ASSERT_LE(list.apart(mesh, *at), std::min(at_start, at_end));
      }
  }
  EXPECT_GT(asked, 5u);
  EXPECT_LT(list.builds(), 125);
}

}  // namespace
}  // namespace gambeson
