#pragma once
/// Bending of a homogeneous sheet, which its membrane determines.

#include "core/material/laws/given_rigidities.hpp"

namespace gambeson {

/// D = h^2/12 A, B = 0: a homogeneous St. Venant-Kirchhoff sheet of thickness h [m] (Zheng 2013, 2.2.2, `consistent
/// bending`, which stiffens cloth too much). A solid: free of stress in its curved rest shape.
struct ConsistentBending {
  static constexpr bool is_solid = true;

  bool operator==(const ConsistentBending&) const = default;
  Section section(const Voigt& A, double thickness_m) const {
    Section section{A, {}, {}};
    for (int i = 0; i < 6; ++i) section.D[i] = A[i] * thickness_m * thickness_m / 12;
    return section;
  }
  void thicken(double /*factor*/) {}  // follows the membrane and the thickness
  static ConsistentBending mixed(const ConsistentBending& a, const ConsistentBending&, double) { return a; }
};

}  // namespace gambeson
