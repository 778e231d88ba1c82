#pragma once
/// Damping by the cloth itself.
///
/// In explicit steps the force - D(q) v is evaluated at the positions at the end of a step and at the velocity of its
/// half step,
///   M (v_{n+3/2} - v_{n+1/2}) = h (f(q_{n+1}) - D(q_{n+1}) v_{n+1/2}),
/// so that nothing is solved. Velocities lag by h/2: damped motion is of first order in h, undamped motion of second. A
/// mode with the frequency w and the part z of critical damping is stable for w h < 2 (sqrt(1 + z^2) - z), that is
/// where h^2 K + 2 h D <= 4 M (core/motion/frequency.cpp).

#include "core/motion/model.hpp"

namespace gambeson {

/// Adds the damping of the cloth at s.p with the velocities v of the free points to s.a, which holds forces, and leaves
/// it in w.damping, with the power that it takes at v, never negative, in w.damping_power_W. Zero of cloth that does
/// not damp.
void addClothDamping(const Model& model, std::span<const Vec3> v, State& s, StepWork& w);

/// The power that the force in w.damping takes at s.v [W]: what closes the balance of energy of the scheme to second
/// order, as velocities at full steps are those of the kinetic energy.
double clothDampingPower(const State& s, const StepWork& w);

/// The damping force on the free points at the positions q of all points and the velocities v of the free ones [N];
/// empty of cloth that does not damp.
std::vector<Vec3> clothDamping(const Cloth& cloth, std::span<const Vec3> q, std::span<const Vec3> v);

}  // namespace gambeson
