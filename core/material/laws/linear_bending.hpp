#pragma once
/// Bending in proportion to curvature, with rigidities of its own.

#include "core/material/laws/given_rigidities.hpp"
#include "core/material/laws/linear.hpp"

namespace gambeson {

/// m = D k [N], W = k . D k / 2, with k = (k11, k22, 2 k12) the changes of curvature [1/m] (Zheng 2013, eq. 2.9). `D`
/// [N m]: six entries in the order of Voigt, or a DiagonalStiffness. The consistent bending of 2.2.2 and laminated
/// sections are of this kind too. Valid for D positive semidefinite and curvatures far below 1 / thickness.
template <unsigned kParts, class S, class Stiffness>
GAMBESON_LAW void linearMoment(const Stiffness& D, const S* k, Answer<S, 3>& out) {
  linearLaw<kParts>(D, k, out);
}

/// D = diag(weft, warp, twist), all given.
struct LinearBending : GivenRigidities {
  bool operator==(const LinearBending&) const = default;
  static LinearBending mixed(const LinearBending& a, const LinearBending& b, double w) {
    return {GivenRigidities::mixed(a, b, w)};
  }
};

}  // namespace gambeson
