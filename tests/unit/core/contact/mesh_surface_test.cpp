/// Trees, triangles, and distance queries on meshes against brute force.
#include "core/contact/mesh_surface.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

#include "core/contact/triangle.hpp"
#include "unit/core/contact/mesh_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

Vec3 randomPoint(std::mt19937& rng, double half = 1) {
  std::uniform_real_distribution<double> u(-half, half);
  return {u(rng), u(rng), u(rng)};
}

/// Smallest distance over all triangles.
double bruteDistance(const TriangleMesh& m, const Vec3& p) {
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : m.triangles)
    best = std::min(best, closestOnTriangle({m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]}, p).dist2_m2);
  return std::sqrt(best);
}

/// Winding number of a closed mesh about p (van Oosterom and Strackee 1983): 1 inside, 0 outside.
double winding(const TriangleMesh& m, const Vec3& p) {
  double sum = 0;
  for (const auto& t : m.triangles) {
    const Vec3 a = m.vertices[t[0]] - p, b = m.vertices[t[1]] - p, c = m.vertices[t[2]] - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * M_PI);
}

TEST(Triangle, ClosestPointBeatsAGridOfItsPoints) {
  std::mt19937 rng(1);
  std::set<int> features;
  for (int trial = 0; trial < 2000; ++trial) {
    const std::array<Vec3, 3> x{randomPoint(rng), randomPoint(rng), randomPoint(rng)};
    const Vec3 p = randomPoint(rng, 2);
    const TrianglePoint c = closestOnTriangle(x, p);
    features.insert(c.feature);
    EXPECT_NEAR(norm(p - c.position), std::sqrt(c.dist2_m2), 1e-13);
    double best = 1e9;
    for (int i = 0; i <= 40; ++i)
      for (int j = 0; i + j <= 40; ++j) {
        const double u = i / 40.0, v = j / 40.0;
        best = std::min(best, norm(p - (1 - u - v) * x[0] - u * x[1] - v * x[2]));
      }
    EXPECT_LE(norm(p - c.position), best + 1e-14);
    EXPECT_GE(norm(p - c.position), best - 0.1);
  }
  EXPECT_EQ(features.size(), 7u);
}

TEST(Triangle, WithoutAreaItIsItsEdges) {
  const TrianglePoint c = closestOnTriangle({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{2, 0, 0}}, {1.5, 1, 0});
  EXPECT_NEAR(c.dist2_m2, 1, 1e-15);
  EXPECT_EQ(closestOnTriangle({Vec3{1, 1, 1}, Vec3{1, 1, 1}, Vec3{1, 1, 1}}, {1, 1, 3}).dist2_m2, 4);
}

TEST(BoundingTree, FindsWhatBruteForceFinds) {
  std::mt19937 rng(2);
  for (int n : {1, 2, 5, 400}) {
    for (int leaf : {1, 4}) {
      std::vector<Box> boxes(n);
      for (auto& b : boxes) {
        const Vec3 c = randomPoint(rng);
        b.add(c), b.add(c + randomPoint(rng, 0.1));
      }
      BoundingTree tree(boxes, leaf);
      for (int round = 0; round < 2; ++round) {
        for (int trial = 0; trial < 100; ++trial) {
          Box q;
          q.add(randomPoint(rng)), q.add(q.lo + randomPoint(rng, 0.5));
          std::multiset<int> seen;
          tree.overlapping(q, [&](int i) { seen.insert(i); });
          for (int i = 0; i < n; ++i) {
            ASSERT_LE(seen.count(i), 1u);
            if (overlap(boxes[i], q)) {
              ASSERT_EQ(seen.count(i), 1u);
            }
          }
          const Vec3 p = randomPoint(rng, 1.5);
          seen.clear();
          tree.within(p, 0.3, [&](int i) { seen.insert(i); });
          double best2 = std::numeric_limits<double>::infinity(), brute2 = best2;
          int visited = 0;
          tree.nearest(p, best2, [&](int i, double& limit2) {
            ++visited;
            limit2 = std::min(limit2, boxDistance2(boxes[i], p));
          });
          for (int i = 0; i < n; ++i) {
            brute2 = std::min(brute2, boxDistance2(boxes[i], p));
            if (boxDistance2(boxes[i], p) <= 0.09) {
              ASSERT_EQ(seen.count(i), 1u);
            }
          }
          ASSERT_EQ(best2, brute2);
          if (n == 400 && round == 0) {
            ASSERT_LT(visited, 100);
          }
        }
        // Same topology around primitives that moved.
        for (auto& b : boxes) {
          const Vec3 c = randomPoint(rng);
          b = Box{};
          b.add(c), b.add(c + randomPoint(rng, 0.1));
        }
        tree.refit(boxes);
      }
    }
  }
}

