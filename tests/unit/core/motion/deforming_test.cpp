/// Obstacles whose vertices move one by one: contacts, friction, impacts and ledgers, against the same motion done by a
/// rigid placement, against closed forms, and against exact intersections.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "core/error.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "exact/scene_intersections.hpp"
#include "unit/core/contact/mesh_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

using Way = std::function<Vec3(const Vec3&, double)>;  ///< of a point of the rest shape at a time

/// One mesh that goes its way: vertex by vertex, or by the placement (`rigid`).
class OneBody : public Stage {
 public:
  TriangleMesh mesh;
  Way way;
  std::function<Placement(double)> rigid, frame;  ///< `frame`: that springs hang on

  void placements(double t, std::span<Placement> obstacles, std::span<Placement> anchors) const override {
    obstacles[0] = rigid ? rigid(t) : Placement{};
    for (Placement& a : anchors) a = frame ? frame(t) : Placement{};
  }
  void vertices(int, double t, std::span<Vec3> x) const override {
    for (std::size_t v = 0; v < x.size(); ++v) x[v] = way(mesh.vertices[v], t);
  }
};

struct Scene {
  OneBody stage;
  std::unique_ptr<Model> model;
  StepWork work;
  State state;
  Frequency frequency;

  Scene(const Garment& g, const TriangleMesh& mesh, Way way, const Vec3& gravity = {0, 0, -9.81}, double friction = 0.3,
        std::function<Placement(double)> rigid = {}, const ModelOptions& options = {},
        std::function<Placement(double)> frame = {}) {
    stage.mesh = mesh;
    stage.way = std::move(way);
    stage.rigid = std::move(rigid);
    stage.frame = std::move(frame);
    model =
        buildModel(g, options, {gravity, 0.288}, {1.2e-3, friction, 0.01, 1e-3, 4000}, {{mesh, "body", !stage.rigid}});
    state = initialState(*model, stage, 0, work);
  }
  void run(double until, const StepObserver& observe = {}) {
    VelocityVerlet(*model, stage, {0.7, 1e-3}, frequency, work)
        .advance(until, state,
                 [&](const State& a, const State& b, const StepReport& r, const StepResult& w, const Frequency& f) {
                   EXPECT_LE(r.momentum.error(), 1e-9 * r.momentum.scale) << "at " << b.time_s;
                   if (observe) observe(a, b, r, w, f);
                 });
  }
  std::vector<Vec3> samples() const {
    std::vector<Vec3> x;
    samplePositions(*model, state.p, x);
    return x;
  }
};

Garment sheetAt(int cells, double side, const Vec3& centre) {
  Garment g = squareSheet(cells, side, 0);
  for (Vec3& x : g.patches[0].points) x += centre - Vec3{0.5 * side, 0.5 * side, 0};
  return g;
}

/// The unit square, about the origin, of side `side`.
TriangleMesh plate(int n, double side) {
  TriangleMesh m = testing_shapes::plane(n);
  for (Vec3& v : m.vertices) v = side * (v - Vec3{0.5, 0.5, 0});
  return m;
}

