#pragma once
/// Assumed strains: no membrane locking of quadratic cells at any thickness, in lanes. Included only by kernels.
///
/// In bending, a quadratic net cannot keep its membrane strains zero at all points of the full rule, and answers with
/// spurious membrane stress. The strains of a cell are therefore taken where the net can follow, and interpolated
/// (assumed natural strains; with the knots as places, as Casquero and Golestanian 2022 do for shells of quadratic
/// NURBS):
///   E_11 at the two u-knots of the cell and each Gauss v, linear in u;  E_22 likewise at the v-knots;
///   E_12 at the four corners, bilinear.
/// What is interpolated is the strain tensor in the orthonormal rest frames (weft projected) of the places, seen along
/// the parameter lines of the Gauss point, so that constant strain passes unchanged on distorted cells too; where the
/// rest surface degenerates (a pole) it is the covariant component itself. On distorted cells that alone would not hold
/// a constant stress in balance. With F the cell's mean gradient of x and A its rest area, the mean over the cell of
/// what the ties miss of the strain's part linear in x about F,
///   C = 1/A ∫ (L - L_assumed) dA,   L_ab = sym(F_a . x,b),
/// is therefore added, less its value at rest: zero in a homogeneous state and on cells of constant rest metric; with
/// it the patch test is passed to rounding. The curvature is taken as it is. 2 x 2 Gauss points suffice (3 x 3 on
/// rational, narrow and trimmed patches, see shell.cpp); rigid motions make no strain, and no mode is free that the
/// full rule holds.
///
/// Linear pinched hemisphere with a hole, 16 x 16 cells, R/h = 250: 0.998 of the limit, full rule 0.85. The price: the
/// strain of a cell's own curvature, (cell x curvature)^2 / 12, is not seen, and where membrane stress governs the
/// bending the order drops to 2; wrinkles under shear come out too short on meshes that the full rule resolves. Use it
/// where bending of thin sheets governs; it is not the default.

#include "core/cloth/law_lanes.hpp"
#include "core/cloth/shell/shell_kernel.hpp"

namespace gambeson {
namespace {

/// Derivatives of one node's basis function in the parameters.
struct Shape {
  V d1, d2, d11, d22, d12;
};

/// The derivatives of all nodes at Gauss point (gu, gv) of a tensor cell. `weights`: null unless rational, then `w`
/// holds the denominator and its derivatives.
inline void tensorShapes(int nu, int nv, const double* bu, const double* bv, const double* weights, const double* w,
                         Shape* N) {
  for (int j = 0; j < nv; ++j) {
    const V v0 = load(bv + j * kLanes), v1 = load(bv + (nv + j) * kLanes), v2 = load(bv + (2 * nv + j) * kLanes);
    for (int i = 0; i < nu; ++i) {
      const V u0 = load(bu + i * kLanes), u1 = load(bu + (nu + i) * kLanes), u2 = load(bu + (2 * nu + i) * kLanes);
      Shape& s = N[i + nu * j];
      s = {u1 * v0, u0 * v1, u2 * v0, u0 * v2, u1 * v1};
      if (weights) {
        // The quotient rule on weight times product over the denominator.
        const V inv_w = 1.0 / load(w), w1 = load(w + kLanes), w2 = load(w + 2 * kLanes), w11 = load(w + 3 * kLanes),
                w22 = load(w + 4 * kLanes), w12 = load(w + 5 * kLanes);
        const V over = load(weights + (i + nu * j) * kLanes) * inv_w, s0 = over * u0 * v0;
        s.d1 = over * s.d1 - inv_w * w1 * s0;
        s.d2 = over * s.d2 - inv_w * w2 * s0;
        s.d11 = over * s.d11 - inv_w * (2.0 * w1 * s.d1 + w11 * s0);
        s.d22 = over * s.d22 - inv_w * (2.0 * w2 * s.d2 + w22 * s0);
        s.d12 = over * s.d12 - inv_w * (w1 * s.d2 + w2 * s.d1 + w12 * s0);
      }
    }
  }
}

/// One place where strains are taken: covariant (E11, E22, 2 E12).
struct Tie {
  V d1[9], d2[9];  ///< first derivatives of the basis
  V3 a1, a2;
  V strain[3];
  V force[3];  ///< what the points' resultants add up to, conjugate to `strain`
};

/// Eight ties act on a Gauss point: E11 at the knots 0 and 1, E22 at the knots 0 and 1, E12 at the corners (0, 0),
/// (0, 1), (1, 0), (1, 1). Their weights (ShellBlock::tie_weight) are three numbers each; nine more take C to
/// covariant components.
struct Ties {
  Tie at[3][2][kMaxTies];             ///< [E11][u-knot][gv], [E22][v-knot][gu], [E12][u-knot][v-knot]
  int count[3];                       ///< of the last index
  V gradient[2][9], excess[3][2][9];  ///< rows of F and of the mean of x,b as C needs it
  V3 mean_rows[3][9];                 ///< dC/dq of each node
  V mean[3], mean_force[3];           ///< C less that of the rest shape (11, 22, 2 x 12), and what acts on it

