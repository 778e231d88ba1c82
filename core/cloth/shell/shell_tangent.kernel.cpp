/// Second derivatives of the energy of the Kirchhoff-Love shell, vectorised over cells. Compiled once per instruction
/// set with GAMBESON_ISA defined.
///
/// At a point all is turned to the physical basis first: p_a = N,a and P_ab = N,ab of each node along weft and warp,
/// e_a = x,a, y_ab = x,ab, n the normal, e^a the dual base, Gamma^g_ab = y_ab . e^g. Then, for node I,
///   dE_ab = (p_b e_a + p_a e_b)/2,   dkappa_ab = beta_ab n,   beta_ab = P_ab - Gamma^g_ab p_g,
///   dn = - t n^T,   t = p_a e^a,
/// and the second variations are, with n^ab the resultants, m^ab the moments, mu = m^ab beta_ab, Y = m^ab y_ab . n,
///   membrane  n^ab p_aI p_bJ 1
///   bending   - mu_I t_J n^T - mu_J n t_I^T - Y (t_I . t_J) n n^T
/// for rows of I and columns of J. Where the matrix has to be definite, n^ab is its tensile part alone and the last row
/// is left out; cells with assumed strains then have their geometric stiffness at the Gauss points, not at the ties.

#include "core/cloth/shell/assumed.hpp"
#include "core/cloth/tensile.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr int kMaxDegree = 5;

/// Of one node at one point: rows of the strains (a vector each) and of the curvatures (times n), the change of the
/// normal, and what the resultants make of them.
struct Rows {
  V3 strain[3];
  V bend[3];
  V3 t;
  V mu, p1, p2;
};
/// The changes of n and m (times the area) by moving one node.
struct Changes {
  V3 n[3], m[3];
};

/// Where a Gauss point lies among the ties of its cell.
struct Tied {
  Ties* ties;
  const double* tie_weight;
  int gu, gv;
};

