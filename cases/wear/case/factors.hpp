#pragma once
/// The factors of a case: the one place that applies them.

#include "cases/wear/case/case.hpp"

namespace gambeson {

/// The case with its factors multiplied in, all factors 1 again:
///     thickness t: h t, so that mass and membrane stiffness (density and moduli per volume stay) change by t;
///                  B0, twist and seam stiffness t^3; a given contact layer t, else the layer is the thickness itself
///     bending b:   B0, twist and seam stiffness b
///     membrane m:  moduli m
///     weight w:    gravity w
///     inertia i:   density i, gravity 1/i
///     drag d:      drag coefficient d
///     friction f:  every coefficient of friction, and viscosity, f
/// Supports and the compliance of contact stay. Curvatures of the bending law stay (kappa0: the same B0 rule
/// at every thickness).
/// The seams of garment files are not yet read here: scaleSeams does the same to all seams of a built garment.
Case withFactors(const Case& c);
void scaleSeams(Garment& garment, const FactorsCase& factors);

/// "thickness x 0.5, weight x 1.1"; empty where all are 1.
std::string factorsText(const FactorsCase& factors);

}  // namespace gambeson
