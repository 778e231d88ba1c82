#include "core/cloth/triangles/hinge_angle.hpp"

#include <cmath>

namespace gambeson {
namespace {

using Matrix = std::array<double, 9>;  ///< row by row

void addOuter(Matrix& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[static_cast<std::size_t>(3 * i + j)] += scale * a[i] * b[j];
}

/// One triangle about the edge e from corner 0 to corner 1: N = e x a, a from corner 0 to its third corner (of the
/// other triangle with the sign that makes both normals point to one side). Turning about the edge by d(phi) moves the
/// third corner along n = N/|N| by its height h: d(phi) = n . (da - (a . e) de/|e|^2)/h, so that with g = n/h and c = a
/// . e/|e|^2
///   d(phi) = g . (da - c de).
/// g = |e| N/|N|^2.
struct Side {
  Vec3 g;
  double c = 0;
  Matrix g_a{}, g_e{};  ///< dg/da, dg/de
  Vec3 c_a, c_e;        ///< dc/da, dc/de

  Side(const Vec3& e, const Vec3& a, bool second) {
    const double length2 = norm2(e), length = std::sqrt(length2);
    const Vec3 N = cross(e, a);
    const double size2 = norm2(N);
    g = (length / size2) * N;
    c = dot(a, e) / length2;
    if (!second) return;
    // dN = de x a + e x da = -[a]x de + [e]x da; dg = |e|/|N|^2 (I - 2 n nT) dN + g (e . de)/|e|^2.
    const double s = length / size2;
    const auto project = [&](const Vec3& v) { return s * (v - (2 * dot(N, v) / size2) * N); };
    for (int k = 0; k < 3; ++k) {
      Vec3 unit{};
      unit[k] = 1;
      const Vec3 of_a = project(cross(e, unit)), of_e = project(cross(unit, a)) + (e[k] / length2) * g;
      for (int i = 0; i < 3; ++i) {
        g_a[static_cast<std::size_t>(3 * i + k)] = of_a[i];
        g_e[static_cast<std::size_t>(3 * i + k)] = of_e[i];
      }
    }
    c_a = e / length2;
    c_e = (a - 2 * c * e) / length2;
  }
};

}  // namespace

double foldAngle(const HingePoints& x, HingePoints* gradient) {
  const Vec3 e = x[1] - x[0], a = x[2] - x[0], b = x[3] - x[0];
  const Vec3 na = cross(e, a), nb = cross(b, e);
  const double length = norm(e);
  const double theta = std::atan2(dot(cross(nb, na), e), length * dot(na, nb));
  if (gradient) {
    // The corners rise with the turn of either triangle about the edge.
    const Side sa(e, a, false), sb(e, b, false);
    const Vec3 ga = sa.g, gb = -sb.g;
    (*gradient)[2] = ga;
    (*gradient)[3] = gb;
    (*gradient)[1] = -(sa.c * ga + sb.c * gb);
    (*gradient)[0] = -(ga + gb + (*gradient)[1]);
  }
  return theta;
}

void foldAngleHessian(const HingePoints& x, std::array<std::array<double, 9>, 16>& blocks) {
  const Vec3 e = x[1] - x[0];
  // In e, a and b: d(theta) = ga . da + gb . db - (ca ga + cb gb) . de; blocks of (e, a, b).
  std::array<std::array<Matrix, 3>, 3> h{};
  const auto add = [&](const Vec3& a, std::size_t at, double sign) {
    const Side s(e, a, true);
    for (std::size_t k = 0; k < 9; ++k) {
      h[at][at][k] += sign * s.g_a[k];
      h[at][0][k] += sign * s.g_e[k];
    }
    // - d(c g)/de and - d(c g)/da.
    for (std::size_t k = 0; k < 9; ++k) {
      h[0][0][k] -= sign * s.c * s.g_e[k];
      h[0][at][k] -= sign * s.c * s.g_a[k];
    }
    addOuter(h[0][0], -sign, s.g, s.c_e);
    addOuter(h[0][at], -sign, s.g, s.c_a);
  };
  add(x[2] - x[0], 1, 1);
  add(x[3] - x[0], 2, -1);
  // Corners: e = x1 - x0, a = x2 - x0, b = x3 - x0.
  constexpr double part[4][3] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (std::size_t I = 0; I < 4; ++I)
    for (std::size_t J = 0; J < 4; ++J) {
      Matrix& m = blocks[4 * I + J];
      m.fill(0);
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t c = 0; c < 3; ++c)
          if (part[I][r] * part[J][c] != 0)
            for (std::size_t k = 0; k < 9; ++k) m[k] += part[I][r] * part[J][c] * h[r][c][k];
    }
}

}  // namespace gambeson
