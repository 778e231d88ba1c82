#pragma once
/// A quadratic cell with 2 x 2 points on four lanes, a lane a point.
///
/// The sum over the points is one tree whatever runs it: what the two points of a row give to the functions of u is
/// added, then taken to the nodes by the functions of v, and the two rows are added. Lanes exchange halves, so that
/// each ends with a quarter of the cell's 27 numbers.

#include "gpu/device/unroll.hpp"
#include "gpu/forces/shell_point.hpp"

namespace gambeson::gpu {

/// Patches of quadratic cells as the kernels see them; all arrays of one after the other, `first_*` say where.
struct QuadSheet {
  int cells_u, cells_v, points_u, points_v;
  int first_point;                   ///< of the control points
  int first_column, first_row;       ///< of cells: bases and first functions
  int first_point_u, first_point_v;  ///< of control points: which cells they touch
  int law;
  long first_rest;
  int rational;
};

/// Of a point of a cell: G and the area, and of rational cells 1/w and the derivatives of w.
GAMBESON_HD constexpr int restNumbers(bool rational) { return rational ? 11 : 5; }

/// The cells along one direction that have a control point: cell[a] has it as its function a; -1: none.
struct Touched {
  int cell[3];
  int last;  ///< of these cells
};

struct QuadSheets {
  const int *function_u, *function_v;    ///< of each column, row of cells: its first control point
  const double *basis_u, *basis_v;       ///< of each column, row: [point][derivative][function]
  const Touched *touched_u, *touched_v;  ///< of each column, row of control points
  const double* rest;                    ///< of each sheet: [cell][number][4]
  const Point4* position;
  Point4* force;
  const PlainNumbers* laws;
};

struct Lane15 {
  double at[15];
};
struct Lane8 {
  double at[8];
};

/// Where the number of node (i, j), component c, ends: with which lane of the cell, and in which place there.
struct QuadPlace {
  int lane, at;
  GAMBESON_HD QuadPlace(int i, int j, int c) {
    const int pair = 3 * i + c, odd = pair >= 5, q = 3 * (odd ? pair - 5 : pair) + j, high = q >= 8;
    lane = odd + 2 * high;
    at = q - 8 * high;
  }
};

/// Forces on the derivatives of the numerator, and on itself.
struct NumeratorForces {
  SurfaceTerms of;
  Vec3 g0;
};

/// `node(i, j)`: a control point, of rational cells times its weight; bu, bv: [derivative][function]; `rest(k)`: number
/// k of the point.
template <bool kRational, class Node, class Rest>
GAMBESON_HD NumeratorForces quadPoint(const Node& node, const double* bu, const double* bv, const Rest& rest,
                                      const PlainNumbers& law) {
  Vec3 x0{};
  SurfaceTerms x{};
  GAMBESON_UNROLL
  for (int i = 0; i < 3; ++i) {
    Vec3 y0{}, y1{}, y2{};
    GAMBESON_UNROLL
    for (int j = 0; j < 3; ++j) {
      const Vec3 q = node(i, j);
      const double v0 = bv[j], v1 = bv[3 + j], v2 = bv[6 + j];
      y0 = fma(v0, q, y0);
      y1 = fma(v1, q, y1);
      y2 = fma(v2, q, y2);
    }
    const double u0 = bu[i], u1 = bu[3 + i], u2 = bu[6 + i];
    if (kRational) x0 = fma(u0, y0, x0);
    x.of1 = fma(u1, y0, x.of1);
    x.of2 = fma(u0, y1, x.of2);
    x.of11 = fma(u2, y0, x.of11);
    x.of22 = fma(u0, y2, x.of22);
    x.of12 = fma(u1, y1, x.of12);
  }
  Denominator d{};
  if (kRational) {
    d = {rest(5), rest(6), rest(7), rest(8), rest(9), rest(10)};
    x = divided(d, x0, x);
  }
  const SurfaceTerms f = shellForces(x, RestPoint{rest(0), rest(1), rest(2), rest(3), rest(4)},
                                     [&](const Voigt3& strain, const Voigt3& bend, Voigt3& tension, Voigt3& moment) {
                                       tension = tensionOf(law, strain);
                                       moment = momentOf(law, bend);
                                     });
  NumeratorForces out{f, {}};
  if (kRational) out.of = dividedBack(d, f, out.g0);
  return out;
}

/// What the point gives to the functions of u: z[derivative of v][3 i + component].
template <bool kRational>
GAMBESON_HD void quadColumns(const NumeratorForces& forces, const double* bu, double (&z)[3][9]) {
  const SurfaceTerms& f = forces.of;
  GAMBESON_UNROLL
  for (int i = 0; i < 3; ++i) {
    const double u0 = bu[i], u1 = bu[3 + i], u2 = bu[6 + i];
    Vec3 z0 = fma(u2, f.of11, u1 * f.of1);
    if (kRational) z0 = fma(u0, forces.g0, z0);
    const Vec3 z1 = fma(u1, f.of12, u0 * f.of2), z2 = u0 * f.of22;
    z[0][3 * i] = z0.x, z[0][3 * i + 1] = z0.y, z[0][3 * i + 2] = z0.z;
    z[1][3 * i] = z1.x, z[1][3 * i + 1] = z1.y, z[1][3 * i + 2] = z1.z;
    z[2][3 * i] = z2.x, z[2][3 * i + 1] = z2.y, z[2][3 * i + 2] = z2.z;
  }
}

/// Cells in the lanes of a group, four lanes each. `source` gives the nodes, bases and point at rest of a lane's cell
/// (lanes too many do a cell once more); `store(lane, at, value)` takes what each lane ends with.
template <bool kRational, class Group, class Source, class Store>
GAMBESON_HD void quadCells(const Group& group, const PlainNumbers& law, const Source& source, const Store& store) {
  // Bases are read anew for what is given back: registers are scarce in between.
  typename Group::template PerLane<NumeratorForces> forces;
  group.each([&](int lane) {
    forces[lane] = quadPoint<kRational>([&](int i, int j) { return source.node(lane, i, j); }, source.basisU(lane),
                                        source.basisV(lane), [&](int k) { return source.rest(lane, k); }, law);
  });
  typename Group::template PerLane<Lane15> kept, sent;
  group.each([&](int lane) {
    double z[3][9];
    quadColumns<kRational>(forces[lane], source.basisU(lane), z);
    const bool odd = lane & 1;
    GAMBESON_UNROLL
    for (int p = 0; p < 5; ++p) GAMBESON_UNROLL
    for (int d = 0; d < 3; ++d) {
      const double low = z[d][p], high = p < 4 ? z[d][p + 5] : 0.0;
      kept[lane].at[3 * p + d] = odd ? high : low;
      sent[lane].at[3 * p + d] = odd ? low : high;
    }
  });
  group.exchange(sent, 1);
  typename Group::template PerLane<Lane8> kept8, sent8;
  group.each([&](int lane) {
    const double* bv = source.basisV(lane);
    double v[16];
    GAMBESON_UNROLL
    for (int p = 0; p < 5; ++p) {
      double Z[3];
      GAMBESON_UNROLL
      for (int d = 0; d < 3; ++d) Z[d] = kept[lane].at[3 * p + d] + sent[lane].at[3 * p + d];
      GAMBESON_UNROLL
      for (int j = 0; j < 3; ++j) v[3 * p + j] = ::fma(bv[6 + j], Z[2], ::fma(bv[3 + j], Z[1], bv[j] * Z[0]));
    }
    v[15] = 0;
    const bool high = lane & 2;
    GAMBESON_UNROLL
    for (int k = 0; k < 8; ++k) {
      kept8[lane].at[k] = high ? v[8 + k] : v[k];
      sent8[lane].at[k] = high ? v[k] : v[8 + k];
    }
  });
  group.exchange(sent8, 2);
  group.each([&](int lane) {
    GAMBESON_UNROLL
    for (int k = 0; k < 8; ++k) store(lane, k, kept8[lane].at[k] + sent8[lane].at[k]);
  });
}

}  // namespace gambeson::gpu
