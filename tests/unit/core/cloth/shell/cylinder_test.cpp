// A flat sheet bent into a circular cylinder, cut lengthwise into 1 to 4 patches. Closed forms of the linear law:
// energy 1/2 B kappa^2 A, end moment B kappa w; a seam with a spring of stiffness k adds the compliance 1/(k w).
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr int kCells = 24;
constexpr double kLength = 1, kWidth = 0.2, kAngle = 2, kThickness = 0.01;

/// B = E h^3 / 12, isotropic with nu = 0.
Fabric sheetFabric() {
  Fabric f = plainFabric();
  f.thickness_m = kThickness;
  f.young_weft_Pa = f.young_warp_Pa = 1e6;
  f.shear_Pa = 0.5e6;
  f.poisson = 0;
  const double B = 1e6 * std::pow(kThickness, 3) / 12;
  f.law = LinearBending{{B, B, 0.5 * B}};
  return f;
}

/// Cuts a patch over [0, 1] into n of equal length.
std::vector<NurbsPatch> cutInto(NurbsPatch rest, int n) {
  std::vector<NurbsPatch> parts;
  for (int k = 1; k < n; ++k) {
    const double at =
        rest.u.knots[std::lower_bound(rest.u.knots.begin(), rest.u.knots.end(), static_cast<double>(k) / n - 1e-9) -
                     rest.u.knots.begin()];
    const auto [left, right] = cutU(rest, at);
    parts.push_back(left);
    rest = right;
  }
  parts.push_back(rest);
  return parts;
}

Garment strip(const NurbsPatch& whole, int n, SeamKind kind, double stiffness) {
  std::vector<Seam> seams;
  for (int k = 0; k + 1 < n; ++k) seams.push_back({{k, Side::u1}, {k + 1, Side::u0}, kind, stiffness});
  return garmentOf(cutInto(whole, n), seams, sheetFabric());
}

/// Control points that interpolate the arc at the Greville points.
NurbsPatch arcOf(const NurbsPatch& flat) {
  const KnotVector& k = flat.u;
  const std::vector<double> at = grevillePoints(k);
  const int n = k.count();
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(n, n), X(n, 2);
  const double R = kLength / kAngle;
  for (int r = 0; r < n; ++r) {
    const int span = findSpan(k, at[r]);
    std::vector<double> b(k.degree + 1);
    basisDerivatives(k, span, at[r], 0, b);
    for (int i = 0; i <= k.degree; ++i) N(r, span - k.degree + i) = b[i];
    X.row(r) << R * std::sin(kAngle * at[r]), R * (1 - std::cos(kAngle * at[r]));
  }
  const Eigen::MatrixXd P = N.colPivHouseholderQr().solve(X);
  NurbsPatch arc = flat;
  for (int j = 0; j < flat.v.count(); ++j)
    for (int i = 0; i < n; ++i) arc.points[arc.index(i, j)] = {P(i, 0), flat.points[flat.index(i, j)].y, P(i, 1)};
  return arc;
}

struct Bent {
  double energy, moment, lowest_curvature, highest_curvature;
};

