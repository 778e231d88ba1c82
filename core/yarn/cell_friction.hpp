#pragma once
/// What a cell with friction remembers from one accepted load to the next.

#include <span>
#include <vector>

#include "core/yarn/cell_faces.hpp"
#include "core/yarn/rod_friction.hpp"

namespace gambeson {

class RodCell;

/// The spring of a pair in contact, as the last accepted load left it.
struct PairGrip {
  int pair = 0;
  RodGrip grip;  ///< first of the weft
  /// Where on the second axes of both sections their chords meet (CrossingContact): the line of the ends goes from one
  /// of these places to the other, along the normal of the crossing, so that yarns that only come nearer do not slip.
  std::array<double, 2> aside_m{};
  double normal_N = 0;  ///< f under that load
};

/// Of all pairs that touched, ascending; of a cell without load none.
struct CellHistory {
  std::vector<PairGrip> grips;
  double stored_J = 0;  ///< in the springs
  double lost_J = 0;    ///< by all loads so far
};

/// Friction while sections move from one accepted load to the next: the forces that press are held, so that it has a
/// potential. A pair that did not touch under the last load has no grip yet.
struct CellFriction {
  std::span<const PairGrip> grips;
  std::vector<double> normal_N;  ///< by grip
};

/// With the forces that press where the sections are.
CellFriction frictionAt(const RodCell& cell, const CellFaces& faces, std::span<const Pose> sections,
                        const CellHistory& history);

/// Accepts an equilibrium: springs are cut to mu f, pairs that touch anew get one without slip, those that have parted
/// none. A pair that slides by s loses mu s (f0 + f1)/2, f0 and f1 under the last load and this one: of second order in
/// the step, as the work of resultants by the trapezoidal rule is.
void accept(const RodCell& cell, const CellFaces& faces, std::span<const Pose> sections, CellHistory& history);

}  // namespace gambeson
