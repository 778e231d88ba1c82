/// The shell on cut cells: rigid motions, patch tests, gradient, mirror images, and the explicit step.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/trim_map.hpp"
#include "core/cloth/shell/shell.hpp"
#include "core/motion/model.hpp"
#include "core/motion/step.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Garment trimmedGarment(NurbsPatch patch, std::vector<TrimLoop> loops, const Fabric& fabric, int points = 0) {
  Garment g = garmentOf({std::move(patch)}, {}, fabric);
  g.trims = {{std::move(loops), points}};
  return g;
}

/// Free points at f(rest).
template <class F>
std::vector<Vec3> controls(const Garment& g, const FreeMap& map, F f) {
  std::vector<Vec3> p, q(map.T.rows());
  for (int home : map.home) p.push_back(f(g.patches[0].points[home]));
  map.T.multiply<Vec3>(p, q);
  return q;
}

double largestOf(std::span<const Vec3> f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, norm(v));
  return most;
}

TEST(TrimShell, RigidMotionsMakeNoForce) {
  for (bool flat : {true, false}) {
    const std::vector<double> more{0.1, 0.2, 0.45, 0.7, 0.8, 0.9};
    NurbsPatch patch = unitPatch(2, 8);
    if (!flat)
      patch = insertKnots(insertKnots(curvedPatch(2, 2, true), Direction::u, more), Direction::v,
                          std::vector<double>{0.2, 0.6, 0.8});
    Fabric fabric = plainFabric();
    fabric.rest_curvature_of_shape = true;
    const Garment g = trimmedGarment(patch, {{circle({0.52, 0.5}, 0.35, 0.4, false)}}, fabric);
    const FreeMap map = buildFreeMap(g);
    ASSERT_LT(map.T.column_count, map.T.rows());
    const Shell shell(g, widestKernels());
    ClothWork work;
    std::vector<Vec3> f(map.T.rows()), pushed(map.T.rows());
    const Mat3 R = rotationAbout(normalized(Vec3{1, 2, -1}), 1.1);
    shell.force(controls(g, map, [&](Vec3 X) { return R * X + Vec3{0.3, -2, 1}; }), f, work);
    shell.force(controls(g, map, [](Vec3 X) { return 1.01 * X; }), pushed, work);  // a strain of one hundredth
    EXPECT_LT(largestOf(f), 1e-9 * largestOf(pushed));
  }
}

TEST(TrimShell, UniformStrainLoadsTheRimAsItsTractions) {
  // x = F X has one stress everywhere: f_I = - P ∮ N_I nu ds over the outline of what is kept, here the loop of a disk,
  // with nu ds = (dv, -du). P from the law at a point; the loop by 40 Gauss points per quarter.
  const Fabric fabric = plainFabric();
  for (int p : {2, 3}) {
    const NurbsCurve loop = circle({0.51, 0.48}, 0.37, 0.33, false);
    const Garment g = trimmedGarment(unitPatch(p, 5), {{loop}}, fabric, 10);
    const FreeMap map = buildFreeMap(g);
    const Shell shell(g, widestKernels(), 0, CellRule::full);
    const Vec3 a1{1.1, 0.07, 0.02}, a2{-0.04, 0.93, 0.1};
    const auto q = controls(g, map, [&](Vec3 X) { return X.x * a1 + X.y * a2; });
    const Vec3 n = shell.stateAt(0, {0.4, 0.5}, q).n;
    const Vec3 P1 = n.x * a1 + n.z * a2, P2 = n.z * a1 + n.y * a2;  // first Piola-Kirchhoff columns
    ClothWork work;
    std::vector<Vec3> f(map.T.rows()), expected(map.T.rows());
    shell.force(q, f, work);
    const Quadrature rule = gaussLegendre(40);
    for (int quarter = 0; quarter < 4; ++quarter)
      for (int piece = 0; piece < 64; ++piece)
        for (std::size_t k = 0; k < rule.points.size(); ++k) {
          const double dt = 0.25 / 64, t = 0.25 * quarter + dt * (piece + rule.points[k]);
          const CurvePoint c = curvePoint(loop, t);
          const SurfaceBasis b = surfaceBasis(g.patches[0], c.point.x, c.point.y);
          for (std::size_t i = 0; i < b.columns.size(); ++i)
            expected[b.columns[i]] -= rule.weights[k] * dt * b.values[0][i] * (c.tangent.y * P1 - c.tangent.x * P2);
        }
    double worst = 0;
    for (std::size_t i = 0; i < f.size(); ++i) worst = std::max(worst, norm(f[i] - expected[i]));
    EXPECT_LT(worst, 1e-7 * largestOf(expected)) << p;
  }
}

TEST(TrimShell, UniformBendingIsExact) {
  // z = k x^2 / 2 with a small k: free points at the coefficients of the polynomial; the followers continue it, so that
  // every point of every cut cell has the curvature k.
  for (int p : {2, 3}) {
    const Garment g = trimmedGarment(unitPatch(p, 10), {{circle({0.5, 0.5}, 0.4, 0.37, false)}}, plainFabric());
    const FreeMap map = buildFreeMap(g);
    const NurbsPatch& patch = g.patches[0];
    const double k = 1e-5;
    std::vector<Vec3> free, q(map.T.rows());
    for (int home : map.home) {
      const int i = home % patch.u.count();
      double pairs = 0;  // the blossom of u^2
      for (int a = 1; a <= p; ++a)
        for (int b = a + 1; b <= p; ++b) pairs += patch.u.knots[i + a] * patch.u.knots[i + b];
      Vec3 x = patch.points[home];
      x.z = 0.5 * k * pairs / (p * (p - 1) / 2);
      free.push_back(x);
    }
    map.T.multiply<Vec3>(free, q);
    int followers = 0;
    for (const auto& [control, f] : trimFollowers(g)) followers += f.supported;
    EXPECT_GT(followers, 4);
    const Shell shell(g, widestKernels());
    for (const TrimmedCell& cell : trimCells(patch, g.trims[0]))
      for (const CellPoint& at : cell.points) {
        const Vec3 kappa = shell.curvatureAt(0, {at.u, at.v}, q);
        EXPECT_NEAR(kappa.x, k, 1e-8 * k);
        EXPECT_NEAR(kappa.y, 0, 1e-8 * k);
        EXPECT_NEAR(kappa.z, 0, 1e-8 * k);
      }
  }
}

