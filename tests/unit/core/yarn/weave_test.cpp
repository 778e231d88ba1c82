#include "core/yarn/weave.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/yarn/woven_yarns.hpp"

namespace gambeson {
namespace {

void expectRefused(const std::function<void()>& make, const std::string& key, const std::string& says) {
  try {
    make();
    ADD_FAILURE() << key << " was not refused";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key);
    EXPECT_NE(e.reason().find(says), std::string::npos) << e.reason();
  }
}

TEST(Weave, RepeatsAreThoseOfTheTextbooks) {
  EXPECT_EQ(plainWeave().warp_over, (std::vector<char>{1, 0, 0, 1}));
  EXPECT_EQ(twillWeave(1, 1).warp_over, plainWeave().warp_over);
  EXPECT_EQ(twillWeave(2, 2).warp_over, (std::vector<char>{1, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 1, 1, 0, 0, 1}));
  const Weave satin = satinWeave(5, 2);
  for (int k = 0; k < 5; ++k) {
    int over_weft = 0, over_warp = 0;
    for (int i = 0; i < 5; ++i) over_weft += satin.warpOver(i, k), over_warp += satin.warpOver(k, i);
    EXPECT_EQ(over_weft, 4);
    EXPECT_EQ(over_warp, 4);
    EXPECT_EQ(satin.warpOver(k + 1, k), satin.warpOver(k + 6, k - 5)) << "periodic";
    EXPECT_TRUE(satin.warpOver(2 * k + 1, k)) << "no two interlacings touch";
  }
}

TEST(Weave, PlainIsWhatChangesSidesEverywhere) {
  EXPECT_TRUE(isPlain(plainWeave()));
  EXPECT_TRUE(isPlain(weaveOf({{1, 0, 1, 0}, {0, 1, 0, 1}})));
  EXPECT_FALSE(isPlain(twillWeave(2, 1)));
  EXPECT_FALSE(isPlain(weaveOf({{1, 0, 1, 0}, {1, 0, 1, 0}, {0, 1, 0, 1}, {0, 1, 0, 1}})));
}

TEST(Weave, WhatFallsApartIsRefused) {
  for (const Weave& w : {plainWeave(), twillWeave(2, 2), twillWeave(3, 1), satinWeave(5, 2), satinWeave(8, 3)})
    EXPECT_NO_THROW(checkWeave(w));
  EXPECT_NO_THROW(weaveOf({{1, 0}, {0, 1}}));
  expectRefused([] { weaveOf({{1, 1}, {1, 1}}); }, "weave.matrix", "not woven in");
  expectRefused([] { weaveOf({{1, 0, 1}, {0, 1, 1}}); }, "weave.matrix", "warp yarn 3");
  expectRefused([] { weaveOf({{1, 0}, {0, 1}, {0, 0}}); }, "weave.matrix", "weft yarn 3");
  // Every yarn interlaces, yet two plain weaves lie on each other.
  const std::vector<std::vector<int>> two = {{1, 0, 1, 1}, {0, 1, 1, 1}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  expectRefused([&] { weaveOf(two); }, "weave.matrix", "not woven in");
  expectRefused([] { weaveOf({}); }, "weave.matrix", "at least one");
  expectRefused([] { weaveOf({{1, 0}, {0}}); }, "weave.matrix", "row 2 has 1");
  expectRefused([] { weaveOf({{1, 0}, {0, 2}}); }, "weave.matrix", "0 (weft over) or 1");
  expectRefused([] { twillWeave(0, 2); }, "weave.over", "at least 1");
  expectRefused([] { twillWeave(2, 0); }, "weave.under", "at least 1");
  expectRefused([] { satinWeave(4, 2); }, "weave.ends", "at least 5");
  expectRefused([] { satinWeave(8, 2); }, "weave.step", "without a factor");
  expectRefused([] { satinWeave(5, 4); }, "weave.step", "2 to 3");
}

TEST(Weave, KnowsItsMirrorsAndFaces) {
  EXPECT_TRUE(isMirrorSymmetric(plainWeave()));
  EXPECT_TRUE(hasEqualFaces(plainWeave()));
  EXPECT_FALSE(isMirrorSymmetric(twillWeave(2, 2))) << "its line goes to the other side";
  EXPECT_TRUE(hasEqualFaces(twillWeave(2, 2)));
  EXPECT_FALSE(isMirrorSymmetric(twillWeave(2, 1)));
  EXPECT_FALSE(hasEqualFaces(twillWeave(2, 1)));
  EXPECT_FALSE(isMirrorSymmetric(satinWeave(5, 2))) << "step 2 becomes step 3";
  EXPECT_FALSE(hasEqualFaces(satinWeave(8, 3)));
  // A twill that turns back is its mirror image.
  EXPECT_TRUE(isMirrorSymmetric(weaveOf({{1, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 1, 0}, {0, 1, 0, 1}})));
}

WovenYarns cloth(const Weave& weave) {
  return {weave, {WovenYarn{1e-3, 0.16e-3, 0.24e-3, 0.16e-3}, WovenYarn{1.5e-3, 0.12e-3, 0.2e-3, 0.1e-3}}};
}

TEST(WovenYarns, PlainYarnsAreSineWaves) {
  const WovenYarns w = cloth(plainWeave());
  EXPECT_NO_THROW(checkWovenYarns(w));
  EXPECT_DOUBLE_EQ(w.period_m(along_weft), 3e-3);
  EXPECT_DOUBLE_EQ(w.period_m(along_warp), 2e-3);
  EXPECT_DOUBLE_EQ(w.area_m2(), 6e-6);
  for (const int d : {along_weft, along_warp})
    for (int k = 0; k < 2; ++k)
      for (int i = 0; i < 23; ++i) {
        const double L = w.yarn[1 - d].spacing_m, s = w.period_m(d) * i / 23;
        const double sign = w.onTop(d, k, 0) ? 1 : -1, phase = std::numbers::pi * (s / L - 0.5);
        const double A = sign * w.yarn[d].amplitude_m;
        EXPECT_NEAR(w.height_m(d, k, s), A * std::cos(phase), 1e-18);
        EXPECT_NEAR(w.slope(d, k, s), -A * std::numbers::pi / L * std::sin(phase), 1e-14);
      }
}

/// A whole wave of a sine has the length 4 sqrt(1 + m²) E(m/sqrt(1 + m²)) L/(2 pi), m = pi A/L its slope.
TEST(WovenYarns, LengthIsTheEllipticIntegral) {
  const WovenYarns w = cloth(plainWeave());
  for (const int d : {along_weft, along_warp}) {
    const double L = w.yarn[1 - d].spacing_m, m = std::numbers::pi * w.yarn[d].amplitude_m / L, r = std::hypot(1, m);
    const double exact = 4 * r * std::comp_ellint_2(m / r) * L / std::numbers::pi;
    EXPECT_NEAR(w.arcLength_m(d, 0, 0, w.period_m(d)), exact, 1e-12 * exact);
    double sum = 0;
    for (int i = 0; i < 14; ++i) sum += w.arcLength_m(d, 1, w.period_m(d) * i / 14, w.period_m(d) * (i + 1) / 14);
    EXPECT_NEAR(sum, exact, 1e-12 * exact);
  }
}

TEST(WovenYarns, FloatsAreStraight) {
  const WovenYarns w = cloth(twillWeave(2, 2));
  const double L = w.yarn[along_warp].spacing_m, A = w.yarn[along_weft].amplitude_m;
  // Weft 0 is under warps 0 and 1, over warps 2 and 3.
  EXPECT_DOUBLE_EQ(w.height_m(along_weft, 0, 0.5 * L), -A);
  EXPECT_DOUBLE_EQ(w.height_m(along_weft, 0, 1.1 * L), -A);
  EXPECT_NEAR(w.height_m(along_weft, 0, 2 * L), 0, 1e-18);
  EXPECT_DOUBLE_EQ(w.height_m(along_weft, 0, 3 * L), A);
  EXPECT_DOUBLE_EQ(w.slope(along_weft, 0, 3 * L), 0);
  EXPECT_EQ(w.middle(along_weft, 1, 0.0).y, 1.5 * w.yarn[along_weft].spacing_m);
}

TEST(WovenYarns, HalfATurnTakesAWeaveToItselfAboutPlacesOfItsYarns) {
  for (const Weave& weave : {plainWeave(), twillWeave(2, 2), twillWeave(3, 1), satinWeave(5, 2)}) {
    const WovenYarns w = cloth(weave);
    for (const int d : {along_weft, along_warp})
      for (int k = 0; k < w.count(d); ++k) {
        const std::optional<int> halves = w.halfTurn(d, k);
        ASSERT_TRUE(halves);
        const double L = w.yarn[1 - d].spacing_m, place = 0.5 * (*halves + 1) * L;
        for (const double s : {0.1, 0.7, 1.3})
          EXPECT_NEAR(w.height_m(d, k, place + s * L), w.height_m(d, k, place - s * L), 1e-15);
      }
  }
  EXPECT_EQ(cloth(plainWeave()).halfTurn(along_weft, 0), 0);
  EXPECT_EQ(cloth(twillWeave(2, 2)).halfTurn(along_weft, 0).value() % 2, 1);  // in the middle of a float
  // A weave whose first weft has no such place: floats of 3, 1, 1 and 2 one after the other.
  const Weave odd{7, 2, {1, 1, 1, 0, 1, 0, 0, 0, 0, 1, 1, 0, 1, 1}};
  EXPECT_FALSE(cloth(odd).halfTurn(along_weft, 0));
}

TEST(WovenYarns, YarnsThatCannotLieThereAreRefused) {
  const auto with = [](const std::function<void(WovenYarns&)>& change) {
    return [change] {
      WovenYarns w = cloth(plainWeave());
      change(w);
      checkWovenYarns(w);
    };
  };
  expectRefused(with([](WovenYarns& w) { w.yarn[0].amplitude_m = 0.13e-3; }), "weft.amplitude", "at least 0.00014");
  expectRefused(with([](WovenYarns& w) { w.yarn[1].half_width_m = 0.76e-3; }), "warp.half_width", "0.00075");
  expectRefused(with([](WovenYarns& w) { w.yarn[1].half_width_m = -1e-3; }), "warp.half_width", "> 0");
  expectRefused(with([](WovenYarns& w) { w.yarn[0].spacing_m = std::nan(""); }), "weft.spacing", "> 0");
  expectRefused(with([](WovenYarns& w) { w.yarn[1].amplitude_m = -1; }), "warp.amplitude", ">= 0");
  expectRefused(with([](WovenYarns& w) { w.yarn[0].half_thickness_m = 0; }), "weft.half_thickness", "> 0");
  // The weft goes down within the width of the warps that it lies on.
  expectRefused(with([](WovenYarns& w) { w.yarn[1].half_width_m = 0.7e-3; }), "weft.amplitude", "interlocked");
  // Man 2006, 4.3.5 (A = b = 0.16 L, a = 1.5 b) touches and no more.
  WovenYarns man{plainWeave(), {}};
  man.yarn[0] = man.yarn[1] = {1, 0.16, 0.24, 0.16};
  EXPECT_NO_THROW(checkWovenYarns(man));
}

}  // namespace
}  // namespace gambeson
