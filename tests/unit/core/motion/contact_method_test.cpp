/// Steps whose contacts with bodies are found by the boxes of Man 2006, section 3.3: sheets of triangles that fall,
/// slide, stick and drape.

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdio>

#include "core/contact/ellipsoid.hpp"
#include "core/contact/penalty.hpp"
#include "core/contact/projection.hpp"
#include "core/error.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kLayer_m = 1e-3, kGravity = 9.81;
constexpr ContactMethod kBoxes[] = {ContactMethod::penalty, ContactMethod::forward_increment,
                                    ContactMethod::projection};

const char* nameOf(ContactMethod method) {
  return method == ContactMethod::penalty ? "box 3" : method == ContactMethod::forward_increment ? "box 4" : "box 5";
}

ContactParameters with(ContactMethod method, double friction, double penalty = 0) {
  ContactParameters c{kLayer_m, friction, 0.01, 1e-4, 2000};
  c.method = method;
  c.penalty_Pa_per_m = penalty;
  return c;
}

const TriangleMesh ground{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};

/// A flat sheet of triangles, whose samples are its points.
struct Sheet {
  std::unique_ptr<Model> model;
  UniformStage stage;
  StepWork work;
  State state, next;
  double mass = 0;

  Sheet(int cells, double side, const Vec3& corner, const Vec3& gravity, const ContactParameters& c,
        std::vector<Obstacle> obstacles, bool self = false, int sheets = 1) {
    std::vector<MeshDraft> all;
    for (int k = 0; k < sheets; ++k) {
      MeshDraft g = flatTriangles(cells, cells, side, side, sheetFabric());
      for (Vec3& x : g.mesh.vertices) x += corner + Vec3{0, 0, 1.5 * k * kLayer_m};
      all.push_back(std::move(g));
    }
    stage.at.resize(obstacles.size());
    stage.velocity.resize(obstacles.size());
    ModelOptions o;
    o.self_contact = self;
    model = buildModel(std::make_shared<TriangleCloth>(std::move(all)), o, {gravity, 0}, c, std::move(obstacles));
    state = initialState(*model, stage, 0, work);
    for (double m : model->mass_kg) mass += m;
  }
  void throwWith(const Vec3& v) {
    for (Vec3& each : state.v) each = v;
    attachSprings(*model, stage, state, work);
  }
  StepReport step(double dt) {
    StepReport r = gambeson::step(*model, stage, state, dt, next, work);
    EXPECT_EQ(r.failure, StepFailure::none) << r.why;
    EXPECT_LE(r.momentum.error(), 1e-9 * r.momentum.scale);
    std::swap(state, next);
    return r;
  }
};

// A7: each point of a flat sheet that falls flat is a node dropped by itself.
TEST(ContactMethod, ADroppedNodeStopsInBoxes4And5) {
  const double dt = 1e-4, v = 0.5, height = 3e-3;
  for (const ContactMethod method : {ContactMethod::forward_increment, ContactMethod::projection}) {
    SCOPED_TRACE(nameOf(method));
    Sheet s(1, 0.1, {0, 0, kLayer_m + height}, {0, 0, -kGravity}, with(method, 0), {{ground, "ground"}});
    s.throwWith({0, 0, -v});
    double impulse = 0, deepest = 0, highest_after = -1, rest = 0;
    bool landed = false;
    const int steps = 1000;
    for (int k = 0; k < steps; ++k) {
      const StepReport r = s.step(dt);
      EXPECT_GE(r.work.dissipated, -1e-15);
      impulse -= r.momentum.obstacles.z;
      landed = landed || norm(r.momentum.obstacles) > 0;
      for (const Vec3& p : s.state.p) {
        deepest = std::max(deepest, kLayer_m - p.z);
        if (landed) highest_after = std::max(highest_after, p.z - kLayer_m);
      }
      if (k > steps / 2) rest = std::max(rest, std::abs(-r.momentum.obstacles.z / (s.mass * kGravity * dt) - 1));
    }
    const double expected = s.mass * (v + kGravity * steps * dt);
    std::printf("[ measured ] %s: depth %.3g m, above after landing %.3g m, rest force off by %.3g, impulse by %.3g\n",
                nameOf(method), deepest, highest_after, rest, impulse / expected - 1);
    EXPECT_TRUE(landed);
    EXPECT_LE(deepest, 1e-12);
    EXPECT_LE(highest_after, 1e-12);
    EXPECT_LE(rest, 1e-10);
    EXPECT_NEAR(impulse / expected, 1, 1e-3);
  }
}

