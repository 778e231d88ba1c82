/// The degenerated shell in equilibrium: published plates, the roll-up, the pinched hemisphere.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"
#include "unit/core/cloth/degenerated/degenerated_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

void add(std::vector<LinearConstraint>& to, const std::vector<LinearConstraint>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

void clamp(const Cloth& c, const PatchEdge& edge, StructureOptions& o) {
  add(o.constraints, c.mounting().holdEdge(edge, kAxes, {}));
  add(o.constraints, c.mounting().clampEdge(edge));
}

/// A quarter of the clamped square plate of Man 2006, section 2.3.2.1: side 10, E 1.092e6, nu 0.3, force 1 at its middle,
/// for a deflection of 0.0611 * 1.092e-3... thin: 5.612e-3 at a thickness of 0.1. Returns the deflection times (t/0.1)³.
double clampedPlate(ShellRule rule, double factor, int n, double t, double distort) {
  const auto c = std::make_shared<DegeneratedShell>(flatSheet(n, n, 5, 5, isotropicSolid(1.092e6, 0.3, t), distort),
                                                    DegeneratedOptions{rule, factor, RotaryInertia::exact});
  StructureOptions o;
  add(o.constraints, c->mounting().mirrorEdge({0, Side::u0, false}, {1, 0, 0}));
  add(o.constraints, c->mounting().mirrorEdge({0, Side::v0, false}, {0, 1, 0}));
  clamp(*c, {0, Side::u1, false}, o);
  clamp(*c, {0, Side::v1, false}, o);
  o.dead = {{c->mounting().placeForce(0, {0, 0}, {0, 0, -0.25 * t * t * t / 1e-3}), 0}};
  const auto s = buildStructure(c, o);
  StaticOptions options;
  options.linear = true;
  double w = 0;
  const StaticReport report = solveStatic(*s, options, [&](const StaticPoint& p) {
    w = -controlPoints(*s, p.y, 1)[0].z;
    return true;
  });
  EXPECT_TRUE(report.reached) << report.why;
  return w;
}

TEST(DegeneratedStatics, ClampedPlate) {
  // Man's number: one point, 64 cells of the quarter, 5.62e-3; without shear correction.
  EXPECT_NEAR(clampedPlate(ShellRule::one_point, 1, 8, 0.1, 0), 5.62e-3, 0.005e-3);
  // Thin plate: 5.612e-3, whatever the thickness.
  for (const double t : {0.1, 0.01})
    EXPECT_NEAR(clampedPlate(ShellRule::mitc4, 5.0 / 6, 16, t, 0), 5.612e-3, 0.005 * 5.612e-3) << t;
  EXPECT_NEAR(clampedPlate(ShellRule::mitc4, 5.0 / 6, 16, 0.1, 0.25), 5.612e-3, 0.007 * 5.612e-3);
  // Full integration locks.
  EXPECT_NEAR(clampedPlate(ShellRule::full, 5.0 / 6, 8, 0.1, 0), 0.60e-3, 0.005e-3);
}

struct Rolled {
  double moment = 0;  ///< over EI theta/L
  double tip = 0;     ///< off the exact place, over L
  int iterations = 0;
};

/// A strip 12 x 1 of E 1.2e6, nu 0 (Sze 2004), clamped at one end, the other turned by 2 pi in 20 steps.
Rolled rollUp(ShellRule rule, int n, double t) {
  const double L = 12, E = 1.2e6, EI = E * t * t * t / 12;
  const auto c = std::make_shared<DegeneratedShell>(flatSheet(n, 1, L, 1, isotropicSolid(E, 0, t)),
                                                    DegeneratedOptions{rule, 5.0 / 6, RotaryInertia::exact});
  StructureOptions o;
  clamp(*c, {0, Side::u0, false}, o);
  add(o.constraints, c->mounting().turnEdge({0, Side::u1, false}, {0, -2 * kPi, 0}, 0));
  const auto s = buildStructure(c, o);
  StaticOptions options;
  options.steps = 20;
  Rolled rolled;
  const StaticReport report = solveStatic(*s, options, [&](const StaticPoint& p) {
    rolled.iterations += p.iterations;
    const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor, ProgramEnds::extended);
    const std::vector<double> inner = innerValues(*s, p.y, p.factor, ProgramEnds::extended);
    std::vector<Vec3> f(q.size());
    std::vector<double> torque(inner.size());
    ClothWork work;
    s->cloth->force({q, inner, {}}, {f, torque, {}, nullptr}, work, {});
    double moment = 0;
    for (const int end : {n, 2 * n + 1}) moment += torque[static_cast<std::size_t>(3 * end + 1)];
    const double theta = 2 * kPi * p.factor;
    rolled.moment = moment / (EI * theta / L);
    const Vec3 exact = L / theta * Vec3{std::sin(theta), 0, 1 - std::cos(theta)};
    rolled.tip = norm(q[static_cast<std::size_t>(n)] - exact) / L;
    return true;
  });
  EXPECT_TRUE(report.reached) << report.why;
  return rolled;
}

