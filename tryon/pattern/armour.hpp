#pragma once
/// What is worn over shorts: a belt and a shirt (without sleeves the armour of Zheng 2013, section 6.2), and a skirt.
/// All are drafted on the standing body (x forward, y left, z up) over the garments that are already worn, symmetric
/// about its median plane. Rows of control points of belt, wrap, panels and belly are horizontal; v runs upward and u
/// so that normals point outward.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

/// A garment under the one that is drafted. Between two garments cloth keeps half the sum of their thicknesses, to the
/// body its own.
struct Worn {
  const Garment* garment = nullptr;
  double layer_m = 0;  ///< its thickness in contact
};

/// One patch, closed on itself by a G1 seam at the back.
///
/// At rest it is shorter than the curve that it lies on, the wrap of the body moved out by the garments under it, by
/// the stretch lambda at which a strip of its width carries the tension:
///   T = width thickness E lambda (lambda^2 - 1) / 2        (St. Venant-Kirchhoff, free to contract across)
/// It then presses 2 pi T on a round, smooth waist: pressure per length T / R, R the radius of curvature, summed over a
/// closed curve. It starts stretched further (Garment::placed), free of the garments below.
struct BeltPattern {
  double width_m = 0.05;
  double tension_N = 2;
  double below_waist_m = 0.01;  ///< upper edge below the edge "waist" of the garment under it; without one, the belt's
                                ///< middle stands at the origin of the torso's frame
  double cell_m = 0.022;
  int degree = 2;
  double gap_m = 0.001;  ///< that it starts farther out than the garments under it ask for
};
/// `fabric` is the belt's, `layer_m` its thickness in contact.
Garment makeBelt(const BeltPattern& pattern, const BodyForm& form, const Fabric& fabric, double layer_m,
                 std::span<const Worn> under);
/// The stretch at which a strip carries `tension_N`.
double stretchAt(double tension_N, double width_m, const Fabric& fabric);

/// Six patches, and four more for each sleeve where there are any; all seams C0 with a rotational spring.
///
///   front      between the side edges of the wrap, from the hem up to the chest; the neckline is trimmed out of its
///              upper edge
///   back       from the upper edge of the wrap up to the shoulder blades
///   strap_left, strap_right   over the shoulders, on parts of the upper edges of front and back
///   side_wrap  from the front's left edge around the sides and the back to the front's right edge
///   belly      hangs from the middle of the front's hem, over belt and shorts
///
/// Cross-sections are those of the convex hull of torso, pelvis and thighs, grown by 1 + ease, and farther out where
/// garments lie under it. Towards the upper edge they go over into the hull of chest and shoulders. A strap is a
/// straight strip that lies evenly on the slope of the shoulder (tryon/pattern/strap.hpp).
///
/// An armhole is bounded by the front's edge above the wrap, the strap's outer edge, the edge of the back, and the part
/// of the wrap's upper edge between back and front. With sleeves there are no margins, so that these four meet at
/// corners, and to each a strip of the sleeve is sewn along its whole upper edge:
///
///   sleeve_front, sleeve_top, sleeve_back, sleeve_under (_left and _right)   from the hem up to the armhole; u runs
///              counterclockwise seen from the shoulder (tryon/pattern/sleeve.hpp)
struct ShirtPattern {
  double ease = 0.06;
  double hem_above_waist_m =
      0.01;  ///< above the edge "waist" of a garment under it, or the origin of the torso's frame
  double top_below_shoulder_m = 0.02;  ///< upper edges of front and back below the shoulder joints
  double wrap_share = 0.66;            ///< of the front's height that the side wrap has
  double front_share = 0.36;           ///< of the girth that the front covers below
  double strap_width_m = 0.0385;
  double neck_share = 0.44;  ///< distance between the straps over that of the shoulder joints
  double neck_depth_m = 0.07;
  double margin_m = 0.025;  ///< between strap and armhole, on either panel; none with sleeves
  double belly_length_m = 0.17;
  double belly_share = 0.75;  ///< of the front's width below
  double cell_m = 0.022;
  int degree = 2;
  double gap_m = 0.001;  ///< more than the garments under it ask for
  double seam_stiffness_N = 0.01;
  std::optional<double> sleeve_length_m;  ///< from the shoulder joint along the arm; none: without sleeves
  double sleeve_ease = 0.15;              ///< girth of a sleeve = (1 + ease) that of the arm
  std::optional<double> sleeve_hem_ease;  ///< of its hem over the arm there; without it the sleeve hangs (ArmForm)
};
Garment makeShirt(const ShirtPattern& pattern, const BodyForm& form, double layer_m, std::span<const Worn> under);

/// Where the patches of the shirt stand in Garment::patches; the last eight are those of sleeves.
enum ShirtPatch {
  front,
  back,
  strap_left,
  strap_right,
  side_wrap,
  belly,
  sleeve_front_left,
  sleeve_top_left,
  sleeve_back_left,
  sleeve_under_left,
  sleeve_front_right,
  sleeve_top_right,
  sleeve_back_right,
  sleeve_under_right
};
/// Their names, and those of the patches of belt and skirt.
inline std::vector<std::string> shirtPatchNames(bool sleeves = false) {
  std::vector<std::string> out{"front", "back", "strap_left", "strap_right", "side_wrap", "belly"};
  if (sleeves)
    for (const char* side : {"_left", "_right"})
      for (const char* strip : {"sleeve_front", "sleeve_top", "sleeve_back", "sleeve_under"})
        out.push_back(std::string(strip) + side);
  return out;
}
/// Names of its edges.
inline std::vector<std::string> shirtEdgeNames(bool sleeves = false) {
  std::vector<std::string> out{"hem", "neck_front", "neck_back", "belly_hem"};
  if (sleeves) out.insert(out.end(), {"cuff_left", "cuff_right"});
  return out;
}
inline std::vector<std::string> beltPatchNames() { return {"belt"}; }
inline std::vector<std::string> skirtPatchNames() {
  return {"panel_0", "panel_1", "panel_2", "panel_3", "panel_4", "panel_5", "panel_6", "panel_7"};
}

/// A flared skirt of eight equal panels, joined by G1 seams: a cone from the waist (the edge "waist" of a garment under
/// it, or the origin of the torso's frame) down, and wider where body or garments ask for it (Zheng 2013,
/// section 3.7.4: eight quadratic patches with 960 control points).
struct SkirtPattern {
  double length_m = 0.5;
  double ease = 0.04;      ///< at the waist
  double flare_rad = 0.3;  ///< of its sides against the vertical
  int cells_around = 64, cells_along = 10;
  int degree = 2;
  double gap_m = 0.001;
};
Garment makeSkirt(const SkirtPattern& pattern, const BodyForm& form, double layer_m, std::span<const Worn> under);

/// The hull of garments under a height range, without their sleeves, moved out by half the sum of the thicknesses and
/// `gap_m`; a height where nothing is worn has nothing. False where nothing is worn at all.
bool wrapOf(std::span<const Worn> under, double layer_m, double gap_m, double from, double to, int heights, Wrap& out);
/// The same of their left sleeves, at heights in the frame that X_FW takes points to.
bool sleeveWrapOf(std::span<const Worn> under, const Pose& X_FW, double layer_m, double gap_m, double from, double to,
                  int heights, Wrap& out);
/// Height of the edge "waist" of the garments, the outermost that has one; `otherwise` where none has.
double waistOf(std::span<const Worn> under, double otherwise);

}  // namespace gambeson
