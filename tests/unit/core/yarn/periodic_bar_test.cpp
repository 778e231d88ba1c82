#include "core/yarn/periodic_bar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.hpp"

namespace gambeson {
namespace {

TEST(PeriodicBar, StiffnessIsTheHarmonicMean) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> in(0, 1);
  for (const std::size_t n : {1u, 2u, 3u, 40u}) {
    PeriodicBar bar;
    double length = 0, compliance = 0;
    for (std::size_t i = 0; i < n; ++i) {
      bar.length.push_back(0.1 + in(random));
      bar.young_Pa.push_back(std::pow(10, 6 + 4 * in(random)));
      length += bar.length[i];
      compliance += bar.length[i] / bar.young_Pa[i];
    }
    const HomogenisedBar out = homogenise(bar);
    EXPECT_NEAR(out.young_Pa, length / compliance, 1e-12 * out.young_Pa) << n;
    // The stress is the same everywhere, eq. 4.29.
    for (std::size_t i = 0; i < n; ++i) {
      const double slope = (out.characteristic[i + 1] - out.characteristic[i]) / bar.length[i];
      EXPECT_NEAR(bar.young_Pa[i] * (1 + slope), out.young_Pa, 1e-10 * bar.young_Pa[i]);
    }
  }
}

TEST(PeriodicBar, NumbersOutOfRangeAreRefused) {
  EXPECT_THROW(homogenise({}), InputError);
  EXPECT_THROW(homogenise({{1, 2}, {1}}), InputError);
  EXPECT_THROW(homogenise({{1, 0}, {1, 1}}), InputError);
  EXPECT_THROW(homogenise({{1, 1}, {1, -1}}), InputError);
  EXPECT_THROW(homogenise({{1, std::nan("")}, {1, 1}}), InputError);
}

}  // namespace
}  // namespace gambeson
