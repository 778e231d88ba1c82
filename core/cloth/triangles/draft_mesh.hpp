#pragma once
/// Triangles in place of the NURBS patches of a draft.

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"

namespace gambeson {

/// single: every cell of the draft in two triangles with the same diagonal. equilateral: rows of triangles with sides
/// of a cell's width, every other row shifted by half a side; patches that are trimmed have none.
enum class MeshKind { single, equilateral };

/// The draft's shape, seams, edges, threads and fabrics; it lies at rest as it stands. Throws InputError (key "mesh")
/// where seams join edges that have other vertices, or a patch is trimmed that cannot be.
TriangleGarment triangleGarment(const Garment& draft, MeshKind kind);

}  // namespace gambeson
