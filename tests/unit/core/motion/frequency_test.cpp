/// The stable step is 2 / omega, and sharp (the fifth of the tests that every discretisation passes): velocity Verlet
/// keeps a mode of frequency omega bounded for omega dt < 2, where v^2 + (1 - (omega dt)^2/4) omega^2 x^2 is constant
/// for it, so that its energy never exceeds the first one by more than 1/(1 - (omega dt)^2/4); and at omega dt = 2.2
/// it grows by exp(2 arcosh(1.42)) = 5.9 a step. Contact off, no gravity, no drag.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// The largest energy of a perturbation over the steps, relative to the first.
double growth(const Garment& g, const ModelOptions& options, double factor, int steps, const char* governing) {
  Motion m(g, {{0, 0, 0}, 0}, {}, options);
  const Frequency f = largestFrequency(*m.model, m.stage, m.state, 60, m.work);
  EXPECT_STREQ(f.governing(), governing);
  EXPECT_NEAR(f.membrane_share + f.bending_share + f.seam_share + f.spring_share, 1, 1e-4);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> d(-1e-9, 1e-9);
  for (Vec3& x : m.state.p) x += Vec3{d(random), d(random), d(random)};
  m.restart();
  const double first = m.energy().total(), dt = factor * 2 / f.largest_rad_per_s;
  double most = 1;
  int k = 0;
  for (; k < steps && most < 1e6; ++k) {
    EXPECT_EQ(m.step(dt).failure, StepFailure::none);
    most = std::max(most, m.energy().total() / first);
  }
  std::printf("[ measured ] %s: dt %.4g us (%.2f of the limit), energy times %.4g after %d steps\n", f.governing(),
              1e6 * dt, factor, most, k);
  return most;
}

void expectSharp(const Garment& g, const char* governing, const ModelOptions& options = {}) {
  EXPECT_LT(growth(g, options, 0.95, 2000, governing), 1.01 / (1 - 0.95 * 0.95));
  EXPECT_GT(growth(g, options, 1.1, 300, governing), 1e3);
}

TEST(StableStep, SharpWhereTheMembraneGoverns) { expectSharp(squareSheet(8, 0.2, 0), "membrane"); }

TEST(StableStep, SharpWhereLinearBendingGoverns) {
  Fabric f = sheetFabric();
  f.law = LinearBending{{0.02, 0.02, 0.02}};
  expectSharp(squareSheet(8, 0.2, 0, f), "bending");
}

/// Curved at rest, four patches that meet inside, joined smoothly through T.
TEST(StableStep, SharpOnACurvedSheetWithSmoothSeams) {
  Fabric f = plainFabric();
  f.rest_curvature_of_shape = true;
  expectSharp(fourPatches(2, 2, false, SeamKind::G1, 0, f), "bending");
  f.young_weft_Pa = f.young_warp_Pa = 2e5;
  f.shear_Pa = 8e4;
  ModelOptions o;
  o.samples_per_cell = 3;
  expectSharp(fourPatches(2, 3, true, SeamKind::G1, 0, f), "membrane", o);
}

TEST(StableStep, SharpWhereTheSpringsOfSeamsGovern) {
  Fabric f = plainFabric();
  f.rest_curvature_of_shape = true;
  expectSharp(fourPatches(2, 2, false, SeamKind::C0, 300, f), "seam");
}

TEST(StableStep, SharpWhereASupportingSpringGoverns) {
  ModelOptions o;
  o.anchor_count = 1;
  o.springs = {{0, 0, 1e3}, {8, 0, 500}};
  expectSharp(squareSheet(8, 0.2, 0), "spring", o);
}

/// A point mass on a spring: omega^2 = k N^2 / m at a corner sample, which one control point carries.
TEST(StableStep, FrequencyOfASpringOnAPoint) {
  ModelOptions o;
  o.anchor_count = 1;
  o.springs = {{0, 0, 1e6}};
  Motion m(squareSheet(4, 0.2, 0), {{0, 0, 0}, 0}, {}, o);
  const double exact = std::sqrt(1e6 / m.model->mass_kg[0]);
  EXPECT_NEAR(largestFrequency(*m.model, m.stage, m.state, 60, m.work).largest_rad_per_s, exact, 1e-3 * exact);
}

/// Eq. 2.14's regularised root is steepest at no curvature: the step allows for that slope also where the cloth is
/// bent.
TEST(StableStep, AllowsForTheSteepestBendingLaw) {
  Fabric f = sheetFabric();
  f.law = ZhengBending{{1e-2, 1e-2}, 30, 3};
  Fabric linear = sheetFabric();
  const double steepest = zhengSteepest(1e-2, 30.0, 3.0);
  linear.law = LinearBending{{steepest, steepest}};
  double omega[2];
  int at = 0;
  for (const Fabric& fabric : {f, linear}) {
    Motion m(squareSheet(8, 0.2, 0, fabric), {{0, 0, 0}, 0});
    for (Vec3& x : m.state.p) x.z += 5 * x.x * x.x;  // curvature 10/m
    omega[at++] = largestFrequency(*m.model, m.stage, m.state, 60, m.work).largest_rad_per_s;
  }
  EXPECT_NEAR(omega[0], omega[1], 1e-3 * omega[1]);
}

}  // namespace
}  // namespace gambeson
