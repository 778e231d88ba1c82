// The Kirchhoff-Love shell: force against energy, rigid motion, balance, patch test, stress. Zheng 2013, section 2.2.
#include "core/cloth/shell/shell.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

double largest(const std::vector<Vec3>& f) {
  double m = 0;
  for (const Vec3& v : f) m = std::max(m, norm(v));
  return m;
}

/// Every free component of -dE/dp, by central differences with one Richardson step (error h^4), against Tᵀ f.
double gradientError(const Garment& g) {
  const Shell shell(g, widestKernels());
  const FreeMap map = buildFreeMap(g);
  std::vector<Vec3> p = deformedFree(g, map, 0.02);
  const std::vector<Vec3> f = onFree(map, forceOn(shell, controlsOf(map, p)));
  // The energy of eq. 2.14 has kinks in its third derivative: a short step keeps them out of most differences.
  const double h = std::holds_alternative<LinearBending>(g.fabric.law) ? 2e-4 : 1e-5, scale = largest(f);
  double worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto energy = [&](double step) {
        const double old = p[i][c];
        p[i][c] += step;
        double e = 0;
        forceOn(shell, controlsOf(map, p), &e);
        p[i][c] = old;
        return e;
      };
      const double slope = (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
      worst = std::max(worst, std::abs(slope + f[i][c]) / scale);
    }
  return worst;
}

struct Kind {
  int p, q;
  bool rational;
};

std::string kindName(const testing::TestParamInfo<Kind>& info) {
  const Kind& k = info.param;
  return "p" + std::to_string(k.p) + "q" + std::to_string(k.q) + (k.rational ? "rational" : "");
}

class ShellForce : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Degrees, ShellForce,
                         testing::Values(Kind{2, 2, false}, Kind{2, 2, true}, Kind{3, 3, false}, Kind{3, 3, true},
                                         Kind{1, 1, false}, Kind{2, 3, true}, Kind{4, 4, true}),
                         kindName);

TEST_P(ShellForce, IsTheGradientOfTheEnergy) {
  const auto [p, q, rational] = GetParam();
  for (bool of_shape : {false, true})
    for (Bends law : {Bends::linear, Bends::zheng}) {
      Fabric fabric = plainFabric(law);
      fabric.rest_curvature_of_shape = of_shape;
      const double bound = law == Bends::linear ? 1e-8 : 1e-7;
      EXPECT_LT(gradientError(garmentOf({curvedPatch(p, q, rational)}, {}, fabric, turnedWeft())), bound);
      EXPECT_LT(gradientError(fourPatches(p, q, rational, SeamKind::C0, 0.4, fabric)), bound) << "springs";
      if (p > 1 && q > 1) {
        EXPECT_LT(gradientError(fourPatches(p, q, rational, SeamKind::G1, 0, fabric)), bound) << "through T";
      }
    }
}

/// Internal forces are in balance in any state, also across the springs of a seam.
TEST_P(ShellForce, HasNoResultantAndNoMoment) {
  const auto [p, q, rational] = GetParam();
  const Garment g = fourPatches(p, q, rational, SeamKind::C0, 0.4, plainFabric(Bends::zheng));
  const FreeMap map = buildFreeMap(g);
  const std::vector<Vec3> x = controlsOf(map, deformedFree(g, map, 0.05));
  const auto f = forceOn(Shell(g, widestKernels()), x);
  Vec3 force{}, moment{};
  double size = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    force += f[i];
    moment += cross(x[i], f[i]);
    size += norm(f[i]);
  }
  EXPECT_LT(norm(force), 1e-13 * size);
  EXPECT_LT(norm(moment), 1e-13 * size);
}

/// Against the force of a strain of 1e-3: what is left is rounding.
TEST_P(ShellForce, VanishesUnderRigidMotion) {
  const auto [p, q, rational] = GetParam();
  const Mat3 turn = rotationAbout(normalized({1, 2, -0.5}), 1.1);
  for (Bends law : {Bends::linear, Bends::zheng})
    for (bool flat : {false, true}) {
      Fabric fabric = plainFabric(law);
      fabric.rest_curvature_of_shape = !flat;
      Garment g = fourPatches(p, q, rational, SeamKind::C0, 0.4, fabric);
      if (flat)
        for (NurbsPatch& patch : g.patches)
          for (Vec3& x : patch.points) x.z = 0;
      const Shell shell(g, widestKernels());
      std::vector<Vec3> x = restPoints(g), stretched;
      for (Vec3& y : x) y = turn * y + Vec3{3, -2, 0.7};
      for (const Vec3& y : x) stretched.push_back(1.001 * y);
      double energy;
      const auto f = forceOn(shell, x, &energy);
      EXPECT_LT(largest(f), 1e-9 * largest(forceOn(shell, stretched)));
      EXPECT_NEAR(energy, 0, 1e-20);
    }
}

