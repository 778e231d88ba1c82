#include "analysis/viewer/packed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "unit/analysis/viewer/page_reader.hpp"

namespace gambeson {
namespace {

/// A sheet of 40 x 40 vertices that walks on and waves, frame by frame.
struct Sheet {
  static constexpr int n = 40;
  std::vector<std::array<int, 3>> triangles;
  std::vector<std::vector<float>> at;
  std::vector<Vec3> origin;
  explicit Sheet(double speed_m_per_s = 1.3, int frames = 30) {
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        const int a = j * n + i;
        triangles.push_back({a, a + 1, a + n});
        triangles.push_back({a + 1, a + n + 1, a + n});
      }
    for (int f = 0; f < frames; ++f) {
      const double t = 0.02 * f;
      origin.push_back({speed_m_per_s * t, 0, 0});
      std::vector<float>& x = at.emplace_back();
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const double u = 0.02 * i, v = 0.02 * j;
          for (const double c : {speed_m_per_s * t + 0.05 * std::sin(9 * v + 7 * t), u + 0.01 * std::sin(5 * t),
                                 v + 0.02 * std::cos(8 * u + 3 * t)})
            x.push_back(static_cast<float>(c));
        }
    }
  }
};

std::vector<int> asInts(const std::vector<std::int16_t>& codes) { return {codes.begin(), codes.end()}; }

TEST(Packed, ParentsAreNeighboursBefore) {
  const std::vector<std::array<int, 3>> triangles{{0, 2, 1}, {4, 2, 1}};
  EXPECT_EQ(parentsOf(6, triangles), (std::vector<int>{-1, 0, 1, -1, 2, -1}));
}

TEST(Packed, CodesComeBackWhateverTheyAre) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> any(-32768, 32767);
  const Sheet sheet;
  const std::size_t vertices = Sheet::n * Sheet::n;
  const std::vector<int> parents = parentsOf(vertices, sheet.triangles);
  for (const std::size_t components : {1u, 3u}) {
    Codes codes{5, vertices, components, {}};
    for (std::size_t i = 0; i < 5 * vertices * components; ++i)
      codes.of.push_back(static_cast<std::int16_t>(any(random)));
    EXPECT_EQ(viewed::unpacked(packed(codes, parents), 5, vertices, components, parents), asInts(codes.of));
  }
}

TEST(Packed, PositionsWithinTheStatedError) {
  const Sheet sheet;
  const PackedPositions p = packedPositions(sheet.at, sheet.origin);
  EXPECT_EQ(p.quantum_m, PackedPositions::kQuantum_m);
  const std::vector<int> parents = parentsOf(p.codes.vertices, sheet.triangles);
  const std::vector<int> back = viewed::unpacked(packed(p.codes, parents), 30, p.codes.vertices, 3, parents);
  double worst_m = 0;
  for (std::size_t t = 0; t < sheet.at.size(); ++t)
    for (std::size_t v = 0; v < p.codes.vertices; ++v) {
      double d2 = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = sheet.origin[t][static_cast<int>(c)] + p.quantum_m * back[(t * p.codes.vertices + v) * 3 + c];
        d2 += std::pow(x - static_cast<double>(sheet.at[t][3 * v + c]), 2);
      }
      worst_m = std::max(worst_m, std::sqrt(d2));
    }
  EXPECT_NEAR(worst_m, p.error_m, 1e-12);  // what a page states is what its reader gets
  EXPECT_LE(worst_m, std::sqrt(3) / 2 * 1e-4);
  EXPECT_LT(worst_m, 1e-4);        // issue 23, P1
  EXPECT_GT(worst_m, 0.5 * 1e-4);  // of 48,000 vertices some are near a corner of their cube
}

TEST(Packed, ALargeSceneHasACoarserQuantum) {
  std::vector<std::vector<float>> at{{0, 0, 0, 40, -10, 3}};
  const PackedPositions p = packedPositions(at, std::vector<Vec3>{{}});
  EXPECT_DOUBLE_EQ(p.quantum_m, 40.0 / 32767);
  EXPECT_EQ(p.codes.of[3], 32767);
  EXPECT_LE(p.error_m, std::sqrt(3) / 2 * p.quantum_m);
}

TEST(Packed, ValuesWithinTheStatedError) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> exponent(-7, 5);
  std::vector<std::vector<float>> values(1);
  for (int i = 0; i < 20000; ++i)
    values[0].push_back(static_cast<float>((i % 2 ? -1 : 1) * std::pow(10, exponent(random))));
  values[0].push_back(0);
  values[0].push_back(std::numeric_limits<float>::quiet_NaN());
  const PackedValues p = packedValues(values);
  for (std::size_t i = 0; i + 1 < values[0].size(); ++i) {
    const double v = values[0][i], bound = 0.5 * PackedValues::kStep * std::hypot(v, p.scale);
    EXPECT_NEAR(p.value(p.codes.of[i]), v, 1.01 * bound);
  }
  EXPECT_EQ(p.codes.of[20000], 0);
  EXPECT_TRUE(std::isnan(p.value(p.codes.of[20001])));
}

/// Motion that neighbours share costs little: 6 bytes of a vertex and frame become less than 1.5.
TEST(Packed, NeighboursSaveRoom) {
  const Sheet sheet;
  const PackedPositions p = packedPositions(sheet.at, sheet.origin);
  const double raw = 2.0 * static_cast<double>(p.codes.of.size());
  const double own = static_cast<double>(packed(p.codes, parentsOf(p.codes.vertices, sheet.triangles)).size());
  const double alone = static_cast<double>(packed(p.codes, std::vector<int>(p.codes.vertices, -1)).size());
  EXPECT_LT(own, 0.25 * raw);
  EXPECT_LT(own, 0.7 * alone);
}

}  // namespace
}  // namespace gambeson
