#pragma once
/// Who is whose neighbour in a triangle mesh, with one number for each face, edge and vertex.

#include <array>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

/// Feature numbers: face t is t (the index in TriangleMesh), edge e is faces + e, vertex v is faces + edges + v.
/// Vertices at the same position are one, so a mesh whose file repeats them at every triangle is closed all the same.
struct MeshTopology {
  struct Corner {
    int face, k;  ///< k: for an edge, edge k of the face (corner k to k + 1); for a vertex, corner k
  };
  struct Edge {
    int v, w;  ///< v < w
  };
  std::vector<int> vertex_of;                 ///< per vertex of the mesh: its representative
  std::vector<std::array<int, 3>> triangles;  ///< of representatives; a triangle with two equal corners has no features
  std::vector<std::array<int, 3>> face_edges;  ///< -1 where the triangle is collapsed
  std::vector<Edge> edges;
  std::vector<int> edge_begin;  ///< faces of edge e: edge_faces[edge_begin[e], edge_begin[e+1])
  std::vector<Corner> edge_faces;
  std::vector<int> vertex_begin;  ///< edges at vertex v: vertex_edges[vertex_begin[v], vertex_begin[v+1])
  std::vector<int> vertex_edges;
  std::vector<char> rim_edge, rim_vertex;  ///< at the border of an open mesh
  bool closed = false;

  bool collapsed(int face) const { return face_edges[face][0] < 0; }
  int edgeFeature(int e) const { return static_cast<int>(triangles.size()) + e; }
  int vertexFeature(int v) const { return static_cast<int>(triangles.size() + edges.size()) + v; }
};

/// Throws InputError where the mesh is empty, a position is not finite, an index is out of range, neighbouring
/// triangles disagree on what is outside, or a closed mesh is turned inside out.
MeshTopology meshTopology(const TriangleMesh& mesh);

/// What a user should know of a mesh that is taken as it is: holes, and edges of more than two triangles. Empty: none.
std::string meshDefects(const MeshTopology& mesh);

}  // namespace gambeson
