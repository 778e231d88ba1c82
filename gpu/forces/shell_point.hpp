#pragma once
/// A Gauss point of the Kirchhoff-Love shell (Zheng 2013, eq. 2.6 to 2.22), as core/cloth/shell/shell.kernel.cpp has
/// it, in the fewest operations.

#include "gpu/forces/plain_law.hpp"
#include "gpu/forces/point4.hpp"

namespace gambeson::gpu {

/// What is constant at a Gauss point: G = d(xi)/dX of the rest shape, columns for weft and warp, and the area.
struct RestPoint {
  double G11, G12, G21, G22, dA;
};

/// Derivatives of the surface in its parameters, or the forces conjugate to them times the point's area.
struct SurfaceTerms {
  Vec3 of1, of2, of11, of22, of12;
};

/// Takes (11, 22, 12) of a symmetric tensor in the parameters to (11, 22, 2 x 12) along weft and warp, and resultants
/// back by its transpose.
struct FrameRows {
  double t[3][3];
  GAMBESON_HD explicit FrameRows(const RestPoint& g)
      : t{{g.G11 * g.G11, g.G21 * g.G21, 2.0 * g.G11 * g.G21},
          {g.G12 * g.G12, g.G22 * g.G22, 2.0 * g.G12 * g.G22},
          {2.0 * g.G11 * g.G12, 2.0 * g.G21 * g.G22, 2.0 * ::fma(g.G11, g.G22, g.G21 * g.G12)}} {}
  GAMBESON_HD Voigt3 toFrame(double a, double b, double c) const {
    const auto row = [&](int i) { return ::fma(t[i][2], c, ::fma(t[i][1], b, t[i][0] * a)); };
    return {row(0), row(1), row(2)};
  }
  GAMBESON_HD Voigt3 back(const Voigt3& r) const {
    const auto column = [&](int i) { return ::fma(t[2][i], r.c, ::fma(t[1][i], r.b, t[0][i] * r.a)); };
    return {column(0), column(1), column(2)};
  }
};

/// With n the unit normal, b_ab = n . x,ab and a^g the dual base, d(kappa_ab) = n . d(x,ab) - (x,ab . a^g) n . d(a_g).
/// `law(strain, curvature, tension, moment)`.
template <class Law>
GAMBESON_HD SurfaceTerms shellForces(const SurfaceTerms& x, const RestPoint& rest, const Law& law) {
  const FrameRows rows(rest);
  const double C11 = fusedDot(x.of1, x.of1), C22 = fusedDot(x.of2, x.of2), C12 = fusedDot(x.of1, x.of2);
  const Voigt3 C = rows.toFrame(C11, C22, C12);
  const Vec3 normal_j = fusedCross(x.of1, x.of2);
  const double inv_j = inverseRoot(fusedDot(normal_j, normal_j));
  const Vec3 n = inv_j * normal_j;
  const Voigt3 k = rows.toFrame(fusedDot(n, x.of11), fusedDot(n, x.of22), fusedDot(n, x.of12));
  Voigt3 tension, moment;
  law(Voigt3{0.5 * (C.a - 1.0), 0.5 * (C.b - 1.0), 0.5 * C.c}, k, tension, moment);
  const double dA = rest.dA;
  const Voigt3 N = rows.back({dA * tension.a, dA * tension.b, dA * tension.c});
  const Voigt3 M = rows.back({dA * moment.a, dA * moment.b, dA * moment.c});  // its third is 2 M12
  const Vec3 b = fma(M.c, x.of12, fma(M.b, x.of22, M.a * x.of11));
  const double b1 = fusedDot(b, x.of1), b2 = fusedDot(b, x.of2), inv_det = inv_j * inv_j;
  const double h1 = ::fma(C22, b1, -(C12 * b2)) * inv_det, h2 = ::fma(C11, b2, -(C12 * b1)) * inv_det;
  const double N12 = 0.5 * N.c;
  return {fma(-h1, n, fma(N12, x.of2, N.a * x.of1)), fma(-h2, n, fma(N.b, x.of2, N12 * x.of1)), M.a * n, M.b * n,
          M.c * n};
}

/// The denominator of a rational surface and its derivatives.
struct Denominator {
  double inverse, w1, w2, w11, w22, w12;
};

/// The quotient rule: derivatives of the numerator become those of x.
GAMBESON_HD inline SurfaceTerms divided(const Denominator& d, const Vec3& numerator, const SurfaceTerms& y) {
  SurfaceTerms x;
  const Vec3 x0 = d.inverse * numerator;
  x.of1 = d.inverse * fma(-d.w1, x0, y.of1);
  x.of2 = d.inverse * fma(-d.w2, x0, y.of2);
  x.of11 = d.inverse * fma(-d.w11, x0, fma(-2.0 * d.w1, x.of1, y.of11));
  x.of22 = d.inverse * fma(-d.w22, x0, fma(-2.0 * d.w2, x.of2, y.of22));
  x.of12 = d.inverse * fma(-d.w12, x0, fma(-d.w2, x.of1, fma(-d.w1, x.of2, y.of12)));
  return x;
}

/// Its transpose: forces on derivatives of x become those on derivatives of the numerator, `g0` on the numerator.
GAMBESON_HD inline SurfaceTerms dividedBack(const Denominator& d, const SurfaceTerms& f, Vec3& g0) {
  SurfaceTerms g;
  g.of11 = d.inverse * f.of11;
  g.of22 = d.inverse * f.of22;
  g.of12 = d.inverse * f.of12;
  g.of1 = d.inverse * fma(-d.w2, g.of12, fma(-2.0 * d.w1, g.of11, f.of1));
  g.of2 = d.inverse * fma(-d.w1, g.of12, fma(-2.0 * d.w2, g.of22, f.of2));
  const Vec3 sum = fma(d.w2, g.of2, fma(d.w1, g.of1, fma(d.w12, g.of12, fma(d.w22, g.of22, d.w11 * g.of11))));
  g0 = (-d.inverse) * sum;
  return g;
}

}  // namespace gambeson::gpu
