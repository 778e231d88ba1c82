#pragma once
/// Large triangles cut into four, again and again, until they are small for their cells (Loop's scheme; Wong 2014,
/// section 5.3.2): a triangle then covers the cells of its pieces alone, not all of its box.

#include "gpu/finding/cells/frame.hpp"

namespace gambeson::gpu {

constexpr int kMostCuts = 4;

struct Pieces {
  const Owner* owner;
  const FloatBox* box;
  const MovingPoint* point;
  float margin_m;
  const CellFrame* frame;
  const CellRange* range;
  int bits;  ///< of the finest cells

  /// Whether a piece of the triangle covers the cell: always the same for the same two. Pieces that are cut are not
  /// kept: they come anew from the corners.
  GAMBESON_HD bool cover(int of, const int (&cell)[3]) const {
    if (!range[of].has(frame->coarser, cell)) return false;
    if (!(radiusOf(box[of]) > frame->radius_m)) return true;
    constexpr int kStack = 3 * kMostCuts + 1;
    Piece stack[kStack];
    int left = 1;
    stack[0] = {0, 0, 0, false};
    while (left > 0) {
      const Piece piece = stack[--left];
      const FloatBox around = boxOfPiece(owner[of], piece);
      if (!frame->range(around, bits).has(frame->coarser, cell)) continue;
      if (piece.cuts == kMostCuts || !(radiusOf(around) > frame->radius_m)) return true;
      // In the lattice of twice as many: three at the corners, one in the middle the other way round.
      const int i = 2 * piece.i, j = 2 * piece.j, cuts = piece.cuts + 1, there = piece.turned ? 1 : 0;
      stack[left++] = {cuts, i + 1, j, piece.turned};
      stack[left++] = {cuts, i, j + 1, piece.turned};
      stack[left++] = {cuts, i + there, j + there, piece.turned};
      stack[left++] = {cuts, i + there, j + there, !piece.turned};
    }
    return false;
  }

 private:
  /// In the lattice of 2^cuts parts of each side: corners (i, j), (i + 1, j), (i, j + 1), or turned by half a turn
  /// (i + 1, j + 1), (i, j + 1), (i + 1, j).
  struct Piece {
    int cuts, i, j;
    bool turned;
  };

  GAMBESON_HD FloatBox boxOfPiece(const Owner& o, const Piece& piece) const {
    const MovingPoint a = point[o.corner[0]], b = point[o.corner[1]], c = point[o.corner[2]];
    FloatBox around = emptyBox();
    for (int k = 0; k < 3; ++k) {
      const int i = piece.i + (piece.turned ? k != 1 : k == 1), j = piece.j + (piece.turned ? k != 2 : k == 2);
      const double part = 1.0 / (1 << piece.cuts), u = part * i, v = part * j, w = 1 - u - v;
      for (int axis = 0; axis < 3; ++axis) {
        const double start[3] = {w * a.start[axis], u * b.start[axis], v * c.start[axis]};
        const double end[3] = {w * a.end[axis], u * b.end[axis], v * c.end[axis]};
        const double from = start[0] + start[1] + start[2], to = end[0] + end[1] + end[2];
        double rounding = 0;
        for (int n = 0; n < 3; ++n) rounding += 0x1p-51 * (std::abs(start[n]) + std::abs(end[n]));
        around.lo[axis] = std::min(around.lo[axis], roundedDown(std::min(from, to) - rounding, margin_m));
        around.hi[axis] = std::max(around.hi[axis], roundedUp(std::max(from, to) + rounding, margin_m));
      }
    }
    return around;
  }
};

}  // namespace gambeson::gpu
