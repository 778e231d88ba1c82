/// Energy of explicit steps over a long time, on cloth with a curved bending law.

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/patches/patch_supports.hpp"
#include "core/statics/statics.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Half a millimetre, 200 g/m^2; Zheng's bending law, its root regularised.
Fabric cloth(double young, double bending) {
  Fabric f;
  f.thickness_m = 0.5e-3;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = f.young_warp_Pa = young;
  f.shear_Pa = 0.4 * young;
  f.poisson = 0.25;
  f.law = ZhengBending{{bending, bending, bending / 4}, 30, 5};
  return f;
}

/// The stable step at the start.
double criticalStep(const Structure& s, std::span<const double> y) {
  ExplicitSteps m(s, {}, y);
  return 2 / largestFrequency(*m.model, m.stage, m.state, 60, m.work).largest_rad_per_s;
}

struct Drift {
  double mean = 0;         ///< |mean energy of the last tenth - of the first tenth|
  double fluctuation = 0;  ///< largest |energy - the first|
  double kinetic = 0;      ///< peak
};

Drift driftOver(const Structure& s, std::span<const double> y, double step, int steps) {
  ExplicitSteps m(s, {}, y);
  Drift drift;
  const double energy0 = energyOf(s, m.state, true).total();
  double first = 0, last = 0;
  int n = 0;
  m.run(step * steps, step, [&](const State&, const State& now, const StepReport&) {
    const DynamicEnergy e = energyOf(s, now, true);
    if (n < steps / 10) first += e.total() / (steps / 10);
    if (n >= steps - steps / 10) last += e.total() / (steps / 10);
    drift.fluctuation = std::max(drift.fluctuation, std::abs(e.total() - energy0));
    drift.kinetic = std::max(drift.kinetic, e.kinetic);
    ++n;
  });
  EXPECT_EQ(n, steps);
  drift.mean = std::abs(last - first);
  return drift;
}

/// A quarter of the critical step, 10,000 steps, and half of it over the same time: the mean energy of the last tenth
/// is that of the first within 0.1 % of the peak kinetic energy, and it and the fluctuation fall at least 3.5-fold
/// (velocity Verlet conserves an energy that differs from the true one by O(h^2): Hairer, Lubich and Wanner 2003).
void expectConserved(const Structure& s, std::span<const double> start, double least_kinetic) {
  const double step = 0.25 * criticalStep(s, start);
  const Drift whole = driftOver(s, start, step, 10000), half = driftOver(s, start, step / 2, 20000);
  EXPECT_GT(whole.kinetic, least_kinetic);
  EXPECT_LT(whole.mean, 1e-3 * whole.kinetic);
  EXPECT_GT(half.mean, 1e-10 * half.kinetic);  // far above rounding: the ratio means something
  EXPECT_GE(whole.mean / half.mean, 3.5);
  EXPECT_GE(whole.fluctuation / half.fluctuation, 3.5);
  testing::Test::RecordProperty("mean_over_kinetic", std::to_string(1e9 * whole.mean / whole.kinetic) + "e-9");
  testing::Test::RecordProperty("ratio", std::to_string(whole.mean / half.mean));
}

/// 20 cm x 5 cm, clamped, bent up by a force at its end until its tip stands 17 cm high, and let go: six seconds.
TEST(ExplicitEnergy, ABentStripThatIsLetGoKeepsIt) {
  const Garment g = garmentOf({flatPatch(uniformKnots(3, 6), uniformKnots(3, 1), 0.2, 0.05)}, {}, cloth(30e3, 2e-6));
  StructureOptions o;
  o.constraints = supportEdge(g, {0, Side::u0}, kAxes);
  for (const LinearConstraint& c : clampRotation(g, {0, Side::u0})) o.constraints.push_back(c);
  const auto free = buildStructure(g, o);
  o.dead = {{edgeForce(g, {0, Side::u1}, {0, 0, 0.002})}};
  const auto bent = buildStructure(g, o);
  std::vector<double> y;
  const StaticReport r = solveStatic(*bent, {.steps = 10}, [&](const StaticPoint& p) { return y = p.y, true; });
  ASSERT_TRUE(r.reached) << r.why;
  ASSERT_GT(controlPoints(*bent, y, 1)[g.patches[0].u.count() - 1].z, 0.15);
  expectConserved(*free, y, 0.9 * strainEnergy(*bent, y, 1));
}

/// A flat sheet of 20 cm, held at its corners, falls into its weight's trough and swings: 1.2 s.
TEST(ExplicitEnergy, ASheetThatFallsIntoItsCornersKeepsIt) {
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 4), uniformKnots(2, 4), 0.2, 0.2)}, {}, cloth(3e6, 2e-4));
  StructureOptions o;
  for (const Vec2& c : {Vec2{0, 0}, Vec2{1, 0}, Vec2{0, 1}, Vec2{1, 1}})
    for (const LinearConstraint& held : supportPoint(g, 0, c, kAxes)) o.constraints.push_back(held);
  o.programs = {{{0}, {1}}};
  o.dead = {{weightForce(g, {0, 0, -9.81})}};
  const auto s = buildStructure(g, o);
  expectConserved(*s, {}, 1e-4);
}

}  // namespace
}  // namespace gambeson
