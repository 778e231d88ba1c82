#include "core/cloth/draft/hinge.hpp"

namespace gambeson {
namespace {

using Matrix = std::array<double, 9>;  ///< row by row

void addOuter(Matrix& m, double scale, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m[3 * i + j] += scale * a[i] * b[j];
}

/// Adds scale [a]x, [a]x b = a x b.
void addSkew(Matrix& m, double scale, const Vec3& a) {
  m[1] -= scale * a.z, m[2] += scale * a.y;
  m[3] += scale * a.z, m[5] -= scale * a.x;
  m[6] -= scale * a.y, m[7] += scale * a.x;
}

/// The turn of a vector v about e = t/|t|: its gradient is n = e x v/s in v and - c n in t, with s = |v_perp|^2 and
/// c = v . t/|t|^2 (see hingeAngle). Second derivatives, with P = I - e eᵀ:
///   dn/dv = ([e]x - 2 n v_perpᵀ)/s,     dn/dt = (- [v]x P + 2 (v . e) n v_perpᵀ)/(s |t|),
///   d(c n)/dt = n (v - 2 (v . e) e)ᵀ/|t|^2 + c dn/dt.
struct Turn {
  Vec3 n;
  double c;
  Matrix vv{}, vt{}, tt{};  ///< dn/dv, dn/dt, - d(c n)/dt
  Turn(const Vec3& t, const Vec3& v) {
    const double length = norm(t);
    const Vec3 e = t / length;
    const double along = dot(v, e);
    const Vec3 perp = v - along * e;
    const double s = norm2(perp);
    n = cross(e, v) / s;
    c = along / length;
    addSkew(vv, 1 / s, e);
    addOuter(vv, -2 / s, n, perp);
    addSkew(vt, -1 / (s * length), v);  // [v]x P = [v]x - (v x e) eᵀ
    addOuter(vt, 1 / (s * length), cross(v, e), e);
    addOuter(vt, 2 * along / (s * length), n, perp);
    addOuter(tt, -1 / (length * length), n, v - 2 * along * e);
    for (int k = 0; k < 9; ++k) tt[k] -= c * vt[k];
  }
};

}  // namespace

void hingeStiffness(const HingePoint& h, std::span<const Vec3> q, std::vector<std::array<double, 9>>& blocks,
                    bool definite) {
  const std::size_t n = h.columns.size();
  Vec3 t{}, a{}, b{};
  for (std::size_t k = 0; k < n; ++k) {
    const Vec3& x = q[h.columns[k]];
    t += h.t[k] * x;
    a += h.a[k] * x;
    b += h.b[k] * x;
  }
  // theta is the turn of b less that of -a, whose n and c n are those of a with the sign that hingeAngle gives them.
  const Turn ta(t, a), tb(t, b);
  std::vector<Vec3> gradient;
  const double angle = hingeAngle(h, q, &gradient) - h.theta0, moment = definite ? 0 : h.stiffness_length * angle;
  blocks.assign(n * n, Matrix{});
  for (std::size_t I = 0; I < n; ++I)
    for (std::size_t J = I; J < n; ++J) {
      Matrix m{};
      addOuter(m, h.stiffness_length, gradient[I], gradient[J]);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int k = 3 * i + j, mirror = 3 * j + i;
          m[k] += moment * (h.b[I] * h.b[J] * tb.vv[k] - h.a[I] * h.a[J] * ta.vv[k] + h.b[I] * h.t[J] * tb.vt[k] +
                            h.t[I] * h.b[J] * tb.vt[mirror] - h.a[I] * h.t[J] * ta.vt[k] -
                            h.t[I] * h.a[J] * ta.vt[mirror] + h.t[I] * h.t[J] * (tb.tt[k] - ta.tt[k]));
        }
      blocks[I * n + J] = m;
      if (J == I) continue;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) blocks[J * n + I][3 * j + i] = m[3 * i + j];
    }
}

}  // namespace gambeson
