#pragma once
/// The stiffness of the degenerated shell in positions and spins.

#include <memory>

#include "core/cloth/degenerated/degenerated_shell.hpp"

namespace gambeson {

/// K is the second derivative of E(x + u, exp(w) d) by u and w at zero, spins w normal to d: with g = dE/dd,
///   K_uw = H_ud Q,  K_ww = Qᵀ H_dd Q - (g . d) P,   Q w = w x d,  P = 1 - d dᵀ.
/// The last term is the director's own second derivative, which Man 2006, eq. 2.61, leaves out: without it Newton's
/// iteration is not quadratic. What is idle is drilling, held by ShellCell::hold_Nm d dᵀ.
std::unique_ptr<ClothTangent> degeneratedTangent(const DegeneratedShell& cloth);

}  // namespace gambeson
