// Loads: totals against closed forms, virtual work against finite differences, stiffness of those that follow.
#include "core/cloth/patches/patch_loads.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/cloth/draft/edge.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_cylinder.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kRadius = 0.7, kLength = 1.9;
const std::vector<double> kOne{1};

Garment cylinder() { return garmentOf({quarterCylinder(kRadius, kLength, 4)}, {}, plainFabric()); }

Vec3 total(const std::vector<Vec3>& f) {
  Vec3 sum{};
  for (const Vec3& v : f) sum += v;
  return sum;
}

Vec3 totalMoment(const std::vector<Vec3>& f, const std::vector<Vec3>& q) {
  Vec3 sum{};
  for (std::size_t i = 0; i < f.size(); ++i) sum += cross(q[i], f[i]);
  return sum;
}

void expectVec(const Vec3& a, const Vec3& b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

std::vector<Vec3> forceOf(const Loads& loads, const std::vector<Vec3>& q) {
  std::vector<Vec3> f(q.size());
  loads.add(q, kOne, f);
  return f;
}

// Centroid of a quarter arc: 2 R/pi from both axes.
TEST(Loads, EdgeForceOfAnArc) {
  const Garment g = cylinder();
  const Vec3 t{1, -2, 3};
  const auto f = edgeForce(g, {0, Side::v1}, t);
  const double length = kPi / 2 * kRadius;
  expectVec(total(f), length * t, 1e-9);
  const Vec3 centroid{2 * kRadius / kPi, 2 * kRadius / kPi, kLength};
  expectVec(totalMoment(f, restPoints(g)), cross(centroid, length * t), 1e-9);
}

TEST(Loads, SurfaceForceOfACylinder) {
  const Garment g = cylinder();
  const Vec3 b{0.5, 1, -2};
  const auto f = surfaceForce(g, 0, b);
  const double area = kPi / 2 * kRadius * kLength;
  expectVec(total(f), area * b, 1e-7);
  const Vec3 centroid{2 * kRadius / kPi, 2 * kRadius / kPi, kLength / 2};
  expectVec(totalMoment(f, restPoints(g)), cross(centroid, area * b), 1e-7);
}

TEST(Loads, WeightIsThatOfAllPatches) {
  Garment g =
      garmentOf({flatPatch(uniformKnots(2, 3), uniformKnots(3, 2), 2, 0.5), quarterCylinder(kRadius, kLength, 4)}, {},
                plainFabric());
  const double area = 1 + kPi / 2 * kRadius * kLength;
  expectVec(total(weightForce(g, {0, 0, -9.81})), {0, 0, -9.81 * 3 * area}, 1e-5);  // 300 kg/m^3, 0.01 m
  expectVec(total(garmentForce(g, {0, 0, 1})), {0, 0, area}, 1e-7);
  g.fabric.law = Laminate{{{.thickness_m = 0.002}, {.thickness_m = 0.003}}};  // the plies' thickness counts
  expectVec(total(weightForce(g, {0, 0, -9.81})), {0, 0, -9.81 * 1.5 * area}, 1e-5);
  g.fields.resize(2);  // twice as thick at the far end of the flat patch: 1.5 on average
  g.fields[0].thickness = PatchField{1, 2, 2, {1, 2, 1, 2}};
  expectVec(total(weightForce(g, {0, 0, -9.81})), {0, 0, -9.81 * 1.5 * (area + 0.5)}, 1e-5);
}

TEST(Loads, PointForceActsAtItsPoint) {
  const Garment g = garmentOf({curvedPatch(2, 2, false), curvedPatch(3, 2, true)}, {}, plainFabric());
  const Vec3 F{1, 2, -0.5};
  const auto f = pointForce(g, 1, {0.37, 0.81}, F);
  expectVec(total(f), F, 1e-14);
  expectVec(totalMoment(f, restPoints(g)), cross(surfaceDerivatives(g.patches[1], 0.37, 0.81)[0], F), 1e-14);
  EXPECT_EQ(f[0], Vec3{});  // nothing on the other patch
}

TEST(Loads, DeadLoadFollowsItsProgram) {
  const Garment g = cylinder();
  const auto force = surfaceForce(g, 0, {0, 0, 1});
  const Loads loads = loadsOf(g, {{force, 1}}, {}, {});
  EXPECT_EQ(loads.programs(), 2);
  EXPECT_FALSE(loads.follow());
  std::vector<Vec3> f(force.size());
  loads.add(restPoints(g), std::vector<double>{5, -0.25}, f);
  for (std::size_t i = 0; i < f.size(); ++i) EXPECT_EQ(f[i], -0.25 * force[i]);
}

// Pressure on a curved surface gives p times the projected area: R L towards x and y for a quarter, 2 R L for a half.
TEST(Loads, PressureGivesTheProjectedArea) {
  const Garment g = cylinder();
  const Loads loads = loadsOf(g, {}, {{0, 3.0, 0}}, {});
  EXPECT_TRUE(loads.follow());
  const auto f = forceOf(loads, restPoints(g));
  const double projected = 3 * kRadius * kLength;
  expectVec(total(f), {projected, projected, 0}, 1e-8);
  // Through the axis: no moment about z.
  expectVec(totalMoment(f, restPoints(g)), {-projected * kLength / 2, projected * kLength / 2, 0}, 1e-8);
}

double volumeOf(const NurbsPatch& patch, const std::vector<Vec3>& q) {
  double volume = 0;
  for (const SheetCell& cell : sheetCells(garmentOf({patch}, {}, plainFabric())))
    for (const CellPoint& point : cellRule(cell, 8, 8)) {
      const SurfaceBasis b = surfaceBasis(patch, point.u, point.v);
      volume += dot(combine(b.columns, b.values[0], q),
                    cross(combine(b.columns, b.values[1], q), combine(b.columns, b.values[2], q))) *
                point.weight / 3;
    }
  return volume;
}

TEST(Loads, PressureIsTheGradientOfTheVolumeInsideAHeldBoundary) {
  for (const auto& [p, q] : {std::pair{2, 2}, {3, 2}, {3, 4}}) {
    const NurbsPatch patch = curvedPatch(p, q, false);
    const Garment g = garmentOf({patch}, {}, plainFabric());
    const auto x = deformedFree(g, buildFreeMap(g), 0.03);
    const auto f = forceOf(loadsOf(g, {}, {{0, 2.0, 0}}, {}), x);
    for (int i = 1; i + 1 < patch.u.count(); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        const int at = patch.index(i, 1);
        auto plus = x, minus = x;  // the volume is linear in each single control point's component
        plus[at][axis] += 1, minus[at][axis] -= 1;
        EXPECT_NEAR(f[at][axis], 2.0 * (volumeOf(patch, plus) - volumeOf(patch, minus)) / 2, 1e-13);
      }
  }
}

BlockMatrix fullSparsity(int n) {
  BlockMatrix K;
  for (int r = 0; r < n; ++r) {
    for (int c = r; c < n; ++c) K.columns.push_back(c);
    K.offsets.push_back(static_cast<long>(K.columns.size()));
  }
  K.values.assign(9 * K.columns.size(), 0.0);
  return K;
}

Eigen::MatrixXd dense(const BlockMatrix& K) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(3 * K.rows(), 3 * K.rows());
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          m(3 * r + i, 3 * K.columns[k] + j) = K.values[9 * k + 3 * i + j];
          m(3 * K.columns[k] + j, 3 * r + i) = K.values[9 * k + 3 * i + j];
        }
  return m;
}

