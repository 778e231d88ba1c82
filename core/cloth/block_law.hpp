#pragma once
/// From what a fabric is to what the kernels of any cloth read.

#include <array>
#include <span>

#include "core/cloth/cloth_state.hpp"
#include "core/material/fabric_law.hpp"

namespace gambeson {

/// The laws of cloth that has given rigidities, carries compression and remembers nothing, as one short list of
/// numbers: what most garments need.
struct PlainLaw {
  OrthotropicStiffness<double> membrane{};
  std::array<double, 3> rigidity{};  ///< weft, warp, twist [N m]
  std::array<double, kLawNumbers> numbers{};
  int kind = 0;  ///< of BendingLaws; 0: linear
};

/// The bending law becomes linear, with its steepest slope.
void takeSteepest(PlainLaw& law);

/// What the kernels need to know of the laws of a block of elements.
struct BlockLaw {
  PlainLaw plain;
  /// The same as a general law: what the tangent reads, and the force where `general` says that the plain one is not
  /// enough. Where the block has laws of its own by point, those.
  PointLaw point;
  bool general = false;
  LawUse use;  ///< of any point
  /// What is left out, as in ForceTerms: of the general law in the kernel, of the plain one by the caller.
  bool membrane = true, bending = true, steepest = false, definite = false;
  /// History of the whole cloth as it was committed (null: the cloth is new) and as it would be (null: not asked), and
  /// where in it the block's points have theirs, [point][use.historySize()][lane]. Energy lost since by group,
  /// [group][lane] (null: not asked). Only general laws remember.
  const double* committed = nullptr;
  double* trial = nullptr;
  long history_first = 0;
  double elapsed_s = 0;  ///< since the commit
  double* lost = nullptr;

  /// Which laws are evaluated.
  LawUse evaluated() const { return steepest ? LawUse{0, false, use.jams} : use; }
  /// Whether any of the points has a history that counts.
  bool remembers() const { return use.remembers() && !steepest; }
};

/// Laws of the points of a block that differ: [point][kLawDoubles][lane], null where they do not, and which of the
/// numbers of a point are not everywhere what BlockLaw::point has.
struct LawsByPoint {
  const double* numbers = nullptr;
  std::span<const int> varying;
};

/// The parts that the law leaves out become zero, or steepest.
template <class S>
GAMBESON_LAW void leaveOut(const BlockLaw& law, PointNumbers<S>& l) {
  for (int i = 0; i < 6; ++i) {
    if (!law.membrane) l.A[i] = S{};
    if (!law.membrane || !law.bending) l.B[i] = S{};
    if (!law.bending) l.D[i] = S{};
  }
  if (law.steepest) takeSteepest(BendingLaws{}, law.use, l);
  if (!law.bending) l.kind = S{};
  if (!law.membrane) l.tension = l.jam = S{};
}

/// The law of a fabric, with the plain form where that suffices.
BlockLaw blockLaw(const Fabric& fabric);

/// The same with what `terms` leave out.
BlockLaw withTerms(BlockLaw law, const ForceTerms& terms);

/// The law that reads the history of a state from there on, and writes there what `out` asks for.
BlockLaw withHistory(BlockLaw law, long history_first, const ClothState& state, const ClothForce& out);

}  // namespace gambeson