/// Uniform strain of a flat sheet whose control net is distorted: x = F X.
Vec3 strained(const Vec3& X) { return {1.08 * X.x + 0.11 * X.y, -0.03 * X.x + 0.95 * X.y, 0.2 * X.x}; }

double interiorForce(const Garment& g, int gauss_extra, CellRule rule = CellRule::full) {
  std::vector<Vec3> x = restPoints(g);
  for (Vec3& y : x) y = strained(y);
  const auto f = forceOn(Shell(g, widestKernels(), gauss_extra, rule), x);
  const NurbsPatch& s = g.patches[0];
  double worst = 0;
  for (int j = 1; j + 1 < s.v.count(); ++j)
    for (int i = 1; i + 1 < s.u.count(); ++i) worst = std::max(worst, norm(f[s.index(i, j)]));
  return worst / largest(f);
}

TEST(ShellPatchTest, PolynomialPatchesPassExactly) {
  for (int p : {1, 2, 3, 4}) {
    const Garment g = garmentOf({flatPatch(knotsAt(p, {0, 0.2, 0.5, 1}), knotsAt(p, {0, 0.45, 1}), 1.2, 0.9, 0.3)}, {},
                                plainFabric(), turnedWeft());
    for (CellRule rule : {CellRule::automatic, CellRule::full, CellRule::assumed})
      EXPECT_LT(interiorForce(g, 0, rule), 1e-10) << "degree " << p;
    const Shell shell(g, widestKernels());
    std::vector<Vec3> x = restPoints(g);
    for (Vec3& y : x) y = strained(y);
    const PrincipalStress first = shell.stressAt(0, {0.1, 0.1}, x);
    for (Vec2 uv : {Vec2{0.3, 0.4}, Vec2{0.5, 0.5}, Vec2{0.93, 0.21}, Vec2{1, 1}}) {
      const PrincipalStress s = shell.stressAt(0, uv, x);
      EXPECT_NEAR(s.principal1_N_per_m, first.principal1_N_per_m, 1e-10 * first.principal1_N_per_m);
      EXPECT_NEAR(s.principal2_N_per_m, first.principal2_N_per_m, 1e-10 * first.principal1_N_per_m);
      EXPECT_NEAR(s.strain1, first.strain1, 1e-12);
    }
  }
}

/// Rational integrands are not polynomials: the error falls geometrically with the order of the Gauss rule.
TEST(ShellPatchTest, RationalPatchesConvergeWithTheGaussOrder) {
  for (int p : {2, 3}) {
    Garment g = garmentOf({flatPatch(knotsAt(p, {0, 0.2, 0.5, 1}), knotsAt(p, {0, 0.45, 1}), 1.2, 0.9, 0.2)}, {},
                          plainFabric(), turnedWeft());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> d(0.8, 1.25);
    for (double& w : g.patches[0].weights) w = d(random);
    std::vector<double> error;
    for (int extra = 0; extra <= 4; ++extra) {
      error.push_back(interiorForce(g, extra));
      RecordProperty("degree_" + std::to_string(p) + "_extra_" + std::to_string(extra), std::to_string(error.back()));
      printf("degree %d, %d more Gauss points: interior force %.2e of the largest\n", p, extra, error.back());
    }
    EXPECT_LT(error[0], 2e-3);
    for (int extra = 1; extra <= 4; ++extra) EXPECT_LT(error[extra], 0.3 * error[extra - 1]);
  }
}

