/// The room that the arrays of a step have.

#include <gtest/gtest.h>

#include <cmath>

#include "core/motion/capacity.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Ten sheets within each other's layer on a ball: everything a step finds has room, and no array of contacts moves.
TEST(StepCapacity, HoldsAPileOfTenSheets) {
  const ContactParameters contact{1.2e-3, 0.2, 0.01, 1e-2, 400};
  Garment g = squareSheet(5, 0.1, 0);
  for (int k = 1; k < 10; ++k) {
    g.patches.push_back(squareSheet(5, 0.1, 0.02 * k).patches[0]);
    g.weft.push_back({1, 0, 0});
  }
  Obstacle ball;
  ball.shape = Ellipsoid{{0.1, 0.1, 0.1}};
  Motion m(g, {{0, 0, -9.81}, 0}, contact, {}, {ball}, {Placement{{}, {0.05, 0.05, -0.1012}, 1}});
  for (Vec3& p : m.state.p) {
    // Samples that lie on each other are one contact: every other sheet lies a little aside.
    if (std::lround(p.z / 0.02) % 2 == 1) p.x += 3e-3;
    p.z *= 1.1e-3 / 0.02;  // what is that near at rest is no contact
  }
  m.restart();
  const StepCapacity room = capacityOf(*m.model);
  EXPECT_EQ(room.samples, m.model->surface.size());
  EXPECT_EQ(room.points, m.model->freeCount());
  reserve(room, m.work);
  const ContactRow* rows = m.work.rows.data();
  const Contact* near = m.work.near.data();
  double most = 0;
  for (int s = 0; s < 20; ++s) {
    const StepReport r = m.step(2e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_TRUE(fits(room, m.work)) << s;
    most = std::max(most, static_cast<double>(m.work.rows.size()) / room.samples);
  }
  EXPECT_EQ(m.work.rows.data(), rows);
  EXPECT_EQ(m.work.near.data(), near);
  EXPECT_GT(most, 2);  // the pile is one
  StepCapacity less = room;
  less.cloth_points = room.samples / 4;
  EXPECT_FALSE(fits(less, m.work));
}

/// What nothing can touch has no room for contacts.
TEST(StepCapacity, ASheetAloneHasNone) {
  ModelOptions o;
  o.self_contact = false;
  const Motion m(squareSheet(5, 0.1, 0), {}, {}, o);
  EXPECT_EQ(capacityOf(*m.model).rows(), 0);
  EXPECT_EQ(capacityOf(*m.model).listed_edges, 0);
}

}  // namespace
}  // namespace gambeson
