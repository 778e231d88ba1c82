#include "core/solid/facet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gambeson {
namespace {

constexpr double kSign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
constexpr int kIterations = 50;
constexpr double kRest = 1e-14;   ///< of a correction
constexpr double kLongest = 0.5;  ///< step of Newton

/// d²m/dxi1 dxi2.
Vec3 twist(const FacetCorners& x) { return 0.25 * (x[0] - x[1] + x[2] - x[3]); }

/// Newton's correction of xi for the least distance, downhill.
Vec2 correction(const FacetCorners& x, const Vec3& p, const Vec2& local) {
  const std::array<Vec3, 2> t = facetTangents(x, local);
  const Vec3 r = p - facetPosition(x, local);
  const double a = norm2(t[0]), c = norm2(t[1]), flat = dot(t[0], t[1]);
  const double g0 = dot(r, t[0]), g1 = dot(r, t[1]);
  double b = flat - dot(r, twist(x));
  if (!(a * c - b * b > 0)) b = flat;  // beyond the centre of curvature: without it
  const double det = a * c - b * b;
  return {(c * g0 - b * g1) / det, (a * g1 - b * g0) / det};
}

double largest(const Vec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); }

}  // namespace

std::array<double, 4> facetShape(const Vec2& local) {
  std::array<double, 4> N{};
  for (int k = 0; k < 4; ++k) N[k] = 0.25 * (1 + kSign[k][0] * local.x) * (1 + kSign[k][1] * local.y);
  return N;
}

Vec3 facetPosition(const FacetCorners& corners, const Vec2& local) {
  const std::array<double, 4> N = facetShape(local);
  return N[0] * corners[0] + N[1] * corners[1] + N[2] * corners[2] + N[3] * corners[3];
}

std::array<Vec3, 2> facetTangents(const FacetCorners& x, const Vec2& local) {
  return {0.25 * ((1 - local.y) * (x[1] - x[0]) + (1 + local.y) * (x[2] - x[3])),
          0.25 * ((1 - local.x) * (x[3] - x[0]) + (1 + local.x) * (x[2] - x[1]))};
}

Vec3 facetNormal(const FacetCorners& corners, const Vec2& local) {
  const std::array<Vec3, 2> t = facetTangents(corners, local);
  return normalized(cross(t[0], t[1]));
}

std::optional<Vec2> projectOnFacet(const FacetCorners& corners, const Vec3& p, double reach) {
  Vec2 local;
  for (int k = 0; k < kIterations; ++k) {
    Vec2 d = correction(corners, p, local);
    const double size = largest(d);
    if (!std::isfinite(size)) return std::nullopt;
    const double shorter = size > kLongest ? kLongest / size : 1;
    local.x += shorter * d.x, local.y += shorter * d.y;
    if (largest(local) > reach + kLongest) return std::nullopt;
    if (size < kRest * std::max(1.0, largest(local))) break;
    if (k + 1 == kIterations && size > 1e-10) return std::nullopt;
  }
  if (largest(local) > reach) return std::nullopt;
  return local;
}

FacetPoint closestOnFacet(const FacetCorners& x, const Vec3& p) {
  FacetPoint best;
  best.dist2_m2 = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    const Vec3 e = x[next] - x[k];
    const double along = dot(p - x[k], e), length2 = norm2(e);
    const double s = length2 > 0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    FacetPoint c;
    c.position = s == 1 ? x[next] : x[k] + s * e;
    c.dist2_m2 = norm2(p - c.position);
    c.feature = s == 0 ? kFacetCorner + k : s == 1 ? kFacetCorner + next : kFacetEdge + k;
    c.local = {(1 - s) * kSign[k][0] + s * kSign[next][0], (1 - s) * kSign[k][1] + s * kSign[next][1]};
    if (c.dist2_m2 < best.dist2_m2) best = c;
  }
  if (const std::optional<Vec2> local = projectOnFacet(x, p, 1.0)) {
    FacetPoint c{*local, facetPosition(x, *local), 0, kFacetFace};
    c.dist2_m2 = norm2(p - c.position);
    if (largest(c.local) < 1 && c.dist2_m2 < best.dist2_m2) best = c;
  }
  return best;
}

}  // namespace gambeson
