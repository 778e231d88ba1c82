/// Explicit steps of cloth whose law is a table: as long as the strains that it comes to allow, and no longer.

#include <gtest/gtest.h>

#include <cmath>

#include "core/material/linearised.hpp"
#include "core/material/table/law_table.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Garment stiffening() {
  Fabric f = sheetFabric();
  f = withEnergy(f, std::make_shared<const LawTable>(tableOf({}, 9, 5)));
  return squareSheet(4, 0.2, 0, f);
}

double energyOf(const Motion& m) {
  std::vector<Vec3> f(static_cast<std::size_t>(m.model->cloth->points())), q(f.size());
  m.model->cloth->map().T.multiply<Vec3>(m.state.p, q);
  ClothWork work;
  ClothEnergy energy;
  m.model->cloth->force(q, {f, {}, {}, &energy}, work);
  double kinetic = 0;
  for (int i = 0; i < m.model->freeCount(); ++i)
    kinetic += 0.5 * m.model->mass_kg[static_cast<std::size_t>(i)] * norm2(m.state.v[static_cast<std::size_t>(i)]);
  return energy.stored + kinetic;
}

/// A free sheet that is thrown apart along the weft, to a strain of 8 %, and swings. At rest its steps are more than
/// twice those that the whole table allows; on the way each step is stable with the slopes of where it leads, and
/// energy is kept.
TEST(LawSteps, FollowTheStrainsThatTheClothComesTo) {
  Motion m(stiffening(), {Vec3{}, 0});
  Frequency frequency;
  const double whole = [&] {
    State state = m.state;
    return largestFrequency(*m.model, m.stage, state, 40, m.work).largest_rad_per_s;
  }();
  for (std::size_t i = 0; i < m.state.p.size(); ++i) m.state.v[i] = {24 * (m.state.p[i].x - 0.1), 0, 0};
  StepControl control;
  control.max_step_s = 1;
  const double before = energyOf(m);
  double first = 0, shortest = 1, most = 0;
  long steps = 0;
  VelocityVerlet(*m.model, m.stage, control, frequency, m.work)
      .advance(0.1, m.state,
               [&](const State&, const State& now, const StepReport& r, const StepResult&, const Frequency&) {
                 if (steps++ == 0) first = r.step_s;
                 shortest = std::min(shortest, r.step_s);
                 std::vector<Vec3> q(static_cast<std::size_t>(m.model->cloth->points()));
                 m.model->cloth->map().T.multiply<Vec3>(now.p, q);
                 const StrainBox at = *m.model->cloth->lawStrains(q);
                 most = std::max(most, at.high[0]);
                 ASSERT_TRUE(now.law_strains);
                 if (now.steps_to_estimate > 0) {
                   EXPECT_TRUE(now.law_strains->contains(at)) << "at " << now.time_s;
                 }
               });
  EXPECT_GT(most, 0.06) << "the sheet does not come to where it is stiff";
  EXPECT_GT(first, 2 * 0.8 * 2 / whole);
  EXPECT_LT(shortest, 0.7 * first) << "steps do not follow the strain";
  EXPECT_NEAR(energyOf(m), before, 0.05 * before) << "more than the check of every run lets pass";
}

}  // namespace
}  // namespace gambeson
