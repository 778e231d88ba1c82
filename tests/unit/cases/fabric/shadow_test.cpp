// What a draped specimen covers: exact areas of shapes whose share is known, and their folds.
#include "cases/fabric/shadow.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace gambeson::laboratory {
namespace {

constexpr double kInner = 0.09, kOuter = 0.15;

/// A ring of cloth whose point at radius r and angle a lies at `place`.
struct DrapedRing {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;

  explicit DrapedRing(const std::function<Vec3(double r, double a)>& place, int across = 12, int around = 240) {
    for (int i = 0; i <= across; ++i)
      for (int j = 0; j < around; ++j)
        points.push_back(place(kInner + (kOuter - kInner) * i / across, 2 * std::numbers::pi * j / around));
    for (int i = 0; i < across; ++i)
      for (int j = 0; j < around; ++j) {
        const int a = i * around + j, b = i * around + (j + 1) % around;
        triangles.push_back({a, b, a + around});
        triangles.push_back({b, b + around, a + around});
      }
  }
  Shadow shadow(int rays = 1440) const { return shadowOf(points, triangles, kInner, rays); }
};

Vec3 around(double r, double a, double z) { return {r * std::cos(a), r * std::sin(a), z}; }

TEST(Shadow, ARigidDiscCoversAllAndALimpOneNothing) {
  const DrapedRing flat([](double r, double a) { return around(r, a, 0); });
  const Shadow whole = flat.shadow();
  // Chords of 1.5 degrees lie inside the circle by 1.1e-4 of the area.
  EXPECT_NEAR(whole.area_m2, std::numbers::pi * (kOuter * kOuter - kInner * kInner), 2e-4 * whole.area_m2);
  EXPECT_EQ(nodesOf(whole.reach_m, 0.003), 0);
  // Straight down from the support, where chords lie inside of it.
  const DrapedRing limp([](double r, double a) { return around(kInner, a, kInner - r); });
  EXPECT_NEAR(limp.shadow().area_m2, 0, 1e-16);
  EXPECT_EQ(nodesOf(limp.shadow().reach_m, 0.003), 0);
  // Inwards, below the support.
  const DrapedRing under([](double r, double a) { return around(2 * kInner - r, a, -0.01); });
  EXPECT_NEAR(under.shadow().area_m2, 0, 1e-16);
}

// A cone that slopes by 60 degrees: the ring is half as wide seen from above.
TEST(Shadow, AConeCoversItsProjection) {
  const DrapedRing flat([](double r, double a) { return around(r, a, 0); });
  const DrapedRing cone(
      [](double r, double a) { return around(kInner + 0.5 * (r - kInner), a, -std::sqrt(0.75) * (r - kInner)); });
  const double middle = 0.5 * (kInner + kOuter);
  EXPECT_NEAR(cone.shadow().area_m2 / flat.shadow().area_m2,
              (middle * middle - kInner * kInner) / (kOuter * kOuter - kInner * kInner), 1e-4);
}

TEST(Shadow, ClothOverClothCountsOnce) {
  const DrapedRing flat([](double r, double a) { return around(r, a, 0); });
  // Folded back on itself at two thirds: the last third lies over the second.
  const double fold = kInner + (kOuter - kInner) * 2 / 3;
  const DrapedRing back(
      [&](double r, double a) { return around(r < fold ? r : 2 * fold - r, a, r < fold ? 0 : 0.001); });
  EXPECT_NEAR(back.shadow().area_m2 / flat.shadow().area_m2,
              (fold * fold - kInner * kInner) / (kOuter * kOuter - kInner * kInner), 1e-4);
  EXPECT_NEAR(back.shadow().reach_m[7], fold, 1e-4);
}

TEST(Shadow, FoldsAreCountedAboveWhatIsNoise) {
  for (const int folds : {3, 7, 12}) {
    const DrapedRing wavy([&](double r, double a) {
      const double depth = (r - kInner) / (kOuter - kInner);
      return around(r - depth * (0.02 + 0.01 * std::cos(folds * a) + 0.0005 * std::cos(40 * a)), a, -0.02 * depth);
    });
    EXPECT_EQ(nodesOf(wavy.shadow().reach_m, 0.003), folds);
  }
}

}  // namespace
}  // namespace gambeson::laboratory
