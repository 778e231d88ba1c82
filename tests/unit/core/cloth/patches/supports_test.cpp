// Supports: which motions they take and which they leave, exactly, on curved, rational and skewed patches.
#include "core/cloth/patches/patch_supports.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "core/cloth/draft/edge.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_cylinder.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double largestViolation(const std::vector<LinearConstraint>& constraints, const std::vector<Vec3>& u) {
  double worst = 0;
  for (const LinearConstraint& c : constraints) {
    double sum = 0;
    for (const auto& [control, coefficient] : c.terms) sum += dot(coefficient, u[control]);
    worst = std::max(worst, std::abs(sum));
  }
  return worst;
}

std::vector<Vec3> motion(const std::vector<Vec3>& q, const std::function<Vec3(const Vec3&)>& u) {
  std::vector<Vec3> out;
  for (const Vec3& x : q) out.push_back(u(x));
  return out;
}

int rankOf(const std::vector<LinearConstraint>& constraints, int controls) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(static_cast<int>(constraints.size()), 3 * controls);
  for (int r = 0; r < m.rows(); ++r)
    for (const auto& [control, v] : constraints[r].terms)
      for (int i = 0; i < 3; ++i) m(r, 3 * control + i) += v[i];
  return static_cast<int>(Eigen::FullPivLU<Eigen::MatrixXd>(m).setThreshold(1e-10).rank());
}

/// A flat rational patch in x, y whose grid is skewed at the straight edge u0 (x = 0).
NurbsPatch skewedFlat(bool rational) {
  NurbsPatch s = patchOf(knotsAt(3, {0, 0.4, 1}), knotsAt(2, {0, 0.3, 0.7, 1}), [](double a, double b) {
    return Vec3{a, b + 0.3 * a * (1 + b), 0};
  });
  std::mt19937 random(4);
  std::uniform_real_distribution<double> d(0.7, 1.4);
  if (rational)
    for (double& w : s.weights) w = d(random);
  return s;
}

TEST(Supports, EdgeHoldsItsComponents) {
  const Garment g = garmentOf({curvedPatch(2, 2, false), curvedPatch(3, 2, true)}, {}, plainFabric());
  const Vec3 d = normalized(Vec3{1, 2, -1});
  const auto held = supportEdge(g, {1, Side::v1}, std::vector{d});
  EXPECT_EQ(held.size(), static_cast<std::size_t>(g.patches[1].u.count()));
  const auto q = restPoints(g);
  EXPECT_NEAR(largestViolation(held, motion(q, [&](const Vec3&) { return d; })), 1, 1e-14);
  EXPECT_NEAR(largestViolation(held, motion(q, [&](const Vec3& x) { return cross(d, x); })), 0, 1e-14);
  const auto all = supportEdge(g, {1, Side::v1}, kAxes);
  EXPECT_EQ(rankOf(all, static_cast<int>(q.size())), 3 * g.patches[1].u.count());
  for (const LinearConstraint& c : all)
    for (const auto& [control, v] : c.terms) EXPECT_GE(control, g.patches[0].size());  // of patch 1
}

TEST(Supports, PrescribedMotionGoesToTheComponentsThatItMoves) {
  const Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, plainFabric());
  const auto moved = supportEdge(g, {0, Side::u1}, kAxes, {{0, 0.3, 0}, 2});
  const int n = g.patches[0].v.count();
  ASSERT_EQ(static_cast<int>(moved.size()), 3 * n);
  EXPECT_EQ(moved[0].amount_m, 0);
  EXPECT_EQ(moved[0].program, -1);
  EXPECT_EQ(moved[n].amount_m, 0.3);
  EXPECT_EQ(moved[n].program, 2);
  EXPECT_NE(moved[n].name.find("u1"), std::string::npos);
}

