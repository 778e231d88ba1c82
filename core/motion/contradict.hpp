#pragma once
/// Where the contacts of a step contradict each other. Internal to the contact part of a step.

#include "core/contact/response.hpp"

namespace gambeson {

/// Contacts contradict each other where cloth is pinched: between bodies that come closer than two layers, or where it
/// would have to bend more sharply than its control points can. Then no velocities keep what they ask for, or only such
/// as grow without bound from step to step, the impulses of both sides grow with each iteration, and the residual stays
/// far above the tolerance.
inline bool contradict(const ContactSolve& solve, double dt) {
  constexpr double kFar_m_per_s2 = 0.3;  // solves end at a thirtieth to a third of it
  return !solve.converged && !(solve.residual_m_per_s <= kFar_m_per_s2 * dt);
}

}  // namespace gambeson
