/// Angular momentum of two free sheets that meet. An impulse lambda on a pair of points at a distance d turns the
/// system by d x lambda, d at the start of the step: the scheme's positions move along its velocities, so that x x m v
/// is kept by a step whatever the impulses do at either end. Along d, as in persistent contact without friction,
/// that is nothing; the normal of an impact is that of a later time of the step, and friction acts across the layer.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A sheet and a smaller one above it, turned by 0.4 and tilted.
Motion twoSheets(double gap, double tilt, double friction, const Vec3& v) {
  Garment g = squareSheet(8, 0.2, 0);
  NurbsPatch patch = squareSheet(7, 0.16, 0).patches[0];
  for (Vec3& x : patch.points) {
    const Vec3 r = x - Vec3{0.08, 0.08, 0};
    x = Vec3{0.11 + std::cos(0.4) * r.x - std::sin(0.4) * r.y, 0.1 + std::sin(0.4) * r.x + std::cos(0.4) * r.y,
             gap + tilt * (r.x + 0.1)};
  }
  g.patches.push_back(patch);
  g.weft.push_back({1, 0, 0});
  Motion m(g, {{0, 0, 0}, 0}, {1.2e-3, friction, 0.01, 1e-2, 400});
  for (int i = 0; i < m.model->freeCount(); ++i)
    if (m.state.p[i].z > 0.5 * gap) m.state.v[i] = v;
  m.restart();
  return m;
}

/// By the impulses that were given: without the halves of the next ones that velocities hold in advance.
Vec3 angular(const Motion& m, double* scale = nullptr) {
  Vec3 l{};
  if (scale) *scale = 0;
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const Vec3 ahead = m.state.pressed.empty() ? Vec3{} : (0.5 * m.state.last_step_s) * m.state.pressed[i];
    const Vec3 moment = m.model->mass_kg[i] * cross(m.state.p[i], m.state.v[i] - ahead);
    l += moment;
    if (scale) *scale += norm(moment);
  }
  return l;
}

struct Turned {
  Vec3 by;            ///< by all impulses
  Vec3 persistent;    ///< by those along the distance, without friction
  double impact = 0;  ///< by each impact, absolute
};

/// What the impulses of the last step turn the system by; `p` from before it.
Turned turnedBy(const Motion& m, const std::vector<Vec3>& p) {
  std::vector<Vec3> x;
  samplePositions(*m.model, p, x);
  Turned t;
  for (std::size_t i = 0; i < m.work.rows.size(); ++i) {
    const ContactRow& row = m.work.rows[i];
    Vec3 d{};
    for (int k = 0; k < row.stencil.count; ++k) d += row.stencil.weight[k] * x[row.stencil.sample[k]];
    const Vec3 turn = cross(d, m.work.impulses[i]);
    t.by += turn;
    if (row.impact)
      t.impact += norm(turn);
    else
      t.persistent += cross(d, dot(m.work.impulses[i], row.contact.normal) * row.contact.normal);
  }
  return t;
}

TEST(AngularMomentum, IsKeptByPersistentContactWithoutFriction) {
  Motion m = twoSheets(2e-3, 0.05, 0, {0.1, 0.05, -0.3});
  double scale = 0;
  const Vec3 start = angular(m, &scale);
  int contacts = 0, impacts = 0;
  double worst = 0;
  for (int s = 0; s < 200; ++s) {
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    contacts += r.cloth_contacts;
    impacts += r.impacts + r.impact_zones;
    worst = std::max(worst, norm(angular(m) - start) / scale);
  }
  std::printf("[ measured ] persistent: %.2g of the angular momentum over 200 steps, %d contacts\n", worst, contacts);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(contacts, 1000);
  EXPECT_EQ(impacts, 0);
}

/// Fast sheets with friction; every step changes it by the sum of d x lambda and by nothing else.
TEST(AngularMomentum, OfImpactsAndFrictionChangesByThePredictedDefect) {
  Motion m = twoSheets(0.02, 0.05, 0.3, {-12, 4, -30});
  double scale = 0, worst = 0, largest = 0;
  angular(m, &scale);
  int impacts = 0;
  for (int s = 0; s < 40; ++s) {
    const Vec3 before = angular(m);
    const std::vector<Vec3> p = m.state.p;
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    impacts += r.impacts;
    if (r.impact_zones > 0) continue;
    const Turned turned = turnedBy(m, p);
    worst = std::max(worst, norm(angular(m) - before - turned.by) / scale);
    largest = std::max(largest, norm(turned.by) / scale);
    EXPECT_LT(norm(turned.persistent), 1e-12 * scale);
  }
  std::printf("[ measured ] impacts: defect up to %.2g of the angular momentum, %.2g of it not predicted\n", largest,
              worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(largest, 1e-7);
  EXPECT_GT(impacts, 10);
}

TEST(AngularMomentum, DefectOfImpactsVanishesWithTheStep) {
  double last = 0;
  for (int cut : {1, 2, 4, 8}) {
    Motion m = twoSheets(0.02, 0.05, 0, {-120, 40, -60});
    double scale = 0, defect = 0;
    angular(m, &scale);
    for (int s = 0; s < 5 * cut; ++s) {
      const std::vector<Vec3> p = m.state.p;
      const StepReport r = m.step(2e-4 / cut);
      ASSERT_EQ(r.failure, StepFailure::none) << r.why;
      defect += turnedBy(m, p).impact / scale;
    }
    std::printf("[ measured ] step %.3g ms: defect of the impacts %.3g of the angular momentum\n", 0.2 / cut, defect);
    EXPECT_GT(defect, 0);
    if (cut > 1) {
      EXPECT_LT(defect, 0.75 * last) << cut;
    }
    last = defect;
  }
}

}  // namespace
}  // namespace gambeson
