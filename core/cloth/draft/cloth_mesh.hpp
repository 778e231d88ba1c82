#pragma once
/// A garment of triangles as files hold it: a welded mesh with patches, threads and named edges.

#include <array>
#include <string>
#include <vector>

#include "core/cloth/patch_edge.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A chain of vertices along the border of a patch, by a name. "u0", "u1", "v0" and "v1" are the sides of a patch that
/// was drafted as a rectangle.
struct MeshLine {
  std::string name;
  int patch = 0;
  std::vector<int> vertices;
};

/// Triangles run patch by patch. `uv`: of each triangle's corners, in metres: u along the weft and v along the warp
/// where the cloth lies flat, or coordinates that turn as the threads do; empty where the file has none.
struct ClothMesh {
  std::vector<Vec3> vertices;  ///< each once, also where patches meet [m]
  std::vector<std::string> patch_names;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> patch;  ///< of each triangle
  std::vector<std::array<Vec2, 3>> uv;
  std::vector<MeshLine> lines;
};

/// Throws InputError (key = what is wrong) unless every triangle has three corners of its own and an area, patches have
/// triangles and run in order, no edge has more than two triangles, which run around it in opposite directions, all
/// vertices are used and finite, and lines run along edges of their patch.
void checkMesh(const ClothMesh& mesh);

/// The number of a line among those of its patch: 0 to 3 are u0, u1, v0, v1, whether they are there or not; other names
/// follow in the order of the lines.
std::vector<int> sideOfLine(const ClothMesh& mesh);

/// Lines of one name, as one edge; not the four sides.
std::vector<NamedEdge> namedEdges(const ClothMesh& mesh);

}  // namespace gambeson
