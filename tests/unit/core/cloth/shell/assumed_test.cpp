/// Assumed strains: the default rule of quadratic cells bends thin sheets without locking, and holds every mode that
/// the full rule holds.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/cloth/patches/patch_supports.hpp"
#include "core/cloth/shell/tangent.hpp"
#include "core/statics/statics.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Eigen::VectorXd spectrum(const Garment& g, CellRule rule, double stretch_x = 1) {
  const Shell shell(g, widestKernels(), 0, rule);
  const FreeMap map = buildFreeMap(g);
  const Tangent tangent(shell, map);
  ClothWork work;
  BlockMatrix K;
  std::vector<Vec3> q = restPoints(g);
  for (Vec3& x : q) x.x *= stretch_x;
  tangent.assemble(shell, q, work, K);
  const int n = 3 * K.rows();
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(n, n);
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          full(3 * r + i, 3 * K.columns[k] + j) = full(3 * K.columns[k] + j, 3 * r + i) = K.values[9 * k + 3 * i + j];
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(full, Eigen::EigenvaluesOnly).eigenvalues();
}

int zeros(const Eigen::VectorXd& values) {
  return static_cast<int>((values.array() < 1e-10 * values.maxCoeff()).count());
}

/// A thin shell at rest is free in six ways and no more, also on distorted, curved and rational patches.
TEST(CellRules, HoldEveryModeThatTheFullRuleHolds) {
  Fabric f = plainFabric();
  f.law = ConsistentBending{};
  f.thickness_m = 0.02;
  const std::vector<NurbsPatch> patches{flatPatch(uniformKnots(2, 7), uniformKnots(2, 6), 1, 1),
                                        flatPatch(uniformKnots(2, 6), uniformKnots(2, 6), 1, 1, 0.25),
                                        flatPatch(uniformKnots(2, 9), uniformKnots(2, 1), 9, 1),
                                        flatPatch(uniformKnots(2, 2), uniformKnots(2, 3), 1, 1),
                                        flatPatch(uniformKnots(2, 3), uniformKnots(2, 3), 1, 1),
                                        curvedPatch(2, 2, false),
                                        curvedPatch(2, 2, true)};
  for (const NurbsPatch& patch : patches) {
    const Garment g = garmentOf({patch}, {}, f, turnedWeft());
    const Eigen::VectorXd full = spectrum(g, CellRule::full);
    EXPECT_EQ(zeros(full), 6);
    for (CellRule rule : {CellRule::automatic, CellRule::assumed}) {
      const Eigen::VectorXd assumed = spectrum(g, rule);
      EXPECT_EQ(zeros(assumed), 6);
      // Locking makes the full rule stiffer; it must not be softer by more than a factor where no locking is: the flat
      // plates' upper half of the spectrum is membrane.
      const auto upper = assumed.size() / 2;
      EXPECT_GT((assumed.tail(upper).array() / full.tail(upper).array()).minCoeff(), 0.3);
      EXPECT_LT((assumed.array() / full.array().max(1e-10 * full.maxCoeff())).maxCoeff(), 1.6);
    }
  }
}

