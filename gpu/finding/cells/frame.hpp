#pragma once
/// Space cut into cells along x, y and z. Which cells a box covers follows from any mapping of coordinates that never
/// falls: what lies outside counts to the cells at the sides, so that a pair is found whatever the cells are.

#include "gpu/device/list.hpp"
#include "gpu/device/unroll.hpp"
#include "gpu/finding/cells/owners.hpp"
#include "gpu/finding/float_box.hpp"

namespace gambeson::gpu {

constexpr int kMostCellBits = 10;  ///< along an axis

/// From the first to the last cell along each axis, of the finest cells; coarser ones by shifting.
struct alignas(4) CellRange {
  std::uint16_t lo[3], hi[3];

  GAMBESON_HD Count cells(int coarser) const {
    Count n = 1;
    for (int k = 0; k < 3; ++k) n *= static_cast<Count>((hi[k] >> coarser) - (lo[k] >> coarser) + 1);
    return n;
  }
  /// The cell at that place among them, x first.
  GAMBESON_HD void cell(int coarser, Count place, int (&at)[3]) const {
    auto left = static_cast<std::uint32_t>(place);
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t first = lo[k] >> coarser, n = (hi[k] >> coarser) - first + 1;
      at[k] = static_cast<int>(first + left % n);
      left /= n;
    }
  }
  GAMBESON_HD bool has(int coarser, const int (&at)[3]) const {
    bool inside = true;
    for (int k = 0; k < 3; ++k) inside &= (lo[k] >> coarser) <= at[k] && at[k] <= (hi[k] >> coarser);
    return inside;
  }
};

/// Numbers that sort as the floats do.
GAMBESON_HD inline std::uint32_t sortable(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}
GAMBESON_HD inline float fromSortable(std::uint32_t key) {
  return std::bit_cast<float>((key & 0x80000000u) != 0 ? key & 0x7fffffffu : ~key);
}

/// What all triangles together are, gathered without an order: least and largest numbers, and a sum of integers.
struct Extent {
  std::uint32_t lo[3], hi[3];  ///< sortable
  std::uint32_t largest_radius;
  Count radius_sum;  ///< in parts of a length that the search was made with
};

/// How space is cut in this step.
struct CellFrame {
  float lo[3];
  float cells_per_m;                  ///< of the finest cells
  int coarser;                        ///< by how many bits the cells that are taken are coarser
  float radius_m;                     ///< a third of the length of such a cell
  Count cells_of[kMostCellBits + 1];  ///< of all triangles together, for each such number of bits

  GAMBESON_HD int at(float x, int axis, int bits) const {
    const float most = static_cast<float>((1 << bits) - 1);
    const float place = (x - lo[axis]) * cells_per_m;
    return static_cast<int>(place > 0 ? (place < most ? place : most) : 0.0f);
  }
  GAMBESON_HD CellRange range(const FloatBox& box, int bits) const {
    CellRange r{};
    for (int k = 0; k < 3; ++k) {
      r.lo[k] = static_cast<std::uint16_t>(at(box.lo[k], k, bits));
      r.hi[k] = static_cast<std::uint16_t>(at(box.hi[k], k, bits));
    }
    return r;
  }
};

/// Of the sphere around a box.
GAMBESON_HD inline float radiusOf(const FloatBox& box) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double side = static_cast<double>(box.hi[k]) - static_cast<double>(box.lo[k]);
    square += side * side;
  }
  return static_cast<float>(0.5 * std::sqrt(square));
}

struct ClearExtent {
  Extent* extent;
  CellFrame* frame;

  GAMBESON_HD void operator()(int) const {
    *extent = {{~0u, ~0u, ~0u}, {0, 0, 0}, 0, 0};
    *frame = CellFrame{};
  }
};

/// Boxes of triangles over the step, and what they are together.
struct MeasureOwners {
  static constexpr int kResident = 32;
  static constexpr int kOfGroup = 512;
  struct Shared {
    Extent of_lane[32];
  };

