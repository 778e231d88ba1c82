#include "core/contact/bluntness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/contact/sharp.hpp"

namespace gambeson {
namespace {

/// A skin of triangles about 12 mm long over bumps and a crease.
class BluntnessTest : public ::testing::Test {
 protected:
  static constexpr int kSide = 24;

  void SetUp() override {
    std::vector<std::array<int, 3>> triangles;
    for (int j = 0; j + 1 < kSide; ++j)
      for (int i = 0; i + 1 < kSide; ++i) {
        const int a = i + kSide * j, b = a + 1, c = a + kSide, d = c + 1;
        triangles.push_back({a, b, d});
        triangles.push_back({a, d, c});
      }
    mesh = contactMesh(kSide * kSide, triangles);
    std::mt19937 random(5);
    std::normal_distribution<double> noise(0, 8e-4);
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double u = 0.012 * i, v = 0.012 * j;
        const double height = 0.02 * std::sin(18 * u) * std::cos(14 * v) + 0.35 * std::abs(v - 0.1) + noise(random);
        x.push_back({u + noise(random), v + noise(random), height});
      }
    velocity.resize(x.size());
    slack.assign(x.size(), 0);
  }

  ListedMotion motion(double horizon) const { return {x, velocity, slack, horizon}; }
  static Box everywhere() { return Box{{-9, -9, -9}, {9, 9, 9}}; }

  ContactMesh mesh;
  std::vector<Vec3> x, velocity;
  std::vector<double> slack;
};

TEST_F(BluntnessTest, WhatCountsAsBluntIsBluntForAsLongAsItHolds) {
  Bluntness bluntness(mesh, std::vector<char>(x.size(), 1));
  bluntness.ask(mesh, motion(1e-3), everywhere());
  const BluntFeatures& blunt = bluntness.features();
  int blunt_edges = 0, sharp_edges = 0, blunt_corners = 0;
  for (char b : blunt.edge) blunt_edges += b;
  for (char b : blunt.vertex) blunt_corners += b;
  for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e) sharp_edges += isSharpEdge(mesh, x, e);
  // Not empty either way: most of the skin is certified, and there is something sharp.
  EXPECT_GT(blunt_edges, static_cast<int>(mesh.edges.size()) / 2);
  EXPECT_GT(blunt_corners, mesh.vertex_count / 2);
  EXPECT_GT(sharp_edges, 50);
  EXPECT_TRUE(bluntness.holds(x));

  // Rigid motions by translation change nothing; noise grows until it does not hold any more.
  std::mt19937 random(7);
  std::normal_distribution<double> noise;
  int held = 0, broken = 0, became_sharp = 0;
  for (double size = 1e-6; size < 4e-3; size *= 1.3) {
    for (int trial = 0; trial < 6; ++trial) {
      std::vector<Vec3> y = x;
      // A single vertex or all of them; along a wave, too, that folds along one direction.
      for (int v = 0; v < static_cast<int>(y.size()); ++v) {
        const double z = trial < 3 ? noise(random) : trial < 5 ? std::cos(3.14159265 * (v % kSide)) : (v == 300);
        y[v] += Vec3{1, 2, 3} + size * Vec3{trial < 3 ? noise(random) : 0, trial < 3 ? noise(random) : 0, z};
      }
      bool sharp = false;
      for (int e = 0; e < static_cast<int>(mesh.edges.size()); ++e)
        sharp = sharp || (blunt.edge[e] && isSharpEdge(mesh, y, e));
      for (int v = 0; v < mesh.vertex_count; ++v) sharp = sharp || (blunt.vertex[v] && isSharpCorner(mesh, y, v));
      const bool holds = bluntness.holds(y);
      ASSERT_FALSE(holds && sharp) << size << " " << trial;
      held += holds;
      broken += !holds;
      became_sharp += sharp;
    }
  }
  EXPECT_GT(held, 50);
  EXPECT_GT(broken, 20);
  EXPECT_GT(became_sharp, 10);
}

TEST_F(BluntnessTest, WhatBendsSoonOrIsFarAwayIsNotLookedAt) {
  Bluntness bluntness(mesh, std::vector<char>(x.size(), 1));
  // The second half folds up at once.
  for (int v = 0; v < static_cast<int>(x.size()); ++v)
    if (v % kSide >= kSide / 2) velocity[v] = {0, 0, 10.0 * (v % 2 ? 1 : -1)};
  bluntness.ask(mesh, motion(1e-3), everywhere());
  int at_rest = 0;
  for (int v = 0; v < static_cast<int>(x.size()); ++v) {
    if (v % kSide >= kSide / 2) {
      EXPECT_FALSE(bluntness.features().vertex[v]) << v;
    }
    at_rest += v % kSide < kSide / 2 - 1 && bluntness.features().vertex[v];
  }
  EXPECT_GT(at_rest, mesh.vertex_count / 4);

  Bluntness near(mesh, std::vector<char>(x.size(), 1));
  near.ask(mesh, motion(1e-3), Box{{-1, -1, -1}, {0.05, 1, 1}});
  for (int v = 0; v < static_cast<int>(x.size()); ++v) {
    if (x[v].x > 0.05) {
      EXPECT_FALSE(near.features().vertex[v]) << v;
    }
  }
  EXPECT_TRUE(Bluntness(mesh, std::vector<char>(x.size(), 0)).empty());
}

}  // namespace
}  // namespace gambeson
