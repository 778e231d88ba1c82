#include "core/sheet/hinge_tangent.hpp"

#include <cmath>

namespace gambeson {
namespace {

/// By columns.
Mat3 outer(const Vec3& a, const Vec3& b) { return {b.x * a, b.y * a, b.z * a}; }
Mat3 crossMatrix(const Vec3& v) { return {cross(v, {1, 0, 0}), cross(v, {0, 1, 0}), cross(v, {0, 0, 1})}; }
Mat3 combine(double s, const Mat3& m, double t, const Mat3& n) {
  return {s * m.a + t * n.a, s * m.b + t * n.b, s * m.c + t * n.c};
}

/// One wing of the hinge. With A = t x a the angle of a about t grows by -(|t| A/|A|^2) . da + ((a.t)/|t| A/|A|^2) . dt
/// up to a turn of the frame that both wings share; these are the derivatives of the two factors. With
/// d(A/|A|^2) = P dA, P = (1 - 2 AA^T/|A|^2)/|A|^2, dA = dt x a + t x da.
struct Wing {
  Vec3 by_t, by_a;
  Mat3 tt, at, aa;  ///< at: rows a, columns t
};

Wing wingOf(const Vec3& t, const Vec3& a) {
  const double length = norm(t), at = dot(a, t);
  const Vec3 A = cross(t, a), A_over = A / norm2(A), e = t / length;
  const Mat3 P = combine(1 / norm2(A), Mat3{}, -2, outer(A_over, A_over));
  const Mat3 P_da = P * crossMatrix(t), P_dt = combine(-1, P * crossMatrix(a), 0, Mat3{});
  Wing w;
  w.by_a = -length * A_over;
  w.by_t = (at / length) * A_over;
  w.aa = combine(-length, P_da, 0, Mat3{});
  w.at = combine(-1, outer(A_over, e), -length, P_dt);
  w.tt = combine(1, outer(A_over, a / length - (at / (length * length)) * e), at / length, P_dt);
  return w;
}

}  // namespace

void hingeTangent(const HingePoint& h, std::span<const Vec3> q, double* pairs) {
  Vec3 t{}, a{}, b{};
  for (std::size_t k = 0; k < h.columns.size(); ++k) {
    const Vec3& x = q[h.columns[k]];
    t += h.t[k] * x;
    a += h.a[k] * x;
    b += h.b[k] * x;
  }
  const double couple = h.stiffness_length * (hingeAngle(h, q, nullptr) - h.theta0);
  // theta by (t, a, b): the wing of a less that of b.
  const Wing wa = wingOf(t, a), wb = wingOf(t, b);
  const Vec3 gradient[3] = {wa.by_t - wb.by_t, wa.by_a, -wb.by_a};
  const Mat3 zero = {{}, {}, {}};
  Mat3 second[3][3];
  second[0][0] = combine(1, wa.tt, -1, wb.tt);
  second[1][0] = wa.at;
  second[2][0] = combine(-1, wb.at, 0, zero);
  second[0][1] = transpose(second[1][0]);
  second[0][2] = transpose(second[2][0]);
  second[1][1] = wa.aa;
  second[2][2] = combine(-1, wb.aa, 0, zero);
  second[1][2] = second[2][1] = zero;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      second[i][j] = combine(h.stiffness_length, outer(gradient[i], gradient[j]), couple, second[i][j]);
  for (std::size_t I = 0; I < h.columns.size(); ++I)
    for (std::size_t J = I; J < h.columns.size(); ++J) {
      const double left[3] = {h.t[I], h.a[I], h.b[I]}, right[3] = {h.t[J], h.a[J], h.b[J]};
      Mat3 block = zero;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (left[i] != 0 && right[j] != 0) block = combine(1, block, left[i] * right[j], second[i][j]);
      for (int i = 0; i < 3; ++i) {
        *pairs++ = block.a[i];
        *pairs++ = block.b[i];
        *pairs++ = block.c[i];
      }
    }
}

}  // namespace gambeson
