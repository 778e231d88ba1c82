// Springs of virtual stitching, Zheng 2013, eq. 6.2 and 6.3.
#include "core/motion/stitch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Two sheets side by side, 20 mm apart, stitched along the edges that face each other, at rest and without gravity.
Motion twoSheets(double damping) {
  Garment g = squareSheet(6, 0.12, 0);
  NurbsPatch other = g.patches[0];
  for (Vec3& x : other.points) x += Vec3{0.14, 0.003, 0.01};
  g.patches.push_back(other);
  g.weft.push_back(g.weft[0]);
  ModelOptions o;
  o.self_contact = false;
  const Surface surface = buildSurface(g, buildFreeMap(g), o.samples_per_cell);
  const std::vector<int> a = edgeSamples(surface, {0, Side::u1, false}), b = edgeSamples(surface, {1, Side::u0, false});
  EXPECT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) o.stitches.push_back({a[k], b[k], 2.0, damping});
  return Motion(g, {{}, 0}, {1e-3, 0.3, 0.01, 1e-2, 400}, o);
}

TEST(Stitch, ForcesAreTheGradientOfTheEnergy) {
  Motion m = twoSheets(0);
  const Model& model = *m.model;
  std::vector<Vec3> p = m.state.p, f(p.size());
  addStitchForces(model.stitches, model.surface.WT, p, f);
  double largest = 0, worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (double Vec3::*c : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      const double h = 1e-5, at = p[i].*c;
      p[i].*c = at + h;
      const double up = stitchEnergy(model.stitches, model.surface.WT, p);
      p[i].*c = at - h;
      const double down = stitchEnergy(model.stitches, model.surface.WT, p);
      p[i].*c = at;
      worst = std::max(worst, std::abs(f[i].*c + (up - down) / (2 * h)));
      largest = std::max(largest, std::abs(f[i].*c));
    }
  EXPECT_GT(largest, 1e-3);
  EXPECT_LT(worst, 1e-8 * largest);
  // 13 pairs, each |(0.02, 0.003, 0.01)| apart.
  EXPECT_NEAR(stitchEnergy(model.stitches, model.surface.WT, p), 13 * 0.5 * 2 * (4e-4 + 9e-6 + 1e-4), 1e-12);
  EXPECT_NEAR(widestStitch(model.stitches, model.surface.WT, p), std::sqrt(4e-4 + 9e-6 + 1e-4), 1e-12);
}

TEST(Stitch, WithoutDampingMomentumAndEnergyAreKept) {
  Motion m = twoSheets(0);
  const double start = m.energy().total();
  const double apart = widestStitch(m.model->stitches, m.model->surface.WT, m.state.p);
  double least = apart, worst = 0, least_kinetic = 0;
  for (int s = 0; s < 600; ++s) {
    const StepReport r = m.step(5e-5);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    least = std::min(least, widestStitch(m.model->stitches, m.model->surface.WT, m.state.p));
    least_kinetic = std::max(least_kinetic, m.energy().kinetic);
    EXPECT_NEAR(m.energy().total(), start, 1e-3 * start);
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(least, 0.8 * apart);
  EXPECT_GT(least_kinetic, 0.2 * start);
  Vec3 momentum{};
  double scale = 0;
  for (std::size_t i = 0; i < m.state.v.size(); ++i) {
    momentum += m.model->mass_kg[i] * m.state.v[i];
    scale += m.model->mass_kg[i] * norm(m.state.v[i]);
  }
  EXPECT_LT(norm(momentum), 1e-10 * scale);
}

/// All points at velocity v feel -eta v at each of the 26 samples.
TEST(Stitch, DampingIsThatOfBothEnds) {
  Motion m = twoSheets(0.02);
  for (Vec3& v : m.state.v) v = {0, 0, 0.3};
  m.restart();
  EXPECT_NEAR(m.state.sums.drag.z, -26 * 0.02 * 0.3, 1e-12);
  const StepReport r = m.step(1e-4);
  ASSERT_EQ(r.failure, StepFailure::none) << r.why;
  EXPECT_LT(r.momentum.error(), 1e-12 * r.momentum.scale);
  EXPECT_GT(r.work.dissipated, 0);
}

TEST(Stitch, TheLargestFrequencyCountsThem) {
  Motion m = twoSheets(0);
  const double soft = largestFrequency(*m.model, m.stage, m.state, 40, m.work).largest_rad_per_s;
  for (Stitch& s : m.model->stitches) s.stiffness_N_per_m = 2e4;
  m.state.mode.clear();
  const Frequency hard = largestFrequency(*m.model, m.stage, m.state, 40, m.work);
  EXPECT_GT(hard.largest_rad_per_s, 2 * soft);
  EXPECT_GT(hard.spring_share, 0.5);
}

}  // namespace
}  // namespace gambeson