  Ties(const ShellBlock& block, long group, const double* weights, const V3* X) : count{block.gv, block.gu, 2} {
    const double* tu = block.tie_u.data() + group * 12 * kLanes;
    const double* tv = block.tie_v.data() + group * 12 * kLanes;
    const double* bu = block.basis_u.data() + group * block.gu * 9 * kLanes;
    const double* bv = block.basis_v.data() + group * block.gv * 9 * kLanes;
    const double* rest = block.tie_rest.data() + group * block.tieCount() * 3 * kLanes;
    for (int component = 0; component < 3; ++component)
      for (int knot = 0; knot < 2; ++knot)
        for (int g = 0; g < count[component]; ++g) {
          const double* u = component == 1 ? bu + 9 * g * kLanes : tu + 6 * knot * kLanes;
          const double* v = component == 0   ? bv + 9 * g * kLanes
                            : component == 1 ? tv + 6 * knot * kLanes
                                             : tv + 6 * g * kLanes;
          set(at[component][knot][g], u, v, weights, X, rest);
          rest += 3 * kLanes;
        }
    const double* rows = block.tie_mean.data() + group * kMeanDoubles * kLanes;
    V3 F[2]{}, H[3][2]{};
    for (int c = 0; c < 2; ++c)
      for (int k = 0; k < 9; ++k) {
        gradient[c][k] = load(rows + (9 * c + k) * kLanes);
        add(F[c], gradient[c][k], X[k]);
        for (int i = 0; i < 3; ++i) {
          excess[i][c][k] = load(rows + (18 + 9 * (2 * i + c) + k) * kLanes);
          add(H[i][c], excess[i][c][k], X[k]);
        }
      }
    for (int i = 0; i < 3; ++i) {
      mean[i] = dot(F[0], H[i][0]) + dot(F[1], H[i][1]) - load(rows + (72 + i) * kLanes);
      mean_force[i] = V{};
      for (int k = 0; k < 9; ++k) {
        mean_rows[i][k] = V3{};
        for (int c = 0; c < 2; ++c) {
          add(mean_rows[i][k], gradient[c][k], H[i][c]);
          add(mean_rows[i][k], excess[i][c][k], F[c]);
        }
      }
    }
  }

  template <class Self>
  static auto& tie(Self& self, int which, int gu, int gv) {
    return which < 2   ? self.at[0][which][gv]
           : which < 4 ? self.at[1][which - 2][gu]
                       : self.at[2][(which - 4) / 2][(which - 4) % 2];
  }
  static constexpr int component(int which) { return which < 2 ? 0 : which < 4 ? 1 : 2; }

  /// The three covariant strains at a Gauss point.
  void strains(const double* tie_weight, int gu, int gv, V* cov) const {
    cov[0] = cov[1] = cov[2] = V{};
    for (int i = 0; i < 8; ++i) {
      const Tie& t = tie(*this, i, gu, gv);
      for (int c = 0; c < 3; ++c) cov[component(i)] += load(tie_weight + (3 * i + c) * kLanes) * t.strain[c];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) cov[i] += load(tie_weight + (24 + 3 * i + j) * kLanes) * mean[j];
  }
  /// Hands the covariant resultants of a Gauss point (times its area) to the ties.
  void collect(const double* tie_weight, int gu, int gv, const V* N) {
    for (int i = 0; i < 8; ++i) {
      Tie& t = tie(*this, i, gu, gv);
      for (int c = 0; c < 3; ++c) t.force[c] += load(tie_weight + (3 * i + c) * kLanes) * N[component(i)];
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) mean_force[j] += load(tie_weight + (24 + 3 * i + j) * kLanes) * N[i];
  }
  /// Rows of the three covariant strains at a Gauss point for one node.
  void rows(const double* tie_weight, int gu, int gv, int node, V3* r) const {
    r[0] = r[1] = r[2] = V3{};
    for (int i = 0; i < 8; ++i) {
      const Tie& t = tie(*this, i, gu, gv);
      const V s0 = load(tie_weight + 3 * i * kLanes), s1 = load(tie_weight + (3 * i + 1) * kLanes),
              s2 = load(tie_weight + (3 * i + 2) * kLanes);
      V3& out = r[component(i)];
      add(out, s0 * t.d1[node] + s2 * t.d2[node], t.a1);
      add(out, s1 * t.d2[node] + s2 * t.d1[node], t.a2);
    }
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) add(r[i], load(tie_weight + (24 + 3 * i + j) * kLanes), mean_rows[j][node]);
  }

 private:
  static void set(Tie& t, const double* u, const double* v, const double* weights, const V3* X, const double* rest) {
    V n0[9], W{}, W1{}, W2{};
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int k = i + 3 * j;
        const V f0 = load(u + i * kLanes), f1 = load(u + (3 + i) * kLanes), g0 = load(v + j * kLanes),
                g1 = load(v + (3 + j) * kLanes), w = weights ? load(weights + k * kLanes) : splat(1);
        n0[k] = w * f0 * g0;
        t.d1[k] = w * f1 * g0;
        t.d2[k] = w * f0 * g1;
        W += n0[k];
        W1 += t.d1[k];
        W2 += t.d2[k];
      }
    t.a1 = t.a2 = V3{};
    const V inv = 1.0 / W;
    for (int k = 0; k < 9; ++k) {
      if (weights) {
        const V n = inv * n0[k];
        t.d1[k] = inv * (t.d1[k] - W1 * n);
        t.d2[k] = inv * (t.d2[k] - W2 * n);
      }
      add(t.a1, t.d1[k], X[k]);
      add(t.a2, t.d2[k], X[k]);
    }
    t.strain[0] = 0.5 * (dot(t.a1, t.a1) - load(rest));
    t.strain[1] = 0.5 * (dot(t.a2, t.a2) - load(rest + kLanes));
    t.strain[2] = dot(t.a1, t.a2) - load(rest + 2 * kLanes);
    t.force[0] = t.force[1] = t.force[2] = V{};
  }
};

}  // namespace
}  // namespace gambeson