/// A closed tube about x, bent and pulsating: the centre line is a circle's arc of the curvature k(t).
TriangleMesh tube(double radius, double length, int rings, int segments) {
  TriangleMesh m;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j < segments; ++j) {
      const double a = 2 * M_PI * (j + 0.5 * (i % 2)) / segments;
      m.vertices.push_back(
          {length * (static_cast<double>(i) / rings - 0.5), radius * std::cos(a), radius * std::sin(a)});
    }
  const auto id = [&](int i, int j) { return i * segments + j % segments; };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < segments; ++j) {
      m.triangles.push_back({id(i, j), id(i, j + 1), id(i + 1, j)});
      m.triangles.push_back({id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
    }
  const int first = static_cast<int>(m.vertices.size()), last = first + 1;
  m.vertices.push_back({-0.5 * length, 0, 0});
  m.vertices.push_back({0.5 * length, 0, 0});
  for (int j = 0; j < segments; ++j) {
    m.triangles.push_back({first, id(0, j + 1), id(0, j)});
    m.triangles.push_back({last, id(rings, j), id(rings, j + 1)});
  }
  // Outward.
  double volume = 0;
  for (const auto& [a, b, c] : m.triangles) volume += dot(m.vertices[a], cross(m.vertices[b], m.vertices[c]));
  if (volume < 0)
    for (auto& t : m.triangles) std::swap(t[1], t[2]);
  return m;
}

Vec3 bentTube(const Vec3& X, double t) {
  const double k = 4 * std::sin(8 * t), swell = 1 + 0.1 * std::sin(25 * t), s = X.x, y = swell * X.y, z = swell * X.z;
  if (std::abs(k) < 1e-9) return {s, y, z};
  const double r = 1 / k - z;
  return {r * std::sin(k * s), y, 1 / k - r * std::cos(k * s)};
}

TEST(Deforming, ARigidMotionGivesTheSameContactsAsAPlacement) {
  const TriangleMesh ball = testing_shapes::sphere(0.05, 3);
  const auto place = [](double t) {
    return Placement{rotationAbout(normalized(Vec3{0.2, 1, 0.3}), 3 * t), Vec3{0.2 * t, 0, 0.4 * t}, 1};
  };
  const Garment g = sheetAt(8, 0.1, {0.003, 0.002, 0.0525});
  Scene deforming(g, ball, [&](const Vec3& X, double t) { return place(t) * X; });
  Scene rigid(g, ball, {}, {0, 0, -9.81}, 0.3, place);
  StepReport a, b;
  long contacts = 0;
  double largest = 0;
  State next;
  for (int k = 0; k < 60; ++k) {
    const double dt = 2e-4;
    a = step(*deforming.model, deforming.stage, deforming.state, dt, next, deforming.work);
    ASSERT_EQ(a.failure, StepFailure::none) << a.why;
    std::swap(deforming.state, next);
    b = step(*rigid.model, rigid.stage, rigid.state, dt, next, rigid.work);
    ASSERT_EQ(b.failure, StepFailure::none) << b.why;
    std::swap(rigid.state, next);
    ASSERT_EQ(a.contacts, b.contacts) << k;
    ASSERT_EQ(a.impacts, b.impacts) << k;
    contacts += a.contacts;
    EXPECT_LE(a.momentum.error(), 1e-9 * a.momentum.scale);
    largest = std::max(largest, norm(a.momentum.obstacles));
    EXPECT_LE(norm(a.momentum.obstacles - b.momentum.obstacles), 1e-9 * largest) << k;
    const auto &x = deforming.work.contact_impulses, &y = rigid.work.contact_impulses;
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t i = 0; i < x.size(); ++i) {
      ASSERT_EQ(std::tie(x[i].sample, x[i].feature), std::tie(y[i].sample, y[i].feature));
      EXPECT_LE(norm(x[i].impulse - y[i].impulse), 1e-8 * largest);
      EXPECT_LT(norm(x[i].point - y[i].point), 1e-12);
      // The touched point is that of its vertices, with weights that add up to 1.
      EXPECT_LT(norm(x[i].touched.of(deforming.work.stage.start.vertices[0]) - x[i].point), 1e-12);
      EXPECT_NEAR(x[i].touched.weight[0] + x[i].touched.weight[1] + x[i].touched.weight[2], 1, 1e-12);
      EXPECT_FALSE(y[i].touched.given());
    }
  }
  EXPECT_GT(contacts, 200);
  for (std::size_t i = 0; i < next.p.size(); ++i) EXPECT_LT(norm(deforming.state.p[i] - rigid.state.p[i]), 1e-10);
}

