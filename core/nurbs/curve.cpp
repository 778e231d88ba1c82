#include "core/nurbs/curve.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

Vec3 mix(double s, const Vec3& a, const Vec3& b) { return (1 - s) * a + s * b; }

}  // namespace

void validate(const NurbsCurve& c) {
  const int p = c.knots.degree, n = static_cast<int>(c.knots.knots.size());
  if (p < 1 || p > 20) reject("degree", std::to_string(p) + ", must be 1 to 20");
  if (n < 2 * (p + 1))
    reject("knots", std::to_string(n) + " knots, at least 2 (degree + 1) are needed, degree " + std::to_string(p));
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(c.knots.knots[i])) reject("knots[" + std::to_string(i) + "]", "must be finite");
    if (i > 0 && !(c.knots.knots[i] >= c.knots.knots[i - 1]))
      reject("knots[" + std::to_string(i) + "]", "below the knot before it; knots must not descend");
  }
  if (!(c.knots.back() > c.knots.front())) reject("knots", "no non-empty cell");
  for (int i = 0; i + p < n; ++i) {
    const bool inner = c.knots.knots[i] > c.knots.front() && c.knots.knots[i] < c.knots.back();
    const int most = inner ? p : p + 1;
    if (i + most < n && c.knots.knots[i] == c.knots.knots[i + most])
      reject("knots[" + std::to_string(i) + "]",
             "multiplicity above " + std::to_string(most) + (inner ? " (the degree)" : " (degree + 1)"));
  }
  const auto expect = std::to_string(c.knots.count()) + " expected";
  if (static_cast<int>(c.points.size()) != c.knots.count())
    reject("points", std::to_string(c.points.size()) + " given, " + expect);
  if (static_cast<int>(c.weights.size()) != c.knots.count())
    reject("weights", std::to_string(c.weights.size()) + " given, " + expect);
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    if (!std::isfinite(c.points[i].x) || !std::isfinite(c.points[i].y))
      reject("points[" + std::to_string(i) + "]", "must be finite");
    if (!(c.weights[i] > 0) || !std::isfinite(c.weights[i]))
      reject("weights[" + std::to_string(i) + "]", "must be positive and finite");
  }
}

CurvePoint curvePoint(const NurbsCurve& c, double t) {
  const int p = c.knots.degree, span = findSpan(c.knots, t);
  std::vector<double> basis(2 * (p + 1));
  basisDerivatives(c.knots, span, t, 1, basis);
  Vec3 h{}, dh{};
  for (int i = 0; i <= p; ++i) {
    const int k = span - p + i;
    const Vec3 point = c.weights[k] * Vec3{c.points[k].x, c.points[k].y, 1};
    h += basis[i] * point;
    dh += basis[p + 1 + i] * point;
  }
  const Vec2 at{h.x / h.z, h.y / h.z};
  return {at, {(dh.x - dh.z * at.x) / h.z, (dh.y - dh.z * at.y) / h.z}};
}

NurbsCurve line(Vec2 from, Vec2 to) { return {{1, {0, 0, 1, 1}}, {from, to}, {1, 1}}; }

// Piegl and Tiller, section 7.5: nine points of the square about the circle, weights 1 and cos 45 degrees.
NurbsCurve circle(Vec2 center, double radius_u, double radius_v, bool clockwise) {
  static constexpr int x[9] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, y[9] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  NurbsCurve c{{2, {0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1}}, {}, {}};
  for (int k = 0; k < 9; ++k) {
    c.points.push_back({center.x + radius_u * x[k], center.y + (clockwise ? -radius_v : radius_v) * y[k]});
    c.weights.push_back(k % 2 == 0 ? 1 : std::sqrt(0.5));
  }
  return c;
}

std::vector<NurbsCurve> polygon(std::span<const Vec2> corners) {
  if (corners.size() < 3) reject("corners", std::to_string(corners.size()) + ", at least 3 are needed");
  std::vector<NurbsCurve> edges;
  for (std::size_t k = 0; k < corners.size(); ++k) edges.push_back(line(corners[k], corners[(k + 1) % corners.size()]));
  return edges;
}

