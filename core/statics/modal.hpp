#pragma once
/// Natural frequencies about an equilibrium.

#include "core/statics/structure.hpp"

namespace gambeson {

struct Mode {
  double omega_rad_per_s = 0;  ///< negative where the equilibrium is unstable: -sqrt(-omega^2)
  std::vector<double> shape;   ///< unknowns, mass-normalised
  /// |s - (omega^2 - sigma) (K - sigma M)^-1 M s| in M's norm, sigma the shift: some eigenvalue is no farther from
  /// omega^2 than this part of its distance from sigma (Parlett 1998, section 4.5, for the inverse). |K s - omega^2 M
  /// s| would tell nothing of thin sheets: a rounding of s in the plane, times the membrane's stiffness, drowns
  /// bending.
  double residual = 0;
  /// eps |s|^T |K| |s| / omega^2: what the rounding of K's own entries leaves open of omega^2 at most, relative; 0 of
  /// rigid modes.
  double rounding = 0;
};

/// The lowest `count` modes of K s = omega^2 M s at y (empty: at rest) and time t, by shift-and-invert Lanczos with
/// full orthogonalisation; consistent mass unless `lumped_mass`. Repeated modes are all found: after a run has
/// converged, others look in the complement of what is known until none finds a lower mode. Where K is not positive
/// definite (free bodies, unstable equilibria) the shift goes below the lowest eigenvalue, and an omega^2 within
/// 1e-3 of the first such shift, 1e-10 max K_ii/M_ii, is zero: a rigid mode. `history`: committed at y; empty: of new
/// cloth.
std::vector<Mode> naturalModes(const Structure& structure, std::span<const double> y, double t, int count,
                               bool lumped_mass = false, std::span<const double> history = {});

class System;
/// The same for any system.
std::vector<Mode> lowestModes(System& system, std::span<const double> y, double t, int count, bool lumped_mass = false);

}  // namespace gambeson
