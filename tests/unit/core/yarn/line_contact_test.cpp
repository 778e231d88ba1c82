#include "core/yarn/line_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

TEST(Compression, ForceAndApproachAreOneLaw) {
  const LateralCompression law{0.2, 2.5};
  const double touch = 0.3e-3;
  EXPECT_DOUBLE_EQ(law.force_N(0.5 * touch, touch), 0.2) << "half of the thickness";
  EXPECT_EQ(law.force_N(touch, touch), 0);
  EXPECT_EQ(law.force_N(2 * touch, touch), 0);
  for (const double F : {1e-6, 0.01, 0.2, 7.0})
    EXPECT_NEAR(law.force_N(touch - law.approach_m(F, touch), touch), F, 1e-11 * F);
  EXPECT_EQ(law.approach_m(0, touch), 0);
  EXPECT_NO_THROW(checkCompression(law));
  EXPECT_THROW(checkCompression({0, 3}), InputError);
  EXPECT_THROW(checkCompression({std::nan(""), 3}), InputError);
  EXPECT_THROW(checkCompression({1, 1.9}), InputError);
  EXPECT_THROW(checkCompression({1, 6.1}), InputError);
}

TEST(LineContact, DensityHasItsDerivatives) {
  const LateralCompression law{0.2, 3.3};
  for (const double d : {0.05, 0.15, 0.25, 0.29}) {
    const double h = 1e-5;
    const LineContact a = lineContact(law, 0.3, d - h), b = lineContact(law, 0.3, d), c = lineContact(law, 0.3, d + h);
    EXPECT_NEAR((c.energy - a.energy) / (2 * h), b.first, 1e-5 * std::abs(b.first));
    EXPECT_NEAR((c.first - a.first) / (2 * h), b.second, 1e-5 * std::abs(b.second));
  }
  EXPECT_EQ(lineContact(law, 0.3, 0.3).energy, 0);
  EXPECT_EQ(lineContact(law, 0.3, 0.31).second, 0);
}

/// Two straight rods crossing under an angle phi: the force is F(d)/sin(phi).
TEST(LineContact, CrossedRodsHaveTheForceOfTheLaw) {
  const LateralCompression law{0.2, 3};
  const double touch = 0.3, step = 0.004;
  for (const double phi : {0.5 * std::numbers::pi, 1.0})
    for (const double d : {0.2, 0.25}) {
      double force = 0;
      for (int i = -120; i <= 120; ++i)
        for (int j = -120; j <= 120; ++j) {
          const double s = i * step, t = j * step;
          const double l = std::sqrt(d * d + s * s + t * t - 2 * s * t * std::cos(phi));
          force -= step * step * lineContact(law, touch, l).first * d / l;
        }
      const double exact = law.force_N(d, touch) / std::sin(phi);
      EXPECT_NEAR(force, exact, 1e-4 * exact) << phi << " " << d;
    }
}

}  // namespace
}  // namespace gambeson
