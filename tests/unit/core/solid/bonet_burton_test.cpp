/// The law of yarns (Man 2006, section 4.3.4): its constants, stress and tangent, what it refuses.

#include "core/solid/bonet_burton.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Man 2006, section 4.3.5.2.
BonetBurton kevlar() { return {0.4457e9, 0.5154e9, 0.2714e9, 0.06548e9, 10.54e9}; }

constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};

/// C = FᵀF of F = 1 + size * random.
Symmetric randomStrain(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> d(-size, size);
  double F[3][3];
  for (auto& r : F)
    for (double& v : r) v = d(random);
  for (int i = 0; i < 3; ++i) F[i][i] += 1;
  Symmetric C{};
  for (int a = 0; a < 6; ++a)
    for (int k = 0; k < 3; ++k) C[a] += F[k][row[a]] * F[k][column[a]];
  return C;
}

TEST(BonetBurton, ManConstantsAreTheModuliOfKevlar) {
  const TransverseModuli m = moduliOf(kevlar());
  EXPECT_NEAR(m.axial_young_Pa, 84.63e9, 0.005e9);
  EXPECT_NEAR(m.transverse_young_Pa, 1.340e9, 0.0005e9);
  EXPECT_NEAR(m.axial_shear_Pa, 0.2440e9, 0.00005e9);
  EXPECT_NEAR(m.poisson_axial, 0.300, 0.0005);
  EXPECT_NEAR(m.poisson_transverse, 0.300, 0.0005);
}

TEST(BonetBurton, ManIsotropicConstantsAreYoungAndPoisson) {
  const TransverseModuli m = moduliOf({48.82e9, 32.55e9});
  EXPECT_NEAR(m.axial_young_Pa, 84.63e9, 0.005e9);
  EXPECT_NEAR(m.transverse_young_Pa, m.axial_young_Pa, 1e-9 * m.axial_young_Pa);
  EXPECT_NEAR(m.poisson_axial, 0.300, 0.0005);
  EXPECT_NEAR(m.axial_shear_Pa, 32.55e9, 1);
  const BonetBurton law = isotropicLaw(m.axial_young_Pa, m.poisson_axial);
  EXPECT_NEAR(law.lambda_Pa, 48.82e9, 1);
  EXPECT_NEAR(law.mu_Pa, 32.55e9, 1);
}

TEST(BonetBurton, ModuliAndConstantsAreOneAnother) {
  const TransverseModuli given{3e9, 7e8, 2e8, 0.35, -0.2};
  const TransverseModuli m = moduliOf(lawOf(given));
  EXPECT_NEAR(m.axial_young_Pa, given.axial_young_Pa, 1e-3);
  EXPECT_NEAR(m.transverse_young_Pa, given.transverse_young_Pa, 1e-3);
  EXPECT_NEAR(m.axial_shear_Pa, given.axial_shear_Pa, 1e-3);
  EXPECT_NEAR(m.poisson_axial, given.poisson_axial, 1e-12);
  EXPECT_NEAR(m.poisson_transverse, given.poisson_transverse, 1e-12);
}

TEST(BonetBurton, HasNoStressAtRest) {
  const double largest = 84.63e9;
  const SolidAnswer a = evaluate(kevlar(), normalized(Vec3{0.3, 0.5, -0.7}), {1, 1, 1, 0, 0, 0});
  EXPECT_EQ(a.energy_J_per_m3, 0);
  for (const double s : a.stress_Pa) EXPECT_NEAR(s, 0, 1e-15 * largest);
}

TEST(BonetBurton, StressAndTangentAreDerivativesOfTheEnergy) {
  std::mt19937 random(3);
  const Vec3 fibre = normalized(Vec3{0.3, 0.5, -0.7});
  for (const BonetBurton& law : {kevlar(), BonetBurton{48.82e9, 32.55e9}})
    for (int trial = 0; trial < 20; ++trial) {
      const Symmetric C = randomStrain(random, 0.2);
      Elasticity D;
      const SolidAnswer here = evaluate(law, fibre, C, D);
      EXPECT_EQ(here.stress_Pa, evaluate(law, fibre, C).stress_Pa);
      double stress = 0, slope = 0, stress_error = 0, slope_error = 0;
      for (const double s : here.stress_Pa) stress = std::max(stress, std::abs(s));
      for (const double d : D) slope = std::max(slope, std::abs(d));
      for (int b = 0; b < 6; ++b) {
        // dC = 2 dE: an entry off the diagonal moves with its mirror image. Differences of fourth order.
        const double h = 1e-4;
        const auto at = [&](double way) {
          Symmetric moved = C;
          moved[b] += (b < 3 ? 2 : 1) * way * h;
          return evaluate(law, fibre, moved);
        };
        const SolidAnswer m2 = at(-2), m1 = at(-1), p1 = at(1), p2 = at(2);
        const auto slopeOf = [&](auto get) { return (8 * (get(p1) - get(m1)) - (get(p2) - get(m2))) / (12 * h); };
        stress_error = std::max(stress_error, std::abs(slopeOf([](const SolidAnswer& s) { return s.energy_J_per_m3; }) -
                                                       here.stress_Pa[b]));
        for (int a = 0; a < 6; ++a)
          slope_error = std::max(
              slope_error, std::abs(slopeOf([&](const SolidAnswer& s) { return s.stress_Pa[a]; }) - D[6 * a + b]));
      }
      EXPECT_LT(stress_error, 1e-7 * stress);
      EXPECT_LT(slope_error, 1e-7 * slope);
    }
}

