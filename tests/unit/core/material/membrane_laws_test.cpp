/// Springs, and the membrane of Baraff and Witkin with their damping.

#include <gtest/gtest.h>

#include "core/material/laws/baraff_witkin.hpp"
#include "core/material/laws/membrane.hpp"
#include "core/material/laws/spring.hpp"
#include "unit/core/material/law_check.hpp"

namespace gambeson {
namespace {

using Three = std::array<double, 3>;

const BaraffWitkinNumbers<double> threads{300, 200, 40, 0.5, 0.2};

// One point of a spring moves, the other is at the origin: minus its force, and d f/d x of the other.
TEST(Spring, ForceAndSlopeAreThoseOfItsEnergy) {
  static constexpr double k = 120, rest = 0.7;
  const auto law = []<class S>(const S* d) {
    const S length2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const SpringAnswer<S> a = linearSpring<all_parts>(k, rest, length2);
    Evaluated<S, 3> out;
    out.potential = a.energy;
    for (int i = 0; i < 3; ++i) {
      out.resultant[i] = a.per_length * d[i];
      for (int j = 0; j < 3; ++j)
        out.slope[i][j] = (a.along - a.across) * d[i] * d[j] / length2 + a.across * (i == j ? 1.0 : 0.0);
    }
    return out;
  };
  for (const Three& d : {Three{0.5, -0.4, 0.6}, Three{0.2, 0.1, -0.1}, Three{0.9, 0, 0}, Three{3, -2, 1}}) {
    const LawErrors e = lawErrors<3>(law, d, 1e-4);
    EXPECT_LT(e.gradient, 1e-8);
    EXPECT_LT(e.slope, 1e-8);
    EXPECT_LT(e.dual, 1e-13);
  }
  // Pressed, it is unstable across; at rest it is not there.
  EXPECT_LT((linearSpring<all_parts>(k, rest, 0.25 * rest * rest).across), 0);
  EXPECT_EQ((linearSpring<all_parts>(k, 2.0, 4.0).per_length), 0);
  EXPECT_TRUE(std::isfinite(linearSpring<all_parts>(k, rest, 0.0).per_length));
}

TEST(Spring, DampingTakesTheSpeedAlongIt) {
  const double d[3] = {0.3, -0.2, 0.6}, length2 = 0.49, c = 0.4;
  for (const Three& w : {Three{1, 2, -1}, Three{0.3, -0.2, 0.6}, Three{2, 3, 0}}) {
    const double along = d[0] * w[0] + d[1] * w[1] + d[2] * w[2], per_length = springDamping(c, length2, along);
    const double speed = along / 0.7;
    EXPECT_NEAR(per_length * 0.7, c * speed, 1e-15);  // f_i = c (u . w) u
    EXPECT_NEAR(per_length * along, c * speed * speed, 1e-15);
  }
}

const std::vector<Three> strains{{0.012, -0.007, 0.02}, {-0.09, 0.03, -0.05}, {0.2, 0.11, 0.07}, {-0.3, -0.2, 0.3}};

TEST(BaraffWitkin, ResultantsAreTheGradientOfTheEnergy) {
  const auto law = []<class S>(const S* e) {
    Answer<S, 3> a{};
    baraffWitkin<all_parts>(threads, e, a);
    return evaluated(a);
  };
  for (const Three& e : strains) {
    const LawErrors errors = lawErrors<3>(law, e, 1e-5);
    EXPECT_LT(errors.gradient, 1e-8);
    EXPECT_LT(errors.slope, 1e-8);
    EXPECT_LT(errors.dual, 1e-13);
  }
}

/// P = k (l - 1) along a thread, against E l (l^2 - 1)/2 of St. Venant-Kirchhoff: P = l n.
TEST(BaraffWitkin, PullsAThreadAsAStraightLine) {
  for (const double l : {0.4, 0.9, 1.0, 1.3, 2.0}) {
    const double e[3] = {0.5 * (l * l - 1), 0, 0}, A[6] = {300, 200, 40, 0, 0, 0};
    Answer<double, 3> ours{}, st_venant{};
    baraffWitkin<only_resultants>(threads, e, ours);
    stVenantKirchhoff<only_resultants>(A, e, st_venant);
    EXPECT_NEAR(l * ours.resultant[0], 300 * (l - 1), 1e-12);
    EXPECT_NEAR(l * st_venant.resultant[0], 300 * l * (l * l - 1) / 2, 1e-12);
    EXPECT_EQ(ours.resultant[1], 0);
    EXPECT_EQ(ours.resultant[2], 0);
  }
}

/// Per area dC_u/dt = d|w_u|/dt: the power of its damping is k_d (dC_u/dt)^2, by differences of |w_u|.
TEST(BaraffWitkin, DampingTakesTheRateOfItsConditions) {
  const double rate[3] = {0.3, -0.4, 0.25}, dt = 1e-6;
  for (const Three& e : strains) {
    Answer<double, 3> a{};
    baraffWitkinDamping<all_parts>(threads, e.data(), rate, a);
    double power = 0, C[2] = {};
    for (int i = 0; i < 2; ++i) {
      const auto length = [&](double side) { return std::sqrt(1 + 2 * (e[i] + side * dt * rate[i])); };
      C[i] = (length(1) - length(-1)) / (2 * dt);
      power += threads.stretch_damping * C[i] * C[i];
      EXPECT_NEAR(a.resultant[i], threads.stretch_damping * C[i] / length(0), 1e-9);
      EXPECT_NEAR(a.slope[i] * rate[i], a.resultant[i], 1e-15);
    }
    power += threads.shear_damping * rate[2] * rate[2];
    EXPECT_NEAR(a.energy, power, 1e-9);
    EXPECT_GE(a.energy, 0);
  }
}

}  // namespace
}  // namespace gambeson