/// - d(Tᵀ f(T p))/dp by central differences.
Eigen::MatrixXd differences(const Loads& loads, const FreeMap& map, const std::vector<Vec3>& p, double step) {
  const int n = static_cast<int>(p.size());
  Eigen::MatrixXd m(3 * n, 3 * n);
  for (int J = 0; J < n; ++J)
    for (int j = 0; j < 3; ++j) {
      auto plus = p, minus = p;
      plus[J][j] += step, minus[J][j] -= step;
      const auto a = onFree(map, forceOf(loads, controlsOf(map, plus)));
      const auto b = onFree(map, forceOf(loads, controlsOf(map, minus)));
      for (int I = 0; I < n; ++I)
        for (int i = 0; i < 3; ++i) m(3 * I + i, 3 * J + j) = -(a[I][i] - b[I][i]) / (2 * step);
    }
  return m;
}

void expectSymmetricPart(const Garment& g, const Loads& loads) {
  const FreeMap map = buildFreeMap(g);
  const auto p = deformedFree(g, map, 0.02);
  BlockMatrix K = fullSparsity(map.T.column_count);
  loads.addStiffness(controlsOf(map, p), kOne, map, K);
  const Eigen::MatrixXd ours = dense(K), fd = differences(loads, map, p, 1e-5);
  const Eigen::MatrixXd symmetric = 0.5 * (fd + fd.transpose());
  const double size = symmetric.cwiseAbs().maxCoeff();
  EXPECT_GT(size, 1e-3);
  EXPECT_LT((ours - symmetric).cwiseAbs().maxCoeff(), 1e-7 * size);
}

