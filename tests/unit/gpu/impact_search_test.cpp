/// The search for impacts on the reference device: against each pair asked of core, for any width of a group, with too
/// little room, and on what a GPU found (gpu/manifest.json).
#include "gpu/finding/impact_search.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "gpu/device/reference.hpp"
#include "gpu/finding/hash.hpp"
#include "gpu/finding/impact_finder.hpp"
#include "scenes.hpp"

namespace gambeson::gpu {
namespace {

const BothSizes kAmple{ListSizes{1 << 16, 1 << 14, 1 << 14, 1 << 14}, ListSizes{1 << 17, 1 << 14, 1 << 14, 1 << 14}};

TEST(ImpactSearch, FindsWhatEachPairAskedOfCoreSays) {
  std::size_t hits[kPairKinds] = {};
  for (const Scene& scene : smallScenes()) {
    const auto search = searchOnReference(scene.mesh, scene.x0, scene.options, kAmple);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::rebuilt);
    for (int k = 0; k < kPairKinds; ++k) {
      const PairKind kind{k};
      std::vector<Pair> pairs = search->pairs(kind);
      std::ranges::sort(pairs);
      const std::vector<Pair> truth = pairsByBruteForce(scene, kind);
      EXPECT_EQ(pairs, truth) << scene.name << ", kind " << k;
      EXPECT_EQ(search->hits(kind), hitsByCore(scene, kind, truth)) << scene.name << ", kind " << k;
      hits[k] += search->hits(kind).size();
    }
  }
  EXPECT_GT(hits[0], 100u);
  EXPECT_GT(hits[1], 300u);
}

TEST(ImpactSearch, BodiesDoNotMeetEachOther) {
  for (Scene scene : {fallingSheets(12), wavySheets(3, 9), flyingBalls(3)}) {
    const auto all = searchOnReference(scene.mesh, scene.x0, scene.options, kAmple);
    all->setMotion(scene.x0, scene.x1);
    all->find(Trees::rebuilt);
    // The last third is bodies: whole sheets or balls, but for the two sheets, of which one is.
    const int parts = scene.mesh.vertices % 3 == 0 && scene.name.find("2 sheets") == std::string::npos ? 3 : 2;
    scene.mesh.bodies_from = scene.mesh.vertices / parts * (parts - 1);
    const auto some = searchOnReference(scene.mesh, scene.x0, scene.options, kAmple);
    some->setMotion(scene.x0, scene.x1);
    some->find(Trees::rebuilt);
    some->find(Trees::refitted);
    std::size_t left_out = 0;
    for (int k = 0; k < kPairKinds; ++k) {
      const PairKind kind{k};
      const auto ofBodies = [&](const Pair& p) {
        const int first = kind == PairKind::pointTriangle ? p.first : scene.mesh.edges[p.first][0];
        const int second =
            kind == PairKind::pointTriangle ? scene.mesh.faces[p.second][0] : scene.mesh.edges[p.second][0];
        return first >= scene.mesh.bodies_from && second >= scene.mesh.bodies_from;
      };
      std::vector<Pair> truth = all->pairs(kind), got = some->pairs(kind);
      left_out += std::erase_if(truth, ofBodies);
      std::ranges::sort(truth);
      std::ranges::sort(got);
      EXPECT_EQ(got, truth) << scene.name << ", kind " << k;
      std::vector<Hit> hits = all->hits(kind);
      std::erase_if(hits, [&](const Hit& h) { return ofBodies(h.pair); });
      EXPECT_EQ(some->hits(kind), hits) << scene.name << ", kind " << k;
    }
    EXPECT_GT(left_out, 100u) << scene.name;
  }
}

TEST(ImpactSearch, TreesOfAnotherStepFindTheSame) {
  for (const Scene& scene : smallScenes()) {
    const auto search = searchOnReference(scene.mesh, scene.x0, scene.options, kAmple);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::rebuilt);
    const Facts facts = factsOf(*search);
    // Trees made where all has moved about, then only fitted.
    std::vector<Vec3> elsewhere = scene.x1;
    std::ranges::reverse(elsewhere);
    search->setMotion(elsewhere, elsewhere);
    search->find(Trees::rebuilt);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::refitted);
    EXPECT_EQ(factsOf(*search), facts) << scene.name;
  }
}

template <int W>
Facts factsWith(const Scene& scene, int queries_per_group) {
  SearchOptions options = scene.options;
  options.queries_per_group = queries_per_group;
  ImpactFinder<ReferenceOf<W>> finder(scene.mesh, scene.x0, options, kAmple);
  finder.setMotion(scene.x0, scene.x1);
  finder.find(Trees::rebuilt);
  return factsOf(finder);
}

TEST(ImpactSearch, AnyWidthOfAGroupGivesTheSameBits) {
  for (const Scene& scene : smallScenes()) {
    const Facts facts = factsWith<1>(scene, 1);
    EXPECT_EQ(factsWith<1>(scene, 16), facts) << scene.name;
    EXPECT_EQ(factsWith<5>(scene, 3), facts) << scene.name;
    EXPECT_EQ(factsWith<32>(scene, 4), facts) << scene.name;
    EXPECT_EQ(factsWith<32>(scene, 16), facts) << scene.name;
  }
}

