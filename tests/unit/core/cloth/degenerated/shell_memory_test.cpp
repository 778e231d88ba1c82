/// The degenerated shell with laws that no section expresses: friction in bending and in shear, curvature from flat.

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/degenerated/degenerated_shell.hpp"
#include "core/material/hysteresis.hpp"
#include "core/statics/reduction.hpp"
#include "unit/core/cloth/degenerated/degenerated_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Friction is overcome at 2 1/m; curvatures of the shapes below are about 1 1/m.
template <class L>
L loop() {
  const Stops<kStops> stops = stopsOf<kStops>(curveOver(4, 1, 2));
  L law;
  law.weft_Nm = law.warp_Nm = stops.last_Nm;
  law.twist_Nm = 0.5 * stops.last_Nm;
  law.shape = stops.shape;
  law.first_Nm = {stops.first_Nm, stops.first_Nm, 0.5 * stops.first_Nm};
  law.span_per_m = {2, 2, 2};
  law.cycle_per_m = 4;
  return law;
}

std::vector<BendingLaw> laws() {
  auto recovering = loop<Recovering<HysteresisBending>>();
  recovering.part = 0.5;
  recovering.time_s = 0.1;
  return {StopBending{{2, 3, 1}, 1}, loop<HysteresisBending>(), loop<IsotropicHysteresisBending>(), recovering};
}

Fabric clothOf(const BendingLaw& law, bool shears) {
  Fabric f = orthotropicCloth();
  f.law = law;
  f.rest_curvature_of_shape = false;
  if (shears) f.shear_friction = {2000, 0.05, 0};
  return f;
}

struct Remembered {
  std::unique_ptr<DegeneratedShell> cloth;
  ShellPlace at;
  std::vector<double> committed;
  ClothState state() const { return {at.q, at.inner, committed, {}, 0.05}; }
  ClothState state(const ShellPlace& s) const { return {s.q, s.inner, committed, {}, 0.05}; }
};

/// Bent one way, accepted, then another.
Remembered remembered(const BendingLaw& law, bool shears, ShellRule rule) {
  Remembered r{std::make_unique<DegeneratedShell>(curvedSheet(3, 2, clothOf(law, shears)),
                                                  DegeneratedOptions{rule, 0.1, RotaryInertia::exact}),
               {},
               {}};
  r.committed.resize(r.cloth->historySize());
  r.cloth->startHistory(r.committed);
  r.at = disturbed(*r.cloth, 0.05, 0.4);
  std::vector<double> trial = r.committed;
  std::vector<Vec3> f(r.at.q.size());
  ClothWork work;
  r.cloth->force(r.state(), {f, {}, trial, nullptr}, work, {});
  r.committed = trial;
  r.at = disturbed(*r.cloth, 0.05, 0.4, 8);
  return r;
}

std::vector<double> forceOf(const Remembered& r, const ShellPlace& s) { return forcesIn(*r.cloth, r.state(s)); }

double energyOf(const Remembered& r, const ShellPlace& s) {
  std::vector<Vec3> f(s.q.size());
  ClothWork work;
  ClothEnergy energy;
  r.cloth->force(r.state(s), {f, {}, {}, &energy}, work, {});
  EXPECT_GE(energy.lost, 0);
  return energy.stored + energy.lost;
}

class ShellMemory : public testing::TestWithParam<ShellRule> {};

TEST_P(ShellMemory, ForceIsTheGradientOfWhatIsStoredAndLost) {
  for (const BendingLaw& law : laws())
    for (const bool shears : {false, true}) {
      const Remembered r = remembered(law, shears, GetParam());
      const std::vector<double> f = forceOf(r, r.at);
      std::mt19937 random(4);
      std::uniform_real_distribution<double> d(-1, 1);
      for (int sample = 0; sample < 3; ++sample) {
        std::vector<double> way(f.size()), back(f.size());
        double along = 0, size = 0;
        for (std::size_t k = 0; k < f.size(); ++k) {
          way[k] = 1e-6 * d(random), back[k] = -way[k];
          along -= f[k] * way[k], size += std::abs(f[k] * way[k]);
        }
        const double slope =
            0.5 * (energyOf(r, changed(*r.cloth, r.at, way)) - energyOf(r, changed(*r.cloth, r.at, back)));
        EXPECT_NEAR(slope, along, 1e-6 * size);
      }
    }
}

TEST_P(ShellMemory, TangentIsItsSlopeOnTheManifold) {
  for (const BendingLaw& law : laws())
    for (const bool shears : {false, true}) {
      const Remembered r = remembered(law, shears, GetParam());
      const std::size_t points = r.cloth->map().home.size(), n = 3 * points + r.cloth->innerRates();
      ClothWork work;
      BlockMatrix K;
      r.cloth->tangent()->assemble(r.state(), work, K);
      std::mt19937 random(2);
      std::uniform_real_distribution<double> d(-1, 1);
      for (int sample = 0; sample < 3; ++sample) {
        std::vector<double> way(n), there(n), Kw(n);
        for (double& v : way) v = d(random);
        r.cloth->dropIdle(r.at.inner, std::span(way).subspan(3 * points));
        const double step = 1e-6;  // within the branches of the laws
        for (std::size_t k = 0; k < n; ++k) there[k] = step * way[k];
        const std::vector<double> ahead = forceOf(r, changed(*r.cloth, r.at, there));
        for (double& v : there) v = -v;
        const std::vector<double> behind = forceOf(r, changed(*r.cloth, r.at, there));
        multiply(K, way, Kw);
        double slope = 0, mine = 0;
        for (std::size_t k = 0; k < n; ++k)
          slope += way[k] * (behind[k] - ahead[k]) / (2 * step), mine += way[k] * Kw[k];
        EXPECT_NEAR(mine, slope, 1e-6 * std::abs(slope));
      }
    }
}

