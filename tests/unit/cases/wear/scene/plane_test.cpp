/// A sheet that lands and slides on a slope: Zheng 2013, section 3.7.1 (cases/library/inclined_plane.json), and the
/// same with another slope, thickness and discretisation. References are the closed forms of a rigid plate with drag:
///   p = rho g cos(alpha), friction = min(mu p, rho g sin(alpha)), rho the surface density,
///   falling  v = (g/c)(1 - exp(-c t)) down, c = eta/rho,
///   landing  takes the normal velocity at once, and mu times it of the tangential one,
///   sliding  v = v0 exp(-c t) + (a/c)(1 - exp(-c t)), a = g (sin(alpha) - mu cos(alpha)).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// The library's sheet 0.1 m above a slope of `alpha`, whose fall line runs along +x.
Case slope(double alpha_rad, double friction, const std::vector<std::string>& overrides = {}) {
  Case c = libraryCase("inclined_plane", overrides);
  const Vec3 n{std::sin(alpha_rad), 0, std::cos(alpha_rad)}, down{std::cos(alpha_rad), 0, -std::sin(alpha_rad)};
  auto& sheet = std::get<SheetGarment>(c.garments[0].shape);
  sheet.axis_u = down;
  sheet.corner = 0.1 * n - 0.3 * down + Vec3{0, -0.3, 0};
  std::get<PlaneObstacle>(c.obstacles[0].shape).normal = n;
  c.contact.friction = friction;
  return c;
}

struct Landing {
  /// Middle of the first step without normal velocity (the first with contact reaches the layer, the next stays
  /// there), and the velocity down the slope then.
  double time_s = 0, v_m_per_s = 0;
  int steps = 0;
  double rebound_m = 0;                     ///< largest distance above the layer after it
  double depth_m = 0;                       ///< largest distance below it
  double sliding_error = 0;                 ///< of the velocity, relative to the closed form
  double path_m = 0;                        ///< way down the slope after it
  double pressure_Pa = 0, friction_Pa = 0;  ///< means over the last 0.1 s
  double sample_rms = 0;                    ///< of the samples' pressures over the last 10 ms, relative to the mean
  AuditWatch audit;
};

Landing land(const Case& c) {
  SceneRun scene(c);
  const Model& m = scene.model;
  const Vec3 n = std::get<PlaneObstacle>(c.obstacles[0].shape).normal, down{n.z, 0, -n.x};
  const double rho = c.fabric.surfaceDensity(), drag = c.air.drag_kg_per_m2s / rho, g = norm(c.gravity_m_per_s2);
  const double a = g * (n.x - c.contact.friction.kinetic * n.z), area = 0.36;
  Landing l;
  Vec3 received{}, start{};
  std::vector<double> normal(m.surface.size(), 0);
  std::vector<Vec3> x;
  bool landed = false;
  int touched = 0;  // steps with contact
  const double end = *c.time.duration_s;
  const auto watch = [&](const State& before, const State& after, const StepReport& r, const StepResult& w,
                         const Frequency&) {
    l.audit(r);
    // The velocity with which the positions moved, at the middle of the step.
    const Vec3 v = (centreOfMass(m, after) - centreOfMass(m, before)) / r.step_s;
    const double now = after.time_s - 0.5 * r.step_s;
    if (!w.contact_impulses.empty()) ++touched;
    if (!landed && touched > 0 && std::abs(dot(v, n)) < 1e-6) {
      landed = true;
      l.time_s = now;
      l.steps = touched;
      l.v_m_per_s = dot(v, down);
      start = 0.5 * (centreOfMass(m, before) + centreOfMass(m, after));
    }
    if (!landed) return;
    samplePositions(m, after.p, x);
    for (const Vec3& s : x) {
      l.rebound_m = std::max(l.rebound_m, dot(s, n) - *c.contact.layer_m);
      l.depth_m = std::max(l.depth_m, *c.contact.layer_m - dot(s, n));
    }
    const double t = now - l.time_s, decay = std::exp(-drag * t);
    if (a > 0) {
      const double exact = l.v_m_per_s * decay + a / drag * (1 - decay);
      l.sliding_error = std::max(l.sliding_error, std::abs(dot(v, down) / exact - 1));
    }
    if (after.time_s > end - 0.1 + 1e-12) received += r.momentum.obstacles;
    if (after.time_s > end - 0.01 + 1e-12)
      for (const ContactImpulse& i : w.contact_impulses) normal[i.sample] += dot(i.impulse, n);
  };
  scene.run(end - 0.1, watch);
  scene.run(end - 0.01, watch);
  scene.run(end, watch);
  l.pressure_Pa = -dot(received, n) / (area * 0.1);
  l.friction_Pa = dot(received, down) / (area * 0.1);
  const double exact = rho * g * n.z;
  for (int s = 0; s < m.surface.size(); ++s)
    l.sample_rms += std::pow(normal[s] / (m.surface.area_m2[s] * 0.01) / exact - 1, 2) / m.surface.size();
  l.sample_rms = std::sqrt(l.sample_rms);
  l.path_m = dot(centreOfMass(m, scene.state) - start, down);
  std::printf(
      "[ measured ] landing %.4f s in %d steps, %.5f m/s; rebound %.3g um, depth %.3g um; sliding error %.3g %%; path "
      "%.6g mm;\n"
      "             pressure %.5f Pa (%.5f), friction %.5f Pa, samples %.3g %% RMS; audit %.2g over %d steps\n",
      l.time_s, l.steps, l.v_m_per_s, 1e6 * l.rebound_m, 1e6 * l.depth_m, 100 * l.sliding_error, 1e3 * l.path_m,
      l.pressure_Pa, exact, l.friction_Pa, 100 * l.sample_rms, l.audit.worst, l.audit.steps);
  return l;
}

