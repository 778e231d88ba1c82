// Laws at the points of the shell: sections, tension fields, fields over a patch, cut cells, and what queries say.
#include <gtest/gtest.h>

#include "core/cloth/shell/tangent.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

struct Answer {
  double energy = 0;
  std::vector<Vec3> force;
  BlockMatrix K;
};

Answer answerOf(const Garment& g, double size = 0.03) {
  const FreeMap map = buildFreeMap(g);
  const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, size));
  const Shell shell(g, widestKernels());
  Answer a;
  a.force = forceOn(shell, q, &a.energy);
  ClothWork work;
  Tangent(shell, map).assemble(shell, q, work, a.K);
  return a;
}

void expectSame(const Answer& a, const Answer& b, double tolerance = 1e-12) {
  EXPECT_NEAR(a.energy, b.energy, tolerance * a.energy);
  double force = 0, stiffness = 0;
  for (const Vec3& f : a.force) force = std::max(force, norm(f));
  for (double k : a.K.values) stiffness = std::max(stiffness, std::abs(k));
  ASSERT_EQ(a.force.size(), b.force.size());
  for (std::size_t i = 0; i < a.force.size(); ++i) EXPECT_LE(norm(a.force[i] - b.force[i]), tolerance * force);
  ASSERT_EQ(a.K.columns, b.K.columns);
  for (std::size_t i = 0; i < a.K.values.size(); ++i) EXPECT_NEAR(a.K.values[i], b.K.values[i], tolerance * stiffness);
}

/// One ply along the weft is the consistent sheet of the same moduli, and both are the linear fabric with rigidities
/// E h^3/12/(1 - nu nu') -- where it has no coupling of weft and warp bending, nu = 0, and bends from the rest shape.
TEST(ShellSection, PlyConsistentAndGivenRigidities) {
  Fabric consistent = plainFabric();
  consistent.law = ConsistentBending{};
  consistent.poisson = 0;
  consistent.thickness_m = 0.1;
  Fabric given = consistent;
  const double i = 1e-3 / 12;
  given.law = LinearBending{{given.young_weft_Pa * i, given.young_warp_Pa * i, given.shear_Pa * i}};
  given.rest_curvature_of_shape = true;
  Fabric ply = consistent;
  ply.law = Laminate{{{0.1, consistent.young_weft_Pa, consistent.young_warp_Pa, consistent.shear_Pa, 0, 0}}};
  const auto on = [](const Fabric& f) { return answerOf(garmentOf({curvedPatch(2, 3, true)}, {}, f, turnedWeft())); };
  expectSame(on(consistent), on(given));
  expectSame(on(consistent), on(ply));
}

/// Plies from the other side, angles mirrored, on a patch whose normal points the other way: the same sheet.
TEST(ShellSection, TheSignOfTheCouplingFollowsTheNormal) {
  Fabric up = plainFabric(), down = plainFabric();
  up.law = Laminate{{{0.05, 200, 50, 30, 0.3, 0.4}, {0.08, 100, 60, 25, 0.2, -0.7}}};
  down.law = Laminate{{{0.08, 100, 60, 25, 0.2, 0.7}, {0.05, 200, 50, 30, 0.3, -0.4}}};
  const NurbsPatch patch = curvedPatch(2, 2, false), turned = flippedU(patch);
  const Garment a = garmentOf({patch}, {}, up), b = garmentOf({turned}, {}, down);
  std::vector<Vec3> q = deformedFree(a, buildFreeMap(a), 0.03), r(q.size());
  for (int j = 0; j < patch.v.count(); ++j)
    for (int i = 0; i < patch.u.count(); ++i) r[patch.index(patch.u.count() - 1 - i, j)] = q[patch.index(i, j)];
  double ea, eb;
  const auto fa = forceOn(Shell(a, widestKernels()), q, &ea), fb = forceOn(Shell(b, widestKernels()), r, &eb);
  EXPECT_NEAR(ea, eb, 1e-12 * ea);
  // The other order is another sheet.
  std::swap(std::get<Laminate>(down.law).plies[0], std::get<Laminate>(down.law).plies[1]);
  forceOn(Shell(garmentOf({turned}, {}, down), widestKernels()), r, &eb);
  EXPECT_GT(std::abs(ea - eb), 1e-4 * ea);
}

