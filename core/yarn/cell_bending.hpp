#pragma once
/// How a flat cell of yarns begins to bend: what W(E, k) = Wm(E) + k . b(E) + 1/2 k . D(E) . k has of curvature.

#include <array>

#include "core/yarn/cell_equilibrium.hpp"

namespace gambeson {

/// k = (k11, k22, 2 k12). By area of the cell at rest.
struct CellBending {
  std::array<double, 3> moment_N{};     ///< b1, b2, b3
  std::array<double, 6> rigidity_Nm{};  ///< D11, D22, D33, D12, D13, D23
};

/// Of a flat equilibrium, the strain of the middle of the cloth kept: the sections go with the cylinder (carried),
/// follow to first order as they like, and the force that moves a yarn as a whole through the cloth is borne from
/// outside (yarns under tension would slip inwards, to where they are shorter, and loose ones have nothing to hold
/// them; one that lies off the middle is stretched by the bend). To a bend k about the direction t the energy answers
///   b(t) = b1 c² + b2 s² + 2 b3 c s,
///   D(t) = D11 c⁴ + D22 s⁴ + (2 D12 + 4 D33) c² s² + 4 D13 c³ s + 4 D23 c s³,  c = cos t, s = sin t,
/// D(t) = d²W/dk² - g . K^-1 g with g = d²W/(dk dx), by central differences (h = 1e-4 a period, error of h²). b comes
/// from three directions, D from five. Cylinders cannot part D12 from D33, and no lattice is bent into a saddle: D12 =
/// 0, which is exact where yarns do not press on each other (each answers its own bend and its own twist) and lacks
/// what they answer to each other's bend where they do, at most 5e-4 of D11 (core/yarn/DECISIONS.md). Throws RunError
/// where the cell is not stable, is bent or has friction, InputError with the key "extent" where it is a quarter.
CellBending bendingOf(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections, EquilibriumWork& work);

}  // namespace gambeson
