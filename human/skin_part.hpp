#pragma once
/// Some vertices of a skin as a skin of their own, to move them alone.

#include <span>

#include "human/skin.hpp"

namespace gambeson {

/// `vertices` ascending; vertex i of the part is vertices[i]. Without triangles: skinPositions is all that it is for,
/// and gives the same bits as for the whole.
Skin skinPart(const Skin& skin, std::span<const int> vertices);

}  // namespace gambeson
