#pragma once
/// Panels that stand where their pattern says, but too low for seams to close over shoulders and arms.
///
/// A seam pulls two points together along the line between them. Where that line passes through the body, the edges
/// jam, or slide off to the wrong side: panels whose shoulder seams start below the shoulders stay open, and sleeves
/// close under the arms. GarmentCode's placements are up to 10 cm too low for its own bodies in this sense.

#include "tryon/pattern/flat/panel.hpp"
#include "tryon/pattern/flat/standing_body.hpp"

namespace gambeson {

struct PanelLift {
  double lift_m = 0;
  double through_m = 0, left_m = 0;  ///< length of seam whose lines pass through the body: as placed, and lifted
};

/// The least lift, of steps of 1 cm up to 25 cm, with which as little of the seams as can be passes through the body,
/// up to 2 cm of their length. `position_m`: where the garment is put. All panels have a placement.
PanelLift liftOverBody(const FlatPattern& pattern, const Vec3& position_m, const StandingBody& form);

}  // namespace gambeson
