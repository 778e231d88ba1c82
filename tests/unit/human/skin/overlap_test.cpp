/// Where a surface has folded into itself: two blocks of one mesh of which one reaches into the other.

#include "human/skin/overlap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/contact/obstacle.hpp"

namespace gambeson {
namespace {

/// Adds the surface of a box, n x n squares on each side, outward.
void addBox(TriangleMesh& m, const Vec3& low, const Vec3& high, int n) {
  std::map<std::array<int, 3>, int> known;
  const auto vertex = [&](const std::array<int, 3>& at) {
    const auto [entry, fresh] = known.try_emplace(at, static_cast<int>(m.vertices.size()));
    if (fresh) {
      Vec3 x;
      for (int k = 0; k < 3; ++k) x[k] = low[k] + (high[k] - low[k]) * at[static_cast<std::size_t>(k)] / n;
      m.vertices.push_back(x);
    }
    return entry->second;
  };
  for (std::size_t k = 0; k < 3; ++k)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> at{};
            at[k] = side, at[(k + 1) % 3] = i + a, at[(k + 2) % 3] = j + b;
            return vertex(at);
          };
          std::array<int, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side == 0) std::reverse(q.begin(), q.end());
          m.triangles.push_back({q[0], q[1], q[2]});
          m.triangles.push_back({q[0], q[2], q[3]});
        }
}

/// The second block, 0.6 wide, reaches 0.45 into the first: hidden are its end, 0.36, and 0.45 of its four sides, 1.08,
/// and 0.36 of the first block's side. Triangles on the border count whole, so that the excess falls with their size.
TEST(SkinOverlap, IsWhatLiesWithin) {
  const auto excess = [](int n) {
    TriangleMesh m;
    addBox(m, {0, 0, 0}, {1, 1, 1}, n);
    addBox(m, {0.55, 0.21, 0.22}, {1.437, 0.81, 0.82}, n);
    const Overlap o = overlapOf(m.triangles, m.vertices);
    EXPECT_EQ(o.triangles.size(), m.triangles.size());
    return o.area_m2 - 1.8;
  };
  const double coarse = excess(12), fine = excess(48);
  EXPECT_GT(fine, 0);
  EXPECT_LT(fine, 0.15);
  EXPECT_LT(fine, coarse / 3);
}

TEST(SkinOverlap, IsNoneWhereNothingPassesThrough) {
  TriangleMesh m;
  addBox(m, {0, 0, 0}, {1, 1, 1}, 6);
  addBox(m, {1.001, 0, 0}, {2, 1, 1}, 6);
  const Overlap o = overlapOf(m.triangles, m.vertices);
  EXPECT_EQ(o.area_m2, 0);
  EXPECT_TRUE(std::none_of(o.triangles.begin(), o.triangles.end(), [](char c) { return c; }));
}

/// Two blocks 1 mm apart, the second one larger: cloth that needs 3 mm has no room between them, cloth that needs 0.8
/// mm has. What faces the other block counts, 1 m^2 of each, and triangles on the border of that count whole.
TEST(SkinOverlap, IsWhatLeavesNoRoom) {
  const auto tight = [](int n, double room_m) {
    TriangleMesh m;
    addBox(m, {0, 0, 0}, {1, 1, 1}, n);
    addBox(m, {1.001, -0.31, -0.23}, {2, 1.19, 1.27}, n);
    return overlapOf(m.triangles, m.vertices, room_m).area_m2;
  };
  EXPECT_EQ(tight(6, 0), 0);
  EXPECT_EQ(tight(6, 0.8e-3), 0);
  EXPECT_GE(tight(6, 3e-3), 2 - 1e-9);
  EXPECT_LT(tight(24, 3e-3), 2.6);
}

}  // namespace
}  // namespace gambeson
