/// Cloth that meets cloth: nothing passes through, momentum stays, tangled cloth comes free.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/contact/crossing.hpp"
#include "core/contact/impact_zones.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const ContactParameters kContact{1.2e-3, 0.2, 0.01, 1e-2, 400};

int crossings(const Motion& m) {
  std::vector<Vec3> x;
  samplePositions(*m.model, m.state.p, x);
  const ContactMesh mesh = contactMesh(m.model->surface.size(), m.model->surface.triangles);
  return static_cast<int>(findCrossings(mesh, x).size());
}

/// Two squares, one above the other and turned by `angle`, in one model.
Motion twoSheets(double gap, double angle, const Environment& e = {{0, 0, 0}, 0}) {
  Garment g = squareSheet(8, 0.2, 0);
  const Garment upper = squareSheet(7, 0.16, gap);
  NurbsPatch patch = upper.patches[0];
  for (Vec3& x : patch.points) {
    const Vec3 r = x - Vec3{0.08, 0.08, 0};
    x = Vec3{0.1 + std::cos(angle) * r.x - std::sin(angle) * r.y, 0.1 + std::sin(angle) * r.x + std::cos(angle) * r.y,
             r.z};
  }
  g.patches.push_back(patch);
  g.weft.push_back({1, 0, 0});
  return Motion(g, e, kContact);
}

double kinetic(const Motion& m) {
  double k = 0;
  for (int i = 0; i < m.model->freeCount(); ++i) k += 0.5 * m.model->mass_kg[i] * norm2(m.state.v[i]);
  return k;
}
Vec3 momentum(const Motion& m) {
  Vec3 p{};
  for (int i = 0; i < m.model->freeCount(); ++i) p += m.model->mass_kg[i] * m.state.v[i];
  return p;
}

TEST(SelfContact, TwoSheetsMeetWithoutPassingAndKeepTheirMomentum) {
  Motion m = twoSheets(0.01, 0.4);
  for (int i = 0; i < m.model->freeCount(); ++i)
    if (m.state.p[i].z > 0.005) m.state.v[i] = {0.2, 0, -2};
  m.restart();
  const Vec3 start = momentum(m);
  const double energy = kinetic(m);
  int contacts = 0;
  for (int s = 0; s < 200; ++s) {
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_LT(norm(momentum(m) - start), 1e-13 * norm(start)) << s;
    ASSERT_EQ(crossings(m), 0) << s;
    contacts += r.cloth_contacts;
  }
  EXPECT_GT(contacts, 1000);
  EXPECT_LT(m.energy().total(), energy);  // what the sheets lose, and nothing comes in
}

TEST(SelfContact, FastSheetsAreStoppedByImpact) {
  Motion m = twoSheets(0.02, 0.4);
  for (int i = 0; i < m.model->freeCount(); ++i)
    if (m.state.p[i].z > 0.005) m.state.v[i] = {-120, 40, -60};
  m.restart();
  int impacts = 0, contacts = 0;
  double work = 0, separation = 0;
  for (int s = 0; s < 30; ++s) {
    // 12 mm down and 25 mm sideways in a step: the nearest points at its start tell nothing.
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_EQ(crossings(m), 0) << s;
    impacts += r.impacts;
    contacts += r.cloth_contacts;
    // Impulses take energy, but for what restoring the layer adds. Velocities hold half of what lasts in advance, and a
    // contact that has ended gives its half back in the next step: sums tell where nothing is held in advance.
    work += r.work.contact;
    separation += r.work.separation;
    if (m.state.pressed.empty()) {
      EXPECT_LE(work, separation + 1e-12) << s;
    }
  }
  EXPECT_GT(impacts, 10);
  EXPECT_GT(impacts + contacts, 100);
}

TEST(SelfContact, AClosingFoldDoesNotPassThroughItself) {
  const Garment g = squareSheet(12, 0.2, 0);
  Motion m(g, {{0, 0, -9.81}, 0.3}, kContact);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    Vec3& p = m.state.p[i];
    // Half a turn about the middle line, the upper half lowered onto the lower one.
    const double s = p.x - 0.1, r = 0.015;
    const double a = s / r;
    const double y = p.y;
    p = a < 0 ? Vec3{s, y, 0} : a < kPi ? Vec3{r * std::sin(a), y, r * (1 - std::cos(a))} : Vec3{kPi * r - s, y, 2 * r};
    m.state.v[i] = {0, 0, a > kPi / 2 ? -1.5 : 0.0};
  }
  m.restart();
  ASSERT_EQ(crossings(m), 0);
  int contacts = 0;
  for (int s = 0; s < 300; ++s) {
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why << " step " << s;
    ASSERT_EQ(crossings(m), 0) << s;
    contacts += r.cloth_contacts;
  }
  EXPECT_GT(contacts, 1000);
}