/// Pulled along the weft, a crossed pair of plies with the stiff one above bends so that the stiff side is inside:
/// n = A e + B k, m = B e + D k = 0 for a free strip; the shell's energy at that state is the least.
TEST(ShellSection, StatesAtAPoint) {
  Fabric f = plainFabric();
  f.law = Laminate{{{0.05, 200, 50, 30, 0.3, 0}, {0.05, 200, 50, 30, 0.3, kPi / 2}}};
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1)}, {}, f);
  const Shell shell(g, widestKernels());
  std::vector<Vec3> q = restPoints(g);
  for (Vec3& x : q) x = {1.02 * x.x, 0.99 * x.y + 0.01 * x.x, x.z};
  const PointState s = shell.stateAt(0, {0.3, 0.6}, q);
  const double E11 = 0.5 * (1.02 * 1.02 + 0.01 * 0.01 - 1), E22 = 0.5 * (0.99 * 0.99 - 1), g12 = 0.99 * 0.01;
  EXPECT_NEAR(s.strain.x, E11, 1e-14);
  EXPECT_NEAR(s.strain.y, E22, 1e-14);
  EXPECT_NEAR(s.strain.z, g12, 1e-14);
  EXPECT_NEAR(norm(s.curvature_change), 0, 1e-12);
  const Section section = laminate(f.laminate()->plies);
  EXPECT_NEAR(s.n.x, section.A[0] * E11 + section.A[3] * E22, 1e-12);
  EXPECT_NEAR(s.n.z, section.A[2] * g12, 1e-12);
  EXPECT_NEAR(s.m.x, section.B[0] * E11 + section.B[3] * E22, 1e-12);
  EXPECT_NEAR(s.m.y, section.B[3] * E11 + section.B[1] * E22, 1e-12);
  double energy;
  forceOn(shell, q, &energy);
  EXPECT_NEAR(energy, 0.5 * (dot(s.n, s.strain)), 1e-12) << "area 1, no bending";
}

TEST(ShellSection, ConstantFieldsAreTheFabricTurnedOrThickened) {
  for (Bends law : {Bends::linear, Bends::zheng, Bends::consistent})
    for (bool trimmed : {false, true}) {
      Garment plain = garmentOf({curvedPatch(2, 2, true)}, {}, plainFabric(law), {1, 0, 0});
      plain.fabric.rest_curvature_of_shape = true;
      if (trimmed) plain.trims = {{{{circle({0.5, 0.45}, 0.22, 0.3, true)}}}};
      Garment with = plain;
      with.fields.resize(1);
      with.fields[0].thickness = PatchField{1, 2, 2, {1.7, 1.7, 1.7, 1.7}};
      plain.fabric.thickness_m *= 1.7;
      if (GivenRigidities* given = givenRigidities(plain.fabric.law)) given->stiffen(1.7 * 1.7 * 1.7);
      expectSame(answerOf(plain), answerOf(with));
    }
  // On a flat sheet the turned weft is a vector.
  Fabric f = plainFabric();
  f.law = Laminate{{{0.05, 200, 50, 30, 0.3, 0.4}, {0.08, 100, 60, 25, 0.2, -0.7}}};
  const NurbsPatch flat = flatPatch(uniformKnots(2, 3), uniformKnots(3, 2), 1.2, 0.9, 0.3);
  Garment angle = garmentOf({flat}, {}, f, {1, 0, 0});
  angle.fields.resize(1);
  angle.fields[0].fibre_angle = PatchField{0, 1, 1, {kPi / 6}};
  expectSame(answerOf(garmentOf({flat}, {}, f, turnedWeft())), answerOf(angle));
}