/// Adds what the point contributes to all pairs. `kNodes`: their largest number, `nn` the number. With assumed strains
/// (`tied`) the resultants go to the ties, which add the rest of the membrane's part (addTies).
template <int kNodes, bool kAssumed = false>
inline void addPoint(int nn, const V3* X, const Shape* N, const double* data, const double* rest, GeneralLaw& law,
                     const LawsByPoint& laws, long point, double* pairs, [[maybe_unused]] const Tied* tied = nullptr) {
  V3 a1{}, a2{}, x11{}, x22{}, x12{};
  for (int k = 0; k < nn; ++k) {
    add(a1, N[k].d1, X[k]);
    add(a2, N[k].d2, X[k]);
    add(x11, N[k].d11, X[k]);
    add(x22, N[k].d22, X[k]);
    add(x12, N[k].d12, X[k]);
  }
  const V G11 = load(data), G12 = load(data + kLanes), G21 = load(data + 2 * kLanes), G22 = load(data + 3 * kLanes);
  const V dA = load(data + 4 * kLanes);
  const V q11 = G11 * G11, q12 = 2.0 * G11 * G21, q13 = G21 * G21;
  const V q21 = G12 * G12, q22 = 2.0 * G12 * G22, q23 = G22 * G22;
  const V q31 = G11 * G12, q32 = G11 * G22 + G21 * G12, q33 = G21 * G22;
  const V3 e1 = G11 * a1 + G21 * a2, e2 = G12 * a1 + G22 * a2;
  const V3 y11 = q11 * x11 + q12 * x12 + q13 * x22, y22 = q21 * x11 + q22 * x12 + q23 * x22,
           y12 = q31 * x11 + q32 * x12 + q33 * x22;
  const V C11 = dot(e1, e1), C22 = dot(e2, e2), C12 = dot(e1, e2);
  const V3 normal_j = cross(e1, e2);
  const V inv_j2 = 1.0 / dot(normal_j, normal_j);
  const V3 n = squareRoot(inv_j2) * normal_j;
  const V3 dual1 = inv_j2 * (C22 * e1 - C12 * e2), dual2 = inv_j2 * (C11 * e2 - C12 * e1);
  const V b11 = dot(n, y11), b22 = dot(n, y22), b12 = dot(n, y12);
  V strain[3] = {0.5 * (C11 - 1.0), 0.5 * (C22 - 1.0), C12};
  // From covariant (11, 22, 2 x 12) to physical components.
  [[maybe_unused]] const V T[3][3] = {{q11, q13, 0.5 * q12}, {q21, q23, 0.5 * q22}, {2.0 * q31, 2.0 * q33, q32}};
  if constexpr (kAssumed) {
    V cov[3];
    tied->ties->strains(tied->tie_weight, tied->gu, tied->gv, cov);
    for (int i = 0; i < 3; ++i) strain[i] = T[i][0] * cov[0] + T[i][1] * cov[1] + T[i][2] * cov[2];
  }
  V change[3] = {b11, b22, 2.0 * b12};
  if (rest) {
    change[0] -= load(rest);
    change[1] -= load(rest + kLanes);
    change[2] -= 2.0 * load(rest + 2 * kLanes);
  }
  PointAnswer<V> answer;
  law.evaluate<with_slope>(laws, point, strain, change, answer);
  V *force = answer.membrane.resultant, *moment3 = answer.bending.resultant;
  V *A = answer.membrane.slope, *D = answer.bending.slope, B[6];
  for (int i = 0; i < 6; ++i) {
    A[i] *= dA;
    B[i] = law.lanes.B[i] * dA;
    D[i] *= dA;
  }
  for (int i = 0; i < 3; ++i) {
    force[i] *= dA;
    moment3[i] *= dA;
  }
  if constexpr (kAssumed) {
    V R[3];
    for (int i = 0; i < 3; ++i) R[i] = T[0][i] * force[0] + T[1][i] * force[1] + T[2][i] * force[2];
    tied->ties->collect(tied->tie_weight, tied->gu, tied->gv, R);
  }
  const V Y = moment3[0] * b11 + moment3[1] * b22 + 2.0 * moment3[2] * b12;
  const V g111 = dot(y11, dual1), g211 = dot(y11, dual2), g122 = dot(y22, dual1), g222 = dot(y22, dual2),
          g112 = dot(y12, dual1), g212 = dot(y12, dual2);

  const bool definite = law.law.definite;
  V spreading[3] = {force[0], force[1], force[2]};
  if (definite) tensilePart(force, spreading);

  Rows rows[kNodes];
  Changes changes[kNodes];
  for (int k = 0; k < nn; ++k) {
    Rows& r = rows[k];
    r.p1 = G11 * N[k].d1 + G21 * N[k].d2;
    r.p2 = G12 * N[k].d1 + G22 * N[k].d2;
    r.bend[0] = q11 * N[k].d11 + q12 * N[k].d12 + q13 * N[k].d22 - g111 * r.p1 - g211 * r.p2;
    r.bend[1] = q21 * N[k].d11 + q22 * N[k].d12 + q23 * N[k].d22 - g122 * r.p1 - g222 * r.p2;
    r.bend[2] = 2.0 * (q31 * N[k].d11 + q32 * N[k].d12 + q33 * N[k].d22 - g112 * r.p1 - g212 * r.p2);
    if constexpr (kAssumed) {
      V3 cov[3];
      tied->ties->rows(tied->tie_weight, tied->gu, tied->gv, k, cov);
      for (int i = 0; i < 3; ++i) r.strain[i] = T[i][0] * cov[0] + T[i][1] * cov[1] + T[i][2] * cov[2];
    } else {
      r.strain[0] = r.p1 * e1;
      r.strain[1] = r.p2 * e2;
      r.strain[2] = r.p1 * e2 + r.p2 * e1;
    }
    r.t = r.p1 * dual1 + r.p2 * dual2;
    r.mu = moment3[0] * r.bend[0] + moment3[1] * r.bend[1] + moment3[2] * r.bend[2];
    V bn[3]{}, bm[3]{};
    addProduct(B, r.bend, bn);
    addProduct(D, r.bend, bm);
    Changes& c = changes[k];
    const V3* s = r.strain;
    c.n[0] = A[0] * s[0] + A[3] * s[1] + A[4] * s[2] + bn[0] * n;
    c.n[1] = A[3] * s[0] + A[1] * s[1] + A[5] * s[2] + bn[1] * n;
    c.n[2] = A[4] * s[0] + A[5] * s[1] + A[2] * s[2] + bn[2] * n;
    c.m[0] = B[0] * s[0] + B[3] * s[1] + B[4] * s[2] + bm[0] * n;
    c.m[1] = B[3] * s[0] + B[1] * s[1] + B[5] * s[2] + bm[1] * n;
    c.m[2] = B[4] * s[0] + B[5] * s[1] + B[2] * s[2] + bm[2] * n;
  }
  for (int I = 0; I < nn; ++I) {
    const Rows r = rows[I];
    const V f1 = spreading[0] * r.p1 + spreading[2] * r.p2, f2 = spreading[2] * r.p1 + spreading[1] * r.p2;
    const V3 turned = definite ? V3{} : r.mu * n;
    for (int J = I; J < nn; ++J) {
      const Changes& c = changes[J];
      const V3 tJ = rows[J].t;
      V3 w = r.bend[0] * c.m[0] + r.bend[1] * c.m[1] + r.bend[2] * c.m[2];
      if (!definite) {
        w = w - rows[J].mu * r.t;
        add(w, -Y * dot(r.t, tJ), n);
      }
      const V spread = kAssumed && !definite ? V{} : f1 * rows[J].p1 + f2 * rows[J].p2;
      const V left[5][3] = {{r.strain[0].x, r.strain[0].y, r.strain[0].z},
                            {r.strain[1].x, r.strain[1].y, r.strain[1].z},
                            {r.strain[2].x, r.strain[2].y, r.strain[2].z},
                            {n.x, n.y, n.z},
                            {-tJ.x, -tJ.y, -tJ.z}};
      const V3 right[5] = {c.n[0], c.n[1], c.n[2], w, turned};
      for (int i = 0; i < 3; ++i) {
        V3 row{load(pairs + (3 * i) * kLanes), load(pairs + (3 * i + 1) * kLanes), load(pairs + (3 * i + 2) * kLanes)};
        for (int k = 0; k < 5; ++k) add(row, left[k][i], right[k]);
        (i == 0 ? row.x : i == 1 ? row.y : row.z) += spread;
        store(pairs + (3 * i) * kLanes, row.x);
        store(pairs + (3 * i + 1) * kLanes, row.y);
        store(pairs + (3 * i + 2) * kLanes, row.z);
      }
      pairs += 9 * kLanes;
    }
  }
}

