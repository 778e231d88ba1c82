/// Internal force of the Kirchhoff-Love shell (Zheng 2013, eq. 2.6 to 2.22), vectorised over cells. Compiled once per
/// instruction set with GAMBESON_ISA defined.
///
/// The tensor product is used twice: derivatives of the numerator sum_ij B_i B_j (w q)_ij are built direction by
/// direction, the quotient rule turns them into derivatives of x, and the transpose of both steps takes the stresses
/// back to the control points. With n the unit normal, b_ab = n . x,ab and a^g the dual base,
///   d(kappa_ab) = n . d(x,ab) - (x,ab . a^g) n . d(a_g),
/// which is eq. 2.20 in fewer terms.

#include "core/cloth/law_lanes.hpp"
#include "core/cloth/shell/shell_kernel.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {

void GAMBESON_CONCAT(shellTangent_, GAMBESON_ISA)(const ShellBlock&, const BlockLaw&, const double*, int, int, double*);
void GAMBESON_CONCAT(shellAssumed_, GAMBESON_ISA)(const ShellBlock&, const BlockLaw&, const double*, double*, double*);

namespace {

/// Resultants and their pull-back at one quadrature point: on return g1, g2, g11, g22, g12 hold the force conjugate to
/// x,u x,v x,uu x,vv x,uv (times the point's area).
template <bool kEnergy, class Law>
inline void shellPoint(Law& law, const LawsByPoint& laws, long point, const double* data, const double* rest_curvature,
                       V3 a1, V3 a2, V3 x11, V3 x22, V3 x12, V3& g1, V3& g2, V3& g11, V3& g22, V3& g12,
                       GroupEnergy& energy) {
  const V G11 = load(data), G12 = load(data + kLanes), G21 = load(data + 2 * kLanes), G22 = load(data + 3 * kLanes);
  const V dA = load(data + 4 * kLanes);
  const V C11 = dot(a1, a1), C22 = dot(a2, a2), C12 = dot(a1, a2);
  // Physical strain: E = (Gᵀ C G - I)/2 with G = d(xi)/dX, columns for weft and warp.
  const V c1a = C11 * G11 + C12 * G21, c1b = C12 * G11 + C22 * G21;
  const V c2a = C11 * G12 + C12 * G22, c2b = C12 * G12 + C22 * G22;
  const V E11 = 0.5 * (G11 * c1a + G21 * c1b - 1.0), E22 = 0.5 * (G12 * c2a + G22 * c2b - 1.0);
  const V E12x2 = G12 * c1a + G22 * c1b;
  const V3 normal_j = cross(a1, a2);
  const V j2 = dot(normal_j, normal_j);
  const V inv_j = 1.0 / squareRoot(j2);
  const V3 n = inv_j * normal_j;
  const V b11 = dot(n, x11), b22 = dot(n, x22), b12 = dot(n, x12);
  V k11 = G11 * (G11 * b11 + 2.0 * G21 * b12) + G21 * G21 * b22;
  V k22 = G12 * (G12 * b11 + 2.0 * G22 * b12) + G22 * G22 * b22;
  V k12 = G11 * G12 * b11 + (G11 * G22 + G21 * G12) * b12 + G21 * G22 * b22;
  if (rest_curvature) {
    k11 -= load(rest_curvature);
    k22 -= load(rest_curvature + kLanes);
    k12 -= load(rest_curvature + 2 * kLanes);
  }
  const V strain[3] = {E11, E22, E12x2}, change[3] = {k11, k22, 2.0 * k12};
  PointAnswer<V> answer;
  law.template evaluate<kEnergy ? with_energy : only_resultants>(laws, point, strain, change, answer);
  if constexpr (kEnergy) energy.add(dA, answer);
  const V *n_ab = answer.membrane.resultant, *m_ab = answer.bending.resultant;
  const V n11 = n_ab[0], n22 = n_ab[1], n12 = n_ab[2];
  const V m11 = m_ab[0], m22 = m_ab[1], m12 = m_ab[2];

  // Back to the parameters: N = G n Gᵀ, M = G m Gᵀ (symmetric).
  const V p1 = G11 * n11 + G12 * n12, p2 = G11 * n12 + G12 * n22;
  const V r1 = G21 * n11 + G22 * n12, r2 = G21 * n12 + G22 * n22;
  const V N11 = dA * (p1 * G11 + p2 * G12), N12 = dA * (p1 * G21 + p2 * G22), N22 = dA * (r1 * G21 + r2 * G22);
  const V s1 = G11 * m11 + G12 * m12, s2 = G11 * m12 + G12 * m22;
  const V t1 = G21 * m11 + G22 * m12, t2 = G21 * m12 + G22 * m22;
  const V M11 = dA * (s1 * G11 + s2 * G12), M12 = dA * (s1 * G21 + s2 * G22), M22 = dA * (t1 * G21 + t2 * G22);

  const V3 b = M11 * x11 + M22 * x22 + (2.0 * M12) * x12;
  const V ba1 = dot(b, a1), ba2 = dot(b, a2);
  const V inv_det = inv_j * inv_j;
  const V h1 = (C22 * ba1 - C12 * ba2) * inv_det, h2 = (C11 * ba2 - C12 * ba1) * inv_det;
  g1 = N11 * a1 + N12 * a2 - h1 * n;
  g2 = N12 * a1 + N22 * a2 - h2 * n;
  g11 = M11 * n;
  g22 = M22 * n;
  g12 = (2.0 * M12) * n;
}

constexpr int kMaxDegree = 5;

/// The cells of a group. kP, kQ: degrees known at compile time, or -1.
template <int kP, int kQ, bool kRational, bool kEnergy, class Law>
void groupForce(const ShellBlock& block, const BlockLaw& shell_law, int group, const double* q, double* cell_force,
                double* energy) {
  const int nu = kP < 0 ? block.p + 1 : kP + 1, nv = kQ < 0 ? block.q + 1 : kQ + 1, nn = nu * nv;
  constexpr int kNu = kP < 0 ? kMaxDegree + 1 : kP + 1, kNv = kQ < 0 ? kMaxDegree + 1 : kQ + 1;
  const int stride = block.pointDoubles() * kLanes;
  const LawsByPoint laws = block.lawsByPoint();
  V3 X[kNu * kNv], F[kNu * kNv];
  const int* nodes = block.nodes.data() + static_cast<long>(group) * nn * kLanes;
  const double* weights = kRational ? block.weights.data() + static_cast<long>(group) * nn * kLanes : nullptr;
  for (int k = 0; k < nn; ++k) {
    X[k] = gather(q, nodes + k * kLanes);
    if constexpr (kRational) X[k] = load(weights + k * kLanes) * X[k];
    F[k] = V3{};
  }
  GroupEnergy e;
  Law law{shell_law};
  if constexpr (std::is_same_v<Law, GeneralLaw>) constantLaw(shell_law, law.lanes);
  for (int gv = 0; gv < block.gv; ++gv) {
    const double* bv = block.basis_v.data() + (static_cast<long>(group) * block.gv + gv) * 3 * nv * kLanes;
    V3 Y0[kNu], Y1[kNu], Y2[kNu], Z0[kNu], Z1[kNu], Z2[kNu];
    for (int i = 0; i < nu; ++i) {
      V3 y0{}, y1{}, y2{};
      for (int j = 0; j < nv; ++j) {
        add(y0, load(bv + j * kLanes), X[i + nu * j]);
        add(y1, load(bv + (nv + j) * kLanes), X[i + nu * j]);
        add(y2, load(bv + (2 * nv + j) * kLanes), X[i + nu * j]);
      }
      Y0[i] = y0;
      Y1[i] = y1;
      Y2[i] = y2;
      Z0[i] = Z1[i] = Z2[i] = V3{};
    }
    for (int gu = 0; gu < block.gu; ++gu) {
      const double* bu = block.basis_u.data() + (static_cast<long>(group) * block.gu + gu) * 3 * nu * kLanes;
      const double* data = block.points.data() + ((static_cast<long>(group) * block.gv + gv) * block.gu + gu) * stride;
      const double* rest = block.rest_curvature ? data + (5 + (kRational ? 6 : 0)) * kLanes : nullptr;
      V3 x0{}, x1{}, x2{}, x11{}, x22{}, x12{};
      for (int i = 0; i < nu; ++i) {
        const V u0 = load(bu + i * kLanes), u1 = load(bu + (nu + i) * kLanes), u2 = load(bu + (2 * nu + i) * kLanes);
        if constexpr (kRational) add(x0, u0, Y0[i]);
        add(x1, u1, Y0[i]);
        add(x2, u0, Y1[i]);
        add(x11, u2, Y0[i]);
        add(x22, u0, Y2[i]);
        add(x12, u1, Y1[i]);
      }
      V w1{}, w2{}, w11{}, w22{}, w12{}, inv_w{};
      if constexpr (kRational) {
        const double* w = data + 5 * kLanes;
        inv_w = 1.0 / load(w);
        w1 = load(w + kLanes);
        w2 = load(w + 2 * kLanes);
        w11 = load(w + 3 * kLanes);
        w22 = load(w + 4 * kLanes);
        w12 = load(w + 5 * kLanes);
        x0 = inv_w * x0;
        x1 = inv_w * (x1 - w1 * x0);
        x2 = inv_w * (x2 - w2 * x0);
        x11 = inv_w * (x11 - (2.0 * w1) * x1 - w11 * x0);
        x22 = inv_w * (x22 - (2.0 * w2) * x2 - w22 * x0);
        x12 = inv_w * (x12 - w1 * x2 - w2 * x1 - w12 * x0);
      }
      V3 g0{}, g1, g2, g11, g22, g12;
      const long point = (group * long{block.gv} + gv) * block.gu + gu;
      shellPoint<kEnergy>(law, laws, point, data, rest, x1, x2, x11, x22, x12, g1, g2, g11, g22, g12, e);
      if constexpr (kRational) {
        g11 = inv_w * g11;
        g22 = inv_w * g22;
        g12 = inv_w * g12;
        g1 = inv_w * (g1 - (2.0 * w1) * g11 - w2 * g12);
        g2 = inv_w * (g2 - (2.0 * w2) * g22 - w1 * g12);
        g0 = (-inv_w) * (w11 * g11 + w22 * g22 + w12 * g12 + w1 * g1 + w2 * g2);
      }
      for (int i = 0; i < nu; ++i) {
        const V u0 = load(bu + i * kLanes), u1 = load(bu + (nu + i) * kLanes), u2 = load(bu + (2 * nu + i) * kLanes);
        add(Z0[i], u1, g1);
        add(Z0[i], u2, g11);
        if constexpr (kRational) add(Z0[i], u0, g0);
        add(Z1[i], u0, g2);
        add(Z1[i], u1, g12);
        add(Z2[i], u0, g22);
      }
    }
    for (int j = 0; j < nv; ++j) {
      const V v0 = load(bv + j * kLanes), v1 = load(bv + (nv + j) * kLanes), v2 = load(bv + (2 * nv + j) * kLanes);
      for (int i = 0; i < nu; ++i) {
        add(F[i + nu * j], v0, Z0[i]);
        add(F[i + nu * j], v1, Z1[i]);
        add(F[i + nu * j], v2, Z2[i]);
      }
    }
  }
  double* out = cell_force + static_cast<long>(group) * nn * 3 * kLanes;
  for (int k = 0; k < nn; ++k) {
    const V3 f = kRational ? load(weights + k * kLanes) * F[k] : F[k];
    store(out + (3 * k) * kLanes, f.x);
    store(out + (3 * k + 1) * kLanes, f.y);
    store(out + (3 * k + 2) * kLanes, f.z);
  }
  if constexpr (kEnergy) e.write(shell_law, group, energy);
}

template <int kP, int kQ, bool kRational, bool kEnergy, class Law>
void force(const ShellBlock& block, const BlockLaw& law, const double* q, double* cell_force, double* energy) {
  forAll(Each::element, block.groups,
         [&](int group) { groupForce<kP, kQ, kRational, kEnergy, Law>(block, law, group, q, cell_force, energy); });
}

/// Cut cells: points of their own, the law in its general form.
template <bool kEnergy>
void scatteredForce(const ShellBlock& block, const BlockLaw& shell_law, const double* q, double* cell_force,
                    double* energy) {
  const int nn = block.nodeCount(), stride = block.pointDoubles() * kLanes;
  const LawsByPoint laws = block.lawsByPoint();
  forAll(Each::element, block.groups, [&](int group) {
    constexpr int kMax = (kMaxDegree + 1) * (kMaxDegree + 1);
    V3 X[kMax], F[kMax];
    const int* nodes = block.nodes.data() + static_cast<long>(group) * nn * kLanes;
    for (int k = 0; k < nn; ++k) {
      X[k] = gather(q, nodes + k * kLanes);
      F[k] = V3{};
    }
    GroupEnergy e;
    GeneralLaw law{shell_law};
    constantLaw(shell_law, law.lanes);
    for (long point = block.first_point[group]; point < block.first_point[group + 1]; ++point) {
      const double* data = block.points.data() + point * stride;
      const double* shape = block.shapes.data() + point * 5 * nn * kLanes;
      const auto N = [&](int d, int k) { return load(shape + (d * nn + k) * kLanes); };
      V3 x[5]{}, g[5];
      for (int k = 0; k < nn; ++k)
        for (int d = 0; d < 5; ++d) add(x[d], N(d, k), X[k]);
      shellPoint<kEnergy>(law, laws, point, data, block.rest_curvature ? data + 5 * kLanes : nullptr, x[0], x[1], x[2],
                          x[3], x[4], g[0], g[1], g[2], g[3], g[4], e);
      for (int k = 0; k < nn; ++k)
        for (int d = 0; d < 5; ++d) add(F[k], N(d, k), g[d]);
    }
    double* out = cell_force + static_cast<long>(group) * nn * 3 * kLanes;
    for (int k = 0; k < nn; ++k) {
      store(out + (3 * k) * kLanes, F[k].x);
      store(out + (3 * k + 1) * kLanes, F[k].y);
      store(out + (3 * k + 2) * kLanes, F[k].z);
    }
    if constexpr (kEnergy) e.write(shell_law, group, energy);
  });
}

template <bool kRational, bool kEnergy, class Law>
void forceOfDegree(const ShellBlock& b, const BlockLaw& law, const double* q, double* cell_force, double* energy) {
  if (b.p == 2 && b.q == 2) return force<2, 2, kRational, kEnergy, Law>(b, law, q, cell_force, energy);
  if (b.p == 3 && b.q == 3) return force<3, 3, kRational, kEnergy, Law>(b, law, q, cell_force, energy);
  force<-1, -1, kRational, kEnergy, Law>(b, law, q, cell_force, energy);
}

template <bool kRational, bool kEnergy>
void forceOfLaw(const ShellBlock& b, const BlockLaw& law, const double* q, double* cell_force, double* energy) {
  law.general ? forceOfDegree<kRational, kEnergy, GeneralLaw>(b, law, q, cell_force, energy)
              : forceOfDegree<kRational, kEnergy, FabricLaw>(b, law, q, cell_force, energy);
}

void shellForce(const ShellBlock& b, const BlockLaw& law, const double* q, double* cell_force, double* energy) {
  if (b.assumed) return GAMBESON_CONCAT(shellAssumed_, GAMBESON_ISA)(b, law, q, cell_force, energy);
  if (b.scattered)
    return energy ? scatteredForce<true>(b, law, q, cell_force, energy)
                  : scatteredForce<false>(b, law, q, cell_force, energy);
  if (b.rational) {
    energy ? forceOfLaw<true, true>(b, law, q, cell_force, energy)
           : forceOfLaw<true, false>(b, law, q, cell_force, energy);
  } else {
    energy ? forceOfLaw<false, true>(b, law, q, cell_force, energy)
           : forceOfLaw<false, false>(b, law, q, cell_force, energy);
  }
}

/// 16 independent chains of multiply-adds, enough to hide the latency of the unit.
double multiplyAddPeak(long rounds) {
  constexpr int kChains = 16;
  V x[kChains];
  for (int c = 0; c < kChains; ++c) x[c] = splat(1.0 + c * 1e-3);
  V scale = splat(0.999999), shift = splat(1e-7);
  asm volatile("" : "+x"(scale), "+x"(shift));
  for (long r = 0; r < rounds; ++r)
    for (int c = 0; c < kChains; ++c) x[c] = x[c] * scale + shift;
  V sum{};
  for (int c = 0; c < kChains; ++c) sum += x[c];
  asm volatile("" : : "x"(sum));
  return 2.0 * kChains * kLanes * static_cast<double>(rounds);
}

}  // namespace

extern const KernelSet GAMBESON_CONCAT(kKernels_, GAMBESON_ISA);
const KernelSet GAMBESON_CONCAT(kKernels_, GAMBESON_ISA){GAMBESON_STRING(GAMBESON_ISA), kLanes, shellForce,
                                                         GAMBESON_CONCAT(shellTangent_, GAMBESON_ISA), multiplyAddPeak};

}  // namespace gambeson
