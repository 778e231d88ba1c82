/// The search for pairs on public frames of simulations: every pair that truly meets between two frames is found.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <ostream>

#include "core/contact/pairs.hpp"
#include "tools/collision_data.hpp"
#include "tools/data_folder.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

struct Frames {
  const char *folder, *start, *end, *number;
};

void PrintTo(const Frames& f, std::ostream* out) { *out << f.folder; }

class FramesTest : public testing::TestWithParam<Frames> {};

TEST_P(FramesTest, EveryTruePairIsOnTheList) {
  const Frames& p = GetParam();
  const fs::path folder = test::collisionFolder() / p.folder;
  if (!fs::exists(folder / p.start)) GTEST_SKIP() << "needs " << (folder / p.start).string();
  const collision::Frame start = collision::readPly(folder / p.start), end = collision::readPly(folder / p.end);
  const int vertices = static_cast<int>(start.vertices.size()), faces = static_cast<int>(start.faces.size());
  const ContactMesh mesh = contactMesh(vertices, start.faces);
  // Triangles of no grid: one a cell, none certified.
  GridChart chart;
  chart.cells = {faces, 1};
  chart.whole.assign(faces, 0);
  for (int t = 0; t < faces; ++t) {
    chart.triangles.items.push_back(t);
    chart.triangles.first.push_back(t + 1);
  }
  const std::vector<ChartCorners> corners(faces, ChartCorners{Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}});
  ContactTree tree(mesh, {chart}, corners, {}, start.vertices);
  std::vector<Vec3> velocity(vertices);
  for (int i = 0; i < vertices; ++i) velocity[i] = end.vertices[i] - start.vertices[i];
  const ListedMotion motion{start.vertices, velocity, {}, 1};
  tree.refit(mesh, motion);
  CandidatePairs found;
  PairCollector(mesh).collect(mesh, tree, motion, {2e-6, 1, true}, found);
  std::ranges::sort(found.edges);

  const std::vector<std::array<int, 2>> edges = collision::edgesOf(start);
  const auto edgeOf = [&](int id) {
    const auto at = std::ranges::lower_bound(mesh.edges, edges[id - vertices]);
    return static_cast<int>(at - mesh.edges.begin());
  };
  int true_pairs = 0;
  for (const std::string kind : {"vf", "ee"}) {
    const std::string name = p.number + kind;
    const auto pairs = collision::readPairs(folder / (name + ".json"));
    const auto truth = collision::readTruth(folder / (name + "_mma_bool.json"));
    ASSERT_EQ(pairs.size(), truth.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (!truth[k]) continue;
      ++true_pairs;
      if (kind == "vf") {
        const PointTriangle pair{pairs[k][0], pairs[k][1] - vertices - static_cast<int>(edges.size()), {}};
        EXPECT_TRUE(std::ranges::binary_search(found.points, pair)) << name << " " << k;
      } else {
        const int a = edgeOf(pairs[k][0]), b = edgeOf(pairs[k][1]);
        const EdgeEdge pair{std::min(a, b), std::max(a, b), {}};
        EXPECT_TRUE(std::ranges::binary_search(found.edges, pair)) << name << " " << k;
      }
    }
  }
  EXPECT_GT(true_pairs, 0);
  std::printf("%s: %d true pairs; on the list %zu and %zu\n", p.folder, true_pairs, found.points.size(),
              found.edges.size());
}

INSTANTIATE_TEST_SUITE_P(Public, FramesTest,
                         testing::Values(Frames{"cloth-ball", "cloth_ball92.ply", "cloth_ball93.ply", "92"},
                                         Frames{"cloth-funnel", "227.ply", "228.ply", "227"}),
                         [](const auto& set) { return set.index == 0 ? "ball" : "funnel"; });

}  // namespace
}  // namespace gambeson
