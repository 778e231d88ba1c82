/// Structures of real sheets: mass, reactions, mechanisms, and static, modal and dynamic references.

#include "core/statics/structure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/cloth/patches/patch_supports.hpp"
#include "core/error.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/path.hpp"
#include "core/statics/structure_system.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// A homogeneous isotropic sheet of St. Venant-Kirchhoff material, bending rigidity E h^3/(12 (1 - nu^2)).
Fabric isotropic(double young, double poisson, double thickness, double density = 1) {
  Fabric f;
  f.thickness_m = thickness;
  f.density_kg_per_m3 = density;
  f.young_weft_Pa = f.young_warp_Pa = young;
  f.shear_Pa = young / (2 * (1 + poisson));
  f.poisson = poisson;
  f.law = ConsistentBending{};
  f.rest_curvature_of_shape = true;
  return f;
}

template <class... Lists>
std::vector<LinearConstraint> all(const Lists&... lists) {
  std::vector<LinearConstraint> c;
  (c.insert(c.end(), lists.begin(), lists.end()), ...);
  return c;
}

/// Sze 2004, section 3.1: 10 x 1 x 0.1, E 1.2e6, nu 0, clamped at x = 0.
struct Cantilever {
  Garment garment;
  StructureOptions options;
  explicit Cantilever(int cells, double length = 10) {
    garment =
        garmentOf({flatPatch(uniformKnots(3, cells), uniformKnots(3, 1), length, 1)}, {}, isotropic(1.2e6, 0, 0.1));
    options.constraints = all(supportEdge(garment, {0, Side::u0}, kAxes), clampRotation(garment, {0, Side::u0}));
  }
  Vec3 tip(const Structure& s, const State& state) const {
    return controlPoints(s, state)[garment.patches[0].u.count() - 1];
  }
  Vec3 tip(const Structure& s, std::span<const double> y, double t) const {
    return controlPoints(s, y, t)[garment.patches[0].u.count() - 1];
  }
};

TEST(Structure, MassIsThatOfTheSheet) {
  Cantilever c(3);
  const auto s = buildStructure(c.garment, c.options);
  const double mass = 10 * 1 * 0.1;
  EXPECT_NEAR(std::accumulate(s->lumped_kg.begin(), s->lumped_kg.end(), 0.0), mass, 1e-12);
  EXPECT_NEAR(std::accumulate(s->area_m2.begin(), s->area_m2.end(), 0.0), 10, 1e-12);
  // xT M x = ∫ rho h x^2 dA = rho h L^3/3: a cubic basis reproduces x.
  std::vector<double> x, Mx(s->cloth->map().home.size());
  for (int i : s->cloth->map().home) x.push_back(s->cloth->rest()[i].x);
  s->consistent_kg.multiply<double>(x, Mx);
  EXPECT_NEAR(std::inner_product(x.begin(), x.end(), Mx.begin(), 0.0), 0.1 * 1000 / 3, 1e-9);
}

TEST(Structure, ProgramsAreLinearBetweenPointsAndGoOnInAPath) {
  const Program p{{0, 2, 3}, {1, 5, 4}};
  EXPECT_DOUBLE_EQ(p(-1), 1);
  EXPECT_DOUBLE_EQ(p(0.5), 2);
  EXPECT_DOUBLE_EQ(p(2), 5);
  EXPECT_DOUBLE_EQ(p(7), 4);
  EXPECT_NEAR(p.extended(-1), -1, 1e-12);
  EXPECT_NEAR(p.extended(4), 3, 1e-12);
  EXPECT_DOUBLE_EQ(p.extended(0.5), 2);
  const Program half{{0, 0.5}, {0, 1}};  // flat from 0.5 to 1 and beyond
  EXPECT_DOUBLE_EQ(half.extended(1.5), 1);
  EXPECT_NEAR(half.extended(-0.5), -1, 1e-12);
  EXPECT_DOUBLE_EQ((Program{{0}, {3}}).extended(-2), 3);
}

