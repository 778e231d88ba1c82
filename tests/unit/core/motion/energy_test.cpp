/// Energy over many steps: constant in free vibration, and changed by the works of contact and drag alone.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(Energy, OfAFreeVibrationStays) {
  Motion m = vibration();
  const double first = m.energy().total();
  double most = 0;
  for (int s = 0; s < 4000; ++s) {
    ASSERT_EQ(m.step(1e-4).failure, StepFailure::none);
    most = std::max(most, std::abs(m.energy().total() / first - 1));
  }
  std::printf("[ measured ] energy within %.3g %% over 4000 steps\n", 100 * most);
  EXPECT_LT(most, 0.01);
}

/// KE + internal + gravity changes by the works of contact and drag. A sheet lands on a ball; a rising ball kicks it
/// up.
TEST(Energy, ChangesByTheWorks) {
  for (double up : {0.0, 2.0}) {
    ContactParameters c{1e-3, 0.3, 0.01, 1e-2, 400};
    Motion m(squareSheet(10, 0.2, 0.121), {{0, 0, -9.81}, 0.288}, c, {}, {{Ellipsoid{{0.1, 0.1, 0.1}}, "ball"}},
             {{{}, {0.1, 0.1, 0}, 1}}, {{0, 0, up}});
    const double first = m.energy().total();
    double contact = 0, drag = 0, separation = 0;
    for (int s = 0; s < 3000; ++s) {
      const StepReport r = m.step(1e-4);
      ASSERT_EQ(r.failure, StepFailure::none) << r.why;
      contact += r.work.contact;
      drag += r.work.drag;
      separation += r.work.separation;
    }
    const double change = m.energy().total() - first;
    std::printf(
        "[ measured ] ball at %g m/s: energy %+.5g J, contact %+.5g J (separation %.2g J), drag %+.5g J, rest %.3g "
        "%%\n",
        up, change, contact, separation, drag, 100 * (change - contact - drag) / std::abs(change));
    EXPECT_NEAR(change, contact + drag, 0.01 * std::abs(change));
    EXPECT_LT(drag, 0);
    EXPECT_GT(std::abs(contact), 1e-4);
    EXPECT_EQ(contact > 0, up > 0);
  }
}

}  // namespace
}  // namespace gambeson
