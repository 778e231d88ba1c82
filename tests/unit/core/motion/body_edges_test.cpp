/// A sheet over a box whose edges lie between its samples comes to rest on them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/motion/velocity_verlet.hpp"
#include "unit/core/contact/mesh_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(BodyEdges, ASheetOverABoxRestsOnItsEdges) {
  Garment g = squareSheet(8, 0.16, 0.0515);
  for (Vec3& x : g.patches[0].points) x -= Vec3{0.0787, 0.0793, 0};
  Motion m(g, {{0, 0, -9.81}, 0.8}, {1e-3, 0.3, 0.01, 1e-2, 400}, {},
           {{testing_shapes::box({0.05, 0.05, 0.05}), "box"}});
  Frequency frequency;
  long impacts = 0, edges = 0, steps = 0;
  double carried = 0, weight = 0;
  std::vector<Vec3> x, lo, hi;
  const double end = 2, watched = 0.1;
  VelocityVerlet(*m.model, m.stage, {0.7, 1e-3}, frequency, m.work)
      .advance(end, m.state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 if (after.time_s < end - watched) return;
                 impacts += r.impacts;
                 edges += static_cast<long>(m.work.edge_rows.size());
                 ++steps;
                 carried -= r.momentum.obstacles.z;
                 weight -= r.momentum.gravity.z;
                 samplePositions(*m.model, after.p, x);
                 if (lo.empty()) lo = hi = x;
                 for (std::size_t i = 0; i < x.size(); ++i) lo[i] = minimum(lo[i], x[i]), hi[i] = maximum(hi[i], x[i]);
               });
  double tremble = 0;
  for (std::size_t i = 0; i < x.size(); ++i) tremble = std::max(tremble, norm(hi[i] - lo[i]));
  std::printf("[ measured ] %.4f of the weight, samples move %.1f um in %.1f s, %ld impacts, %.1f rows on edges\n",
              std::abs(carried) / weight, 1e6 * tremble, watched, impacts,
              static_cast<double>(edges) / static_cast<double>(steps));
  EXPECT_NEAR(std::abs(carried) / weight, 1, 0.01);
  EXPECT_EQ(impacts, 0);  // some 20 a step where edges hold by impacts alone
  EXPECT_GT(edges, 10 * steps);
  EXPECT_LT(tremble, 50e-6);
}

}  // namespace
}  // namespace gambeson
