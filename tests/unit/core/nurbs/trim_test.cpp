/// Trimming loops: what is kept, its quadrature, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Trim holes(std::vector<TrimLoop> loops, int points = 0) { return {std::move(loops), points}; }

void expectPositiveInside(const NurbsPatch& patch, const Trim& trim) {
  for (const CellPoint& p : allPoints(patch, trim)) {
    EXPECT_GT(p.weight, 0);
    EXPECT_TRUE(isKept(patch, trim, {p.u, p.v})) << p.u << " " << p.v;
  }
}

TEST(NurbsCurve, PointsAndTangents) {
  const NurbsCurve c = circle({0.4, 0.6}, 0.2, 0.2, false);
  validate(c);
  for (double t : {0.0, 0.1, 0.3, 0.77, 1.0}) {
    const CurvePoint p = curvePoint(c, t);
    const double x = p.point.x - 0.4, y = p.point.y - 0.6;
    EXPECT_NEAR(std::hypot(x, y), 0.2, 1e-15);                 // exact circle
    EXPECT_NEAR(x * p.tangent.x + y * p.tangent.y, 0, 1e-15);  // tangent normal to the radius
    EXPECT_GT(x * p.tangent.y - y * p.tangent.x, 0);           // counter-clockwise
    if (t < 1) {
      const double h = 1e-6;
      const Vec2 a = curvePoint(c, t).point, b = curvePoint(c, t + h).point;
      EXPECT_NEAR((b.x - a.x) / h, p.tangent.x, 1e-5);
      EXPECT_NEAR((b.y - a.y) / h, p.tangent.y, 1e-5);
    }
  }
  // Bezier segments are the curve itself.
  const std::vector<Vec2> points{{0.1, 0.2}, {0.8, 0.1}, {0.9, 0.7}, {0.5, 0.9}, {0.2, 0.6}};
  for (const NurbsCurve& curve : {c, closedSpline(points)}) {
    const auto ends = breakpoints(curve.knots);
    const auto segments = bezierSegments(curve);
    ASSERT_EQ(segments.size() + 1, ends.size());
    for (std::size_t k = 0; k < segments.size(); ++k)
      for (double t : {0.0, 0.3, 1.0}) {
        const double dt = ends[k + 1] - ends[k];
        const CurvePoint a = segments[k].at(t), b = curvePoint(curve, ends[k] + t * dt);
        EXPECT_NEAR(a.point.x, b.point.x, 1e-15);
        EXPECT_NEAR(a.point.y, b.point.y, 1e-15);
        if (t == 1) continue;  // the next cell's tangent
        EXPECT_NEAR(a.tangent.x, dt * b.tangent.x, 1e-13);
        EXPECT_NEAR(a.tangent.y, dt * b.tangent.y, 1e-13);
      }
  }
}

TEST(NurbsCurve, ClosedSplineInterpolatesAndIsSmooth) {
  const std::vector<Vec2> points{{0.1, 0.2}, {0.8, 0.1}, {0.9, 0.7}, {0.5, 0.9}};
  const NurbsCurve c = closedSpline(points);
  validate(c);
  double at = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec2 p = curvePoint(c, at).point, next = points[(k + 1) % points.size()];
    EXPECT_NEAR(p.x, points[k].x, 1e-14);
    EXPECT_NEAR(p.y, points[k].y, 1e-14);
    at += std::hypot(next.x - points[k].x, next.y - points[k].y);
  }
  const CurvePoint a = curvePoint(c, c.knots.front()), b = curvePoint(c, c.knots.back());
  EXPECT_NEAR(a.point.x, b.point.x, 1e-14);
  EXPECT_NEAR(a.tangent.x, b.tangent.x, 1e-13);
  EXPECT_NEAR(a.tangent.y, b.tangent.y, 1e-13);
}

TEST(Trim, WithoutLoopsNothingChanges) {
  for (const TrimmedCell& c : trimCells(unitPatch(2, 3), {})) EXPECT_EQ(c.kind, CellKind::inside);
}

TEST(Trim, AreaOfTheUnitSquareLessACircle) {
  // A generic circle, one about a knot vertex through knot vertices, one tangent to grid lines, one within a cell.
  const struct {
    Vec2 center;
    double radius;
  } cases[] = {{{0.47, 0.53}, 0.31}, {{0.5, 0.5}, 0.25}, {{0.5, 0.5}, 0.125}, {{0.375, 0.625}, 0.125},
               {{0.4, 0.4}, 0.01},   {{0.5, 0.3}, 0.2},  {{0.25, 0.25}, 0.25}};
  for (const auto& c : cases) {
    const Trim hole = holes({{circle(c.center, c.radius, c.radius, true)}}, 12);
    const Trim disk = holes({{circle(c.center, c.radius, c.radius, false)}}, 12);
    const double expected = kPi * c.radius * c.radius;
    EXPECT_NEAR(keptArea(unitPatch(2, 8), hole), 1 - expected, 1e-10) << c.center.x << " " << c.radius;
    EXPECT_NEAR(keptArea(unitPatch(2, 8), disk), expected, 1e-10) << c.center.x << " " << c.radius;
    expectPositiveInside(unitPatch(2, 8), holes(hole.loops, 3));
    expectPositiveInside(unitPatch(2, 8), holes(disk.loops, 3));
  }
}

