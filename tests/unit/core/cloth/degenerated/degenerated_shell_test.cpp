/// The degenerated shell: forces and tangents against differences, rigid motions, patch tests, seams, refusals.

#include "core/cloth/degenerated/degenerated_shell.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/joined_cloth.hpp"
#include "core/cloth/springs/spring_cloth.hpp"
#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "unit/core/cloth/degenerated/degenerated_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::vector<double> unit(std::size_t n, std::size_t k, double step) {
  std::vector<double> by(n, 0.0);
  by[k] = step;
  return by;
}

Vec3 directorOf(const ShellPlace& s, std::size_t d) { return {s.inner[3 * d], s.inner[3 * d + 1], s.inner[3 * d + 2]}; }

/// v without what is along the directors.
void project(const ShellPlace& s, std::size_t points, std::vector<double>& v) {
  for (std::size_t d = 0; d < s.inner.size() / 3; ++d) {
    const std::size_t at = 3 * points + 3 * d;
    const Vec3 n = directorOf(s, d), own{v[at], v[at + 1], v[at + 2]}, in = own - dot(own, n) * n;
    v[at] = in.x, v[at + 1] = in.y, v[at + 2] = in.z;
  }
}

std::vector<double> times(const BlockMatrix& K, const std::vector<double>& x) {
  std::vector<double> y(x.size(), 0.0);
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r) + 1]; ++k) {
      const int c = K.columns[static_cast<std::size_t>(k)];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const double v = K.values[static_cast<std::size_t>(9 * k + 3 * i + j)];
          y[static_cast<std::size_t>(3 * r + i)] += v * x[static_cast<std::size_t>(3 * c + j)];
          if (r != c) y[static_cast<std::size_t>(3 * c + j)] += v * x[static_cast<std::size_t>(3 * r + i)];
        }
    }
  return y;
}

class EachRule : public testing::TestWithParam<ShellRule> {
 protected:
  DegeneratedOptions options() const { return {GetParam(), 5.0 / 6, RotaryInertia::exact}; }
};

TEST_P(EachRule, ForceIsTheGradientOfTheEnergy) {
  for (const bool given : {false, true}) {
    const DegeneratedShell c(curvedSheet(3, 2, given ? orthotropicCloth() : isotropicSolid(1e6, 0.3, 0.1)), options());
    const ShellPlace s = disturbed(c, 0.03, 0.3);
    const std::vector<double> f = forcesIn(c, s);
    const double step = 1e-6;
    double largest = 0, error = 0;
    for (std::size_t k = 0; k < f.size(); ++k) {
      const double slope =
          (energyIn(c, changed(c, s, unit(f.size(), k, step))) - energyIn(c, changed(c, s, unit(f.size(), k, -step)))) /
          (2 * step);
      largest = std::max(largest, std::abs(f[k]));
      error = std::max(error, std::abs(f[k] + slope));
    }
    EXPECT_LT(error, 1e-7 * largest);
  }
}

