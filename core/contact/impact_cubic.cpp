#include "core/contact/impact_cubic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/contact/triangle.hpp"

namespace gambeson {

namespace {

double lerp(double a, double b, double t) { return (1 - t) * a + t * b; }
Vec3 lerp(const Vec3& a, const Vec3& b, double t) { return (1 - t) * a + t * b; }

double cubic(const std::array<double, 4>& c, double t) {
  const double a = lerp(c[0], c[1], t), b = lerp(c[1], c[2], t), d = lerp(c[2], c[3], t);
  return lerp(lerp(a, b, t), lerp(b, d, t), t);
}

/// Where a monotone cubic on [l, r] passes `level`, by bisection (f(l) - level and f(r) - level differ in sign).
/// Returns the last bracket, so that the caller can round outward.
std::pair<double, double> passage(const std::array<double, 4>& c, double l, double r, double level) {
  const bool rising = cubic(c, l) < level;
  for (;;) {
    const double m = 0.5 * (l + r);
    if (!(m > l && m < r)) return {l, r};
    ((cubic(c, m) < level) == rising ? l : r) = m;
  }
}

double triple(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

/// Weights of the closest point of a triangle, and its distance.
MovingHit footOf(const std::array<Vec3, 3>& x, const Vec3& p, double time) {
  const TrianglePoint q = closestOnTriangle(x, p);
  MovingHit hit{time, {}, std::sqrt(q.dist2_m2)};
  if (q.feature < kEdge0) {
    hit.weights[q.feature] = 1;
  } else if (q.feature < kFace) {
    const int a = q.feature - kEdge0, b = (a + 1) % 3;
    const Vec3 e = x[b] - x[a];
    hit.weights[b] = std::clamp(dot(q.position - x[a], e) / norm2(e), 0.0, 1.0);
    hit.weights[a] = 1 - hit.weights[b];
  } else {
    const Vec3 n = cross(x[1] - x[0], x[2] - x[0]);
    hit.weights.y = dot(cross(x[0] - x[2], q.position - x[2]), n) / norm2(n);
    hit.weights.z = dot(cross(x[1] - x[0], q.position - x[0]), n) / norm2(n);
    hit.weights.x = 1 - hit.weights.y - hit.weights.z;
  }
  return hit;
}

}  // namespace

TimeWindows zerosOfCubic(const std::array<double, 4>& c, double zero) {
  TimeWindows out;
  const double lo = *std::min_element(c.begin(), c.end()), hi = *std::max_element(c.begin(), c.end());
  if (lo > zero || hi < -zero) return out;  // the curve stays in the hull of its coefficients
  // Ends of the monotone pieces: roots of the derivative, Bernstein (d0, d1, d2): A t^2 - 2 B t + C = 0.
  const double d0 = c[1] - c[0], d1 = c[2] - c[1], d2 = c[3] - c[2];
  const double A = d0 - 2 * d1 + d2, B = d0 - d1, C = d0;
  std::array<double, 4> ends{0, 1, 1, 1};
  int n = 1;
  const auto split = [&](double t) {
    if (t > 0 && t < 1) ends[n++] = t;
  };
  if (const double disc = B * B - A * C; disc > 0) {
    const double q = B + std::copysign(std::sqrt(disc), B);
    if (A != 0) split(q / A);
    if (q != 0) split(C / q);
  } else if (A != 0) {
    split(B / A);  // an inflection, or a pair of extrema lost to rounding
  }
  ends[n++] = 1;
  if (n == 4 && ends[1] > ends[2]) std::swap(ends[1], ends[2]);
  for (int i = 0; i + 1 < n; ++i) {
    const double l = ends[i], r = ends[i + 1], fl = cubic(c, l), fr = cubic(c, r);
    if (std::min(fl, fr) > zero || std::max(fl, fr) < -zero) continue;
    TimeWindows::Window w{l, r};
    if (std::abs(fl) > zero) w.begin = passage(c, l, r, fl > 0 ? zero : -zero).first;
    if (std::abs(fr) > zero) w.end = passage(c, l, r, fr > 0 ? zero : -zero).second;
    out.window[out.count++] = w;
  }
  return out;
}

std::optional<MovingHit> movingPointTriangle(const Vec3& p0, const Vec3& p1, const std::array<Vec3, 3>& corner0,
                                             const std::array<Vec3, 3>& corner1) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  // Relative to the first corner, eq. 3.22 is the triple product of three vectors that are linear in time.
  const Vec3 a0 = p0 - corner0[0], b0 = corner0[1] - corner0[0], c0 = corner0[2] - corner0[0];
  const Vec3 a1 = p1 - corner1[0], b1 = corner1[1] - corner1[0], c1 = corner1[2] - corner1[0];
  const std::array<double, 4> bernstein{
      triple(a0, b0, c0), (triple(a1, b0, c0) + triple(a0, b1, c0) + triple(a0, b0, c1)) / 3,
      (triple(a0, b1, c1) + triple(a1, b0, c1) + triple(a1, b1, c0)) / 3, triple(a1, b1, c1)};
  // Rounding: some 20 operations on products of the three lengths.
  const double a = std::sqrt(std::max(norm2(a0), norm2(a1))), b = std::sqrt(std::max(norm2(b0), norm2(b1))),
               c = std::sqrt(std::max(norm2(c0), norm2(c1)));
  const TimeWindows windows = zerosOfCubic(bernstein, 64 * eps * a * b * c);

  // |p - triangle| changes at most by the largest speed relative to a corner.
  double speed = 0, extent = 0;
  for (int k = 0; k < 3; ++k) {
    speed = std::max(speed, norm((p1 - p0) - (corner1[k] - corner0[k])));
    extent = std::max({extent, norm(corner0[k]), norm(corner1[k])});
  }
  const double tolerance = 1e-13 * std::max({extent, norm(p0), norm(p1)});
  struct Piece {
    double begin, end;
  };
  for (int i = 0; i < windows.count; ++i) {
    std::array<Piece, 128> stack;  // one more entry for each halving of [0, 1] down to speed * length < tolerance
    int top = 0;
    stack[top++] = {windows.window[i].begin, windows.window[i].end};
    while (top > 0) {
      const auto [begin, end] = stack[--top];
      const double t = 0.5 * (begin + end), half = 0.5 * (end - begin);
      std::array<Vec3, 3> x;
      for (int k = 0; k < 3; ++k) x[k] = lerp(corner0[k], corner1[k], t);
      const MovingHit hit = footOf(x, lerp(p0, p1, t), t);
      if (hit.gap_m > speed * half * (1 + 4 * eps) + tolerance) continue;
      if (speed * half <= tolerance) return hit;
      assert(top + 2 <= static_cast<int>(stack.size()));
      stack[top++] = {t, end};
      stack[top++] = {begin, t};
    }
  }
  return std::nullopt;
}

}  // namespace gambeson