TEST(BoundingTree, CoincidingCentresEnd) {
  std::vector<Box> boxes(1000);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].add(Vec3{1, 2, 3});
  const BoundingTree tree(boxes, 1);
  EXPECT_LE(tree.levels(), 96);
  int seen = 0;
  tree.overlapping(Box{{1, 2, 3}, {1, 2, 3}}, [&](int) { ++seen; });
  EXPECT_EQ(seen, 1000);
  // Centres that pile up geometrically make bisection deep; the stack of a traversal is bounded all the same.
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double x = std::ldexp(1.0, -static_cast<int>(i));
    boxes[i] = Box{{x, 0, 0}, {x, 0, 0}};
  }
  EXPECT_LE(BoundingTree(boxes, 1).levels(), 96);
}

TEST(MeshSurface, SignedDistanceIsThatOfBruteForceAndWinding) {
  std::mt19937 rng(3);
  for (const TriangleMesh& m : {box({0.5, 0.3, 0.7}), sphere(0.8, 2), torus(0.6, 0.25, 20, 9)}) {
    const MeshSurface s(m);
    ASSERT_TRUE(s.closed());
    int inside = 0;
    for (int trial = 0; trial < 1500; ++trial) {
      const Vec3 p = randomPoint(rng);
      const auto q = s.nearest(p, std::numeric_limits<double>::infinity());
      ASSERT_TRUE(q);
      const bool in = winding(m, p) > 0.5;
      inside += in;
      ASSERT_NEAR(q->distance_m, (in ? -1 : 1) * bruteDistance(m, p), 1e-14);
      ASSERT_NEAR(norm(p - q->position - q->distance_m * q->normal), 0, 1e-10);
    }
    EXPECT_GT(inside, 100);
    EXPECT_FALSE(s.nearest({5, 5, 5}, 1));
  }
}

TEST(MeshSurface, SliversAtASpikeDoNotTurnTheSign) {
  // A sharp pyramid, one of whose sides is a fan of 20 slivers: counted one by one they would outvote the others.
  TriangleMesh m;
  m.vertices = {{0, 0, 1}, {-0.05, 0.05, 0}, {-0.05, -0.05, 0}};
  for (int i = 0; i <= 20; ++i) m.vertices.push_back({0.05, -0.05 + 0.005 * i, 0});
  m.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 23, 1}};
  for (int i = 3; i < 23; ++i) {
    m.triangles.push_back({0, i, i + 1});
    m.triangles.push_back({1, i + 1, i});
  }
  m.triangles.push_back({1, 3, 2});
  const MeshSurface s(m);
  ASSERT_TRUE(s.closed());
  const auto q = s.nearest({-0.1, 0, 1.02}, 10);
  EXPECT_EQ(q->position, m.vertices[0]);
  EXPECT_NEAR(q->distance_m, std::hypot(0.1, 0.02), 1e-15);
}

TEST(MeshSurface, NormalIsTheGradientOfTheDistance) {
  std::mt19937 rng(4);
  const MeshSurface s(torus(0.6, 0.25, 20, 9));
  const double h = 1e-7, all = std::numeric_limits<double>::infinity();
  int same = 0;
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 p = randomPoint(rng);
    const auto q = s.nearest(p, all);
    for (int i = 0; i < 3; ++i) {
      Vec3 a = p, b = p;
      a[i] -= h, b[i] += h;
      const auto A = s.nearest(a, all), B = s.nearest(b, all);
      if (A->feature != q->feature || B->feature != q->feature) continue;  // a kink lies between
      ++same;
      ASSERT_NEAR((B->distance_m - A->distance_m) / (2 * h), q->normal[i], 1e-5);
    }
  }
  EXPECT_GT(same, 1400);
}