TEST(Supports, PointIsOneControlPointAtACornerAndACombinationInside) {
  const Garment g = garmentOf({curvedPatch(3, 2, true)}, {}, plainFabric());
  const auto corner = supportPoint(g, 0, {1, 0}, kAxes);
  ASSERT_EQ(corner.size(), 3u);
  ASSERT_EQ(corner[0].terms.size(), 1u);
  EXPECT_EQ(corner[0].terms[0].first, g.patches[0].u.count() - 1);
  // A rotation about the point leaves it; any other motion does not.
  const Vec3 x0 = surfaceDerivatives(g.patches[0], 0.21, 0.77)[0];
  const auto inside = supportPoint(g, 0, {0.21, 0.77}, kAxes);
  const auto q = restPoints(g);
  const auto turn = [&](const Vec3& x) { return cross(Vec3{1, 2, 3}, x - x0); };
  EXPECT_NEAR(largestViolation(inside, motion(q, turn)), 0, 1e-14);
  EXPECT_NEAR(largestViolation(inside, motion(q, [&](const Vec3&) { return Vec3{0, 0.5, 0}; })), 0.5, 1e-14);
}

// A clamp takes the rotation about the edge and leaves translations, the other rotations and all membrane strain.
TEST(Supports, ClampTakesTheRotationAboutTheEdgeAlone) {
  for (const bool skewed : {false, true})
    for (const bool rational : {false, true}) {
      NurbsPatch patch = skewedFlat(rational);
      if (!skewed) {
        const auto w = patch.weights;
        patch = flatPatch(patch.u, patch.v, 1, 1);
        patch.weights = w;
      }
      const Garment g = garmentOf({patch}, {}, plainFabric());
      const auto clamp = clampRotation(g, {0, Side::u0});
      const auto q = restPoints(g);
      EXPECT_EQ(rankOf(clamp, patch.size()), patch.v.count());
      for (const Vec3& axis : kAxes)
        EXPECT_NEAR(largestViolation(clamp, motion(q, [&](const Vec3&) { return axis; })), 0, 1e-14);
      EXPECT_GT(largestViolation(clamp, motion(q, [](const Vec3& x) { return cross({0, 1, 0}, x); })), 0.05);
      EXPECT_NEAR(largestViolation(clamp, motion(q, [](const Vec3& x) { return cross({0, 0, 1}, x); })), 0, 1e-13);
      // The edge tilts about x: its points move along the normal, and the sheet has not turned about the edge.
      EXPECT_NEAR(largestViolation(clamp, motion(q, [](const Vec3& x) { return cross({1, 0, 0}, x); })), 0, 1e-13);
      const auto strain = [](const Vec3& x) { return Vec3{0.7 * x.x + 0.2 * x.y, 0.4 * x.x - 0.1 * x.y, 0}; };
      EXPECT_NEAR(largestViolation(clamp, motion(q, strain)), 0, 1e-13);
      const auto isPair = [](const LinearConstraint& c) { return c.terms.size() == 2; };
      EXPECT_EQ(std::all_of(clamp.begin(), clamp.end(), isPair), !skewed && !rational);  // the plain case stays plain
    }
}

/// Largest turn of the normal about a held edge over motions that a clamp allows: the row next to the edge moves at
/// random in the null space of the clamp's equations, by `size`.
double largestTurn(int cells, double size) {
  const Garment g = garmentOf({quarterCylinder(0.7, 1.9, cells)}, {}, plainFabric());
  const PatchEdge edge{0, Side::v0};
  const auto clamp = clampRotation(g, edge);
  const auto q = restPoints(g);
  const EdgeColumns rows = edgeColumns(g, edge);
  const int n = static_cast<int>(rows.inner.size());
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(static_cast<int>(clamp.size()), 3 * n);
  for (int r = 0; r < m.rows(); ++r)
    for (const auto& [control, v] : clamp[r].terms)
      for (int i = 0; i < n; ++i)
        if (rows.inner[i] == control)
          for (int axis = 0; axis < 3; ++axis) m(r, 3 * i + axis) += v[axis];
  // A smooth field in the tangent plane, and what of it the clamp leaves.
  Eigen::VectorXd u(3 * n);
  for (int i = 0; i < n; ++i) {
    const double phi = std::atan2(q[rows.inner[i]].y, q[rows.inner[i]].x);
    const double s = size * std::sin(2 * phi);
    u.segment<3>(3 * i) << -s * std::sin(phi), s * std::cos(phi), 0.5 * s;
  }
  u -= m.transpose() * (m * m.transpose()).ldlt().solve(m * u);
  auto x = q;
  for (int i = 0; i < n; ++i) x[rows.inner[i]] += Vec3{u[3 * i], u[3 * i + 1], u[3 * i + 2]};
  double worst = 0;
  for (int i = 0; i <= 200; ++i) {
    const EdgeBasis b = edgeBasis(g, edge, i / 200.0);
    const auto normal = [&](const std::vector<Vec3>& at) {
      return normalized(cross(combine(b.columns, b.along, at), combine(b.columns, b.inward, at)));
    };
    worst = std::max(worst, norm(normal(x) - normal(q)));
  }
  return worst;
}

