#pragma once
/// Flat panels from the uv of a mesh: parts of it that hang together in uv too.

#include <string>
#include <vector>

#include "core/cloth/draft/cloth_mesh.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// How uv lies beside the mesh as it stands.
struct UvFit {
  double scale_m = 0;  ///< of a 1 of uv: s = sum(l_uv l) / sum(l_uv^2), least squares of lengths l [m] of all edges
  double rms = 0;      ///< of s l_uv / l - 1 over all edges, weighed by their length
  double least = 0, most = 0;  ///< of s l_uv / l
  std::string fault;           ///< why it is no flat shape of the cloth: parts without area or folded over; or empty
};
UvFit fitUv(const ClothMesh& mesh);

/// The mesh with a patch for each island of each patch, in its order ("front", or "front_1", "front_2" where it has
/// several), and uv in metres, counter-clockwise; mirrored islands are turned over, u to -u. Named edges that
/// cross from island to island become parts of one name, one in each. Only where fitUv finds no fault.
ClothMesh islandsOf(const ClothMesh& mesh, double scale_m, int& mirrored);

/// Islands as panels: each outline split where the neighbour changes, at corners of free borders, and at the tips of
/// darts. Edges of the mesh that are one and lie apart in uv are seams.
FlatPattern flatOfIslands(const ClothMesh& islands, const std::string& name);

}  // namespace gambeson
