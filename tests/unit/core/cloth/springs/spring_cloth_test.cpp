/// Cloth of points and springs: what it amounts to as a sheet, its forces, and what it refuses.

#include "core/cloth/springs/spring_cloth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/material/fabric_law.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric cloth() {
  Fabric f;
  f.thickness_m = 5e-4;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = 2e6;
  f.young_warp_Pa = 3e6;
  f.shear_Pa = 2e5;
  f.poisson = 0.1;
  f.law = LinearBending{{1e-6, 2e-6, 1e-6}};
  return f;
}

Garment sheet(int nu, int nv, double length, double width) {
  Garment g;
  g.patches = {flatPatch(uniformKnots(1, nu), uniformKnots(1, nv), length, width)};
  g.weft = {{1, 0, 0}};
  g.fabric = cloth();
  return g;
}

/// Points moved by f.
std::vector<Vec3> moved(const Cloth& c, const std::function<Vec3(const Vec3&)>& f) {
  std::vector<Vec3> q;
  for (const Vec3& x : c.rest()) q.push_back(f(x));
  return q;
}

double energyOf(const Cloth& c, const std::vector<Vec3>& q, const ForceTerms& terms = {}) {
  std::vector<Vec3> f(q.size());
  ClothWork work;
  double energy = 0;
  c.force(q, f, work, &energy, terms);
  return energy;
}

/// W of a uniform stretch by the displacement gradients G11, G22 and, symmetric, G12, over the area; the mean of both
/// senses.
double density(const Cloth& c, double area, double g11, double g22, double g12) {
  double sum = 0;
  for (const double sense : {-1.0, 1.0})
    sum +=
        0.5 * energyOf(c, moved(c, [&](const Vec3& x) {
                         return Vec3{x.x + sense * (g11 * x.x + g12 * x.y), x.y + sense * (g12 * x.x + g22 * x.y), 0};
                       }));
  return sum / area;
}

/// Bent to a cylinder along x so that structural springs keep their length, cells of width h there.
std::vector<Vec3> bent(const Cloth& c, double h, double curvature) {
  const double angle = 2 * std::asin(0.5 * h * curvature), r = 1 / curvature;
  return moved(c, [&](const Vec3& x) {
    const double a = x.x / h * angle;
    return Vec3{r * std::sin(a), x.y, r * (1 - std::cos(a))};
  });
}

TEST(SpringCloth, SquareCellsHaveTheModuliOfTheirSprings) {
  const int n = 24;
  const double h = 0.01, ks = 7, kd = 3, kf = 0.5, area = n * h * n * h, e = 1e-4;
  const SpringCloth c(sheet(n, n, n * h, n * h), {ks, kd, kf});
  const double A11 = ks + kd + 4 * kf * (n - 1) / n;
  EXPECT_NEAR(2 * density(c, area, e, 0, 0) / (e * e), A11, 1e-6 * A11);
  EXPECT_NEAR(2 * density(c, area, 0, e, 0) / (e * e), A11, 1e-6 * A11);
  EXPECT_NEAR((density(c, area, e, e, 0) - density(c, area, e, -e, 0)) / (2 * e * e), kd, 1e-6 * kd);
  EXPECT_NEAR(2 * density(c, area, 0, 0, e) / (4 * e * e), kd, 1e-6 * kd);
}

TEST(SpringCloth, FlexionGoesWithTheFourthPowerOfCurvature) {
  const double h = 0.01;
  const SpringCloth c(sheet(24, 24, 0.24, 0.24), {7, 3, 0.5});
  const ForceTerms bending{false, true, false};
  const double one = energyOf(c, bent(c, h, 1), bending), two = energyOf(c, bent(c, h, 2), bending),
               four = energyOf(c, bent(c, h, 4), bending);
  EXPECT_GT(one, 0);
  EXPECT_NEAR(std::log2(two / one), 4, 0.02);
  EXPECT_NEAR(std::log2(four / two), 4, 0.02);
}