// The periodic cubic with knots at the points, which exists and is unique (the system for its second derivatives is
// diagonally dominant); solved densely, a loop has few points.
NurbsCurve closedSpline(std::span<const Vec2> points) {
  const int n = static_cast<int>(points.size());
  if (n < 3) reject("points", std::to_string(n) + ", at least 3 are needed");
  std::vector<double> at{0};
  for (int k = 0; k < n; ++k) {
    const Vec2 a = points[k], b = points[(k + 1) % n];
    const double chord = std::hypot(b.x - a.x, b.y - a.y);
    if (!(chord > 0) || !std::isfinite(chord)) reject("points[" + std::to_string(k) + "]", "equals the next point");
    at.push_back(at.back() + chord);
  }
  NurbsCurve c{{3, {}}, {}, std::vector<double>(n + 3, 1.0)};
  const double length = at.back();
  for (int k = -3; k <= n + 3; ++k) {
    const int turn = k < 0 ? -1 : k / n;
    c.knots.knots.push_back(at[k - turn * n] + turn * length);
  }
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::MatrixXd rhs(n, 2);
  std::vector<double> basis(4);
  for (int k = 0; k < n; ++k) {
    basisDerivatives(c.knots, k + 3, at[k], 0, basis);
    for (int i = 0; i < 4; ++i) A(k, (k + i) % n) += basis[i];
    rhs(k, 0) = points[k].x;
    rhs(k, 1) = points[k].y;
  }
  const Eigen::MatrixXd x = A.partialPivLu().solve(rhs);
  for (int k = 0; k < n + 3; ++k) c.points.push_back({x(k % n, 0), x(k % n, 1)});
  return c;
}

NurbsCurve reversed(const NurbsCurve& curve) {
  NurbsCurve c = curve;
  std::reverse(c.points.begin(), c.points.end());
  std::reverse(c.weights.begin(), c.weights.end());
  std::reverse(c.knots.knots.begin(), c.knots.knots.end());
  const double ends = curve.knots.knots.front() + curve.knots.knots.back();
  for (double& k : c.knots.knots) k = ends - k;
  return c;
}

CurvePoint BezierSegment::at(double t) const {
  const int p = static_cast<int>(points.size()) - 1;
  Vec3 b[21];
  std::copy(points.begin(), points.end(), b);
  for (int r = 1; r < p; ++r)
    for (int i = 0; i <= p - r; ++i) b[i] = mix(t, b[i], b[i + 1]);
  const Vec3 h = mix(t, b[0], b[1]), dh = p * (b[1] - b[0]);
  const Vec2 point{h.x / h.z, h.y / h.z};
  return {point, {(dh.x - dh.z * point.x) / h.z, (dh.y - dh.z * point.y) / h.z}};
}

// Bezier point j of the knot cell [a, b] is the blossom at a (p - j times) and b (j times).
std::vector<BezierSegment> bezierSegments(const NurbsCurve& c) {
  const int p = c.knots.degree;
  const std::vector<double> ends = breakpoints(c.knots);
  const std::vector<double>& U = c.knots.knots;
  std::vector<BezierSegment> out;
  for (std::size_t cell = 0; cell + 1 < ends.size(); ++cell) {
    const int s = findSpan(c.knots, 0.5 * (ends[cell] + ends[cell + 1]));
    BezierSegment segment;
    for (int j = 0; j <= p; ++j) {
      std::vector<Vec3> d;
      for (int i = s - p; i <= s; ++i) d.push_back(c.weights[i] * Vec3{c.points[i].x, c.points[i].y, 1});
      for (int r = 1; r <= p; ++r) {
        const double at = r <= p - j ? ends[cell] : ends[cell + 1];
        for (int i = p; i >= r; --i) {
          const double low = U[s - p + i], high = U[s + 1 + i - r];
          d[i] = mix((at - low) / (high - low), d[i - 1], d[i]);
        }
      }
      segment.points.push_back(d[p]);
    }
    out.push_back(std::move(segment));
  }
  return out;
}

}  // namespace gambeson