TEST_P(EachRule, TangentIsTheSlopeOfTheForceOnTheManifold) {
  for (const bool given : {false, true}) {
    const DegeneratedShell c(curvedSheet(3, 2, given ? orthotropicCloth() : isotropicSolid(1e6, 0.3, 0.1)), options());
    const ShellPlace s = disturbed(c, 0.03, 0.3);
    const std::size_t points = c.map().home.size(), n = 3 * points + c.innerRates();
    ClothWork work;
    BlockMatrix K;
    c.tangent()->assemble(s, work, K);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> d(-1, 1);
    for (int sample = 0; sample < 5; ++sample) {
      // Second derivative of the energy along a geodesic, as the slope of the force on the way.
      std::vector<double> way(n), there(n);
      for (double& v : way) v = d(random);
      project(s, points, way);
      const double step = 1e-5;
      for (std::size_t k = 0; k < n; ++k) there[k] = step * way[k];
      const ShellPlace ahead = changed(c, s, there);
      for (double& v : there) v = -v;
      const ShellPlace behind = changed(c, s, there);
      const std::vector<double> f1 = forcesIn(c, ahead), f0 = forcesIn(c, behind), Kw = times(K, way);
      // Along the way itself a spin is the same vector all along, so that forces are compared there.
      double slope = 0, mine = 0;
      for (std::size_t k = 0; k < n; ++k) slope += way[k] * (f0[k] - f1[k]) / (2 * step), mine += way[k] * Kw[k];
      EXPECT_NEAR(mine, slope, 1e-7 * std::abs(slope));
    }
    // Drilling meets nothing, and where it is held its own stiffness alone.
    std::vector<double> drill(n, 0.0);
    const Vec3 axis = directorOf(s, 4);
    for (int i = 0; i < 3; ++i) drill[3 * points + 12 + static_cast<std::size_t>(i)] = axis[i];
    double largest = 0;
    for (const double v : K.values) largest = std::max(largest, std::abs(v));
    for (const double v : times(K, drill)) EXPECT_LT(std::abs(v), 1e-13 * largest);
    c.tangent()->holdIdle(s, K);
    const std::vector<double> Kd = times(K, drill);
    double along = 0, elsewhere = 0;
    for (std::size_t k = 0; k < n; ++k) along += drill[k] * Kd[k];
    for (std::size_t k = 0; k < n; ++k) elsewhere = std::max(elsewhere, std::abs(Kd[k] - along * drill[k]));
    EXPECT_GT(along, 0);
    EXPECT_LT(elsewhere, 1e-12 * largest);
  }
}

TEST_P(EachRule, TheDefiniteTangentIsDefinite) {
  const DegeneratedShell c(curvedSheet(3, 2, isotropicSolid(1e6, 0.3, 0.1)), options());
  const ShellPlace s = disturbed(c, 0.03, 0.5);
  ClothWork work;
  BlockMatrix K;
  ForceTerms terms;
  terms.definite = true;
  c.tangent()->assemble(s, work, K, terms);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-1, 1);
  for (int sample = 0; sample < 50; ++sample) {
    std::vector<double> x(static_cast<std::size_t>(3 * K.rows()));
    for (double& v : x) v = d(random);
    const std::vector<double> y = times(K, x);
    double work_J = 0;
    for (std::size_t k = 0; k < x.size(); ++k) work_J += x[k] * y[k];
    EXPECT_GE(work_J, 0);
  }
}

TEST_P(EachRule, RigidMotionCostsNothing) {
  const DegeneratedShell c(curvedSheet(4, 3, isotropicSolid(1e6, 0.3, 0.1)), options());
  const double scale = energyIn(c, disturbed(c, 0.03, 0.3));
  for (const double angle : {1.0, kPi, 2.5 * kPi, 10 * kPi + 0.3}) {
    const Vec3 axis = normalized(Vec3{0.3, -0.7, 0.5});
    const Mat3 R = rotationAbout(axis, angle);
    ShellPlace s = atRest(c);
    for (Vec3& x : s.q) x = R * x + Vec3{0.4, -2, 3};
    std::vector<double> spin, from = s.inner;
    for (std::size_t k = 0; k < c.innerRates(); ++k) spin.push_back(angle * axis[static_cast<int>(k % 3)]);
    c.advance(from, spin, 1, s.inner);
    EXPECT_LT(energyIn(c, s), 1e-24 * scale);
    for (const double f : forcesIn(c, s)) EXPECT_LT(std::abs(f), 1e-9);
  }
}