/// n^ab N_I,a N_J,b of the ties, on the diagonal of each pair's block.
void addTies(const Ties& ties, double* pairs) {
  V spread[45]{};
  for (int component = 0; component < 3; ++component)
    for (int knot = 0; knot < 2; ++knot)
      for (int g = 0; g < ties.count[component]; ++g) {
        const Tie& t = ties.at[component][knot][g];
        int pair = 0;
        for (int I = 0; I < 9; ++I) {
          const V f1 = t.force[0] * t.d1[I] + t.force[2] * t.d2[I], f2 = t.force[2] * t.d1[I] + t.force[1] * t.d2[I];
          for (int J = I; J < 9; ++J) spread[pair++] += f1 * t.d1[J] + f2 * t.d2[J];
        }
      }
  for (int i = 0; i < 3; ++i)
    for (int c = 0; c < 2; ++c) {
      int pair = 0;
      for (int I = 0; I < 9; ++I) {
        const V f = ties.mean_force[i] * ties.gradient[c][I], h = ties.mean_force[i] * ties.excess[i][c][I];
        for (int J = I; J < 9; ++J) spread[pair++] += f * ties.excess[i][c][J] + h * ties.gradient[c][J];
      }
    }
  for (int pair = 0; pair < 45; ++pair)
    for (int d = 0; d < 9; d += 4) {
      double* at = pairs + (9 * pair + d) * kLanes;
      store(at, load(at) + spread[pair]);
    }
}

struct NoTies {
  NoTies(const ShellBlock&, int, const double*, const V3*) {}
};

