/// Loops in lengths.

#include "core/cloth/draft/trim_loops.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>

#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

double areaLeft(const NurbsPatch& patch, const TrimLoop& loop) {
  Garment g = garmentOf({patch}, {}, plainFabric());
  g.trims = {{{loop}, 12}};
  double area = 0;
  for (double a : controlAreas(g)) area += a;
  return area;
}

TEST(TrimLoops, AreasInSquareMetres) {
  const NurbsPatch patch = flatPatch(uniformKnots(2, 6), knotsAt(3, {2, 2.5, 4, 5}), 0.6, 0.5);
  EXPECT_NEAR(areaLeft(patch, circleLoop(patch, {0.3, 0.8}, 0.2, Keep::outside)), 0.9 - kPi * 0.04, 1e-9);
  EXPECT_NEAR(areaLeft(patch, circleLoop(patch, {0.3, 0.8}, 0.2, Keep::inside)), kPi * 0.04, 1e-9);
  std::vector<Vec2> square{{0.1, 0.2}, {0.5, 0.2}, {0.5, 1}, {0.1, 1}};
  for (int way = 0; way < 2; ++way) {
    EXPECT_NEAR(areaLeft(patch, polygonLoop(patch, square, Keep::outside)), 0.9 - 0.32, 1e-12);
    EXPECT_NEAR(areaLeft(patch, polygonLoop(patch, square, Keep::inside)), 0.32, 1e-12);
    std::vector<Vec2> small = square;
    for (Vec2& p : small) p = {0.3 + 0.5 * (p.x - 0.3), p.y};
    const double in = areaLeft(patch, splineLoop(patch, small, Keep::inside)),
                 out = areaLeft(patch, splineLoop(patch, small, Keep::outside));
    EXPECT_NEAR(in + out, 0.9, 1e-9);
    EXPECT_GT(in, 0.16);  // bulges beyond the polygon
    std::reverse(square.begin(), square.end());
  }
}

TEST(TrimLoops, RefuseWhatIsNoEvenRectangle) {
  EXPECT_THROW(circleLoop(curvedPatch(2, 2, false), {0.3, 0.3}, 0.1, Keep::outside), InputError);
  EXPECT_THROW(circleLoop(flatPatch(uniformKnots(2, 4), uniformKnots(2, 4), 1, 1, 0.2), {0.3, 0.3}, 0.1, Keep::outside),
               InputError);
  EXPECT_THROW(circleLoop(unitPatch(2, 4), {0.3, 0.3}, -0.1, Keep::outside), InputError);
  EXPECT_THROW(circleLoop(unitPatch(2, 4), {0.3, 0.3}, std::nan(""), Keep::outside), InputError);
}

}  // namespace
}  // namespace gambeson