  const Owner* owner;
  int owners;
  const FloatBox* vertex_box;
  float parts_per_m;
  FloatBox* box;
  Extent* extent;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int) const {
    group.each([&](int lane) {
      Extent mine{{~0u, ~0u, ~0u}, {0, 0, 0}, 0, 0};
      const int end = std::min(owners, (index + 1) * int{kOfGroup});
      for (int i = index * int{kOfGroup} + lane; i < end; i += Group::kLanes) {
        const int* corner = owner[i].corner;
        box[i] = joined(joined(vertex_box[corner[0]], vertex_box[corner[1]]), vertex_box[corner[2]]);
        add(mine, box[i]);
      }
      shared.of_lane[lane] = mine;
    });
    group.sync();
    group.once([&] {
      Extent all = shared.of_lane[0];
      for (int lane = 1; lane < Group::kLanes; ++lane) join(all, shared.of_lane[lane]);
      for (int k = 0; k < 3; ++k) {
        fetchMin(&extent->lo[k], all.lo[k]);
        fetchMax(&extent->hi[k], all.hi[k]);
      }
      fetchMax(&extent->largest_radius, all.largest_radius);
      return fetchAdd(&extent->radius_sum, all.radius_sum);
    });
  }

 private:
  GAMBESON_HD void add(Extent& to, const FloatBox& b) const {
    const float radius = radiusOf(b);
    const double parts = static_cast<double>(radius) * parts_per_m;
    join(to, {{sortable(b.lo[0]), sortable(b.lo[1]), sortable(b.lo[2])},
              {sortable(b.hi[0]), sortable(b.hi[1]), sortable(b.hi[2])},
              sortable(radius),
              static_cast<Count>(parts < 0x1p40 ? parts : 0x1p40)});
  }
  GAMBESON_HD static void join(Extent& to, const Extent& with) {
    for (int k = 0; k < 3; ++k) {
      to.lo[k] = with.lo[k] < to.lo[k] ? with.lo[k] : to.lo[k];
      to.hi[k] = with.hi[k] > to.hi[k] ? with.hi[k] : to.hi[k];
    }
    to.largest_radius = with.largest_radius > to.largest_radius ? with.largest_radius : to.largest_radius;
    to.radius_sum += with.radius_sum;
  }
};

/// The finest cells: so many along the longest side of all, or of a length from the triangles' radii, the larger.
struct ChooseFinest {
  const Extent* extent;
  int owners, bits;
  double mean_radii, largest_radii;  ///< a cell's length in mean and in largest radii; both 0: by the bits alone
  double parts_per_m;
  CellFrame* frame;

  GAMBESON_HD void operator()(int) const {
    double side = 0;
    for (int k = 0; k < 3; ++k) {
      frame->lo[k] = fromSortable(extent->lo[k]);
      const double here = static_cast<double>(fromSortable(extent->hi[k])) - static_cast<double>(frame->lo[k]);
      side = here > side ? here : side;
    }
    const double mean = static_cast<double>(extent->radius_sum) / parts_per_m / owners;
    const double largest = static_cast<double>(fromSortable(extent->largest_radius));
    double cell = side / (1 << bits);
    cell = mean_radii * mean > cell ? mean_radii * mean : cell;
    cell = largest_radii * largest > cell ? largest_radii * largest : cell;
    frame->cells_per_m = cell > 1e-30 ? static_cast<float>(1 / cell) : 0.0f;
    frame->radius_m = static_cast<float>(cell / 3);
  }
};

/// Which of the finest cells each triangle covers, and how many of coarser ones all do.
struct PlaceOwners {
  static constexpr int kResident = 32;
  static constexpr int kOfGroup = 512;
  struct Shared {
    Count cells_of[kMostCellBits + 1];
  };

  const FloatBox* box;
  int owners, bits;
  CellFrame* frame;
  CellRange* range;

  template <class Group>
  GAMBESON_HD void operator()(const Group& group, Shared& shared, int index, int) const {
    group.each([&](int lane) {
      for (int k = lane; k <= kMostCellBits; k += Group::kLanes) shared.cells_of[k] = 0;
    });
    group.sync();
    group.each([&](int lane) {
      Count mine[kMostCellBits + 1] = {};
      const int end = std::min(owners, (index + 1) * int{kOfGroup});
      for (int i = index * int{kOfGroup} + lane; i < end; i += Group::kLanes) {
        const CellRange r = frame->range(box[i], bits);
        range[i] = r;
        GAMBESON_UNROLL
        for (int k = 0; k <= kMostCellBits; ++k) mine[k] += r.cells(k);
      }
      GAMBESON_UNROLL
      for (int k = 0; k <= kMostCellBits; ++k) fetchAdd(&shared.cells_of[k], mine[k]);
    });
    group.sync();
    group.each([&](int lane) {
      for (int k = lane; k <= kMostCellBits; k += Group::kLanes) fetchAdd(&frame->cells_of[k], shared.cells_of[k]);
    });
  }
};

/// The finest cells of which all triangles together cover no more than `most`.
struct ChooseCoarser {
  int bits;
  Count most;
  CellFrame* frame;

  GAMBESON_HD void operator()(int) const {
    while (frame->coarser < bits && frame->cells_of[frame->coarser] > most) {
      ++frame->coarser;
      frame->radius_m *= 2;
    }
  }
};

/// Of each triangle, of the cells that are taken; nothing behind the last, for the sum of all.
struct CountCells {
  const CellRange* range;
  const CellFrame* frame;
  int owners;
  Count* cells;

  GAMBESON_HD void operator()(int i) const { cells[i] = i < owners ? range[i].cells(frame->coarser) : 0; }
};

}  // namespace gambeson::gpu
