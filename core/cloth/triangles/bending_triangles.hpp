#pragma once
/// Triangles that bend by the tensor of curvature of each.
///
/// alpha_i is the angle by which the surface's normal turns from the triangle to its edge i, positive where the surface
/// rises to the side of the normal. With h_i the height on the edge and n_i the normal of the edge in the triangle, at
/// rest and in the basis of the threads,
///   kappa = sum_i 2 alpha_i / h_i n_i x n_i,   E = A W(kappa - kappa_rest),
/// W the fabric's own bending energy per area, with what it remembers: one point for each triangle. For small slopes
/// this is Morley's triangle (Aero. Quart. 19, 1968); of large ones see Grinspun, Gingold, Reisman and Zorin, Computer
/// Graphics Forum 25, 2006.
///
/// `midedge`: alpha_a = theta/2 + phi and alpha_b = theta/2 - phi on both sides of an edge, theta the angle of its fold
/// and phi [rad] an unknown of the edge, which turns its normal from the one halfway; at the border alpha = phi. Rigid
/// motions leave phi. Its inertia is rho A_e (2 h)^2/3, A_e the area of the triangles at the edge and h their mean
/// height on it: no mode of the plate sees it, and it asks for no shorter a step than hinges do (DECISIONS.md).
/// Modes and implicit motions have it too.
/// `triangle`: phi = 0, and alpha = 0 at the border.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/free_map.hpp"
#include "core/cloth/triangles/rest_elements.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/material/fabric.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// One of them; its edges are those that face the corners 0, 1 and 2.
struct BentTriangle {
  int triangle = 0;  ///< among all
  std::array<int, 3> corner{};
  int law = 0;
  double area_m2 = 0;
  std::array<Vec3, 3> per_angle;         ///< curvature (k11, k22, 2 k12) of an angle of each edge [1/m]
  std::array<int, 3> hinge{-1, -1, -1};  ///< the fold at each edge; -1: border
  std::array<int, 3> turn{-1, -1, -1};   ///< the inner unknown of each edge; -1: none
  std::array<double, 3> sense{1, 1, 1};  ///< with which the unknown is added
  Vec3 rest;                             ///< curvature at rest [1/m]
};

class BendingTriangles {
 public:
  BendingTriangles() = default;
  /// Takes those of `triangles` that bend so, and the folds between them. `laws` and `fabrics` by the triangles' law;
  /// their moments and history have places from `first_moment` and `first_history` on.
  BendingTriangles(const std::vector<MembraneTriangle>& triangles, std::span<const FoldHinge> hinges,
                   std::span<const BlockLaw> laws, std::span<const Fabric> fabrics, const TriangleKernels& kernels,
                   int first_moment, long first_history);

  const std::vector<BentTriangle>& triangles() const { return bent_; }
  /// The bent triangle that one among all is; -1: none.
  int bentOf(int triangle) const { return bent_.empty() ? -1 : bent_of_[static_cast<std::size_t>(triangle)]; }
  /// Where the moment of a fold is, if a bent triangle has it; `moments`: places that they need.
  int momentOf(std::size_t hinge) const { return moment_of_[hinge]; }
  int moments() const { return moments_; }
  long historySize() const { return history_; }
  HistoryPlace historyOf(std::size_t bent) const;  ///< where its numbers stand, without its place
  const std::vector<double>& innerMasses() const { return inner_mass_; }  ///< of the inner unknowns [kg m^2]
  void makeHeavier(int turn, double factor) { inner_mass_[static_cast<std::size_t>(turn)] *= factor; }

  /// Doubles that `force` works with, a multiple of the lanes.
  std::size_t scratchSize() const { return static_cast<std::size_t>(angles_ + couples_); }
  /// Writes the moments of the folds over their length, all moments' list being `moments`; forces of inner unknowns and
  /// history where they are asked for. Adds energy.
  void force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, std::span<double> scratch,
             double* moments, ClothWork& work) const;

  /// (k11, k22, 2 k12) of a bent triangle beyond that at rest [1/m]; where the state has no inner unknowns they are
  /// zeros.
  Vec3 changeOf(const BentTriangle& t, std::span<const FoldHinge> hinges, const ClothState& state) const;
  /// What a bent triangle remembers; null where it remembers nothing, or the cloth is new.
  History<double> memoryOf(std::size_t bent, const ClothState& state) const;

  /// The block rows of K that a bent triangle has: its free points, and behind all points the inner unknowns, three in
  /// a block.
  std::vector<int> blocksOf(const BentTriangle& t, std::span<const FoldHinge> hinges, const FreeMap& map) const;
  /// Adds the second derivatives of the energy to K, whose sparsity has those blocks.
  void addStiffness(std::span<const FoldHinge> hinges, const FreeMap& map, const ClothState& state,
                    const ForceTerms& terms, BlockMatrix& K) const;

 private:
  void findEdges(std::span<const FoldHinge> hinges);
  void findMasses(std::span<const Fabric> fabrics);
  /// `of_law`: bent triangles of each law, which make a block.
  void packTriangles(std::span<const std::vector<std::size_t>> of_law, long first_history);
  void packEdges(std::span<const FoldHinge> hinges, std::span<const std::vector<std::size_t>> of_law, int first_moment);

  std::vector<BentTriangle> bent_;
  std::vector<int> bent_of_;  ///< of each triangle
  std::vector<BlockLaw> laws_;
  const TriangleKernels* kernels_ = nullptr;
  std::vector<int> moment_of_;  ///< of each fold
  std::vector<std::array<int, 3>> couple_at_;  ///< of each bent triangle's edges: what acts on their angle
  std::vector<EdgeBlock> edges_;
  std::vector<BendingBlock> blocks_;
  std::vector<long> history_at_;  ///< of each bent triangle's first number
  std::vector<double> inner_mass_;
  int moments_ = 0, turning_ = 0;  ///< folds whose normals turn: the first inner unknowns
  long angles_ = 0, couples_ = 0, history_ = 0;
};

}  // namespace gambeson
