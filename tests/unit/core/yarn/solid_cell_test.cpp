/// Cells of solid yarns: loads, symmetry, resultants, contact, friction (issue 21, A10 and A13 to A16). Meshes are
/// coarse here.

#include "core/yarn/solid_response.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/yarn/solid_stress.hpp"

namespace gambeson {
namespace {

/// Man 2006, section 4.3.5.2, in GPa; lengths in spacings: forces are GPa times spacing squared.
constexpr BonetBurton kYarn{0.4457, 0.5154, 0.2714, 0.06548, 10.54};

SolidCellDesign designOf(const YarnMeshing& meshing = {2, 7}, bool quarter = true) {
  const WovenYarn y{1, 0.16, 0.24, 0.16};
  SolidCellDesign d;
  d.yarns = {plainWeave(), {y, y}};
  d.law = {kYarn, kYarn};
  d.meshing = meshing;
  d.quarter = quarter;
  return d;
}

SolidLoadOptions exactOptions() {
  SolidLoadOptions o;
  o.change = o.deepest = 1e-7;
  o.tolerance = 1e-11;
  return o;
}

/// From rest by way of the loads.
SolidCellState at(const SolidCell& cell, SolidCellWork& work, const std::vector<CellLoad>& loads,
                  const SolidLoadOptions& options = {}) {
  SolidCellState state = restOf(cell);
  for (const CellLoad& load : loads) {
    const SolidLoadReport report = changeLoad(cell, load, state, work, options);
    EXPECT_TRUE(report.reached) << report.why;
  }
  return state;
}

CellLoad biaxial(double stretch) { return loadOf({stretch, 0, 0, stretch}); }

/// E12 at a biaxial stretch.
CellLoad sheared(double e12, double stretch) {
  CellLoad load = biaxial(stretch);
  load.g12 = 2 * e12;
  return load;
}

std::array<double, 3> stressAt(const SolidCellDesign& design, const std::vector<CellLoad>& loads,
                               const SolidLoadOptions& options = {}) {
  const SolidCell cell(design);
  SolidCellWork work(cell);
  return stressOf(cell, resultantsOf(cell, at(cell, work, loads, options)));
}

TEST(SolidCell, IsWithoutForceAtRestAndMovesWithItsFaces) {
  const SolidCell cell(designOf());
  SolidCellWork work(cell);
  SolidCellState state = restOf(cell);
  const CellResultants n = resultantsOf(cell, state);
  EXPECT_NEAR(n.energy_J_per_m2, 0, 1e-16);
  EXPECT_NEAR(n.n11, 0, 1e-12);
  EXPECT_NEAR(cell.height_m(), 0.64, 1e-15);
  EXPECT_NEAR(cell.volumeFraction(), 0.400, 0.001);
  const CellLoad load{0.02, -0.01, 0.03, 0, 0};
  ASSERT_TRUE(changeLoad(cell, load, state, work).reached);
  const CellFaces faces = facesOf(cell.yarns(), load);
  for (const YarnBody& b : cell.solids().bodies)
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2; ++i) {
        const Vec3 near = state.x[cell.solids().node(b, 0, i, j)],
                   far = state.x[cell.solids().node(b, b.sections - 1, i, 2 - j)];
        const Vec3 step = 0.5 * faces.step[b.direction].origin;
        EXPECT_NEAR(far.x - near.x, step.x, 1e-13);
        EXPECT_NEAR(far.y - near.y, step.y, 1e-13);
        EXPECT_NEAR(far.z + near.z, 0, 1e-13);
      }
}

TEST(SolidCell, QuarterIsTheFullCell) {  // A14: 1e-4 of the largest resultant
  for (const std::vector<CellLoad>& loads :
       {std::vector<CellLoad>{biaxial(1.02)}, {biaxial(1.01), sheared(0.1, 1.01)}}) {
    const auto quarter = stressAt(designOf({2, 5}, true), loads, exactOptions());
    const auto full = stressAt(designOf({2, 5}, false), loads, exactOptions());
    EXPECT_GT(quarter[0], 0.01);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(quarter[k], full[k], 1e-4 * quarter[0]) << k;
  }
}

TEST(SolidCell, HeldFacesStiffenTheQuarterMost) {  // A14: S12 at E12 = 0.10
  const std::vector<CellLoad> loads{biaxial(1.01), sheared(0.05, 1.01), sheared(0.1, 1.01)};
  const auto shearOf = [&](bool quarter, FaceSupport faces) {
    SolidCellDesign d = designOf({2, 7}, quarter);
    d.faces = faces;
    return stressAt(d, loads)[2];
  };
  const double held_full = shearOf(false, FaceSupport::held), held_quarter = shearOf(true, FaceSupport::held);
  EXPECT_GT(held_quarter, held_full);
  EXPECT_GT(held_full, 1.01 * shearOf(true, FaceSupport::glide));  // of the full cell, too: the test before
}

/// Derivatives by a load's numbers, of energy and resultants, by central differences.
struct Difference {
  double energy, n[3];
};
Difference differenceAt(const SolidCell& cell, SolidCellWork& work, const SolidCellState& state, int e,
                        const SolidLoadOptions& options) {
  constexpr double h = 1e-5;
  CellResultants n[2];
  for (const int side : {0, 1}) {
    SolidCellState moved = state;
    CellLoad load = state.load;
    (e == 0 ? load.e11 : e == 1 ? load.e22 : load.g12) += side ? h : -h;
    EXPECT_TRUE(changeLoad(cell, load, moved, work, options).reached);
    n[side] = resultantsOf(cell, moved);
  }
  return {(n[1].energy_J_per_m2 - n[0].energy_J_per_m2) / (2 * h),
          {(n[1].n11 - n[0].n11) / (2 * h), (n[1].n22 - n[0].n22) / (2 * h), (n[1].n12 - n[0].n12) / (2 * h)}};
}

TEST(SolidCell, ResultantsAndTangentAreDerivatives) {  // A15: 1e-5
  for (const SolidContactMethod method : {SolidContactMethod::penalty, SolidContactMethod::augmented}) {
    const SolidCell cell(designOf());
    SolidCellWork work(cell);
    SolidLoadOptions options = exactOptions();
    options.method = method;
    const SolidCellState state = at(cell, work, {biaxial(1.02), {0.02, 0.015, 0.05, 0, 0}}, options);
    EXPECT_GT(state.points.size(), 3u);
    const CellResultants n = resultantsOf(cell, state);
    const double resultants[3] = {n.n11, n.n22, n.n12};
    const std::array<double, 9> D = membraneTangent(cell, state, work, method);
    for (int e = 0; e < 3; ++e) {
      const Difference d = differenceAt(cell, work, state, e, options);
      EXPECT_NEAR(d.energy, resultants[e], 1e-5 * n.n11) << e;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(D[3 * k + e], d.n[k], 1e-5 * D[0]) << k << e;
    }
  }
}

TEST(SolidCell, WithoutContactAYarnStraightensAsABeamThatShears) {  // A13: 7 %
  SolidCellDesign d = designOf({4, 9});
  for (WovenYarn& y : d.yarns.yarn) y = {1, 0.08, 0.12, 0.08};
  d.contact = false;
  const SolidCell cell(d);
  SolidCellWork work(cell);
  SolidCellState state = restOf(cell);
  const TransverseModuli m = moduliOf(kYarn);
  const double area = std::numbers::pi * 0.12 * 0.08, EA = m.axial_young_Pa * area, GA = m.axial_shear_Pa * area;
  const double B = 0.25 * EA * 0.08 * 0.08, P = 1 / (1 / (std::numbers::pi * std::numbers::pi * B) + 1 / GA);
  for (const double stretch : {1.004, 1.008, 1.012}) {
    ASSERT_TRUE(changeLoad(cell, biaxial(stretch), state, work).reached);
    const double T = resultantsOf(cell, state).n11 * stretch;  // n11 dE11 = T d(stretch)
    const double A = 0.08, left = A / (1 + T / P);
    const double strain = 0.25 * std::numbers::pi * std::numbers::pi * (A * A - left * left) + T / EA;
    EXPECT_NEAR(strain, stretch - 1, 0.07 * (stretch - 1)) << T;
  }
}

TEST(SolidCell, BiaxialStressIsAsFound) {  // A16, GPa at E11 = 0.041
  const auto S = stressAt(designOf({4, 13}), {biaxial(1.02), biaxial(1.0402)});
  EXPECT_NEAR(S[0], 0.200, 0.05 * 0.200);
  EXPECT_NEAR(S[1], S[0], 0.01 * S[0]);
}

TEST(SolidCell, UniaxialStressIsAsFound) {  // A16, GPa at E11 = 0.041
  const auto S = stressAt(designOf({4, 13}), {loadOf({1.02, 0, 0, 1}), loadOf({1.0402, 0, 0, 1})});
  EXPECT_NEAR(S[0], 0.109, 0.05 * 0.109);
  EXPECT_NEAR(S[1], 0.056, 0.05 * 0.056);
}

TEST(SolidCell, StiffYarnsPullLessOnThoseTheyCross) {  // Man 2006, fig. 21 beside 24; at E11 = 0.06
  double ratio[2];
  for (const bool isotropic : {false, true}) {
    SolidCellDesign d = designOf();
    if (isotropic) d.law = {isotropicLaw(84.63, 0.3), isotropicLaw(84.63, 0.3)};
    const double most = std::sqrt(1.12);
    const auto S = stressAt(d, {loadOf({1 + 0.5 * (most - 1), 0, 0, 1}), loadOf({most, 0, 0, 1})});
    ratio[isotropic] = S[1] / S[0];
  }
  EXPECT_LT(ratio[true], 0.75 * ratio[false]);
}

TEST(SolidCell, IsSoftWherePressedOrWithoutContact) {  // A16
  const auto extended = stressAt(designOf({2, 9}), {biaxial(1.02), loadOf({std::sqrt(1.1), 0, 0, std::sqrt(1.1)})});
  const auto pressed = stressAt(designOf({2, 9}), {loadOf({std::sqrt(0.9), 0, 0, std::sqrt(0.9)})});
  EXPECT_LT(pressed[0], 0);
  EXPECT_GT(pressed[0], -0.06 * extended[0]);
  SolidCellDesign d = designOf({4, 13});
  d.contact = false;
  EXPECT_LT(stressAt(d, {biaxial(1.04)})[0], 0.03);
}

TEST(SolidCell, FrictionDoublesTheShearOfATrellis) {  // A10: E12 = 0.12 at 1 % stretch
  double s12[2];
  for (const double mu : {0.0, 0.3}) {
    SolidCellDesign d = designOf();
    d.friction = mu;
    std::vector<CellLoad> loads{biaxial(1.01)};
    for (int k = 1; k <= 6; ++k) loads.push_back(trellis(std::asin(2 * 0.02 * k), 1.01));
    s12[mu > 0] = stressAt(d, loads)[2];
  }
  EXPECT_GT(s12[0], 0);
  EXPECT_GT(s12[1], 2 * s12[0]);
}

TEST(SolidCell, AClosedLoopWithoutFrictionLosesNothing) {  // A10: 1e-4 of the work
  const SolidCell cell(designOf());
  SolidCellWork work(cell);
  SolidCellState state = at(cell, work, {biaxial(1.01)}, exactOptions());
  const CellResultants before = resultantsOf(cell, state);
  CellResultants n = before;
  double done = 0, most = 0;
  for (const double e12 : {0.04, 0.08, 0.04, 0.0}) {
    const double from = state.load.g12;
    ASSERT_TRUE(changeLoad(cell, sheared(e12, 1.01), state, work, exactOptions()).reached);
    const CellResultants next = resultantsOf(cell, state);
    done += 0.5 * (n.n12 + next.n12) * (state.load.g12 - from);
    most = std::max(most, done);
    n = next;
  }
  EXPECT_GT(most, 0);
  EXPECT_NEAR(done, 0, 1e-4 * most);
  EXPECT_NEAR(n.energy_J_per_m2, before.energy_J_per_m2, 1e-4 * before.energy_J_per_m2);
}

TEST(SolidCell, MeanStressIsLessThanTheFacesCarryInShear) {  // 4.64 is not conjugate to the load
  const SolidCell cell(designOf());
  SolidCellWork work(cell);
  const SolidCellState state = at(cell, work, {biaxial(1.01), sheared(0.1, 1.01)});
  const auto S = stressOf(cell, resultantsOf(cell, state)), mean = meanStress(cell, state.x);
  EXPECT_NEAR(mean[0], S[0], 0.02 * S[0]);
  EXPECT_LT(mean[2], 0.8 * S[2]);
}

TEST(SolidCell, StretchedWithFreeSidesItHasNoStressAcross) {
  const SolidCell cell(designOf());
  SolidCellWork work(cell);
  SolidCellState state = at(cell, work, {loadOf({1.02, 0, 0, 1})}, exactOptions());
  EXPECT_GT(resultantsOf(cell, state).n22, 0.1 * resultantsOf(cell, state).n11);
  const SolidLoadReport report = freeAcross(cell, state, work, 1e-6, exactOptions());
  ASSERT_TRUE(report.reached) << report.why;
  const CellResultants n = resultantsOf(cell, state);
  EXPECT_LT(std::abs(n.n22), 1e-6 * n.n11);
  EXPECT_LT(state.load.e22, -1e-3);
  EXPECT_NEAR(state.load.e11, 0.5 * (1.02 * 1.02 - 1), 1e-12);
}

TEST(SolidCell, SameBitsForAnyNumberOfThreads) {
  std::vector<Vec3> x[2];
  const int before = omp_get_max_threads();
  for (const int k : {0, 1}) {
    omp_set_num_threads(k == 0 ? 1 : 3);
    SolidCellDesign d = designOf({2, 5});
    d.friction = 0.2;
    const SolidCell cell(d);
    SolidCellWork work(cell);
    x[k] = at(cell, work, {biaxial(1.01), sheared(0.05, 1.01)}).x;
  }
  omp_set_num_threads(before);
  EXPECT_EQ(x[0], x[1]);
}

TEST(SolidCell, YarnsOfOtherWeavesAreHeldWithoutForce) {
  SolidCellDesign d = designOf({2, 5}, false);
  d.yarns.weave = twillWeave(2, 1);
  const SolidCell cell(d);
  SolidCellWork work(cell);
  SolidLoadOptions options;
  options.method = SolidContactMethod::penalty;
  const SolidCellState state = at(cell, work, {biaxial(1.01)}, options);
  const CellResultants n = resultantsOf(cell, state);
  EXPECT_GT(n.n11, 1e-3);
  EXPECT_GT(n.n22, 1e-3);
  SolidWork scratch;
  std::vector<Vec3> force(state.x.size());
  cell.body().force(state.x, force, scratch);
  cell.contact().addForce(state.points, force);
  double at_ends = 0, between = 0;
  for (const YarnBody& b : cell.solids().bodies)
    for (int k = 0; k < 9 * b.sections; ++k) {
      double& most = k < 9 || k >= 9 * (b.sections - 1) ? at_ends : between;
      most = std::max(most, norm(force[b.first_node + k]));
    }
  EXPECT_GT(at_ends, 1e-4);
  EXPECT_LT(between, 1e-5 * at_ends);
}

std::string keyOf(const SolidCellDesign& design, const CellLoad& load = {}) {
  try {
    const SolidCell cell(design);
    SolidCellWork work(cell);
    SolidCellState state = restOf(cell);
    changeLoad(cell, load, state, work);
  } catch (const InputError& e) {
    return e.where().key;
  }
  return "";
}

TEST(SolidCell, BadInputNamesItsKey) {
  SolidCellDesign d = designOf();
  d.friction = -0.1;
  EXPECT_EQ(keyOf(d), "friction");
  d = designOf();
  d.penalty = 0;
  EXPECT_EQ(keyOf(d), "penalty");
  d = designOf();
  d.law[along_warp].mu_Pa = -1;
  EXPECT_EQ(keyOf(d), "warp.law.mu_Pa");
  d = designOf();
  d.meshing.along = 8;
  EXPECT_EQ(keyOf(d), "along");
  EXPECT_EQ(keyOf(designOf(), {0, 0, 0, 0.1, 0}), "load.curvature");
  EXPECT_EQ(keyOf(designOf(), {-0.6, 0, 0, 0, 0}), "load.e11");
}

}  // namespace
}  // namespace gambeson
