/// A strip over a turning drum: the tension ratio is exp(mu phi) (Euler, Eytelwein), whatever the drum's radius.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kRadius_m = 0.1, kLayer_m = 1e-3, kSpeed_m_per_s = 0.01, kWidth_m = 0.01, kSlack_N_per_m = 5;

/// The drum's axis is y.
class TurningDrum : public Stage {
 public:
  void placements(double t, std::span<Placement> obstacles, std::span<Placement>) const override {
    obstacles[0] = {rotationAbout({0, 1, 0}, t * kSpeed_m_per_s / kRadius_m), {}, 1};
  }
};

/// The strip lies on the drum from angle 0 (a straight end up, held) through `wrap` (a straight end, pulled by the
/// slack tension); it starts without tension.
double tensionRatio(double friction, double wrap) {
  const double r = kRadius_m + kLayer_m, end = 0.03;
  const double length = r * wrap + 2 * end;
  const int cells = static_cast<int>(std::ceil(length / (r * 4.5 / 180 * kPi)));
  // Along the strip s: e(a) is the outward direction at angle a, turning from +x towards -z.
  const auto place = [&](double s) {
    const auto out = [](double a) { return Vec3{std::cos(a), 0, -std::sin(a)}; };
    const auto along = [](double a) { return Vec3{-std::sin(a), 0, -std::cos(a)}; };
    const double on = s - end, a = std::clamp(on / r, 0.0, wrap);
    return r * out(a) + (on - a * r) * along(a);
  };
  Fabric f = sheetFabric();
  f.young_weft_Pa = f.young_warp_Pa = 1e5 / f.thickness_m;
  f.poisson = 0;
  f.shear_Pa = f.young_weft_Pa / 2;
  f.density_kg_per_m3 = 5 / f.thickness_m;  // slow waves, long steps: the motion is quasi-static
  f.law = LinearBending{{1e-6, 1e-6}};
  // The rest shape is the strip as it lies.
  const KnotVector along = uniformKnots(2, cells), across = uniformKnots(2, 1);
  NurbsPatch patch = patchOf(along, across, [&](double u, double v) {
    return place(length * u) + Vec3{0, kWidth_m * (v - 0.5), 0};
  });
  Garment g = garmentOf({patch}, {}, f);
  g.weft = {{0, 1, 0}};
  ModelOptions o;
  o.dead_force_N.assign(patch.points.size(), Vec3{});
  const Vec3 pull = place(length) - place(length - 0.01);
  const int last = along.count() - 1;
  // The slack tension on the last row, shared by the rows' lengths (basis of degree 2 on one cell: a third each).
  for (int j = 0; j < across.count(); ++j) {
    o.held_control_points.push_back(patch.index(0, j));
    o.dead_force_N[patch.index(last, j)] = (kSlack_N_per_m * kWidth_m / 3 / norm(pull)) * pull;
  }
  const ContactParameters c{kLayer_m, friction, 0.01};  // all else by default
  o.self_contact = false;
  TurningDrum drum;
  const auto model = buildModel(g, o, {{0, 0, 0}, 2000}, c, {{Ellipsoid{{kRadius_m, 100, kRadius_m}}, "drum"}});
  StepWork work;
  State state = initialState(*model, drum, 0, work);
  Frequency frequency;
  StepControl control;
  Vec3 held{};
  int unconverged = 0;
  constexpr double from = 0.12, until = 0.16;
  VelocityVerlet(*model, drum, control, frequency, work)
      .advance(until, state,
               [&](const State& before, const State&, const StepReport& report, const StepResult&, const Frequency&) {
                 unconverged += !report.contact.converged;
                 if (before.time_s >= from) held += report.momentum.supports;
               });
  const double tension = norm(held) / ((until - from) * kWidth_m);
  std::printf("[ measured ] mu phi %.3f (wrap %.0f degrees): %.3f N/m, ratio over exp %.4f, %d unconverged\n",
              friction * wrap, wrap * 180 / kPi, tension, tension / kSlack_N_per_m / std::exp(friction * wrap),
              unconverged);
  return tension / kSlack_N_per_m;
}

TEST(Capstan, TensionRatioIsTheExponentialOfFrictionTimesWrap) {
  // The drum's top turns towards the pulled end or away from it; away is where the held end takes more.
  for (const auto& [friction, wrap] : {std::pair{0.3, kPi / 2}, {0.3, kPi}, {0.5, kPi}, {2 / kPi, 1.5 * kPi}})
    EXPECT_NEAR(tensionRatio(friction, wrap) / std::exp(friction * wrap), 1, 0.02) << friction << " " << wrap;
}

}  // namespace
}  // namespace gambeson
