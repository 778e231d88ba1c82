/// Internal force of quadratic cells with assumed strains (core/cloth/shell/assumed.hpp), vectorised over cells.
/// Compiled once per instruction set with GAMBESON_ISA defined. Notation as in shell_tangent.kernel.cpp.

#include "core/cloth/shell/assumed.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

template <bool kEnergy, class Law>
void assumedForce(const ShellBlock& block, const BlockLaw& shell_law, const double* q, double* cell_force,
                  double* energy) {
  constexpr int nn = 9;
  const int stride = block.pointDoubles() * kLanes;
  const LawsByPoint laws = block.lawsByPoint();
  forAll(Each::element, block.groups, [&](int group) {
    V3 X[nn], F[nn];
    const int* nodes = block.nodes.data() + static_cast<long>(group) * nn * kLanes;
    const double* weights = block.rational ? block.weights.data() + static_cast<long>(group) * nn * kLanes : nullptr;
    for (int k = 0; k < nn; ++k) {
      X[k] = gather(q, nodes + k * kLanes);
      F[k] = V3{};
    }
    Ties ties(block, group, weights, X);
    GroupEnergy total;
    Law law{shell_law};
    if constexpr (std::is_same_v<Law, GeneralLaw>) constantLaw(shell_law, law.lanes);
    for (int gv = 0; gv < block.gv; ++gv) {
      const double* bv = block.basis_v.data() + (static_cast<long>(group) * block.gv + gv) * 9 * kLanes;
      for (int gu = 0; gu < block.gu; ++gu) {
        const double* bu = block.basis_u.data() + (static_cast<long>(group) * block.gu + gu) * 9 * kLanes;
        const long point = (static_cast<long>(group) * block.gv + gv) * block.gu + gu;
        const double* data = block.points.data() + point * stride;
        const double* tie_weight = block.tie_weight.data() + point * kTieWeightDoubles * kLanes;
        Shape N[nn];
        tensorShapes(3, 3, bu, bv, weights, data + 5 * kLanes, N);
        V3 a1{}, a2{}, x11{}, x22{}, x12{};
        for (int k = 0; k < nn; ++k) {
          add(a1, N[k].d1, X[k]);
          add(a2, N[k].d2, X[k]);
          add(x11, N[k].d11, X[k]);
          add(x22, N[k].d22, X[k]);
          add(x12, N[k].d12, X[k]);
        }
        const V G11 = load(data), G12 = load(data + kLanes), G21 = load(data + 2 * kLanes),
                G22 = load(data + 3 * kLanes), dA = load(data + 4 * kLanes);
        // From covariant (11, 22, 2 x 12) to physical components; the transpose takes the resultants back.
        const V T[3][3] = {{G11 * G11, G21 * G21, G11 * G21},
                           {G12 * G12, G22 * G22, G12 * G22},
                           {2.0 * G11 * G12, 2.0 * G21 * G22, G11 * G22 + G21 * G12}};
        const V3 normal_j = cross(a1, a2);
        const V inv_j2 = 1.0 / dot(normal_j, normal_j);
        const V3 n = squareRoot(inv_j2) * normal_j;
        const V bent[3] = {dot(n, x11), dot(n, x22), 2.0 * dot(n, x12)};
        V cov[3], strain[3], change[3];
        ties.strains(tie_weight, gu, gv, cov);
        for (int i = 0; i < 3; ++i) {
          strain[i] = T[i][0] * cov[0] + T[i][1] * cov[1] + T[i][2] * cov[2];
          change[i] = T[i][0] * bent[0] + T[i][1] * bent[1] + T[i][2] * bent[2];
        }
        if (block.rest_curvature) {
          const double* rest = data + (5 + (block.rational ? 6 : 0)) * kLanes;
          change[0] -= load(rest);
          change[1] -= load(rest + kLanes);
          change[2] -= 2.0 * load(rest + 2 * kLanes);
        }
        PointAnswer<V> answer;
        law.template evaluate<kEnergy ? with_energy : only_resultants>(laws, point, strain, change, answer);
        if constexpr (kEnergy) total.add(dA, answer);
        const V *resultant = answer.membrane.resultant, *couple = answer.bending.resultant;
        V R[3], B[3];
        for (int i = 0; i < 3; ++i) {
          R[i] = dA * (T[0][i] * resultant[0] + T[1][i] * resultant[1] + T[2][i] * resultant[2]);
          B[i] = dA * (T[0][i] * couple[0] + T[1][i] * couple[1] + T[2][i] * couple[2]);
        }
        ties.collect(tie_weight, gu, gv, R);
        // B : d(kappa) = n (B^ab N,ab - B^ab x,ab . a^g N,g)
        const V3 b = B[0] * x11 + B[1] * x22 + (2.0 * B[2]) * x12;
        const V C11 = dot(a1, a1), C22 = dot(a2, a2), C12 = dot(a1, a2), ba1 = dot(b, a1), ba2 = dot(b, a2);
        const V h1 = (C22 * ba1 - C12 * ba2) * inv_j2, h2 = (C11 * ba2 - C12 * ba1) * inv_j2;
        for (int k = 0; k < nn; ++k)
          add(F[k], B[0] * N[k].d11 + B[1] * N[k].d22 + (2.0 * B[2]) * N[k].d12 - h1 * N[k].d1 - h2 * N[k].d2, n);
      }
    }
    for (int component = 0; component < 3; ++component)
      for (int knot = 0; knot < 2; ++knot)
        for (int g = 0; g < ties.count[component]; ++g) {
          const Tie& t = ties.at[component][knot][g];
          const V3 f1 = t.force[0] * t.a1 + t.force[2] * t.a2, f2 = t.force[2] * t.a1 + t.force[1] * t.a2;
          for (int k = 0; k < nn; ++k) {
            add(F[k], t.d1[k], f1);
            add(F[k], t.d2[k], f2);
          }
        }
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < nn; ++k) add(F[k], ties.mean_force[i], ties.mean_rows[i][k]);
    double* out = cell_force + static_cast<long>(group) * nn * 3 * kLanes;
    for (int k = 0; k < nn; ++k) {
      store(out + (3 * k) * kLanes, F[k].x);
      store(out + (3 * k + 1) * kLanes, F[k].y);
      store(out + (3 * k + 2) * kLanes, F[k].z);
    }
    if constexpr (kEnergy) total.write(shell_law, group, energy);
  });
}

}  // namespace

void GAMBESON_CONCAT(shellAssumed_, GAMBESON_ISA)(const ShellBlock&, const BlockLaw&, const double*, double*, double*);
void GAMBESON_CONCAT(shellAssumed_, GAMBESON_ISA)(const ShellBlock& b, const BlockLaw& law, const double* q,
                                                  double* cell_force, double* energy) {
  if (law.general) {
    energy ? assumedForce<true, GeneralLaw>(b, law, q, cell_force, energy)
           : assumedForce<false, GeneralLaw>(b, law, q, cell_force, energy);
  } else {
    energy ? assumedForce<true, FabricLaw>(b, law, q, cell_force, energy)
           : assumedForce<false, FabricLaw>(b, law, q, cell_force, energy);
  }
}

}  // namespace gambeson
