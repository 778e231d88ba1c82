/// Several garments as one: each keeps what it is alone, and contact keeps them apart by half the sum of their
/// thicknesses.

#include "core/cloth/draft/join_garments.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric thickFabric() {
  Fabric f = sheetFabric();
  f.name = "thick";
  f.thickness_m = 3e-3;
  f.density_kg_per_m3 = 500;
  f.young_warp_Pa = 90e3;
  rigidities(f).weft_Nm = 4e-5;
  return f;
}

Garment seamed() { return fourPatches(2, 2, false, SeamKind::G1, 0, plainFabric()); }

ModelOptions samplesOf(std::vector<int> per_cell) {
  ModelOptions o;
  o.patch_samples_per_cell = std::move(per_cell);
  return o;
}

/// Control points moved at random, and the force of the shell there.
std::vector<Vec3> forceOf(const Garment& g, const std::vector<Vec3>& shift, double& energy) {
  const Shell shell(g, widestKernels());
  std::vector<Vec3> q, f(shell.controlCount());
  for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
  for (std::size_t i = 0; i < q.size(); ++i) q[i] += shift[i];
  ClothWork work;
  shell.force(q, f, work, &energy);
  return f;
}

TEST(JoinGarments, JoinedGarmentsHaveTheForcesOfEach) {
  Garment varied = squareSheet(4, 0.3, 0.1, thickFabric());
  varied.fields.resize(1);
  varied.fields[0].thickness = PatchField{1, 2, 2, {1, 2, 1, 1.5}};
  varied.fields[0].material = PatchField{0, 2, 1, {0, 1}};
  varied.other_fabrics.push_back(sheetFabric());
  varied.other_fabrics[0].young_weft_Pa *= 2;
  const std::vector<Garment> garments{seamed(), squareSheet(5, 0.2, 0, thickFabric()), varied};
  const Garment all = joinGarments(garments);
  ASSERT_EQ(all.patches.size(), 6u);
  EXPECT_EQ(all.garment_of_patch, (std::vector<int>{0, 0, 0, 0, 1, 2}));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> d(-0.004, 0.004);
  std::vector<Vec3> shift(controlOffsets(all).back());
  for (Vec3& s : shift) s = {d(random), d(random), d(random)};
  double energy = 0, sum = 0;
  const std::vector<Vec3> together = forceOf(all, shift, energy);
  std::size_t at = 0;
  for (const Garment& g : garments) {
    const std::vector<Vec3> own(shift.begin() + static_cast<long>(at),
                                shift.begin() + static_cast<long>(at) + controlOffsets(g).back());
    double e = 0;
    const std::vector<Vec3> alone = forceOf(g, own, e);
    double largest = 0;
    for (const Vec3& f : alone) largest = std::max(largest, norm(f));
    EXPECT_GT(largest, 0);
    for (const Vec3& f : alone) EXPECT_LT(norm(together[at++] - f), 1e-11 * largest);
    sum += e;
  }
  EXPECT_NEAR(energy / sum, 1, 1e-12);
}

TEST(JoinGarments, OneFabricNeedsNoFields) {
  const Garment all = joinGarments(std::vector<Garment>{squareSheet(3, 0.2, 0), squareSheet(4, 0.2, 0.01)});
  EXPECT_TRUE(all.fields.empty());
  EXPECT_TRUE(all.other_fabrics.empty());
  EXPECT_EQ(all.garment_of_patch, (std::vector<int>{0, 1}));
}