/// Springs above a body that deforms: the force has no part along its normal and is the gradient of the energy, and
/// what the anchors' and the normals' motion does is the work that the energy of a closed system grows by.
TEST(Deforming, SpringsActAlongTheBodyUnderThem) {
  const Garment g = sheetAt(6, 0.2, {0, 0, 0.3});
  const TriangleMesh body = plate(4, 0.5);
  const auto at = [](double t) {
    return Placement{rotationAbout(normalized(Vec3{1, 2, 3}), 30 * t * t), {0.1 * t, 0, 3 * t * t}, 1};
  };
  ModelOptions options;
  options.anchor_count = 1;
  for (int k = 0; k < 4; ++k)
    options.springs.push_back({std::array{0, 12, 156, 168}[k], 0, 2.0 + k, 0, body.triangles[3 + 5 * k]});
  const auto scene = [&] {
    return Scene(
        g, body, [&](const Vec3& x, double t) { return at(t) * x; }, {}, 0.3, {}, options,
        [](double t) {
          return Placement{rotationAbout({0, 1, 0}, 4 * t), {0.2 * t, 0.1 * t, 0.3 * t}, 1};
        });
  };

  Scene s = scene();
  s.state.time_s = 0.05;  // the anchors have gone on, in all directions
  hangSprings(*s.model, s.stage, s.state.anchors, s.state, s.work);
  const Vec3 normal = at(0.05).rotation * Vec3{0, 0, 1};
  Vec3 sum{};
  for (const Vec3& f : s.work.spring_force) {
    EXPECT_GT(norm(f), 1e-3);
    EXPECT_LT(std::abs(dot(f, normal)), 1e-12);
    sum += f;
  }
  const double off = 1e-5;
  for (const Vec3& d : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const auto energy = [&](double h) {
      State moved = s.state;
      for (Vec3& p : moved.p) p += h * d;
      return energyOf(*s.model, s.stage, moved, s.work).springs;
    };
    EXPECT_NEAR(dot(sum, d), -(energy(off) - energy(-off)) / (2 * off), 1e-8);
  }

  const auto error = [&](double dt) {
    Scene m = scene();
    m.model->environment.drag_kg_per_m2s = 0;
    std::fill(m.model->drag_kg_per_s.begin(), m.model->drag_kg_per_s.end(), 0.0);
    const double before = energyOf(*m.model, m.stage, m.state, m.work).total();
    double work = 0;
    State next;
    for (int i = 0; i < std::lround(0.1 / dt); ++i) {
      const StepReport r = step(*m.model, m.stage, m.state, dt, next, m.work);
      EXPECT_EQ(r.failure, StepFailure::none) << r.why;
      work += r.work.supports;
      std::swap(m.state, next);
    }
    EXPECT_GT(work, 1e-4);
    return std::abs(energyOf(*m.model, m.stage, m.state, m.work).total() - before - work) / work;
  };
  const double coarse = error(2e-4), fine = error(1e-4);
  EXPECT_LT(fine, 1e-3);
  EXPECT_LT(fine, 0.4 * coarse);
}

TEST(Deforming, ASheetStaysOnAPlateThatBends) {
  const TriangleMesh mesh = plate(12, 0.3);
  // Waves up and down, and sideways: each vertex its own way.
  const Way way = [](const Vec3& X, double t) {
    const double w = 0.5 * (1 - std::cos(20 * t));
    return X + Vec3{0.004 * w * std::sin(30 * X.y), 0,
                    0.02 * w * std::sin(20 * X.x) + 0.01 * std::sin(15 * t) * X.y / 0.15};
  };
  Scene s(sheetAt(12, 0.15, {0.01, 0.013, 0.0013}), mesh, way);
  const exact::SceneIntersections check(*s.model, s.stage);
  long touched = 0;
  s.run(0.12, [&](const State&, const State& after, const StepReport&, const StepResult& w, const Frequency&) {
    touched += static_cast<long>(w.contact_impulses.size());
    const exact::Intersections found = check.at(after);
    ASSERT_TRUE(found.none()) << after.time_s << " " << (found.pairs.empty() ? "" : check.name(found.pairs[0]));
  });
  EXPECT_GT(touched, 3000);
  // Above: the plate is open, so that intersections alone would not tell.
  DeformedSurfaces surfaces(s.model->obstacles);
  surfaces.move(deformedVertices(*s.model, s.stage, s.state.time_s));
  double least = 1, most = -1;
  for (const Vec3& x : s.samples()) {
    const double d = s.model->proximity->signedDistance(0, {}, x, &surfaces);
    least = std::min(least, d), most = std::max(most, d);
  }
  EXPECT_GT(least, 0.2e-3);
  EXPECT_LT(most, 0.04);
}