TEST_P(ShellMemory, PointsKeepTheirNumbersSideBySide) {
  const Remembered r = remembered(StopBending{{2, 3, 1}, 1}, true, GetParam());
  const std::size_t each = StopBending::history_size + kShearHistory;
  const std::size_t points = GetParam() == ShellRule::one_point ? 1 : 4;
  EXPECT_EQ(r.cloth->historySize(), 6 * points * each);
  const std::vector<HistoryPlace> places = r.cloth->historyPlaces();
  ASSERT_EQ(places.size(), 6 * points);
  double u = 0, v = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(places[i].first, i * each);
    EXPECT_EQ(places[i].count, each);
    EXPECT_EQ(places[i].stride, 1u);
    u += places[i].place.x, v += places[i].place.y;
  }
  EXPECT_NEAR(u, 0.5 * static_cast<double>(places.size()), 1e-12);
  EXPECT_NEAR(v, 0.5 * static_cast<double>(places.size()), 1e-12);
  // A query has the memory of the point that is nearest.
  const Vec2 near{places[0].place.x + 0.01, places[0].place.y};
  std::vector<double> forgot = r.committed;
  std::fill_n(forgot.begin(), each, 0.0);
  const Vec3 before = r.cloth->stateAt({r.at.q, r.at.inner, r.committed}, 0, near).m;
  EXPECT_GT(norm(r.cloth->stateAt({r.at.q, r.at.inner, forgot}, 0, near).m - before), 1e-3 * norm(before));
  std::fill(forgot.begin() + static_cast<long>(each), forgot.end(), 0.0);
  std::copy_n(r.committed.begin(), each, forgot.begin());
  EXPECT_EQ(norm(r.cloth->stateAt({r.at.q, r.at.inner, forgot}, 0, near).m - before), 0);
}
INSTANTIATE_TEST_SUITE_P(Rules, ShellMemory, testing::ValuesIn(kShellRules));

/// Within its yield moment a stop is the linear law, to rounding, and its steepest slope is that law everywhere.
TEST(ShellLaw, AStopThatHoldsIsLinear) {
  Fabric stop = clothOf(StopBending{{2, 3, 1}, 1e6}, false), linear = clothOf(LinearBending{{2, 3, 1}}, false);
  const DegeneratedShell a(curvedSheet(3, 2, stop)), b(curvedSheet(3, 2, linear));
  const ShellPlace s = disturbed(a, 0.03, 0.3);
  const std::vector<double> fa = forcesIn(a, s), fb = forcesIn(b, s);
  double largest = 0;
  for (const double v : fb) largest = std::max(largest, std::abs(v));
  for (std::size_t k = 0; k < fa.size(); ++k) EXPECT_NEAR(fa[k], fb[k], 1e-12 * largest);
  EXPECT_NEAR(energyIn(a, s), energyIn(b, s), 1e-12 * energyIn(b, s));
  const DegeneratedShell yields(curvedSheet(3, 2, clothOf(StopBending{{2, 3, 1}, 1e-3}, false)));
  ForceTerms steepest;
  steepest.steepest = true;
  EXPECT_LT(energyIn(yields, s), 0.999 * energyIn(b, s));
  EXPECT_NEAR(energyIn(yields, s, steepest), energyIn(b, s), 1e-12 * energyIn(b, s));
}

/// A cylinder of cloth that is flat by itself holds B/(2 R²) per area, and its moment is B/R; from its shape, nothing.
TEST(ShellLaw, CurvatureFromFlatBendsACurvedDraft) {
  const double R = 0.5, B = 3;
  Fabric f = orthotropicCloth();
  f.law = LinearBending{{B, B, B}};
  const auto tube = [&](bool from_shape) {
    f.rest_curvature_of_shape = from_shape;
    return DegeneratedShell(sheetOf(24, 2, f, [&](double a, double b) {
      return Vec3{R * std::sin(a), b, R * (1 - std::cos(a))};
    }));
  };
  const DegeneratedShell flat = tube(false), shape = tube(true);
  EXPECT_LT(energyIn(shape, atRest(shape)), 1e-20);
  EXPECT_FALSE(shape.springsAtRest(1));
  EXPECT_TRUE(flat.springsAtRest(1));
  EXPECT_NEAR(energyIn(flat, atRest(flat)), 0.5 * B / (R * R) * R, 1e-3 * 0.5 * B / R);
  const PointState at = flat.stateAt(atRest(flat), 0, {0.5, 0.5});
  EXPECT_NEAR(std::abs(at.curvature_change.x), 1 / R, 1e-3 / R);
  EXPECT_NEAR(at.m.x, B * at.curvature_change.x, 1e-12 * B / R);
  EXPECT_NEAR(norm(at.n), 0, 1e-9);
}

}  // namespace
}  // namespace gambeson
