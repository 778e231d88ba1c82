#pragma once
/// Meshes of flat panels that are sewn vertex to vertex.
///
/// A seam holds points at equal fractions of the lengths of its two sides together. Here both sides of every seam have
/// as many vertices, so that it joins each to one of the other side, and nothing gapes between them but what chords
/// differ by. Corners of the borders and ends of seams are vertices; so is what lies over them across a seam, and over
/// that across the next. Where a corner that comes over a seam falls within a quarter of a cell of one on the other
/// side both are taken together, and the seam eases by so much there; ends of the parts that a seam's sides are made of
/// are not: where these nearly meet there is an edge as short as what parts them. Between them edges are about a cell
/// long, and turn by half a radian at most. Inside lie triangles that are nearly equilateral along the grain
/// (core/math/planar_mesh.hpp).

#include <array>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// A vertex of a patch's mesh.
struct MeshVertex {
  int patch = 0, vertex = 0;
};

/// Two vertices that a seam joins.
struct SewnPair {
  MeshVertex a, b;
  int seam = 0;
  double length_m = 0;   ///< of seam that it stands for, the mean of both sides
  double spacing_m = 0;  ///< to the next along the seam, likewise
};

/// Two edges that a seam joins, each in the seam's sense.
struct SewnEdgePair {
  std::array<MeshVertex, 2> a, b;
  int seam = 0;
};

struct SewnMesh {
  struct Patch {
    std::vector<Vec2> uv;
    std::vector<std::array<int, 3>> triangles;
    double cell_m = 0;  ///< wanted length of edges: the side of a square as large as the mean cell
  };
  std::vector<Patch> patches;
  std::vector<SewnPair> pairs;      ///< of seams that steps hold, none twice, none of a vertex with itself
  std::vector<SewnEdgePair> edges;  ///< of those seams
  /// Vertices at one place of cuts in a sheet (core/cloth/draft/shared_points.hpp): one in the cloth.
  std::vector<std::array<MeshVertex, 2>> cuts;
};

/// Throws InputError: key "sewn_seams[i]" where an edge does not run along a border or both sides are one, where a seam
/// is weak (it goes with NURBS cloth); "mesh" where a patch is not flat with even parameters, its border crosses
/// itself, or patches are joined in other ways as well.
SewnMesh sewnMesh(const Garment& garment);

}  // namespace gambeson
