#include "cases/cell/paths.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

TEST(CellPaths, ThereAndBack) {
  PathCase path{"p", BiaxialPath{0.1}, 2, 0};
  EXPECT_EQ(partsOf(path), (std::vector<double>{0, 0.5, 1}));
  path.cycles = 2;
  EXPECT_EQ(partsOf(path), (std::vector<double>{0, 0.5, 1, 0.5, 0, 0.5, 1, 0.5, 0}));
}

/// E = (Phi^T Phi - 1)/2, Man 2006, eq. 4.59.
TEST(CellPaths, LoadsAreWhatTheySay) {
  const CellLoad both = targetOf(BiaxialPath{0.2, 0.5}, 0.5).load;
  EXPECT_DOUBLE_EQ(both.e11, 0.5 * (1.1 * 1.1 - 1));
  EXPECT_DOUBLE_EQ(both.e22, 0.5 * (1.05 * 1.05 - 1));
  const CellLoad shear = targetOf(ShearPath{0.2, 0.01}, 1).load;
  EXPECT_DOUBLE_EQ(shear.e11, 0.5 * (1.01 * 1.01 + 0.04 - 1));
  EXPECT_DOUBLE_EQ(shear.g12, 2 * 1.01 * 0.2);
  const CellLoad turned = targetOf(TrellisPath{0.3, 0.02}, 1).load;
  EXPECT_DOUBLE_EQ(turned.e22, 0.5 * (1.02 * 1.02 - 1));
  EXPECT_NEAR(turned.g12, 1.02 * 1.02 * std::sin(0.3), 1e-15);
  EXPECT_EQ(targetOf(BendingPath{40, 0.7}, 0.25).load.curvature_per_m, 10);
  EXPECT_EQ(targetOf(BendingPath{40, 0.7}, 0).load.direction_rad, 0.7);
  EXPECT_LT(targetOf(CompressionPath{0.05}, 1).load.e22, 0);
  EXPECT_FALSE(targetOf(UniaxialPath{0.1}, 1).free);
  const CellTarget warp = targetOf(UniaxialPath{0.1, along_warp, true}, 1);
  EXPECT_EQ(warp.free, along_weft);
  EXPECT_NEAR(warp.load.e22, 0.105, 1e-15);
}

}  // namespace
}  // namespace gambeson
