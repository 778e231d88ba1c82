#pragma once
/// The elements of a cloth of triangles: membranes and hinges, their force, energy and stiffness.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/stress.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/material/fabric.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A triangle at rest.
struct MembraneTriangle {
  std::array<int, 3> corner{};
  /// d(barycentric)/d(weft, warp): F D_weft = (x1 - x0) g[0].x + (x2 - x0) g[1].x, F D_warp with y [1/m].
  std::array<Vec2, 2> g{};
  double area_m2 = 0;
  int law = 0;
};

/// A hinge between two triangles at rest; see TriangleCloth.
struct FoldHinge {
  std::array<int, 4> corner{};  ///< as foldAngle has them
  std::array<int, 2> triangle{};
  double theta0 = 0;     ///< [rad]
  double per_angle = 0;  ///< kappa over theta - theta0 [1/m]
  double area_m2 = 0;
  Vec3 d;  ///< (n1^2, n2^2, 2 n1 n2)
  int law = 0;
  bool seam = false;  ///< between two patches
};

class TriangleElements {
 public:
  TriangleElements() = default;
  /// Throws InputError on a fabric that is none of triangles.
  TriangleElements(int points, std::vector<MembraneTriangle> triangles, std::vector<FoldHinge> hinges,
                   std::span<const Fabric> fabrics, const TriangleKernels& kernels = *triangleKernels().front());

  const std::vector<MembraneTriangle>& triangles() const { return triangles_; }
  const std::vector<FoldHinge>& hinges() const { return hinges_; }
  const char* kernels() const { return kernels_->name; }
  /// Doubles of the history: those of each hinge whose law remembers, and of each triangle that has friction in shear,
  /// lanes side by side.
  std::size_t historySize() const { return static_cast<std::size_t>(history_); }
  /// Of the numbers of a hinge: where they stand, without its place; of the friction in shear of a triangle.
  HistoryPlace historyOf(std::size_t hinge) const;
  HistoryPlace shearHistoryOf(std::size_t triangle) const;

  void force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const;
  /// d2E/dq2 of a triangle: blocks[3 I + J] (3 x 3, row by row) of its corners.
  void membraneStiffness(int triangle, const ClothState& state, const ForceTerms& terms,
                         std::vector<std::array<double, 9>>& blocks) const;
  /// d2E/dq2 of a hinge: blocks[4 I + J] of its corners, as above.
  void hingeStiffness(int hinge, const ClothState& state, const ForceTerms& terms,
                      std::vector<std::array<double, 9>>& blocks) const;
  /// Strain (E11, E22, 2 E12) of a triangle, and F D along weft and warp.
  Vec3 strain(int triangle, std::span<const Vec3> q, Vec3* weft = nullptr, Vec3* warp = nullptr) const;
  double curvature(int hinge, std::span<const Vec3> q) const;  ///< kappa of a hinge [1/m]
  /// (k11, k22, 2 k12) of a triangle [1/m]: half of what its hinges turn over their lengths, over its area. `rest`:
  /// with the angles at rest, else what is beyond them.
  Vec3 curvatureOf(int triangle, std::span<const Vec3> q, bool rest) const;
  /// All that the laws see and say in a triangle; they remember there the mean of what its hinges do.
  PointState stateOf(int triangle, const ClothState& state) const;

 private:
  void packHinges();
  void packTriangles();
  BlockLaw lawOf(int index, const ForceTerms& terms) const;
  /// What a hinge remembers; null where it remembers nothing, or the cloth is new.
  History<double> memoryOf(std::size_t hinge, std::span<const double> history) const;

  std::vector<MembraneTriangle> triangles_;
  std::vector<FoldHinge> hinges_;
  std::vector<BlockLaw> laws_;
  std::vector<std::array<int, 3>> hinges_of_;  ///< of each triangle; -1 where it has fewer
  const TriangleKernels* kernels_ = nullptr;
  std::vector<ElementBlock> triangle_blocks_, hinge_blocks_;
  std::vector<long> history_at_;  ///< of each hinge's first number
  std::vector<long> shear_at_;    ///< of each triangle's
  std::vector<int> moment_;       ///< of each hinge: where its moment is
  int moments_ = 0;               ///< and behind them one that stays 0
  long history_ = 0, slot_count_ = 0;
  SlotGather gather_;
};

}  // namespace gambeson
