#pragma once
/// An octree of cells, cut finer where that makes fewer tests (Wong 2014, chapter 6): all levels are whole grids of
/// counters, a base level is chosen by how many of its cells the triangles cover, two stages say which cells are
/// leaves, and each triangle is registered once in each leaf that it covers.

#include "gpu/finding/cells/lists.hpp"
#include "gpu/finding/cells/measured.hpp"

namespace gambeson::gpu {

constexpr int kTopLevel = 2, kMostLevels = 8;  ///< level l has 8^l cells

/// Where level l begins among all cells: (8^l - 1) / 7.
GAMBESON_HD inline int levelBegin(int level) { return static_cast<int>(((1u << 3 * level) - 1) / 7); }
GAMBESON_HD inline int inLevel(int level, const int (&at)[3]) { return at[0] | at[1] << level | at[2] << 2 * level; }
/// Sorts by level, then by place.
GAMBESON_HD inline std::uint32_t leafCell(int level, const int (&at)[3]) {
  return static_cast<std::uint32_t>(level << 24 | inLevel(level, at));
}

/// How many triangles cover a cell; of cells above the base level afterwards the tests that are made within it, with
/// the sign set where they are made in smaller cells. In single precision: only which is less counts.
union OctreeCell {
  std::uint32_t covering;
  float tests;
};

GAMBESON_HD inline bool isCut(const OctreeCell& above_base) {
  return (std::bit_cast<std::uint32_t>(above_base.tests) & 0x80000000u) != 0;
}

/// The levels in use.
struct Octree {
  OctreeCell* cell;
  const CellFrame* frame;
  int levels;  ///< the finest level of all; the base is coarser by what the frame says

  GAMBESON_HD int base() const { return levels - frame->coarser; }

  /// The leaf that holds a cell of the base level: the highest one on the way down to it.
  GAMBESON_HD int leafLevel(const int (&at_base)[3]) const {
    const int base = this->base();
    for (int level = std::min(int{kTopLevel}, base); level < base; ++level) {
      int at[3];
      for (int k = 0; k < 3; ++k) at[k] = at_base[k] >> (base - level);
      if (!isCut(cell[levelBegin(level) + inLevel(level, at)])) return level;
    }
    return base;
  }
};

/// A cell of the base level that a triangle covers stands for it in a larger cell where it has the low corner of what
/// they have in common (the token position of Fan and others 2011).
GAMBESON_HD inline bool standsIn(const int (&at_base)[3], const CellRange& range, int coarser, int up) {
  bool stands = true;
  for (int k = 0; k < 3; ++k) stands &= at_base[k] == range.lo[k] >> coarser || (at_base[k] & ((1 << up) - 1)) == 0;
  return stands;
}

/// How many triangles cover each cell of each level, from the base up.
struct CountCovering {
  static constexpr int kResident = 32;
  struct Shared {};

  Octree tree;
  const CellRange* range;

  template <class Group>
  GAMBESON_HD void piece(const Group& group, Shared&, const typename Group::template PerLane<bool>& on,
                         const typename Group::template PerLane<int>& row,
                         const typename Group::template PerLane<Count>& place, int&) const {
    group.each([&](int lane) {
      if (!on[lane]) return;
      const CellRange r = range[row[lane]];
      const int coarser = tree.frame->coarser, base = tree.base();
      int at[3];
      r.cell(coarser, place[lane], at);
      for (int level = base; level >= std::min(int{kTopLevel}, base); --level) {
        const int up = base - level;
        if (!standsIn(at, r, coarser, up)) return;
        const int larger[3] = {at[0] >> up, at[1] >> up, at[2] >> up};
        fetchAdd(&tree.cell[levelBegin(level) + inLevel(level, larger)].covering, 1u);
      }
    });
  }
  template <class Group>
  GAMBESON_HD void end(const Group&, Shared&, int&) const {}
};

/// From the base up: a cell is cut where the tests in the eight smaller ones are fewer, whatever these are.
struct MergeCells {
  Octree tree;
  int level;