TEST(Loads, PressureStiffnessAgainstDifferences) {
  const Garment one = garmentOf({curvedPatch(3, 2, true)}, {}, plainFabric());
  expectSymmetricPart(one, loadsOf(one, {}, {{0, 2.0, 0}}, {}));
  const Garment four = fourPatches(2, 2, false, SeamKind::G1, 0, plainFabric());
  expectSymmetricPart(four, loadsOf(four, {}, garmentPressure(four, 2.0), {}));
}

TEST(Loads, MomentStiffnessAgainstDifferences) {
  const Garment one = garmentOf({curvedPatch(3, 2, true)}, {}, plainFabric());
  for (Side side : {Side::u0, Side::u1, Side::v0, Side::v1})
    expectSymmetricPart(one, loadsOf(one, {}, {}, {{{0, side, side == Side::u1}, 1.5, 0}}));
  const Garment four = fourPatches(2, 3, false, SeamKind::G1, 0, plainFabric());
  expectSymmetricPart(four, loadsOf(four, {}, {}, {{{1, Side::u1}, 1.5, 0}, {{3, Side::u1}, 1.5, 0}}));
}

// Inside a held boundary pressure has a potential: nothing is lost by taking the symmetric part.
TEST(Loads, PressureStiffnessIsWholeInsideAHeldBoundary) {
  const Garment g = garmentOf({curvedPatch(3, 2, false)}, {}, plainFabric());
  const FreeMap map = buildFreeMap(g);
  const auto p = deformedFree(g, map, 0.02);
  const Loads loads = loadsOf(g, {}, {{0, 2.0, 0}}, {});
  BlockMatrix K = fullSparsity(map.T.column_count);
  loads.addStiffness(p, kOne, map, K);
  const Eigen::MatrixXd ours = dense(K), fd = differences(loads, map, p, 1e-3);  // quadratic in q: exact
  const NurbsPatch& patch = g.patches[0];
  double worst = 0;
  for (int j = 1; j + 1 < patch.v.count(); ++j)
    for (int i = 1; i + 1 < patch.u.count(); ++i)
      for (int l = 1; l + 1 < patch.v.count(); ++l)
        for (int k = 1; k + 1 < patch.u.count(); ++k) {
          const int r = 3 * patch.index(i, j), c = 3 * patch.index(k, l);
          worst = std::max(worst, (ours.block<3, 3>(r, c) - fd.block<3, 3>(r, c)).cwiseAbs().maxCoeff());
        }
  EXPECT_LT(worst, 1e-11);
}