TEST(Deforming, FrictionDragsClothAlongWithTheMaterialPointsBelowIt) {
  // A plate that stretches in x at 0.8 /s: below a small sheet at x = 0.1 it moves with 0.08 m/s, on the other side the
  // other way. With a coefficient of 0.5 it is taken along within v/(mu g) = 16 ms.
  for (const double side : {-1.0, 1.0}) {
    const TriangleMesh mesh = plate(10, 0.4);
    const double rate = 0.8;
    Scene s(
        sheetAt(4, 0.03, {side * 0.1, 0.004, 0.00125}), mesh,
        [&](const Vec3& X, double t) {
          return Vec3{X.x * (1 + rate * t), X.y, X.z};
        },
        {0, 0, -9.81}, 0.5);
    Vec3 centre0{}, centre{}, velocity{};
    const std::vector<Vec3> x0 = s.samples();
    for (const Vec3& x : x0) centre0 += x / static_cast<double>(x0.size());
    const double end = 0.1;
    s.run(end);
    const std::vector<Vec3> x1 = s.samples();
    for (const Vec3& x : x1) centre += x / static_cast<double>(x1.size());
    double mass = 0;
    for (int i = 0; i < s.model->freeCount(); ++i) {
      velocity += s.model->mass_kg[i] * s.state.v[i];
      mass += s.model->mass_kg[i];
    }
    velocity = velocity / mass;
    // The material point under the centre: X = x/(1 + rate t), velocity rate X.
    const double material = centre.x / (1 + rate * end);
    std::printf("[ measured ] moves at %.5f m/s on a surface that does at %.5f; gone %.2f mm\n", velocity.x,
                rate * material, 1e3 * (centre.x - centre0.x));
    EXPECT_NEAR(velocity.x, rate * material, 0.02 * rate * 0.1);
    EXPECT_GT(side * (centre.x - centre0.x), 0.006);
    EXPECT_NEAR(velocity.y, 0, 1e-3);
  }
}

TEST(Deforming, FastBodiesMissNothing) {
  // A ball swells at up to 16 m/s under a sheet at rest; a plate throws up a spike between the samples.
  struct Case {
    const char* name;
    TriangleMesh mesh;
    Way way;
    Garment garment;
  };
  const auto rise = [](double t) { return 0.5 * (1 - std::cos(std::min(t, 4e-3) * M_PI / 4e-3)); };
  const Case cases[] = {
      {"swelling ball", testing_shapes::sphere(0.03, 3),
       [=](const Vec3& X, double t) { return (1 + 1.3 * rise(t)) * X; }, sheetAt(10, 0.1, {0.004, 0.003, 0.033})},
      {"spike", plate(8, 0.2),
       [=](const Vec3& X, double t) {
         return norm(X - Vec3{0.025, 0, 0}) < 1e-9 ? X + Vec3{0, 0, 0.04 * rise(t)} : X;
       },
       sheetAt(6, 0.12, {0.004, 0.003, 0.0013})},
  };
  for (const Case& c : cases) {
    Scene s(c.garment, c.mesh, c.way, {0, 0, 0});
    const exact::SceneIntersections check(*s.model, s.stage);
    ASSERT_TRUE(check.at(s.state).none());
    long impacts = 0;
    s.run(0.01, [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
      impacts += r.impacts;
      ASSERT_TRUE(check.at(after).none()) << c.name << " at " << after.time_s;
    });
    EXPECT_GT(impacts, 0) << c.name;
  }
}

