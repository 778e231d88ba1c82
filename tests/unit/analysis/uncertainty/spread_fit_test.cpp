/// The spread of a result from few runs, against closed forms and against many samples.

#include "analysis/uncertainty/spread_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/uncertainty/latin_hypercube.hpp"

namespace gambeson {
namespace {

using Scores = std::vector<std::vector<double>>;

/// y = 5 + 2 z1 - z2 + 0 z3 has variances 4, 1, 0, and no residual.
TEST(SpreadFit, ALinearResultIsFoundExactly) {
  const Scores z = latinHypercube(12, 3, 1);
  std::vector<double> y;
  for (const auto& row : z) y.push_back(5 + 2 * row[0] - row[1]);
  const SpreadFit fit = fitSpread(z, y);
  EXPECT_NEAR(fit.center, 5, 1e-12);
  EXPECT_NEAR(fit.slope[1], -1, 1e-12);
  EXPECT_NEAR(fit.variance[0], 4, 1e-11);
  EXPECT_NEAR(fit.variance[1], 1, 1e-11);
  EXPECT_NEAR(fit.variance[2], 0, 1e-11);
  EXPECT_NEAR(fit.residual, 0, 1e-12);
  EXPECT_NEAR(fit.deviation(), std::sqrt(5.0), 1e-11);
  EXPECT_NEAR(fit.explained, 1, 1e-12);
}

/// y = z1 + e with e of deviation 0.5 that no factor knows: over many seeds the means of the variances are those,
/// 1, 0 and 0.25; without what chance adds to squares of slopes the factor without influence would have 0.021.
TEST(SpreadFit, ScatterIsNoFactorsPart) {
  double first = 0, second = 0, residual = 0;
  const int seeds = 400;
  for (int seed = 0; seed < seeds; ++seed) {
    const Scores z = latinHypercube(12, 2, static_cast<std::uint64_t>(seed));
    const Scores e = independentScores(12, 1, static_cast<std::uint64_t>(10000 + seed));
    std::vector<double> y;
    for (std::size_t i = 0; i < z.size(); ++i) y.push_back(z[i][0] + 0.5 * e[i][0]);
    const SpreadFit fit = fitSpread(z, y);
    first += fit.variance[0] / seeds;
    second += fit.variance[1] / seeds;
    residual += fit.residual * fit.residual / seeds;
  }
  EXPECT_NEAR(first, 1, 0.03);
  EXPECT_LT(second, 0.015);
  EXPECT_NEAR(residual, 0.25, 0.02);
}

/// One value whatever the factors are: nothing spreads.
TEST(SpreadFit, AConstantDoesNotSpread) {
  const SpreadFit fit = fitSpread(latinHypercube(12, 4, 2), std::vector<double>(12, 3.5));
  EXPECT_NEAR(fit.deviation(), 0, 1e-14);
}

/// A torque as the armour has it (cases/DECISIONS.md: membrane 0.56, bending 0.28, weight 0.15), with friction as a
/// part that goes with its coefficient, each a multiple, so that it is no straight line of the scores; and a scatter
/// from run to run of 1 %.
double torqueOf(const std::vector<double>& z) {
  const double t = multipleOf(0.05, z[0]), m = multipleOf(0.10, z[1]), b = multipleOf(0.15, z[2]),
               f = multipleOf(0.20, z[3]);
  const double scatter = std::sin(1e4 * (z[0] + 2 * z[1] + 3 * z[2] + 5 * z[3]));
  return 8 * (0.56 * t * m + 0.28 * b + 0.15 * t) * (1 + 0.3 * f) * (1 + 0.014 * scatter);
}

/// Twelve runs and a line against the deviation of 200 samples: within 20 % for 18 of 20 seeds and more.
TEST(SpreadFit, ADozenRunsTellTheSpreadOfTwoHundred) {
  double sum = 0, squares = 0;
  for (const auto& z : independentScores(200, 4, 99)) {
    const double y = torqueOf(z);
    sum += y;
    squares += y * y;
  }
  const double spread = std::sqrt((squares - sum * sum / 200) / 199);
  int within = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scores z = latinHypercube(12, 4, seed);
    std::vector<double> y;
    for (const auto& row : z) y.push_back(torqueOf(row));
    within += std::abs(fitSpread(z, y).deviation() / spread - 1) < 0.2;
  }
  EXPECT_GE(within, 18);
}

}  // namespace
}  // namespace gambeson
