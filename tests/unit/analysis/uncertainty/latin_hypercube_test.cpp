/// Samples of several factors.

#include "analysis/uncertainty/latin_hypercube.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace gambeson {
namespace {

double probabilityOf(double score) { return 0.5 * std::erfc(-score / std::sqrt(2.0)); }

/// What makes it a Latin hypercube: of each factor every stratum is met once.
TEST(LatinHypercube, MeetsEveryStratumOfEveryFactorOnce) {
  const int runs = 12, factors = 4;
  const auto z = latinHypercube(runs, factors, 7);
  ASSERT_EQ(z.size(), 12u);
  for (int f = 0; f < factors; ++f) {
    std::set<int> strata;
    for (const auto& row : z) strata.insert(static_cast<int>(runs * probabilityOf(row[static_cast<std::size_t>(f)])));
    EXPECT_EQ(strata.size(), 12u) << f;
    EXPECT_EQ(*strata.begin(), 0);
    EXPECT_EQ(*strata.rbegin(), 11);
  }
}

/// A dozen runs of four factors hardly correlate: any two columns by chance have a correlation of some 0.3.
TEST(LatinHypercube, TellsFactorsApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto z = latinHypercube(12, 4, seed);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) {
        double ab = 0, aa = 0, bb = 0, ma = 0, mb = 0;
        for (const auto& row : z) ma += row[a] / 12, mb += row[b] / 12;
        for (const auto& row : z)
          ab += (row[a] - ma) * (row[b] - mb), aa += (row[a] - ma) * (row[a] - ma), bb += (row[b] - mb) * (row[b] - mb);
        EXPECT_LT(std::abs(ab / std::sqrt(aa * bb)), 0.2) << seed;
      }
  }
}

/// The generator and what is made of its draws are specified: these scores are the same everywhere.
TEST(LatinHypercube, TheSeedDecides) {
  EXPECT_EQ(latinHypercube(12, 3, 5), latinHypercube(12, 3, 5));
  EXPECT_NE(latinHypercube(12, 3, 5), latinHypercube(12, 3, 6));
}

/// exp(s z) with s^2 = ln(1 + c^2) has the deviation c of its mean (Johnson, Kotz and Balakrishnan, Continuous
/// univariate distributions, vol. 1, 1994, eq. 14.8); its median is 1.
TEST(LatinHypercube, MultiplesHaveTheSpreadThatIsGiven) {
  double sum = 0, squares = 0;
  const int n = 20000;
  for (const auto& row : latinHypercube(n, 1, 3)) {
    const double m = multipleOf(0.3, row[0]);
    sum += m;
    squares += m * m;
  }
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  EXPECT_NEAR(deviation / mean, 0.3, 0.003);
  EXPECT_EQ(multipleOf(0.3, 0), 1);
  EXPECT_EQ(multipleOf(0, 1.7), 1);
}

}  // namespace
}  // namespace gambeson