/// The same points once as factors and once one by one: a trim that cuts off nothing but a corner cell's tip.
TEST(ShellSection, CutCellsIntegrateTheSameEnergy) {
  // A uniform strain of a flat sheet: the energy is the density times the area that is left.
  Garment g = garmentOf({flatPatch(uniformKnots(2, 5), uniformKnots(2, 5), 1, 1)}, {}, plainFabric(), turnedWeft());
  std::vector<Vec3> q = restPoints(g);
  for (Vec3& x : q) x = {1.05 * x.x, 0.97 * x.y, 0.1 * x.x};
  double whole, trimmed;
  forceOn(Shell(g, widestKernels()), q, &whole);
  g.trims = {{{{circle({0.5, 0.5}, 0.25, 0.25, true)}}}};
  g.trims[0].points_per_piece = 8;
  forceOn(Shell(g, widestKernels()), q, &trimmed);
  EXPECT_NEAR(trimmed, whole * (1 - kPi / 16), 1e-9 * whole);
}

/// A strip pulled along and pressed across: with a tension field the press costs nothing, E h e^2/2 is left.
TEST(ShellSection, TensionFieldOfASheet) {
  Fabric f = plainFabric();
  f.young_warp_Pa = f.young_weft_Pa;
  f.shear_Pa = 0.5 * f.young_weft_Pa / (1 + f.poisson);
  f.tension_field = true;
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1)}, {}, f, turnedWeft());
  std::vector<Vec3> q = restPoints(g);
  for (Vec3& x : q) x = {1.1 * x.x, 0.8 * x.y, 0};
  double energy;
  const Shell shell(g, widestKernels());
  forceOn(shell, q, &energy);
  const double e = 0.5 * (1.21 - 1);
  EXPECT_NEAR(energy, 0.5 * f.young_weft_Pa * f.thickness_m * e * e, 1e-12);
  const PrincipalStress stress = shell.stressAt(0, {0.4, 0.4}, q);
  EXPECT_NEAR(stress.principal2_N_per_m, 0, 1e-12);
  EXPECT_NEAR(stress.principal1_N_per_m, f.young_weft_Pa * f.thickness_m * e * 1.1 / 0.8, 1e-12);
}

std::string refusal(const Garment& g) {
  try {
    Shell(g, widestKernels());
  } catch (const InputError& e) {
    return e.where().key;
  }
  return "accepted";
}

TEST(ShellSection, WrongLawsAreRefused) {
  const Garment good = garmentOf({curvedPatch(2, 2, true)}, {}, plainFabric());
  EXPECT_EQ(refusal(good), "accepted");
  Garment g = good;
  g.fabric.law = Laminate{{{0.05, 200, 50, 30, 0.3, 0}, {0.05, 200, 50, 30, 0.3, 1}}};
  std::vector<Ply>& plies = std::get<Laminate>(g.fabric.law).plies;
  EXPECT_EQ(refusal(g), "accepted");
  g.fabric.tension_field = true;
  EXPECT_EQ(refusal(g), "fabric.tension_field");
  plies.pop_back();
  EXPECT_EQ(refusal(g), "accepted");
  plies[0].young1_Pa = 0;
  EXPECT_EQ(refusal(g), "fabric.plies[0].young1_Pa");
  g = good;
  g.other_fabrics = {plainFabric()};
  g.other_fabrics[0].thickness_m = -1;
  EXPECT_EQ(refusal(g), "other_fabrics[0].thickness_m");
  g = good;
  g.fields.resize(2);
  EXPECT_EQ(refusal(g), "fields");
  g = good;
  g.fabric.law = ConsistentBending{};
  EXPECT_EQ(refusal(g), "accepted");
}

}  // namespace
}  // namespace gambeson
