#pragma once
/// Two ways through quadratic cells, which give the same bits: tiles where there are few, strips where there are many.
///
/// Both compute the cells around the control points that a block owns, those on the rim a second time, and keep what
/// each cell gives in shared memory; the owner of a control point adds its cells, rows first, along v and along u in
/// their order. A tile has all its cells at once: a chain of operations as short as can be. A strip goes along v with
/// the last rows of cells in shared memory: hardly any rim.

#include "gpu/device/prefetch.hpp"
#include "gpu/forces/quad_cell.hpp"

namespace gambeson::gpu {

/// What a block does: cells [cell_u, end_u) x [cell_v, end_v), and of them the sums of control points.
struct QuadWork {
  QuadSheet sheet;
  int cell_u, end_u, cell_v, end_v;
  int point_u, point_end_u, point_v, point_end_v;
};

/// Contributions that other elements have written for a control point: items [first[point], first[point + 1]) of slot.
struct MoreSlots {
  const int* first = nullptr;  ///< null: there are none
  const int* slot = nullptr;
  const Vec3* value = nullptr;
};

/// Component kC of f = - (w sum of the cells + sum of the rest) at a control point. `row(cj)` has the contributions of
/// a row of cells.
template <bool kRational, int kStride, int kC, class Row>
GAMBESON_HD void quadSum(const QuadSheets& s, const MoreSlots& more, const QuadSheet& sheet, int first_cell, int x,
                         int y, const Row& row) {
  const Touched across = s.touched_u[sheet.first_point_u + x], along = s.touched_v[sheet.first_point_v + y];
  double sum = 0;
  GAMBESON_UNROLL
  for (int b = 2; b >= 0; --b) {
    if (along.cell[b] < 0) continue;
    const double* cells = row(along.cell[b]) - first_cell;
    GAMBESON_UNROLL
    for (int a = 2; a >= 0; --a) {
      const QuadPlace place(a, b, kC);
      if (across.cell[a] >= 0) sum += cells[(place.at * 4 + place.lane) * kStride + across.cell[a]];
    }
  }
  const int point = sheet.first_point + x + sheet.points_u * y;
  if (kRational) sum *= s.position[point].w;
  if (more.first)
    for (int k = more.first[point]; k < more.first[point + 1]; ++k) {
      const Vec3& value = more.value[more.slot[k]];
      sum += kC == 0 ? value.x : kC == 1 ? value.y : value.z;
    }
  Point4& force = s.force[point];
  (kC == 0 ? force.x : kC == 1 ? force.y : force.z) = -sum;
}

/// All components at the control points [work.point_u, ..) x [first_v, end_v), by all lanes.
template <bool kRational, int kStride, class Group, class Row>
GAMBESON_HD void quadSums(const Group& group, const QuadSheets& s, const MoreSlots& more, const QuadSheet& sheet,
                          const QuadWork& work, int first_v, int end_v, const Row& row) {
  const int across = work.point_end_u - work.point_u, count = across * (end_v - first_v);
  group.each([&](int lane) {
    for (int k = lane; k < 3 * count; k += Group::kLanes) {
      const int c = k / count, x = work.point_u + (k - c * count) % across, y = first_v + (k - c * count) / across;
      if (c == 0)
        quadSum<kRational, kStride, 0>(s, more, sheet, work.cell_u, x, y, row);
      else if (c == 1)
        quadSum<kRational, kStride, 1>(s, more, sheet, work.cell_u, x, y, row);
      else
        quadSum<kRational, kStride, 2>(s, more, sheet, work.cell_u, x, y, row);
    }
  });
}

/// Control points that a block may need along a direction of so many cells: two more, and some where knots are double.
constexpr int roomFor(int cells) { return cells + 4; }

/// The numbers of a cell's points at rest, [number][4].
template <bool kRational>
GAMBESON_HD const double* restOf(const QuadSheets& s, const QuadSheet& sheet, int ci, int cj) {
  return s.rest + sheet.first_rest + (ci + static_cast<long>(sheet.cells_u) * cj) * (4 * restNumbers(kRational));
}
template <bool kRational>
GAMBESON_HD void prefetchRest(const double* rest, int g) {
  GAMBESON_UNROLL
  for (int k = 0; k < restNumbers(kRational); k += 4)
    if (k + g < restNumbers(kRational)) prefetch(rest + 4 * (k + g));
}

/// A control point as cells take it.
template <bool kRational>
GAMBESON_HD Point4 homogeneous(const Point4& p) {
  return kRational ? Point4{p.w * p.x, p.w * p.y, p.w * p.z, p.w} : p;
}

/// kU x kV cells at once.
template <int kU, int kV, int kBlocks>
struct QuadTile {
  static constexpr int kCellsU = kU, kCellsV = kV, kLanes = 4 * kU * kV, kResident = kBlocks;
  static constexpr int kStride = kU * kV + 4 + (16 - kU * kV % 16) % 16;  ///< 4 beyond 16s: no two lanes in one bank
  struct Shared {
    Point4 point[roomFor(kV)][roomFor(kU)];
    double cell[32 * kStride];
    double basis_u[18 * kU], basis_v[18 * kV];
    PlainNumbers law;
  };
  QuadSheets s;
  MoreSlots more;
  const QuadWork* works;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index) const {
    const QuadWork& work = works[index];
    const QuadSheet& sheet = work.sheet;
    sheet.rational ? run<true>(group, shared, work, sheet) : run<false>(group, shared, work, sheet);
  }