TEST(ImpactSearch, TooLittleRoomIsRepeatedWithMore) {
  const Scene scene = triangleSoup(300, 2);
  const auto facts = [&](const BothSizes& room, int& repeats) {
    const auto search = searchOnReference(scene.mesh, scene.x0, scene.options, room);
    search->setMotion(scene.x0, scene.x1);
    search->find(Trees::rebuilt);
    repeats = search->repeats();
    return factsOf(*search);
  };
  int repeats = 0;
  const Facts truth = facts(kAmple, repeats);
  EXPECT_EQ(repeats, 0);
  for (const auto list : {&ListSizes::pairs, &ListSizes::open, &ListSizes::hard, &ListSizes::hits})
    for (int k = 0; k < kPairKinds; ++k) {
      BothSizes room = kAmple;
      ASSERT_GT(truth[k].sizes.*list, 3u);
      room[k].*list = 3;
      EXPECT_EQ(facts(room, repeats), truth);
      EXPECT_GE(repeats, 1);
    }
  EXPECT_EQ(facts({ListSizes{1, 1, 1, 1}, ListSizes{1, 1, 1, 1}}, repeats), truth);
}

/// Tasks of a group that hardly fit on its stack are taken one at a time.
TEST(ImpactSearch, AShortStackIsEnough) {
  using Device = ReferenceOf<32>;
  const Scene scene = triangleSoup(300, 2);
  FlatMesh<Device> mesh(scene.mesh, scene.x0);
  std::vector<FloatBox> boxes;
  for (std::size_t i = 0; i < scene.x0.size(); ++i) boxes.push_back(boxOf({scene.x0[i], scene.x1[i]}, 5e-4f));
  Device::Queue queue;
  Device::Buffer<FloatBox> vertex_box(boxes.size());
  queue.upload(std::span<const FloatBox>(boxes), vertex_box);
  BoxTree<Device, 2> tree(mesh.edges);
  tree.build(queue, mesh.edge, vertex_box, mesh.cube);
  tree.fit(queue, mesh.edge, vertex_box);
  const auto pairsWith = [&]<int kStack>() {
    Device::Buffer<Pair> pairs(1 << 17);
    Device::Buffer<Count> count(1);
    const EdgesInEdges queries{tree.leaf(), tree.leafBox()};
    queue.forGroups((mesh.edges + 7) / 8,
                    Traverse<EdgesInEdges, kStack>{
                        queries, mesh.edges, 8, tree.node(), tree.leaf(), {pairs.data(), count.data(), pairs.size()}});
    std::vector<Pair> found = queue.download(pairs, *count.data());
    std::ranges::sort(found);
    return found;
  };
  const std::vector<Pair> found = pairsWith.operator()<512>();
  EXPECT_GT(found.size(), 1000u);
  EXPECT_EQ(pairsWith.operator()<kTreeDepth + 9>(), found);
}

TEST(ImpactSearch, HashesDoNotDependOnOrderButOnEveryBit) {
  std::vector<Hit> hits{{{1, 2}, 0.5}, {{2, 1}, 0.25}, {{0, 7}, 0}};
  const std::uint64_t hash = hashOf(std::span<const Hit>(hits));
  std::ranges::reverse(hits);
  EXPECT_EQ(hashOf(std::span<const Hit>(hits)), hash);
  hits[1].time = std::nextafter(hits[1].time, 1);
  EXPECT_NE(hashOf(std::span<const Hit>(hits)), hash);
}

/// Counts and hashes that a GPU found; `gambeson_gpu_check --write-manifest` writes them.
TEST(ImpactSearch, FindsWhatTheManifestSaysOfAGpu) {
  std::ifstream file(std::string(GAMBESON_SOURCE_DIR) + "/gpu/manifest.json");
  const auto manifest = nlohmann::json::parse(file);
  const std::vector<Scene> scenes = manifestScenes();
  ASSERT_EQ(manifest.at("scenes").size(), scenes.size());
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const auto& kept = manifest.at("scenes")[i];
    EXPECT_EQ(kept.at("name"), scenes[i].name);
    const auto search = searchOnReference(scenes[i].mesh, scenes[i].x0, scenes[i].options, roomFor(scenes[i].mesh));
    search->setMotion(scenes[i].x0, scenes[i].x1);
    search->find(Trees::rebuilt);
    const Facts facts = factsOf(*search);
    for (int k = 0; k < kPairKinds; ++k) {
      const auto& said = kept.at(k == 0 ? "points" : "edges");
      const auto hash = [&](const char* key) { return std::stoull(said.at(key).get<std::string>(), nullptr, 16); };
      const KindFacts expected{
          {said.at("pairs"), said.at("open"), said.at("hard"), said.at("hits")}, hash("pairs_hash"), hash("hits_hash")};
      EXPECT_EQ(facts[k], expected) << scenes[i].name << "\n" << print(facts);
    }
  }
}

TEST(ImpactSearch, WithoutCudaSaysHowToGetIt) {
  if (cudaBuilt()) GTEST_SKIP() << "built with CUDA";
  try {
    cudaDevice();
    FAIL() << "a device of CUDA in a build without it";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("GAMBESON_CUDA"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace gambeson::gpu
