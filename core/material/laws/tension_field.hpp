#pragma once
/// Membranes that carry no compression: the relaxed energy of a tension field.

#include "core/material/laws/law.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// What a membrane without compression answers: energy per area [N/m], resultants n (11, 22, 12) [N/m], slope [N/m].
template <class S>
struct TensionFieldOf {
  enum State { slack, uniaxial, taut };
  State state = slack;
  S energy{};
  S n[3]{};
  S slope[6]{};  ///< dn/de in the order of Voigt
};
using TensionField = TensionFieldOf<double>;

/// Relaxation of W = e . A e / 2, e = (E11, E22, 2 E12), A positive definite, to the states that a wrinkled sheet can
/// reach (Pipkin, IMA J. Appl. Math. 36, 1986; Reissner's tension field):
///   W_r(E) = max over S positive semidefinite of S : E - S : C : S / 2,   C = A^-1.
/// taut: A e is positive semidefinite, W_r = W; slack: no direction stretches, W_r = 0; else the maximum is a uniaxial
/// tension S = s t t, t = (cos theta, sin theta), and
///   W_r = max over theta of (t . E t)^2 / (2 c(theta)), t . E t > 0, c(theta) = tt : C : tt.
/// The largest of 16 directions and the principal one starts a Newton iteration on theta that only climbs; for an
/// isotropic A the principal direction is the answer. Convex, C1, no residual stiffness: the slope is only
/// semidefinite. A in N/m. For one point at a time, not for lanes: it searches.
template <class S>
GAMBESON_HD inline TensionFieldOf<S> tensionField(const S* A, const S* e) {
  using std::atan2, std::cos, std::fabs, std::sin, std::sqrt;
  using Wrinkled = TensionFieldOf<S>;
  Wrinkled out;
  const S linear[3] = {A[0] * e[0] + A[3] * e[1] + A[4] * e[2], A[3] * e[0] + A[1] * e[1] + A[5] * e[2],
                       A[4] * e[0] + A[5] * e[1] + A[2] * e[2]};
  const bool at_rest = fabs(e[0]) < 1e-12 && fabs(e[1]) < 1e-12 && fabs(e[2]) < 1e-12;
  if (at_rest || (linear[0] + linear[1] >= 0 && linear[0] * linear[1] >= linear[2] * linear[2])) {
    out.state = Wrinkled::taut;
    for (int i = 0; i < 3; ++i) out.n[i] = linear[i];
    for (int i = 0; i < 6; ++i) out.slope[i] = A[i];
    out.energy = 0.5 * (linear[0] * e[0] + linear[1] * e[1] + linear[2] * e[2]);
    return out;
  }
  const S mean = 0.5 * (e[0] + e[1]), half = 0.5 * (e[0] - e[1]), shear = 0.5 * e[2];
  if (!(mean + sqrt(half * half + shear * shear) > 0)) return out;

  // C = A^-1 and the coefficients of c(theta) in powers of cos and sin: S = tt has S12 = cos sin once in Voigt order.
  const S m0 = A[1] * A[2] - A[5] * A[5], m1 = A[0] * A[2] - A[4] * A[4], m2 = A[0] * A[1] - A[3] * A[3];
  const S m3 = A[4] * A[5] - A[3] * A[2], m4 = A[3] * A[5] - A[1] * A[4], m5 = A[3] * A[4] - A[0] * A[5];
  const S det = A[0] * m0 + A[3] * m3 + A[4] * m4;
  const S C[6] = {m0 / det, m1 / det, m2 / det, m3 / det, m4 / det, m5 / det};
  struct At {
    S v[3], dv[3], strain, d_strain, dd_strain, c, dc, ddc, f;
  };
  const auto at = [&](S theta) {
    At p;
    const S cs = cos(theta), sn = sin(theta), c2 = cs * cs - sn * sn, s2 = 2 * cs * sn;
    const S v[3] = {cs * cs, sn * sn, cs * sn}, dv[3] = {-s2, s2, c2}, ddv[3] = {-2 * c2, 2 * c2, -2 * s2};
    const S w[3] = {C[0] * v[0] + C[3] * v[1] + C[4] * v[2], C[3] * v[0] + C[1] * v[1] + C[5] * v[2],
                    C[4] * v[0] + C[5] * v[1] + C[2] * v[2]};
    const S dw[3] = {C[0] * dv[0] + C[3] * dv[1] + C[4] * dv[2], C[3] * dv[0] + C[1] * dv[1] + C[5] * dv[2],
                     C[4] * dv[0] + C[5] * dv[1] + C[2] * dv[2]};
    p.strain = p.d_strain = p.dd_strain = p.c = p.dc = p.ddc = S{};
    for (int i = 0; i < 3; ++i) {
      p.v[i] = v[i];
      p.dv[i] = dv[i];
      p.strain += v[i] * e[i];
      p.d_strain += dv[i] * e[i];
      p.dd_strain += ddv[i] * e[i];
      p.c += v[i] * w[i];
      p.dc += 2 * dv[i] * w[i];
      p.ddc += 2 * (ddv[i] * w[i] + dv[i] * dw[i]);
    }
    p.f = p.strain > 0 ? 0.5 * p.strain * p.strain / p.c : S{};
    return p;
  };
  // Climbs f = strain^2/(2 c). At the maximum strain' = strain c'/(2 c).
  const auto d1 = [](const At& p) {
    return p.strain * p.d_strain / p.c - 0.5 * p.strain * p.strain * p.dc / (p.c * p.c);
  };
  const auto d2 = [](const At& p) {
    const S c2 = p.c * p.c;
    return (p.d_strain * p.d_strain + p.strain * p.dd_strain) / p.c - 2 * p.strain * p.d_strain * p.dc / c2 +
           p.strain * p.strain * (p.dc * p.dc / (c2 * p.c) - 0.5 * p.ddc / c2);
  };
  S theta = 0.5 * atan2(shear, half);
  At best = at(theta);
  constexpr double kStep = 3.14159265358979323846 / 16;
  for (int k = 0; k < 16; ++k) {
    const At p = at(S(k * kStep));
    if (p.f > best.f) best = p, theta = S(k * kStep);
  }
  for (int i = 0; i < 60; ++i) {
    const S slope = d1(best), curve = d2(best);
    S step = curve < 0 ? S(-slope / curve) : S(slope > 0 ? kStep : -kStep);
    step = step > kStep ? S(kStep) : step < -kStep ? S(-kStep) : step;
    if (fabs(step) < 1e-15) break;
    At next = at(theta + step);
    // Near the top f is flat to rounding: there the slope, which still falls, decides.
    int halvings = 0;
    while (next.f < best.f && !(fabs(d1(next)) < fabs(slope) && next.strain > 0 && fabs(step) < 1e-6) &&
           halvings < 40) {
      step *= 0.5;
      next = at(theta + step);
      ++halvings;
    }
    if (halvings == 40) break;
    theta += step;
    best = next;
    if (fabs(step) < 1e-13) break;
  }
  out.state = Wrinkled::uniaxial;
  const S s = best.strain / best.c;
  out.energy = best.f;
  S mixed[3];
  for (int i = 0; i < 3; ++i) {
    out.n[i] = s * best.v[i];
    mixed[i] = (best.d_strain / best.c - best.strain * best.dc / (best.c * best.c)) * best.v[i] + s * best.dv[i];
  }
  // W_r'' = f_ee - f_e,theta f_theta,e / f_theta,theta.
  const S curve = d2(best), turn = curve < 0 ? S(-1 / curve) : S{};
  const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  for (int i = 0; i < 6; ++i)
    out.slope[i] = best.v[row[i]] * best.v[column[i]] / best.c + turn * mixed[row[i]] * mixed[column[i]];
  return out;
}

/// The same for each of `lanes` points whose `on` is not 0: overwrites n, the energy per area and, where not null, the
/// slope. Arrays run [component][lane]. Compiled once, for all instruction sets.
void tensionFieldLanes(int lanes, const double* A, const double* strain, const double* on, double* n, double* energy,
                       double* slope);

}  // namespace gambeson