TEST(Deforming, ClothInsideOfADeformingBodyComesOutAndWhatIsOutsideIsNotPushed) {
  const TriangleMesh ball = testing_shapes::sphere(0.05, 3);
  const Way way = [](const Vec3& X, double t) {
    return Vec3{(1 + 0.1 * std::sin(30 * t)) * X.x + 0.3 * t, X.y, (1 - 0.1 * std::sin(30 * t)) * X.z};
  };
  Scene s(sheetAt(6, 0.05, {0.001, 0.002, 0.015}), ball, way, {0, 0, 0}, 0.2);
  int inside = 0;
  double free_s = 0;
  s.run(0.15, [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
    inside = std::max(inside, r.inside);
    if (r.deepest_m > 0 || r.intersections > 0) free_s = after.time_s;
  });
  EXPECT_GT(inside, 100);
  EXPECT_LT(free_s, 0.12);
  EXPECT_FALSE(s.state.tangled);
  EXPECT_TRUE(exact::SceneIntersections(*s.model, s.stage).at(s.state).none());

  // Far outside of the ball but within its box, with the ball coming past: no contact, no push.
  Scene far(sheetAt(6, 0.02, {0.045, 0.045, 0.045}), ball, way, {0, 0, 0}, 0.2);
  far.run(0.02, [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
    EXPECT_EQ(r.contacts, 0);
    EXPECT_EQ(r.deepest_m, 0);
  });
  for (const Vec3& v : far.state.v) EXPECT_LT(norm(v), 1e-11);
}

/// What is known to be outside is what a search without knowledge finds, in every step.
TEST(Deforming, WhatIsKnownToBeOutsideIs) {
  const TriangleMesh mesh = tube(0.04, 0.3, 16, 14);
  Scene s(sheetAt(10, 0.16, {0.004, 0.003, 0.043}), mesh, bentTube);
  DeformedSurfaces surfaces(s.model->obstacles);
  std::size_t known = 0, asked = 0;
  s.run(0.12, [&](const State& before, const State&, const StepReport&, const StepResult&, const Frequency&) {
    surfaces.move(deformedVertices(*s.model, s.stage, before.time_s));
    std::vector<Vec3> x;
    samplePositions(*s.model, before.p, x);
    const std::vector<char>& outside = s.work.collisions.near_bodies.outside_of;
    ASSERT_EQ(outside.size(), x.size());
    for (std::size_t i = 0; i < x.size(); ++i, ++asked) {
      if (!outside[i]) continue;
      ++known;
      ASSERT_GT(s.model->proximity->signedDistance(0, {}, x[i], &surfaces), 0) << i;
    }
  });
  EXPECT_GT(known, asked / 2);  // most are in the body's box
}

/// Cloth that did not come there on its own way is asked anew where it is.
/// Points one after the other, along lines that pass through a tube and along its skin, which is how a finer surface is
/// asked about: the same are inside, and as deep, as where each is asked for itself.
TEST(Deforming, PointsInARowAreInsideWhereEachAloneIs) {
  const TriangleMesh skin = tube(0.04, 0.3, 24, 20);
  const std::vector<Obstacle> obstacles{{skin, "tube", true}};
  const ProximityQuery query(obstacles);
  DeformedSurfaces surfaces(obstacles);
  DeformedVertices at(obstacles);
  for (std::size_t v = 0; v < skin.vertices.size(); ++v) at[0][v] = bentTube(skin.vertices[v], 0.13);
  surfaces.move(at);
  std::vector<Vec3> x;
  for (int line = 0; line < 60; ++line)
    for (int k = 0; k <= 80; ++k) {
      const double s = k / 40.0 - 1, angle = 0.37 * line, r = line % 2 ? 0.04 + 0.004 * std::sin(0.4 * k) : 0.09 * s;
      x.push_back(
          bentTube({0.2 * (line % 2 ? s : 0.013 * line - 0.4), r * std::cos(angle), r * std::sin(angle)}, 0.13));
    }
  const Placement none;
  const auto depths = [&](std::span<const Vec3> points) {
    MeshCandidates nothing_near;
    nothing_near.first.assign(points.size() + 1, 0);
    const std::vector<double> reach(points.size(), 0);
    std::vector<Contact> inside;
    query.near({&none, 1}, {&none, 1}, points, reach, inside, &nothing_near, &surfaces);
    std::vector<double> out(points.size(), 0);
    for (const Contact& c : inside) out[c.sample] = c.gap_m;
    return out;
  };
  const std::vector<double> together = depths(x);
  int inside = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double alone = depths({&x[i], 1})[0];
    ASSERT_NEAR(together[i], alone, 1e-15) << i;
    inside += alone < 0;
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, static_cast<int>(x.size()) - 1000);
}

