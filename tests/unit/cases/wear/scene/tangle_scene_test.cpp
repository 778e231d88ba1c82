/// Scenes that start tangled come free within 0.3 s of simulated time (cases/library/tangle_*.json, nested_tubes.json):
/// pairs of triangles that pass through each other, counted apart from the detection that frees them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "cases/structure/self_crossings.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

struct Freed {
  long at_start = 0, at_end = 0;
  double free_s = -1;     ///< the first look (every 10 ms) from which on nothing crosses
  double added_J = 0;     ///< by restoring
  double farthest_m = 0;  ///< way of a sample in one step
  std::vector<Vec3> x;    ///< samples at the end
};

Freed freed(SceneRun& scene, double end_s) {
  const Model& m = scene.model;
  Freed f;
  const auto crossings = [&] {
    f.x.resize(m.surface.size());
    m.surface.WT.multiply<Vec3>(scene.state.p, f.x);
    return selfCrossings(f.x, m.surface.triangles);
  };
  f.at_start = f.at_end = crossings();
  const auto watch = [&](const State& before, const State& after, const StepReport& r, const StepResult&,
                         const Frequency&) {
    f.added_J += r.work.restoring;
    std::vector<Vec3> way(before.p.size()), moved(m.surface.size());
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = after.p[i] - before.p[i];
    m.surface.WT.multiply<Vec3>(way, moved);
    for (const Vec3& d : moved) f.farthest_m = std::max(f.farthest_m, norm(d));
  };
  for (int k = 1; k <= std::lround(end_s / 0.01); ++k) {
    scene.run(0.01 * k, watch);
    f.at_end = crossings();
    if (f.at_end > 0) f.free_s = -1;
    if (f.at_end == 0 && f.free_s < 0) f.free_s = 0.01 * k;
  }
  std::printf("[ measured ] %ld crossing pairs at the start, %ld at the end; free at %.2f s, %.3g mJ added\n",
              f.at_start, f.at_end, f.free_s, 1e3 * f.added_J);
  return f;
}

class TangledSheets : public testing::TestWithParam<const char*> {};

TEST_P(TangledSheets, ComeFreeAndStayFree) {
  SceneRun scene(libraryCase(GetParam()));
  const Freed f = freed(scene, 0.3);
  EXPECT_GT(f.at_start, 0);
  EXPECT_EQ(f.at_end, 0);
  EXPECT_GT(f.free_s, 0);
  EXPECT_LT(f.farthest_m, 0.5 * 0.3 / 18);  // half a cell
}
INSTANTIATE_TEST_SUITE_P(Library, TangledSheets, testing::Values("tangle_open", "tangle_half", "tangle_closed"));

/// At the neck dC/dd = 0: by length the sleeve stays, by area it leaves (Zheng 2013, fig. 4.5 and 4.6).
TEST(TangledSleeve, ComesFreeByAreaAndNotByLength) {
  SceneRun by_area(libraryCase("tangle_sleeve"));
  const Freed area = freed(by_area, 0.3);
  EXPECT_GT(area.at_start, 0);
  EXPECT_EQ(area.at_end, 0);
  SceneRun by_length(libraryCase("tangle_sleeve"));
  by_length.scenario->model->collisions.untangling.by = UntangleBy::kLength;
  EXPECT_GT(freed(by_length, 0.3).at_end, 0);
}

/// In the order of the garments: each tube's samples lie outside of the one below.
TEST(TangledTubes, ComeFreeInTheOrderOfTheGarments) {
  SceneRun scene(libraryCase("nested_tubes"));
  const Freed f = freed(scene, 0.2);
  EXPECT_GT(f.at_start, 0);
  EXPECT_EQ(f.at_end, 0);
  EXPECT_LT(f.farthest_m, 0.5 * 0.02);
  const Model& m = scene.model;
  for (int tube : {0, 1}) {
    // Rings of samples, v by v: the tube below as a polygon about its middle.
    const auto [nu, nv] = m.surface.patch_grid_size[static_cast<std::size_t>(tube)];
    const std::vector<int>& grid = m.surface.patch_grid[static_cast<std::size_t>(tube)];
    int outside = 0, all = 0;
    for (int s = 0; s < m.surface.size(); ++s) {
      if (m.surface.patch[s] != tube + 1) continue;
      int ring = 0;
      double least = 1e9;
      for (int j = 0; j < nv; ++j) {
        Vec3 middle{};
        for (int i = 0; i + 1 < nu; ++i) middle += f.x[grid[i + nu * j]] / (nu - 1);
        if (std::abs(middle.z - f.x[s].z) < least) least = std::abs(middle.z - f.x[s].z), ring = j;
      }
      double turn = 0;  // about the sample: 2 pi where it is inside
      for (int i = 0; i + 1 < nu; ++i) {
        const Vec3 a = f.x[grid[i + nu * ring]] - f.x[s], b = f.x[grid[i + 1 + nu * ring]] - f.x[s];
        turn += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
      }
      ++all;
      outside += std::abs(turn) < 1;
    }
    EXPECT_EQ(outside, all) << "tube " << tube + 1;
  }
}

}  // namespace
}  // namespace gambeson
