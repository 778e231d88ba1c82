// Weak seams: patches whose edges do not match (after Herrema et al. 2019), and the stiffness of hinges.
#include "core/cloth/shell/weak_seam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/cloth/draft/hinge.hpp"
#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/shell/tangent.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_cylinder.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

using Blocks = std::vector<std::array<double, 9>>;

void addBlocks(const std::vector<int>& columns, const Blocks& blocks, Eigen::MatrixXd& K) {
  const std::size_t n = columns.size();
  for (std::size_t I = 0; I < n; ++I)
    for (std::size_t J = 0; J < n; ++J)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) K(3 * columns[I] + i, 3 * columns[J] + j) += blocks[I * n + J][3 * i + j];
}

Eigen::MatrixXd stiffness(const WeakPoints& points, const std::vector<Vec3>& q) {
  const auto n = static_cast<int>(3 * q.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Blocks blocks;
  for (const GapPoint& p : points.gaps) {
    gapStiffness(p, blocks);
    addBlocks(p.columns, blocks, K);
  }
  for (const HingePoint& h : points.hinges) {
    hingeStiffness(h, q, blocks);
    addBlocks(h.columns, blocks, K);
  }
  return K;
}

Eigen::MatrixXd differences(const std::function<std::vector<Vec3>(const std::vector<Vec3>&)>& force,
                            const std::vector<Vec3>& q, double step) {
  const auto n = static_cast<int>(q.size());
  Eigen::MatrixXd K(3 * n, 3 * n);
  for (int J = 0; J < n; ++J)
    for (int j = 0; j < 3; ++j) {
      auto plus = q, minus = q;
      plus[J][j] += step, minus[J][j] -= step;
      const auto a = force(plus), b = force(minus);
      for (int I = 0; I < n; ++I)
        for (int i = 0; i < 3; ++i) K(3 * I + i, 3 * J + j) = -(a[I][i] - b[I][i]) / (2 * step);
    }
  return K;
}

std::vector<Vec3> weakForce(const WeakPoints& points, const std::vector<Vec3>& q, double* energy = nullptr) {
  std::vector<Vec3> f(q.size());
  const double e = addWeakForce(points, q, f);
  if (energy) *energy = e;
  return f;
}

/// A curved patch cut at u = 0.55 with the right part refined and raised: one curve, other knots and degree.
Garment curvedPair(SeamKind kind, double spring = 0) {
  const auto [left, right] = cutU(curvedPatch(2, 2, true), 0.55);
  const NurbsPatch finer = insertKnots(elevateDegree(right, Direction::v), Direction::v, std::vector{0.25, 0.7, 0.85});
  Garment g = garmentOf({left, flippedU(finer)}, {}, plainFabric());
  g.weak_seams = {{{0, Side::u1}, {1, Side::u1, true}, kind, spring}};
  return g;
}

TEST(WeakSeam, AllKnotsOfBothEdgesEndAPiece) {
  const auto points = buildWeakSeams(curvedPair(SeamKind::G1));
  EXPECT_EQ(points.gaps.size(), 5u * 4u);  // cells 0 0.25 0.4 0.7 0.85 1, degree 3
  EXPECT_EQ(points.hinges.size(), points.gaps.size());
  EXPECT_TRUE(buildWeakSeams(curvedPair(SeamKind::C0)).hinges.empty());
  EXPECT_EQ(buildWeakSeams(curvedPair(SeamKind::C0, 0.3)).hinges.size(), points.hinges.size());
}

TEST(WeakSeam, RigidMotionsOfAnySizeAreFree) {
  const Garment g = curvedPair(SeamKind::G1);
  const auto points = buildWeakSeams(g);
  const Mat3 turn = rotationAbout(normalized(Vec3{1, 2, 3}), 2.5);
  auto q = restPoints(g);
  for (Vec3& x : q) x = turn * x + Vec3{3, -1, 2};
  double energy = 0;
  const auto f = weakForce(points, q, &energy);
  double stiffest = 0;
  for (const GapPoint& p : points.gaps) stiffest = std::max(stiffest, p.stiffness_N_per_m);
  EXPECT_LT(energy, 1e-20 * stiffest);
  for (const Vec3& v : f) EXPECT_LT(norm(v), 1e-12 * stiffest);
}

TEST(WeakSeam, ForceIsTheGradientAndStiffnessTheSecondDerivative) {
  const Garment g = curvedPair(SeamKind::G1);
  const auto points = buildWeakSeams(g);
  const auto q = deformedFree(g, buildFreeMap(g), 0.02);  // no strong seams: all control points
  const auto f = weakForce(points, q);
  double size = 0;
  for (const Vec3& v : f) size = std::max(size, norm(v));
  for (std::size_t i = 0; i < q.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      auto plus = q, minus = q;
      plus[i][axis] += 1e-6, minus[i][axis] -= 1e-6;
      double a = 0, b = 0;
      weakForce(points, plus, &a);
      weakForce(points, minus, &b);
      EXPECT_NEAR(f[i][axis], -(a - b) / 2e-6, 1e-6 * size);
    }
  const Eigen::MatrixXd K = stiffness(points, q);
  const Eigen::MatrixXd fd = differences([&](const auto& x) { return weakForce(points, x); }, q, 1e-6);
  EXPECT_LT((K - fd).cwiseAbs().maxCoeff(), 1e-7 * K.cwiseAbs().maxCoeff());
  EXPECT_LT((K - K.transpose()).cwiseAbs().maxCoeff(), 1e-13 * K.cwiseAbs().maxCoeff());
}

TEST(WeakSeam, HingeStiffnessIsTheSecondDerivativeFarFromRest) {
  // Any five points with any rows: tangents at any angle to the edge, turned by 1 rad, so that the geometric part
  // counts.
  std::mt19937 random(21);
  std::uniform_real_distribution<double> d(-1, 1);
  for (int trial = 0; trial < 5; ++trial) {
    HingePoint h{{0, 1, 2, 3, 4}, {}, {}, {}, 0.7, 0};
    std::vector<Vec3> q;
    for (int k = 0; k < 5; ++k) {
      h.t.push_back(d(random)), h.a.push_back(d(random)), h.b.push_back(d(random));
      q.push_back({d(random), d(random), d(random)});
    }
    h.theta0 = hingeAngle(h, q, nullptr) - 1;
    const WeakPoints one{{}, {h}};
    const Eigen::MatrixXd K = stiffness(one, q);
    const Eigen::MatrixXd fd = differences([&](const auto& x) { return weakForce(one, x); }, q, 1e-6);
    EXPECT_LT((K - fd).cwiseAbs().maxCoeff(), 1e-7 * K.cwiseAbs().maxCoeff()) << "trial " << trial;
  }
}

/// Two flat patches in a row along x whose edges do not match, and the relative errors of the end's displacement under
/// tension and under an end moment, against n L/(E h) and m L^2/(2 B).
struct StripErrors {
  double tension, bending;
};
StripErrors strip(double factor, double scale) {
  Fabric fabric = plainFabric();
  for (double* p : {&fabric.young_weft_Pa, &fabric.young_warp_Pa, &fabric.shear_Pa}) *p *= scale;
  rigidities(fabric).stiffen(scale);
  const double length = 1.2, width = 0.4;
  const auto part = [&](int p, const std::vector<double>& us, const std::vector<double>& vs, double from, double to) {
    return patchOf(knotsAt(p, us), knotsAt(p, vs), [&](double a, double b) {
      return Vec3{from + (to - from) * a, width * b, 0};
    });
  };
  Garment g = garmentOf(
      {part(2, {0, 0.5, 1}, {0, 0.4, 1}, 0, 0.5), part(3, {0, 0.6, 1}, {0, 0.3, 0.7, 1}, 0.5, length)}, {}, fabric);
  g.weak_seams = {{{0, Side::u1}, {1, Side::u0}, SeamKind::G1, 0, factor}};
  const Shell shell(g, widestKernels());
  const auto q = restPoints(g);
  ClothWork work;
  BlockMatrix blocks;
  Tangent(shell, buildFreeMap(g)).assemble(shell, q, work, blocks);  // no strong seams: all control points are free
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(3 * blocks.rows(), 3 * blocks.rows());
  for (int r = 0; r < blocks.rows(); ++r)
    for (long k = blocks.offsets[r]; k < blocks.offsets[r + 1]; ++k)
      for (int i = 0; i < 9; ++i) {
        K(3 * r + i / 3, 3 * blocks.columns[k] + i % 3) = blocks.values[9 * k + i];
        K(3 * blocks.columns[k] + i % 3, 3 * r + i / 3) = blocks.values[9 * k + i];
      }

  const auto stretch = edgeForce(g, {1, Side::u1}, {1, 0, 0});
  std::vector<Vec3> bend(q.size());
  loadsOf(g, {}, {}, {{{1, Side::u1, true}, 1.0, 0}}).add(q, std::vector{1.0}, bend);
  const int n = static_cast<int>(q.size());
  Eigen::MatrixXd f(3 * n, 2);
  for (int i = 0; i < n; ++i)
    for (int d = 0; d < 3; ++d) f(3 * i + d, 0) = stretch[i][d], f(3 * i + d, 1) = bend[i][d];
  const auto hold = [&](int control, int axis) {
    K.row(3 * control + axis).setZero();
    K.col(3 * control + axis).setZero();
    K(3 * control + axis, 3 * control + axis) = scale;
    f.row(3 * control + axis).setZero();
  };
  const EdgeColumns rows = edgeColumns(g, {0, Side::u0});
  for (int control : rows.edge) hold(control, 0), hold(control, 2);
  for (int control : rows.inner) hold(control, 2);
  hold(rows.edge[0], 1);
  const Eigen::MatrixXd u = (0.5 * (K + K.transpose())).ldlt().solve(f);
  const int tip = edgeColumns(g, {1, Side::u1}).edge[0];
  return {u(3 * tip, 0) / (length / (fabric.young_weft_Pa * fabric.thickness_m)) - 1,
          u(3 * tip + 2, 1) / (0.5 * length * length / rigidities(fabric).weft_Nm) - 1};
}

// The seam gives way by h/f, h = 0.2 m and 0.14 m: less than 1/f of the strip's own displacement, whatever the
// stiffness.
TEST(WeakSeam, GivesWayByOneOverItsFactor) {
  for (double factor : {1e2, 1e3, 1e4}) {
    const StripErrors e = strip(factor, 1);
    std::printf("[ measured ] factor %.0e: tension %+.2e, bending %+.2e\n", factor, e.tension, e.bending);
    EXPECT_GT(e.tension, 0);
    EXPECT_LT(e.tension, 0.5 / factor);
    EXPECT_GT(e.bending, 0);
    EXPECT_LT(e.bending, 0.5 / factor);
  }
  const StripErrors soft = strip(1e3, 1), stiff = strip(1e3, 1e5);
  EXPECT_NEAR(stiff.tension, soft.tension, 1e-6);
  EXPECT_NEAR(stiff.bending, soft.bending, 1e-6);
}

// An edge may lie on a part of the other: two half patches against one whole edge.
TEST(WeakSeam, ShortEdgeOnALongOne) {
  const auto k = uniformKnots(2, 3);
  NurbsPatch below = flatPatch(k, k, 1, 1), left = flatPatch(k, k, 0.37, 1), right = flatPatch(k, k, 0.63, 1);
  for (Vec3& x : left.points) x += Vec3{0, 1, 0};
  for (Vec3& x : right.points) x += Vec3{0.37, 1, 0};
  Garment g = garmentOf({below, left, right}, {}, plainFabric());
  g.weak_seams = {{{0, Side::v1}, {1, Side::v0}}, {{2, Side::v0}, {0, Side::v1}}};
  const auto points = buildWeakSeams(g);
  // Stiffness per length f A/h, A = 200 Pa 0.01 m/(1 - 0.25^2/2), h the mean of 1/3 and 0.37/3 or 0.63/3.
  double total = 0;
  for (const GapPoint& p : points.gaps) total += p.stiffness_N_per_m;
  const double A = 2 / (1 - 0.0625 / 2);
  EXPECT_NEAR(total, 1e3 * A * 6 * (0.37 / 1.37 + 0.63 / 1.63), 1e-9 * total);
}

/// A whole tube as one patch, closed at the angle `start`; z from `from` to `to`.
NurbsPatch tube(double start, double from, double to) {
  NurbsPatch s{{2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}}, uniformKnots(2, 2), {}, {}};
  for (double b : grevillePoints(s.v))
    for (int i = 0; i < 9; ++i) {
      const double r = i % 2 == 0 ? 0.7 : 0.7 * std::sqrt(2.0), phi = start + i * kPi / 4;
      s.points.push_back({r * std::cos(phi), r * std::sin(phi), from + (to - from) * b});
      s.weights.push_back(i % 2 == 0 ? 1 : std::sqrt(0.5));
    }
  return s;
}