TEST(SpringCloth, OfAFabricHasItsStiffnessOnCellsOfAnySides) {
  const double a = 0.010, b = 0.012;
  const int nu = 60, nv = 50;
  const SpringCloth c(sheet(nu, nv, nu * a, nv * b));
  const double area = nu * a * nv * b, e = 1e-4;
  const Section s = pointLaw(cloth()).section;
  // Lines of flexion springs are two points short.
  EXPECT_NEAR(2 * density(c, area, e, 0, 0) / (e * e), s.A[0], 2e-3 * s.A[0]);
  EXPECT_NEAR(2 * density(c, area, 0, e, 0) / (e * e), s.A[1], 2e-3 * s.A[1]);
  EXPECT_NEAR(2 * density(c, area, 0, 0, e) / (4 * e * e), s.A[2], 1e-6 * s.A[2]);
  // At a curvature of 1/cm it stores what the fabric does, but for the lines at both ends.
  const double stored = energyOf(c, bent(c, a, 100), {false, true, false});
  EXPECT_NEAR(stored / area, 0.5 * s.D[0] * 100 * 100 * (nu - 1) / nu, 1e-9);
}

void expectGradientAndSlope(const SpringNumbers& numbers) {
  const SpringCloth c(sheet(5, 4, 0.05, 0.044), numbers);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> d(-1e-3, 1e-3);
  const std::vector<Vec3> q = moved(c, [&](const Vec3& x) {
    return x + Vec3{d(random), d(random), 0.01 * std::sin(40 * x.x) + d(random)};
  });
  const int n = c.points();
  std::vector<Vec3> f(q.size()), f0(q.size()), f1(q.size());
  ClothWork work;
  c.force(q, f, work);
  const auto K = c.tangent();
  BlockMatrix k;
  K->assemble(ClothState(q), work, k);
  double largest = 0, force_error = 0, slope_error = 0, largest_slope = 0;
  Vec3 sum{};
  for (int i = 0; i < n; ++i) {
    sum += f[i];
    for (int axis = 0; axis < 3; ++axis) {
      const double step = 1e-6;
      std::vector<Vec3> q0 = q, q1 = q;
      q0[i][axis] -= step, q1[i][axis] += step;
      double e0 = 0, e1 = 0;
      c.force(q0, f0, work, &e0);
      c.force(q1, f1, work, &e1);
      largest = std::max(largest, std::abs(f[i][axis]));
      force_error = std::max(force_error, std::abs(f[i][axis] + (e1 - e0) / (2 * step)));
      for (int j = i; j < n; ++j) {
        const long at = k.find(i, j);
        for (int row = 0; row < 3; ++row) {
          const double slope = -(f1[j][row] - f0[j][row]) / (2 * step);
          const double mine = at < 0 ? 0 : k.values[static_cast<std::size_t>(9 * at + 3 * axis + row)];
          largest_slope = std::max(largest_slope, std::abs(slope));
          slope_error = std::max(slope_error, std::abs(slope - mine));
        }
      }
    }
  }
  EXPECT_LT(force_error, 1e-6 * largest);
  EXPECT_LT(slope_error, 1e-6 * largest_slope);
  EXPECT_LT(norm(sum), 1e-12 * largest);
}

TEST(SpringCloth, ForceIsTheGradientOfTheEnergyAndTheTangentItsSlope) {
  expectGradientAndSlope({});
  expectGradientAndSlope({0, 0, 0, Flexion::buckling});
}

TEST(SpringCloth, TwoPatchesJoinedAreOne) {
  const SpringNumbers numbers{7, 3, 0.5};
  const SpringCloth whole(sheet(12, 6, 0.12, 0.06), numbers);
  Garment two = sheet(5, 6, 0.05, 0.06);
  two.patches.push_back(patchOf(uniformKnots(1, 7), uniformKnots(1, 6), [](double a, double b) {
    return Vec3{0.05 + 0.07 * a, 0.06 * b, 0};
  }));
  two.weft.push_back({1, 0, 0});
  two.seams.push_back({{0, Side::u1, false}, {1, Side::u0, false}, SeamKind::G1});
  const SpringCloth joined(two, numbers);
  const auto shape = [](const Vec3& x) { return Vec3{1.02 * x.x + 0.01 * x.y, 0.99 * x.y, 2 * x.x * x.x - x.y * x.x}; };
  const double e = energyOf(whole, moved(whole, shape));
  EXPECT_GT(e, 0);
  EXPECT_NEAR(energyOf(joined, moved(joined, shape)), e, 1e-12 * e);
}