TEST(Structure, RefusesProgramsAndDampingThatAreNone) {
  Cantilever c(1);
  const auto refuse = [&](const auto& change) {
    StructureOptions o = c.options;
    change(o);
    EXPECT_THROW(buildStructure(c.garment, o), InputError);
  };
  refuse([](auto& o) { o.programs = {{{0, 0}, {0, 1}}}; });
  refuse([](auto& o) { o.programs = {{{0, 1}, {0}}}; });
  refuse([](auto& o) { o.programs = {{{}, {}}}; });
  refuse([](auto& o) { o.programs = {{{0, NAN}, {0, 1}}}; });
  refuse([](auto& o) { o.rayleigh_mass_per_s = -1; });
  refuse([](auto& o) { o.rayleigh_stiffness_s = NAN; });
  refuse([](auto& o) { o.drag_kg_per_m2s = -1; });
  refuse([&](auto& o) { o.dead = {{edgeForce(c.garment, {0, Side::u1}, {0, 0, 1}), 3}}; });
}

std::string mechanismOf(const Garment& garment, const std::vector<LinearConstraint>& constraints,
                        const std::vector<std::vector<Vec3>>& loads = {}, const StaticOptions& options = {}) {
  StructureOptions o;
  o.constraints = constraints;
  for (const std::vector<Vec3>& load : loads) o.dead.push_back({load});
  const auto s = buildStructure(garment, o);
  try {
    const StaticReport r = solveStatic(*s, options, [](const StaticPoint&) { return true; });
    EXPECT_TRUE(r.reached) << r.why;
  } catch (const RunError& e) {
    return e.what();
  }
  return "";
}

TEST(Structure, AMissingSupportIsNamed) {
  const Garment g = Cantilever(4).garment;
  const PatchEdge left{0, Side::u0};
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
  };
  const std::string free = mechanismOf(g, {});
  for (const char* part : {"translation along x", "translation along y", "translation along z", "rotation about x",
                           "rotation about y", "rotation about z"})
    has(free, part);
  const std::string hinge = mechanismOf(g, supportEdge(g, left, kAxes));
  has(hinge, "rotation about y through (0, ");
  EXPECT_EQ(hinge.find("translation"), std::string::npos) << hinge;
  const std::string corner = mechanismOf(g, supportPoint(g, 0, {0, 0}, kAxes));
  for (const char* part : {"rotation about x", "rotation about y", "rotation about z"}) has(corner, part);
  const std::string plane =
      mechanismOf(g, all(supportEdge(g, left, std::vector<Vec3>{{0, 0, 1}}), clampRotation(g, left)));
  has(plane, "translation along x");
  has(plane, "translation along y");
  has(plane, "rotation about z");
  EXPECT_EQ(plane.find("rotation about x"), std::string::npos) << plane;
  EXPECT_EQ(mechanismOf(g, all(supportEdge(g, left, kAxes), clampRotation(g, left))), "");
  // No bending stiffness: the sheet is held as a whole, but its inside is loose.
  Garment limp = g;
  limp.fabric.law = LinearBending{};
  has(mechanismOf(limp, all(supportEdge(limp, left, kAxes), clampRotation(limp, left))), "control point (");
}

/// A strip of 1 m by 5 cm along x, limp (E h = 1000 N/m, B = 8e-9 N m), its first edge hinged, its long edges symmetry
/// edges: it swings about y only.
struct Hanging {
  Garment garment;
  std::vector<LinearConstraint> hinge, sides;
  explicit Hanging(int cells) {
    garment =
        garmentOf({flatPatch(uniformKnots(3, cells), uniformKnots(2, 1), 1, 0.05)}, {}, isotropic(1e8, 0, 1e-5, 1e4));
    hinge = supportEdge(garment, {0, Side::u0}, kAxes);
    sides = all(symmetryEdge(garment, {0, Side::v0}, {0, 1, 0}), symmetryEdge(garment, {0, Side::v1}, {0, 1, 0}));
  }
};

