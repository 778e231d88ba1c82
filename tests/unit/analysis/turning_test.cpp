/// How fast regions of cloth turn.

#include "analysis/turning.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

/// A grid of unequal masses in two regions, each moving rigidly about a centre and an axis of its own.
struct Grid {
  std::vector<int> region;
  std::vector<double> mass_kg;
  std::vector<Vec3> x_m, v_m_per_s;

  void add(int r, const Vec3& spin, const Vec3& velocity, double flatness) {
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 4; ++j) {
        const Vec3 x{0.1 * i + r, 0.07 * j, flatness * (i * i - j) - r};
        region.push_back(r);
        mass_kg.push_back(0.01 * (1 + (3 * i + j) % 4));
        x_m.push_back(x);
        v_m_per_s.push_back(velocity + cross(spin, x));
      }
  }
  std::vector<Turning> turning(int regions) const { return turningOf(region, mass_kg, x_m, v_m_per_s, regions); }
};

TEST(Turning, RigidRegionsTurnAsTheyAreTurned) {
  const Vec3 first{0.3, -2, 5}, second{0, 0, -7};
  Grid g;
  g.add(0, first, {1, 2, 3}, 0);  // flat
  g.add(1, second, {-4, 0, 1}, 0.02);
  const std::vector<Turning> w = g.turning(2);
  EXPECT_LE(norm(w[0].rate_rad_per_s - first), 1e-10);
  EXPECT_LE(norm(w[1].rate_rad_per_s - second), 1e-10);
}

TEST(Turning, IsTheNearestRigidMotionOfWhatIsNotRigid) {
  Grid g;
  g.add(0, {0, 0, 3}, {}, 0.02);
  const auto missed = [&](const Vec3& w) {
    double mass = 0, sum = 0;
    Vec3 centre, mean;
    for (std::size_t i = 0; i < g.x_m.size(); ++i) {
      mass += g.mass_kg[i];
      centre += g.mass_kg[i] * g.x_m[i];
      mean += g.mass_kg[i] * g.v_m_per_s[i];
    }
    for (std::size_t i = 0; i < g.x_m.size(); ++i)
      sum += g.mass_kg[i] * norm2(g.v_m_per_s[i] - mean / mass - cross(w, g.x_m[i] - centre / mass));
    return sum;
  };
  for (std::size_t i = 0; i < g.x_m.size(); ++i) g.v_m_per_s[i] += Vec3{std::sin(5. * i), std::cos(3. * i), 0.2};
  const Vec3 w = g.turning(1)[0].rate_rad_per_s;
  for (const Vec3& d : {Vec3{0.1, 0, 0}, Vec3{0, 0.1, 0}, Vec3{0, 0, 0.1}}) {
    EXPECT_LT(missed(w), missed(w + d));
    EXPECT_LT(missed(w), missed(w - d));
  }
}

// Two masses of 0.5 kg on arms of 0.1 m, carried along, at 3 rad/s: L = 2 m r^2 w.
TEST(Turning, MomentumIsThatAboutTheCentre) {
  const std::vector<int> region{0, 0, 0};
  const std::vector<double> mass{0.5, 0.5, 2};
  const Vec3 at{4, 5, 6}, along{7, 8, 9};
  const std::vector<Vec3> x{at + Vec3{0.1, 0, 0}, at - Vec3{0.1, 0, 0}, at},
      v{along + Vec3{0, 0.3, 0}, along - Vec3{0, 0.3, 0}, along};
  const Turning t = turningOf(region, mass, x, v, 1)[0];
  EXPECT_LE(norm(t.momentum_Nms - Vec3{0, 0, 2 * 0.5 * 0.01 * 3}), 1e-14);
}

TEST(Turning, MassesOnALineHaveNone) {
  const std::vector<int> region{0, 0, 0};
  const std::vector<double> mass{1, 2, 3};
  const std::vector<Vec3> x{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, v{{0, 0, 1}, {0, 0, 0}, {0, 0, -1}};
  EXPECT_TRUE(std::isnan(turningOf(region, mass, x, v, 1)[0].rate_rad_per_s.z));
}

}  // namespace
}  // namespace gambeson