/// Equilibrium between ends that are clamped as in the arc, by Newton's method with a Hessian by central differences.
Bent bend(int degree, int n, SeamKind kind, double stiffness) {
  const NurbsPatch flat = patchOf(uniformKnots(degree, kCells), uniformKnots(2, 1), [](double a, double b) {
    return Vec3{kLength * a, kWidth * b, 0};
  });
  const Garment g = strip(flat, n, kind, stiffness);
  const std::vector<Vec3> q0 = restPoints(garmentOf(cutInto(arcOf(flat), n), {}, sheetFabric()));
  const FreeMap map = buildFreeMap(g);
  const Shell shell(g, widestKernels(), 0, CellRule::full);  // the seams are tested here, not the rule
  std::vector<Vec3> p;
  for (int i : map.home) p.push_back(q0[i]);
  // The two columns at each end are held.
  std::vector<int> start, end, moving;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const int offset = controlOffsets(g)[n - 1], first = g.patches[0].u.count(), last = g.patches[n - 1].u.count();
    const bool at_start = map.home[i] < g.patches[0].size() && map.home[i] % first < 2;
    const bool at_end = map.home[i] >= offset && (map.home[i] - offset) % last >= last - 2;
    (at_start ? start : at_end ? end : moving).push_back(static_cast<int>(i));
  }
  const auto forces = [&](const std::vector<Vec3>& x) { return onFree(map, forceOn(shell, controlsOf(map, x))); };
  const int m = 3 * static_cast<int>(moving.size());
  double residual = 1;
  for (int round = 0; round < 30 && residual > 1e-12; ++round) {
    const auto f = forces(p);
    Eigen::VectorXd r(m);
    Eigen::MatrixXd K(m, m);
    for (int c = 0; c < m; ++c) {
      r(c) = f[moving[c / 3]][c % 3];
      const double h = 1e-6, old = p[moving[c / 3]][c % 3];
      p[moving[c / 3]][c % 3] = old + h;
      const auto more = forces(p);
      p[moving[c / 3]][c % 3] = old - h;
      const auto less = forces(p);
      p[moving[c / 3]][c % 3] = old;
      for (int k = 0; k < m; ++k) K(k, c) = (less[moving[k / 3]][k % 3] - more[moving[k / 3]][k % 3]) / (2 * h);
    }
    const Eigen::VectorXd d = K.ldlt().solve(r);
    const double limit = std::min(1.0, 0.02 / d.cwiseAbs().maxCoeff());
    for (int c = 0; c < m; ++c) p[moving[c / 3]][c % 3] += limit * d(c);
    residual = d.cwiseAbs().maxCoeff();
  }
  EXPECT_LT(residual, 1e-9) << "no equilibrium found";
  Bent b{0, 0, 1e9, -1e9};
  const std::vector<Vec3> q = controlsOf(map, p);
  const auto f = onFree(map, forceOn(shell, q, &b.energy));
  for (int i : start) b.moment += cross(p[i] - p[start[0]], f[i]).y;
  b.moment = std::abs(b.moment);
  for (int k = 0; k < n; ++k)
    for (int i = 1; i < 12; ++i) {
      const NurbsPatch& s = g.patches[k];
      const double u = s.u.front() + (s.u.back() - s.u.front()) * i / 12.0,
                   kappa = std::abs(shell.curvatureAt(k, {u, 0.5}, q).x);
      b.lowest_curvature = std::min(b.lowest_curvature, kappa);
      b.highest_curvature = std::max(b.highest_curvature, kappa);
    }
  return b;
}

const double kRigidity = rigidities(sheetFabric()).weft_Nm, kCurvature = kAngle / kLength;
const double kEnergy = 0.5 * kRigidity * kCurvature * kCurvature * kLength * kWidth,
             kMoment = kRigidity * kCurvature * kWidth;

TEST(Cylinder, StripsOfOneToFourPatchesJoinedByTBendAlike) {
  for (int degree : {2, 3}) {
    const Bent one = bend(degree, 1, SeamKind::G1, 0);
    for (int n : {1, 2, 3, 4}) {
      const Bent b = bend(degree, n, SeamKind::G1, 0);
      printf("degree %d, %d patches, G1: energy %.5f, moment %.5f, curvature %.4f to %.4f of the closed form\n", degree,
             n, b.energy / kEnergy, b.moment / kMoment, b.lowest_curvature / kCurvature,
             b.highest_curvature / kCurvature);
      EXPECT_NEAR(b.energy, kEnergy, 0.005 * kEnergy);
      EXPECT_NEAR(b.moment, kMoment, 0.005 * kMoment);
      EXPECT_NEAR(b.energy, one.energy, 1e-5 * kEnergy);
      EXPECT_NEAR(b.moment, one.moment, 1e-4 * kMoment);
      EXPECT_NEAR(b.lowest_curvature, kCurvature, 0.005 * kCurvature);
      EXPECT_NEAR(b.highest_curvature, kCurvature, 0.005 * kCurvature);
    }
  }
}