TEST(SelfContact, CrossedStripsComeFree) {
  // A vertical sheet stuck 6 mm deep through a horizontal one (an open contour on both).
  Garment g = squareSheet(8, 0.2, 0);
  NurbsPatch upright = squareSheet(5, 0.08, 0).patches[0];
  for (Vec3& x : upright.points) x = {0.1003, x.x + 0.0612, x.y - 0.006};
  g.patches.push_back(upright);
  g.weft.push_back({0, 0, 1});
  Motion m(g, {{0, 0, 0}, 0.3}, kContact);
  ASSERT_GT(crossings(m), 0);
  int step = 0;
  double restored = 0;
  for (; step < 1000 && m.state.tangled; ++step) {
    const StepReport r = m.step(3e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    restored += r.work.restoring;
  }
  EXPECT_FALSE(m.state.tangled);
  EXPECT_EQ(crossings(m), 0);
  EXPECT_LT(step * 3e-4, 0.3);
  EXPECT_GT(restored, 0);
  // What that took is known apart from the rest (table 4.1 of the thesis), and only of steps that looked.
  const PhaseTimes times = m.work.times;
  EXPECT_EQ(times.searches, step);
  EXPECT_GT(times.tangles, 0);
  EXPECT_GT(times.freeing, 0);
  EXPECT_GT(times.searched_steps, times.tangles + times.freeing);
  for (int s = 0; s < 50; ++s) {
    ASSERT_EQ(m.step(3e-4).failure, StepFailure::none);
    ASSERT_EQ(crossings(m), 0);
  }
  EXPECT_EQ(m.work.times.searches, times.searches);
  EXPECT_EQ(m.work.times.searched_steps, times.searched_steps);
}

TEST(Zones, RigidMotionKeepsMomentaAndNeverAddsEnergy) {
  std::mt19937 random(3);
  std::normal_distribution<double> d;
  std::vector<Vec3> p(9), v(9);
  std::vector<double> mass(9);
  for (int i = 0; i < 9; ++i) {
    p[i] = {d(random), d(random), d(random)};
    v[i] = {d(random), d(random), d(random)};
    mass[i] = 0.5 + std::abs(d(random));
  }
  const std::vector<int> points{0, 1, 2, 4, 5, 7, 8};
  ImpactZone zone;
  zone.points = points;
  std::vector<Vec3> after = v;
  makeRigid(zone, p, mass, after);
  Vec3 linear{}, angular{};
  double energy = 0;
  for (int i : zone.points) {
    linear += mass[i] * (after[i] - v[i]);
    angular += mass[i] * cross(p[i], after[i] - v[i]);
    energy += 0.5 * mass[i] * (norm2(after[i]) - norm2(v[i]));
  }
  EXPECT_LT(norm(linear), 1e-14);
  EXPECT_LT(norm(angular), 1e-13);
  EXPECT_LT(energy, 0);
  EXPECT_EQ(after[3], v[3]);
  // Distances do not change to first order.
  for (int i : zone.points)
    for (int j : zone.points) EXPECT_NEAR(dot(p[i] - p[j], after[i] - after[j]), 0, 1e-13);
}

TEST(ImpactZones, PairsThatShareSupportAreOneImpactZone) {
  SparseRows W;  // samples 0..3 on points {0,1}, {1,2}, {3}, {5}
  W.column_count = 6;
  const auto row = [&](std::initializer_list<int> columns) {
    for (int c : columns) W.add(c, 1.0 / static_cast<double>(columns.size()));
    W.endRow();
  };
  row({0, 1});
  row({1, 2});
  row({3});
  row({5});
  ContactRow a, b, c;
  a.contact.obstacle = b.contact.obstacle = -1;
  a.contact.kind = b.contact.kind = ContactKind::sample_on_cloth;
  a.stencil.add(0, 1), a.stencil.add(2, -1);
  b.stencil.add(1, 1), b.stencil.add(2, -1);
  c.contact.obstacle = 4;
  c.stencil.add(3, 1);
  ImpactZones impact_zones;
  const std::vector<ContactRow> rows{a, b, c};
  joinImpactZones(rows, W, impact_zones);
  const auto points = [&](int zone) {
    return std::vector<int>(impact_zones[zone].points.begin(), impact_zones[zone].points.end());
  };
  ASSERT_EQ(impact_zones.size(), 2);
  EXPECT_EQ(points(0), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(impact_zones[0].body, -1);
  EXPECT_EQ(points(1), (std::vector<int>{5}));
  EXPECT_EQ(impact_zones[1].body, 4);
  ContactRow d;
  d.contact.obstacle = 2;
  d.stencil.add(3, 1), d.stencil.add(0, -1);
  joinImpactZones(std::vector<ContactRow>{d}, W, impact_zones);
  ASSERT_EQ(impact_zones.size(), 1);
  EXPECT_TRUE(impact_zones[0].pinched);
}

}  // namespace
}  // namespace gambeson
