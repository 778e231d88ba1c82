#pragma once
/// The sheet of a structure: exact geometry of simple shapes, refined, with trimming and fields, and the names by which
/// a case speaks of its edges and points.

#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cases/cloth/kind.hpp"
#include "cases/cloth/noise.hpp"
#include "cases/cloth/patch_fields.hpp"
#include "cases/cloth/sheet.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"

namespace gambeson {

// --- Shapes ------------------------------------------------------------------------------------------------------

/// corner + s width axis_u + t height axis_v; the axes are unit and orthogonal.
struct PlateShape {
  double width_m = 0, height_m = 0;
  Vec3 corner;
  Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};

/// u runs around `axis` (right-handed) from start_angle to end_angle, counted from the direction `zero`; v along the
/// axis. The normal points outwards.
struct CylinderShape {
  double radius_m = 0, length_m = 0;
  double start_angle_rad = 0, end_angle_rad = 2 * std::numbers::pi;
  Vec3 start;
  Vec3 axis{1, 0, 0}, zero{0, 0, 1};
};

/// u is the longitude about `axis`, counted from `zero`, v the latitude, as on a globe. The normal points outwards.
struct SphereShape {
  double radius_m = 0;
  double longitude_start_rad = 0, longitude_end_rad = 2 * std::numbers::pi;
  double latitude_start_rad = 0, latitude_end_rad = 0;
  Vec3 center;
  Vec3 axis{0, 0, 1}, zero{1, 0, 0};
};

/// A flat ring: u runs outward, v around `normal` (right-handed), counted from `zero`.
struct AnnulusShape {
  double inner_radius_m = 0, outer_radius_m = 0;
  double start_angle_rad = 0, end_angle_rad = 2 * std::numbers::pi;
  Vec3 center;
  Vec3 normal{0, 0, 1}, zero{1, 0, 0};
};

/// `weak`: the edges' knots, degrees or weights may differ; joined by a penalty, WeakSeam.
struct SeamCase {
  Seam seam;
  bool weak = false;
};

struct NurbsShape {
  std::vector<NurbsPatch> patches;
  std::vector<SeamCase> seams;
};

struct SheetFile {
  std::filesystem::path path;
};

// --- Places on it ------------------------------------------------------------------------------------------------

/// An edge of the whole sheet ("u0"), or of one patch of it ("2.u0").
struct EdgeAt {
  int patch = -1;  ///< -1: of the whole
  Side side = Side::u0;
};

/// A point at fractions of lengths and angles of the whole sheet, or of the parameter range of one patch.
struct PointAt {
  int patch = -1;
  Vec2 at;
};

// --- The rest ----------------------------------------------------------------------------------------------------

/// A closed loop in lengths from the corner along u and v (plate) or in fractions of the parameter range of a patch.
struct TrimCircle {
  Vec2 center;
  double radius = 0;
};
struct TrimPolygon {
  std::vector<Vec2> points;
};
/// A smooth closed curve through the points; plates only.
struct TrimSpline {
  std::vector<Vec2> points;
};
struct TrimCurves {
  std::vector<NurbsCurve> curves;
};
struct TrimCase {
  std::variant<TrimCircle, TrimPolygon, TrimSpline, TrimCurves> loop;
  bool keep_inside = false;  ///< else the inside is a hole
  int patch = 0;
};

struct SheetCase {
  std::variant<PlateShape, CylinderShape, SphereShape, AnnulusShape, NurbsShape, SheetFile> shape;
  int degree = 3;
  /// Of built shapes, always present there after reading.
  std::optional<int> cells_u, cells_v;
  /// Of patches of one's own, each cell into split x split; always present there after reading.
  std::optional<int> split;
  std::vector<double> refine_u, refine_v;  ///< further knots, fractions of each patch's range
  std::optional<Vec3> weft;                ///< absent: along u (plate), the axis (cylinder, sphere), `zero`
  double weft_angle_rad = 0;               ///< turns the weft about the normal
  std::vector<TrimCase> trim;
  int trim_points = 0;        ///< Gauss points per direction on pieces of cut cells; 0: degree + 1
  double trim_unused = 0.05;  ///< Trim::unused_fraction
  std::vector<FieldsCase> fields;
  std::optional<NoiseCase> imperfection;  ///< part of the rest shape
  ClothModel cloth;
};

/// Throws InputError whose key is relative to the sheet ("trim[0].circle").
Sheet buildSheet(const SheetCase& c);

/// The patch edges that an edge is made of, in the sense of its parameter. Throws InputError (reason only) where there
/// is no such edge.
std::vector<PatchEdge> edgesOf(const Sheet& sheet, const EdgeAt& edge);
/// Patch and parameters of a point. Throws InputError (reason only) where there is no such point.
std::pair<int, Vec2> locate(const Sheet& sheet, const PointAt& point);
/// The rest length of an edge [m].
double edgeLength(const Sheet& sheet, const EdgeAt& edge);

}  // namespace gambeson