/// Hanging chain (D. Bernoulli 1732): omega_n sqrt(L/g) = j_0n/2, the zeros of J0. At rest the rotation about the hinge
/// has no stiffness; the weight brings it.
TEST(Structure, AStripHangsFromAHingeAndSwingsLikeAChain) {
  Hanging strip(16);
  const double g = 9.81;
  StructureOptions o;
  o.constraints = all(strip.hinge, strip.sides);
  o.dead = {{weightForce(strip.garment, {g, 0, 0})}};
  const auto s = buildStructure(strip.garment, o);
  for (const bool arc : {false, true}) {
    StaticPoint last;
    const StaticReport r =
        solveStatic(*s, {.steps = 2, .arc_length = arc}, [&](const StaticPoint& p) { return last = p, true; });
    ASSERT_TRUE(r.reached) << r.why;
    EXPECT_EQ(last.negative_pivots, 0);
    // It lengthens by rho g L^2/(2 E).
    EXPECT_NEAR(controlPoints(*s, last.y, 1)[strip.garment.patches[0].u.count() - 1].x - 1, 1e4 * g / 2e8, 1e-5);
    const auto modes = naturalModes(*s, last.y, 1, 3);
    const double exact[] = {1.202413, 2.760039, 4.326864};
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(modes[k].omega_rad_per_s / std::sqrt(g), exact[k], 0.01 * exact[k]) << k;
  }
}

/// Loads hold what they do no work on and what their stress makes stiff; nothing else.
TEST(Structure, LoadsHoldOnlyWhatTheirStressHolds) {
  const auto has = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in: " << text;
  };
  Hanging strip(8);
  const Garment& g = strip.garment;
  const auto supports = all(strip.hinge, strip.sides);
  const auto weight = [&](const Vec3& a) { return std::vector<std::vector<Vec3>>{weightForce(g, a)}; };
  EXPECT_EQ(mechanismOf(g, supports, weight({9.81, 0, 0})), "");
  // Across the strip, at any angle, and none at all.
  for (const Vec3& a : {Vec3{0, 0, -9.81}, Vec3{9.81, 0, 0.1}, Vec3{}})
    has(mechanismOf(g, supports, weight(a)), "rotation about y through (0, ");
  has(mechanismOf(g, supports, weight({9.81, 0, 0}), {.linear = true}), "rotation about y through (0, ");
  // From one point: its weight does not hold the turn about the vertical.
  has(mechanismOf(g, all(supportPoint(g, 0, {0, 0.5}, kAxes)), weight({9.81, 0, 0})), "rotation about x");
  // Free: under its weight, and pulled at both ends alike.
  has(mechanismOf(g, {}, weight({9.81, 0, 0})), "translation along x");
  has(mechanismOf(g, {}, {edgeForce(g, {0, Side::u0}, {-1, 0, 0}), edgeForce(g, {0, Side::u1}, {1, 0, 0})}),
      "translation along z");
  // It falls along its only free translation.
  has(mechanismOf(g, all(supportEdge(g, {0, Side::u0}, std::vector<Vec3>{{0, 1, 0}, {0, 0, 1}}), strip.sides),
                  weight({9.81, 0, 0})),
      "translation along x");
}