// Around a curved edge the normal turns: the clamp holds it at as many points as there are control points, and between
// them up to an interpolation error of quadratic splines, third order; also for motions as large as the cells.
TEST(Supports, ClampOfACurvedEdgeConverges) {
  const double coarse = largestTurn(4, 0.05), fine = largestTurn(8, 0.05);
  EXPECT_LT(coarse, 2e-2);
  EXPECT_GT(coarse, 1e-8);  // the comparison means something
  EXPECT_GT(std::log2(coarse / fine), 2.5) << coarse << " " << fine;
}

// A mirrored motion of any size satisfies symmetry; shear across the plane and tilt of the surface do not.
TEST(Supports, SymmetryTakesWhatIsNotMirrored) {
  for (const bool rational : {false, true}) {
    const Garment g = garmentOf({skewedFlat(rational)}, {}, plainFabric());
    const auto symmetry = symmetryEdge(g, {0, Side::u0}, {1, 0, 0});
    const auto q = restPoints(g);
    EXPECT_EQ(rankOf(symmetry, g.patches[0].size()), 3 * g.patches[0].v.count());
    const auto mirrored = [](const Vec3& x) {  // a turn by 1 rad about x, stretch and shear within the plane
      const Mat3 turn = rotationAbout({1, 0, 0}, 1);
      return turn * Vec3{1.4 * x.x, 0.8 * x.y + 0.3 * x.z, 1.1 * x.z} + Vec3{0, 3, -2} - x;
    };
    EXPECT_NEAR(largestViolation(symmetry, motion(q, mirrored)), 0, 1e-13);
    EXPECT_GT(largestViolation(symmetry, motion(q, [](const Vec3& x) { return Vec3{0, 0, 0.1 * x.x}; })), 0.005);
    EXPECT_GT(largestViolation(symmetry, motion(q, [](const Vec3& x) { return Vec3{0, 0.1 * x.x, 0}; })), 0.005);
    EXPECT_GT(largestViolation(symmetry, motion(q, [](const Vec3&) { return Vec3{0.1, 0, 0}; })), 0.05);
  }
}

TEST(Supports, SymmetryOfACylinder) {
  const Garment g = garmentOf({quarterCylinder(0.7, 1.9, 4)}, {}, plainFabric());
  const auto q = restPoints(g);
  for (const auto& [side, normal] : {std::pair{Side::v0, Vec3{0, 0, 1}}, {Side::u0, Vec3{0, 1, 0}}}) {
    const auto symmetry = symmetryEdge(g, {0, side}, normal);
    EXPECT_EQ(rankOf(symmetry, g.patches[0].size()), static_cast<int>(symmetry.size()));
    EXPECT_NEAR(
        largestViolation(symmetry,
                         motion(q, [&](const Vec3& x) { return 0.5 * dot(x, normal) * normal + cross(normal, x); })),
        0, 1e-13);
  }
  EXPECT_THROW(symmetryEdge(g, {0, Side::v0}, {1, 0, 0}), InputError);  // not in that plane
  EXPECT_THROW(symmetryEdge(g, {0, Side::u0}, {1, 0, 0}), InputError);  // tangent to it
  EXPECT_THROW(symmetryEdge(g, {0, Side::u0}, {0, 2, 0}), InputError);
}