TEST(ContactMethod, ADroppedNodeSinksAndReboundsInBox3) {
  const double rho = sheetFabric().surfaceDensity(), eps = 1e6 * rho, v = 0.5, dt = 2e-5;
  Sheet s(1, 0.1, {0, 0, kLayer_m + 1e-5}, {0, 0, -kGravity}, with(ContactMethod::penalty, 0, eps),
          {{ground, "ground"}});
  s.throwWith({0, 0, -v});
  const double meets = std::sqrt(v * v + 2 * kGravity * 1e-5);
  double deepest = 0, leaves = 0;
  for (int k = 0; k < 1000 && leaves == 0; ++k) {
    const double before = s.state.p[0].z;
    const StepReport r = s.step(dt);
    EXPECT_NEAR(r.work.dissipated, 0, 1e-15);  // it comes back
    deepest = std::max(deepest, kLayer_m - s.state.p[0].z);
    if (before < kLayer_m && s.state.p[0].z >= kLayer_m) leaves = (s.state.p[0].z - before) / dt;
  }
  const double expected = meets * std::sqrt(rho / eps) + rho * kGravity / eps;
  std::printf("[ measured ] box 3: depth %.5g of %.5g m, rebound %.5f\n", deepest, expected, leaves / meets);
  EXPECT_NEAR(deepest / expected, 1, 0.02);
  EXPECT_NEAR(leaves / meets, 1, 0.01);
}

/// What would sink through the layer is stopped at the surface.
TEST(ContactMethod, TooSoftAPenaltyStopsAtTheSurface) {
  const double rho = sheetFabric().surfaceDensity();
  Sheet s(1, 0.1, {0, 0, kLayer_m}, {0, 0, -kGravity}, with(ContactMethod::penalty, 0, 1e4 * rho),
          {{ground, "ground"}});
  s.throwWith({0, 0, -0.5});
  double lowest = 1;
  int impacts = 0;
  for (int k = 0; k < 100; ++k) {
    impacts += s.step(1e-4).impacts;
    for (const Vec3& p : s.state.p) lowest = std::min(lowest, p.z);
  }
  EXPECT_GT(impacts, 0);
  EXPECT_GT(lowest, 0);
}

// A8, incline: g (sin a - mu cos a), or nothing moves.
TEST(ContactMethod, SlidesAndSticksOnASlope) {
  const double angle = 30 * M_PI / 180, dt = 1e-4, rho = sheetFabric().surfaceDensity(), eps = 1e6 * rho;
  const Vec3 gravity = kGravity * Vec3{std::sin(angle), 0, -std::cos(angle)};
  for (const ContactMethod method : kBoxes) {
    SCOPED_TRACE(nameOf(method));
    // At rest, box 3 at the depth that bears the weight.
    const double depth = method == ContactMethod::penalty ? rho * kGravity * std::cos(angle) / eps : 0;
    const auto atRest = [&](double friction) {
      return Sheet(1, 0.1, {0, 0, kLayer_m - depth}, gravity, with(method, friction, eps), {{ground, "ground"}});
    };
    Sheet sliding = atRest(0.2);
    const int steps = 1000, from = 500;
    double way[2] = {};
    for (int k = 0; k < steps; ++k) {
      if (k == from) way[0] = sliding.state.p[0].x;
      sliding.step(dt);
    }
    way[1] = sliding.state.p[0].x;
    const double t0 = from * dt, t1 = steps * dt;
    const double a = 2 * (way[1] - way[0]) / (t1 * t1 - t0 * t0);
    const double expected = kGravity * (std::sin(angle) - 0.2 * std::cos(angle));
    Sheet sticking = atRest(0.61);
    double fastest = 0;
    const Vec3 start = sticking.state.p[0];
    for (int k = 0; k < steps; ++k) {
      sticking.step(dt);
      if (k >= from)
        for (const Vec3& v : sticking.state.v) fastest = std::max(fastest, norm(v));
    }
    const double crept = norm(sticking.state.p[0] - start);
    std::printf("[ measured ] %s: acceleration off by %.3g; sticking at %.3g m/s, crept %.3g m\n", nameOf(method),
                a / expected - 1, fastest, crept);
    EXPECT_NEAR(a / expected, 1, 1e-3);
    if (method == ContactMethod::penalty) continue;
    EXPECT_LT(fastest, 1e-9);
    EXPECT_LT(crept, 1e-10);
  }
}

