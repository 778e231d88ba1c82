#pragma once
/// What cloth asks of a draft whose cells are quadrilaterals between control points: patches of degree 1.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Throws InputError unless the garment is one (checkGarment) and its patches are of degree 1 with each inner knot
/// once, as nodalDraft makes them. `cloth` is what it is to be made of, for messages: "springs".
void checkBilinear(const Garment& garment, const std::string& cloth);

/// The cells of a patch at a place, u fastest: one inside of a cell, two on a side, up to four at a point.
std::vector<int> cellsAt(const NurbsPatch& patch, Vec2 uv);
/// Control points of a cell, in the patch: (0, 0), (1, 0), (0, 1), (1, 1).
std::array<int, 4> cornersOf(const NurbsPatch& patch, int cell);
/// Where a place lies in a cell, 0 to 1 in u and v.
Vec2 withinCell(const NurbsPatch& patch, int cell, Vec2 uv);
/// The place that lies so in a cell.
Vec2 placeIn(const NurbsPatch& patch, int cell, Vec2 within);
/// The place in the middle of a cell.
Vec2 middleOf(const NurbsPatch& patch, int cell);
int cellCount(const NurbsPatch& patch);
/// Of all patches: patch and middle.
std::vector<std::pair<int, Vec2>> cellMiddles(const Garment& garment);

}  // namespace gambeson