TEST(WeakSeam, ClosedTubesThatCloseElsewhere) {
  Garment g = garmentOf({tube(0, 0, 1), flippedU(tube(1, 1, 2))}, {}, plainFabric(), {0, 0, 1});
  g.weak_seams = {{{0, Side::v1}, {1, Side::v0}}};
  const auto points = buildWeakSeams(g);
  EXPECT_EQ(points.gaps.size(), 8u * 3u);  // four knots of either
  const auto q = restPoints(g);
  for (const GapPoint& p : points.gaps) EXPECT_LT(norm(gapOf(p, q)), 1e-14);
  for (const HingePoint& h : points.hinges) EXPECT_NEAR(h.theta0, 0, 1e-13);
}

TEST(WeakSeam, BadInputIsRefused) {
  const auto refused = [](const std::function<void(Garment&)>& change) {
    Garment g = curvedPair(SeamKind::G1);
    change(g);
    try {
      buildWeakSeams(g);
    } catch (const InputError& e) {
      return e.where().key == "weak_seams[0]";
    }
    return false;
  };
  EXPECT_FALSE(refused([](Garment&) {}));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].a.patch = 2; }));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].factor = 0; }));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].factor = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].stiffness_N = -1; }));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].b = g.weak_seams[0].a; }));
  EXPECT_TRUE(refused([](Garment& g) { g.weak_seams[0].b.side = Side::u0; }));  // far away
  EXPECT_TRUE(refused([](Garment& g) {                                          // apart by 1 mm in the middle
    NurbsPatch& p = g.patches[1];
    p.points[p.index(p.u.count() - 1, 3)].z += 0.003;
  }));
}

}  // namespace
}  // namespace gambeson
