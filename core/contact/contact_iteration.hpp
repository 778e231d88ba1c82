#pragma once
/// The iteration of a contact solve. Internal to the solve.
///
/// A sweep takes the rows of an island one after the other, in the order of row_order.hpp, and gives each the traction
/// that solves its own condition while the others stay: tau' = P(tau - (v - drift + c tau_n n)/(D + c)) with the row's
/// diagonal entry D. Between two sweeps the tractions go on along the last change, by Nesterov's sequence (O'Donoghue
/// and Candes, 2015, restart by the gradient; a restart keeps half of the momentum's index). What converges slowly here
/// are patterns of pressure that hardly move the cloth, since samples outnumber its points. Steps along the gradient
/// are bounded by the row sums of the operator, ten times its diagonal; a sweep is not, and sees these patterns ten
/// times as large: solves of walking and aiming armour take 0.35 to 0.45 of the iterations. Sweeps with momentum are no
/// gradient method and may go round; where an island's residual has not fallen for some time, or has grown out of hand,
/// its steps become shorter.
///
/// Where something ties all points (MotionHold) a row cannot be taken alone: held_iteration.hpp. But if that is rows
/// C v = 0 for velocities (seams), what a row's traction does to points near it along the seam is known beforehand
/// (ProjectingHold::ties), and a sweep counts it: the row's own entry and its pushes are those of P = M^-1 - H, less
/// entries that hardly count, and every few sweeps, and wherever the residual is looked at, the velocities are those of
/// P exactly. A sweep that saw M^-1 alone, with the projection after it, would be Gauss and Seidel's method by blocks,
/// and slow where a light side of a seam is touched: the projection takes back all but the light side's share of what a
/// row has pushed.

#include "core/contact/response.hpp"

namespace gambeson {

/// Starts from work.traction and what that does to all free points, work.change: sets the candidates and the velocities
/// that go with them, work.moved.
void startIteration(ContactWork& work);

/// v - drift of a row at work.moved, less its normal part.
Vec3 slipOf(const ContactWork& work, int row);

/// Iterates on every island that is not done, up to the goal or to `last` iterations; work.candidate holds the result,
/// work.moved the velocities that go with it. The last quarter of the `most` that a solve may take goes without
/// momentum: without friction a sweep alone never raises the energy, and rows that contradict each other end there.
void iterate(double goal_m_per_s, int last, int most, ContactWork& work);

}  // namespace gambeson
