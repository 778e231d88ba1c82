#pragma once
/// The iteration where something holds all points together (MotionHold): steps along the gradient. Internal to the
/// solve.

#include "core/contact/response.hpp"

namespace gambeson {

/// The hold takes its part of what the points of the rows have changed, work.moved - work.base; nothing without one.
void holdPoints(ContactWork& work);

/// What tractions of a held island's rows make its free points do.
void moveHeld(const std::vector<ContactWork::Quad>& tractions, const ContactWork::Island& island, ContactWork& work,
              std::vector<ContactWork::Quad>& moved);

/// `iterate` with a hold: all rows take a step at once, bounded by the row sums D over the rows that carry something,
/// which a hold (P <= M^-1) does not make larger. work.moved is that of the point before the last step.
void iterateHeld(double goal_m_per_s, int last, ContactWork& work);

/// What the bounds of the rows would be if all carried something, with a hold.
void largestBounds(ContactWork& work);

}  // namespace gambeson