constexpr double k30 = M_PI / 6, k20 = M_PI / 9;

/// Acceptance of what every run has in common. `friction` mu < tan(alpha): slides.
void expectSliding(const Case& c, const Landing& l, double alpha_rad) {
  const double rho = c.fabric.surfaceDensity(), g = 9.8, mu = c.contact.friction.kinetic, drag = c.air.drag_kg_per_m2s / rho;
  const double p = rho * g * std::cos(alpha_rad);
  EXPECT_NEAR(l.pressure_Pa, p, 0.005 * p);
  EXPECT_NEAR(l.friction_Pa, mu * p, 0.005 * mu * p);
  EXPECT_LT(l.sample_rms, 0.05);
  EXPECT_LT(l.rebound_m, 1e-6);
  EXPECT_LT(l.depth_m, 1e-6);
  EXPECT_LT(l.sliding_error, 0.02);
  // 0.1 m less the layer along the normal, with the fall's closed form solved for the time by Newton's method.
  const double way = (0.1 - *c.contact.layer_m) / std::cos(alpha_rad);
  double t = std::sqrt(2 * way / g);
  for (int k = 0; k < 20; ++k) {
    const double v = g / drag * (1 - std::exp(-drag * t));
    t -= (g / drag * t - v / drag - way) / v;
  }
  const double fall = g / drag * (1 - std::exp(-drag * t));
  EXPECT_NEAR(l.time_s, t, 2.1e-3);  // two steps
  EXPECT_LE(l.steps, 2);
  const double expected = fall * (std::sin(alpha_rad) - mu * std::cos(alpha_rad));
  EXPECT_NEAR(l.v_m_per_s, expected, 0.02 * expected);
  EXPECT_LT(l.audit.worst, 1e-9);
}

TEST(InclinedPlane, PressureFrictionAndSlidingOfTheLibraryCase) {
  const Case c = libraryCase("inclined_plane");
  const Landing l = land(c);
  EXPECT_NEAR(l.pressure_Pa, 1.2217, 0.005 * 1.2217);
  EXPECT_NEAR(l.friction_Pa, 0.2443, 0.005 * 0.2443);
  expectSliding(c, l, k30);
}

TEST(InclinedPlane, AnotherSlope) {
  const Case c = slope(k20, 0.2);
  expectSliding(c, land(c), k20);
}

TEST(InclinedPlane, AnotherThickness) {
  const Case c = slope(k30, 0.2, {"fabric.thickness=2.4 mm"});
  expectSliding(c, land(c), k30);
}

TEST(InclinedPlane, SheetOf256QuadraticCells) {
  const Case c = slope(
      k30, 0.2,
      {"garment.sheet.degree=2", "garment.sheet.cells_u=16", "garment.sheet.cells_v=16", "garment.samples_per_cell=2"});
  expectSliding(c, land(c), k30);
}

TEST(InclinedPlane, SticksAboveTheAngleOfFriction) {
  for (const auto& mesh : {std::vector<std::string>{},
                           {"garment.sheet.degree=2", "garment.sheet.cells_u=16", "garment.sheet.cells_v=16"}}) {
    const Case c = slope(k30, 1.05 * std::tan(k30), mesh);
    const Landing l = land(c);
    EXPECT_NEAR(l.pressure_Pa, 1.2217, 0.005 * 1.2217);
    EXPECT_NEAR(l.friction_Pa, 0.7053, 0.005 * 0.7053);
    EXPECT_LT(l.sample_rms, 0.05);
    EXPECT_LT(l.rebound_m, 1e-6);
    EXPECT_LT(std::abs(l.path_m), 1e-6);
    EXPECT_LT(l.audit.worst, 1e-9);
  }
}

// The same bounds for cloth of triangles.
TEST(InclinedPlane, OfTriangles) {
  for (const char* mesh : {"single", "equilateral"}) {
    const std::vector<std::string> triangles{"garment.sheet.cells_u=8", "garment.sheet.cells_v=8",
                                             "garment.model=triangles", std::string("garment.mesh=") + mesh};
    const Case c = slope(k30, 0.2, triangles);
    expectSliding(c, land(c), k30);
    const Landing l = land(slope(k30, 1.05 * std::tan(k30), triangles));
    EXPECT_NEAR(l.friction_Pa, 0.7053, 0.005 * 0.7053);
    EXPECT_LT(std::abs(l.path_m), 1e-6);
    EXPECT_LT(l.audit.worst, 1e-9);
  }
}

TEST(InclinedPlane, SlidesBelowTheAngleOfFriction) {
  const Case c = slope(k30, 0.95 * std::tan(k30));
  const Landing l = land(c);
  expectSliding(c, l, k30);
  // v0 (1 - e)/c + a/c (t - (1 - e)/c), e = exp(-c t).
  const double drag = c.air.drag_kg_per_m2s / c.fabric.surfaceDensity(), a = 9.8 * 0.05 * std::sin(k30),
               t = 1 - l.time_s;
  const double e = std::exp(-drag * t);
  const double path = l.v_m_per_s * (1 - e) / drag + a / drag * (t - (1 - e) / drag);
  EXPECT_NEAR(l.path_m, path, 0.02 * path);
  EXPECT_GT(l.path_m, 0.03);
}

}  // namespace
}  // namespace gambeson
