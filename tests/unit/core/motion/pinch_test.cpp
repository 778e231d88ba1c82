/// Cloth between two bodies that close on it until they overlap, and part again: what no velocities can satisfy must
/// neither throw the cloth about nor hold it for ever.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/contact/crossing.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Two pyramids on a square, base to base: a ball of three rings and four segments.
TriangleMesh pyramids(double radius) {
  TriangleMesh m;
  m.vertices = {{0, 0, radius}, {0, 0, -radius}};
  const double r = radius * std::sin(kPi / 3), z = radius * std::cos(kPi / 3);
  for (double side : {1.0, -1.0})
    for (int k = 0; k < 4; ++k) m.vertices.push_back({r * std::cos(k * kPi / 2), r * std::sin(k * kPi / 2), side * z});
  for (int k = 0; k < 4; ++k) {
    const int n = (k + 1) % 4, a = 2 + k, b = 2 + n, c = 6 + k, d = 6 + n;
    m.triangles.insert(m.triangles.end(), {{0, a, b}, {a, c, b}, {b, c, d}, {1, d, c}});
  }
  return m;
}

/// Towards each other along z until `turn_s`, then back at the same speed.
class Pincers : public Stage {
 public:
  double speed_mps = 0.3, turn_s = 0;
  std::array<Vec3, 2> start;

  void placements(double t, std::span<Placement> obstacles, std::span<Placement>) const override {
    const double way = speed_mps * (t < turn_s ? t : 2 * turn_s - t);
    for (int k = 0; k < 2; ++k) {
      obstacles[k] = {};
      obstacles[k].origin = start[k] + Vec3{0, 0, k == 0 ? way : -way};
    }
  }
};

struct Pinch {
  Pincers stage;
  std::unique_ptr<Model> model;
  StepWork work;
  State state;
  Frequency frequency;
  long steps = 0, pinched = 0, yielded = 0;
  double fastest_mps = 0;
  double excess_J = 0;  ///< the most that contacts of a step added beyond what bodies and targets put in

  explicit Pinch(double turn_s, const Shape& body = pyramids(0.04)) {
    // Tips 15 mm apart sideways and 10 mm along z.
    stage.start = {Vec3{0, 0, -0.045}, Vec3{0.013, 0.007, 0.045}};
    stage.turn_s = turn_s;
    Fabric f = sheetFabric();
    f.thickness_m = 0.3e-3;
    f.density_kg_per_m3 = 0.144 / f.thickness_m;
    f.law = LinearBending{{3.3e-6, 3.3e-6}};
    Garment g = squareSheet(20, 0.2, 0, f);
    for (Vec3& x : g.patches[0].points) x -= Vec3{0.1, 0.1, 0};
    const ContactParameters contact{0, 0.2, 0.01, 1e-2, 400};
    model = buildModel(g, {}, {{0, 0, 0}, 0.288}, contact, {{body, "low"}, {body, "high"}});
    state = initialState(*model, stage, 0, work);
  }

  void run(double until_s) {
    VelocityVerlet(*model, stage, {0.7, 1e-3}, frequency, work)
        .advance(until_s, state,
                 [&](const State&, const State& after, const StepReport& r, const StepResult& w, const Frequency&) {
                   ++steps;
                   pinched += r.pinched;
                   yielded += r.contact.yielded;
                   double gained = 0, put_in = 0;
                   for (int i = 0; i < model->freeCount(); ++i) {
                     gained += 0.5 * model->mass_kg[i] * (norm2(work.velocity[i]) - norm2(work.predictor[i]));
                     fastest_mps = std::max(fastest_mps, norm(after.v[i]));
                     ASSERT_TRUE(std::isfinite(norm(after.v[i])));
                   }
                   for (std::size_t k = 0; k < w.rows.size(); ++k)
                     put_in += dot(w.impulses[k],
                                   w.rows[k].body_velocity + w.rows[k].target_m_per_s * w.rows[k].contact.normal);
                   for (int z = 0; z < w.impact_zones.size(); ++z)
                     for (int i : w.impact_zones[z].points)
                       if (w.impact_zones[z].body >= 0)
                         put_in += model->mass_kg[i] * dot(w.impact_zone_change[i], work.velocity[i]);
                   excess_J = std::max(excess_J, gained - put_in);
                 });
  }

  int crossings() const {
    std::vector<Vec3> x;
    samplePositions(*model, state.p, x);
    std::vector<Placement> at(2), anchors;
    stage.placements(state.time_s, at, anchors);
    const CollisionModel& c = model->collisions;
    x.resize(c.mesh.vertex_count);
    for (const auto& body : c.bodies)
      for (std::size_t k = 0; k < body.local.size(); ++k) x[body.first_vertex + k] = at[body.obstacle] * body.local[k];
    return static_cast<int>(findCrossings(c.mesh, x, c.is_body).size());
  }
};

TEST(Pinch, NeitherThrowsTheClothAboutNorKeepsIt) {
  // The bodies touch each other 0.038 s from the start, and go 1.8 mm further.
  Pinch p(0.041);
  p.run(0.041);
  const double fastest = p.fastest_mps;
  p.run(0.082);
  p.run(0.2);
  std::printf(
      "[ measured ] %ld steps, %ld yielded, %ld pinched samples, fastest %.2f m/s (closing %.2f), %.2g J too many\n",
      p.steps, p.yielded, p.pinched, p.fastest_mps, fastest, p.excess_J);
  EXPECT_GT(p.yielded, 0);
  EXPECT_GT(p.pinched, 0);
  EXPECT_LT(p.fastest_mps, 6);
  EXPECT_LT(p.excess_J, 1e-7);
  EXPECT_EQ(p.crossings(), 0);
  EXPECT_FALSE(p.state.tangled);
}

/// Ellipsoids that overlap leave a sample between them no place: only hits of ellipsoids fail the step, and each says
/// when, so that the sample is let pass as one that meshes pinch is.
TEST(Pinch, EllipsoidsLetGoOfWhatTheyPinch) {
  Pinch p(0.041, Ellipsoid{{0.04, 0.04, 0.04}});
  p.run(0.041);
  p.run(0.082);
  p.run(0.2);
  std::printf("[ measured ] %ld steps, %ld yielded, %ld pinched samples, fastest %.2f m/s, %.2g J too many\n", p.steps,
              p.yielded, p.pinched, p.fastest_mps, p.excess_J);
  EXPECT_GT(p.pinched, 0);
  EXPECT_LT(p.fastest_mps, 6);
  std::vector<Vec3> x;
  samplePositions(*p.model, p.state.p, x);
  std::vector<Placement> at(2), anchors;
  p.stage.placements(p.state.time_s, at, anchors);
  for (const Vec3& v : x)
    for (const Placement& body : at) EXPECT_GT(norm(v - body.origin), 0.04);
}

}  // namespace
}  // namespace gambeson