/// Across a free seam (C0) nothing bends; one with a spring of its own bends as the cloth beside it.
TEST(SpringCloth, FoldsFreelyAtAFreeSeam) {
  Garment two = sheet(4, 3, 0.04, 0.03);
  two.patches.push_back(patchOf(uniformKnots(1, 4), uniformKnots(1, 3), [](double a, double b) {
    return Vec3{0.04 + 0.04 * a, 0.03 * b, 0};
  }));
  two.weft.push_back({1, 0, 0});
  const auto folded = [&](const Seam& seam) {
    two.seams = {seam};
    const SpringCloth c(two, {7, 3, 0.5});
    return energyOf(c, moved(c, [](const Vec3& x) { return x.x <= 0.04 ? x : Vec3{0.04, x.y, x.x - 0.04}; }));
  };
  const PatchEdge a{0, Side::u1, false}, b{1, Side::u0, false};
  EXPECT_NEAR(folded({a, b, SeamKind::C0}), 0, 1e-18);
  // Three cells' width of springs from 2 cells to sqrt(2) of them.
  const double shorter = 0.01 * (2 - std::sqrt(2.0)), expected = 3 * 0.5 * 0.5 * shorter * shorter;
  EXPECT_NEAR(folded({a, b, SeamKind::C0, 0.01}), expected, 1e-12 * expected);
  EXPECT_NEAR(folded({a, b, SeamKind::G1}), expected, 1e-12 * expected);
}

/// A narrow patch on a part of a wide one's edge (Seam::first_cell) is as if the wide one went on there.
TEST(SpringCloth, BendsOverASeamOnAPart) {
  Garment g = sheet(4, 6, 0.04, 0.06);
  g.patches.push_back(patchOf(uniformKnots(1, 4), uniformKnots(1, 2), [](double a, double b) {
    return Vec3{0.04 + 0.04 * a, 0.03 + 0.02 * b, 0};
  }));
  g.weft.push_back({1, 0, 0});
  g.seams.push_back({{1, Side::u0, false}, {0, Side::u1, false}, SeamKind::C0, 0.01, 3});
  const SpringCloth c(g, {7, 3, 0.5});
  const double e = energyOf(c, moved(c, [](const Vec3& x) { return x.x <= 0.04 ? x : Vec3{0.04, x.y, x.x - 0.04}; }));
  const double shorter = 0.01 * (2 - std::sqrt(2.0)), expected = 2 * 0.5 * 0.5 * shorter * shorter;
  EXPECT_NEAR(e, expected, 1e-12 * expected);
}

/// Strips that buckle store B/2 kappa^2 of a cylinder, but for the half line at both ends, and pull nothing.
TEST(SpringCloth, StripsStoreWhatTheRigiditySays) {
  const int n = 24;
  const double h = 0.01, kappa = 8;
  // Stiff enough at the start for that to store next to nothing.
  const SpringCloth c(sheet(n, n, n * h, n * h), {1000, 0, 1e5, Flexion::buckling, 3e-6});
  const double area = n * h * n * h, e = energyOf(c, bent(c, h, kappa), {false, true, false}) / area;
  EXPECT_NEAR(e, 0.5 * 3e-6 * kappa * kappa * (n - 1) / n, 3e-3 * e);  // chords, and the start of the strips
  const std::vector<Vec3> stretched = moved(c, [](const Vec3& x) { return 1.05 * x; });
  EXPECT_EQ(energyOf(c, stretched, {false, true, false}), 0);
  const PointState s = c.stateAt(ClothState(bent(c, h, kappa)), 0, {0.45, 0.45});
  EXPECT_NEAR(s.m.x, 3e-6 * kappa, 1e-3 * 3e-6 * kappa);
  EXPECT_NEAR(s.m.y, 0, 1e-12);
  // From a fabric the springs along a line have all of its stiffness.
  const SpringCloth whole(sheet(60, 50, 0.6, 0.6), {0, 0, 0, Flexion::buckling});
  const Section section = pointLaw(cloth()).section;
  const auto stretch = moved(whole, [](const Vec3& x) { return Vec3{1.0001 * x.x, x.y, 0}; });
  EXPECT_NEAR(2 * energyOf(whole, stretch) / (0.36 * 1e-8), section.A[0], 1e-3 * section.A[0]);
}

