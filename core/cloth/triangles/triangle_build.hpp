#pragma once
/// From meshes of garments to points, patches, membranes and hinges.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/cloth.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "core/cloth/triangles/triangle_elements.hpp"
#include "core/material/fabric.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// All garments, in turn.
struct TriangleParts {
  std::vector<Vec3> rest;   ///< points: each patch has its own, in the order in which its triangles name them
  std::vector<int> vertex;  ///< of each point, among those of all meshes
  SparseRows T;             ///< points x vertices of the meshes; those that closed seams tie are one
  std::vector<ClothPatch> patches;
  std::vector<char> drafted;                              ///< of each patch: whether it has parameters of a draft
  std::vector<std::vector<std::vector<int>>> sides;       ///< of each patch: points of its sides (sideOfLine)
  std::vector<std::array<int, 3>> triangles;              ///< by points, patch after patch
  std::vector<int> first_triangle;                        ///< of each patch, and the end
  std::vector<std::array<Vec2, 3>> draft;                 ///< of each triangle; of garments without draft zeros
  std::vector<std::array<std::vector<double>, 2>> lines;  ///< of each patch (MeshDraft::lines)
  std::vector<Fabric> fabrics;
  std::vector<MembraneModel> membrane_models;  ///< of each fabric
  std::vector<int> fabric_of_triangle;
  std::vector<MembraneTriangle> membranes;
  bool sewn = false;          ///< some garment has ties
  std::vector<MeshTie> ties;  ///< that are not closed; vertex: point, seam: of all garments
  std::vector<SeamSpring> seam_springs;
  std::vector<FoldHinge> hinges;  ///< in the order of the second triangle at an edge
};

/// Throws InputError on bad meshes, a garment without fabric, and uv that gives no threads or no flat shape.
TriangleParts buildTriangles(std::span<const MeshDraft> garments);

}  // namespace gambeson
