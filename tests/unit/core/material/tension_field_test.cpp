// The relaxed membrane against closed forms, its own definition as a maximum, and differences.
#include "core/material/laws/tension_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "core/material/section.hpp"

namespace gambeson {
namespace {

Voigt isotropic(double E, double nu) {
  const double k = E / (1 - nu * nu);
  return {k, k, 0.5 * E / (1 + nu), nu * k, 0, 0};
}

/// A turned ply, 5 : 1.
Voigt aniso() { return reducedStiffness({1, 500, 100, 60, 0.3, 0.4}); }

TensionField at(const Voigt& A, double e11, double e22, double g12) {
  const double e[3] = {e11, e22, g12};
  return tensionField(A.data(), e);
}

/// E1 > 0 wide: a bar of modulus E along the principal direction as soon as the sheet would be pressed across, that is
/// where E2 < -nu E1.
TEST(TensionField, IsotropicClosedForm) {
  const double E = 200, nu = 0.3, turn = 0.37, c = std::cos(turn), s = std::sin(turn);
  const Voigt A = isotropic(E, nu);
  for (double e1 : {0.1, 1e-4, -0.1})
    for (double e2 : {0.05, -0.01, -0.029e0, -0.2, -1.0}) {
      if (e2 > e1) continue;
      const auto f = at(A, c * c * e1 + s * s * e2, s * s * e1 + c * c * e2, 2 * c * s * (e1 - e2));
      const double n1 = f.n[0] * c * c + f.n[1] * s * s + 2 * f.n[2] * c * s;
      if (e1 <= 0) {
        EXPECT_EQ(f.state, TensionField::slack);
        EXPECT_EQ(f.energy, 0);
      } else if (e2 > -nu * e1) {
        EXPECT_EQ(f.state, TensionField::taut);
        EXPECT_NEAR(n1, E / (1 - nu * nu) * (e1 + nu * e2), 1e-12 * E);
      } else {
        EXPECT_EQ(f.state, TensionField::uniaxial);
        EXPECT_NEAR(n1, E * e1, 1e-11 * E * e1);
        EXPECT_NEAR(f.n[0] + f.n[1], E * e1, 1e-11 * E * e1) << "no stress across";
        EXPECT_NEAR(f.energy, 0.5 * E * e1 * e1, 1e-12 * E * e1 * e1);
      }
    }
}

/// W_r(E) = max over S >= 0 of S : E - S : C : S/2: no positive semidefinite S on a fine grid gives more, and the S
/// returned gives just W_r. In two dimensions S = a uu + b vv.
TEST(TensionField, IsTheMaximumOverTensileStresses) {
  const Voigt A = aniso();
  std::mt19937 random(4);
  std::uniform_real_distribution<double> d(-1, 1);
  const auto strainOf = [&](const double* n) {  // C n by Cramer's rule
    const double m[3][3] = {{A[0], A[3], A[4]}, {A[3], A[1], A[5]}, {A[4], A[5], A[2]}};
    const auto det = [](const double(&k)[3][3]) {
      return k[0][0] * (k[1][1] * k[2][2] - k[1][2] * k[2][1]) - k[0][1] * (k[1][0] * k[2][2] - k[1][2] * k[2][0]) +
             k[0][2] * (k[1][0] * k[2][1] - k[1][1] * k[2][0]);
    };
    std::array<double, 3> e{};
    for (int c = 0; c < 3; ++c) {
      double k[3][3];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) k[i][j] = j == c ? n[i] : m[i][j];
      e[c] = det(k) / det(m);
    }
    return e;
  };
  int seen[3] = {0, 0, 0};
  for (int sample = 0; sample < 200; ++sample) {
    const double e[3] = {d(random), d(random), 2 * d(random)};
    const TensionField f = tensionField(A.data(), e);
    ++seen[f.state];
    const auto value = [&](const double* n) {
      const auto c = strainOf(n);
      double v = 0;
      for (int i = 0; i < 3; ++i) v += n[i] * (e[i] - 0.5 * c[i]);
      return v;
    };
    EXPECT_NEAR(value(f.n), f.energy, 1e-9);
    EXPECT_GE(f.n[0] * f.n[1] - f.n[2] * f.n[2], -1e-7);
    EXPECT_GE(f.n[0] + f.n[1], 0);
    const double top = 700;
    for (int t = 0; t < 36; ++t)
      for (int i = 0; i < 15; ++i)
        for (int j = 0; j < 15; ++j) {
          const double a = top * i / 14, b = top * j / 14, c = std::cos(t * 0.0873), s = std::sin(t * 0.0873);
          const double n[3] = {a * c * c + b * s * s, a * s * s + b * c * c, (a - b) * c * s};
          EXPECT_LE(value(n), f.energy + 1e-9);
        }
  }
  for (int state : seen) EXPECT_GT(state, 10);
}

TEST(TensionField, ForceAndSlopeAreDerivatives) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> d(-1, 1);
  for (const Voigt& A : {isotropic(200, 0.3), aniso(), Voigt{200, 100, 45, 25, 0, 0}})
    for (int sample = 0; sample < 300; ++sample) {
      double e[3] = {d(random), d(random), 2 * d(random)};
      const TensionField f = tensionField(A.data(), e);
      const int index[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
      const double h = 1e-5;
      for (int j = 0; j < 3; ++j) {
        const double old = e[j];
        e[j] = old + h;
        const TensionField up = tensionField(A.data(), e);
        e[j] = old - h;
        const TensionField down = tensionField(A.data(), e);
        e[j] = old;
        if (up.state != f.state || down.state != f.state) continue;
        EXPECT_NEAR((up.energy - down.energy) / (2 * h), f.n[j], 2e-6 * A[0]);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR((up.n[i] - down.n[i]) / (2 * h), f.slope[index[i][j]], 1e-4 * A[0])
              << e[0] << " " << e[1] << " " << e[2];
      }
    }
}

/// The force has no jump where the state changes, and the energy is convex: along any line the force only grows.
TEST(TensionField, IsConvexAndContinuous) {
  const Voigt A = aniso();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-1, 1);
  for (int line = 0; line < 50; ++line) {
    const double from[3] = {d(random), d(random), d(random)}, along[3] = {d(random), d(random), d(random)};
    double before = -1e300;
    for (int k = -500; k <= 500; ++k) {
      double e[3], work = 0;
      for (int i = 0; i < 3; ++i) e[i] = from[i] + 0.004 * k * along[i];
      const TensionField f = tensionField(A.data(), e);
      for (int i = 0; i < 3; ++i) work += f.n[i] * along[i];
      if (k > -500) {
        EXPECT_GE(work, before - 1e-9);
        EXPECT_LE(work - before,
                  0.004 * 4 * (A[0] + A[1] + A[2] + 2 * std::abs(A[3]) + 2 * std::abs(A[4]) + 2 * std::abs(A[5])));
      }
      before = work;
    }
  }
}

TEST(TensionField, ZeroStrainHasNoForce) {
  const TensionField f = at(aniso(), 0, 0, 0);
  EXPECT_EQ(f.energy, 0);
  for (double n : f.n) EXPECT_EQ(n, 0);
  EXPECT_EQ(f.slope[0], aniso()[0]);  // taut: the sheet answers at once where it is pulled
  EXPECT_EQ(at(aniso(), -1e-13, -1e-14, 1e-14).state, TensionField::taut) << "rest to rounding";
  EXPECT_EQ(at(aniso(), -1e-11, -1e-11, 0).state, TensionField::slack);
}

}  // namespace
}  // namespace gambeson
