/// Newton's method where sweeps are slow: cloth that is pulled tight over a body.

#include "core/contact/newton_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/contact/response.hpp"

namespace gambeson {
namespace {

constexpr double rho = 0.436, step_s = 1.5e-4, goal = 0.1 * step_s;

/// A belt of quadratic patches around a round body, points in two rows, three samples a cell, each of which a belt's
/// tension presses with thousands of times its weight. Every seventh sample touches a second body beside the first.
struct Belt {
  static constexpr int kPoints = 40, kRows = 2, kSamples = 3 * kPoints;
  SparseRows W;
  std::vector<double> inverse_mass, area, density;
  std::vector<Vec3> velocity;
  std::vector<ContactRow> rows;

  Belt() : inverse_mass(kRows * kPoints), area(kSamples, 1e-4), density(kSamples, rho), velocity(kRows * kPoints) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> part(-1, 1);
    W.column_count = kRows * kPoints;
    std::vector<double> mass(kRows * kPoints, 0.0);
    for (int s = 0; s < kSamples; ++s) {
      const double u = (s % 3 + 0.5) / 3;
      const double N[3] = {0.5 * (1 - u) * (1 - u), 0.5 + u * (1 - u), 0.5 * u * u};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < kRows; ++j) {
          const int point = j * kPoints + (s / 3 + i) % kPoints;
          const double weight = N[i] * (j == 0 ? 0.7 : 0.3);
          W.add(point, weight);
          mass[point] += weight * rho * area[s];
        }
      W.endRow();
    }
    const auto at = [](double angle) { return Vec3{std::cos(angle), std::sin(angle), 0}; };
    for (int i = 0; i < kRows * kPoints; ++i) {
      inverse_mass[i] = 1 / mass[i];
      const double angle = 2 * std::numbers::pi * (i % kPoints + 0.5) / kPoints;
      const Vec3 along = at(angle + std::numbers::pi / 2);
      velocity[i] = (-8 - part(random)) * at(angle) + (2.5 + part(random)) * along + Vec3{0, 0, 0.5 * part(random)};
    }
    for (int s = 0; s < kSamples; ++s) {
      const double angle = 2 * std::numbers::pi * (s + 0.5) / kSamples;
      touch(s, 0, at(angle));
      if (s % 7 == 0) touch(s, 1, at(angle + 1.3));
    }
  }

  void touch(int sample, int obstacle, const Vec3& normal) {
    Contact c;
    c.sample = sample;
    c.obstacle = obstacle;
    c.normal = normal;
    rows.push_back(bodyRow(c, {}, 1e-3, false));
    rows.back().compliance = 3e-5 / rho;
  }

  struct Answer {
    ContactSolve report;
    std::vector<Vec3> velocity, traction;
  };
  Answer solve(bool newton, int most) const {
    ContactParameters parameters{1e-3, 0.3, 0.01, goal / step_s, most};
    parameters.newton = newton;
    Answer a{{}, velocity, std::vector<Vec3>(rows.size())};
    std::vector<Vec3> impulses;
    ContactWork work;
    a.report = solveContacts(rows, W, inverse_mass, area, density, {}, parameters, step_s, a.velocity, a.traction,
                             impulses, work);
    return a;
  }

  /// What a row misses: Signorini's and Coulomb's conditions, by their definition [m/s].
  double residual(const Answer& a, std::size_t k) const {
    const ContactRow& row = rows[k];
    const Vec3& n = row.contact.normal;
    Vec3 v = (-row.target_m_per_s + row.compliance * dot(a.traction[k], n)) * n;
    for (int e = W.offsets[row.contact.sample]; e < W.offsets[row.contact.sample + 1]; ++e)
      v += W.values[e] * a.velocity[W.columns[e]];
    const Vec3 p = a.traction[k] - rho * v;
    Vec3 kept{};
    if (const double pressed = dot(p, n); pressed > 0) {
      const Vec3 along = p - pressed * n;
      kept = pressed * n + std::min(1.0, 0.3 * pressed / norm(along)) * along;
    }
    return norm(a.traction[k] - kept) / rho;
  }
};

TEST(NewtonRows, SolveWhatSweepsLeave) {
  const Belt belt;
  EXPECT_FALSE(belt.solve(false, 2000).report.converged);
  const Belt::Answer a = belt.solve(true, 2000);
  EXPECT_TRUE(a.report.converged);
  EXPECT_LT(a.report.iterations, 600);
  int slips = 0, sticks = 0;
  for (std::size_t k = 0; k < belt.rows.size(); ++k) {
    EXPECT_LE(belt.residual(a, k), 1.01 * goal) << k;
    const Vec3& n = belt.rows[k].contact.normal;
    const double pressed = dot(a.traction[k], n), along = norm(a.traction[k] - pressed * n);
    if (pressed > 0) ++(along > 0.2999 * pressed ? slips : sticks);
  }
  EXPECT_GT(slips, 20);
  EXPECT_GT(sticks, 20);
}

TEST(NewtonRows, FindTheMotionThatSweepsFind) {
  const Belt belt;
  const Belt::Answer newton = belt.solve(true, 2000), sweeps = belt.solve(false, 1000000);
  ASSERT_TRUE(newton.report.converged && sweeps.report.converged);
  for (std::size_t i = 0; i < belt.velocity.size(); ++i)
    EXPECT_LT(norm(newton.velocity[i] - sweeps.velocity[i]), 1e-3 * norm(belt.velocity[i])) << i;
}

TEST(NewtonRows, SayThatAnIslandHasNoSolution) {
  Belt belt;
  for (ContactRow& row : belt.rows) row.compliance = 0;
  Contact against;  // the same sample, pressed between two bodies that close on it
  against.sample = belt.rows[0].contact.sample;
  against.obstacle = 2;
  against.normal = -belt.rows[0].contact.normal;
  belt.rows.push_back(bodyRow(against, {}, 1.0, false));
  const Belt::Answer a = belt.solve(true, 700);
  EXPECT_FALSE(a.report.converged);
  for (const Vec3& v : a.velocity) EXPECT_TRUE(std::isfinite(norm(v)));
}

}  // namespace
}  // namespace gambeson
