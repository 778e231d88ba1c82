#pragma once
/// What a degenerated shell's points are made of, through the thickness.
///
/// St. Venant's law at two points through the thickness gives n = A E + B kappa, m = B E + D kappa
/// (core/material/section.hpp): the part of the strain that is linear in the height, z kappa, is what the laws of
/// bending of core/material/laws/bending_laws.hpp see. Where a fabric has such a law its moment m(kappa, history)
/// stands in the place of D kappa, per area of the mid-surface at rest; friction in shear adds to n. Transverse shear
/// stays linear.

#include "core/cloth/stress.hpp"
#include "core/material/fabric_law.hpp"

namespace gambeson {

struct ShellLaw {
  Section section;           ///< of linear laws; B = 0 with others
  double shear_N_per_m = 0;  ///< G, in both directions
  double z2_m2 = 0;          ///< z0²
  bool from_flat = false;    ///< curvature counts from flat, not from the shape at rest
  LawUse use;                ///< of `point`; none: linear
  PointLaw point;
  Section steepest;  ///< of laws that are not linear: with their steepest slopes

  bool isLinear() const { return use.kinds == 0 && !use.shears; }
  int historySize() const { return use.historySize(); }
};

/// Of a fabric that a shell can have (whatShellLacks). Jamming is left out. `shear_factor` > 0, of transverse shear.
ShellLaw shellLaw(const Fabric& fabric, double shear_factor);

/// n [N/m] and m [N] of a law that is not linear, their slopes, and energies of each [J/m²]: stored, and lost since the
/// history was committed. The resultants are the gradient of both by strain (E11, E22, 2 E12) and by curvature
/// (k11, k22, 2 k12) [1/m].
PointAnswer<double> answerOf(const ShellLaw& law, const Vec3& strain, const Vec3& curvature, History<double> history);

/// What the points of one cell remember, one after the other, each ShellLaw::historySize() doubles.
struct CellMemory {
  const double* committed = nullptr;  ///< null: new cloth
  double* trial = nullptr;            ///< null: not asked
  double elapsed_s = 0;

  History<double> of(const ShellLaw& law, std::size_t point) const {
    const auto first = static_cast<long>(point) * law.historySize();
    History<double> own{committed ? committed + first : nullptr, trial ? trial + first : nullptr};
    own.elapsed_s = elapsed_s;
    return own;
  }
};

}  // namespace gambeson