TEST(Trim, PolynomialsOverAnEllipse) {
  // ∫ x^2 y^2 over an ellipse about c: closed form from its even moments.
  const Vec2 c{0.45, 0.52};
  const double a = 0.33, b = 0.21, A = kPi * a * b;
  const double xx = a * a / 4, yy = b * b / 4, xxyy = a * a * b * b / 24;
  const double exact = A * (xxyy + c.x * c.x * yy + c.y * c.y * xx + c.x * c.x * c.y * c.y);
  double sum = 0;
  for (const CellPoint& p : allPoints(unitPatch(2, 5), holes({{circle(c, a, b, false)}}, 12)))
    sum += p.weight * p.u * p.u * p.v * p.v;
  EXPECT_NEAR(sum, exact, 1e-10);
}

TEST(Trim, AreaConvergesAtTheOrderOfTheQuadrature) {
  // n Gauss points on smooth pieces of size h: error of the area O(h^2n); measured 2.2, 3.4, 5.5 over three halvings
  // (rms over six circles, whose errors fluctuate; the last halvings come closer).
  for (int points : {1, 2, 3}) {
    std::vector<double> errors;
    for (int cells : {4, 8, 16, 32}) {
      double sum = 0;
      for (int k = 0; k < 6; ++k) {
        const Vec2 c{0.47 + 0.011 * k, 0.51 - 0.007 * k};
        const double r = 0.29 + 0.013 * k;
        sum += std::pow(keptArea(unitPatch(2, cells), holes({{circle(c, r, r, true)}}, points)) - 1 + kPi * r * r, 2);
      }
      errors.push_back(std::sqrt(sum / 6));
    }
    EXPECT_GT(std::log2(errors.front() / errors.back()) / 3, 2 * points - 0.8) << points;
  }
}

TEST(Trim, SeveralHolesOutlinesAndIslands) {
  const NurbsPatch patch = unitPatch(2, 7);
  const std::vector<Vec2> star{
      {0.1, 0.1}, {0.3, 0.15}, {0.35, 0.4}, {0.2, 0.25}};  // counter-clockwise, one acute corner
  std::vector<Vec2> back(star.rbegin(), star.rend());
  double polygon_area = 0;
  for (std::size_t k = 0; k < star.size(); ++k) {
    const Vec2 a = star[k], b = star[(k + 1) % star.size()];
    polygon_area += 0.5 * (a.x * b.y - b.x * a.y);
  }
  const Trim holes3 =
      holes({{circle({0.7, 0.7}, 0.2, 0.15, true)}, polygon(back), {circle({0.75, 0.2}, 0.1, 0.1, true)}}, 10);
  EXPECT_NEAR(keptArea(patch, holes3), 1 - kPi * 0.03 - kPi * 0.01 - polygon_area, 1e-10);
  // An outline with a hole with an island in it, and a second outline.
  const Trim nested = holes({{circle({0.6, 0.6}, 0.35, 0.35, false)},
                             {circle({0.6, 0.6}, 0.25, 0.25, true)},
                             {circle({0.6, 0.6}, 0.12, 0.12, false)},
                             {circle({0.12, 0.12}, 0.1, 0.1, false)}},
                            12);
  EXPECT_NEAR(keptArea(patch, nested), kPi * (0.35 * 0.35 - 0.0625 + 0.0144 + 0.01), 1e-10);
  EXPECT_FALSE(isKept(patch, nested, {0.01, 0.99}));
  EXPECT_TRUE(isKept(patch, nested, {0.6, 0.6}));
  EXPECT_TRUE(isKept(patch, nested, {0.6, 0.3}));
  EXPECT_FALSE(isKept(patch, nested, {0.6, 0.4}));
  EXPECT_TRUE(isKept(patch, nested, {0.85, 0.6}));  // on the loop
  expectPositiveInside(patch, holes(nested.loops, 3));
}