/// A strip that stands on its hinge is in equilibrium, and not a stable one.
TEST(Structure, AStripThatStandsOnItsHingeIsUnstable) {
  Cantilever c(4);
  StructureOptions o;
  o.constraints = supportEdge(c.garment, {0, Side::u0}, kAxes);
  o.dead = {{weightForce(c.garment, {-1e-3, 0, 0})}};
  int negative = 0;
  const StaticReport r = solveStatic(*buildStructure(c.garment, o), {.steps = 1}, [&](const StaticPoint& p) {
    negative = p.negative_pivots;
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_EQ(negative, 1);
}

/// The inextensible elastica under a dead end force of 4 EI/L^2 (theta'' = -4 f cos theta): U, W at P/Pmax.
TEST(Structure, EndShearAgreesWithTheElastica) {
  struct Row {
    double factor, u, w;
  };
  const std::vector<Row> exact{
      {0.25, 0.56433, 3.01721}, {0.5, 1.60642, 4.93457}, {0.75, 2.5442, 6.03253}, {1, 3.28941, 6.69964}};
  Cantilever c(12);
  c.options.dead = {{edgeForce(c.garment, {0, Side::u1}, {0, 0, 4})}};
  const auto s = buildStructure(c.garment, c.options);
  std::size_t row = 0;
  const StaticReport r = solveStatic(*s, {.steps = 4}, [&](const StaticPoint& p) {
    const Vec3 x = c.tip(*s, p.y, p.factor);
    EXPECT_NEAR(p.factor, exact[row].factor, 1e-12);
    EXPECT_NEAR(10 - x.x, exact[row].u, 1e-3 * 3.28941);
    EXPECT_NEAR(x.z, exact[row].w, 1e-3 * 6.69964);
    EXPECT_LT(p.residual, 1e-8);
    EXPECT_EQ(p.negative_pivots, 0);
    // Reactions balance the load: (0, 0, -4 f) in all.
    Vec3 sum{};
    for (const Vec3& f : reactions(*s, p.y, p.factor)) sum += f;
    EXPECT_NEAR(norm(sum - Vec3{0, 0, -4 * p.factor}), 0, 1e-6);
    ++row;
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_EQ(row, 4u);
}

/// A tip that is moved instead of loaded: the reaction there is the load that moves it so (P = 2 at W = 4.93457).
TEST(Structure, APrescribedTipTakesTheForceThatWouldMoveIt) {
  Cantilever c(12);
  const PatchEdge right{0, Side::u1};
  c.options.constraints =
      all(c.options.constraints, supportEdge(c.garment, right, std::vector<Vec3>{{0, 0, 1}}, {{0, 0, 4.93457}, 0}));
  const auto s = buildStructure(c.garment, c.options);
  double force = 0, energy = 0, work = 0, last_force = 0, last = 0;
  const StaticReport r = solveStatic(*s, {.steps = 8}, [&](const StaticPoint& p) {
    const std::vector<Vec3> f = reactions(*s, p.y, p.factor);
    force = 0;
    for (int i : edgeColumns(c.garment, right).edge) force += f[i].z;
    work += 0.5 * (force + last_force) * 4.93457 * (p.factor - last);  // trapezoidal
    last_force = force, last = p.factor;
    energy = strainEnergy(*s, p.y, p.factor);
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_NEAR(force, 2, 2e-3);
  EXPECT_NEAR(work, energy, 5e-3 * energy);
}

/// A closed circle with the coupling of membrane and bending of eq. 2.9: with a stretch l of the middle surface and the
/// turn th per rest length, the energy per length EA/2 ((l^2 - 1)/2)^2 + EI/2 (l th)^2 gives l^2 = 1 - h^2 th^2/6 and M
/// = EI l^2 th; the tip lies on the arc of length l L and angle th L.
TEST(Structure, EndMomentRollsTheStripUp) {
  Cantilever c(16, 12);
  const double EI = 100, h = 0.1, L = 12, theta = 2 * M_PI / L, l2 = 1 - h * h * theta * theta / 6;
  c.options.moments = {{{0, Side::u1}, EI * l2 * theta}};
  const auto s = buildStructure(c.garment, c.options);
  StaticPoint last;
  const StaticReport r = solveStatic(*s, {.steps = 12}, [&](const StaticPoint& p) { return last = p, true; });
  ASSERT_TRUE(r.reached) << r.why;
  const Vec3 x = c.tip(*s, last.y, 1);
  EXPECT_NEAR(x.x, 0, 1e-3 * L);
  EXPECT_NEAR(x.z, 0, 1e-3 * L);
  const double radius = std::sqrt(l2) / theta;
  double highest = 0;
  for (const Vec3& q : controlPoints(*s, last.y, 1)) highest = std::max(highest, std::abs(q.z));
  EXPECT_NEAR(highest, 2 * radius, 0.1 * radius);  // control points lie a little outside
}

/// Close to the solution the residual's exponent doubles.
TEST(Structure, NewtonConvergesQuadraticallyOnAShell) {
  Cantilever c(8);
  c.options.dead = {{edgeForce(c.garment, {0, Side::u1}, {0, 0, 4})}};
  const auto s = buildStructure(c.garment, c.options);
  StructureSystem system(*s, ProgramEnds::extended);
  PathState state(system);
  EquilibriumAt at(system, 0.1);
  NewtonOptions options;
  options.tolerance = 1e-12;
  options.length_m = system.reach();
  const NewtonReport n = solveNewton(at, options, state.y, state.K, state.solver);
  ASSERT_TRUE(n.converged);
  // The last step above rounding: from below 1e-2 the residual falls at least to 100 times its square.
  int pairs = 0;
  for (std::size_t k = 0; k + 1 < n.residuals.size(); ++k)
    if (n.residuals[k] < 1e-2 && n.residuals[k] > 1e-6) {
      EXPECT_LT(n.residuals[k + 1], 100 * n.residuals[k] * n.residuals[k] + 1e-11);
      ++pairs;
    }
  EXPECT_GE(pairs, 1);
}

/// A quarter of the hinged roof of Sze 2004, section 3.8: u from the crown to the hinge, v from the middle, `shift`
/// away from its axis.
NurbsPatch roofPatch(int degree, int cells, const Vec3& shift = {}) {
  const double R = 2540, theta = 0.1, L = 254;
  NurbsPatch p{uniformKnots(2, 1), uniformKnots(1, 1), {}, {}};
  for (int j : {0, 1})
    for (int i : {0, 1, 2}) {
      const double a = i * theta / 2, r = i == 1 ? R / std::cos(theta / 2) : R;
      p.points.push_back(shift + Vec3{r * std::sin(a), j * L, r * std::cos(a)});
      p.weights.push_back(i == 1 ? std::cos(theta / 2) : 1);
    }
  p = elevateDegree(elevateDegree(p, Direction::u, degree - 2), Direction::v, degree - 1);
  std::vector<double> knots;
  for (int k = 1; k < cells; ++k) knots.push_back(static_cast<double>(k) / cells);
  return insertKnots(insertKnots(p, Direction::u, knots), Direction::v, knots);
}

/// That roof, its straight edges hinged, under a force of 3000 in its middle.
struct Roof {
  std::unique_ptr<Structure> structure;
  explicit Roof(double thickness, int degree = 3, int cells = 4, const Vec3& shift = {}) {
    const Garment g = garmentOf({roofPatch(degree, cells, shift)}, {}, isotropic(3102.75, 0.3, thickness), {0, 1, 0});
    StructureOptions o;
    o.constraints = all(symmetryEdge(g, {0, Side::u0}, {1, 0, 0}), symmetryEdge(g, {0, Side::v0}, {0, 1, 0}),
                        supportEdge(g, {0, Side::u1}, kAxes));
    o.dead = {{pointForce(g, 0, {0, 0}, {0, 0, -3000.0 / 4})}};
    structure = buildStructure(g, o);
  }
};

/// At rest without loads all that is out of balance is rounding: below its estimate on every mesh and wherever the
/// coordinates' origin is, and the estimate is not far above, since it ends iterations.
TEST(Structure, RoundingAtRestIsBelowItsEstimateAndNear) {
  for (const int degree : {2, 3, 4})
    for (const double away : {-2540.0, 0.0, 1e5})
      for (const int cells : {4, 8, 12, 14, 16, 20, 24}) {
        const Roof roof(12.7, degree, cells, {0, 0, away});
        StructureSystem system(*roof.structure, ProgramEnds::extended);
        PathState state(system);
        std::vector<double> r(state.y.size());
        system.residual(state.y, 0, r);
        system.stiffness(state.y, 0, state.K);
        const double estimate = roundingForce(state.K, system.reach());
        EXPECT_LT(norm(r), estimate) << degree << " " << cells << " " << away;
        EXPECT_GT(norm(r), 0.01 * estimate) << degree << " " << cells << " " << away;
      }
}

/// Sze 2004, section 3.8, thickness 12.7: straight edges hinged, central force up to 3000; a quarter of it. The path
/// rises to P/Pmax 0.742 near w = 11, falls to 0.173 near w = 19.5 and rises again (Abaqus S4R).
TEST(Structure, HingedRoofPassesItsLimitPointsByArcLength) {
  const double R = 2540;
  const Roof roof(12.7);
  const auto& s = roof.structure;
  double peak = 0, valley = 1, peak_at = 0, valley_at = 0, last_w = 0;
  bool unstable = false;
  const StaticReport r = solveStatic(*s, {.steps = 20, .arc_length = true}, [&](const StaticPoint& point) {
    const double w = R - controlPoints(*s, point.y, point.factor, ProgramEnds::extended)[0].z;
    EXPECT_GT(w, last_w);
    last_w = w;
    if (w < 15 && point.factor > peak) peak = point.factor, peak_at = w;
    if (w > 15 && point.factor < valley) valley = point.factor, valley_at = w;
    unstable = unstable || point.negative_pivots == 1;
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_TRUE(unstable);
  EXPECT_NEAR(peak, 0.742, 0.01);
  EXPECT_NEAR(peak_at, 11, 0.7);
  EXPECT_NEAR(valley, 0.173, 0.01);
  EXPECT_NEAR(valley_at, 19.5, 0.7);
}

/// The same, half as thick, turns back in displacement too: two limit points of the load, two of the displacement. The
/// default arcs miss none, and a straight line between their points nowhere leaves the path of fine arcs by more than
/// 2 % of the largest load.
TEST(Structure, ThinRoofsPathIsTheSameForAnyFirstArc) {
  struct At {
    double w, factor;
  };
  const Roof roof(6.35);
  const auto follow = [&](int steps, int& limits) {
    std::vector<At> path{{0, 0}};
    const StaticReport r = solveStatic(*roof.structure, {.steps = steps, .arc_length = true, .max_points = 2000},
                                       [&](const StaticPoint& p) {
                                         const Vec3 x = controlPoints(*roof.structure, p.y, p.factor)[0];
                                         path.push_back({2540 - x.z, p.factor});
                                         limits += p.limit_point;
                                         EXPECT_FALSE(p.jumped);
                                         EXPECT_FALSE(p.bifurcation);
                                         return true;
                                       });
    EXPECT_TRUE(r.reached) << r.why;
    return path;
  };
  int limits = 0;
  const std::vector<At> fine = follow(400, limits);
  EXPECT_EQ(limits, 2);
  double largest = 0;  // before the path rises for good
  for (const At& p : fine)
    if (p.w < 17) largest = std::max(largest, p.factor);
  for (const int steps : {1, 3, 10, 40}) {
    limits = 0;
    const std::vector<At> path = follow(steps, limits);
    EXPECT_EQ(limits, 2) << steps;
    // Distance of the fine points from the polygon, with the load in parts of its largest and w in parts of 17.
    double worst = 0;
    for (const At& p : fine) {
      if (p.factor > largest) continue;
      double nearest = 1e9;
      for (std::size_t k = 1; k < path.size(); ++k) {
        const auto at = [&](const At& x) { return Vec3{x.w / 17, x.factor / largest, 0}; };
        const Vec3 d = at(path[k]) - at(path[k - 1]), q = at(p) - at(path[k - 1]);
        const double t = std::clamp(dot(q, d) / dot(d, d), 0.0, 1.0);
        nearest = std::min(nearest, norm(q - t * d));
      }
      worst = std::max(worst, nearest);
    }
    EXPECT_LT(worst, 0.02) << steps;
  }
}

/// A ruler, clamped at one end: bending is 1e-11 of the membrane. omega = 1.8751^2, 4.6941^2 sqrt(E h^2/(12 rho))/L^2.
TEST(Structure, SlenderStripsHaveTheirFrequencies) {
  for (const auto& [length, width, h] : {std::array{1.0, 0.05, 1e-3}, {1.0, 1.0, 1e-4}, {1.0, 0.01, 1e-5}}) {
    const double E = 7e10, rho = 2700;
    const Garment g =
        garmentOf({flatPatch(uniformKnots(3, 24), uniformKnots(3, 3), length, width)}, {}, isotropic(E, 0, h, rho));
    StructureOptions o;
    o.constraints = all(supportEdge(g, {0, Side::u0}, kAxes), clampRotation(g, {0, Side::u0}));
    const auto s = buildStructure(g, o);
    const auto modes = naturalModes(*s, {}, 0, 6);
    ASSERT_EQ(modes.size(), 6u);
    const double c = std::sqrt(E * h * h / (12 * rho)) / (length * length);
    EXPECT_NEAR(modes[0].omega_rad_per_s, 3.516015 * c, 2e-4 * 3.516015 * c);
    for (const Mode& m : modes) {
      EXPECT_LT(m.residual, 1e-9);
      EXPECT_LT(m.rounding, 1e-5);
    }
  }
}

/// omega = pi^2 (m^2 + n^2)/a^2 sqrt(D/(rho h)), D = E h^3/(12 (1 - nu^2)): the second is double.
TEST(Structure, SimplySupportedPlateHasItsFrequencies) {
  const double a = 1, h = 0.01, E = 7e10, nu = 0.3, rho = 2700;
  const Garment g = garmentOf({flatPatch(uniformKnots(3, 8), uniformKnots(3, 8), a, a)}, {}, isotropic(E, nu, h, rho));
  StructureOptions o;
  const std::vector<Vec3> z{{0, 0, 1}};
  for (Side side : {Side::u0, Side::u1, Side::v0, Side::v1})
    o.constraints = all(o.constraints, supportEdge(g, {0, side}, z));
  o.constraints =
      all(o.constraints, supportPoint(g, 0, {0, 0}, kAxes), supportPoint(g, 0, {1, 0}, std::vector<Vec3>{{0, 1, 0}}));
  const auto s = buildStructure(g, o);
  const auto modes = naturalModes(*s, {}, 0, 4);
  ASSERT_EQ(modes.size(), 4u);
  const double unit = M_PI * M_PI / (a * a) * std::sqrt(E * h * h / (12 * (1 - nu * nu) * rho));
  const double expected[] = {2, 5, 5, 8};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(modes[k].omega_rad_per_s, expected[k] * unit, 2e-3 * expected[k] * unit);
  EXPECT_NEAR(modes[1].omega_rad_per_s, modes[2].omega_rad_per_s, 1e-6 * modes[1].omega_rad_per_s);
}

TEST(Structure, AFreeSheetHasSixRigidModes) {
  Cantilever c(6);
  c.options.constraints.clear();
  const auto modes = naturalModes(*buildStructure(c.garment, c.options), {}, 0, 7);
  ASSERT_EQ(modes.size(), 7u);
  for (int k = 0; k < 6; ++k) EXPECT_EQ(modes[k].omega_rad_per_s, 0) << k;
  // A free beam: (4.73004)^2/L^2 sqrt(EI/mu), EI = 100, mu = 0.1.
  const double omega = 4.7300407449 * 4.7300407449 / 100 * std::sqrt(1000.0);
  EXPECT_NEAR(modes[6].omega_rad_per_s, omega, 2e-3 * omega);
}

/// From rest with Newmark (0), generalised-alpha (1) or explicit steps (2), lumped.
State moved(const Structure& s, int scheme, double step_s, double end_s, const Watch& watch = {}) {
  if (scheme == 2) {
    ExplicitSteps steps(s);
    steps.run(end_s, 0, watch);
    return steps.state;
  }
  State state = structureState(s, 0, std::vector<double>(static_cast<std::size_t>(s.dofs.unknowns()), 0.0), {}, {});
  ImplicitSteps(s, {.scheme = scheme == 0 ? ImplicitScheme::newmark : ImplicitScheme::generalised_alpha,
                    .step_s = step_s,
                    .lumped_mass = true})
      .advance(end_s, state, observerOf(watch));
  return state;
}

/// A step of load on the strip, no damping: all schemes conserve the energy, explicit steps best, and agree.
TEST(Structure, SchemesAgreeOnAStripAndKeepItsEnergy) {
  Cantilever c(4);
  c.options.dead = {{edgeForce(c.garment, {0, Side::u1}, {0, 0, 0.05})}};
  c.options.programs = {{{0}, {1}}};
  const auto s = buildStructure(c.garment, c.options);
  double tip[3];
  for (int scheme : {0, 1, 2}) {
    double worst = 0, most = 0;
    const Watch watch = [&](const State&, const State& d, const StepReport&) {
      const DynamicEnergy e = energyOf(*s, d, true);
      worst = std::max(worst, std::abs(e.total()));
      most = std::max(most, e.kinetic);
    };
    const State state = moved(*s, scheme, 0.005, 1, watch);
    EXPECT_EQ(state.time_s, 1);
    EXPECT_GT(most, 1e-4);
    EXPECT_LT(worst, 5e-3 * most);
    tip[scheme] = c.tip(*s, state).z;
  }
  EXPECT_GT(tip[0], 0.05);
  for (int k : {1, 2}) EXPECT_NEAR(tip[k], tip[0], 2e-3 * std::abs(tip[0])) << k;
}

/// Loads that grow on a sheet at rest change accelerations where hardly anything moves: that is no stiffness, and steps
/// stay as long as the sheet allows.
TEST(Structure, ALoadThatComesShortensNoSteps) {
  Cantilever c(4);
  c.options.dead = {{edgeForce(c.garment, {0, Side::u1}, {0, 0, 0.05})}};
  for (const Program& program : {Program{{0, 0.3}, {0, 1}}, Program{{0.1, 0.101}, {0, 1}}}) {
    c.options.programs = {program};
    const auto s = buildStructure(c.garment, c.options);
    ExplicitSteps steps(*s);
    const double stable =
        2 / largestFrequency(*steps.model, steps.stage, steps.state, 60, steps.work).largest_rad_per_s;
    int count = 0;
    steps.run(0.4, 0, [&](const State&, const State&, const StepReport&) { ++count; });
    EXPECT_LT(count, 0.4 / (0.6 * stable));
    EXPECT_GT(c.tip(*s, steps.state).z, 1e-3);
  }
}

/// A clamp that accelerates, z = c t^3: in its frame the sheet carries the weight -6 c t per mass.
TEST(Structure, AMovingClampActsAsAnInertialForce) {
  const double rise = 2;
  Cantilever fixed(4), moving(4);
  fixed.options.dead = {{weightForce(fixed.garment, {0, 0, -6 * rise})}};
  fixed.options.programs = {{{0, 1}, {0, 1}}};
  Program cubic;
  for (int k = 0; k <= 400; ++k) cubic.at.push_back(k / 400.0), cubic.value.push_back(std::pow(k / 400.0, 3));
  moving.options.programs = {cubic};
  moving.options.constraints = all(supportEdge(moving.garment, {0, Side::u0}, kAxes, {{0, 0, rise}, 0}),
                                   clampRotation(moving.garment, {0, Side::u0}));
  const auto a = buildStructure(fixed.garment, fixed.options), b = buildStructure(moving.garment, moving.options);
  for (int scheme : {0, 2}) {
    const double relative = moving.tip(*b, moved(*b, scheme, 0.005, 0.5)).z - rise * 0.125,
                 expected = fixed.tip(*a, moved(*a, scheme, 0.005, 0.5)).z;
    EXPECT_LT(expected, -0.01);
    EXPECT_NEAR(relative, expected, 0.01 * std::abs(expected));
  }
}

}  // namespace
}  // namespace gambeson
