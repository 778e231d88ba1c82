/// Broad phases by cells beside the one by trees: the same candidates and hits, whatever the scene, the width of a
/// group and the room; owners of features; pieces; work dealt out.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "gpu/device/reference.hpp"
#include "gpu/finding/cells/owners.hpp"
#include "gpu/finding/hash.hpp"
#include "gpu/finding/impact_finder.hpp"
#include "scenes.hpp"

namespace gambeson::gpu {
namespace {

constexpr Broad kSame[] = {Broad::vss, Broad::otg, Broad::grid};  ///< as Broad::lbvh, in what they find

/// Scenes that cells are bad at.
std::vector<Scene> hardScenes() {
  std::vector<Scene> scenes = smallScenes();
  scenes.push_back(gradedPyramids(2, 24));
  scenes.push_back(longWays(6));
  const auto changed = [&](Scene scene, const char* name, const auto& change) {
    scene.name = name;
    for (std::size_t i = 0; i < scene.x0.size(); ++i) change(scene.x0[i], scene.x1[i]);
    scenes.push_back(std::move(scene));
  };
  changed(fallingSheets(8), "nothing moves", [](Vec3& a, Vec3& b) { b = a; });
  changed(triangleSoup(60, 3), "all in one point", [](Vec3& a, Vec3& b) { a = b = {0.1, -0.2, 0.3}; });
  changed(triangleSoup(60, 4), "all in one plane", [](Vec3& a, Vec3& b) { a.z = b.z = -1; });
  changed(triangleSoup(60, 5), "all along one line", [](Vec3& a, Vec3& b) { a.y = b.y = a.z = b.z = 0; });
  int i = 0;
  changed(fallingSheets(8), "all fly far, each its own way", [&](Vec3& a, Vec3& b) {
    b = a + 1e6 * Vec3{++i % 3 - 1.0, i % 5 - 2.0, i % 7 - 3.0};
  });
  // A triangle around everything else, in a corner of its box.
  Scene giant = fallingSheets(10);
  giant.name = "one giant triangle";
  const int first = giant.mesh.vertices;
  for (const Vec3& corner : {Vec3{-3, -3, -3}, Vec3{4, -3, 3}, Vec3{-3, 5, 4}}) {
    giant.x0.push_back(corner);
    giant.x1.push_back(corner + Vec3{0.1, 0, 0});
  }
  giant.mesh.vertices += 3;
  giant.mesh.faces.push_back({first, first + 1, first + 2});
  giant.mesh.edges = edgesOf(giant.mesh.faces);
  scenes.push_back(giant);
  return scenes;
}

const BothSizes kAmple{ListSizes{1 << 17, 1 << 15, 1 << 15, 1 << 15}, ListSizes{1 << 19, 1 << 17, 1 << 16, 1 << 16}};

template <class Device>
std::unique_ptr<ImpactSearch> searched(const Scene& scene, Broad broad, Bounds bounds = Bounds::boxes,
                                       unsigned long long room = 0) {
  SearchOptions options = scene.options;
  options.broad = broad, options.bounds = bounds, options.cells_room = room;
  auto search = impactFinder<Device>(scene.mesh, scene.x0, options, kAmple);
  search->setMotion(scene.x0, scene.x1);
  search->find(Trees::rebuilt);
  return search;
}

template <int W>
Facts factsWith(const Scene& scene, Broad broad, Bounds bounds = Bounds::boxes) {
  return factsOf(*searched<ReferenceOf<W>>(scene, broad, bounds));
}

/// Whether the facts are those of the pairs by brute force, with which trees are compared elsewhere.
TEST(BroadPhases, FindTheSameCandidatesAndHits) {
  for (const Scene& scene : hardScenes()) {
    const Facts facts = factsWith<1>(scene, Broad::lbvh);
    for (const Broad broad : kSame)
      EXPECT_EQ(factsWith<1>(scene, broad), facts) << scene.name << ", " << static_cast<int>(broad);
    for (int k = 0; k < kPairKinds; ++k)
      EXPECT_EQ(facts[k].sizes.pairs, pairsByBruteForce(scene, PairKind{k}).size()) << scene.name;
  }
}

TEST(BroadPhases, AnyWidthOfAGroupGivesTheSameBits) {
  for (const Scene& scene : {triangleSoup(300, 2), flyingBalls(3), longWays(6), gradedPyramids(2, 16)})
    for (const Broad broad : {Broad::vss, Broad::vssPieces, Broad::otg}) {
      const Facts facts = factsWith<1>(scene, broad);
      EXPECT_EQ(factsWith<5>(scene, broad), facts) << scene.name << ", " << static_cast<int>(broad);
      EXPECT_EQ(factsWith<32>(scene, broad), facts) << scene.name << ", " << static_cast<int>(broad);
    }
}

/// Fewer candidates, as boxes of triangles that are not along the axes are large; and no hit less.
TEST(BroadPhases, PolytopesLoseNoHit) {
  unsigned long long boxes = 0, polytopes = 0;
  for (const Scene& scene : hardScenes()) {
    const Facts by_boxes = factsWith<1>(scene, Broad::lbvh),
                facts = factsWith<1>(scene, Broad::lbvh, Bounds::polytopes);
    for (const Broad broad : kSame)
      EXPECT_EQ(factsWith<1>(scene, broad, Bounds::polytopes), facts) << scene.name << ", " << static_cast<int>(broad);
    for (int k = 0; k < kPairKinds; ++k) {
      EXPECT_EQ(facts[k].hits_hash, by_boxes[k].hits_hash) << scene.name;
      boxes += by_boxes[k].sizes.pairs, polytopes += facts[k].sizes.pairs;
    }
  }
  EXPECT_LT(polytopes, boxes * 9 / 10);
}

TEST(BroadPhases, PiecesLoseNoHitAndRegisterLess) {
  bool fewer = false;
  for (const Scene& scene : hardScenes()) {
    const auto whole = searched<Reference>(scene, Broad::vss), pieces = searched<Reference>(scene, Broad::vssPieces);
    const Facts all = factsOf(*whole), some = factsOf(*pieces);
    for (int k = 0; k < kPairKinds; ++k) {
      EXPECT_EQ(some[k].hits_hash, all[k].hits_hash) << scene.name;
      EXPECT_LE(some[k].sizes.pairs, all[k].sizes.pairs) << scene.name;
      std::vector<Pair> pairs = pieces->pairs(PairKind{k});
      std::ranges::sort(pairs);
      EXPECT_EQ(std::ranges::adjacent_find(pairs), pairs.end()) << scene.name;
    }
    EXPECT_LE(pieces->broadFacts().registrations, whole->broadFacts().registrations) << scene.name;
    fewer |= pieces->broadFacts().registrations < whole->broadFacts().registrations * 9 / 10;
  }
  EXPECT_TRUE(fewer);
}

TEST(BroadPhases, BodiesDoNotMeetEachOther) {
  for (Scene scene : {flyingBalls(3), wavySheets(3, 9)}) {
    const Facts all = factsWith<1>(scene, Broad::vss);
    scene.mesh.bodies_from = scene.mesh.vertices / 3;
    const Facts facts = factsWith<1>(scene, Broad::lbvh);
    EXPECT_LT(facts[1].sizes.pairs, all[1].sizes.pairs);
    for (const Broad broad : kSame) EXPECT_EQ(factsWith<1>(scene, broad), facts) << scene.name;
  }
}

TEST(BroadPhases, TooLittleRoomIsRepeatedWithMore) {
  const Scene scene = triangleSoup(300, 2);
  for (const Broad broad : {Broad::vss, Broad::vssPieces, Broad::otg}) {
    const auto ample = searched<Reference>(scene, broad, Bounds::boxes, 1 << 18);
    EXPECT_EQ(ample->repeats(), 0);
    const auto scarce = searched<Reference>(scene, broad, Bounds::boxes, 3);
    EXPECT_GE(scarce->repeats(), 1);
    EXPECT_EQ(factsOf(*scarce), factsOf(*ample));
    EXPECT_EQ(scarce->broadFacts().tests, ample->broadFacts().tests);
  }
}

/// Another step with the same search: what is left of the last one matters to nothing.
TEST(BroadPhases, AnotherStepOfTheSameSearch) {
  const Scene scene = gradedPyramids(2, 16);
  for (const Broad broad : {Broad::vss, Broad::vssPieces, Broad::otg}) {
    const auto search = searched<Reference>(scene, broad);
    const Facts facts = factsOf(*search);
    const BroadFacts broad_facts = search->broadFacts();
    std::vector<Vec3> elsewhere = scene.x1;
    std::ranges::reverse(elsewhere);
    for (Vec3& x : elsewhere) x = 7.0 * x + Vec3{1, 2, 3};
    search->setMotion(scene.x0, elsewhere);
    search->find(Trees::rebuilt);
    EXPECT_NE(factsOf(*search), facts);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::refitted);
    EXPECT_EQ(factsOf(*search), facts);
    EXPECT_EQ(search->broadFacts().tests, broad_facts.tests);
    EXPECT_EQ(search->broadFacts().registrations, broad_facts.registrations);
  }
}

/// Cells are cut where triangles are many: fewer tests than with cells of one size where sizes differ, and those after
/// the mean are better than those after the largest (Wong 2014, figures 5.14 and 6.10).
TEST(BroadPhases, FewerTestsWithCellsThatFit) {
  const Scene scene = gradedPyramids(2, 48);
  const auto tests = [&](Broad broad) { return searched<Reference>(scene, broad)->broadFacts().tests; };
  EXPECT_LT(2 * tests(Broad::vss), tests(Broad::grid));
  EXPECT_LT(2 * tests(Broad::otg), tests(Broad::vss));
}

TEST(BroadPhases, FactsAreOfWhatWasDone) {
  const Scene scene = flyingBalls(5);
  const auto n = static_cast<unsigned long long>(scene.mesh.faces.size());
  // All pairs of triangles whose boxes meet, each against each.
  std::vector<FloatBox> box;
  for (const auto& f : scene.mesh.faces) {
    FloatBox all = emptyBox();
    for (const int v : f) all = joined(all, boxOf({scene.x0[v], scene.x1[v]}, 0));
    box.push_back(all);
  }
  unsigned long long meeting = 0;
  for (std::size_t a = 0; a < box.size(); ++a)
    for (std::size_t b = a + 1; b < box.size(); ++b) meeting += meet(box[a], box[b]);
  for (const Broad broad : kSame) {
    const auto search = searched<Reference>(scene, broad);
    const BroadFacts facts = search->broadFacts();
    EXPECT_EQ(facts.pairs_of_triangles, meeting);
    EXPECT_GE(facts.tests, facts.boxes_of_triangles);
    EXPECT_GE(facts.boxes_of_triangles, meeting);
    EXPECT_LE(facts.boxes_of_triangles, n * (n - 1) / 2);
    const BothSizes sizes = search->sizes();
    EXPECT_GE(facts.boxes_of_features, sizes[0].pairs + sizes[1].pairs);
    EXPECT_GE(facts.registrations, n);
    EXPECT_EQ(std::accumulate(facts.registrations_of.begin(), facts.registrations_of.end(), 0ull), facts.registrations);
    EXPECT_GT(facts.bytes, n * sizeof(Owner));
  }
  EXPECT_GT(searched<Reference>(scene, Broad::lbvh)->broadFacts().tests, 1000u);
}

TEST(Owners, EachFeatureHasOne) {
  std::vector<Scene> scenes = hardScenes();
  scenes.back().mesh.edges.push_back({0, 1});  // once more
  for (const Scene& scene : scenes) {
    const std::vector<Owner> owners = ownersOf(scene.mesh);
    std::multiset<int> vertices, edges, faces;
    int most = 0;
    for (const Owner& o : owners) {
      int own = 0;
      for (int k = 0; k < 3; ++k) {
        if (o.own_corner >> k & 1) vertices.insert(o.corner[k]), ++own;
        if (o.edge[k] < 0) continue;
        edges.insert(o.edge[k]), ++own;
        const auto& e = scene.mesh.edges[o.edge[k]];
        EXPECT_EQ(std::minmax(e[0], e[1]), std::minmax(o.corner[k], o.corner[(k + 1) % 3]));
      }
      if (o.face >= 0) faces.insert(o.face);
      most = std::max(most, own);
    }
    const auto all = [](std::size_t n) {
      std::vector<int> each(n);
      std::iota(each.begin(), each.end(), 0);
      return std::multiset<int>(each.begin(), each.end());
    };
    EXPECT_EQ(vertices, all(static_cast<std::size_t>(scene.mesh.vertices))) << scene.name;
    EXPECT_EQ(edges, all(scene.mesh.edges.size())) << scene.name;
    EXPECT_EQ(faces, all(scene.mesh.faces.size())) << scene.name;
    // A closed mesh has half a vertex and one and a half edges to a face.
    if (scene.name.find("balls") != std::string::npos) {
      EXPECT_LE(most, 3) << scene.name;
    }
  }
}

}  // namespace
}  // namespace gambeson::gpu
