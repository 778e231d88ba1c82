#pragma once
/// Whether cells are fine enough for the folds of thin cloth.

#include <cmath>

#include "core/material/fabric.hpp"

namespace gambeson {

/// Cells of side c that bend to a radius R stretch by about (c/R)^2 of what their thickness t = sqrt(12 B/(E h)), that
/// of a plate of the same stiffnesses, sees as bending; where this is much, cloth folds as if it were stiffer
/// (membrane locking). Cloth folds under its weight w to radii of about R = (B/w)^(1/3) [m], so that
///   N = c^2/(t R)
/// tells. Of a strip of 8 to 32 cells of degree 2 that hangs from a clamped edge (w L^3/B = 10 and 100,
/// tests/verify/heavy_elastica.json with thinner strips) the tip is off by 0.7 % of the length at N = 4 to 7, 2 to 3 at
/// 15 to 20, 5 at 45, 10 at 70 to 150, 20 to 25 at 80 (16 cells) to 210; other quantities by a few times that. B is the
/// smaller of weft and warp, the law's least slope; E h the larger. 0 without weight or where cloth
/// has no bending stiffness to speak of in this way (solids, tension fields). `cell_m` > 0, `gravity` >= 0.
inline double coarseness(const Fabric& f, double cell_m, double gravity_m_per_s2) {
  const GivenRigidities* given = givenRigidities(f.law);
  const double B = given ? given->least_Nm() : 0, w = f.surfaceDensity() * gravity_m_per_s2,
               Eh = std::fmax(f.young_weft_Pa, f.young_warp_Pa) * f.thickness_m;
  if (f.tension_field || !(B > 0 && w > 0 && Eh > 0)) return 0;
  return cell_m * cell_m / (std::sqrt(12 * B / Eh) * std::cbrt(B / w));
}

/// From here on a tip of heavy cloth is off by some 3 % of its length.
constexpr double kCoarse = 20;

/// What those tips are off by, from kCoarse on.
inline const char* coarseError(double coarseness) {
  return coarseness < 35 ? "some 4 %" : coarseness < 60 ? "some 5 %" : "10 to 25 %";
}

/// A run takes 1/cell to this as long: cells by the square, steps in proportion. Measured on trousers of 50, 40 and 30
/// mm: 3.6, with contacts that are solved longer.
constexpr double kTimeOfCells = 3;

/// The largest cell that is not coarser than kCoarse, for a cell whose coarseness is known [m].
inline double fineEnough(double cell_m, double coarseness) { return cell_m * std::sqrt(kCoarse / coarseness); }

}  // namespace gambeson
