#pragma once
/// What supports turn the directors of a sheet with: couples, which the forces on its points do not show.

#include <set>
#include <span>
#include <vector>

#include "core/statics/structure.hpp"

namespace gambeson {

/// Of each director [N m], of forces of the sheet and of loads at rest: what equilibrium leaves at each, which is
/// rounding where nothing holds it. Empty where the cloth has no directors (Cloth::turnsInner). `programs`: values of
/// the structure's programs.
std::vector<Vec3> directorMoments(const Structure& s, const ClothState& state, std::span<const double> programs);
/// The same of a motion whose inner rates and accelerations are these, the prescribed ones among them.
std::vector<Vec3> directorMoments(const Structure& s, const ClothState& state, std::span<const double> programs,
                                  std::span<const double> rate, std::span<const double> acceleration);
/// Of small displacements, from the elastic forces on the inner unknowns.
std::vector<Vec3> directorMoments(const Structure& s, std::span<const double> pull, std::span<const double> programs);

/// The directors on edges; none where the cloth has none.
std::set<int> directorsOn(const Cloth& cloth, std::span<const PatchEdge> edges);

}  // namespace gambeson
