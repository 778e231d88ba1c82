#include "core/math/least_squares.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

// A straight line has the textbook's slope, intercept and errors: x = 1..4, y = 6, 5, 7, 10 has 3.5 + 1.4 x and
// s^2 = 4.2/2.
TEST(LeastSquares, FitsALineAsTheTextbookDoes) {
  const std::vector<double> y{6, 5, 7, 10};
  const LeastSquares fit = leastSquares(
      [&](std::span<const double> x, std::span<double> r) {
        for (std::size_t i = 0; i < 4; ++i) r[i] = x[0] + x[1] * (1 + static_cast<double>(i)) - y[i];
      },
      4, {1, 1});
  EXPECT_NEAR(fit.value[0], 3.5, 1e-8);
  EXPECT_NEAR(fit.value[1], 1.4, 1e-8);
  EXPECT_NEAR(fit.error[1], std::sqrt(2.1 / 5), 1e-7);
  EXPECT_NEAR(fit.error[0], std::sqrt(2.1 * (1 / 4. + 2.5 * 2.5 / 5)), 1e-7);
  EXPECT_NEAR(fit.rms, std::sqrt(4.2 / 4), 1e-8);
}

// Of numbers that differ by ten orders of magnitude.
TEST(LeastSquares, FindsWhatIsNotLinear) {
  const double a = 3e-6, b = 4e4;
  const LeastSquares fit = leastSquares(
      [&](std::span<const double> x, std::span<double> r) {
        for (std::size_t i = 0; i < r.size(); ++i) {
          const double t = 1e-5 * static_cast<double>(i);
          r[i] = x[0] * std::expm1(x[1] * t) - a * std::expm1(b * t);
        }
      },
      12, {1e-6, 1e4});
  EXPECT_NEAR(fit.value[0], a, 1e-9 * a);
  EXPECT_NEAR(fit.value[1], b, 1e-9 * b);
}

TEST(LeastSquares, RefusesWhatDeterminesNothing) {
  const auto flat = [](std::span<const double> x, std::span<double> r) {
    for (double& v : r) v = x[0] + x[1] - 1;
  };
  EXPECT_THROW(leastSquares(flat, 2, {1, 1}), InputError);
  EXPECT_THROW(leastSquares(flat, 5, {1, 1}), InputError);
  EXPECT_THROW(leastSquares([](std::span<const double>, std::span<double> r) { r[0] = std::nan(""); }, 5, {1.}),
               InputError);
}

}  // namespace
}  // namespace gambeson