TEST(DegeneratedStatics, RollsUpToAFullTurn) {
  for (const double t : {0.1, 0.01}) {
    const Rolled coarse = rollUp(ShellRule::mitc4, 16, t), fine = rollUp(ShellRule::mitc4, 32, t);
    EXPECT_NEAR(fine.moment, 1, 0.01) << t;
    EXPECT_LT(fine.tip, 1e-6) << t;
    if (t < 0.05) EXPECT_GT(std::log2((coarse.moment - 1) / (fine.moment - 1)), 1.9);
  }
}

/// Sze 2004, section 3.5: a hemisphere of radius 10 with a hole of 18 degrees, t 0.04, E 6.825e7, nu 0.3, pinched by 400.
struct Hemisphere {
  std::shared_ptr<DegeneratedShell> cloth;
  std::unique_ptr<Structure> structure;
  explicit Hemisphere(int n) {
    Garment g = sheetOf(
        n, n, isotropicSolid(6.825e7, 0.3, 0.04),
        [](double a, double b) {
          const double around = kPi / 2 * a, up = 72 * kPi / 180 * b;
          return 10 * Vec3{std::cos(up) * std::cos(around), std::cos(up) * std::sin(around), std::sin(up)};
        },
        {0, 0, 1});
    cloth = std::make_shared<DegeneratedShell>(g);
    StructureOptions o;
    add(o.constraints, cloth->mounting().mirrorEdge({0, Side::u0, false}, {0, 1, 0}));
    add(o.constraints, cloth->mounting().mirrorEdge({0, Side::u1, false}, {1, 0, 0}));
    add(o.constraints, cloth->mounting().holdPlace(0, {0, 0}, std::vector<Vec3>{{0, 0, 1}}, {}));
    std::vector<Vec3> load = cloth->mounting().placeForce(0, {0, 0}, {200, 0, 0});
    const std::vector<Vec3> other = cloth->mounting().placeForce(0, {1, 0}, {0, -200, 0});
    for (std::size_t i = 0; i < load.size(); ++i) load[i] += other[i];
    o.dead = {{load, 0}};
    structure = buildStructure(cloth, o);
  }
};

TEST(DegeneratedStatics, PinchedHemisphere) {
  const int n = 16;
  const Hemisphere h(n);
  StaticOptions options;
  options.steps = 20;
  int iterations = 0;
  double out = 0, in = 0;
  const StaticReport report = solveStatic(*h.structure, options, [&](const StaticPoint& p) {
    iterations += p.iterations;
    const std::vector<Vec3> q = controlPoints(*h.structure, p.y, p.factor);
    out = q[0].x - 10, in = 10 - q[static_cast<std::size_t>(n)].y;
    return true;
  });
  EXPECT_TRUE(report.reached) << report.why;
  EXPECT_LE(iterations, 140);
  printf("hemisphere %d: %g %g, %d iterations\n", n, out, in, iterations);
}

}  // namespace
}  // namespace gambeson