/// All local minima of the distance over the mesh, by definition: triangle by triangle the closest point, kept where
/// every triangle that holds this point has it as its closest.
std::vector<Vec3> bruteMinima(const TriangleMesh& m, const Vec3& p, double radius) {
  const auto closest = [&](const std::array<int, 3>& t) {
    return closestOnTriangle({m.vertices[t[0]], m.vertices[t[1]], m.vertices[t[2]]}, p);
  };
  std::vector<Vec3> out;
  for (const auto& t : m.triangles) {
    const TrianglePoint c = closest(t);
    if (c.dist2_m2 > radius * radius) continue;
    bool minimum = true;
    for (const auto& u : m.triangles) {
      const std::array<Vec3, 3> x{m.vertices[u[0]], m.vertices[u[1]], m.vertices[u[2]]};
      if (closestOnTriangle(x, c.position).dist2_m2 < 1e-22 && norm2(closest(u).position - c.position) > 1e-20)
        minimum = false;
    }
    for (const Vec3& q : out) minimum = minimum && norm2(q - c.position) > 1e-20;
    if (minimum) out.push_back(c.position);
  }
  return out;
}

TEST(MeshSurface, TouchingGivesEachLocalMinimumOnce) {
  std::mt19937 rng(5);
  for (const TriangleMesh& m : {box({0.5, 0.3, 0.7}), torus(0.6, 0.25, 16, 8), sphere(0.8, 1)}) {
    const MeshSurface s(m);
    int several = 0, found = 0;
    std::vector<MeshPoint> got;
    for (int trial = 0; trial < 1500; ++trial) {
      const Vec3 p = randomPoint(rng);
      const double radius = 0.3;
      got.clear();
      s.touching(p, radius, got);
      if (winding(m, p) > 0.5) {
        ASSERT_EQ(got.size(), 1u);
        ASSERT_NEAR(got[0].distance_m, -bruteDistance(m, p), 1e-14);
        continue;
      }
      // Those on the far side have the body between them and p: their offset points into the mesh.
      std::vector<Vec3> expected;
      for (const Vec3& q : bruteMinima(m, p, radius))
        if (winding(m, q + 1e-6 * normalized(p - q)) < 0.5) expected.push_back(q);
      ASSERT_EQ(got.size(), expected.size()) << trial;
      for (const Vec3& q : expected)
        ASSERT_TRUE(
            std::any_of(got.begin(), got.end(), [&](const MeshPoint& g) { return norm(g.position - q) < 1e-9; }));
      for (const MeshPoint& g : got) ASSERT_NEAR(g.distance_m, norm(p - g.position), 1e-13);
      found += !got.empty();
      several += got.size() > 1;
    }
    EXPECT_GT(found, 200);
    if (m.vertices.size() == 16 * 8) {
      EXPECT_GT(several, 20) << "the hole of the torus is concave";
    }
  }
}

TEST(MeshSurface, OpenMeshSeesItsBackWithinReachOnly) {
  const MeshSurface s(plane(4));
  ASSERT_FALSE(s.closed());
  std::vector<MeshPoint> got;
  s.touching({0.3, 0.3, -0.04}, 0.05, got);
  ASSERT_EQ(got.size(), 1u);
  EXPECT_NEAR(got[0].distance_m, -0.04, 1e-16);
  EXPECT_EQ(got[0].normal, (Vec3{0, 0, 1}));
  got.clear();
  s.touching({0.3, 0.3, -0.06}, 0.05, got);
  EXPECT_TRUE(got.empty());
  s.touching({1.03, 0.5, -0.01}, 0.05, got);  // beyond the rim nothing is penetrated
  ASSERT_EQ(got.size(), 1u);
  EXPECT_GT(got[0].distance_m, 0);
}

