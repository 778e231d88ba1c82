#pragma once
/// Whether panels go around their wearer, before anything is sewn.

#include <limits>
#include <string>
#include <vector>

#include "tryon/pattern/flat/place_panels.hpp"

namespace gambeson {

/// What the tape measures of the standing body, and how wide the panels around it are together [m].
struct PanelGirth {
  std::string where;  ///< "chest", "waist", "hip", "left thigh", "right upper arm", ..
  double height_m = 0, body_m = 0, panels_m = 0;
  double short_m() const { return body_m - panels_m; }
};

/// At chest, waist and hip where side seams close panels to a ring within 12 cm (chest: 15 cm) of there, measured at
/// the nearest such height, or beside a seam around the body that lies within 3 cm of it, where neither side is whole;
/// around thighs and upper arms where panels cover legs and arms: of a sleeve its widest line. The chest is measured
/// without arms, each hull as a tape lies. Folds, darts that are not cut and curves of the body
/// within a panel are not seen: what is short here is short, what is not may be.
std::vector<PanelGirth> panelGirths(const FlatPattern& pattern, const std::vector<LaidPanel>& front,
                                    const std::vector<LaidPanel>& back, const StandingBody& form);

/// Panels that stand upright by their own placements, as PlacedPanels has them: y is the height.
void layAsPlaced(const FlatPattern& pattern, const Vec3& shift_m, std::vector<LaidPanel>& front,
                 std::vector<LaidPanel>& back);

/// "at the hip (at 0.93 m) the wearer is 98.0 cm around and the panels 92.0 cm: 6.0 cm short; ..", the shortest first;
/// empty where nothing is short. Where cloth would have to be stretched beyond what it stands (a share of its length),
/// that is said.
std::string shortText(std::vector<PanelGirth> girths, double stands = std::numeric_limits<double>::infinity());

}  // namespace gambeson
