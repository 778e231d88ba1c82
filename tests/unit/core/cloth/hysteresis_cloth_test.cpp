/// Loops of bending on cloth: a strip bent by a moment against the law's own inverse.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/material/hysteresis.hpp"
#include "core/statics/path.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Curvatures are small, so that what is measured is the law and not how cells follow a circle.
constexpr double kFirst_Nm = 2.92e-5, kLast_Nm = 1e-5, kSpan_per_m = 1;

Stops<kStops> stops() { return stopsOf<kStops>(curveOver(kFirst_Nm, kLast_Nm, kSpan_per_m)); }

/// Without Poisson's contraction, so that a strip bends as a line; stiff in its plane.
Fabric stripFabric(double young_Pa) {
  Fabric f = sheetFabric();
  f.young_weft_Pa = f.young_warp_Pa = young_Pa;
  f.poisson = 0;
  f.shear_Pa = 0.5 * young_Pa;
  const Stops<kStops> s = stops();
  IsotropicHysteresisBending law;
  law.weft_Nm = law.warp_Nm = s.last_Nm;
  law.twist_Nm = 0.5 * s.last_Nm;
  law.shape = s.shape;
  law.first_Nm = {s.first_Nm, s.first_Nm, 0.5 * s.first_Nm};
  law.span_per_m = {s.span_per_m, s.span_per_m, s.span_per_m};
  f.law = law;
  return f;
}

std::unique_ptr<const Cloth> strip(double length, double width, int cells, double young_Pa) {
  return std::make_unique<NurbsShell>(
      garmentOf({flatPatch(uniformKnots(3, cells), uniformKnots(2, 1), length, width)}, {}, stripFabric(young_Pa)));
}

/// Curvature of a line on its way, from the moment: by bisection of copies, a line being its history.
double curvatureFor(BentLine<kStops>& line, double moment) {
  double low = -1e4, high = 1e4;
  for (int i = 0; i < 200; ++i) {
    auto tried = line;
    const double mid = 0.5 * (low + high);
    (tried.bend(mid) > moment ? high : low) = mid;
  }
  line.bend(0.5 * (low + high));
  return 0.5 * (low + high);
}

/// A moment at the end bends a strip to a circle: up, down beyond zero, and up again.
TEST(HysteresisCloth, AStripFollowsTheInverseOfItsLaw) {
  constexpr double length = 0.01, largest_N = 3.5e-5;
  StructureOptions o;
  auto cloth = strip(length, 0.0025, 16, 1e7);
  const PatchEdge clamp{0, Side::u0, false}, tip{0, Side::u1, false};
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  o.constraints = cloth->mounting().holdEdge(clamp, all, {});
  for (LinearConstraint& l : cloth->mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
  o.moments = {{tip, largest_N, 0}};
  o.programs = {{{0, 0.3, 0.8, 1}, {0, 1, -0.6, 0.5}}};
  const Cloth* const c = cloth.get();
  const auto s = buildStructure(std::move(cloth), o);
  BentLine<kStops> line(stops());
  int looked = 0;
  double sign = 0;
  const StaticReport r = solveStatic(*s, {.steps = 40, .halvings = 8, .iterations = 30}, [&](const StaticPoint& p) {
    const double expected = curvatureFor(line, largest_N * o.programs[0](p.factor));
    const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor);
    const double bent = c->stateAt({q, {}, p.history}, 0, c->placeOfDraft(0, {0.5, 0.5})).curvature_change.x;
    if (sign == 0) sign = bent > 0 ? 1 : -1;
    EXPECT_NEAR(sign * bent, expected, 1e-6 * kSpan_per_m) << p.factor;
    ++looked;
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_GE(looked, 40);
}

}  // namespace
}  // namespace gambeson
