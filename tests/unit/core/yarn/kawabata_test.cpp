#include "core/yarn/kawabata.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

KawabataCloth cloth() {
  KawabataCloth c;
  c.yarn = {KawabataYarn{0.5e-3, 0.12e-3, 12, 2000, 0.1e-3}, KawabataYarn{0.6e-3, 0.08e-3, 20, 1700, 0.12e-3}};
  c.compression = {0.4, 3};
  return c;
}

/// Energy of one crossing: both yarns and what is pressed together.
double energyOf(const KawabataCloth& c, const KawabataState& s) {
  double energy = 0;
  for (int d = 0; d < 2; ++d) {
    const KawabataYarn& y = c.yarn[d];
    const double e = std::max(0.0, s.yarn_stretch[d] - 1);
    energy += 0.5 * y.stretch_N * e * e * std::hypot(2 * y.crimp_height_m, y.spacing_m);
  }
  const double touch = c.yarn[0].half_thickness_m + c.yarn[1].half_thickness_m;
  const double approach = s.deflection_m[0] - s.deflection_m[1];
  const Quadrature rule = gaussLegendre(16);
  for (std::size_t q = 0; q < rule.points.size(); ++q)
    energy += rule.weights[q] * approach * c.compression.force_N(touch - rule.points[q] * approach, touch);
  return energy;
}

TEST(Kawabata, CrossingsAreInEquilibrium) {
  const KawabataCloth c = cloth();
  for (const auto& stretch : {std::array{1.05, 1.02}, {1.1, 1.0}, {1.0, 1.2}, {0.98, 1.15}}) {
    const KawabataState s = kawabataState(c, stretch);
    EXPECT_GT(s.contact_N, 0);
    const double touch = 0.22e-3;
    EXPECT_NEAR(s.deflection_m[1], s.deflection_m[0] - c.compression.approach_m(s.contact_N, touch), 1e-18) << "4.7";
    const double sign[2] = {-1, 1};
    for (int d = 0; d < 2; ++d) {
      const KawabataYarn& y = c.yarn[d];
      const double height = y.crimp_height_m + sign[d] * s.deflection_m[d];
      const double length = std::hypot(2 * height, stretch[d] * y.spacing_m);
      EXPECT_NEAR(s.yarn_stretch[d], length / std::hypot(2 * y.crimp_height_m, y.spacing_m), 1e-15) << "4.1";
      EXPECT_NEAR(2 * s.yarn_tension_N[d] * 2 * height / length, s.contact_N, 1e-9 * s.contact_N) << "4.4";
      EXPECT_NEAR(s.force_N_per_m[d], y.yarns_per_m * s.yarn_tension_N[d] * stretch[d] * y.spacing_m / length,
                  1e-9 * s.force_N_per_m[d])
          << "4.9";
      const double h = 1e-6;
      std::array<double, 2> less = stretch, more = stretch;
      less[d] -= h, more[d] += h;
      const double slope = (energyOf(c, kawabataState(c, more)) - energyOf(c, kawabataState(c, less))) / (2 * h);
      EXPECT_NEAR(slope, y.spacing_m * s.force_N_per_m[d] / y.yarns_per_m, 1e-6 * slope) << "work";
    }
  }
}

/// Alike yarns, alike stretched: each gives half of what is pressed together; incompressible ones keep their crimp.
TEST(Kawabata, BalancedClothHasAClosedForm) {
  KawabataCloth c = cloth();
  c.yarn[1] = c.yarn[0];
  const KawabataState soft = kawabataState(c, {1.04, 1.04});
  EXPECT_NEAR(soft.deflection_m[0], -soft.deflection_m[1], 1e-15 * 0.1);
  c.compression.half_force_N = 1e12;
  const KawabataState hard = kawabataState(c, {1.04, 1.04});
  const KawabataYarn& y = c.yarn[0];
  const double length = std::hypot(2 * y.crimp_height_m, 1.04 * y.spacing_m);
  const double tension = y.stretch_N * (length / std::hypot(2 * y.crimp_height_m, y.spacing_m) - 1);
  EXPECT_NEAR(hard.force_N_per_m[0], y.yarns_per_m * tension * 1.04 * y.spacing_m / length,
              1e-3 * hard.force_N_per_m[0]);
  EXPECT_LT(soft.force_N_per_m[0], hard.force_N_per_m[0]);
}

TEST(Kawabata, SlackYarnsCarryNothing) {
  for (const auto& stretch : {std::array{1.0, 1.0}, {0.9, 0.95}, {1.0, 0.8}}) {
    const KawabataState s = kawabataState(cloth(), stretch);
    EXPECT_EQ(s.contact_N, 0);
    EXPECT_EQ(s.force_N_per_m[0], 0);
    EXPECT_EQ(s.force_N_per_m[1], 0);
  }
  // One way, the other slack: crimp goes over to it until it is straight.
  const KawabataState one = kawabataState(cloth(), {1.02, 0.9});
  EXPECT_GT(one.deflection_m[0], 0);
  EXPECT_EQ(one.force_N_per_m[1], 0);
}

TEST(Kawabata, NumbersOutOfRangeAreRefused) {
  EXPECT_NO_THROW(checkKawabata(cloth()));
  const auto refused = [](const std::string& key, auto change) {
    KawabataCloth c = cloth();
    change(c);
    try {
      checkKawabata(c);
      ADD_FAILURE() << key;
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
    }
  };
  refused("weft.spacing", [](KawabataCloth& c) { c.yarn[0].spacing_m = 0; });
  refused("warp.crimp_height", [](KawabataCloth& c) { c.yarn[1].crimp_height_m = -1; });
  refused("warp.stretch", [](KawabataCloth& c) { c.yarn[1].stretch_N = std::nan(""); });
  refused("weft.yarns", [](KawabataCloth& c) { c.yarn[0].yarns_per_m = 0; });
  refused("weft.half_thickness", [](KawabataCloth& c) { c.yarn[0].half_thickness_m = 0; });
  refused("compression.exponent", [](KawabataCloth& c) { c.compression.exponent = 1; });
  EXPECT_THROW(kawabataState(cloth(), {0, 1}), InputError);
  EXPECT_THROW(kawabataState(cloth(), {1, std::nan("")}), InputError);
}

}  // namespace
}  // namespace gambeson
