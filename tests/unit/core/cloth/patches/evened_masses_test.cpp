/// Masses for cloth whose threads are limited.

#include "core/cloth/patches/evened_masses.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/cloth/draft/trim_loops.hpp"
#include "core/cloth/patches/surface.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(EvenedMasses, LeaveNoSliverAndThePatchItsMass) {
  const NurbsPatch patch = flatPatch(uniformKnots(2, 8), uniformKnots(2, 8), 1, 1);
  Garment g = garmentOf({patch}, {}, plainFabric());
  const std::vector<double> whole = controlMasses(g);
  EXPECT_EQ(evenedMasses(g, 0.25), whole);  // nothing is trimmed
  g.trims = {{{circleLoop(patch, {0.5, 0.5}, 0.42, Keep::outside)}, 12}};
  const std::vector<double> trimmed = controlMasses(g), evened = evenedMasses(g, 0.25);
  EXPECT_NEAR(sum(evened), sum(trimmed), 1e-14 * sum(trimmed));
  double least = HUGE_VAL, was = HUGE_VAL, change = 0;
  int gone = 0;
  for (std::size_t c = 0; c < whole.size(); ++c) {
    if (!(trimmed[c] > 0)) {
      EXPECT_EQ(evened[c], 0);
      ++gone;
      continue;
    }
    least = std::min(least, evened[c] / whole[c]);
    was = std::min(was, trimmed[c] / whole[c]);
    if (trimmed[c] > 0.25 * whole[c]) change = std::max(change, 1 - evened[c] / trimmed[c]);
  }
  EXPECT_GT(gone, 0);
  EXPECT_LT(was, 0.05);
  EXPECT_GT(least, 0.25 * (1 - change) * (1 - 1e-12));
  EXPECT_GT(change, 0);
  EXPECT_LT(change, 0.2);
}

}  // namespace
}  // namespace gambeson