TEST(MeshSurface, RepeatedVerticesAreWelded) {
  const TriangleMesh m = box({0.5, 0.3, 0.7});
  TriangleMesh soup;
  for (const auto& t : m.triangles) {
    const int n = static_cast<int>(soup.vertices.size());
    for (int i : t) soup.vertices.push_back(m.vertices[i]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  soup.triangles.push_back({0, 1, 1});  // collapsed: ignored
  const MeshSurface s(soup);
  EXPECT_TRUE(s.closed());
  EXPECT_EQ(s.topology().edges.size(), 18u);
  std::vector<MeshPoint> got;
  s.touching({0.51, 0.31, 0.71}, 0.1, got);
  EXPECT_EQ(got.size(), 1u);
}

TEST(MeshSurface, AFootWithinTheToleranceOfAnEdgeIsTheFaces) {
  // Of one triangle, fat or thin: to the tolerance, whatever the edge's length and the distance from it.
  std::mt19937 rng(21);
  std::uniform_real_distribution<double> within(0.1, 0.9), height(0, 0.5);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 a = randomPoint(rng), b = randomPoint(rng), way = randomPoint(rng);
    const double thin = trial % 4 == 0 ? 1e-4 : 1;
    const Vec3 c = a + within(rng) * (b - a) + thin * way;
    const MeshSurface s({{a, b, c}, {{0, 1, 2}}});
    const Vec3 normal = normalized(cross(b - a, c - a)), inward = normalized(cross(normal, b - a));
    for (const double part : {-1000.0, -2.0, -0.5, 0.0, 0.5}) {
      const Vec3 p =
          a + within(rng) * (b - a) + part * s.tolerance_m() * inward + (trial % 3 ? height(rng) : 0.0) * normal;
      std::vector<MeshPoint> got;
      s.touching(p, 1, got);
      ASSERT_EQ(got.size(), 1u) << trial;
      ASSERT_EQ(got[0].feature == 0, part > -1) << trial << ", " << part;
    }
  }
}

TEST(InsideGrid, DecidedCellsAgreeWithTheWindingNumber) {
  std::mt19937 rng(9);
  for (const TriangleMesh& m : {torus(0.6, 0.25, 40, 16), sphere(0.8, 3)}) {
    std::vector<std::array<Vec3, 3>> corners;
    for (const auto& [a, b, c] : m.triangles) corners.push_back({m.vertices[a], m.vertices[b], m.vertices[c]});
    const InsideGrid grid(
        corners, [&](const Vec3& p) { return winding(m, p) > 0.5; }, 40);
    int decided = 0;
    for (int trial = 0; trial < 4000; ++trial) {
      const Vec3 p = randomPoint(rng, 0.8);
      if (grid.at(p) == InsideGrid::Cube::undecided) continue;
      ++decided;
      ASSERT_EQ(grid.at(p) == InsideGrid::Cube::inside, winding(m, p) > 0.5);
    }
    EXPECT_GT(decided, 500);
    EXPECT_EQ(grid.at({5, 0, 0}), InsideGrid::Cube::undecided);
  }
}

TEST(MeshSurface, RefitFollowsADeformingMesh) {
  std::mt19937 rng(8);
  TriangleMesh m = sphere(0.7, 2);
  MeshSurface s(m);
  for (Vec3& v : m.vertices) v = Vec3{1.5 * v.x + 0.2, 0.6 * v.y, v.z + 0.3 * v.x * v.x};
  s.refit(m.vertices);
  const MeshSurface fresh(m);
  EXPECT_EQ(s.bounds(), fresh.bounds());
  EXPECT_EQ(s.tolerance_m(), fresh.tolerance_m());
  for (int trial = 0; trial < 500; ++trial) {
    const Vec3 p = randomPoint(rng, 1.3);
    const auto a = s.nearest(p, 10), b = fresh.nearest(p, 10);
    ASSERT_NEAR(std::abs(a->distance_m), bruteDistance(m, p), 1e-14);
    ASSERT_NEAR(a->distance_m, b->distance_m, 1e-15);
    std::vector<MeshPoint> touching;
    s.touching(p, 0.01, touching);
    ASSERT_EQ(!touching.empty(), b->distance_m <= 0.01);
  }
}

}  // namespace
}  // namespace gambeson
