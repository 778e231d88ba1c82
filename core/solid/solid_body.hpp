#pragma once
/// Solids of hexahedra: energy, forces and their slopes in the positions of the nodes.

#include <span>
#include <vector>

#include "core/math/block_matrix.hpp"
#include "core/math/sparse.hpp"
#include "core/solid/solid_mesh.hpp"

namespace gambeson {

/// Scratch of a SolidBody.
struct SolidWork {
  std::vector<double> energy, stiffness;
  std::vector<Vec3> force;
};

/// Constant after it is built. Sums run over the cells of a node in their order: the same bits for any number of
/// threads.
class SolidBody {
 public:
  /// Throws InputError (checkMesh).
  explicit SolidBody(SolidMesh mesh);

  const SolidMesh& mesh() const { return mesh_; }
  const std::vector<Hexahedron>& cells() const { return cells_; }
  const BonetBurton& lawOf(int cell) const;
  /// At rest [m³].
  double volume() const;

  /// Stored energy [J] at the positions x; `force` is its gradient [N], both one for each node. Not a number where a
  /// cell is turned inside out.
  double force(std::span<const Vec3> x, std::span<Vec3> force, SolidWork& work) const;
  /// Blocks of nodes that share a cell, and the diagonal of all nodes; no values.
  const BlockMatrix& sparsity() const { return sparsity_; }
  /// The slope of the force [N/m]; K has the sparsity.
  void stiffness(std::span<const Vec3> x, BlockMatrix& K, SolidWork& work) const;
  /// ∫ rho N N dV [kg]; lumped: its row sums on the diagonal. K has the sparsity.
  void mass(bool lumped, BlockMatrix& M) const;

 private:
  std::array<Vec3, kHexahedronNodes> cornersOf(int cell, std::span<const Vec3> x) const;

  SolidMesh mesh_;
  std::vector<Hexahedron> cells_;
  std::vector<int> node_offsets_, node_corners_;  ///< of each node: 8 cell + corner
  BlockMatrix sparsity_;
  std::vector<long> block_offsets_;
  std::vector<int> block_sources_;  ///< of each block: 64 cell + 8 corner + corner
};

}  // namespace gambeson
