// Sections: plies and classical laminates against textbook values and their own definition.
#include "core/material/section.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

/// Q-bar of a fibre at 30 degrees from the definition: strains turned to the fibre's axes, stresses turned back.
TEST(Section, TurnedPlyIsTheTurnedTensor) {
  const Ply along{1e-3, 181e9, 10.3e9, 7.17e9, 0.28, 0};
  const Voigt Q = reducedStiffness(along);
  // Tsai and Hahn, Introduction to Composite Materials (1980), table 2.1, T300/5208: Q11 181.8, Q22 10.34, Q12 2.897,
  // Q66 7.17 GPa.
  EXPECT_NEAR(Q[0], 181.8e9, 0.05e9);
  EXPECT_NEAR(Q[1], 10.34e9, 0.01e9);
  EXPECT_NEAR(Q[3], 2.897e9, 0.001e9);
  EXPECT_EQ(Q[2], 7.17e9);
  EXPECT_EQ(Q[4], 0);
  for (double angle : {30.0, 45.0, -60.0, 90.0}) {
    Ply ply = along;
    ply.angle_rad = angle * kDegree;
    const Voigt bar = reducedStiffness(ply);
    const double c = std::cos(ply.angle_rad), s = std::sin(ply.angle_rad);
    // Columns of Q-bar: the stress of a unit strain. e_fibre = R e R^T with engineering shear.
    for (int j = 0; j < 3; ++j) {
      const double e11 = j == 0, e22 = j == 1, g12 = j == 2;
      const double f11 = c * c * e11 + s * s * e22 + c * s * g12, f22 = s * s * e11 + c * c * e22 - c * s * g12,
                   fg = -2 * c * s * e11 + 2 * c * s * e22 + (c * c - s * s) * g12;
      const double s1 = Q[0] * f11 + Q[3] * f22, s2 = Q[3] * f11 + Q[1] * f22, s12 = Q[2] * fg;
      const double expected[3] = {c * c * s1 + s * s * s2 - 2 * c * s * s12, s * s * s1 + c * c * s2 + 2 * c * s * s12,
                                  c * s * (s1 - s2) + (c * c - s * s) * s12};
      const int at[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(bar[at[i][j]], expected[i], 1e-3) << angle;
    }
  }
}

TEST(Section, OnePlyIsAHomogeneousPlate) {
  const Ply ply{2e-3, 3e9, 1e9, 0.4e9, 0.3, 0.7};
  const Voigt Q = reducedStiffness(ply);
  const Section s = laminate(std::span(&ply, 1));
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(s.A[i], Q[i] * 2e-3, 1e-12 * Q[0]);
    EXPECT_EQ(s.B[i], 0);
    EXPECT_NEAR(s.D[i], Q[i] * 8e-9 / 12, 1e-20 * Q[0]);
  }
}

/// Against Gauss integration through the thickness of the stress Q (E - z kappa): n, and m as the energy's conjugate.
TEST(Section, IsTheIntegralThroughTheThickness) {
  const std::vector<Ply> plies{
      {1e-3, 140e9, 10e9, 5e9, 0.3, 0}, {0.5e-3, 140e9, 10e9, 5e9, 0.3, 0.8}, {2e-3, 40e9, 9e9, 4e9, 0.25, -0.4}};
  const Section s = laminate(plies);
  Section sum;
  double bottom = -1.75e-3;
  const Quadrature rule = gaussLegendre(2);
  for (const Ply& ply : plies) {
    const Voigt Q = reducedStiffness(ply);
    for (std::size_t g = 0; g < rule.points.size(); ++g) {
      const double z = bottom + rule.points[g] * ply.thickness_m, w = rule.weights[g] * ply.thickness_m;
      for (int i = 0; i < 6; ++i) {
        sum.A[i] += w * Q[i];
        sum.B[i] -= w * z * Q[i];  // a fibre at +z is shortened by a positive curvature
        sum.D[i] += w * z * z * Q[i];
      }
    }
    bottom += ply.thickness_m;
  }
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(s.A[i], sum.A[i], 1e-12 * s.A[0]);
    EXPECT_NEAR(s.B[i], sum.B[i], 1e-12 * s.A[0] * 1e-3);
    EXPECT_NEAR(s.D[i], sum.D[i], 1e-12 * s.D[0]);
  }
}

/// Jones, Mechanics of Composite Materials, 2nd ed., section 4.3: two plies 0/90 of thickness h have B11 = -B22 =
/// (Q11 - Q22) h^2/2 in size, and no other coupling. The 0 ply below: the fibre there is lengthened by kappa > 0.
TEST(Section, TwoCrossedPlies) {
  const double h = 1e-3;
  const std::vector<Ply> plies{{h, 140e9, 10e9, 5e9, 0.3, 0}, {h, 140e9, 10e9, 5e9, 0.3, 90 * kDegree}};
  const Voigt Q = reducedStiffness(plies[0]);
  const Section s = laminate(plies);
  EXPECT_NEAR(s.B[0], (Q[0] - Q[1]) * h * h / 2, 1e-9 * Q[0] * h * h);
  EXPECT_NEAR(s.B[1], -s.B[0], 1e-9 * s.B[0]);
  for (int i : {2, 3, 4, 5}) EXPECT_NEAR(s.B[i], 0, 1e-9 * s.B[0]);
  EXPECT_NEAR(s.A[0], (Q[0] + Q[1]) * h, 1e-9 * s.A[0]);
  EXPECT_NEAR(s.D[0], (Q[0] + Q[1]) * h * h * h / 3, 1e-9 * s.D[0]);
}

TEST(Section, SymmetricPliesDoNotCouple) {
  const std::vector<Ply> plies{
      {1e-3, 140e9, 10e9, 5e9, 0.3, 0.6}, {2e-3, 40e9, 10e9, 5e9, 0.3, -0.2}, {1e-3, 140e9, 10e9, 5e9, 0.3, 0.6}};
  const Section s = laminate(plies);
  for (double b : s.B) EXPECT_NEAR(b, 0, 1e-12 * s.A[0] * 1e-3);
}

std::string refusal(const std::vector<Ply>& plies) {
  try {
    laminate(plies);
  } catch (const InputError& e) {
    return e.where().key;
  }
  return "accepted";
}

TEST(Section, WrongPliesAreNamed) {
  const Ply good{1e-3, 3e9, 1e9, 0.4e9, 0.3, 0.7};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({good}), "accepted");
  EXPECT_EQ(refusal({}), "plies");
  const auto with = [&](double Ply::*member, double value) {
    Ply bad = good;
    bad.*member = value;
    return refusal({good, bad});
  };
  for (double bad : {0.0, -1.0, nan}) {
    EXPECT_EQ(with(&Ply::thickness_m, bad), "plies[1].thickness_m");
    EXPECT_EQ(with(&Ply::young1_Pa, bad), "plies[1].young1_Pa");
    EXPECT_EQ(with(&Ply::young2_Pa, bad), "plies[1].young2_Pa");
    EXPECT_EQ(with(&Ply::shear_Pa, bad), "plies[1].shear_Pa");
  }
  EXPECT_EQ(with(&Ply::poisson12, 1.8), "plies[1].poisson12");  // 1.8^2 > 3
  EXPECT_EQ(with(&Ply::poisson12, nan), "plies[1].poisson12");
  EXPECT_EQ(with(&Ply::angle_rad, nan), "plies[1].angle_rad");
}

}  // namespace
}  // namespace gambeson