/// Drapes over a rising ball, with folds that touch: every step's ledger holds (Sheet::step), nothing is inside.
TEST(ContactMethod, TheLedgerHoldsOnABall) {
  for (const ContactMethod method : kBoxes) {
    SCOPED_TRACE(nameOf(method));
    const double rho = sheetFabric().surfaceDensity();
    Sheet s(8, 0.2, {-0.1, -0.1, 0.0525}, {0, 0, -kGravity}, with(method, 0.3, 1e6 * rho),
            {{Ellipsoid{{0.05, 0.06, 0.05}}, "ball"}}, true);
    s.stage.velocity[0] = {0, 0.1, 0.3};
    int contacts = 0, unconverged = 0;
    double worst = 0, deepest = 0, force = 0;
    for (int k = 0; k < 600; ++k) {
      const StepReport r = s.step(2e-4);
      worst = std::max(worst, r.momentum.error() / r.momentum.scale);
      contacts += !s.work.contact_impulses.empty();
      unconverged += !r.contact.converged;
      deepest = std::max(deepest, r.deepest_m);
      if (k >= 300) force -= r.momentum.obstacles.z;
    }
    std::printf("[ measured ] %s: ledger %.3g, %d steps with contact, %d unsolved, mean force %.4f of the weight\n",
                nameOf(method), worst, contacts, unconverged, force / (300 * 2e-4 * s.mass * kGravity));
    EXPECT_LT(worst, 1e-9);
    EXPECT_GT(contacts, 500);
    EXPECT_EQ(unconverged, 0);
    EXPECT_EQ(deepest, 0);
  }
}

/// f of the arm with the layer, of every point that presses at the end of a step, and distance kept.
TEST(ContactMethod, Box5KeepsPointsOnTheArmWithItsLayer) {
  const Ellipsoid arm{{0.175, 0.0570, 0.0570}};
  const EllipsoidMetric bare = ellipsoidMetric(arm),
                        grown = ellipsoidMetric({arm.semi_axes + Vec3{kLayer_m, kLayer_m, kLayer_m}});
  ContactParameters c = with(ContactMethod::projection, 0.5);
  Sheet s(14, 0.12, {0.06, -0.06, 0.057}, {0, 0, -kGravity}, c, {{arm, "arm"}});
  double worst = 0, nearest = 1;
  int pressed = 0;
  for (int k = 0; k < 400; ++k) {
    s.step(2e-4);
    for (std::size_t i = 0; i < s.work.rows.size(); ++i) {
      const ContactRow& row = s.work.rows[i];
      if (row.contact.clearance_m > kLayer_m || s.work.impulses[i] == Vec3{}) continue;
      const Vec3& x = s.state.p[static_cast<std::size_t>(row.contact.sample)];
      worst = std::max(worst, std::abs(ellipsoidFunction(grown, x)));
      nearest = std::min(nearest, closestOnEllipsoid(bare, x).distance_m);
      ++pressed;
    }
  }
  std::printf("[ measured ] |f| at most %.3g at %d points that press; %.3f of the layer kept\n", worst, pressed,
              nearest / kLayer_m);
  EXPECT_GT(pressed, 1000);
  EXPECT_LE(worst, 1e-12);
  EXPECT_GE(nearest, 2 * std::sqrt(0.175 * 0.057) / (0.175 + 0.057) * kLayer_m);
}

