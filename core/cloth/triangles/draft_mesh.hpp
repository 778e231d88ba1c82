#pragma once
/// Triangles in place of the NURBS patches of a draft.

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/triangles/mesh_kind.hpp"
#include "core/cloth/triangles/triangle_build.hpp"

namespace gambeson {

/// The draft's shape, seams, edges, threads and fabrics; it lies at rest as it stands. Throws InputError (key "mesh")
/// where seams join edges that have other vertices, or a patch is trimmed that cannot be.
TriangleGarment triangleGarment(const Garment& draft, MeshKind kind);

}  // namespace gambeson
