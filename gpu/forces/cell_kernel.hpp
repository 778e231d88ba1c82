#pragma once
/// Cells of any degree, rule and law, whole or cut, a group each: lanes are points, then nodes.

#include "core/cloth/shell/shell_kernel.hpp"
#include "core/material/laws/point_law.hpp"
#include "gpu/device/lanes.hpp"
#include "gpu/forces/basic_number.hpp"
#include "gpu/forces/shell_point.hpp"

namespace gambeson::gpu {

constexpr int kMostNodes = 36;     ///< of a cell of degree 5
constexpr int kPointsAtOnce = 32;  ///< of a cell, whatever the width of a group

/// What the laws remember: committed (null: new cloth) and as it would be (null: not asked).
struct HistoryArrays {
  const double* committed = nullptr;
  double* trial = nullptr;
  double elapsed_s = 0;
};

/// A ShellBlock of core, its arrays as they are: [group][...][lane].
struct CellArrays {
  int lanes, cells;
  const int* list;  ///< of the block's cells
  int p, q, gu, gv, point_doubles;
  int rational, scattered, rest_curvature;
  const int* nodes;
  const double *weights, *basis_u, *basis_v, *shapes, *points;
  const long* first_point;
  const PointNumbers<double>* law;  ///< of all points
  const double* laws;               ///< [point][kLawDoubles][lane] where they differ; else null
  LawUse use;
  int history_size;  ///< LawUse::historySize, which a device cannot ask for
  long history_first;
  int first_slot;  ///< [index in the list][node]
};

/// n of a membrane that carries no compression.
GAMBESON_HD GAMBESON_APART inline void relaxToTensionField(const double* stiffness, const double* e, double* n) {
  Basic A[6], strain[3];
  for (int i = 0; i < 6; ++i) A[i] = stiffness[i];
  for (int i = 0; i < 3; ++i) strain[i] = e[i];
  const TensionFieldOf<Basic> field = tensionField(A, strain);
  for (int i = 0; i < 3; ++i) n[i] = field.n[i].value;
}

/// n and m: evaluateLaws (core/material/laws/point_law.hpp) without friction in shear.
GAMBESON_HD inline void evaluateCarried(const LawUse& use, const PointNumbers<double>& l, const double* e,
                                        const double* k, History<double> history, double* n, double* m) {
  Answer<double, 3> membrane, bending;
  stVenantKirchhoff<only_resultants>(l.A, e, membrane);
  if (use.tension && l.tension != 0.0) relaxToTensionField(l.A, e, membrane.resultant);
  if (use.jams) addJamming<only_resultants>(l.jam, l.jam_s, e, membrane);
  addProduct(l.B, k, membrane.resultant);
  evaluateBending<only_resultants>(use, l, k, history, bending);
  addProduct(l.B, e, bending.resultant);
  for (int i = 0; i < 3; ++i) n[i] = membrane.resultant[i], m[i] = bending.resultant[i];
}

struct CellForces {
  static constexpr int kResident = 8;
  struct Shared {
    Vec3 x[kMostNodes], sum[kMostNodes];
    Vec3 of_point[kPointsAtOnce][6];  ///< forces on the numerator and its derivatives 1, 2, 11, 22, 12
  };
  CellArrays b;
  HistoryArrays history;
  const Point4* position;
  Vec3* slot;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int) const {
    const int cell = b.list[index], nodes = (b.p + 1) * (b.q + 1), L = b.lanes, block = cell / L, lane_of = cell % L;
    const long first_node = static_cast<long>(block) * nodes * L + lane_of;
    group.each([&](int lane) {
      for (int k = lane; k < nodes; k += Group::kLanes) {
        const Vec3 x = vec(position[b.nodes[first_node + k * L]]);
        shared.x[k] = b.rational ? b.weights[first_node + k * L] * x : x;
        shared.sum[k] = {};
      }
    });
    group.sync();
    const long first = b.scattered ? b.first_point[block] : static_cast<long>(block) * b.gu * b.gv,
               end = b.scattered ? b.first_point[block + 1] : first + b.gu * b.gv;
    for (long at = first; at < end; at += kPointsAtOnce) {
      const int count = static_cast<int>(end - at < kPointsAtOnce ? end - at : kPointsAtOnce);
      group.each([&](int lane) {
        for (int k = lane; k < count; k += Group::kLanes)
          forcesOf(block, lane_of, at + k, static_cast<int>(at - first) + k, shared.x, shared.of_point[k]);
      });
      group.sync();
      group.each([&](int lane) {
        for (int node = lane; node < nodes; node += Group::kLanes) {
          Vec3 sum = shared.sum[node];
          for (int k = 0; k < count; ++k) {
            double N[6]{};
            functions(block, lane_of, at + k, static_cast<int>(at - first) + k, node, N);
            for (int d = b.scattered ? 1 : 0; d < 6; ++d) sum = fma(N[d], shared.of_point[k][d], sum);
          }
          shared.sum[node] = sum;
        }
      });
      group.sync();
    }
    group.each([&](int lane) {
      for (int k = lane; k < nodes; k += Group::kLanes)
        slot[b.first_slot + index * nodes + k] =
            b.rational ? b.weights[first_node + k * L] * shared.sum[k] : shared.sum[k];
    });
  }

