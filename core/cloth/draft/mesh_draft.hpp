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

/// Two vertices of two panels, or of one, that a seam holds at one place (core/cloth/sewn_rows.hpp).
struct MeshTie {
  std::array<int, 2> vertex{}, patch{};
  int seam = 0;          ///< of the draft's sewn seams
  double length_m = 0;   ///< of seam that it stands for
  double spacing_m = 0;  ///< to the next along the seam
  double cell_m = 0;     ///< of the smaller of both meshes
};

/// Two edges that a seam with a rotational spring holds together, by vertices in the seam's sense (SewnSeam).
struct MeshSpring {
  std::array<std::array<int, 2>, 2> edge{};  ///< on either side
  std::array<int, 2> patch{};
  double stiffness_N = 0, rest_angle_rad = 0;
};

struct MeshDraft {
  ClothMesh mesh;
  MeshRest rest = MeshRest::fabric;
  BendingElements bending = BendingElements::hinge;
  double bending_spring_N_per_m = 0;  ///< of BendingElements::springs; 0: from the fabric's rigidities
  std::vector<Fabric> fabrics;        ///< one or more
  std::vector<int> fabric;            ///< of each triangle; empty: the first
  /// Of a draft: the parameters at each triangle's corners, their range in each patch, and the vertices as rows on the
  /// draft's control points. Empty for a file.
  std::vector<std::array<Vec2, 3>> draft;
  std::vector<std::array<Vec2, 2>> range;
  /// Of each patch of a draft: the lines in u and in v whose crossings are its vertices; empty where there are none.
  std::vector<std::array<std::vector<double>, 2>> lines;
  SparseRows of_control;
  MembraneModel membrane;
  std::vector<MeshTie> ties;
  std::vector<MeshSpring> springs;  ///< along seams
  bool closed = false;  ///< tied vertices are one point that moves; else rows hold them, which may still be open
  int sewn_seams = 0;   ///< of the draft
};

}  // namespace gambeson