  GAMBESON_HD void operator()(int i) const {
    const int base = tree.base();
    if (level >= base) return;
    OctreeCell& cell = tree.cell[levelBegin(level) + i];
    const int mask = (1 << level) - 1;
    const int at[3] = {i & mask, i >> level & mask, i >> 2 * level};
    float below = 0;
    for (int part = 0; part < 8; ++part) {
      const int smaller[3] = {2 * at[0] + (part & 1), 2 * at[1] + (part >> 1 & 1), 2 * at[2] + (part >> 2)};
      const OctreeCell& child = tree.cell[levelBegin(level + 1) + inLevel(level + 1, smaller)];
      below += level + 1 == base ? tests(child.covering) : std::abs(child.tests);
    }
    const float here = tests(cell.covering);
    cell.tests = below < here ? -below : here;
  }

 private:
  GAMBESON_HD static float tests(std::uint32_t covering) {
    return static_cast<float>(0.5 * covering * (covering - 1.0));
  }
};

struct RegisterInLeaves {
  static constexpr int kResident = 32;
  struct Shared {};

  Octree tree;
  const CellRange* range;
  Registrations to;

  template <class Group>
  GAMBESON_HD void piece(const Group& group, Shared&, const typename Group::template PerLane<bool>& on,
                         const typename Group::template PerLane<int>& row,
                         const typename Group::template PerLane<Count>& place, int&) const {
    typename Group::template PerLane<bool> stands;
    typename Group::template PerLane<std::uint32_t> leaf;
    group.each([&](int lane) {
      stands[lane] = false;
      if (!on[lane]) return;
      const CellRange r = range[row[lane]];
      const int coarser = tree.frame->coarser;
      int at[3];
      r.cell(coarser, place[lane], at);
      const int level = tree.leafLevel(at), up = tree.base() - level;
      stands[lane] = standsIn(at, r, coarser, up);
      const int larger[3] = {at[0] >> up, at[1] >> up, at[2] >> up};
      leaf[lane] = leafCell(level, larger);
    });
    to.append(group, stands, leaf, row);
  }
  template <class Group>
  GAMBESON_HD void end(const Group&, Shared&, int&) const {}
};

/// The leaf that holds the low corner of what two boxes have in common: each of both covers it.
struct InLowCornerLeaf {
  const CellRange* range;
  int levels;

  GAMBESON_HD bool testedIn(std::uint32_t cell, int a, int b) const {
    const CellRange r = range[a], s = range[b];
    const int level = static_cast<int>(cell >> 24), up = levels - level;
    int at[3];
    for (int k = 0; k < 3; ++k) at[k] = std::max(r.lo[k], s.lo[k]) >> up;
    return leafCell(level, at) == cell;
  }
};

template <class Device>
class OctreeCells {
 public:
  using Queue = typename Device::Queue;
  using Rule = InLowCornerLeaf;
  static constexpr int kKeyBits = 29;  ///< one more: what is no cell comes last

  explicit OctreeCells(MeasuredOwners<Device>& owners)
      : owners_(owners), levels_(levelsFor(owners.count())), cell_(static_cast<std::size_t>(levelBegin(levels_ + 1))) {}

  Stages<Device> stages(const std::function<Registrations()>& to) {
    return {{"cells", [this](Queue& queue) { owners_.frame(queue, levels_, 0, 0); }},
            {"counts of cells",
             [this](Queue& queue) {
               queue.zero(cell_);
               queue.forResidentGroups(DealOut<CountCovering>{owners_.shares(), {tree(), owners_.range()}});
             }},
            {"leaves",
             [this](Queue& queue) {
               for (int level = levels_ - 1; level >= kTopLevel; --level)
                 queue.forEach(1 << 3 * level, MergeCells{tree(), level});
             }},
            {"registrations", [this, to](Queue& queue) {
               queue.forResidentGroups(DealOut<RegisterInLeaves>{owners_.shares(), {tree(), owners_.range(), to()}});
             }}};
  }
  Rule rule() { return {owners_.range(), levels_}; }
  static int levelOf(std::uint32_t cell) { return static_cast<int>(cell >> 24); }
  std::size_t bytes() const { return bytesOf(cell_); }

 private:
  /// So that a sheet across all of it has four triangles a cell.
  static int levelsFor(int owners) {
    int levels = kTopLevel;
    while (levels < kMostLevels && (4 << 2 * levels) < owners) ++levels;
    return levels;
  }
  Octree tree() { return {cell_.data(), owners_.frame(), levels_}; }

  MeasuredOwners<Device>& owners_;
  int levels_;
  typename Device::template Buffer<OctreeCell> cell_;
};

}  // namespace gambeson::gpu
