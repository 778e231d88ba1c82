// Jamming: cloth that is crushed in its plane resists the more; above the area ratio nothing changes.
#include "core/material/laws/jamming.hpp"

#include <gtest/gtest.h>

#include "core/cloth/block_law.hpp"
#include "core/cloth/shell/tangent.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric jammingFabric(bool laminated) {
  Fabric f = plainFabric();
  f.jam_area = 0.7;
  if (laminated) f.law = Laminate{{{0.06, 220, 40, 20, 0.25, 0.4}, {0.09, 180, 60, 30, 0.3, -0.9}}};
  return f;
}

/// Nominal stress along the weft at a stretch, the warp kept at `across`.
double pushed(const Fabric& f, double stretch, double across) {
  const double strain[3] = {0.5 * (stretch * stretch - 1), 0.5 * (across * across - 1), 0}, flat[3] = {0, 0, 0};
  return stretch * resultants(pointLaw(f), strain, flat).membrane.resultant[0];
}

TEST(Jamming, CompressionNeverGivesWay) {
  Fabric weak = plainFabric();
  weak.jam_area = 0;
  for (const double across : {0.9, 1.0, 1.1}) {
    bool gave_way = false;
    double last = pushed(jammingFabric(false), 1, across), last_weak = pushed(weak, 1, across);
    for (double stretch = 0.99; stretch > 0.05; stretch -= 0.01) {
      const double now = pushed(jammingFabric(false), stretch, across), without = pushed(weak, stretch, across);
      EXPECT_LT(now, last) << stretch << " across " << across;
      gave_way = gave_way || without > last_weak;
      last = now;
      last_weak = without;
    }
    EXPECT_TRUE(gave_way) << "without jamming";
  }
}

TEST(Jamming, NothingChangesAboveItsArea) {
  Fabric without = plainFabric();
  without.jam_area = 0;
  for (const double stretch : {0.71, 0.9, 1.0, 1.3})
    EXPECT_EQ(pushed(jammingFabric(false), stretch, 1), pushed(without, stretch, 1));
}

class JammedShell : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Laws, JammedShell, testing::Bool(),
                         [](const auto& law) { return law.param ? "laminate" : "plain"; });

/// Energy of a flat sheet squeezed along x: its area times St. Venant-Kirchhoff plus k/8 (s0/s - 1)^2.
TEST_P(JammedShell, HasTheClosedFormsEnergy) {
  const Fabric fabric = jammingFabric(GetParam());
  const NurbsPatch patch = flatPatch(knotsAt(2, {0, 0.4, 1}), knotsAt(2, {0, 0.5, 1}), 1.2, 0.8);
  const Garment g = garmentOf({patch}, {}, fabric);
  const Shell shell(g, widestKernels());
  for (const double stretch : {0.8, 0.65, 0.4}) {
    std::vector<Vec3> q = patch.points;
    for (Vec3& x : q) x.x *= stretch;
    double energy = 0;
    forceOn(shell, q, &energy);
    const Voigt& A = pointLaw(fabric).section.A;
    const double e = 0.5 * (stretch * stretch - 1), r = std::max(0.0, 0.49 / (stretch * stretch) - 1);
    const double expected = 0.96 * (0.5 * A[0] * e * e + 0.125 * jamStiffness(A) * r * r);
    EXPECT_NEAR(energy, expected, 1e-9 * expected) << stretch;
  }
}

/// Force against differences of the energy, tangent against differences of the force, where much of the sheet jams.
TEST_P(JammedShell, ForceAndTangentAreDerivatives) {
  const Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, jammingFabric(GetParam()), turnedWeft());
  const Shell shell(g, widestKernels());
  const FreeMap map = buildFreeMap(g);
  std::vector<Vec3> p = deformedFree(g, map, 0.02);
  for (Vec3& x : p) x = {0.75 * x.x, 0.72 * x.y, 0.75 * x.z};
  const Tangent tangent(shell, map);
  ClothWork work;
  BlockMatrix K;
  tangent.assemble(shell, controlsOf(map, p), work, K, {});
  const auto f = onFree(map, forceOn(shell, controlsOf(map, p)));
  double scale = 0, force_scale = 0;
  for (const double v : K.values) scale = std::max(scale, std::abs(v));
  for (const Vec3& v : f) force_scale = std::max(force_scale, norm(v));
  const double h = 1e-5;
  for (std::size_t i = 0; i < p.size(); i += 3)
    for (int c = 0; c < 3; ++c) {
      std::vector<Vec3> up = p, down = p;
      up[i][c] += h;
      down[i][c] -= h;
      double above = 0, below = 0;
      const auto f1 = onFree(map, forceOn(shell, controlsOf(map, up), &above));
      const auto f0 = onFree(map, forceOn(shell, controlsOf(map, down), &below));
      EXPECT_NEAR(f[i][c], -(above - below) / (2 * h), 1e-6 * force_scale);
      for (int r = 0; r < K.rows(); ++r)
        for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k) {
          const std::size_t other = static_cast<std::size_t>(K.columns[k]), row = static_cast<std::size_t>(r);
          if (row != i && other != i) continue;
          for (int d = 0; d < 3; ++d) {
            const std::size_t j = row == i ? other : row;
            const double held = row == i ? K.values[9 * k + 3 * c + d] : K.values[9 * k + 3 * d + c];
            EXPECT_NEAR(held, -(f1[j][d] - f0[j][d]) / (2 * h), 2e-6 * scale);
          }
        }
    }
}

TEST(Jamming, RejectsWhatIsNoArea) {
  for (const double area : {-0.1, 1.0, std::nan("")}) {
    Fabric f = plainFabric();
    f.jam_area = area;
    EXPECT_THROW(checkFabric(f), InputError) << area;
  }
  Fabric f = jammingFabric(false);
  f.tension_field = true;
  EXPECT_THROW(checkFabric(f), InputError);
}

}  // namespace
}  // namespace gambeson