TEST_P(EachRule, PassesThePatchTests) {
  const double E = 1e6, nu = 0.3, t = 0.05;
  const DegeneratedShell c(flatSheet(4, 4, 1, 1, isotropicSolid(E, nu, t), 0.2), options());
  const auto largestInside = [&](const ShellPlace& s, const char* what) {
    const std::vector<double> f = forcesIn(c, s);
    double inside = 0, most = 0;
    for (int j = 0; j <= 4; ++j)
      for (int i = 0; i <= 4; ++i)
        for (int k = 0; k < 6; ++k) {
          const auto node = static_cast<std::size_t>(i + 5 * j);
          const double own = std::abs(k < 3 ? f[3 * node + static_cast<std::size_t>(k)]
                                            : f[75 + 3 * node + static_cast<std::size_t>(k - 3)]);
          most = std::max(most, own);
          if (i % 4 != 0 && j % 4 != 0) inside = std::max(inside, own);
        }
    EXPECT_GT(most, 0) << what;
    return inside / most;
  };
  // Finite homogeneous stretch and shear in the plane: no force inside.
  ShellPlace stretched = atRest(c);
  for (Vec3& x : stretched.q) x = {1.2 * x.x + 0.1 * x.y, 0.05 * x.x + 0.9 * x.y, 0};
  EXPECT_LT(largestInside(stretched, "membrane"), 1e-10);
  const PointState flat = c.stateAt(stretched, 0, {0.3, 0.6});
  EXPECT_NEAR(flat.strain.x, 0.5 * (1.2 * 1.2 + 0.05 * 0.05 - 1), 1e-12);
  EXPECT_NEAR(flat.strain.z, 1.2 * 0.1 + 0.05 * 0.9, 1e-12);
  EXPECT_NEAR(flat.n.x, E * t / (1 - nu * nu) * (flat.strain.x + nu * flat.strain.y), 1e-9 * E * t);
  // Directors all tilted: constant shear, G k t gamma²/2, with no forces inside but the couples that shear asks for.
  ShellPlace sheared = atRest(c);
  const double gamma = 1e-4;
  for (Vec3& x : sheared.q) x.z = gamma * x.x;
  EXPECT_NEAR(energyIn(c, sheared), 0.5 * 5.0 / 6 * E / (2 * (1 + nu)) * t * gamma * gamma,
              1e-6 * 0.5 * E / (2 * (1 + nu)) * t * gamma * gamma);
}

TEST_P(EachRule, BendsAsItsRigiditySays) {
  // Constant curvature k11 of a flat rectangular mesh, positions on the parabola, directors along: D11 k² / 2.
  for (const bool given : {false, true}) {
    const Fabric fabric = given ? orthotropicCloth() : isotropicSolid(1e6, 0.3, 0.05);
    const DegeneratedShell c(flatSheet(8, 2, 1, 0.5, fabric), options());
    const Section section = pointLaw(fabric).section;
    const double k = 1e-4;
    ShellPlace s = atRest(c);
    std::vector<double> spin(c.innerRates()), from = s.inner;
    for (std::size_t p = 0; p < s.q.size(); ++p) {
      const double x = s.q[p].x;
      s.q[p].z = 0.5 * k * x * x;
      spin[3 * p + 1] = -k * x;  // normal (-k x, 0, 1)
    }
    c.advance(from, spin, 1, s.inner);
    const double exact = 0.5 * section.D[0] * k * k * 0.5, energy = energyIn(c, s, {false, true, true});
    if (GetParam() == ShellRule::full) {
      EXPECT_GT(energy, 1.02 * exact);  // shear that should not be
    } else {
      EXPECT_NEAR(energy, exact, 1e-6 * exact);
    }
    const PointState at = c.stateAt(s, 0, {0.4, 0.3});
    EXPECT_NEAR(at.curvature_change.x, k, 1e-6 * k);
    EXPECT_NEAR(at.m.x, section.D[0] * k, 1e-6 * section.D[0] * k);
    EXPECT_NEAR(c.bendAt(s, 0, {0.4, 0.3}), k, 1e-6 * k);
  }
}

std::string nameOf(const testing::TestParamInfo<ShellRule>& rule) {
  const std::array<const char*, 4> names{"mitc4", "one_point", "selective", "full"};
  return names[static_cast<std::size_t>(rule.param)];
}
INSTANTIATE_TEST_SUITE_P(DegeneratedShell, EachRule, testing::ValuesIn(kShellRules), nameOf);