TEST(JoinGarments, MassDensityAndThicknessAreThoseOfEachFabric) {
  const Garment all =
      joinGarments(std::vector<Garment>{squareSheet(3, 0.2, 0), squareSheet(4, 0.3, 0.01, thickFabric())});
  const std::unique_ptr<Model> m = buildModel(all, samplesOf({3, 2}), {}, {0, 0.3, 0.01}, {});
  const double rho[] = {sheetFabric().surfaceDensity(), thickFabric().surfaceDensity()}, area[] = {0.04, 0.09};
  double mass[2] = {0, 0};
  for (int i = 0; i < m->freeCount(); ++i) mass[i >= 25] += m->mass_kg[i];
  int samples[2] = {0, 0};
  for (int s = 0; s < m->surface.size(); ++s) {
    const int garment = m->surface.patch[s];
    EXPECT_DOUBLE_EQ(m->density_kg_per_m2[s], rho[garment]);
    EXPECT_DOUBLE_EQ(m->layer_m[s], garment == 0 ? 1.177e-3 : 3e-3);
    EXPECT_DOUBLE_EQ(m->collisions.cloth.thickness_m[s], m->layer_m[s]);
    EXPECT_EQ(m->collisions.cloth.garment[s], garment);
    ++samples[garment];
  }
  EXPECT_EQ(samples[0], 10 * 10);
  EXPECT_EQ(samples[1], 9 * 9);
  for (int k : {0, 1}) EXPECT_NEAR(mass[k] / (rho[k] * area[k]), 1, 1e-12);
  const std::unique_ptr<Model> same = buildModel(all, {}, {}, {2e-3, 0.3, 0.01}, {});
  for (double layer : same->layer_m) EXPECT_EQ(layer, 2e-3);
}

/// A thickness field weighs what it weighs: the mass is the integral of density times factor.
TEST(JoinGarments, FieldsHaveMass) {
  Garment g = squareSheet(4, 0.2, 0);
  g.fields.resize(1);
  g.fields[0].thickness = PatchField{1, 2, 2, {1, 3, 1, 3}};
  const std::unique_ptr<Model> m = buildModel(g, {}, {}, {0, 0.3, 0.01}, {});
  double mass = 0;
  for (double k : m->mass_kg) mass += k;
  EXPECT_NEAR(mass / (2 * 0.144 * 0.04), 1, 1e-12);
  for (int s = 0; s < m->surface.size(); ++s) {
    const double factor = 1 + 2 * m->surface.parameters[s].x / g.patches[0].u.back();
    EXPECT_NEAR(m->density_kg_per_m2[s], factor * 0.144, 1e-12);
    EXPECT_NEAR(m->layer_m[s], factor * 1.177e-3, 1e-15);
  }
}

/// Two sheets of unlike thickness come to rest on a plate: each at its own distance.
TEST(JoinGarments, RestAtHalfTheSumOfTheThicknesses) {
  const Garment all =
      joinGarments(std::vector<Garment>{squareSheet(4, 0.1, 1.3e-3), squareSheet(5, 0.1, 4e-3, thickFabric())});
  const Obstacle plate{TriangleMesh{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, "plate"};
  Motion m(all, {{0, 0, -9.81}, 0}, {0, 0.3, 0.002, 1e-3, 400}, {}, {plate});
  double lifted = 0;
  for (int k = 0; k < 800; ++k) {
    const StepReport r = m.step(2.5e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    if (k >= 600) lifted -= r.momentum.obstacles.z;
  }
  const double weight = 9.81 * 0.01 * (sheetFabric().surfaceDensity() + thickFabric().surfaceDensity());
  EXPECT_NEAR(lifted / (200 * 2.5e-4) / weight, 1, 1e-2);
  std::vector<Vec3> x(m.model->surface.size());
  m.model->surface.WT.multiply<Vec3>(m.state.p, x);
  for (int s = 0; s < m.model->surface.size(); ++s) {
    const double rest = m.model->surface.patch[s] == 0 ? 1.177e-3 : 1.177e-3 + 0.5 * (1.177e-3 + 3e-3);
    EXPECT_NEAR(x[s].z, rest, 2e-5);
  }
}

TEST(JoinGarments, WhatDoesNotFitIsRefused) {
  EXPECT_THROW(joinGarments({}), InputError);
  Garment wrong = squareSheet(3, 0.2, 0);
  wrong.fields.resize(2);
  EXPECT_THROW(joinGarments(std::vector<Garment>{squareSheet(3, 0.2, 0), wrong}), InputError);
  Garment wrong_count = squareSheet(3, 0.2, 0);
  wrong_count.garment_of_patch = {0, 1};
  EXPECT_THROW(buildModel(wrong_count, {}, {}, {1e-3, 0, 0.01}, {}), InputError);
  EXPECT_THROW(buildModel(seamed(), samplesOf({2, 2, 2}), {}, {1e-3, 0, 0.01}, {}), InputError);
  EXPECT_THROW(buildModel(seamed(), samplesOf({2, 2, 2, 3}), {}, {1e-3, 0, 0.01}, {}), InputError);
}

}  // namespace
}  // namespace gambeson