TEST(ShellStress, UniaxialTensionAlongTheWeft) {
  Fabric f = plainFabric();
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1)}, {}, f);
  const double E11 = 0.06, E22 = -f.poisson * E11;  // free contraction along the warp
  const double l1 = std::sqrt(1 + 2 * E11), l2 = std::sqrt(1 + 2 * E22);
  std::vector<Vec3> x = restPoints(g);
  for (Vec3& y : x) y = {0, l1 * y.x, l2 * y.y};
  const PrincipalStress s = Shell(g, widestKernels()).stressAt(0, {0.3, 0.8}, x);
  // Second Piola-Kirchhoff Y_weft E11 h; Cauchy: times l1^2/(l1 l2).
  EXPECT_NEAR(s.principal1_N_per_m, f.young_weft_Pa * E11 * f.thickness_m * l1 / l2, 1e-12);
  EXPECT_NEAR(s.principal2_N_per_m, 0, 1e-12);
  EXPECT_NEAR(s.strain1, E11, 1e-14);
  EXPECT_NEAR(s.strain2, E22, 1e-14);
}

/// A stretch along x of a sheet whose weft lies at 30 degrees: rotated components of eq. 2.13 written out.
TEST(ShellStress, StretchAtThirtyDegreesToTheWeft) {
  const Fabric f = plainFabric();
  const Garment g = garmentOf({flatPatch(uniformKnots(3, 2), uniformKnots(2, 2), 1, 1)}, {}, f, turnedWeft());
  const double l = 1.1, E = 0.5 * (l * l - 1), c = std::cos(kPi / 6), s = std::sin(kPi / 6);
  std::vector<Vec3> x = restPoints(g);
  for (Vec3& y : x) y.x *= l;
  const double nu21 = f.poisson * f.young_warp_Pa / f.young_weft_Pa, k = f.thickness_m / (1 - f.poisson * nu21);
  const double Ea = c * c * E, Eb = s * s * E, Eab = -c * s * E;
  const double na = k * (f.young_weft_Pa * Ea + f.poisson * f.young_warp_Pa * Eb);
  const double nb = k * (f.poisson * f.young_warp_Pa * Ea + f.young_warp_Pa * Eb),
               nab = f.shear_Pa * f.thickness_m * 2 * Eab;
  const double nxx = c * c * na + s * s * nb - 2 * c * s * nab, nyy = s * s * na + c * c * nb + 2 * c * s * nab;
  const double nxy = c * s * (na - nb) + (c * c - s * s) * nab;
  const double sxx = l * nxx, syy = nyy / l, sxy = nxy;
  const double mean = 0.5 * (sxx + syy), radius = std::hypot(0.5 * (sxx - syy), sxy);
  const PrincipalStress stress = Shell(g, widestKernels()).stressAt(0, {0.6, 0.2}, x);
  EXPECT_NEAR(stress.principal1_N_per_m, mean + radius, 1e-12);
  EXPECT_NEAR(stress.principal2_N_per_m, mean - radius, 1e-12);
  // The virtual work of delta x = X e is the first Piola-Kirchhoff resultant of the cuts x = const, times the area 1.
  const auto force = forceOn(Shell(g, widestKernels()), x);
  Vec3 right{};
  for (std::size_t i = 0; i < x.size(); ++i) right += g.patches[0].points[i].x * force[i];
  EXPECT_NEAR(-right.x, l * nxx, 1e-12);
  EXPECT_NEAR(-right.y, nxy, 1e-12);
}

/// A parabola from (1, 0) over (1, 1) to (0, 1): at its end, where the weft is normal to it, kappa = 1/2; at the
/// start too, by symmetry.
TEST(ShellBending, NormIsThereWhereTheWeftIsNormalToTheSheet) {
  NurbsPatch s{uniformKnots(2, 1), uniformKnots(2, 1), {}, std::vector<double>(9, 1)};
  for (double y : {0.0, 0.5, 1.0})
    for (const Vec3& x : {Vec3{1, y, 0}, Vec3{1, y, 1}, Vec3{0, y, 1}}) s.points.push_back(x);
  const Shell shell(garmentOf({s}, {}, plainFabric(Bends::linear), {0, 0, 1}), widestKernels());
  EXPECT_NO_THROW(shell.curvatureAt(0, {1, 0.5}, s.points));  // told beside it, where weft and warp are
  EXPECT_NEAR(shell.bendAt(0, {1, 0.5}, s.points), 0.5, 1e-12);
  EXPECT_NEAR(shell.bendAt(0, {0, 0.5}, s.points), 0.5, 1e-12);
}