TEST(DegeneratedShell, AssumedShearBendsWithoutShearInMovedMeshesToo) {
  // Bending patch test of MITC4: linear directors and quadratic deflections at the points of a distorted mesh.
  const double E = 1e6, nu = 0.3, t = 0.01, k = 1e-4;
  const DegeneratedShell c(flatSheet(6, 6, 1, 1, isotropicSolid(E, nu, t), 0.2));
  ShellPlace s = atRest(c);
  std::vector<double> spin(c.innerRates()), from = s.inner;
  for (std::size_t p = 0; p < s.q.size(); ++p) {
    const Vec3 x = s.q[p];
    s.q[p].z = 0.5 * k * (x.x * x.x + 0.5 * x.y * x.y + x.x * x.y);
    const Vec3 normal{-k * (x.x + 0.5 * x.y), -k * (0.5 * x.y + 0.5 * x.x), 0};
    spin[3 * p] = -normal.y, spin[3 * p + 1] = normal.x;
  }
  c.advance(from, spin, 1, s.inner);
  const Section section = pointLaw(c.garment().fabric).section;
  const Vec3 kappa{k, 0.5 * k, k};
  const double exact = 0.5 * (section.D[0] * (kappa.x * kappa.x + kappa.y * kappa.y) +
                              2 * section.D[3] * kappa.x * kappa.y + section.D[2] * kappa.z * kappa.z);
  EXPECT_NEAR(energyIn(c, s, {false, true, true}), exact, 1e-5 * exact);
}

TEST(DegeneratedShell, StretchAndBendingAddUp) {
  const DegeneratedShell c(curvedSheet(3, 2, orthotropicCloth()));
  const ShellPlace s = disturbed(c, 0.03, 0.3);
  const double both = energyIn(c, s), membrane = energyIn(c, s, {true, false, false}),
               bending = energyIn(c, s, {false, true, false});
  EXPECT_GT(membrane, 0);
  EXPECT_GT(bending, 0);
  EXPECT_NEAR(membrane + bending, both, 1e-12 * both);
}

TEST(DegeneratedShell, SmoothSeamsShareDirectorsAndCreasesAreHinges) {
  const Fabric fabric = isotropicSolid(1e6, 0.3, 0.05);
  const auto arc = [](double from, double to) {
    return [=](double a, double b) {
      const double angle = from + (to - from) * a;
      return Vec3{std::sin(angle), b, 1 - std::cos(angle)};
    };
  };
  const DegeneratedShell whole(sheetOf(8, 2, fabric, arc(0, 1)));
  Garment two = sheetOf(4, 2, fabric, arc(0, 0.5));
  two.patches.push_back(patchOf(uniformKnots(1, 4), uniformKnots(1, 2), arc(0.5, 1)));
  two.weft.push_back({1, 0, 0});
  two.seams.push_back({{0, Side::u1, false}, {1, Side::u0, false}, SeamKind::C0});
  const DegeneratedShell joined(two);
  EXPECT_EQ(joined.innerValues(), whole.innerValues());
  // The same shape and spins on both: the same energy, but that normals at the seam's ends are one-sided parabolas'.
  const auto bent = [](const Cloth& c) {
    ShellPlace s = atRest(c);
    for (Vec3& x : s.q) x = {1.05 * x.x, x.y + 0.1 * x.x, x.z + 0.3 * x.x * x.x};
    return energyIn(c, s);
  };
  const double e = bent(whole);
  EXPECT_NEAR(bent(joined), e, 2e-3 * e);

  Garment roof = flatSheet(3, 2, 1, 1, fabric);
  roof.patches.push_back(patchOf(uniformKnots(1, 3), uniformKnots(1, 2), [](double a, double b) {
    return Vec3{1 + 0.8 * a, b, 0.6 * a};
  }));
  roof.weft.push_back({1, 0, 0});
  roof.seams.push_back({{0, Side::u1, false}, {1, Side::u0, false}, SeamKind::C0});
  const DegeneratedShell hinge(roof);
  EXPECT_EQ(hinge.innerValues(), 3 * hinge.rest().size());
  // Folding it about the seam costs nothing.
  const Mat3 R = rotationAbout({0, 1, 0}, 0.7);
  ShellPlace s = atRest(hinge);
  std::vector<double> spin(hinge.innerRates(), 0.0), from = s.inner;
  for (std::size_t p = 12; p < 24; ++p) {
    s.q[p] = R * (s.q[p] - Vec3{1, 0, 0}) + Vec3{1, 0, 0};
    spin[3 * p + 1] = 0.7;
  }
  hinge.advance(from, spin, 1, s.inner);
  EXPECT_LT(energyIn(hinge, s), 1e-18);
}

