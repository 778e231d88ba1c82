#pragma once
/// Where the sections of a cell come to rest.

#include <memory>
#include <string>
#include <vector>

#include "core/statics/reduction.hpp"
#include "core/yarn/rod_cell.hpp"

namespace gambeson {

struct EquilibriumOptions {
  double tolerance = 1e-9;  ///< of the residual against the forces that balance in it
  int iterations = 200;
  int halvings = 8;  ///< of a change of the load that does not come to rest at once
};

struct EquilibriumReport {
  enum class End { converged, too_many_iterations, no_descent, not_finite, friction };
  End end = End::converged;
  /// False where the forces balance and the tangent is not positive definite: yarns would leave at the least push.
  bool stable = true;
  int iterations = 0;   ///< of all parts of the way
  double residual = 0;  ///< against the forces that balance, the last
  double energy_J = 0;  ///< of the cell
  bool converged() const { return end == End::converged; }
  /// Why it ended, in words.
  std::string reason() const;
};

/// Scratch of the solution: matrices whose sparsity is kept while the same points touch.
class EquilibriumWork {
 public:
  explicit EquilibriumWork(const RodCell& cell) : cell_(cell) {}

  /// The energy and forces of the cell, with friction where `history` is given.
  void evaluate(const CellFaces& faces, std::span<const Pose> sections, CellAnswer& out) const;
  /// Takes the forces that press in friction from the last accepted load, or from where the sections are. Returns how
  /// much they changed [N].
  void pressAsAccepted();
  double press(const CellFaces& faces, std::span<const Pose> sections);

  /// Second derivatives of the energy where `at` was evaluated, for all blocks and for the unknowns.
  void assemble(const CellFaces& faces, std::span<const Pose> sections, const CellAnswer& at, bool downhill = false);
  /// Unknowns of a lattice slide: a yarn may move along itself or, where nothing touches it, anywhere. So a part of its
  /// diagonal (`raise`) is added to the matrix that is factorised; equilibria stay what they are. Returns whether it is
  /// positive definite.
  bool factorise(double raise);
  /// Assembles and factorises in an equilibrium, with the least raise that hides no instability. Returns whether it is
  /// stable.
  bool settle(const CellFaces& faces, std::span<const Pose> sections, const CellAnswer& at);
  /// How the unknowns answer a force on them, the raise of the diagonal taken back by iteration: to 1e-11 of the force,
  /// or until what is left no longer falls to half: what is softer than the raise slides, and its force is rounding.
  /// Throws RunError where more than a thousandth of the force is left.
  std::vector<double> follow(std::span<const double> force) const;
  const BlockMatrix& blocks() const { return blocks_; }
  const SymmetricMatrix& unraised() const { return reduced_; }
  const SymmetricFactor& factor() const { return *factor_; }
  /// The residual of the unknowns; the forces on the unknowns of forces on all blocks.
  std::vector<double> residual(const CellAnswer& answer) const;
  std::vector<double> onUnknowns(std::span<const double> blocks) const;

  CellAnswer answer, trial;
  /// Of the last accepted load, owned by the caller, who accepts loads; none: no friction.
  const CellHistory* history = nullptr;

 private:
  const CellFriction* friction() const { return history ? &friction_ : nullptr; }

  const RodCell& cell_;
  CellFriction friction_;
  std::vector<int> pairs_;
  BlockMatrix blocks_;
  std::unique_ptr<Reduction> reduction_;
  SymmetricMatrix reduced_, raised_;
  std::unique_ptr<SymmetricFactor> factor_;
};

/// Moves the sections downhill in energy until the forces balance, the faces as they are: Newton's method, with
/// RodTangent::downhill where the tangent is not positive definite and its diagonal raised where that is not either,
/// steps cut until the energy falls (Nocedal and Wright 2006, algorithms 3.2 and 3.3). Where it does not converge,
/// `sections` are the last ones. Bits do not depend on threads.
///
/// With friction (EquilibriumWork::history) the forces that press are held while a potential is minimised, then taken
/// from where that led, until they leave the forces balanced. Where they change more and more there is no such
/// equilibrium within reach.
EquilibriumReport findEquilibrium(const RodCell& cell, const CellFaces& faces, std::vector<Pose>& sections,
                                  EquilibriumWork& work, const EquilibriumOptions& options = {});

/// From an equilibrium under one load to one under another, the sections carried along; where that does not come to
/// rest, by way of loads between, the change halved up to `halvings` times. Where it fails, `sections` are of the last
/// load that was reached and `reached` is that. Loads between are not accepted: friction is that of one step. Throws
/// InputError as checkLoad, and with the keys "faces", "extent" where held faces or a quarter are to bend.
struct LoadReport : EquilibriumReport {
  CellLoad reached;
};
LoadReport changeLoad(const RodCell& cell, const CellLoad& from, const CellLoad& to, std::vector<Pose>& sections,
                      EquilibriumWork& work, const EquilibriumOptions& options = {});

}  // namespace gambeson
