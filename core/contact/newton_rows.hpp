#pragma once
/// Newton's method for islands of rows that sweeps solve slowly. Internal to a contact solve.
///
/// Cloth that is pulled tight over a body (a cord, a stiff sleeve) presses with 1e4 to 1e6 times what stops it by
/// itself. Then what is left over is in patterns of traction that hardly move the cloth, where samples outnumber points
/// or a sample touches two bodies: the operator A of the solve has no part of them but the layer's compliance, some
/// 1e-6 of 1/rho. Without friction, Nesterov's sequence finds them; friction, which is no gradient, starts it again and
/// again.
///
/// Of tractions tau_k that are known, the next ones are those of the proximal problem
///   tau = P(tau_k - sigma (v - drift + c tau_n n)),   v = base + M^-1 B^T a tau,   sigma = s/slope of each row,
/// in the velocities v of the island's points: M (v - base) = B^T a tau(v), which Newton's method solves with P's slope
/// (coulombImpulse) and a sparse factorisation. tau_k converges by 1/(1 + s lambda) in a pattern of eigenvalue lambda
/// (in parts of the slope). A great s needs few tau_k, but Newton's method finds which rows carry and slip only from
/// near: s grows where it takes few factorisations, and becomes less, from the last tau_k on, where it takes many.

#include "core/contact/response.hpp"

namespace gambeson {

/// Solves each island that is not done to `goal`, from work.candidate and work.moved on: sets these, and what the
/// iteration knows of the island, whose iterations count a factorisation as one. An island that Newton's method does
/// not solve stays where it was. Islands are solved side by side, each by one thread.
void finishByNewton(double goal_m_per_s, ContactWork& work);

}  // namespace gambeson
