#pragma once
/// Constraint points of their own for weft and warp (LimitPoints::threads).

#include "core/cloth/patches/point_rows.hpp"

namespace gambeson {

/// Where the strain of one thread is constrained on a patch: a grid of Greville points, u fastest.
struct ThreadGrid {
  GrevilleRule u, v;
};
/// The grids of the weft's and of the warp's points. The strain x,s of a thread along u lies in the splines of the
/// patch differentiated once in u: as many points as these have coefficients, so that no motion escapes and none is
/// held twice. Throws InputError (key strain_limit.points) unless the patch is whole, of degree 2 or more, with at most
/// degree - 1 equal inner knots, and its threads follow its knot lines within 0.01 rad.
std::array<ThreadGrid, 2> threadGrids(const Garment& garment, const FreeMap& map, int patch);

}  // namespace gambeson