TEST(Supports, TieLeavesTheCommonMotion) {
  const Garment g = garmentOf({curvedPatch(2, 3, true)}, {}, plainFabric());
  const Vec3 d = normalized(Vec3{1, 0, 1});
  const auto tie = tieEdge(g, {0, Side::u1, true}, d);
  const auto q = restPoints(g);
  EXPECT_EQ(static_cast<int>(tie.size()), g.patches[0].v.count() - 1);
  EXPECT_NEAR(largestViolation(tie, motion(q, [&](const Vec3&) { return d; })), 0, 1e-15);
  EXPECT_NEAR(largestViolation(tie, motion(q, [&](const Vec3& x) { return x.y * Vec3{0, 1, 0}; })), 0, 1e-15);
  EXPECT_GT(largestViolation(tie, motion(q, [&](const Vec3& x) { return x.y * d; })), 0.1);
}

TEST(Supports, TrimmedEdgeHoldsWhatIsLeft) {
  Garment g = garmentOf({flatPatch(uniformKnots(2, 10), uniformKnots(2, 4), 1, 1)}, {}, plainFabric());
  const std::vector<Vec2> outline{{0.25, 0}, {1, 0}, {1, 1}, {0.25, 1}};
  g.trims = {Trim{.loops = {polygon(outline)}}};
  // Of 12 functions the first two, on [0, 0.1] and [0, 0.2], do not reach [0.25, 1].
  const auto held = supportEdge(g, {0, Side::v0}, std::vector{Vec3{0, 0, 1}});
  EXPECT_EQ(held.size(), 10u);
  EXPECT_EQ(held[0].terms[0].first, 2);
  EXPECT_EQ(clampRotation(g, {0, Side::v0, true}).size(), 10u);
  EXPECT_EQ(tieEdge(g, {0, Side::v0}, {0, 0, 1}).size(), 9u);
  EXPECT_EQ(supportEdge(g, {0, Side::u1}, std::vector{Vec3{0, 0, 1}}).size(), 6u);
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, std::vector{Vec3{0, 0, 1}}), InputError);
  EXPECT_THROW(supportPoint(g, 0, {0.1, 0.5}, kAxes), InputError);
}

TEST(Supports, BadInputIsRefused) {
  const Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, plainFabric());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(supportEdge(g, {1, Side::u0}, kAxes), InputError);
  EXPECT_THROW(supportEdge(g, {-1, Side::u0}, kAxes), InputError);
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, {}), InputError);
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, std::vector{Vec3{1, 1, 0}}), InputError);
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, std::vector{Vec3{nan, 1, 0}}), InputError);
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, kAxes, {{0, 0.1, 0}, -1}), InputError);  // no program
  EXPECT_THROW(supportEdge(g, {0, Side::u0}, kAxes, {{0, nan, 0}, 0}), InputError);
  EXPECT_THROW(supportPoint(g, 0, {0.5, 1.5}, kAxes), InputError);
  EXPECT_THROW(supportPoint(g, 3, {0.5, 0.5}, kAxes), InputError);
  EXPECT_THROW(supportPoint(g, 0, {0.5, nan}, kAxes), InputError);
  EXPECT_THROW(clampRotation(g, {2, Side::u0}), InputError);
  EXPECT_THROW(tieEdge(g, {0, Side::u0}, {}), InputError);
  Garment collapsed = g;  // an edge that is a point has no tangent
  NurbsPatch& patch = collapsed.patches[0];
  for (int i = 0; i < patch.u.count(); ++i) patch.points[patch.index(i, 0)] = {};
  EXPECT_THROW(clampRotation(collapsed, {0, Side::v0}), InputError);
  Garment open = g;  // knots that are not clamped: the edge depends on more than its own row
  open.patches[0].u.knots.front() -= 0.1;
  EXPECT_THROW(supportEdge(open, {0, Side::u0}, kAxes), InputError);
}

}  // namespace
}  // namespace gambeson
