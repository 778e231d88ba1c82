/// Stress as it is shown: of a sheet that bends, where the strain at single points is locking and not stress.

#include "core/cloth/shell/stress_field.hpp"

#include <gtest/gtest.h>

#include "core/cloth/patches/patch_supports.hpp"
#include "core/statics/statics.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Stretched and turned as one: what every point has, everywhere, also on trimmed sheets and under fibre angles that
/// jump.
TEST(StressField, ShowsAUniformStateAsItIs) {
  const Vec3 e1 = normalized(Vec3{1, 0.4, 0.2}), e3 = normalized(cross(e1, {0, 1, 0})), e2 = cross(e3, e1);
  for (int cells : {1, 2, 5})
    for (int degree : {2, 3})
      for (bool trimmed : {false, true}) {
        Fabric f = plainFabric();
        f.young_warp_Pa = f.young_weft_Pa = 200;
        f.shear_Pa = 80;  // isotropic: fibres may turn
        Garment g = garmentOf({flatPatch(uniformKnots(degree, cells), uniformKnots(degree, 4), 1, 1)}, {}, f);
        if (trimmed) g.trims.push_back({{{circle({0.5, 0.5}, 0.2, 0.2, true)}}});
        g.fields.resize(1);
        g.fields[0].fibre_angle = PatchField{0, 2, 1, {0.3, 1.1}};
        std::vector<Vec3> q;
        for (const Vec3& X : restPoints(g)) q.push_back(1.2 * X.x * e1 + (0.9 * X.y + 0.1 * X.x) * e2);
        const Shell shell(g, widestKernels());
        const StressField field(shell);
        const auto means = field.means(q, {});
        for (double u : {0.0, 0.1, 0.2, 0.35, 0.93, 1.0})
          for (double v : {0.0, 0.25, 0.3, 1.0}) {
            const PrincipalStress exact = shell.stressAt(0, {u, v}, q);
            for (const auto& some : {means, decltype(means){}}) {
              const PrincipalStress shown = field.at(q, 0, {u, v}, some, {});
              EXPECT_NEAR(shown.principal1_N_per_m, exact.principal1_N_per_m, 1e-12);
              EXPECT_NEAR(shown.principal2_N_per_m, exact.principal2_N_per_m, 1e-12);
              EXPECT_NEAR(shown.strain1, exact.strain1, 1e-13);
              EXPECT_NEAR(shown.strain2, exact.strain2, 1e-13);
            }
          }
      }
}

/// A strip clamped level that hangs down: with w the weight per area the pull is w (L - s) sin(slope), whatever its
/// bending stiffness. Strains of (curvature times cell)^2 times 10 kN/m are far more than its 5 N/m.
TEST(StressField, AHangingStripPullsWithTheWeightBelow) {
  for (CellRule rule : {CellRule::automatic, CellRule::full, CellRule::assumed}) {
    Fabric f;
    f.thickness_m = 1e-3;
    f.density_kg_per_m3 = 500;
    f.young_weft_Pa = f.young_warp_Pa = 1e7;
    f.shear_Pa = 5e6;
    f.law = LinearBending{{0.05, 0.05, 0.05}};
    const Garment g = garmentOf({patchOf(uniformKnots(2, 32), uniformKnots(2, 2),
                                         [](double a, double b) {
                                           return Vec3{a, 0.1 * b, 0};
                                         })},
                                {}, f);
    StructureOptions o;
    const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const PatchEdge clamp{0, Side::u0, false};
    o.constraints = supportEdge(g, clamp, all);
    for (LinearConstraint& c : clampRotation(g, clamp)) o.constraints.push_back(std::move(c));
    o.programs = {{{0, 1}, {0, 1}}};
    o.dead = {{weightForce(g, {0, 0, -10}), 0}};
    const auto s = buildStructure(g, o, {.rule = rule});
    std::vector<Vec3> q;
    const StaticReport report = solveStatic(*s, {.steps = 20}, [&](const StaticPoint& p) {
      q = controlPoints(*s, p.y, p.factor);
      return true;
    });
    ASSERT_TRUE(report.reached) << report.why;
    const StressField field(shellOf(*s).elements());
    const auto means = field.means(q, {});
    // The clamp's two cells do not resolve its bend, and the pull there is the smaller of the principal values.
    double shown_off = 0, point_off = 0, far_off = 0;
    for (int k = 0; k <= 400; ++k) {
      const double a = k / 400.0, u = a * g.patches[0].u.back();
      const SurfaceBasis basis = surfaceBasis(g.patches[0], u, 0.5 * g.patches[0].v.back());
      Vec3 along;
      for (std::size_t i = 0; i < basis.columns.size(); ++i) along += basis.values[1][i] * q[basis.columns[i]];
      const double exact = 5 * (1 - a) * -normalized(along).z;
      const Vec2 uv{u, 0.5 * g.patches[0].v.back()};
      const PrincipalStress shown = field.at(q, 0, uv, means, {});
      const double n = std::abs(shown.principal1_N_per_m) > std::abs(shown.principal2_N_per_m)
                           ? shown.principal1_N_per_m
                           : shown.principal2_N_per_m;
      if (a < 0.0625) continue;
      shown_off = std::max(shown_off, std::abs(n - exact));
      point_off = std::max(point_off, std::abs(shellOf(*s).elements().stateAt(0, uv, q).n.x - exact));
      if (a > 0.25) far_off = std::max(far_off, std::abs(n - exact));
    }
    printf("rule %d: shown off by %.3f N/m (%.3f beyond a quarter), single points by %.1f, of 5\n",
           static_cast<int>(rule), shown_off, far_off, point_off);
    EXPECT_LT(shown_off, 0.08 * point_off);
    EXPECT_LT(far_off, 0.03 * 5);
  }
}

}  // namespace
}  // namespace gambeson
