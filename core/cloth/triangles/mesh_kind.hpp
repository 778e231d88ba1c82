#pragma once
/// How a draft is cut into triangles.

namespace gambeson {

/// single: every cell of the draft in two triangles with the same diagonal. alternating: the diagonals of cells beside
/// each other cross. equilateral: rows of triangles with sides
/// of a cell's width, every other row shifted by half a side; patches that are trimmed have none.
enum class MeshKind { single, alternating, equilateral };

}  // namespace gambeson
