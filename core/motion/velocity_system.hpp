#pragma once
/// The linear system of an implicit step, of changes of velocity.
///
///   A = M + dt D + dt^2 K
///
/// M the masses of the free points, D their drag and the cloth's own damping (eq. 3.2, 3.8), K = -df/dx the stiffness of
/// the cloth, of support springs and of stitches (Wong 2014, eq. 3.25). Where the cloth's tangent has rows for its inner
/// unknowns, vectors have blocks for their rates behind those of the points, three rates in a block. The cloth's own
/// part is positive semidefinite: what compression would take from it is left out element by element
/// (ForceTerms::definite), so that A is positive and conjugate gradients find the solution.

#include "core/math/conjugate_gradients.hpp"
#include "core/motion/forces.hpp"

namespace gambeson {

class VelocitySystem {
 public:
  /// At the positions, inner unknowns and history of `s`. What springs hang on stands as `frames` say. False where a
  /// block of the diagonal is not positive definite (forces that are not finite).
  bool assemble(const Model& model, const State& s, const AnchorFrames& frames, const ForceTerms& terms, double dt_s,
                StepWork& work);
  int rows() const { return A_.rows(); }  ///< of an assembled system: blocks
  void multiply(std::span<const Vec3> x, std::span<Vec3> y) const;  ///< y = A x
  /// out = D x of the cloth's own damping; false, and nothing is written, where it has none.
  bool damping(std::span<const Vec3> x, std::span<Vec3> out) const;
  /// M + dt D without that damping, by components; 1 where the last block of inner unknowns is filled up.
  const Vec3& own(int block) const { return own_[static_cast<std::size_t>(block)]; }
  /// out = dt K x.
  void stiffness(std::span<const Vec3> x, std::span<Vec3> out) const;
  /// Solves A x = b from x on, in what holds the points: held ones do not change, and supports lead what they couple.
  CgReport solve(std::span<const Vec3> b, double tolerance, std::span<Vec3> x);

 private:
  /// Leaves of changes of velocity what supports and held points let through.
  void hold(std::span<Vec3> change) const;

  const Model* model_ = nullptr;
  std::unique_ptr<ClothTangent> tangent_;
  BlockMatrix A_, D_;  ///< D_: of the cloth's own damping, if it has one
  BlockProduct product_, damping_product_;
  BlockInverses inverses_;
  std::vector<Vec3> own_;
  std::vector<double> diagonal_;  ///< of A, nine values a block
  struct Link {
    int a = 0, b = -1;  ///< samples; b: of a stitch
    double weight = 0;  ///< dt^2 times its stiffness
    Vec3 normal;        ///< along which it does not act, or 0
  };
  std::vector<Link> links_;
  double dt_s_ = 0;
  CgWork work_;
  mutable std::vector<Vec3> scratch_, unled_;
  mutable std::vector<double> inner_;
};

}  // namespace gambeson
