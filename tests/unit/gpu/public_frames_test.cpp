/// The search for impacts on public frames of simulations: the pairs and hits that are known of them, and every pair
/// that truly meets.
#include <gtest/gtest.h>

#include <algorithm>

#include "scenes.hpp"
#include "tools/data_folder.hpp"
#include "tools/frames_scene.hpp"

namespace gambeson::gpu {
namespace {

namespace fs = std::filesystem;

/// Counted at separation 0 and a tolerance of 1e-10 m, on a GPU too.
struct Known {
  FramesFiles files;
  std::array<std::size_t, kPairKinds> pairs, hits;
};

void testFrames(const Known& known) {
  const fs::path collision = test::collisionFolder(), folder = collision / known.files.folder;
  if (!fs::exists(folder / known.files.start)) GTEST_SKIP() << "needs " << (folder / known.files.start).string();
  const Scene scene = framesScene(collision, known.files);
  const auto search = searchOnReference(scene.mesh, scene.x0, scene.options, roomFor(scene.mesh));
  search->setMotion(scene.x0, scene.x1);
  search->find(Trees::rebuilt);
  const int vertices = scene.mesh.vertices, edges = static_cast<int>(scene.mesh.edges.size());
  for (int k = 0; k < kPairKinds; ++k) {
    const PairKind kind{k};
    const std::vector<Hit> hits = search->hits(kind);
    EXPECT_EQ(search->pairs(kind).size(), known.pairs[k]);
    EXPECT_EQ(hits.size(), known.hits[k]);
    EXPECT_TRUE(std::ranges::is_sorted(hits, {}, &Hit::pair));
    const std::string name = std::string(known.files.number) + (k == 0 ? "vf" : "ee");
    const auto pairs = collision::readPairs(folder / (name + ".json"));
    const auto truth = collision::readTruth(folder / (name + "_mma_bool.json"));
    ASSERT_EQ(pairs.size(), truth.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      if (!truth[i]) continue;
      const auto [a, b] = std::minmax(pairs[i][0], pairs[i][1]);
      const Pair pair = k == 0 ? Pair{a, b - vertices - edges} : Pair{a - vertices, b - vertices};
      EXPECT_TRUE(std::ranges::binary_search(hits, pair, {}, &Hit::pair)) << name << " " << i;
    }
  }
}

TEST(PublicFrames, ClothOnABall) { testFrames({kPublicFrames[0], {1655541, 5197332}, {19032, 94822}}); }
TEST(PublicFrames, ClothInAFunnel) { testFrames({kPublicFrames[1], {7319, 33770}, {27, 107}}); }

}  // namespace
}  // namespace gambeson::gpu
