/// A sheet slides down another one: the acceleration is g (sin a - mu cos a), however fast it slides.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/cloth/draft/join_garments.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(ClothFriction, ASheetSlidesOnAnotherWithoutMoreThanFriction) {
  constexpr double kFriction = 0.3, kThickness_m = 1.177e-3, kSlope = 0.5, kTime_s = 0.3;
  const Garment lower = squareSheet(10, 0.4, 0);
  Garment upper = squareSheet(5, 0.15, kThickness_m);
  for (Vec3& x : upper.patches[0].points) x += Vec3{0.0313, 0.1217, 0};
  ModelOptions o;
  const int below = lower.patches[0].size();
  for (int i = 0; i < below; ++i) o.held_control_points.push_back(i);
  const Vec3 gravity = 9.81 * normalized(Vec3{kSlope, 0, -1});
  Motion m(joinGarments(std::vector<Garment>{lower, upper}), {gravity, 0}, {0, kFriction, 0.01}, o);
  const auto mean = [&](const std::vector<Vec3>& of) {
    Vec3 sum{};
    double mass = 0;
    for (int i = below; i < m.model->freeCount(); ++i) sum += m.model->mass_kg[i] * of[i], mass += m.model->mass_kg[i];
    return sum / mass;
  };
  const double start = mean(m.state.p).z;
  Frequency frequency;
  double lifted = 0, t = 0, v = 0;
  VelocityVerlet(*m.model, m.stage, {0.9, 1e-3}, frequency, m.work)
      .advance(kTime_s, m.state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 EXPECT_TRUE(r.contact.converged);
                 lifted = std::max(lifted, mean(after.p).z - start);
                 if (t == 0 && after.time_s > 0.01) t = after.time_s, v = mean(after.v).x;  // the first steps land
               });
  const double acceleration = (mean(m.state.v).x - v) / (kTime_s - t),
               exact = 9.81 * (kSlope - kFriction) / std::sqrt(1 + kSlope * kSlope);
  std::printf("[ measured ] acceleration %.5f of the exact one up to %.2f m/s, lifted by %.2g um\n",
              acceleration / exact, mean(m.state.v).x, 1e6 * lifted);
  EXPECT_NEAR(acceleration / exact, 1, 1e-3);  // 0.98 where borders are lifted by the samples that they pass
  EXPECT_LT(lifted, 0.1e-6);
}

}  // namespace
}  // namespace gambeson
