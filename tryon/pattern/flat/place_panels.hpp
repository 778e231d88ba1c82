#pragma once
/// Flat panels around a wearer by the regions of the body that they cover (regions.hpp): where each starts before its
/// seams are closed.
///
/// The body is cut in two by the frontal plane through its sides. All that covers the front of trunk and legs lies in
/// one plane as its seams have it (lay_panels.hpp), all that covers the back in another. Heights: shoulder seams lie on
/// the shoulders, else a crotch seam's lower end at the crotch, else the upper edge of skirts at the waist and that of
/// others under the armpits. Each plane is then bent about the vertical, without strain, around the convex hull of the
/// body at these heights, `clearance` off it: as far towards the sides as its other half leaves room, and straight on
/// from there. A sleeve is bent about the arm along the line from shoulder to hand, open towards the trunk, its highest
/// point at the shoulder joint, and as near to the arm as is free, so that its edges meet beyond it; it slides down the
/// arm until it is free of the other panels. Collars and waistbands that reach
/// around are rings above what they are sewn to. Where something passes through the body, all is tried again further
/// off it.

#include <functional>
#include <string>
#include <vector>

#include "tryon/pattern/flat/lay_panels.hpp"
#include "tryon/pattern/flat/panel.hpp"
#include "tryon/pattern/flat/regions.hpp"
#include "tryon/pattern/flat/standing_body.hpp"

namespace gambeson {

struct PlacedPanels {
  /// Of each panel of the pattern: a plane that its middle touches, and from its own plane to the bent surface.
  std::vector<PanelPlace> flat;
  std::vector<std::function<Vec3(Vec2)>> bent;
  /// Panels as they are laid: y is the height; those that cover trunk and legs at the front, and at the back.
  std::vector<LaidPanel> front, back;
};

/// The region of a panel; none where its word is none of regionNames().
std::optional<PanelRegion> regionOf(const Panel& panel);

/// Whether the arms of whoever is dressed are in the way: panels on the trunk or around arms.
bool coversArms(const FlatPattern& pattern);

/// Of a pattern whose panels all have a region. Throws InputError: "panels[k]" where a panel has none, or would pass
/// through the body (which part, by how much); "human" where the body lacks links.
PlacedPanels placePanels(const FlatPattern& pattern, const StandingBody& form);

/// A point of a panel that lies deepest in the body, of samples 2 cm apart; depth_m < 0 outside, very low where no part
/// of the body is near.
struct PanelDepth {
  double depth_m = -1e300;
  std::string segment;
};
PanelDepth depthInBody(const Panel& panel, const std::function<Vec3(Vec2)>& at, const StandingBody& form);

}  // namespace gambeson