TEST(Trim, ExactForPolygonsAlongGridLinesAndThroughVertices) {
  const NurbsPatch patch = unitPatch(2, 4);
  // Edges on grid lines, on the patch's border, diagonals through vertices; two strips in one cell.
  const std::vector<std::vector<Vec2>> shapes = {
      {{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.5}, {0.25, 0.5}},
      {{0, 0}, {0.5, 0}, {0.5, 1}, {0, 1}},
      {{0.5, 0}, {1, 0.5}, {0.5, 1}, {0, 0.5}},
      {{0.3, 0.3}, {0.45, 0.3}, {0.45, 0.35}, {0.3, 0.35}},
      {{0.3, 0.3}, {0.45, 0.34}, {0.32, 0.34}},
      {{0.01, 0.02}, {0.99, 0.015}, {0.5, 0.03}},
      {{0.25, 0.1}, {0.25 + 1e-12, 0.8}, {0.1, 0.6}}};  // an edge within 1e-12 of a grid line
  for (const auto& shape : shapes) {
    double area = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Vec2 a = shape[k], b = shape[(k + 1) % shape.size()];
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    const Trim kept = holes({polygon(shape)}, 2),
               hole = holes({polygon(std::vector<Vec2>(shape.rbegin(), shape.rend()))}, 2);
    EXPECT_NEAR(keptArea(patch, kept), area, 1e-10);
    EXPECT_NEAR(keptArea(patch, hole), 1 - area, 1e-10);
    expectPositiveInside(patch, kept);
  }
}

TEST(Trim, MirroredLoopsGiveMirroredRules) {
  const NurbsPatch patch = unitPatch(2, 6);
  const std::vector<Vec2> blob{{0.55, 0.2}, {0.8, 0.35}, {0.7, 0.8}, {0.4, 0.7}, {0.45, 0.4}};
  const std::vector<TrimLoop> loops{{reversed(closedSpline(blob))}, {circle({0.2, 0.3}, 0.11, 0.17, true)}};
  std::vector<TrimLoop> mirrored, swapped;
  for (const TrimLoop& l : loops) mirrored.push_back(mirroredU(l)), swapped.push_back(swappedUV(l));
  const auto sorted = [](std::vector<CellPoint> p) {
    std::sort(p.begin(), p.end(), [](const CellPoint& a, const CellPoint& b) {
      return std::abs(a.u - b.u) > 1e-9 ? a.u < b.u : a.v < b.v;
    });
    return p;
  };
  const auto plain = sorted(allPoints(patch, holes(loops)));
  auto other = allPoints(patch, holes(mirrored));
  for (CellPoint& p : other) p.u = 1 - p.u;
  other = sorted(other);
  ASSERT_EQ(plain.size(), other.size());
  for (std::size_t k = 0; k < plain.size(); ++k) {
    EXPECT_NEAR(plain[k].u, other[k].u, 1e-13);
    EXPECT_NEAR(plain[k].v, other[k].v, 1e-13);
    EXPECT_NEAR(plain[k].weight, other[k].weight, 1e-14);
  }
  // Across the diagonal the pieces of a cell may differ where both directions give as many; what they integrate does
  // not, up to the quadrature.
  EXPECT_NEAR(keptArea(patch, holes(swapped, 12)), keptArea(patch, holes(loops, 12)), 1e-11);
}

TEST(Trim, FewPointsPerCutCell) {
  // Quadratic: 9 points on a whole cell. Along circles that span several cells a cut cell takes two pieces or three.
  long points = 0, cells = 0;
  for (int k = 0; k < 10; ++k) {
    const Trim trim = holes({{circle({0.46 + 0.01 * k, 0.53 - 0.007 * k}, 0.31, 0.31, true)}});
    for (const TrimmedCell& c : trimCells(unitPatch(2, 16), trim)) {
      cells += c.kind == CellKind::cut;
      points += static_cast<long>(c.points.size());
    }
  }
  EXPECT_LT(static_cast<double>(points) / cells, 18.0);
}

TEST(Trim, IntersectionsWithTheKnotMesh) {
  // A circle of radius 1/4 + e about a vertex of a grid of 1/4 meets the two lines through the center and the four
  // tangent ones twice each; one through vertices meets them there, once.
  const NurbsPatch patch = unitPatch(2, 4);
  const auto wide = trimIntersections(patch, holes({{circle({0.5, 0.5}, 0.26, 0.26, true)}}));
  EXPECT_EQ(wide.size(), 12u);
  for (Vec2 p : wide) EXPECT_NEAR(std::hypot(p.x - 0.5, p.y - 0.5), 0.26, 1e-14);
  EXPECT_EQ(trimIntersections(patch, holes({{circle({0.5, 0.5}, 0.25, 0.25, true)}})).size(), 4u);
  const auto corners =
      trimIntersections(patch, holes({polygon(std::vector<Vec2>{{0.5, 0.25}, {0.25, 0.5}, {0.75, 0.5}})}));
  EXPECT_EQ(corners.size(), 4u);  // three corners, and (0.5, 0.5) on the long edge
}