TEST(SpringCloth, ResultantsAreWhatTheEnergySays) {
  const double h = 0.01;
  const SpringCloth c(sheet(10, 10, 0.1, 0.1), {7, 3, 0.5});
  // A whole line of springs on each side: the middle cell.
  const Vec3 strain{0.04, -0.02, 0.03};
  const SpringCell& cell = c.springs().cells[44];
  const auto stored = [&](const Vec3& e) {
    double w = 0;
    for (const SpringCell::Line& l : cell.lines) {
      const double l0 = std::hypot(l.way.x, l.way.y);
      const double now =
          std::sqrt(l0 * l0 + 2 * (e.x * l.way.x * l.way.x + e.y * l.way.y * l.way.y + e.z * l.way.x * l.way.y));
      w += 0.5 * l.stiffness_N_per_m * (now - l0) * (now - l0);
    }
    return w / (h * h);
  };
  const Vec3 n = resultantsOf(cell, strain);
  for (int k = 0; k < 3; ++k) {
    Vec3 a = strain, b = strain;
    a[k] -= 1e-6, b[k] += 1e-6;
    EXPECT_NEAR(n[k], (stored(b) - stored(a)) / 2e-6, 1e-7) << k;
  }
  // As the cloth itself has them at a place.
  const std::vector<Vec3> q = moved(c, [](const Vec3& x) { return Vec3{1.1 * x.x, x.y, 0}; });
  const PointState s = c.stateAt(ClothState(q), 0, {0.45, 0.45});
  EXPECT_NEAR(s.strain.x, 0.5 * (1.1 * 1.1 - 1), 1e-12);
  EXPECT_NEAR(s.n.x, resultantsOf(cell, s.strain).x, 1e-12);
  const PointState b = c.stateAt(ClothState(bent(c, h, 4)), 0, {0.45, 0.45});
  EXPECT_NEAR(b.curvature_change.x, 4, 0.01);
  EXPECT_NEAR(b.curvature_change.y, 0, 1e-9);
}

TEST(SpringCloth, SaysWhatItCannotBe) {
  const auto says = [](const Garment& g, const SpringNumbers& n = {}) -> std::string {
    try {
      SpringCloth c(g, n);
    } catch (const InputError& e) {
      return e.what();
    }
    return "nothing";
  };
  Garment trimmed = sheet(4, 4, 0.04, 0.04);
  trimmed.trims = {{{{circle({0.5, 0.5}, 0.2, 0.2, true)}}}};
  EXPECT_NE(says(trimmed).find("cannot be trimmed"), std::string::npos);
  Garment weak = sheet(4, 4, 0.04, 0.04);
  weak.weak_seams.push_back({{0, Side::u0}, {0, Side::u1}});
  EXPECT_NE(says(weak).find("weak seams"), std::string::npos);
  Garment remembers = sheet(4, 4, 0.04, 0.04);
  remembers.fabric.law = StopBending{};
  EXPECT_NE(says(remembers), "nothing");
  Garment stiff = sheet(4, 16, 0.16, 0.04);  // cells of 40 x 2.5 mm
  stiff.fabric.shear_Pa = 1e6;
  EXPECT_NE(says(stiff).find("too long"), std::string::npos);
  EXPECT_EQ(says(stiff, {7, 3, 0.5}), "nothing");
}

}  // namespace
}  // namespace gambeson