TEST(DegeneratedShell, MassesAreThoseOfTheCellsAndTheirSquares) {
  const double t = 0.05, density = 800;
  const DegeneratedShell c(flatSheet(4, 3, 1, 0.6, isotropicSolid(1e6, 0.3, t, density), 0.2));
  double sum = 0, inertia = 0;
  for (const double m : c.masses()) sum += m;
  std::vector<double> inner(c.innerRates());
  c.innerMasses(inner);
  for (std::size_t k = 0; k < inner.size(); k += 3) {
    inertia += inner[k];
    EXPECT_NEAR(inner[k], c.masses()[k / 3] * t * t / 12, 1e-15);
  }
  EXPECT_NEAR(sum, density * t * 0.6, 1e-12);
  EXPECT_NEAR(inertia, density * t * 0.6 * t * t / 12, 1e-15);
  // In a single cell of a trapezoid, ∫ N² by hand (Gauss's rule of 2 x 2 is exact: N² J is of degree 3).
  Garment trapezoid = sheetOf(1, 1, isotropicSolid(1e6, 0.3, t, density), [](double a, double b) {
    return Vec3{a * (1 + b), b, 0};
  });
  const DegeneratedShell one(trapezoid);
  // J = (1 + v): ∫ (1-u)² (1-v)² (1+v) = 1/3 * 5/12, and of v² 1/3 * 7/12.
  const double mass = density * t * 1.5;
  EXPECT_NEAR(one.masses()[0], mass * 0.5 * 5 / 12, 1e-12);
  EXPECT_NEAR(one.masses()[2], mass * 0.5 * 7 / 12, 1e-12);
  const DegeneratedShell wide(flatSheet(2, 2, 1, 1, isotropicSolid(1e6, 0.3, t, density)),
                              {ShellRule::mitc4, 5.0 / 6, RotaryInertia::cell});
  inner.resize(wide.innerRates());
  wide.innerMasses(inner);
  EXPECT_NEAR(inner[0], density * t * 0.25 * 0.25 * 0.25 / 12, 1e-12);
}

TEST(DegeneratedShell, SameBitsForAnyNumberOfThreads) {
  const DegeneratedShell c(curvedSheet(12, 10, isotropicSolid(1e6, 0.3, 0.1)));
  const ShellPlace s = disturbed(c, 0.01, 0.2);
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<double> one = forcesIn(c, s);
  omp_set_num_threads(3);
  const std::vector<double> three = forcesIn(c, s);
  omp_set_num_threads(threads);
  EXPECT_EQ(one, three);
}

TEST(DegeneratedShell, StateInnerIsAsItStartsWhereNoneIsGiven) {
  const DegeneratedShell c(curvedSheet(3, 3, isotropicSolid(1e6, 0.3, 0.1)));
  std::vector<Vec3> q = c.rest();
  EXPECT_EQ(energyIn(c, ClothState(q)), energyIn(c, atRest(c)));
}