void expectRefused(const Trim& trim, const std::string& key, const std::string& word) {
  try {
    trimCells(unitPatch(2, 4), trim);
    ADD_FAILURE() << key << " " << word;
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key) << e.what();
    EXPECT_NE(e.reason().find(word), std::string::npos) << e.what();
  }
}

TEST(Trim, RefusesBadLoops) {
  const TrimLoop hole{circle({0.5, 0.5}, 0.2, 0.2, true)};
  expectRefused(holes({hole, {line({0.1, 0.1}, {0.2, 0.1}), line({0.2, 0.1}, {0.1, 0.2})}}), "loops[1].curves[1]",
                "closed");
  expectRefused(holes({hole, {}}), "loops[1]", "no curve");
  expectRefused(holes({{circle({0.9, 0.5}, 0.2, 0.2, true)}}), "loops[0].curves[0]", "leaves the patch");
  // What to do is said, and can be done: a notch that runs along the border.
  expectRefused(holes({{circle({0.9, 0.5}, 0.2, 0.2, true)}}), "loops[0].curves[0]", "along the border");
  EXPECT_NO_THROW(
      trimCells(unitPatch(2, 4), holes({polygon(std::vector<Vec2>{{1, 0.3}, {0.8, 0.3}, {0.8, 0.7}, {1, 0.7}})})));
  expectRefused(holes({polygon(std::vector<Vec2>{{0.1, 0.1}, {0.5, 0.6}, {0.5, 0.1}, {0.1, 0.5}})}),
                "loops[0].curves[2]", "itself");
  // A figure of eight in one curve, and one that touches itself at a corner.
  expectRefused(holes({{closedSpline(std::vector<Vec2>{{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.1}, {0.2, 0.8}})}}),
                "loops[0].curves[0]", "itself");
  expectRefused(
      holes({polygon(std::vector<Vec2>{{0.2, 0.2}, {0.8, 0.2}, {0.5, 0.5}, {0.8, 0.8}, {0.2, 0.8}, {0.5, 0.5}})}),
      "loops[0].curves[4]", "itself");
  expectRefused(holes({hole, {circle({0.7, 0.5}, 0.1, 0.1, true)}}), "loops[1].curves[0]", "loops[0].curves[0]");
  expectRefused(holes({hole, {circle({0.8, 0.5}, 0.1, 0.1, true)}}), "loops[1].curves[0]", "touch");  // from outside
  expectRefused(holes({hole, hole}), "loops[1].curves[0]", "loops[0].curves[0]");
  expectRefused(holes({hole, {circle({0.5, 0.5}, 0.1, 0.1, true)}}), "loops[1]", "nothing is kept");
  expectRefused(holes({{circle({0.5, 0.5}, 0.3, 0.3, false)}, {circle({0.5, 0.5}, 0.1, 0.1, false)}}), "loops[1]",
                "kept already");
  expectRefused(holes({{line({0.2, 0.2}, {0.7, 0.4}), line({0.7, 0.4}, {0.2, 0.2})}}), "loops[0]", "no area");
  expectRefused(holes({{line({0.2, 0.2}, {0.2, 0.2})}}), "loops[0].curves[0]", "no length");
  expectRefused(holes({polygon(std::vector<Vec2>{{0, 1}, {1, 1}, {1, 0}, {0, 0}})}), "loops", "nothing");
  NurbsCurve bad = circle({0.5, 0.5}, 0.2, 0.2, true);
  bad.weights[3] = -1;
  expectRefused(holes({{bad}}), "loops[0].curves[0].weights[3]", "positive");
  bad = circle({0.5, 0.5}, 0.2, 0.2, true);
  bad.points[2].x = std::nan("");
  expectRefused(holes({{bad}}), "loops[0].curves[0].points[2]", "finite");
  bad = circle({0.5, 0.5}, 0.2, 0.2, true);
  bad.points.pop_back();
  expectRefused(holes({{bad}}), "loops[0].curves[0].points", "expected");
  bad = circle({0.5, 0.5}, 0.2, 0.2, true);
  std::swap(bad.knots.knots[4], bad.knots.knots[6]);
  expectRefused(holes({{bad}}), "loops[0].curves[0].knots[6]", "descend");
  Trim trim = holes({hole});
  trim.points_per_piece = -1;
  expectRefused(trim, "points_per_piece", "0 to 64");
  trim.points_per_piece = 0;
  trim.unused_fraction = std::nan("");
  expectRefused(trim, "unused_fraction", "[0, 1)");
}

}  // namespace
}  // namespace gambeson
