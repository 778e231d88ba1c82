#pragma once
/// The iteration of a contact solve. Internal to the solve.

#include "core/contact/response.hpp"

namespace gambeson {

/// Where the iteration stands between two checks of the rows that are left out.
struct ContactSequence {
  double beta = 0, momentum = 1;
  int iterations = 0;
  double residual_m_per_s = 0;
  bool done = false;
};

/// Starts from work.traction: sets the candidates and the velocities that go with them, work.moved.
void startIteration(ContactWork& work);

/// Nesterov's sequence (O'Donoghue and Candes, 2015, restart by the gradient) up to the goal or to `last` iterations;
/// work.candidate holds the result. The residual is that of the point before the last step.
void iterate(double goal_m_per_s, int last, ContactSequence& sequence, ContactWork& work);

/// What the bounds of the rows would be if all carried something.
void largestBounds(ContactWork& work);

}  // namespace gambeson
