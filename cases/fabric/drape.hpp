#pragma once
/// Cusick's drape tester, in the virtual laboratory.

#include <array>
#include <vector>

#include "cases/fabric/laboratory.hpp"
#include "core/math/vec.hpp"

namespace gambeson::laboratory {

/// How the specimen is cut and held.
struct DrapeTester {
  double specimen_m = 0.30;  ///< diameter; 0.24 for limp cloth, 0.36 for stiff; JIS L 1096: 0.254
  double support_m = 0.18;   ///< of the discs that hold it; JIS L 1096: 0.127
  int start = 0;             ///< how the pattern of the uneven weight is turned
};

/// What is left of the specimen in the picture, and what is read off it.
struct Draped {
  double coefficient = 0;  ///< share of the free ring that the shadow covers
  int nodes = 0;           ///< folds
  long crossings = 0;      ///< pairs of triangles that pass through each other: cloth does not touch itself here
  int steps = 0;           ///< that were taken
  bool at_rest = false;    ///< else it still sank, or its forces do not balance
  double unbalanced = 0;   ///< sum of the sizes of all forces that no other balances, as a part of the ring's weight
  std::vector<Vec2> outline;
  std::vector<Vec3> points;  ///< the height z is 0 on the support
  std::vector<std::array<int, 3>> triangles;
};

/// BS 5058:1973, ISO 9073-9: a round specimen lies between two discs of 18 cm, its free ring sinks under its weight,
/// and the drape coefficient is the share of the ring that its shadow covers,
///   DC = (A_shadow - A_support)/(A_specimen - A_support);
/// G. E. Cusick, The dependence of fabric drape on bending and shear stiffness, J. Text. Inst. 56, T596 (1965).
///
/// The ring is clamped where the discs end. Its weight grows from a hundredth to all of it, as the table of the tester
/// is lowered: under all of it at once it would take twice as many folds, and keep them. At each weight it sinks in
/// steps of an implicit Euler method against a drag (K + M/s, s grows while little moves) to a stable equilibrium:
/// inertia plays no part. It is at rest where a step that a fall of 100 m would take moves no point by 1 um and what is
/// `unbalanced` then, without the drag, is less than 1e-3: points that stand still are not enough (a step whose solve
/// ends by rounding does not move either). So that the ring knows where
/// to fold, its weight is uneven by 2 % in a fixed pattern until it hangs, and even from then on; each `start` has the
/// pattern turned against the grain, and may find other folds. Cloth does not touch itself; `crossings` tells where
/// that would matter. Quadratic cells take assumed strains, and are narrow beside the support; others lock, and the
/// shadow is too large. Throws RunError where a weight on the way finds no equilibrium.
///
/// Internal friction is the fabric's: of a card with 2HB and 2HG sums of stops (core/material/laws/stops.hpp,
/// shear_friction.hpp; Wong 2014, eq. 4.2), that slip as the ring sinks and hold it where it stops. Bent for the first
/// time beyond K0 cloth bears
///   m = B k + 2HB/2 [N],
/// so that a fold of curvature k is as stiff as B + 2HB/(2 k) [N m]: the less curved, the more so, and B of KES is a
/// slope between 50 and 150 per m. The specimen sinks once, as in Cusick's tester; JIS L 1096 shakes it three times,
/// which is left out and would undo a part of the friction.
Draped drape(const Fabric& fabric, const Specimen& specimen, const DrapeTester& tester = {});

}  // namespace gambeson::laboratory
