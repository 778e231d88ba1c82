#pragma once
/// Hinges whose energy is quadratic in the positions of their corners, of cloth that is flat at rest.
///
/// With h the height of a triangle over the common edge at rest and f the place of its foot on the edge, from 0 at
/// corner 0 to 1 at corner 1, the stencil of a hinge is
///   s = x2/h2 + x3/h3 - ((1 - f2)/h2 + (1 - f3)/h3) x0 - (f2/h2 + f3/h3) x1   (no unit):
/// the cotangents of the rest triangles over the length l of the edge. It is zero wherever one affine map
/// takes both triangles from their flat rest to where they are, and |s| = 2 sin(theta/2) where the pair is folded by
/// theta without strain. Then
///   E = 1/2 c |s|^2,   c = l^2/A d . D d   [J],
/// A the area of both triangles, D the fabric's rigidities and d the direction across the edge (TriangleCloth): to
/// second order in theta the energy of a hinge with that fabric, so that the moment is c sin(theta) where the hinge's
/// is c theta: 5 % less at 30 degrees, a third less at 90. The stiffness c K Kᵀ is the same in all positions, and
/// positive semidefinite: forces are linear, tangents constant.
///
/// Bergou, Wardetzky, Harmon, Zorin and Grinspun, 'A quadratic bending model for inextensible surfaces', Eurographics
/// Symp. Geometry Processing 2006, have this stencil; their factor for an isotropic sheet is three times c, from the
/// mass of a nonconforming element. Wardetzky, Bergou, Harmon, Zorin and Grinspun, 'Discrete quadratic curvature
/// energies', Computer Aided Geometric Design 24, 2007, discuss it.
///
/// Valid for laws that are linear in the curvature, angles at rest of zero, folds below some 60 degrees, and cloth that
/// hardly stretches: where the strains of both triangles differ s is not zero, as if a fold of their difference were
/// there.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/block_law.hpp"
#include "core/cloth/free_map.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/triangles/rest_elements.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// One hinge.
struct QuadraticHinge {
  std::array<int, 4> corner{};  ///< as foldAngle has them
  /// sqrt(c) K of the corners 1, 2 and 3; that of corner 0 is minus their sum [sqrt(N/m)].
  std::array<double, 3> weight{};
};

/// The weights of a fold, `first` and `second` the triangles at it, from the rigidities of bending [N m] (Voigt 11 22
/// 33 12 13 23).
QuadraticHinge quadraticHinge(const FoldHinge& hinge, const MembraneTriangle& first, const MembraneTriangle& second,
                              std::span<const double, 6> rigidity_Nm);

class QuadraticHinges {
 public:
  QuadraticHinges() = default;
  /// Those of the hinges that bend so, by their first triangle. Their contributions to forces have slots from
  /// `first_slot` on and are listed in `gather`. Throws InputError on laws that are not linear and on angles at rest.
  QuadraticHinges(std::span<const FoldHinge> hinges, std::span<const MembraneTriangle> triangles,
                  std::span<const BlockLaw> laws, const TriangleKernels& kernels, long first_slot, SlotGather& gather);

  /// Within patches, and across seams.
  std::span<const QuadraticHinge> within() const { return parts_[0].hinges; }
  std::span<const QuadraticHinge> seams() const { return parts_[1].hinges; }
  long slots() const { return slots_; }
  /// Writes dE/dq to the slots of all elements; adds energy.
  void force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, double* slots,
             ClothWork& work) const;
  void addStiffness(const FreeMap& map, const ForceTerms& terms, BlockMatrix& K) const;

 private:
  struct Part {
    std::vector<QuadraticHinge> hinges;
    PointBlock block;
    long first_slot = 0;
  };
  std::array<Part, 2> parts_;
  const BendingKernels* kernels_ = nullptr;
  int lanes_ = 1;
  long slots_ = 0;
};

}  // namespace gambeson
