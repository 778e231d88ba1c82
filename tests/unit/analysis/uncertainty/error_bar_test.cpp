/// Error bars: parts, their sum, and what differences of two runs say.

#include "analysis/uncertainty/error_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

TEST(ErrorBar, PartsAddBySquares) {
  ErrorBar bar{3, 4, {}};
  EXPECT_NEAR(*bar.combined(), 5, 1e-15);
  EXPECT_EQ(bar.largest(), BarPart::step);
  EXPECT_NEAR(bar.share(BarPart::mesh), 0.36, 1e-15);
  EXPECT_EQ(bar.share(BarPart::fabric), 0);
  bar.fabric = 12;
  EXPECT_NEAR(*bar.combined(), 13, 1e-15);
  EXPECT_FALSE(ErrorBar{}.combined());
  EXPECT_EQ(ErrorBar{}.largest(), BarPart::none);
}

/// Where a result is exact + c h^p, the difference of two tells the error of both: with safety 1 the bar is the error.
TEST(ErrorBar, ADifferenceTellsTheErrorOfALawWithKnownOrder) {
  for (const double p : {1.0, 2.0, 3.0})
    for (const double ratio : {1.5, 2.0, 4.0}) {
      const double c = 0.7, h = 0.1, coarse = c * std::pow(h, p), fine = c * std::pow(h / ratio, p);
      EXPECT_NEAR(gridBar(coarse - fine, ratio, p, 1, About::coarse), coarse, 1e-12) << p;
      EXPECT_NEAR(gridBar(coarse - fine, ratio, p, 1, About::fine), fine, 1e-12) << p;
    }
}

/// Cells of a surface: half the size, four times the points. The bar about the coarse run holds the exact result.
TEST(ErrorBar, OfAMeshAndOfAStep) {
  EXPECT_NEAR(meshBar(0.75, 100, 400, About::coarse), 1.25 * 1, 1e-12);
  EXPECT_NEAR(meshBar(0.75, 100, 400, About::fine), 1.25 * 0.25, 1e-12);
  EXPECT_NEAR(stepBar(0.5), 1.25 * 1, 1e-12);
}

}  // namespace
}  // namespace gambeson