// Virtual work of the moment: m times the turn of the normal about the tangent, by differences of the normal itself.
TEST(Loads, MomentWorksOnTheTurnOfTheNormal) {
  const Garment g = garmentOf({curvedPatch(3, 2, true)}, {}, plainFabric());
  const FreeMap map = buildFreeMap(g);
  const auto q = deformedFree(g, map, 0.02), moved = deformedFree(g, map, 0.02, 9);
  for (const PatchEdge edge : {PatchEdge{0, Side::u0}, {0, Side::u1}, {0, Side::v0}, {0, Side::v1, true}}) {
    const auto f = forceOf(loadsOf(g, {}, {}, {{edge, 1.5, 0}}), q);
    const double step = 1e-5;
    std::vector<Vec3> d(q.size()), plus = q, minus = q;
    double work = 0, reference = 0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      d[i] = moved[i] - q[i];
      plus[i] += step * d[i], minus[i] -= step * d[i];
      work += dot(f[i], d[i]);
    }
    for (const EdgePoint& point : edgePoints(g, edge)) {
      const EdgeBasis b = edgeBasis(g, edge, point.t);
      const auto normal = [&](const std::vector<Vec3>& x) {
        return normalized(cross(combine(b.columns, b.along, x), combine(b.columns, b.inward, x)));
      };
      const Vec3 t = normalized(combine(b.columns, b.along, q));
      reference += 1.5 * dot(cross(t, normal(q)), normal(plus) - normal(minus)) / (2 * step) * point.length_m;
    }
    EXPECT_GT(std::abs(reference), 1e-2);
    EXPECT_NEAR(work, reference, 1e-8);
  }
}

// A moment adds no force, and the moment m ∫ t ds over the rest length: here along a straight edge of a bent sheet.
TEST(Loads, MomentAddsAMomentAndNoForce) {
  const Garment g = cylinder();
  const auto f = forceOf(loadsOf(g, {}, {}, {{{0, Side::u1}, 2.5, 0}}), restPoints(g));
  expectVec(total(f), {}, 1e-13);
  expectVec(totalMoment(f, restPoints(g)), {0, 0, 2.5 * kLength}, 1e-12);
  const auto back = forceOf(loadsOf(g, {}, {}, {{{0, Side::u1, true}, 2.5, 0}}), restPoints(g));
  expectVec(totalMoment(back, restPoints(g)), {0, 0, -2.5 * kLength}, 1e-12);
  // Around the arc the tangents add up to the chord.
  const auto arc = forceOf(loadsOf(g, {}, {}, {{{0, Side::v0}, 2.5, 0}}), restPoints(g));
  expectVec(totalMoment(arc, restPoints(g)), {-2.5 * kRadius, 2.5 * kRadius, 0}, 1e-9);
}

// Patch test: under m = B kappa at both ends a flat strip takes the curvature kappa, z = kappa x^2/2 to first order;
// every cubic or quadratic mesh holds it exactly.
TEST(Loads, ConstantMomentPatchTest) {
  for (int p : {2, 3}) {
    const double kappa = 1e-6, length = 1.2;
    NurbsPatch patch = patchOf(knotsAt(p, {0, 0.2, 0.45, 1}), knotsAt(2, {0, 0.6, 1}), [&](double a, double b) {
      return Vec3{length * a, 0.4 * b, 0};
    });
    const Garment g = garmentOf({patch}, {}, plainFabric());
    const Shell shell(g, widestKernels());
    auto q = restPoints(g);
    const KnotVector& k = patch.u;
    for (int j = 0; j < patch.v.count(); ++j)
      for (int i = 0; i < k.count(); ++i) {  // blossom of x^2: mean of the products of pairs of the p knots
        double sum = 0;
        for (int a = 1; a <= p; ++a)
          for (int b = 1; b < a; ++b) sum += k.knots[i + a] * k.knots[i + b];
        q[patch.index(i, j)].z = 0.5 * kappa * length * length * sum / (p * (p - 1) / 2.0);
      }
    const double m = rigidities(g.fabric).weft_Nm * kappa;
    const Loads loads = loadsOf(g, {}, {}, {{{0, Side::u0}, m, 0}, {{0, Side::u1, true}, m, 0}});
    const auto load = forceOf(loads, q), inner = forceOn(shell, q);
    double size = 0, worst = 0;
    for (std::size_t i = 0; i < q.size(); ++i) {
      size = std::max(size, norm(load[i]));
      worst = std::max(worst, norm(load[i] + inner[i]));
    }
    EXPECT_LT(worst, 1e-4 * size) << "degree " << p;  // membrane forces of second order in kappa are left
  }
}

