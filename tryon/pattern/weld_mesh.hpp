#pragma once
/// From the triangles of a foreign mesh to one piece of cloth.

#include <vector>

#include "core/cloth/draft/cloth_mesh.hpp"

namespace gambeson {

struct WeldedMesh {
  ClothMesh mesh;
  int welded = 0;  ///< vertices that others nearby stand for
  int turned = 0;  ///< triangles that faced the other side than their neighbours
  int left = 0;    ///< triangles of other pieces than the one asked for
};

/// Makes vertices within `tolerance_m` of each other one, leaves out those without triangles, and turns triangles so
/// that neighbours face one side, that of most of them. Throws InputError (key: the patch; reason: the place, in cm)
/// where triangles have no area, more than two meet in an edge, cloth meets itself in a point alone, has one side only
/// (a Moebius strip), or is in several pieces. `piece`: which of these is kept, 1 that of the most triangles; 0: all,
/// of which there may be one. Patches of which nothing is left go.
WeldedMesh weldMesh(const ClothMesh& mesh, double tolerance_m, int piece = 0);

/// Chains of vertices along which a welded mesh ends, each closed (its last vertex is followed by its first), the
/// longest first; the cloth lies to their left.
std::vector<std::vector<int>> bordersOf(const ClothMesh& mesh);

/// Along a closed chain of vertices [m].
double lengthAround(const ClothMesh& mesh, const std::vector<int>& chain);

/// Of the triangles of a patch as they stand [m^2].
double areaOf(const ClothMesh& mesh, int patch);

}  // namespace gambeson
