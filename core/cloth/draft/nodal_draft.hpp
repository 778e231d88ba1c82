#pragma once
/// A draft as cloth whose points are nodes: patches of degree 1 through the corners of its cells.

#include "core/cloth/draft/garment.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// The garment has the draft's patches in the draft's parameters, with a point of each at the corners of its cells,
/// where the surface is, and with no weights; fabrics, fields, seams and edges are the draft's. A smooth seam (G1)
/// keeps its kind, which says that cloth runs on across it: nodes have no tangents for a map to join.
struct NodalDraft {
  Garment garment;
  SparseRows of_control;  ///< the nodes from the draft's control points
};

/// Throws InputError (key "model") where the draft has trims or weak seams, which no such cloth has.
NodalDraft nodalDraft(const Garment& draft);

/// A garment of nodes with all seams C0: what the map T holds of it.
Garment heldAtNodes(Garment garment);

}  // namespace gambeson