TEST(DegeneratedShell, JoinsOtherCloth) {
  const Fabric fabric = isotropicSolid(1e6, 0.3, 0.1);
  std::vector<std::unique_ptr<const Cloth>> parts;
  parts.push_back(std::make_unique<SpringCloth>(flatSheet(2, 2, 1, 1, fabric), SpringNumbers{7, 3, 0.5}));
  parts.push_back(std::make_unique<DegeneratedShell>(curvedSheet(3, 2, fabric)));
  const JoinedCloth both(std::move(parts));
  EXPECT_TRUE(both.turnsInner());
  const ShellPlace s = disturbed(both, 0.03, 0.3);
  const std::vector<double> f = forcesIn(both, s);
  const Cloth& shell = *both.parts()[1];
  const ShellPlace own{{s.q.begin() + 9, s.q.end()}, s.inner};
  const std::vector<double> of_shell = forcesIn(shell, own);
  for (std::size_t k = 0; k < of_shell.size(); ++k) EXPECT_EQ(f[27 + k], of_shell[k]);
  const std::vector<LinearConstraint> turn = both.mounting().turnEdge({1, Side::u0, false}, {0, 1, 0}, 0);
  EXPECT_EQ(turn.size(), 9u);
  EXPECT_THROW(both.mounting().turnEdge({0, Side::u0, false}, {0, 1, 0}, 0), InputError);
}

TEST(DegeneratedShell, SaysWhatItCannotBe) {
  const auto says = [](const Garment& g, const DegeneratedOptions& o = {}) -> std::string {
    try {
      DegeneratedShell c(g, o);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  };
  const Fabric solid = isotropicSolid(1e6, 0.3, 0.05);
  EXPECT_EQ(says(flatSheet(2, 2, 1, 1, solid)), "nothing");
  Garment smooth = flatSheet(2, 2, 1, 1, solid);
  smooth.patches[0] = flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1);
  EXPECT_EQ(says(smooth), "nothing");  // its nodes are what counts
  smooth.trims = {{{{circle({0.5, 0.5}, 0.2, 0.2, true)}}}};
  EXPECT_NE(says(smooth).find("cannot be trimmed"), std::string::npos);
  Fabric other = solid;
  other.law = StopBending{{1, 1, 1}, 0.1};
  EXPECT_EQ(says(flatSheet(2, 2, 1, 1, other)), "nothing");
  other = solid;
  other.tension_field = true;
  EXPECT_NE(says(flatSheet(2, 2, 1, 1, other)).find("tension field"), std::string::npos);
  other = solid;
  other.jam_area = 0.5;
  EXPECT_EQ(says(flatSheet(2, 2, 1, 1, other)), "nothing");  // and it does not jam
  other = orthotropicCloth();
  other.rest_curvature_of_shape = false;
  EXPECT_EQ(says(flatSheet(2, 2, 1, 1, other)), "nothing");
  EXPECT_EQ(says(curvedSheet(2, 2, other)), "nothing");
  EXPECT_NE(says(flatSheet(2, 2, 1, 1, solid), {ShellRule::mitc4, 0.0, RotaryInertia::exact}).find("shear_factor"),
            std::string::npos);
  Garment pole = sheetOf(2, 2, solid, [](double a, double b) { return Vec3{a * b, b, 0}; });
  EXPECT_NE(says(pole).find("normal"), std::string::npos);
  Garment turnedOver = flatSheet(2, 2, 1, 1, solid);
  turnedOver.patches.push_back(patchOf(uniformKnots(1, 2), uniformKnots(1, 2), [](double a, double b) {
    return Vec3{1 + b, a, 0};
  }));
  turnedOver.weft.push_back({1, 0, 0});
  turnedOver.seams.push_back({{0, Side::u1, false}, {1, Side::v0, false}, SeamKind::C0});
  EXPECT_NE(says(turnedOver).find("opposite"), std::string::npos);
  Garment roof = flatSheet(2, 2, 1, 1, solid);
  roof.patches.push_back(patchOf(uniformKnots(1, 2), uniformKnots(1, 2), [](double a, double b) {
    return Vec3{1 + a, b, a};
  }));
  roof.weft.push_back({1, 0, 0});
  roof.seams.push_back({{0, Side::u1, false}, {1, Side::u0, false}, SeamKind::C0, 0.01});
  EXPECT_NE(says(roof).find("seams[0].stiffness"), std::string::npos);
  roof.seams[0].stiffness_N = 0;
  EXPECT_EQ(says(roof), "nothing");
}

}  // namespace
}  // namespace gambeson