TEST(Deforming, ClothPutInsideOfABodyIsFoundThere) {
  Scene s(
      sheetAt(6, 0.02, {0.045, 0.045, 0.045}), testing_shapes::sphere(0.05, 3),
      [](const Vec3& X, double t) {
        return X + Vec3{0.1 * t, 0, 0};
      },
      {0, 0, 0}, 0.2);
  s.run(0.005);
  for (Vec3& p : s.state.p) p -= Vec3{0.045, 0.045, 0.045};
  attachSprings(*s.model, s.stage, s.state, s.work);
  State next;
  const StepReport r = step(*s.model, s.stage, s.state, 1e-5, next, s.work);
  EXPECT_EQ(r.inside, s.model->surface.size());
  EXPECT_GT(r.deepest_m, 0.03);
}

TEST(Deforming, TheSameBitsForAnyNumberOfThreads) {
  const auto run = [](int threads) {
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    Scene s(sheetAt(10, 0.16, {0.004, 0.003, 0.0415}), tube(0.04, 0.3, 30, 40), bentTube);
    s.run(0.012);
    omp_set_num_threads(before);
    return s.state.p;
  };
  const std::vector<Vec3> one = run(1), two = run(2);
  for (std::size_t i = 0; i < one.size(); ++i) ASSERT_EQ(one[i], two[i]) << i;
}

/// A step that is tried again, or that follows on another state, finds what a fresh one finds.
TEST(Deforming, ScratchOfOtherStepsChangesNothing) {
  const Garment g = sheetAt(10, 0.16, {0.004, 0.003, 0.0415});
  const TriangleMesh mesh = tube(0.04, 0.3, 16, 14);
  Scene s(g, mesh, bentTube);
  s.run(0.05);
  State a, b;
  StepWork fresh;
  ASSERT_EQ(step(*s.model, s.stage, s.state, 1e-4, a, fresh).failure, StepFailure::none);
  ASSERT_EQ(step(*s.model, s.stage, s.state, 3e-4, b, s.work).failure, StepFailure::none);
  ASSERT_EQ(step(*s.model, s.stage, s.state, 1e-4, b, s.work).failure, StepFailure::none);
  for (std::size_t i = 0; i < a.p.size(); ++i) ASSERT_EQ(a.p[i], b.p[i]) << i;
}

TEST(Deforming, SaysWhatIsWrong) {
  const Garment g = sheetAt(4, 0.1, {0, 0, 0.06});
  Scene s(g, testing_shapes::sphere(0.05, 2), [](const Vec3& X, double t) {
    return t > 0.005 ? Vec3{std::nan(""), 0, 0} : X;
  });
  EXPECT_THROW(s.run(0.01), RunError);
  class Silent : public Stage {
    void placements(double, std::span<Placement> o, std::span<Placement>) const override { o[0] = {}; }
  } silent;
  StepWork work;
  State next;
  EXPECT_THROW(step(*s.model, silent, s.state, 1e-4, next, work), std::logic_error);
  EXPECT_THROW(s.model->proximity->signedDistance(0, {}, {0, 0, 0}), std::logic_error);
}

}  // namespace
}  // namespace gambeson
