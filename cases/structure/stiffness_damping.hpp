#pragma once
/// The stiffness part of Rayleigh's damping in a state of a structure.

#include <span>
#include <vector>

#include "core/motion/structure_motion.hpp"

namespace gambeson {

/// b K v on the components of the free points [N] and of the inner rates behind them [N m]; of cloth whose inner values
/// turn with the part of the material alone, as the solver has it (StructureSystem::damping). `q`: its points [m].
std::vector<double> stiffnessDamping(const Structure& s, const State& state, std::span<const Vec3> q);

}  // namespace gambeson
