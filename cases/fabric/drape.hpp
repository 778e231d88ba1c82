#pragma once
/// Cusick's drape tester, in the virtual laboratory.

#include <array>
#include <vector>

#include "cases/fabric/laboratory.hpp"
#include "core/math/vec.hpp"

namespace gambeson::laboratory {

constexpr double kDrapeSupport_m = 0.18;   ///< diameter of the discs that hold the specimen
constexpr double kDrapeSpecimen_m = 0.30;  ///< its diameter; 0.24 for limp cloth, 0.36 for stiff
constexpr int kDrapeStarts = 3;            ///< whose mean is the result, as testers take that of several drapes

/// What is left of the specimen in the picture, and what is read off it.
struct Draped {
  double coefficient = 0;  ///< share of the free ring that the shadow covers
  int nodes = 0;           ///< folds
  long crossings = 0;      ///< pairs of triangles that pass through each other: cloth does not touch itself here
  int steps = 0;           ///< until it was at rest
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
/// inertia plays no part. So that it knows where to fold, its weight is uneven by 2 % in a fixed pattern until it
/// hangs, and even from then on; each `start` has the pattern turned against the grain, and may find other folds. Cloth
/// does not touch itself; `crossings` tells where that would matter. Quadratic cells take assumed strains, and are
/// narrow beside the support; others lock, and the shadow is too large. Throws RunError where it finds no rest.
Draped drape(const Fabric& fabric, const Specimen& specimen, double specimen_m = kDrapeSpecimen_m, int start = 0);

}  // namespace gambeson::laboratory
