// Strips that are pulled and that droop, against closed forms.
#include "cases/fabric/strips.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/cloth/card.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/curve_energy.hpp"

namespace gambeson {
namespace {

constexpr double kBias = 0.78539816339744831;

/// Thickness 0.5 mm, 300 g/m^2.
Fabric plain(double weft_N_per_m, double warp_N_per_m, double shear_N_per_m, double poisson, double rigidity_Nm) {
  Fabric f;
  f.thickness_m = 5e-4;
  f.density_kg_per_m3 = 600;
  f.young_weft_Pa = weft_N_per_m / f.thickness_m;
  f.young_warp_Pa = warp_N_per_m / f.thickness_m;
  f.shear_Pa = shear_N_per_m / f.thickness_m;
  f.poisson = poisson;
  f.law = LinearBending{{rigidity_Nm, rigidity_Nm, 0.5 * rigidity_Nm}};
  return f;
}

const std::vector<TensilePoint> points{{0.01, 10}, {0.02, 25}, {0.035, 70}, {0.05, 200}, {0.06, 490}};

Fabric curved() {
  return withEnergy(plain(1, 1, 1, 0, 1e-5),
                    std::make_shared<const CurveEnergy>(CurveLaw{{points, {{0.1, 300}}}, 80, {2e-5, 3e-5, 1e-5}}));
}

// The patch test of a law of curves: a strip has the curve's force at every strain, with a degree and cells of any
// kind.
TEST(Strips, ACurveIsPulledAsItWasMeasured) {
  const TensionCurve curve(points);
  for (const int degree : {2, 3}) {
    laboratory::Specimen specimen;
    specimen.cells = 6;
    specimen.degree = degree;
    for (const bool free_sides : {false, true}) {
      const laboratory::Course course{{0.06}, 0.002, {}};
      const laboratory::Loop loop =
          free_sides ? laboratory::pullFree(curved(), specimen, course) : laboratory::pull(curved(), specimen, course);
      ASSERT_GE(loop.size(), 31u);
      for (const laboratory::LoopPoint& p : loop) EXPECT_NEAR(p.load, curve.force(p.at), 1e-6 * curve.force(p.at));
    }
    specimen.direction_rad = 2 * kBias;
    EXPECT_NEAR(laboratory::pull(curved(), specimen, {{0.1}, 0.05, {}}).back().load, 300, 3e-4);
  }
}

// Small strains: 1/E45 = (1/E1 + 1/E2 - 2 nu/E1 + 1/G)/4, less what clamps that stay parallel take.
TEST(Strips, TheBiasGivesShear) {
  laboratory::Specimen specimen;
  specimen.cells = 8;
  specimen.direction_rad = kBias;
  const double E = 4000, G = 40, nu = 0.1, e = 1e-4;
  const double bias = 4 / (2 / E - 2 * nu / E + 1 / G);  // of equal threads no shear is taken
  EXPECT_NEAR(laboratory::pullFree(plain(E, E, G, nu, 1e-5), specimen, {{e}, e, {}}).back().load, bias * e,
              1e-3 * bias * e);
}

// W g L^3/B = 8.004 of the elastica whose chord slopes by 41.5 degrees (integrated by Runge-Kutta's method): half of
// the overhang is (B/(W g))^(1/3) within 0.02 %.
TEST(Strips, TheCantileverHasPeircesLength) {
  laboratory::Specimen specimen;
  specimen.cells = 32;  // 16 lock a little in the membrane: 0.6 % of so slender a strip
  for (const double rigidity : {2e-6, 1e-4}) {
    const double c = std::cbrt(rigidity / (0.3 * 9.80665));
    const laboratory::Droop droop =
        laboratory::droop(plain(2e4, 2e4, 100, 0, rigidity), specimen, 0.7 * c);  // sought from elsewhere
    EXPECT_NEAR(droop.length_m, c, 1e-3 * c) << rigidity;
    const Vec3 end = droop.shape.back();
    EXPECT_NEAR(std::atan2(-end.z, end.x), laboratory::kDroop_rad, 1e-5);
  }
}

}  // namespace
}  // namespace gambeson