/// kP, kQ: degrees known at compile time, or -1. kAssumed: with assumed strains, degree 2.
template <int kP, int kQ, bool kAssumed = false>
void tensorTangent(const ShellBlock& block, const BlockLaw& law, const double* q, int first, int count, double* pairs) {
  const int nu = kP < 0 ? block.p + 1 : kP + 1, nv = kQ < 0 ? block.q + 1 : kQ + 1, nn = nu * nv;
  constexpr int kNodes = (kP < 0 ? kMaxDegree + 1 : kP + 1) * (kQ < 0 ? kMaxDegree + 1 : kQ + 1);
  const int stride = block.pointDoubles() * kLanes;
  const long pair_doubles = static_cast<long>(block.pairCount()) * 9 * kLanes;
  const LawsByPoint laws = block.lawsByPoint();
  forAll(Each::element, first, first + count, [&](int group) {
    V3 X[kNodes];
    Shape N[kNodes];
    const int* nodes = block.nodes.data() + static_cast<long>(group) * nn * kLanes;
    const double* weights = block.rational ? block.weights.data() + static_cast<long>(group) * nn * kLanes : nullptr;
    for (int k = 0; k < nn; ++k) X[k] = gather(q, nodes + k * kLanes);
    double* out = pairs + (group - first) * pair_doubles;
    for (long k = 0; k < pair_doubles; k += kLanes) store(out + k, V{});
    [[maybe_unused]] std::conditional_t<kAssumed, Ties, NoTies> ties(block, group, weights, X);
    GeneralLaw point_law{law};
    constantLaw(law, point_law.lanes);
    for (int gv = 0; gv < block.gv; ++gv) {
      const double* bv = block.basis_v.data() + (static_cast<long>(group) * block.gv + gv) * 3 * nv * kLanes;
      for (int gu = 0; gu < block.gu; ++gu) {
        const double* bu = block.basis_u.data() + (static_cast<long>(group) * block.gu + gu) * 3 * nu * kLanes;
        const long point = (static_cast<long>(group) * block.gv + gv) * block.gu + gu;
        const double* data = block.points.data() + point * stride;
        tensorShapes(nu, nv, bu, bv, weights, data + 5 * kLanes, N);
        const double* rest = block.rest_curvature ? data + (5 + (block.rational ? 6 : 0)) * kLanes : nullptr;
        if constexpr (kAssumed) {
          const Tied tied{&ties, block.tie_weight.data() + point * kTieWeightDoubles * kLanes, gu, gv};
          addPoint<kNodes, true>(nn, X, N, data, rest, point_law, laws, point, out, &tied);
        } else {
          addPoint<kNodes>(nn, X, N, data, rest, point_law, laws, point, out);
        }
      }
    }
    if constexpr (kAssumed)
      if (!law.definite) addTies(ties, out);
  });
}

void scatteredTangent(const ShellBlock& block, const BlockLaw& law, const double* q, int first, int count,
                      double* pairs) {
  constexpr int kNodes = (kMaxDegree + 1) * (kMaxDegree + 1);
  const int nn = block.nodeCount(), stride = block.pointDoubles() * kLanes;
  const long pair_doubles = static_cast<long>(block.pairCount()) * 9 * kLanes;
  const LawsByPoint laws = block.lawsByPoint();
  forAll(Each::element, first, first + count, [&](int group) {
    V3 X[kNodes];
    Shape N[kNodes];
    const int* nodes = block.nodes.data() + static_cast<long>(group) * nn * kLanes;
    for (int k = 0; k < nn; ++k) X[k] = gather(q, nodes + k * kLanes);
    double* out = pairs + (group - first) * pair_doubles;
    for (long k = 0; k < pair_doubles; k += kLanes) store(out + k, V{});
    GeneralLaw point_law{law};
    constantLaw(law, point_law.lanes);
    for (long point = block.first_point[group]; point < block.first_point[group + 1]; ++point) {
      const double* shape = block.shapes.data() + point * 5 * nn * kLanes;
      const auto at = [&](int d, int k) { return load(shape + (d * nn + k) * kLanes); };
      for (int k = 0; k < nn; ++k) N[k] = {at(0, k), at(1, k), at(2, k), at(3, k), at(4, k)};
      const double* data = block.points.data() + point * stride;
      addPoint<kNodes>(nn, X, N, data, block.rest_curvature ? data + 5 * kLanes : nullptr, point_law, laws, point, out);
    }
  });
}

}  // namespace

void GAMBESON_CONCAT(shellTangent_, GAMBESON_ISA)(const ShellBlock&, const BlockLaw&, const double*, int, int, double*);
void GAMBESON_CONCAT(shellTangent_, GAMBESON_ISA)(const ShellBlock& b, const BlockLaw& law, const double* q, int first,
                                                  int count, double* pairs) {
  if (b.assumed) return tensorTangent<2, 2, true>(b, law, q, first, count, pairs);
  if (b.scattered) return scatteredTangent(b, law, q, first, count, pairs);
  if (b.p == 2 && b.q == 2) return tensorTangent<2, 2>(b, law, q, first, count, pairs);
  if (b.p == 3 && b.q == 3) return tensorTangent<3, 3>(b, law, q, first, count, pairs);
  tensorTangent<-1, -1>(b, law, q, first, count, pairs);
}

}  // namespace gambeson
