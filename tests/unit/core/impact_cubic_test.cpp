/// A moving point against a moving triangle: closed forms, and queries whose answer is known exactly.
#include "core/contact/impact_cubic.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

namespace gambeson {
namespace {

using Triangle = std::array<Vec3, 3>;
const Triangle kFlat{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};

double bernsteinAt(const std::array<double, 4>& c, double t) {
  const double s = 1 - t;
  return s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3];
}

TEST(ImpactCubic, WindowsHoldTheKnownRoots) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-0.5, 1.5);
  for (int trial = 0; trial < 5000; ++trial) {
    std::array<double, 3> r{u(rng), u(rng), u(rng)};
    if (trial % 5 == 0) r[1] = r[0];          // a double root
    if (trial % 25 == 0) r[2] = r[1] = r[0];  // a triple root
    // (t - r0)(t - r1)(t - r2) in Bernstein form through its blossom.
    const auto blossom = [&](double a, double b, double c) {
      double sum = 0;
      const double x[3] = {a, b, c};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (j != i) sum += (x[i] - r[0]) * (x[j] - r[1]) * (x[3 - i - j] - r[2]);
      return sum / 6;
    };
    const std::array<double, 4> c{blossom(0, 0, 0), blossom(0, 0, 1), blossom(0, 1, 1), blossom(1, 1, 1)};
    const double zero = 1e-14;
    const TimeWindows w = zerosOfCubic(c, zero);
    for (double root : r) {
      if (root < 0 || root > 1) continue;
      bool held = false;
      for (int i = 0; i < w.count; ++i) held = held || (w.window[i].begin <= root && root <= w.window[i].end);
      ASSERT_TRUE(held) << trial << " " << root;
    }
    for (int i = 0; i < w.count; ++i) {
      ASSERT_LE(std::abs(bernsteinAt(c, 0.5 * (w.window[i].begin + w.window[i].end))), 1e-13);
      if (i > 0) {
        ASSERT_LE(w.window[i - 1].end, w.window[i].begin);
      }
    }
  }
}

TEST(ImpactCubic, PointFallsOnATriangle) {
  const auto hit = movingPointTriangle({0.25, 0.5, 1}, {0.25, 0.5, -3}, kFlat, kFlat);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->time, 0.25, 1e-12);
  EXPECT_NEAR(norm(hit->weights - Vec3{0.25, 0.25, 0.5}), 0, 1e-11);
  EXPECT_FALSE(movingPointTriangle({0.6, 0.6, 1}, {0.6, 0.6, -3}, kFlat, kFlat));
  EXPECT_FALSE(movingPointTriangle({0.25, 0.5, 1}, {0.25, 0.5, 1e-6}, kFlat, kFlat));
  EXPECT_TRUE(movingPointTriangle({0.5, 0.5, 1}, {0.5, 0.5, -1}, kFlat, kFlat)) << "through an edge";
  EXPECT_TRUE(movingPointTriangle({0, 0, 1}, {0, 0, -1}, kFlat, kFlat)) << "through a corner";
}

TEST(ImpactCubic, MotionInThePlaneOfTheTriangle) {
  const auto hit = movingPointTriangle({-1, 0.25, 0}, {1, 0.25, 0}, kFlat, kFlat);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->time, 0.5, 1e-11);
  EXPECT_FALSE(movingPointTriangle({-1, 1.25, 0}, {1, 1.25, 0}, kFlat, kFlat));
  EXPECT_TRUE(movingPointTriangle({0.2, 0.2, 0}, {0.2, 0.2, 0}, kFlat, kFlat)) << "at rest on it";
}

TEST(ImpactCubic, MotionInATiltedPlaneIsNotLostToRounding) {
  // The determinant is nothing but rounding, of either sign: the window of zeros must hold the whole motion.
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (int trial = 0; trial < 5000; ++trial) {
    const Mat3 R = rotationAbout(normalized({u(rng), u(rng), u(rng)}), 3 * u(rng));
    const Vec3 o{u(rng), u(rng), u(rng)}, drift{u(rng), u(rng), 0};
    const auto at = [&](const Vec3& x) { return R * x + o; };
    const Triangle a{at(kFlat[0]), at(kFlat[1]), at(kFlat[2])};
    const Triangle b{at(kFlat[0] + drift), at(kFlat[1] + drift), at(kFlat[2] + drift)};
    // Relative to the triangle the point crosses (1/4, 1/4) half way.
    const Vec3 d = 2 * Vec3{u(rng), u(rng), 0}, m{0.25, 0.25, 0};
    ASSERT_TRUE(movingPointTriangle(at(m - d), at(m + d + drift), a, b)) << trial;
  }
}