 private:
  template <bool kRational>
  struct Source {
    const QuadSheets& s;
    const QuadSheet& sheet;
    const QuadWork& work;
    const Shared& shared;
    GAMBESON_HD int u(int lane) const {
      const int at = (lane >> 2) % kU, last = work.end_u - work.cell_u - 1;
      return at < last ? at : last;
    }
    GAMBESON_HD int v(int lane) const {
      const int at = (lane >> 2) / kU, last = work.end_v - work.cell_v - 1;
      return at < last ? at : last;
    }
    GAMBESON_HD Vec3 node(int lane, int i, int j) const {
      const int* column = s.function_u + sheet.first_column + work.cell_u;
      const int* row = s.function_v + sheet.first_row + work.cell_v;
      return vec(shared.point[row[v(lane)] - row[0] + j][column[u(lane)] - column[0] + i]);
    }
    GAMBESON_HD const double* basisU(int lane) const { return shared.basis_u + (2 * u(lane) + (lane & 1)) * 9; }
    GAMBESON_HD const double* basisV(int lane) const { return shared.basis_v + (2 * v(lane) + (lane >> 1 & 1)) * 9; }
    GAMBESON_HD double rest(int lane, int k) const {
      return restOf<kRational>(s, sheet, work.cell_u + u(lane), work.cell_v + v(lane))[4 * k + (lane & 3)];
    }
  };

  template <bool kRational, class Group>
  GAMBESON_HD void run(const Group& group, Shared& shared, const QuadWork& work, const QuadSheet& sheet) const {
    const int column = sheet.first_column + work.cell_u, row = sheet.first_row + work.cell_v,
              cells_u = work.end_u - work.cell_u, cells_v = work.end_v - work.cell_v;
    const int first_u = s.function_u[column], first_v = s.function_v[row],
              across = s.function_u[column + cells_u - 1] + 3 - first_u,
              along = s.function_v[row + cells_v - 1] + 3 - first_v;
    const Source<kRational> source{s, sheet, work, shared};
    group.each([&](int lane) {
      prefetchRest<kRational>(restOf<kRational>(s, sheet, work.cell_u + source.u(lane), work.cell_v + source.v(lane)),
                              lane & 3);
      for (int k = lane; k < across * along; k += kLanes) {
        const int x = k % across, y = k / across;
        shared.point[y][x] = homogeneous<kRational>(
            s.position[sheet.first_point + first_u + x + static_cast<long>(sheet.points_u) * (first_v + y)]);
      }
      if (lane == 0) shared.law = s.laws[sheet.law];
      for (int k = lane; k < 18 * cells_u; k += kLanes) shared.basis_u[k] = s.basis_u[18 * column + k];
      for (int k = lane; k < 18 * cells_v; k += kLanes) shared.basis_v[k] = s.basis_v[18 * row + k];
    });
    group.sync();
    quadCells<kRational>(group, shared.law, source, [&](int lane, int k, double value) {
      shared.cell[(k * 4 + (lane & 3)) * kStride + (lane >> 2)] = value;
    });
    group.sync();
    quadSums<kRational, kStride>(group, s, more, sheet, work, work.point_v, work.point_end_v,
                                 [&](int cj) { return shared.cell + kU * (cj - work.cell_v); });
  }
};

