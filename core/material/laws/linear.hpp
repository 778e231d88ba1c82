#pragma once
/// Resultants in proportion to strains: what membrane, plain bending and laminates have in common.

#include "core/material/laws/law.hpp"

namespace gambeson {

/// A stiffness without coupling of normal strains and shear, its entries 11, 22, 12 and 33.
template <class P>
struct OrthotropicStiffness {
  P s11, s22, s12, s33;
};
/// A stiffness that couples nothing.
template <class P>
struct DiagonalStiffness {
  P s11, s22, s33;
};

/// y = S x + y, S symmetric in the order of Voigt.
template <class S, class P>
GAMBESON_LAW void addProduct(const P* stiffness, const S* x, S* y) {
  y[0] += stiffness[0] * x[0] + stiffness[3] * x[1] + stiffness[4] * x[2];
  y[1] += stiffness[3] * x[0] + stiffness[1] * x[1] + stiffness[5] * x[2];
  y[2] += stiffness[4] * x[0] + stiffness[5] * x[1] + stiffness[2] * x[2];
}

/// y = S x, W = x . S x / 2 [J/m^2], slope S. S positive semidefinite: [N/m] for strains, [N m] for curvatures. In the
/// order of Voigt.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void linearLaw(const P* stiffness, const S* x, Answer<S, 3>& out) {
  S* y = out.resultant;
  y[0] = y[1] = y[2] = S{};
  addProduct(stiffness, x, y);
  if constexpr (kParts & with_energy) out.energy += 0.5 * (y[0] * x[0] + y[1] * x[1] + y[2] * x[2]);
  if constexpr (kParts & with_slope)
    for (int i = 0; i < 6; ++i) out.slope[i] = spread<S>(stiffness[i]);
}

/// The same for fewer entries.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void linearLaw(const OrthotropicStiffness<P>& s, const S* x, Answer<S, 3>& out) {
  S* y = out.resultant;
  y[0] = s.s11 * x[0] + s.s12 * x[1];
  y[1] = s.s12 * x[0] + s.s22 * x[1];
  y[2] = s.s33 * x[2];
  if constexpr (kParts & with_energy) out.energy += 0.5 * (y[0] * x[0] + y[1] * x[1] + y[2] * x[2]);
  if constexpr (kParts & with_slope) {
    const P all[6] = {s.s11, s.s22, s.s33, s.s12, P{}, P{}};
    for (int i = 0; i < 6; ++i) out.slope[i] = spread<S>(all[i]);
  }
}
template <unsigned kParts, class S, class P>
GAMBESON_LAW void linearLaw(const DiagonalStiffness<P>& s, const S* x, Answer<S, 3>& out) {
  S* y = out.resultant;
  y[0] = s.s11 * x[0];
  y[1] = s.s22 * x[1];
  y[2] = s.s33 * x[2];
  if constexpr (kParts & with_energy) {
    out.energy += 0.5 * y[0] * x[0];
    out.energy += 0.5 * y[1] * x[1];
    out.energy += 0.5 * y[2] * x[2];
  }
  if constexpr (kParts & with_slope) {
    const P all[6] = {s.s11, s.s22, s.s33, P{}, P{}, P{}};
    for (int i = 0; i < 6; ++i) out.slope[i] = spread<S>(all[i]);
  }
}

}  // namespace gambeson
