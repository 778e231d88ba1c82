#pragma once
/// Natural frequencies about an equilibrium.

#include "core/dynamics/structure.hpp"

namespace gambeson {

struct Mode {
  double omega_rad_per_s = 0;  ///< negative where the equilibrium is unstable: -sqrt(-omega^2)
  std::vector<double> shape;   ///< unknowns, mass-normalised
  double residual = 0;         ///< |K s - omega^2 M s| / |K s|
};

/// The lowest `count` modes of K s = omega^2 M s at y (empty: at rest) and time t, by shift-and-invert Lanczos with
/// full orthogonalisation; consistent mass unless `lumped_mass`. Free bodies have their rigid modes at zero.
std::vector<Mode> naturalModes(const Structure& structure, std::span<const double> y, double t, int count,
                               bool lumped_mass = false);

}  // namespace gambeson