/// A flat 2 m x 1 m patch cut along the line from (0.3, 0) to (0.1, 1), with a round hole; in parameters.
Garment trimmedFlat() {
  Garment g = garmentOf({flatPatch(uniformKnots(2, 8), uniformKnots(2, 5), 2, 1)}, {}, plainFabric());
  const std::vector<Vec2> outline{{0.3, 0}, {1, 0}, {1, 1}, {0.1, 1}};
  g.trims = {Trim{.loops = {polygon(outline), {circle({0.7, 0.5}, 0.1, 0.2, true)}}, .points_per_piece = 6}};
  return g;
}

TEST(Loads, TrimmedPatchCarriesWhatIsLeft) {
  const Garment g = trimmedFlat();
  const double hole = kPi * 0.2 * 0.2, area = 2 * (1 - 0.2) - hole;
  const auto f = surfaceForce(g, 0, {0, 0, 3});
  expectVec(total(f), {0, 0, 3 * area}, 1e-6);
  // First moment about y: the trapezium from x = 0.6 - 0.4 y to 2, less the hole at x = 1.4.
  const double first = 0.5 * (4 - (0.36 - 0.24 + 0.16 / 3)) - 1.4 * hole;
  EXPECT_NEAR(totalMoment(f, restPoints(g)).y, -3 * first, 1e-6);
  const Loads loads = loadsOf(g, {}, {{0, 3.0, 0}}, {});
  expectVec(total(forceOf(loads, restPoints(g))), {0, 0, 3 * area}, 1e-6);
  // Edges: what is left of them.
  expectVec(total(edgeForce(g, {0, Side::v0}, {1, 0, 0})), {1.4, 0, 0}, 1e-12);
  expectVec(total(edgeForce(g, {0, Side::v1}, {1, 0, 0})), {1.8, 0, 0}, 1e-12);
  expectVec(total(edgeForce(g, {0, Side::u1}, {1, 0, 0})), {1, 0, 0}, 1e-12);
  const auto moment = forceOf(loadsOf(g, {}, {}, {{{0, Side::v0}, 2.0, 0}}), restPoints(g));
  EXPECT_NEAR(totalMoment(moment, restPoints(g)).x, 2.8, 1e-12);
  EXPECT_THROW(edgeForce(g, {0, Side::u0}, {1, 0, 0}), InputError);   // cut away
  EXPECT_THROW(pointForce(g, 0, {0.7, 0.5}, {1, 0, 0}), InputError);  // in the hole
  EXPECT_THROW(loadsOf(g, {}, {}, {{{0, Side::u0}, 1.0, 0}}), InputError);
}

TEST(Loads, BadInputIsRefused) {
  const Garment g = cylinder();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(edgeForce(g, {1, Side::u0}, {1, 0, 0}), InputError);
  EXPECT_THROW(edgeForce(g, {0, Side::u0}, {nan, 0, 0}), InputError);
  EXPECT_THROW(surfaceForce(g, -1, {1, 0, 0}), InputError);
  EXPECT_THROW(pointForce(g, 0, {1.01, 0.5}, {1, 0, 0}), InputError);
  EXPECT_THROW(pointForce(g, 0, {nan, 0.5}, {1, 0, 0}), InputError);
  EXPECT_THROW(weightForce(g, {0, nan, 0}), InputError);
  EXPECT_THROW(loadsOf(g, {{{Vec3{}}, 0}}, {}, {}), InputError);  // too few forces
  EXPECT_THROW(loadsOf(g, {{surfaceForce(g, 0, {1, 0, 0}), -1}}, {}, {}), InputError);
  EXPECT_THROW(loadsOf(g, {}, {{2, 1.0, 0}}, {}), InputError);
  EXPECT_THROW(loadsOf(g, {}, {{0, nan, 0}}, {}), InputError);
  EXPECT_THROW(loadsOf(g, {}, {}, {{{0, Side::u0}, nan, 0}}), InputError);
  EXPECT_THROW(loadsOf(g, {}, {}, {{{7, Side::u0}, 1, 0}}), InputError);
  Garment collapsed = g;  // an edge without length
  NurbsPatch& patch = collapsed.patches[0];
  for (int i = 0; i < patch.u.count(); ++i) patch.points[patch.index(i, 0)] = {0, 0, 0};
  EXPECT_THROW(edgeForce(collapsed, {0, Side::v0}, {1, 0, 0}), InputError);
}

}  // namespace
}  // namespace gambeson
