#pragma once
/// Panels that stand where their pattern says, but too low for seams to close over shoulders and arms.
///
/// A seam pulls two points together along the line between them. Where that line passes through the body, the edges
/// jam, or slide off to the wrong side: panels whose shoulder seams start below the shoulders stay open, and sleeves
/// close under the arms. GarmentCode's placements are up to 10 cm too low for its own bodies in this sense.

#include <vector>

#include "tryon/pattern/flat/panel.hpp"
#include "tryon/pattern/flat/standing_body.hpp"

namespace gambeson {

struct PanelLift {
  std::vector<double> panel_m;  ///< by which each panel is lifted; empty: none is
  double through_m = 0;         ///< length of seam whose lines pass through the body, as placed
  double left_m = 0;            ///< and lifted
};

/// First panels are moved in height by themselves, so that the points of their seams come to the same height in the
/// mean (least squares by length; panels of one height in the mean stay there): else they draw each other down while
/// they close. Then all are lifted by steps of 1 cm up to 25 cm, to where as little of the seams as can be passes
/// through the body, up to 2 cm of their length, and from there on half as far as at most a fifth of what does as
/// placed passes through (corners under the arms, which slide off). Nothing is lifted where at most 2 cm do as placed.
/// `position_m`: where the garment is put. All panels have a placement.
PanelLift liftOverBody(const FlatPattern& pattern, const Vec3& position_m, const StandingBody& form);

}  // namespace gambeson