/// kU cells across, row after row.
template <int kU, int kBlocks>
struct QuadStrip {
  static constexpr int kCellsU = kU, kLanes = 4 * kU, kResident = kBlocks, kStride = kU + 4;
  static_assert(kStride % 16 == 4);
  struct Shared {
    Point4 point[8][roomFor(kU)];  ///< rows of control points: those of a row of cells, and of the next
    double cell[4][32 * kStride];  ///< rows of cells: the three that a control point may have, and the next
    double basis_u[18 * kU], basis_v[2][18];
    PlainNumbers law;
  };
  QuadSheets s;
  MoreSlots more;
  const QuadWork* works;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index) const {
    const QuadWork& work = works[index];
    const QuadSheet& sheet = work.sheet;
    sheet.rational ? run<true>(group, shared, work, sheet) : run<false>(group, shared, work, sheet);
  }

 private:
  template <bool kRational>
  struct Source {
    const QuadSheets& s;
    const QuadSheet& sheet;
    const QuadWork& work;
    const Shared& shared;
    int cj, row;  ///< of cells; its first of control points
    GAMBESON_HD int u(int lane) const {
      const int at = lane >> 2, last = work.end_u - work.cell_u - 1;
      return at < last ? at : last;
    }
    GAMBESON_HD Vec3 node(int lane, int i, int j) const {
      const int* column = s.function_u + sheet.first_column + work.cell_u;
      return vec(shared.point[(row + j) & 7][column[u(lane)] - column[0] + i]);
    }
    GAMBESON_HD const double* basisU(int lane) const { return shared.basis_u + (2 * u(lane) + (lane & 1)) * 9; }
    GAMBESON_HD const double* basisV(int lane) const { return shared.basis_v[cj & 1] + 9 * (lane >> 1 & 1); }
    GAMBESON_HD double rest(int lane, int k) const {
      return restOf<kRational>(s, sheet, work.cell_u + u(lane), cj)[4 * k + (lane & 3)];
    }
  };

  /// What the row cj of cells needs beyond the rows of control points before `from`.
  template <bool kRational, class Group>
  GAMBESON_HD void load(const Group& group, Shared& shared, const QuadWork& work, const QuadSheet& sheet, int cj,
                        int from) const {
    const int column = sheet.first_column + work.cell_u, first_u = s.function_u[column],
              across = s.function_u[column + work.end_u - work.cell_u - 1] + 3 - first_u,
              end = s.function_v[sheet.first_row + cj] + 3;
    const Point4* at = s.position + sheet.first_point + first_u;
    group.each([&](int lane) {
      const int ci = work.cell_u + (lane >> 2);
      if (ci < work.end_u) prefetchRest<kRational>(restOf<kRational>(s, sheet, ci, cj), lane & 3);
      for (int y = from; y < end; ++y)
        for (int x = lane; x < across; x += kLanes)
          shared.point[y & 7][x] = homogeneous<kRational>(at[x + static_cast<long>(sheet.points_u) * y]);
      for (int k = lane; k < 18; k += kLanes) shared.basis_v[cj & 1][k] = s.basis_v[18 * (sheet.first_row + cj) + k];
    });
  }

  template <bool kRational, class Group>
  GAMBESON_HD void run(const Group& group, Shared& shared, const QuadWork& work, const QuadSheet& sheet) const {
    group.each([&](int lane) {
      if (lane == 0) shared.law = s.laws[sheet.law];
      const double* from = s.basis_u + 18 * (sheet.first_column + work.cell_u);
      for (int k = lane; k < 18 * (work.end_u - work.cell_u); k += kLanes) shared.basis_u[k] = from[k];
    });
    int row = s.function_v[sheet.first_row + work.cell_v];
    load<kRational>(group, shared, work, sheet, work.cell_v, row);
    group.sync();
    int next = work.point_v;  // row of control points to be summed
    for (int cj = work.cell_v; cj < work.end_v; ++cj) {
      if (cj + 1 < work.end_v) load<kRational>(group, shared, work, sheet, cj + 1, row + 3);
      quadCells<kRational>(group, shared.law, Source<kRational>{s, sheet, work, shared, cj, row},
                           [&](int lane, int k, double value) {
                             shared.cell[cj & 3][(k * 4 + (lane & 3)) * kStride + (lane >> 2)] = value;
                           });
      group.sync();
      int end = next;
      while (end < work.point_end_v && s.touched_v[sheet.first_point_v + end].last <= cj) ++end;
      if (end > next)
        quadSums<kRational, kStride>(group, s, more, sheet, work, next, end,
                                     [&](int of) { return shared.cell[of & 3]; });
      next = end;
      if (cj + 1 < work.end_v) row = s.function_v[sheet.first_row + cj + 1];
    }
  }
};

}  // namespace gambeson::gpu