TEST(BonetBurton, StressTurnsWithTheMaterial) {
  std::mt19937 random(8);
  const Vec3 fibre = normalized(Vec3{1, 2, -0.5});
  const Symmetric C = randomStrain(random, 0.3);
  const Mat3 R = rotationAbout(normalized(Vec3{2, -1, 3}), 0.7);
  const auto turned = [&](const Symmetric& s) {
    const Mat3 m{{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}};
    const Mat3 t = R * m * transpose(R);
    return Symmetric{t.a.x, t.b.y, t.c.z, t.c.y, t.c.x, t.b.x};
  };
  const SolidAnswer one = evaluate(kevlar(), fibre, C), two = evaluate(kevlar(), R * fibre, turned(C));
  EXPECT_NEAR(one.energy_J_per_m3, two.energy_J_per_m3, 1e-11 * one.energy_J_per_m3);
  const Symmetric expected = turned(one.stress_Pa);
  for (int a = 0; a < 6; ++a) EXPECT_NEAR(two.stress_Pa[a], expected[a], 1e-11 * 84.63e9);
}

TEST(BonetBurton, AMaterialThatIsTurnedInsideOutHasNoNumbers) {
  Elasticity D;
  const SolidAnswer a = evaluate(kevlar(), {1, 0, 0}, {1, -1, 1, 0, 0, 0}, D);
  EXPECT_TRUE(std::isnan(a.energy_J_per_m3));
  EXPECT_TRUE(std::isnan(a.stress_Pa[0]));
  EXPECT_TRUE(std::isnan(D[0]));
}

void expectRefused(const std::string& key, const std::function<void()>& work) {
  try {
    work();
    ADD_FAILURE() << key << " was accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key);
    EXPECT_NE(e.reason().find("not allowed: "), std::string::npos) << e.reason();
  }
}

TEST(BonetBurton, IndefiniteConstantsAreRefused) {
  const auto refused = [](const std::string& key, const BonetBurton& law) {
    expectRefused(key, [&] { checkLaw(law); });
  };
  BonetBurton law = kevlar();
  checkLaw(law);
  law.mu_Pa = 0;
  refused("mu_Pa", law);
  law = kevlar();
  law.alpha_Pa = law.mu_Pa;
  refused("alpha_Pa", law);
  law = kevlar();
  law.lambda_Pa = -law.mu_Pa;
  refused("lambda_Pa", law);
  law = kevlar();
  law.gamma_Pa = -0.1e9;
  refused("gamma_Pa", law);
  law = kevlar();
  law.beta_Pa = std::nan("");
  refused("beta_Pa", law);
  // The bound of gamma is sharp: there the smallest modulus along the fibres vanishes.
  law = kevlar();
  const double EA = moduliOf(law).axial_young_Pa;
  law.gamma_Pa -= EA / 8 * (1 - 1e-9);
  checkLaw(law);
  law.gamma_Pa -= EA / 8 * 2e-9;
  refused("gamma_Pa", law);
}

TEST(BonetBurton, UnstableModuliAreRefused) {
  const TransverseModuli good{3e9, 7e8, 2e8, 0.35, 0.3};
  const auto refused = [&](const std::string& key, double TransverseModuli::*member, double value) {
    TransverseModuli m = good;
    m.*member = value;
    expectRefused(key, [&] { lawOf(m); });
  };
  refused("axial_young_Pa", &TransverseModuli::axial_young_Pa, -1);
  refused("transverse_young_Pa", &TransverseModuli::transverse_young_Pa, 0);
  refused("axial_shear_Pa", &TransverseModuli::axial_shear_Pa, std::nan(""));
  refused("poisson_transverse", &TransverseModuli::poisson_transverse, 1);
  refused("poisson_axial", &TransverseModuli::poisson_axial, 1.2248);  // sqrt(0.35 3/0.7) = 1.22474
  TransverseModuli edge = good;
  edge.poisson_axial = 1.2247;
  checkLaw(lawOf(edge));
  expectRefused("young_Pa", [] { isotropicLaw(0, 0.3); });
  expectRefused("poisson", [] { isotropicLaw(1e9, 0.5); });
}

}  // namespace
}  // namespace gambeson