/// Two sheets on the ground: it bears both, and the upper one stays above.
TEST(ContactMethod, ClothOnClothStaysWithItsSolve) {
  for (const ContactMethod method : {ContactMethod::forward_increment, ContactMethod::projection}) {
    SCOPED_TRACE(nameOf(method));
    Sheet s(3, 0.05, {0, 0, 1.2 * kLayer_m}, {0, 0, -kGravity}, with(method, 0.3), {{ground, "ground"}}, true, 2);
    double force = 0;
    for (int k = 0; k < 600; ++k) {
      const StepReport r = s.step(1e-4);
      if (k >= 400) force -= r.momentum.obstacles.z / (200 * 1e-4);
      if (k == 599) {
        EXPECT_GT(r.cloth_contacts, 0);
      }
    }
    double lowest[2] = {10, 10};
    const std::size_t half = s.state.p.size() / 2;
    for (std::size_t i = 0; i < s.state.p.size(); ++i)
      lowest[i / half] = std::min(lowest[i / half], s.state.p[i].z / kLayer_m);
    std::printf("[ measured ] %s: %.6f of the weight, sheets at %.4f and %.4f layers\n", nameOf(method),
                force / (s.mass * kGravity), lowest[0], lowest[1]);
    EXPECT_NEAR(force / (s.mass * kGravity), 1, 1e-3);
    EXPECT_NEAR(lowest[0], 1, 1e-3);
    EXPECT_NEAR(lowest[1], 2, 1e-2);
  }
}

TEST(ContactMethod, TheSameBitsForAnyNumberOfThreads) {
  const int most = omp_get_max_threads();
  for (const ContactMethod method : kBoxes) {
    std::vector<Vec3> p[2];
    for (int k = 0; k < 2; ++k) {
      omp_set_num_threads(k == 0 ? 1 : 4);
      Sheet s(26, 0.2, {-0.1, -0.1, kLayer_m}, {2, 0, -kGravity},
              with(method, 0.3, 1e6 * sheetFabric().surfaceDensity()), {{ground, "ground"}});
      s.throwWith({0.3, 0.1, -0.5});
      int rows = 0;
      for (int i = 0; i < 40; ++i) {
        s.step(1e-4);
        rows = std::max(rows, static_cast<int>(s.work.rows.size()));
      }
      EXPECT_GT(rows, 512);
      p[k] = s.state.p;
    }
    omp_set_num_threads(most);
    EXPECT_EQ(p[0], p[1]) << nameOf(method);
  }
}

/// The step is as short as the penalty asks, which no estimate of the cloth's frequency sees.
TEST(ContactMethod, APenaltyShortensTheStep) {
  const double rho = sheetFabric().surfaceDensity();
  const auto longest = [&](double eps) {
    Sheet s(2, 0.1, {0, 0, 1}, {0, 0, -kGravity}, with(ContactMethod::penalty, 0, eps), {{ground, "ground"}});
    Frequency frequency;
    double most_s = 0;
    VelocityVerlet(*s.model, s.stage, {0.9, 1e-3}, frequency, s.work)
        .advance(2e-3, s.state,
                 [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
                   most_s = std::max(most_s, r.step_s);
                 });
    return most_s;
  };
  EXPECT_LE(longest(1e10 * rho), 0.9 * 2 / 1e5);
  EXPECT_GT(longest(1e2 * rho), 2 / 1e5);
}

TEST(ContactMethod, WhatItDoesNotTreatIsRefused) {
  const auto refused = [](const ContactParameters& c, const ModelOptions& o, bool patches) {
    try {
      if (patches) {
        Motion(squareSheet(2, 0.1, 0), {}, c, o);
      } else {
        std::vector<MeshDraft> all{flatTriangles(2, 2, 0.1, 0.1, sheetFabric())};
        buildModel(std::make_shared<TriangleCloth>(std::move(all)), o, {}, c, {});
      }
    } catch (const InputError& e) {
      EXPECT_NE(e.reason().find("allowed"), std::string::npos) << e.reason();
      return e.where().key;
    }
    return std::string("accepted");
  };
  FrictionLaw law = 0.2;
  law.still = 0.3;
  ContactParameters c = with(ContactMethod::forward_increment, 0.3);
  EXPECT_EQ(refused(c, {}, true), "accepted");
  c.friction = law;
  EXPECT_EQ(refused(c, {}, true), "contact.friction");
  c = with(ContactMethod::forward_increment, 0.3);
  ModelOptions limited;
  limited.strain_limit.mode = LimitMode::upper_limit;
  EXPECT_EQ(refused(c, limited, true), "contact.method");
  EXPECT_EQ(refused(with(ContactMethod::penalty, 0.3), {}, true), "contact.penalty");
  EXPECT_EQ(refused(with(ContactMethod::projection, 0.3), {}, true), "contact.method");
  EXPECT_EQ(refused(with(ContactMethod::projection, 0.3), {}, false), "accepted");
}

}  // namespace
}  // namespace gambeson