/// 1 to 4 x 1 to 4 cells, free, at rest: six motions without stiffness and no more. And pulled along x without bending
/// stiffness, where a quadratic that vanishes at the two points of the one cell across would meet no stiffness at all:
/// as many as under the full rule.
TEST(CellRules, LeaveNoModeOutOnFewCells) {
  Fabric f = plainFabric();
  f.law = ConsistentBending{};
  f.thickness_m = 0.02;
  Fabric limp = plainFabric();
  limp.law = LinearBending{{1e-14, 1e-14, 1e-14}};
  limp.poisson = 0;
  for (int nu = 1; nu <= 4; ++nu)
    for (int nv = 1; nv <= 4; ++nv) {
      SCOPED_TRACE(std::to_string(nu) + " x " + std::to_string(nv) + " cells");
      const KnotVector u = uniformKnots(2, nu), v = uniformKnots(2, nv);
      const auto bent = [](double a, double b) {
        return Vec3{a, b - 0.2 * a * b, 0.4 * a * a + 0.2 * b * b - 0.1 * a};
      };
      for (const NurbsPatch& patch :
           {flatPatch(u, v, 1, 1), flatPatch(u, v, 1, 1, 0.2), flatPatch(u, v, 8, 1), patchOf(u, v, bent)})
        for (CellRule rule : {CellRule::automatic, CellRule::assumed})
          EXPECT_EQ(zeros(spectrum(garmentOf({patch}, {}, f, turnedWeft()), rule)), 6);
      const Garment pulled = garmentOf({flatPatch(u, v, 1, 1)}, {}, limp);
      EXPECT_EQ(zeros(spectrum(pulled, CellRule::automatic, 1.1)), zeros(spectrum(pulled, CellRule::full, 1.1)));
    }
  // Cells that meet in double knots are as blind as one.
  KnotVector folded = uniformKnots(2, 2);
  folded.knots.insert(folded.knots.begin() + 3, folded.knots[3]);
  const Garment pulled = garmentOf({flatPatch(uniformKnots(2, 4), folded, 1, 1)}, {}, limp);
  EXPECT_EQ(zeros(spectrum(pulled, CellRule::automatic, 1.1)), zeros(spectrum(pulled, CellRule::full, 1.1)));
}

/// Cantilever under end shear (Sze, Liu and Lo 2004, section 3.1), exact inextensible elastica: W = 6.69964 at the full
/// load P L^2 = 4 E I, whatever the thickness.
double tipOfCantilever(double thickness, CellRule rule, int cells_across = 3) {
  Fabric f;
  f.thickness_m = thickness;
  f.density_kg_per_m3 = 1000;
  f.young_weft_Pa = f.young_warp_Pa = 1.2e6;
  f.shear_Pa = 0.6e6;
  f.law = ConsistentBending{};
  const Garment g = garmentOf({patchOf(uniformKnots(2, 16), uniformKnots(2, cells_across),
                                       [](double a, double b) {
                                         return Vec3{10 * a, b, 0};
                                       })},
                              {}, f);
  StructureOptions options;
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const PatchEdge clamp{0, Side::u0, false}, end{0, Side::u1, false};
  options.constraints = supportEdge(g, clamp, all);
  for (LinearConstraint& c : clampRotation(g, clamp)) options.constraints.push_back(std::move(c));
  const double EI = 1.2e6 * thickness * thickness * thickness / 12;
  options.programs = {{{0, 1}, {0, 1}}};
  options.dead = {{edgeForce(g, end, {0, 0, 4 * EI / 100}), 0}};
  const auto structure = buildStructure(g, options, {.rule = rule});
  double tip = 0;
  StaticOptions steps;
  steps.steps = 8;
  const StaticReport report = solveStatic(*structure, steps, [&](const StaticPoint& point) {
    tip = controlPoints(*structure, point.y, point.factor).back().z;
    return true;
  });
  EXPECT_TRUE(report.reached) << report.why;
  return tip;
}

/// Nor does it matter how few cells a strip has across: what locks is along it.
TEST(CellRules, ANarrowStripBendsAsAWideOne) {
  const double wide = tipOfCantilever(0.01, CellRule::automatic);
  for (int cells : {1, 2}) EXPECT_NEAR(tipOfCantilever(0.01, CellRule::automatic, cells), wide, 1e-3 * wide);
}

TEST(AssumedStrains, ACantileverBendsAlikeForAnyThickness) {
  const double exact = 6.69964;
  for (double thickness : {0.1, 0.01, 0.001}) {
    const double full = tipOfCantilever(thickness, CellRule::full),
                 assumed = tipOfCantilever(thickness, CellRule::assumed);
    printf("thickness %.0e: tip %.4f full rule, %.4f assumed strains, %.4f exact\n", thickness, full, assumed, exact);
    EXPECT_NEAR(assumed, exact, 5e-3 * exact);
    EXPECT_LT(full, assumed);
    // The default frees a good part of what the full rule locks.
    const double fewer = tipOfCantilever(thickness, CellRule::automatic);
    printf("                 %.4f default rule\n", fewer);
    EXPECT_LT(std::abs(fewer - exact), 0.5 * std::abs(full - exact));
  }
}

}  // namespace
}  // namespace gambeson
