#pragma once
/// A garment as a mesh: what cloth is made of that needs no surface between its vertices.

#include <array>
#include <vector>

#include "core/cloth/draft/bending_elements.hpp"
#include "core/cloth/draft/cloth_mesh.hpp"
#include "core/cloth/draft/membrane_elements.hpp"
#include "core/material/fabric.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// How a mesh lies at rest. fabric: as it stands, its edges straight or with its angles as the fabric counts bending
/// (hasRestCurvature); shape: as it stands, edges keep its angles; in both uv turns the threads alone. flat: as uv
/// says, edges straight.
enum class MeshRest { fabric, shape, flat };

struct MeshDraft {
  ClothMesh mesh;
  MeshRest rest = MeshRest::fabric;
  BendingElements bending = BendingElements::hinge;
  double bending_spring_N_per_m = 0;  ///< of BendingElements::springs; 0: from the fabric's rigidities
  std::vector<Fabric> fabrics;  ///< one or more
  std::vector<int> fabric;      ///< of each triangle; empty: the first
  /// Of a draft: the parameters at each triangle's corners, their range in each patch, and the vertices as rows on the
  /// draft's control points. Empty for a file.
  std::vector<std::array<Vec2, 3>> draft;
  std::vector<std::array<Vec2, 2>> range;
  /// Of each patch of a draft: the lines in u and in v whose crossings are its vertices; empty where there are none.
  std::vector<std::array<std::vector<double>, 2>> lines;
  SparseRows of_control;
  MembraneModel membrane;
};

}  // namespace gambeson
