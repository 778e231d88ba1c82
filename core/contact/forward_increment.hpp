#pragma once
/// Contact by forward increment Lagrange multipliers (Carpenter, Taylor and Katona 1991; Man 2006, eq. 3.63 to 3.68 and
/// box 4).

#include "core/contact/method.hpp"

namespace gambeson {

/// The multipliers of a step are those that keep the positions at its end out of the bodies,
///   G (x(n) + dt v) <= 0,   v = v* - dt M^-1 G^T lambda,   lambda = [dt^2 G M^-1 G^T]^-1 G x*,   (3.67)
/// x* the trial position without them and G (eq. 3.26) of the rows at the start of the step. As printed all rows that
/// the trial penetrates are equations, and a multiplier of them may come out negative, which would hold the cloth to
/// the body: those rows are dropped, and the others solved again. That is the problem lambda >= 0, G x <= 0, lambda G x
/// = 0, which the sweeps of solveContacts solve, here without friction and with a rigid layer, to the same tolerance; a
/// sample that shares no point with another's is solved at once.
///
/// Friction has the bounds mu lambda of these multipliers (rub), and they that friction in turn, until neither changes
/// a velocity by more than the tolerance of a solve.
class ForwardIncrement : public BodyMethod {
 public:
  ContactSolve solve(const MethodStep& step, const LayeredRows& rows, std::span<Vec3> velocity, std::span<Vec3> warm,
                     std::span<Vec3> impulses, ContactWork& work, MethodWork& scratch) const override;
};

}  // namespace gambeson
