#pragma once
/// What frees surfaces that pass through each other: for each contour a direction and a speed of restoring (Zheng 2013,
/// chapter 4). All derivatives are by d, a translation of surface 1 (element II) with surface 0 (element I) at rest.

#include <array>
#include <span>
#include <vector>

#include "core/contact/contour.hpp"

namespace gambeson {

/// dC/dd of the contour's length (Zheng 2013, eq. 4.5, 4.5', 4.6) [1]. A shared vertex moves by half of d.
Vec3 lengthGradient(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& contour);

/// dA+/dd on one surface [m], A+ the area to the left of the contour (contour_region.hpp). The sum of eq. 4.17
/// (surface 0) or 4.18 (surface 1) over all segments. A segment stays on the line in which the two planes meet,
/// whatever edges its ends are on, so its term needs neither these nor a reference point: it sweeps the area
///   l n'.d / (n'.m) on surface 0,   m = r x n the unit vector to the right of the contour's direction r,
/// where n is the unit normal of surface 0's triangle and n' of surface 1's; n'.m = direction |n x n'|
/// (times -1 where the carried normal is opposite to n).
/// Segments whose planes coincide are left out: their gradient is unbounded.
Vec3 areaGradient(const ContactMesh& mesh, std::span<const Vec3> x, const Contour& contour, int surface);

enum class UntangleBy {
  kArea,   ///< eq. 4.19 to 4.20
  kLength  ///< eq. 4.19' for all contours, closed or not (for comparison: stops at local minima of the length)
};

struct UntangleLaw {
  double speed_mps = 0.5;  ///< h0 of eq. 4.21, > 0
  double g0 = 1;           ///< g0 of eq. 4.21 [1], > 0
  UntangleBy by = UntangleBy::kArea;
};

/// Throws InputError where a parameter is out of range.
void checkUntangleLaw(const UntangleLaw& law);

struct Untangling {
  Contour contour;
  double length_m = 0;
  /// Where the contour is closed on surface s and tells a wrong part: its sign (+1: left of the contour), its area and
  /// its vertices. Otherwise false, 0, 0 and none; but between garments a contour from the rim of one to the rim of the
  /// other has its sign all the same ("mixed": nested tubes with flush rims). Between garments area and vertices
  /// are missing too where nothing keeps the two sides apart (a cut through a ring, a way around the end of an open
  /// contour). Contours that bound one region together report it each.
  std::array<bool, 2> closed{};
  std::array<int, 2> wrong_sign{};
  std::array<double, 2> wrong_area_m2{};
  std::array<std::vector<int>, 2> wrong_vertices;
  /// Per surface: -(gradient of the wrong area) / C where the sign is known, eq. 4.19; else -2 dC/dd, eq. 4.19' [1]. G
  /// is the longer one, eq. 4.20. Zero where the contour has no length.
  std::array<Vec3, 2> G_side;
  Vec3 G;
  /// What to ask for at each point of the contour: (velocity of surface 1 - velocity of surface 0) . direction >=
  /// speed_mps, direction = G/|G|, speed by eq. 4.21 with the root of |G|^2: h0 |G| / sqrt(|G|^2 + g0^2) (zero where G
  /// is). A point's edge is on surface `owner`, its triangle on the other one.
  Vec3 direction;
  double speed_mps = 0;
};

/// The wrong part is, between two garments (`garment`, one number per vertex, equal on each connected piece, or empty),
/// the part of the lower garment in front of the higher and the part of the higher behind the lower, where the normals
/// of all triangles point outward, from the low to the high numbers; within one garment it is the smaller part.
/// Negative numbers are bodies: the wrong part of the cloth is what is behind their surface, that of the body the
/// smaller one. (With G = -dA/dd the thesis's rule for one garment reverses the sign of A+ where |A+| > |A-|.) A
/// contour that does not divide its surface alone (a cut along a tube) is taken with the others between the same two
/// pieces; where these do not either, as open.
std::vector<Untangling> untangleContours(const ContactMesh& mesh, std::span<const Vec3> x,
                                         std::vector<Contour> contours, std::span<const int> garment,
                                         const UntangleLaw& law);

/// Crossings, contours and what frees them.
std::vector<Untangling> untangle(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const int> garment = {},
                                 std::span<const char> obstacle = {}, const UntangleLaw& law = {});

/// One condition on velocities: sum over k of weight[k] v[vertex[k]] . direction >= speed_mps. The weights sum to 0:
/// the edge's two are positive on surface 1, those of the triangle on surface 0 negative, or the other way round.
struct RestoringRow {
  std::array<int, 5> vertex{};
  std::array<double, 5> weight{};
  Vec3 direction;
  double speed_mps = 0;
};

/// For each point of the contour but shared vertices, in its order; none where G is zero.
std::vector<RestoringRow> restoringRows(const ContactMesh& mesh, const Untangling& untangling);

/// How far a vertex is involved in intersections.
enum class Tangle : char {
  kFree,
  kBeside,  ///< a vertex of a crossed edge or of a crossing triangle
  kWrong    ///< on the wrong side of a contour
};
std::vector<Tangle> tangledVertices(const ContactMesh& mesh, std::span<const Untangling> untanglings);

}  // namespace gambeson
