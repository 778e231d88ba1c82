#pragma once
/// Tiles: what a search for pairs takes as one, a whole cell of cloth or a triangle. Their corners in single precision,
/// so that one direction is tried against four corners at once.

#include <array>
#include <cmath>

#include "core/contact/four.hpp"

namespace gambeson {

/// One or two triangles (the second -1: none) and their corners; of one triangle the last counts twice.
struct Tile {
  std::array<int, 2> triangle{-1, -1};
  std::array<int, 4> vertex{};
};

/// Where a vertex is at first and where its path leads to until the horizon, from a common origin.
struct MovingPoint {
  Four now{}, then{};
};

/// The corners of a tile, coordinate by coordinate.
struct TileShape {
  Four now[3], then[3];
  Four centre;  ///< of the corners at first
  Four normal;  ///< mean of its triangles' at first, a unit vector or 0

  TileShape() = default;
  TileShape(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, const MovingPoint& d, bool two) {
    now[0] = a.now, now[1] = b.now, now[2] = c.now;
    then[0] = a.then, then[1] = b.then, then[2] = c.then;
    Four last = d.now, last_then = d.then;
    centre = all(0.25f) * (now[0] + now[1] + now[2] + last);
    // Of a cell abcd in any order of its corners, where c is common to both triangles or b is: see the constructor of
    // ContactTree.
    const Four p = two ? c.now - a.now : b.now - a.now, q = two ? d.now - b.now : c.now - a.now;
    const Four n = __builtin_shufflevector(p, p, 1, 2, 0, 3) * __builtin_shufflevector(q, q, 2, 0, 1, 3) -
                   __builtin_shufflevector(p, p, 2, 0, 1, 3) * __builtin_shufflevector(q, q, 1, 2, 0, 3);
    normal = unit(n);
    transpose(now[0], now[1], now[2], last);
    transpose(then[0], then[1], then[2], last_then);
  }

  static float dot(const Four& a, const Four& b) {
    const Four c = a * b;
    return c[0] + c[1] + c[2];
  }
  static Four unit(const Four& a) {
    const float length = std::sqrt(dot(a, a));
    return length > 0 ? a / all(length) : Four{};
  }
};

/// How far each corner of a is beyond all of b along a unit vector n, as long as all follow their paths: corners move
/// along lines, so the ends tell. In single precision.
inline Four beyond(const TileShape& a, const TileShape& b, const Four& n) {
  const Four x = all(n[0]), y = all(n[1]), z = all(n[2]);
  const auto along = [&](const Four(&p)[3]) { return x * p[0] + y * p[1] + z * p[2]; };
  return least(along(a.now) - mostOf(along(b.now)), along(a.then) - mostOf(along(b.then)));
}

}  // namespace gambeson
