#pragma once
/// Triangles in place of the NURBS patches of a draft.

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "core/cloth/triangles/mesh_kind.hpp"

namespace gambeson {

/// The draft's shape, seams, edges, threads and fabrics; it lies at rest as it stands. Flat panels with sewn seams are cut
/// so that these join vertices (sewn_mesh.hpp), as ties. Throws InputError (key "mesh") where seams join edges that have
/// other vertices, or a patch is trimmed that cannot be, and as sewnMesh does.
MeshDraft meshDraft(const Garment& draft, MeshKind kind);

}  // namespace gambeson
