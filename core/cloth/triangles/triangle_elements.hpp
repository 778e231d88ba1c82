#pragma once
/// The elements of a cloth of triangles: membranes and what bends, their force, energy and stiffness.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/stress.hpp"
#include "core/cloth/triangles/bending_triangles.hpp"
#include "core/cloth/triangles/crossed_springs.hpp"
#include "core/cloth/triangles/quadratic_hinges.hpp"
#include "core/cloth/triangles/rest_elements.hpp"
#include "core/cloth/triangles/seam_springs.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/cloth/triangles/triangle_membrane.hpp"
#include "core/material/fabric.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

class TriangleElements {
 public:
  TriangleElements() = default;
  /// `membranes`: of each fabric; empty: its own. Throws InputError on a fabric that is none of triangles, or of such a
  /// membrane.
  TriangleElements(int points, std::vector<MembraneTriangle> triangles, std::vector<FoldHinge> hinges,
                   std::span<const Fabric> fabrics, const TriangleKernels& kernels = *triangleKernels().front(),
                   std::span<const MembraneModel> membranes = {}, std::span<const SeamSpring> seam_springs = {});

  const std::vector<MembraneTriangle>& triangles() const { return triangles_; }
  const std::vector<FoldHinge>& hinges() const { return hinges_; }
  const char* kernels() const { return kernels_->name; }
  const BendingTriangles& bending() const { return bending_; }
  const CrossedSprings& springs() const { return springs_; }
  const QuadraticHinges& quadratic() const { return quadratic_; }
  const SeamSprings& seamSprings() const { return seam_springs_; }
  /// Doubles of the history: those of each hinge and bent triangle whose law remembers, and of each triangle that has
  /// friction in shear, lanes side by side.
  std::size_t historySize() const { return static_cast<std::size_t>(history_); }
  /// Of the numbers of a hinge: where they stand, without its place; of the friction in shear of a triangle.
  HistoryPlace historyOf(std::size_t hinge) const;
  HistoryPlace shearHistoryOf(std::size_t triangle) const;

  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const;
  /// Whether any membrane is damped, and then as Cloth::dampingForce has it.
  bool damps() const;
  void dampingForce(const ClothState& state, const ClothForce& out, ClothWork& work) const;
  /// d2E/dq2 of a triangle: blocks[3 I + J] (3 x 3, row by row) of its corners.
  void membraneStiffness(int triangle, const ClothState& state, const ForceTerms& terms,
                         std::vector<std::array<double, 9>>& blocks) const;
  /// - df/dv of a triangle's damping, in the same order.
  void membraneDamping(int triangle, std::span<const Vec3> q, std::vector<std::array<double, 9>>& blocks) const;
  /// Whether an edge bends by itself, by the fabric's law.
  bool isHinge(std::size_t hinge) const { return bendingOf(hinges_[hinge]) == BendingElements::hinge; }
  /// d2E/dq2 of a hinge: blocks[4 I + J] of its corners, as above.
  void hingeStiffness(int hinge, const ClothState& state, const ForceTerms& terms,
                      std::vector<std::array<double, 9>>& blocks) const;
  /// Strain (E11, E22, 2 E12) of a triangle, and F D along weft and warp.
  Vec3 strain(int triangle, std::span<const Vec3> q, Vec3* weft = nullptr, Vec3* warp = nullptr) const;
  double curvature(int hinge, std::span<const Vec3> q) const;  ///< kappa of a hinge [1/m]
  /// (k11, k22, 2 k12) of a triangle [1/m]: its own tensor, or half of what its hinges turn over their lengths, over
  /// its area. `rest`: with the angles at rest, else what is beyond them.
  Vec3 curvatureOf(int triangle, const ClothState& state, bool rest) const;
  /// All that the laws see and say in a triangle; where its hinges remember, the mean of what they do.
  PointState stateOf(int triangle, const ClothState& state) const;

 private:
  void packHinges();
  void packTriangles();
  void packSprings();
  BlockLaw lawOf(int index, const ForceTerms& terms) const;
  const TriangleMembrane& membraneOf(const MembraneTriangle& t) const {
    return membranes_[static_cast<std::size_t>(t.law)];
  }
  /// n of a triangle by its membrane, and its slope.
  void stretch(const MembraneTriangle& triangle, const BlockLaw& law, const Vec3& strain, const History<double>& memory,
               Answer<double, 3>& answer) const;
  BendingElements bendingOf(const FoldHinge& h) const {
    return triangles_[static_cast<std::size_t>(h.triangle[0])].bending;
  }
  using PointMemory = std::array<double, kMostHistory + kShearHistory>;
  /// What a triangle remembers, as its law reads it; of hinges the mean.
  PointMemory memoryAt(int triangle, const ClothState& state) const;
  /// What a hinge remembers; null where it remembers nothing, or the cloth is new.
  History<double> memoryOf(std::size_t hinge, const ClothState& state) const;

  std::vector<MembraneTriangle> triangles_;
  std::vector<FoldHinge> hinges_;
  std::vector<BlockLaw> laws_;
  std::vector<TriangleMembrane> membranes_;    ///< of each law
  std::vector<std::array<int, 3>> hinges_of_;  ///< of each triangle; -1 where it has fewer
  const TriangleKernels* kernels_ = nullptr;
  std::vector<ElementBlock> triangle_blocks_, hinge_blocks_;
  BendingTriangles bending_;
  CrossedSprings springs_;
  QuadraticHinges quadratic_;
  SeamSprings seam_springs_;
  std::vector<long> history_at_;  ///< of each hinge's first number
  std::vector<long> shear_at_;    ///< of each triangle's
  std::vector<int> moment_;       ///< of each edge: where its moment is; -1: none
  int moments_ = 0;               ///< and behind them some that stay 0
  long history_ = 0, slot_count_ = 0;
  SlotGather gather_;
};

}  // namespace gambeson
