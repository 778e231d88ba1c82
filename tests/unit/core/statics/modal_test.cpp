/// Natural modes of chains with closed forms: supported, free, repeated, unstable.

#include "core/statics/modal.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/statics/small_systems.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// `copies` chains of n masses m and springs k next to one another; ends free or held.
SmallSystem chains(int copies, int n, double k, double m, bool held) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(copies * n, copies * n);
  for (int c = 0; c < copies; ++c)
    for (int i = 0; i < n; ++i) {
      const int a = c * n + i;
      K(a, a) = 2 * k;
      if (!held && (i == 0 || i + 1 == n)) K(a, a) = k;
      if (i + 1 < n) K(a, a + 1) = K(a + 1, a) = -k;
    }
  SmallSystem s = linearSystem(K, Eigen::VectorXd::Zero(copies * n));
  s.M = m * Eigen::MatrixXd::Identity(copies * n, copies * n);
  return s;
}

void expectOrthonormal(const std::vector<Mode>& modes, const Eigen::MatrixXd& M) {
  for (std::size_t i = 0; i < modes.size(); ++i)
    for (std::size_t j = 0; j <= i; ++j) {
      const auto a = SmallSystem::vectorOf(modes[i].shape), b = SmallSystem::vectorOf(modes[j].shape);
      EXPECT_NEAR(a.dot(M * b), i == j ? 1 : 0, 1e-8);
    }
}

TEST(Modes, HeldChainHasItsClosedFormFrequencies) {
  const int n = 60;
  SmallSystem s = chains(1, n, 3, 0.5, true);
  const auto modes = lowestModes(s, {}, 0, 10);
  ASSERT_EQ(modes.size(), 10u);
  for (int j = 1; j <= 10; ++j) {
    const double omega = 2 * std::sqrt(6.0) * std::sin(j * M_PI / (2.0 * (n + 1)));
    EXPECT_NEAR(modes[j - 1].omega_rad_per_s, omega, 1e-9 * omega);
    EXPECT_LT(modes[j - 1].residual, 1e-8);
  }
  expectOrthonormal(modes, s.M);
}

/// Three chains: every frequency three times.
TEST(Modes, RepeatedFrequenciesAreAllFound) {
  const int n = 25;
  SmallSystem s = chains(3, n, 1, 1, true);
  const auto modes = lowestModes(s, {}, 0, 11);
  ASSERT_EQ(modes.size(), 11u);
  for (int j = 0; j < 11; ++j) {
    const double omega = 2 * std::sin((j / 3 + 1) * M_PI / (2.0 * (n + 1)));
    EXPECT_NEAR(modes[j].omega_rad_per_s, omega, 1e-8 * omega) << j;
  }
  expectOrthonormal(modes, s.M);
}

/// Free chains: as many modes at zero as there are chains, then 2 sqrt(k/m) sin(j pi/(2 n)).
TEST(Modes, FreeBodiesHaveTheirRigidModesAtZero) {
  const int n = 20;
  SmallSystem s = chains(6, n, 1e4, 1e-2, false);
  const auto modes = lowestModes(s, {}, 0, 13);
  ASSERT_EQ(modes.size(), 13u);
  for (int j = 0; j < 6; ++j) EXPECT_EQ(modes[j].omega_rad_per_s, 0) << j;
  for (int j = 6; j < 13; ++j) {
    const double omega = 2 * std::sqrt(1e6) * std::sin((j / 6) * M_PI / (2.0 * n));
    EXPECT_NEAR(modes[j].omega_rad_per_s, omega, 1e-7 * omega) << j;
  }
  expectOrthonormal(modes, s.M);
}

/// K = diag(-9, 4, -0.25, 100): omega = -3, -0.5, 2, 10, with the sign of omega^2.
TEST(Modes, UnstableModesAreNegative) {
  SmallSystem s = linearSystem(Eigen::Vector4d(-9, 4, -0.25, 100).asDiagonal(), Eigen::Vector4d::Zero());
  const auto modes = lowestModes(s, {}, 0, 4);
  ASSERT_EQ(modes.size(), 4u);
  const double expected[] = {-3, -0.5, 2, 10};
  for (int j = 0; j < 4; ++j) EXPECT_NEAR(modes[j].omega_rad_per_s, expected[j], 1e-8);
}

TEST(Modes, AllModesOfASmallSystemAndNoMore) {
  SmallSystem s = chains(2, 3, 1, 1, true);
  EXPECT_EQ(lowestModes(s, {}, 0, 20).size(), 6u);
  EXPECT_THROW(lowestModes(s, {}, 0, 0), InputError);
  s.M(2, 2) = 0;
  EXPECT_THROW(lowestModes(s, {}, 0, 1), InputError);
}

}  // namespace
}  // namespace gambeson
