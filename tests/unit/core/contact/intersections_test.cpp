/// The exact checker of intersections against cases known by hand, public meshes, and the project's own detection.

#include "exact/intersections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "core/contact/crossing.hpp"
#include "core/error.hpp"
#include "tools/collision_data.hpp"
#include "tools/data_folder.hpp"
#include "unit/core/contact/tangle_shapes.hpp"

namespace gambeson {
namespace {

using exact::IntersectingPair;
using exact::intersections;
using Triangles = std::vector<std::array<int, 3>>;

const Vec3 kA{0, 0, 0}, kB{4, 0, 0}, kC{0, 4, 0};  // the first triangle, in z = 0
constexpr double kTiny = std::numeric_limits<double>::denorm_min();

bool disjointMeet(const Vec3& d, const Vec3& e, const Vec3& f) {
  const std::vector<Vec3> x{kA, kB, kC, d, e, f};
  const auto found = intersections(x, Triangles{{0, 1, 2}, {3, 4, 5}});
  EXPECT_EQ(found.none(), intersections(x, Triangles{{4, 5, 3}, {2, 1, 0}}).none());
  return !found.pairs.empty() && found.pairs == std::vector<IntersectingPair>{{0, 1, 0}};
}

TEST(ExactIntersections, TrianglesWithoutCommonVertex) {
  EXPECT_TRUE(disjointMeet({1, 1, -1}, {1, 1, 1}, {9, 9, 1}));   // through the inside
  EXPECT_FALSE(disjointMeet({1, 1, 1}, {1, 1, 2}, {9, 9, 1}));   // above
  EXPECT_FALSE(disjointMeet({3, 3, -1}, {3, 3, 1}, {9, 9, 1}));  // beside: planes cross, boxes overlap
  EXPECT_TRUE(disjointMeet({1, 1, 0}, {1, 1, 2}, {9, 9, 1}));    // a corner on the face
  EXPECT_FALSE(disjointMeet({1, 1, kTiny}, {1, 1, 2}, {9, 9, 1}));
  EXPECT_TRUE(disjointMeet({2, 2, -1}, {2, 2, 1}, {9, 9, 0}));  // an edge on an edge
  const double above = std::nextafter(2.0, 3);
  EXPECT_FALSE(disjointMeet({2, above, -1}, {2, above, 1}, {9, 9, 0}));
  EXPECT_TRUE(disjointMeet({4, 0, 0}, {5, 0, 1}, {5, 0, -1}));   // a corner on a corner of another number
  EXPECT_TRUE(disjointMeet({1, 1, 0}, {2, 1, 0}, {1, 2, 0}));    // inside it, in its plane
  EXPECT_TRUE(disjointMeet({-1, 1, 0}, {9, 1, 0}, {-1, 2, 0}));  // across it, in its plane
  EXPECT_FALSE(disjointMeet({3, 3, 0}, {9, 3, 0}, {3, 9, 0}));   // beside it, in its plane
}

bool meetBeyondVertex(const Vec3& e, const Vec3& f) {
  const std::vector<Vec3> x{kA, kB, kC, e, f};
  const auto found = intersections(x, Triangles{{0, 1, 2}, {3, 0, 4}});
  EXPECT_EQ(found.none(), intersections(x, Triangles{{4, 3, 0}, {1, 2, 0}}).none());
  return found.pairs == std::vector<IntersectingPair>{{0, 1, 1}};
}

TEST(ExactIntersections, TrianglesWithOneCommonVertex) {
  EXPECT_FALSE(meetBeyondVertex({1, 1, 1}, {2, 1, 1}));     // only the vertex
  EXPECT_TRUE(meetBeyondVertex({1, 1, 1}, {1, 1, -1}));     // the opposite edge through the face
  EXPECT_TRUE(meetBeyondVertex({6, 6, 1}, {6, 6, -1}));     // its own opposite edge through the other
  EXPECT_FALSE(meetBeyondVertex({-1, 1, 1}, {-1, 1, -1}));  // planes cross on the other side of the vertex
  EXPECT_TRUE(meetBeyondVertex({2, 0, 0}, {2, 0, 1}));      // along an edge
  EXPECT_FALSE(meetBeyondVertex({-2, 0, 0}, {2, 0, 1}));
  EXPECT_FALSE(meetBeyondVertex({2, -kTiny, 0}, {2, -1, 1}));
  EXPECT_TRUE(meetBeyondVertex({1, -1, 0}, {1, 1, 0}));  // overlap in the plane
  EXPECT_FALSE(meetBeyondVertex({-1, 1, 0}, {-1, -1, 0}));
  EXPECT_TRUE(meetBeyondVertex({1, 1, 0}, {-1, -1, 1}));  // an edge from the vertex along the face
  EXPECT_FALSE(meetBeyondVertex({1, 1, kTiny}, {-1, -1, 1}));
}

bool foldedFlat(const Vec3& d) {
  const std::vector<Vec3> x{kA, kB, kC, d};
  const auto found = intersections(x, Triangles{{0, 1, 2}, {3, 1, 0}});
  EXPECT_EQ(found.none(), intersections(x, Triangles{{1, 3, 0}, {2, 0, 1}}).none());
  return found.pairs == std::vector<IntersectingPair>{{0, 1, 2}};
}

TEST(ExactIntersections, TrianglesWithACommonEdge) {
  EXPECT_FALSE(foldedFlat({1, -1, 0}));
  EXPECT_FALSE(foldedFlat({1, 1, 1}));
  EXPECT_TRUE(foldedFlat({1, 1, 0}));
  EXPECT_TRUE(foldedFlat({-9, 1, 0}));
  EXPECT_FALSE(foldedFlat({1, 1, kTiny}));  // folded as sharply as doubles can
  EXPECT_FALSE(foldedFlat({1, -1, -kTiny}));
}

TEST(ExactIntersections, TheSameTriangleTwice) {
  const std::vector<Vec3> x{kA, kB, kC};
  EXPECT_EQ(intersections(x, Triangles{{0, 1, 2}, {2, 1, 0}}).pairs, (std::vector<IntersectingPair>{{0, 1, 3}}));
}

/// (n + 1)(n - 1) - n n = -1 is 0 in doubles at n = 2^27: a corner beside an edge by less than rounding.
TEST(ExactIntersections, DecidesBelowRounding) {
  const double n = std::ldexp(1, 27);
  ASSERT_EQ((n + 1) * (n - 1) - n * n, 0);
  const auto meetsSide = [&](const Vec3& side) {
    const std::vector<Vec3> x{{0, 0, 0}, {2 * (n + 1), 2 * n, 0}, side, {n, n - 1, -1}, {n, n - 1, 1}, {n, -n, 0}};
    return !intersections(x, Triangles{{0, 1, 2}, {3, 4, 5}}).none();
  };
  EXPECT_FALSE(meetsSide({0, 2 * n, 0}));
  EXPECT_TRUE(meetsSide({2 * n, 0, 0}));
}

TEST(ExactIntersections, CollapsedTrianglesAreNamed) {
  const std::vector<Vec3> x{kA, kB, kC, {1, 1, -1}, {1, 1, 0}, {1, 1, 1}, {1, 1, 1}, {2, 1, 0}, {2, 1, 0}, {2, 1, 0}};
  auto found = intersections(x, Triangles{{0, 1, 2}, {4, 5, 3}});
  EXPECT_EQ(found.collapsed, std::vector<int>{1});
  EXPECT_EQ(found.pairs, (std::vector<IntersectingPair>{{0, 1, 0}}));
  found = intersections(x, Triangles{{0, 1, 2}, {5, 6, 4}, {7, 8, 9}});
  EXPECT_EQ(found.collapsed, (std::vector<int>{1, 2}));
  EXPECT_EQ(found.pairs, (std::vector<IntersectingPair>{{0, 1, 0}, {0, 2, 0}}));
  EXPECT_FALSE(intersections(x, Triangles{{7, 8, 9}}).none());
  // Neighbours are not compared with it.
  EXPECT_TRUE(intersections(x, Triangles{{0, 1, 2}, {0, 7, 8}}).pairs.empty());
}

TEST(ExactIntersections, ObstaclesAmongThemselvesAreLeftOut) {
  const std::vector<Vec3> x{kA, kB, kC, {1, 1, -1}, {1, 1, 1}, {9, 9, 1}, {1, 2, -1}, {1, 2, 1}, {9, 0, 1}};
  const Triangles t{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  EXPECT_EQ(intersections(x, t).pairs.size(), 3u);
  const std::vector<char> obstacle{0, 0, 0, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(intersections(x, t, obstacle).pairs, (std::vector<IntersectingPair>{{0, 1, 0}, {0, 2, 0}}));
}

TEST(ExactIntersections, RefusesWhatIsNotFinite) {
  for (double bad : {NAN, INFINITY})
    EXPECT_THROW(intersections(std::vector<Vec3>{kA, kB, {0, bad, 0}}, Triangles{{0, 1, 2}}), RunError);
}

/// The pairs that the project's own detection names: the faces of each edge against the triangle that it crosses.
std::vector<IntersectingPair> ownPairs(const testing_shapes::Tangled& t) {
  std::set<std::array<int, 2>> pairs;
  for (const Crossing& c : findCrossings(t.mesh, t.x))
    for (int face : t.mesh.edge_faces[c.edge]) pairs.insert({std::min(face, c.triangle), std::max(face, c.triangle)});
  std::vector<IntersectingPair> out;
  for (const auto& [a, b] : pairs) {
    int shared = 0;
    for (int v : t.mesh.triangles[a])
      for (int w : t.mesh.triangles[b]) shared += v == w;
    out.push_back({a, b, shared});
  }
  return out;
}

/// In general position ties do not matter, so both name the same pairs. Coordinates of 53 random bits, and 1 + k 2^-36,
/// where differences of products cancel.
TEST(ExactIntersections, NamesTheSamePairsAsTheDetection) {
  std::mt19937_64 random(7);
  long disjoint = 0, at_vertex = 0;
  for (int trial = 0; trial < 60; ++trial) {
    testing_shapes::Tangled t = [&] {
      std::mt19937 topology(trial);
      return testing_shapes::soup(topology, 90, 120, 1);
    }();
    const bool fine = trial % 2;
    for (Vec3& p : t.x)
      for (int c = 0; c < 3; ++c)
        p[c] = fine ? 1 + std::ldexp(static_cast<double>(random() >> 48), -36)
                    : std::ldexp(static_cast<double>(random() >> 11), -53);
    auto found = intersections(t.x, t.mesh.triangles);
    // Random triples may come twice; a triangle does not cross itself.
    std::erase_if(found.pairs, [](const IntersectingPair& p) { return p.shared == 3; });
    const auto own = ownPairs(t);
    ASSERT_EQ(found.pairs.size(), own.size()) << trial;
    ASSERT_TRUE(found.pairs == own) << trial;
    EXPECT_TRUE(found.collapsed.empty());
    for (const IntersectingPair& p : found.pairs) (p.shared ? at_vertex : disjoint) += 1;
  }
  std::printf("[ measured ] %ld pairs without a common vertex, %ld with one\n", disjoint, at_vertex);
  EXPECT_GT(disjoint, 10000);
  EXPECT_GT(at_vertex, 500);
}

/// A waisted sleeve through a wavy sheet, in general position by a turn.
TEST(ExactIntersections, NamesTheSamePairsOfASleeveThroughASheet) {
  const Mat3 R = rotationAbout(normalized(Vec3{1, 2, 3}), 0.7);
  const auto turned = [&](const Vec3& p) { return R * p; };
  using namespace testing_shapes;
  const Tangled t = join({mapped(waistedSleeve(48), turned),
                          mapped(sheet(40, 40,
                                       [](double u, double v) {
                                         return Vec3{0.2 * u - 0.1, 0.2 * v - 0.1, 0.003 * std::sin(9 * u)};
                                       }),
                                 turned)});
  const auto found = intersections(t.x, t.mesh.triangles);
  EXPECT_TRUE(found.pairs == ownPairs(t));
  EXPECT_GT(found.pairs.size(), 100u);
}

collision::Frame publicMesh(const std::string& name) {
  const std::filesystem::path file = test::collisionFolder() / name;
  return std::filesystem::exists(file) ? collision::readPly(file) : collision::Frame{};
}

TEST(ExactIntersections, TwoCubes) {
  const collision::Frame close = publicMesh("two-cubes-close.ply"), through = publicMesh("two-cubes-intersecting.ply");
  if (close.faces.empty() || through.faces.empty()) GTEST_SKIP() << "no public data: real/collision/two-cubes-*.ply";
  EXPECT_TRUE(intersections(close.vertices, close.faces).none());
  const auto found = intersections(through.vertices, through.faces);
  EXPECT_TRUE(found.collapsed.empty());
  EXPECT_GT(found.pairs.size(), 50u);
  EXPECT_TRUE(found.pairs ==
              ownPairs({contactMesh(static_cast<int>(through.vertices.size()), through.faces), through.vertices, {}}));
}

}  // namespace
}  // namespace gambeson
