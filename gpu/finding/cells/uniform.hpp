#pragma once
/// One size of cells, after the triangles' bounding spheres (Wong 2014, chapter 5: virtual subdivision), or after the
/// largest of them (section 3.3.1: a plain grid).

#include "gpu/finding/cells/lists.hpp"
#include "gpu/finding/cells/measured.hpp"
#include "gpu/finding/cells/pieces.hpp"

namespace gambeson::gpu {

enum class CellSize { ofMean, ofLargest };

/// 3 lambda radii (eq. 5.1). Of the largest: 1.5 diameters.
constexpr double kCellRadii = 3, kLambda = 1.2;

GAMBESON_HD inline std::uint32_t uniformCell(const int (&at)[3]) {
  return static_cast<std::uint32_t>(at[0] | at[1] << kMostCellBits | at[2] << 2 * kMostCellBits);
}

/// The cell that holds the low corner of what two boxes have in common: each of both covers it.
struct InLowCorner {
  const CellFrame* frame;
  const CellRange* range;

  GAMBESON_HD bool testedIn(std::uint32_t cell, int a, int b) const {
    const CellRange r = range[a], s = range[b];
    int at[3];
    for (int k = 0; k < 3; ++k) at[k] = std::max(r.lo[k], s.lo[k]) >> frame->coarser;
    return uniformCell(at) == cell;
  }
};

/// The first cell that pieces of both cover.
struct InFirstCommon {
  Pieces pieces;

  GAMBESON_HD bool testedIn(std::uint32_t cell, int a, int b) const {
    const CellRange r = pieces.range[a], s = pieces.range[b];
    const int coarser = pieces.frame->coarser;
    int lo[3], hi[3], at[3];
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::max(r.lo[k], s.lo[k]) >> coarser;
      hi[k] = std::min(r.hi[k], s.hi[k]) >> coarser;
    }
    for (at[2] = lo[2]; at[2] <= hi[2]; ++at[2])
      for (at[1] = lo[1]; at[1] <= hi[1]; ++at[1])
        for (at[0] = lo[0]; at[0] <= hi[0]; ++at[0]) {
          if (uniformCell(at) == cell) return true;
          if (pieces.cover(a, at) && pieces.cover(b, at)) return false;
        }
    return false;
  }
};

template <bool kPieces>
struct RegisterInCells {
  static constexpr int kResident = 32;
  struct Shared {};

  Pieces pieces;
  Registrations to;

  template <class Group>
  GAMBESON_HD void piece(const Group& group, Shared&, const typename Group::template PerLane<bool>& on,
                         const typename Group::template PerLane<int>& row,
                         const typename Group::template PerLane<Count>& place, int&) const {
    typename Group::template PerLane<bool> covers;
    typename Group::template PerLane<std::uint32_t> cell;
    group.each([&](int lane) {
      covers[lane] = false;
      if (!on[lane]) return;
      int at[3];
      pieces.range[row[lane]].cell(pieces.frame->coarser, place[lane], at);
      covers[lane] = !kPieces || pieces.cover(row[lane], at);
      cell[lane] = uniformCell(at);
    });
    to.append(group, covers, cell, row);
  }
  template <class Group>
  GAMBESON_HD void end(const Group&, Shared&, int&) const {}
};

/// kPieces: of triangles that are large for their cells only the pieces are registered.
template <class Device, CellSize kSize, bool kPieces>
class UniformCells {
 public:
  using Queue = typename Device::Queue;
  using Rule = std::conditional_t<kPieces, InFirstCommon, InLowCorner>;
  static constexpr int kKeyBits = 3 * kMostCellBits + 1;  ///< one more: what is no cell comes last

  explicit UniformCells(MeasuredOwners<Device>& owners) : owners_(owners) {}

  Stages<Device> stages(const std::function<Registrations()>& to) {
    return {{"cells",
             [this](Queue& queue) {
               constexpr double kRadii = kCellRadii * kLambda;
               owners_.frame(queue, kMostCellBits, kSize == CellSize::ofMean ? kRadii : 0,
                             kSize == CellSize::ofMean ? 0 : kCellRadii);
             }},
            {"registrations", [this, to](Queue& queue) {
               queue.forResidentGroups(DealOut<RegisterInCells<kPieces>>{owners_.shares(), {pieces(), to()}});
             }}};
  }
  Rule rule() {
    if constexpr (kPieces)
      return {pieces()};
    else
      return {owners_.frame(), owners_.range()};
  }
  static int levelOf(std::uint32_t) { return 0; }
  std::size_t bytes() const { return 0; }

 private:
  Pieces pieces() {
    return {owners_.owner(), owners_.box(),   owners_.point(), owners_.margin(),
            owners_.frame(), owners_.range(), kMostCellBits};
  }

  MeasuredOwners<Device>& owners_;
};

}  // namespace gambeson::gpu
