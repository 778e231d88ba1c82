#pragma once
/// Builders of garments at rest: a sheet, a tube, and shorts drafted on a body. The fabric is left for the case.

#include <optional>
#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "human/body/body.hpp"
#include "tryon/pattern/form.hpp"

namespace gambeson {

/// A flat rectangle, one patch: corner + s width axis_u + t height axis_v, s and t in [0, 1]. The axes are unit and
/// orthogonal; the weft runs along axis_u.
struct SheetPattern {
  double width_m = 0, height_m = 0;
  int cells_u = 16, cells_v = 16;
  int degree = 2;
  Vec3 corner{};
  Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};
Garment makeSheet(const SheetPattern& pattern);

/// A flat disc: one patch of square cells, trimmed by a circle. (A rational patch whose corners lie on the circle is
/// singular there: with 2 n cells across its explicit step is 1/16 of that with n.) The centre is the middle of a
/// patch that reaches half a cell beyond the circle. The axes are unit and orthogonal; the weft runs along axis_u.
struct DiscPattern {
  double radius_m = 0;
  int cells = 16;  ///< across the diameter
  int degree = 2;
  Vec3 center{};
  Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};
Garment makeDisc(const DiscPattern& pattern);

/// A closed tube from `start` along `axis` (unit), cut lengthwise into equal patches, whose number divides
/// cells_around. u runs around, v along, normals outward. Its cross-section is the uniform periodic spline through the
/// circle at the knots: the radius between them differs by about radius (pi / cells_around)^4 / 8 for degree 2, and
/// every seam is G1 with ratio 1 to rounding. `seam` C0 with `seam_stiffness_N` keeps the geometry and joins positions
/// only. The weft runs along the axis, since one vector serves a whole patch.
struct TubePattern {
  double radius_m = 0, length_m = 0;
  int cells_around = 24, cells_along = 24;
  int degree = 2;
  int patches = 1;
  Vec3 start{};
  Vec3 axis{1, 0, 0};
  SeamKind seam = SeamKind::G1;
  double seam_stiffness_N = 0;
};
Garment makeTube(const TubePattern& pattern);

/// Shorts of six patches, drafted on the standing body (x forward, y left, z up) and mirrored about its median plane.
///
///   trunk      from the centre front around the hip to the centre back, from the crotch's level up to the waist
///   outer leg  from the front leg line around the hip to the back leg line, from the hem up to the trunk
///   inner leg  between the leg lines on the inner side, from the hem up to the gusset line under the crotch
///
/// At the crotch points Cf and Cb (the ends of the gusset line) six patches meet. Centre and leg seams are G1 with
/// ratio 1 save at Cf and Cb; hip and gusset lines are C0 with a rotational spring. v runs upward everywhere and u so
/// that normals point outward. All rows of control points are horizontal, so cross-sections are curves of constant v.
///
/// Trunk cross-sections are those of the convex hull of pelvis, torso and thighs between crotch and waist (cloth and
/// tape bridge the hollows); leg cross-sections those of a LegForm; both grown by 1 + ease. From the crotch up
/// to `fork_m` the centre lines leave the hull towards the gusset (a tape across the cross-section still reads the
/// same); from the crotch down to `blend_m` the leg goes over from the fork to the thigh's cross-section.
struct ShortsPattern {
  double inseam_m = 0.20;            ///< crotch to hem
  double rise_m = 0.25;              ///< crotch to waist edge
  double ease = 0.06;                ///< garment girth = (1 + ease) body girth
  std::optional<double> waist_ease;  ///< that of the waist edge, where it is another
  double cell_m = 0.022;             ///< wanted size of a cell
  int degree = 2;
  double crotch_ease_m = 0.010;  ///< crotch line under the lowest point of the pelvis
  double gusset_share = 0.6;  ///< length of the gusset line, Cf to Cb, over the depth of the garment above it
  double fork_m = 0.11;
  double blend_m = 0.08;
  double seam_stiffness_N = 0.01;  ///< rotational spring of the C0 seams [N m/(m rad)]
};
Garment makeShorts(const ShortsPattern& pattern, const Human& human);
Garment makeShorts(const ShortsPattern& pattern, const BodyForm& form);

/// Where the patches of the shorts stand in Garment::patches.
enum ShortsPatch { trunk_left, trunk_right, outer_left, outer_right, inner_left, inner_right };
/// Their names.
inline std::vector<std::string> shortsPatchNames() {
  return {"trunk_left", "trunk_right", "outer_left", "outer_right", "inner_left", "inner_right"};
}

/// The free edges by name. Sheet: u0, u1, v0, v1; tube: start, end; shorts: waist, hem_left, hem_right. Throws
/// InputError for other names.
std::vector<PatchEdge> sheetEdge(const std::string& name);
std::vector<PatchEdge> tubeEdge(const TubePattern& pattern, const std::string& name);
std::vector<PatchEdge> shortsEdge(const std::string& name);

}  // namespace gambeson