TEST(TrimShell, ForceIsTheGradientOfTheEnergy) {
  const Garment g = trimmedGarment(unitPatch(2, 5), {{circle({0.53, 0.47}, 0.24, 0.29, true)}}, plainFabric());
  const FreeMap map = buildFreeMap(g);
  const Shell shell(g, widestKernels());
  ClothWork work;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> d(-1, 1);
  const auto q = controls(g, map, [&](Vec3 X) { return X + 0.02 * Vec3{d(random), d(random), d(random)}; });
  std::vector<Vec3> f(q.size()), step(q.size()), shifted(q.size()), unused(q.size());
  shell.force(q, f, work);
  for (int trial = 0; trial < 5; ++trial) {
    double expected = 0, energy[2];
    for (std::size_t i = 0; i < q.size(); ++i) {
      step[i] = {d(random), d(random), d(random)};
      expected -= dot(f[i], step[i]);
    }
    for (int side : {0, 1}) {
      for (std::size_t i = 0; i < q.size(); ++i) shifted[i] = q[i] + (side == 0 ? -1e-6 : 1e-6) * step[i];
      shell.force(shifted, unused, work, &energy[side]);
    }
    EXPECT_NEAR((energy[1] - energy[0]) / 2e-6, expected, 1e-6 * std::abs(expected) + 1e-8);
  }
}

TEST(TrimShell, MirroredHolesGiveMirroredForces) {
  const int cells = 8;
  const TrimLoop hole{circle({0.43, 0.56}, 0.2, 0.27, true)};
  const Garment a = trimmedGarment(unitPatch(2, cells), {hole}, plainFabric());
  const Garment b = trimmedGarment(unitPatch(2, cells), {mirroredU(hole)}, plainFabric());
  const FreeMap ma = buildFreeMap(a), mb = buildFreeMap(b);
  const auto field = [](Vec3 X) {
    return Vec3{X.x + 0.05 * std::sin(3 * X.y), X.y - 0.03 * X.x * X.x, 0.1 * std::cos(4 * X.x + X.y)};
  };
  const auto qa = controls(a, ma, field);
  const auto qb = controls(b, mb, [&](Vec3 X) {
    const Vec3 x = field({1 - X.x, X.y, X.z});
    return Vec3{1 - x.x, x.y, x.z};
  });
  ClothWork work;
  std::vector<Vec3> fa(qa.size()), fb(qb.size());
  Shell(a, widestKernels()).force(qa, fa, work);
  Shell(b, widestKernels()).force(qb, fb, work);
  const int n = a.patches[0].u.count();
  for (int c = 0; c < static_cast<int>(fa.size()); ++c) {
    const Vec3 other = fb[n - 1 - c % n + n * (c / n)];
    EXPECT_LT(norm(fa[c] - Vec3{-other.x, other.y, other.z}), 1e-10 * largestOf(fa));
  }
}

class Still : public Stage {
  void placements(double, std::span<Placement>, std::span<Placement>) const override {}
};

TEST(TrimShell, TheModelsStepIsThatOfTheUntrimmedSheet) {
  // The same sheet with a hole that moves through a cell; a fabric whose step the membrane governs, and one that
  // bending governs. The step is 2 / omega (core/motion/step.hpp).
  for (int p : {2, 3})
    for (bool stiff_bending : {false, true}) {
      Fabric fabric = plainFabric();
      const double bending = stiff_bending ? 30 : 1e-5;
      rigidities(fabric).stiffen(bending);
      const auto omega = [&](const Garment& g) {
        const auto model = buildModel(g, {}, {}, {}, {});
        double mass = 0, area = 0;
        for (double m : model->mass_kg) {
          EXPECT_GT(m, 0);
          mass += m;
        }
        for (double a : controlAreas(g)) area += a;
        EXPECT_NEAR(mass, fabric.surfaceDensity() * area, 1e-12 * mass);
        Still stage;
        StepWork work;
        State state = initialState(*model, stage, 0, work);
        const Frequency f = largestFrequency(*model, stage, state, 40, work);
        EXPECT_STREQ(f.governing(), stiff_bending ? "bending" : "membrane");
        return f.largest_rad_per_s;
      };
      const double whole = omega(garmentOf({unitPatch(p, 6)}, {}, fabric));
      double most = 0;
      for (int k = 0; k < 4; ++k) {
        const double s = (k + 0.5) / 4 / 6;
        most = std::max(most, omega(trimmedGarment(unitPatch(p, 6),
                                                   {{circle({0.44 + s, 0.45 + 0.6 * s}, 0.27, 0.27, true)}}, fabric)));
      }
      RecordProperty("step_ratio_" + std::to_string(p) + (stiff_bending ? "_bending" : "_membrane"),
                     std::to_string(whole / most));
      EXPECT_GT(whole / most, 0.5);  // measured 1.0
    }
}

}  // namespace
}  // namespace gambeson