 private:
  /// Of a node at a point: values and derivatives 1, 2, 11, 22, 12 (of scattered points the derivatives alone).
  GAMBESON_HD void functions(int block, int lane_of, long point, int of_cell, int node, double (&N)[6]) const {
    const int L = b.lanes;
    if (b.scattered) {
      const int nodes = (b.p + 1) * (b.q + 1);
      for (int d = 0; d < 5; ++d) N[d + 1] = b.shapes[((point * 5 + d) * nodes + node) * L + lane_of];
      return;
    }
    const int nu = b.p + 1, nv = b.q + 1, i = node % nu, j = node / nu, gu = of_cell % b.gu, gv = of_cell / b.gu;
    const double* bu = b.basis_u + ((static_cast<long>(block) * b.gu + gu) * 3 * nu + i) * L + lane_of;
    const double* bv = b.basis_v + ((static_cast<long>(block) * b.gv + gv) * 3 * nv + j) * L + lane_of;
    const double u0 = bu[0], u1 = bu[nu * L], u2 = bu[2 * nu * L], v0 = bv[0], v1 = bv[nv * L], v2 = bv[2 * nv * L];
    N[0] = u0 * v0;
    N[1] = u1 * v0;
    N[2] = u0 * v1;
    N[3] = u2 * v0;
    N[4] = u0 * v2;
    N[5] = u1 * v1;
  }

  GAMBESON_HD void forcesOf(int block, int lane_of, long point, int of_cell, const Vec3* x, Vec3* out) const {
    const int L = b.lanes, nodes = (b.p + 1) * (b.q + 1);
    Vec3 numerator{};
    SurfaceTerms t{};
    for (int node = 0; node < nodes; ++node) {
      double N[6]{};
      functions(block, lane_of, point, of_cell, node, N);
      if (b.rational) numerator = fma(N[0], x[node], numerator);
      t.of1 = fma(N[1], x[node], t.of1);
      t.of2 = fma(N[2], x[node], t.of2);
      t.of11 = fma(N[3], x[node], t.of11);
      t.of22 = fma(N[4], x[node], t.of22);
      t.of12 = fma(N[5], x[node], t.of12);
    }
    const double* data = b.points + point * b.point_doubles * L + lane_of;
    Denominator d{};
    if (b.rational) {
      d = {1 / data[5 * L], data[6 * L], data[7 * L], data[8 * L], data[9 * L], data[10 * L]};
      t = divided(d, numerator, t);
    }
    const double* rest = b.rest_curvature ? data + (b.rational ? 11 : 5) * L : nullptr;
    SurfaceTerms f = shellForces(t, {data[0], data[L], data[2 * L], data[3 * L], data[4 * L]},
                                 [&](const Voigt3& strain, const Voigt3& bend, Voigt3& tension, Voigt3& moment) {
                                   law(point, lane_of, rest, strain, bend, tension, moment);
                                 });
    Vec3 g0{};
    if (b.rational) f = dividedBack(d, f, g0);
    out[0] = g0, out[1] = f.of1, out[2] = f.of2, out[3] = f.of11, out[4] = f.of22, out[5] = f.of12;
  }

  GAMBESON_HD void law(long point, int lane_of, const double* rest, const Voigt3& strain, const Voigt3& bend,
                       Voigt3& tension, Voigt3& moment) const {
    const int L = b.lanes;
    const double e[3] = {strain.a, strain.b, strain.c};
    double k[3] = {bend.a, bend.b, bend.c}, n[3], m[3];
    if (rest) k[0] -= rest[0], k[1] -= rest[L], k[2] -= 2.0 * rest[2 * L];
    History<double> remembered;
    if (b.use.remembers()) {
      const long first = b.history_first + point * b.history_size * L + lane_of;
      remembered = {history.committed ? history.committed + first : nullptr,
                    history.trial ? history.trial + first : nullptr,
                    L,
                    b.laws == nullptr,
                    0,
                    history.elapsed_s};
      if (b.laws && history.trial)
        for (int i = 0; i < b.history_size; ++i) remembered.trial[i * L] = remembered.before(i);
    }
    if (b.laws) {
      PointNumbers<double> own;
      double* at = reinterpret_cast<double*>(&own);
      for (int i = 0; i < kLawDoubles; ++i) at[i] = b.laws[(point * kLawDoubles + i) * L + lane_of];
      evaluateCarried(b.use, own, e, k, remembered, n, m);
    } else {
      evaluateCarried(b.use, *b.law, e, k, remembered, n, m);
    }
    tension = {n[0], n[1], n[2]};
    moment = {m[0], m[1], m[2]};
  }
};

/// to[i] = from[i].
struct CopyNumbers {
  const double* from;
  double* to;
  GAMBESON_HD void operator()(int i) const { to[i] = from[i]; }
};

/// The arrays of CellArrays on the host.
struct FlatCells {
  CellArrays shape{};
  const ShellBlock* block = nullptr;
  const BlockLaw* block_law = nullptr;
  std::vector<int> list;
  PointNumbers<double> law{};
};

/// f = - sum of its slots, of a control point that no sheet sums.
struct GatherSlots {
  const int* point;
  const int *first, *slot;
  const Vec3* value;
  Point4* force;
  GAMBESON_HD void operator()(int i) const {
    Vec3 sum{};
    const int at = point[i];
    for (int k = first[at]; k < first[at + 1]; ++k) sum += value[slot[k]];
    force[at] = {-sum.x, -sum.y, -sum.z, 0.0};
  }
};

}  // namespace gambeson::gpu
