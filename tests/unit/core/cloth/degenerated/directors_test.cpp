/// Directors: turns by the exponential map, and normals of drafts of degree 1.

#include "core/cloth/degenerated/directors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/cloth/degenerated/degenerated_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(Directors, TurnAsRodriguesSays) {
  const Vec3 d = normalized(Vec3{0.2, -0.5, 0.8}), axis = normalized(Vec3{1, 0.4, -0.3});
  for (const double angle : {0.0, 1e-9, 0.9e-4, 1.1e-4, 0.3, kPi, 6.0, 40.0}) {
    const Vec3 exact = rotationAbout(axis, angle) * d, mine = turned(d, angle * axis);
    EXPECT_LT(norm(mine - exact), 1e-15 * (1 + 10 * angle)) << angle;
    EXPECT_NEAR(norm(mine), 1, 1e-15);
  }
}

TEST(Directors, ASpinNormalToThemStaysSo) {
  Vec3 d = normalized(Vec3{0.2, -0.5, 0.8});
  const Vec3 w = cross(d, Vec3{1, 2, 3});
  for (int k = 0; k < 1000; ++k) d = turned(d, 0.37 * w);
  EXPECT_LT(std::abs(dot(d, w)), 1e-12 * norm(w));
}

TEST(Directors, NormalsConvergeToThoseOfTheShape) {
  // A torus, whose curvatures differ along both lines: order 2 inside, and no worse at ends.
  const auto error = [](int n, bool inside) {
    const auto place = [](double a, double b, Vec3& normal) {
      const double around = 1.1 * a, up = 0.2 + 1.3 * b;
      const Vec3 out{std::cos(around), std::sin(around), 0};
      normal = std::cos(up) * out + std::sin(up) * Vec3{0, 0, 1};
      return 2 * out + 0.7 * normal;
    };
    Vec3 normal;
    const NurbsPatch p =
        patchOf(uniformKnots(1, n), uniformKnots(1, n), [&](double a, double b) { return place(a, b, normal); });
    const std::vector<Vec3> normals = normalsOf(p);
    double most = 0;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        if (inside && (i % n == 0 || j % n == 0)) continue;
        place(static_cast<double>(i) / n, static_cast<double>(j) / n, normal);
        most = std::max(most, norm(normals[static_cast<std::size_t>(p.index(i, j))] - normal));
      }
    return most;
  };
  // On arcs of circles with equal cells parabolas are exact inside, and off by the cube at ends.
  EXPECT_LT(error(8, true), 1e-14);
  EXPECT_GT(std::log2(error(8, false) / error(16, false)), 2.8);
  // Unequal cells: the second order.
  const auto uneven = [](int n) {
    double most = 0;
    const NurbsPatch p = patchOf(uniformKnots(1, n), uniformKnots(1, 2), [](double a, double b) {
      const double angle = a + 0.3 * a * a;
      return Vec3{std::sin(angle), b, 1 - std::cos(angle)};
    });
    const std::vector<Vec3> normals = normalsOf(p);
    for (int i = 0; i <= n; ++i) {
      const double a = static_cast<double>(i) / n, angle = a + 0.3 * a * a;
      most = std::max(most, norm(normals[static_cast<std::size_t>(i)] - Vec3{-std::sin(angle), 0, std::cos(angle)}));
    }
    return most;
  };
  EXPECT_GT(std::log2(uneven(16) / uneven(32)), 1.9);
}

TEST(Directors, AreSharedWhereSeamsAreSmooth) {
  // A tube of 8 cells around, closed by a seam.
  const Fabric fabric = isotropicSolid(1e6, 0.3, 0.01);
  Garment tube = sheetOf(8, 2, fabric,
                         [](double a, double b) {
                           return Vec3{std::cos(2 * kPi * a), std::sin(2 * kPi * a), b};
                         },
                         {0, 0, 1});
  tube.seams.push_back({{0, Side::u0, false}, {0, Side::u1, false}, SeamKind::C0});
  const Directors d = directorsOf(tube);
  EXPECT_EQ(d.rest.size(), 24u);
  EXPECT_EQ(d.of_point[0], d.of_point[8]);
  EXPECT_LT(norm(d.rest[0] - Vec3{1, 0, 0}), 1e-12);
  // A prism of 4 faces has creases.
  Garment prism = sheetOf(4, 2, fabric,
                          [](double a, double b) {
                            return Vec3{std::cos(2 * kPi * a), std::sin(2 * kPi * a), b};
                          },
                          {0, 0, 1});
  prism.seams.push_back({{0, Side::u0, false}, {0, Side::u1, false}, SeamKind::C0});
  EXPECT_EQ(directorsOf(prism).rest.size(), 15u);
}

}  // namespace
}  // namespace gambeson
