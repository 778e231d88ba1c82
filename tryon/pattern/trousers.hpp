#pragma once
/// Trousers of four rectangles, front and back of each leg (Man 2006, sections 5.2 and 5.4).

#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

/// Four equal rectangles, width w, as high as from hem to waist. The front and the back of a leg are joined along their
/// outer sides, and along their inner sides below the crotch; above it the fronts of both legs are joined to each
/// other, and the backs. All four meet in one point, the crotch. So the trunk is 4 w around, a leg 2 w, from waist to
/// hem.
///
/// A rectangle is cut at the crotch's level into two patches, hips and leg, since its inner side changes partners
/// there. Sides, inner sides of the legs and the cut are G1, the centre seams C0 and free to bend: no stiffness of
/// seams. v runs upward and u so that normals point outward; the weft runs upward (across w lies the warp).
///
/// At rest (Garment::patches) the legs are circular tubes side by side that touch along the line of the crotch: bent
/// but not strained rectangles. The garment starts opened (Garment::placed): its waist edge is a level ring around the
/// body's widest outline, grown to its length, from which the hips go over into the legs, and these lean as the body's
/// do. The crotch lies `crotch_ease_m` below that of the standing body, the waist `rise_m` above the crotch.
///
/// w is the least that leaves hips and thighs their ease: 4 w = (1 + ease) max(girth of the widest outline from the
/// waist down, twice the widest girth of a leg below the crotch).
struct TrousersPattern {
  double ease = 0.06;
  double rise_m = 0.24;         ///< crotch to waist edge
  double crotch_ease_m = 0.05;  ///< the body's crotch to that of the trousers
  double hem_m = 0.09;          ///< the ground to the hems, as they start
  double cell_m = 0.03;         ///< wanted size of a cell
  int degree = 2;
};

/// Throws InputError with the name of the measure that is out of its range, "garment.trousers" where the human lacks
/// thighs, shanks, a torso or a surface on them, or "hem_m" where less than 0.2 m would be left below the crotch.
Garment makeTrousers(const TrousersPattern& pattern, const BodyForm& form);

/// Where the patches stand in Garment::patches.
enum TrousersPatch {
  hips_front_left,
  hips_front_right,
  hips_back_left,
  hips_back_right,
  leg_front_left,
  leg_front_right,
  leg_back_left,
  leg_back_right
};
std::vector<std::string> trousersPatchNames();
/// The free edges: waist, hem_left, hem_right.
std::vector<std::string> trousersEdgeNames();

}  // namespace gambeson