/// Springs in series with the sheet: energy 1/2 w phi^2 / (L/B + seams/k). With k = c B/cell the loss is seams/(c
/// cells). The ends are held where those of the arc are, so the moment of a sheet with soft seams is not uniform: no
/// bound on it.
TEST(Cylinder, SpringsAddTheirCompliance) {
  for (double factor : {10.0, 100.0, 1000.0})
    for (int n : {1, 2, 3, 4}) {
      const double k = factor * kRigidity / (kLength / kCells);
      const Bent b = bend(2, n, SeamKind::C0, k);
      const double series = 0.5 * kWidth * kAngle * kAngle / (kLength / kRigidity + (n - 1) / k);
      printf("degree 2, %d patches, C0 with %g B/cell: energy %.5f (in series %.5f), moment %.5f of the closed form\n",
             n, factor, b.energy / kEnergy, series / kEnergy, b.moment / kMoment);
      EXPECT_NEAR(b.energy, series, 0.003 * kEnergy);
      if (factor >= 100) {
        EXPECT_NEAR(b.energy, kEnergy, 0.005 * kEnergy);
        EXPECT_NEAR(b.moment, kMoment, 0.005 * kMoment);
      }
    }
  EXPECT_LT(bend(2, 2, SeamKind::C0, 0).energy, 0.9 * kEnergy);  // without a spring the seam is a hinge
}

/// A tube from a periodic quadratic spline, cut at knots into n patches that are joined all around.
Garment tube(int n, SeamKind kind, double stiffness, double radius, double length) {
  const int cells = 36, each = cells / n;
  const auto corner = [&](int k, double z) {
    const double angle = 2 * kPi * k / cells;
    return Vec3{radius * std::cos(angle), radius * std::sin(angle), z};
  };
  std::vector<NurbsPatch> patches;
  std::vector<Seam> seams;
  for (int k = 0; k < n; ++k) {
    NurbsPatch s = patchOf(uniformKnots(2, each), uniformKnots(2, 2), [&](double, double b) {
      return Vec3{0, 0, length * b};
    });
    for (int j = 0; j < s.v.count(); ++j)
      for (int i = 0; i < s.u.count(); ++i) {
        Vec3& x = s.points[s.index(i, j)];
        const int at = k * each + i;  // the clamped ends lie halfway between two corners of the control polygon
        x = i == 0          ? 0.5 * (corner(at, x.z) + corner(at + 1, x.z))
            : i == each + 1 ? 0.5 * (corner(at - 1, x.z) + corner(at, x.z))
                            : corner(at, x.z);
      }
    patches.push_back(s);
    seams.push_back({{k, Side::u1}, {(k + 1) % n, Side::u0}, kind, stiffness});
  }
  return garmentOf(patches, seams, sheetFabric(), {0, 0, 1});
}

/// The whole tube with zero rest curvature stores 1/2 B kappa^2 A. The energy is of second degree in the size at a
/// fixed rest metric, so the virtual work of swelling is 2 E (Euler). The nodal forces are those of one patch, by the
/// symmetry equal on every corner of the control polygon.
TEST(Cylinder, FullTubesOfOneToFourPatchesAreOne) {
  const double R = 0.06, length = 0.3, expected = 0.5 * kRigidity / (R * R) * 2 * kPi * R * length;
  for (SeamKind kind : {SeamKind::G1, SeamKind::C0})
    for (int n : {1, 2, 3, 4}) {
      const Garment g = tube(n, kind, kind == SeamKind::C0 ? 100 * kRigidity / (2 * kPi * R / 36) : 0, R, length);
      const FreeMap map = buildFreeMap(g);
      const std::vector<Vec3> q = restPoints(g);
      double energy = 0, swelling = 0, shape = 0;
      const auto f = onFree(map, forceOn(Shell(g, widestKernels(), 0, CellRule::full), q, &energy));
      for (std::size_t i = 0; i < f.size(); ++i) swelling -= dot(f[i], q[map.home[i]]);
      printf("tube of %d patches, %s: energy %.5f of the closed form\n", n, kind == SeamKind::G1 ? "G1" : "C0",
             energy / expected);
      EXPECT_NEAR(energy, expected, 0.005 * expected);
      EXPECT_NEAR(swelling, 2 * energy, 1e-9 * energy);
      if (kind == SeamKind::C0) continue;
      ASSERT_EQ(f.size(), 36u * 4u);
      for (std::size_t i = 0; i < f.size(); ++i) {
        const Vec3 x = q[map.home[i]];
        shape = std::max(shape, std::abs(x.x * f[i].y - x.y * f[i].x) / (R * norm(f[i])));  // no force along the circle
      }
      EXPECT_LT(shape, 1e-9);
    }
}

}  // namespace
}  // namespace gambeson