TEST(ImpactCubic, FirstOfThreeCoplanarTimes) {
  // The corners move so that the plane through them passes the resting point several times; the time is checked by
  // marching along the exact motion.
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(-1, 1);
  const auto random = [&] { return Vec3{u(rng), u(rng), u(rng)}; };
  int hits = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Triangle a{random(), random(), random()}, b{random(), random(), random()};
    const Vec3 p0 = random(), p1 = random();
    const auto hit = movingPointTriangle(p0, p1, a, b);
    const auto volume = [&](double t) {
      const auto at = [&](const Vec3& x, const Vec3& y) { return (1 - t) * x + t * y; };
      const Vec3 o = at(a[0], b[0]);
      return dot(at(p0, p1) - o, cross(at(a[1], b[1]) - o, at(a[2], b[2]) - o));
    };
    const auto inside = [&](double t) {
      const auto at = [&](const Vec3& x, const Vec3& y) { return (1 - t) * x + t * y; };
      const Vec3 x = at(a[0], b[0]), y = at(a[1], b[1]), z = at(a[2], b[2]), p = at(p0, p1), n = cross(y - x, z - x);
      return dot(cross(y - x, p - x), n) > 0 && dot(cross(z - y, p - y), n) > 0 && dot(cross(x - z, p - z), n) > 0;
    };
    double first = 2;
    for (int k = 0; k < 400 && first > 1; ++k) {
      double l = k / 400.0, r = (k + 1) / 400.0;
      if (volume(l) * volume(r) > 0) continue;
      const bool rising = volume(l) < 0;
      for (int i = 0; i < 60; ++i) ((volume(0.5 * (l + r)) < 0) == rising ? l : r) = 0.5 * (l + r);
      if (inside(l)) first = l;
    }
    if (first <= 1) {
      ++hits;
      ASSERT_TRUE(hit) << trial;
      ASSERT_LE(hit->time, first + 1e-9);
    }
    if (hit) {
      ASSERT_NEAR(volume(hit->time), 0, 1e-10);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(ImpactCubic, MissesNoneOfTheQueriesWithAnExactAnswer) {
  const char* root = std::getenv("GAMBESON_DATA");
  const std::filesystem::path data =
      (root ? std::filesystem::path(root) : std::filesystem::path(GAMBESON_SOURCE_DIR) / "../shared/data") /
      "real/collision/queries";
  if (!std::filesystem::exists(data)) GTEST_SKIP() << "no data at " << data << "; set GAMBESON_DATA";
  int queries = 0, hits = 0, missed = 0, extra = 0;
  for (const auto& folder : std::filesystem::directory_iterator(data)) {
    std::ifstream in(folder.path() / "vertex-face/data_0_0.csv");
    std::vector<Vec3> rows;
    bool truth = false;
    for (std::string line; std::getline(in, line);) {
      std::istringstream cells(line);
      std::string cell;
      double value[7];
      for (double& v : value) {
        ASSERT_TRUE(std::getline(cells, cell, ',')) << folder.path();
        v = std::stod(cell);
      }
      rows.push_back({value[0] / value[1], value[2] / value[3], value[4] / value[5]});
      truth = value[6] != 0;
      if (rows.size() < 8) continue;
      const auto hit = movingPointTriangle(rows[0], rows[4], {rows[1], rows[2], rows[3]}, {rows[5], rows[6], rows[7]});
      ++queries, hits += truth, missed += truth && !hit, extra += hit && !truth;
      // What a conservative test adds are passes closer than rounding tells from contact.
      if (hit) {
        double extent = 0;
        for (const Vec3& x : rows) extent = std::max(extent, norm(x));
        EXPECT_LE(hit->gap_m, 2.1e-13 * extent);
      }
      rows.clear();
    }
    ASSERT_TRUE(rows.empty());
  }
  RecordProperty("queries", queries);
  RecordProperty("hits", hits);
  RecordProperty("extra", extra);
  std::printf("%d queries, %d hits, %d missed, %d extra\n", queries, hits, missed, extra);
  EXPECT_GE(queries, 375);
  EXPECT_GE(hits, 54);
  EXPECT_EQ(missed, 0);
}

}  // namespace
}  // namespace gambeson