/// Small z = (a X^2 + 2 b X Y + c Y^2) / 2 over a unit square has the curvatures a, b, c; at 30 degrees to the grid
/// they turn as a tensor. Energy per area: the law's of the weft and warp curvature, and 1/2 (2 m12 kappa12), m12 =
/// twist * 2 kappa12.
TEST(ShellBending, EnergyOfAConstantCurvature) {
  const double a = 3e-4, b = 2e-4, c = -1e-4, cs = std::cos(kPi / 6), sn = std::sin(kPi / 6);
  for (Bends law : {Bends::linear, Bends::zheng}) {
    Fabric f = plainFabric(law);
    const double k0 = 3e-4, kr = 1.5e-4;
    if (law == Bends::zheng) f.law = ZhengBending{rigidities(f), k0, kr};
    const auto [weft, warp, twist] = rigidities(f);
    const Garment g = garmentOf({flatPatch(uniformKnots(2, 3), uniformKnots(2, 2), 1, 1)}, {}, f, turnedWeft());
    NurbsPatch bent = g.patches[0];  // blossom of the quadratic at the Greville points: exact coefficients
    const auto &u = bent.u, &v = bent.v;
    for (int j = 0; j < v.count(); ++j)
      for (int i = 0; i < u.count(); ++i) {
        Vec3& x = bent.points[bent.index(i, j)];
        x.z = 0.5 * (a * u.knots[i + 1] * u.knots[i + 2] + 2 * b * x.x * x.y + c * v.knots[j + 1] * v.knots[j + 2]);
      }
    const double k11 = cs * cs * a + 2 * cs * sn * b + sn * sn * c, k22 = sn * sn * a - 2 * cs * sn * b + cs * cs * c;
    const double k12 = cs * sn * (c - a) + (cs * cs - sn * sn) * b;
    const Shell shell(g, widestKernels());
    const Vec3 kappa = shell.curvatureAt(0, {0.4, 0.7}, bent.points);
    EXPECT_NEAR(kappa.x, k11, 1e-6 * a);
    EXPECT_NEAR(kappa.y, k22, 1e-6 * a);
    EXPECT_NEAR(kappa.z, k12, 1e-6 * a);
    const double bend = std::sqrt(a * a + 2 * b * b + c * c);  // does not depend on the weft
    EXPECT_NEAR(shell.bendAt(0, {0.4, 0.7}, bent.points), bend, 1e-6 * a);
    const auto density = [&](double k, double B) {
      Answer<double, 1> zheng;
      zhengCurve<with_energy>(B, k0, kr, k, zheng);
      return law == Bends::linear ? 0.5 * B * k * k : zheng.energy;
    };
    const double expected = density(k11, weft) + density(k22, warp) + 2 * twist * k12 * k12;
    double energy;
    forceOn(shell, bent.points, &energy, {false, true, false, false});
    EXPECT_NEAR(energy, expected, 1e-6 * expected);
    if (law == Bends::linear) continue;
    // `steepest`: the linear law of the steepest slope instead.
    forceOn(shell, bent.points, &energy, {false, true, false, true});
    EXPECT_NEAR(energy,
                0.5 * (zhengSteepest(weft, k0, kr) * k11 * k11 + zhengSteepest(warp, k0, kr) * k22 * k22) +
                    2 * twist * k12 * k12,
                1e-6 * energy);
  }
}

TEST(ShellInput, BadGeometryAndFabricAreRefused) {
  const Garment good = garmentOf({curvedPatch(2, 2, false)}, {}, plainFabric(Bends::zheng));
  EXPECT_NO_THROW(Shell(good, widestKernels()));
  const auto refuses = [&](auto&& spoil) {
    Garment g = good;
    spoil(g);
    EXPECT_THROW(Shell(g, widestKernels()), InputError);
  };
  refuses([](Garment& g) { g.weft[0] = {}; });
  refuses([](Garment& g) { g.weft.clear(); });
  refuses([](Garment& g) {
    for (Vec3& x : g.patches[0].points) x.y = 0, x.z = 0;
  });
  refuses([](Garment& g) { g.patches[0].weights[3] = -1; });
  refuses([](Garment& g) { g.patches[0] = curvedPatch(6, 2, false); });
  refuses([](Garment& g) { zheng(g.fabric).kappa_regular_per_m = 0; });
  refuses([](Garment& g) { zheng(g.fabric).kappa_regular_per_m = NAN; });
  refuses([](Garment& g) { zheng(g.fabric).kappa0_per_m = 0.1; });
  refuses([](Garment& g) { g.fabric.poisson = 2; });
  refuses([](Garment& g) { g.fabric.thickness_m = 0; });
}

}  // namespace
}  // namespace gambeson
