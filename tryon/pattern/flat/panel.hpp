#pragma once
/// Flat patterns: cloth as it is cut and what is sewn to what. Lengths in m, angles in rad.
///
/// A panel's plane is seen from the right side of the cloth, the one that shows when it is worn: x to the right, y up.
/// Its outline runs counter-clockwise there, its cutouts clockwise, so the cloth lies to the left of every edge. Edges
/// are numbered through, the outline's first, then those of the cutouts in their order: (panel, edge) names one.
///
///   lengths and areas, curves as NURBS, points by fractions of length   flat/panel_geometry.hpp
///   what is wrong with a pattern                                         flat/panel_check.hpp
///   seams for patterns that say none                                     flat/propose_seams.hpp
///   regions of the body, and what names say of them                      flat/regions.hpp
///   panels around a wearer by their regions, and whether they reach      flat/place_panels.hpp, flat/panel_fit.hpp

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// How an edge runs from its start to the start of the next. Ends are no part of any of these.
struct StraightEdge {};
/// A Bezier curve, with one inner point (quadratic) or two (cubic).
struct BezierEdge {
  std::vector<Vec2> controls_m;
};
/// A circular arc whose tangent turns by this much, to the left where it is positive; 0 < |turn| < 2 pi. The radius is
/// |chord| / (2 sin(|turn| / 2)).
struct ArcEdge {
  double turn_rad = 0;
};
/// A NURBS curve with clamped knots; `controls_m` without both ends, `weights` (empty: all 1) with them.
struct SplineEdge {
  int degree = 3;
  std::vector<double> knots;
  std::vector<Vec2> controls_m;
  std::vector<double> weights;
};
/// Straight lines through these points.
struct PolylineEdge {
  std::vector<Vec2> points_m;
};
using EdgeCurve = std::variant<StraightEdge, BezierEdge, ArcEdge, SplineEdge, PolylineEdge>;

struct PanelEdge {
  std::string name;  ///< "hem", or empty
  Vec2 start_m;
  EdgeCurve curve;
};
/// A closed chain of edges: each ends where the next one starts, the last one where the first does. A closed outline is
/// all that this can say.
using PanelLoop = std::vector<PanelEdge>;

/// Along the warp. A panel without one has its warp along y.
struct GrainLine {
  Vec2 from_m, to_m;
};

enum class NotchKind { slit, v, t, castle, check, u };
/// A mark at an edge for whoever sews: two that meet in a seam are laid on each other.
struct Notch {
  int edge = 0;
  double at = 0;  ///< fraction of the edge's length
  NotchKind kind = NotchKind::slit;
  double depth_m = 0;  ///< 0: not said
};

enum class LineKind { internal, sew, fold, stripe, plaid, grade, drill };
/// Drawn on the cloth, not cut: pockets, folds, where stripes match; a drill hole is one point.
struct InternalLine {
  LineKind kind = LineKind::internal;
  std::vector<Vec2> points_m;
  bool closed = false;
};

struct Annotation {
  std::string text;
  Vec2 at_m;
};

/// Where a panel stands around its wearer before it is sewn: (x, y) at origin + x along_x + y along_y, two unit vectors
/// at a right angle. along_x x along_y points away from the wearer. World axes of the manikins: x forward, y left, z
/// up.
struct PanelPlace {
  Vec3 origin_m, along_x{0, 1, 0}, along_y{0, 0, 1};
};

struct Panel {
  std::string name;  ///< no other panel has it
  PanelLoop outline;
  std::vector<PanelLoop> cutouts;
  PanelLoop cut_line;  ///< outside of the outline by the seam allowance; empty: not said
  std::optional<GrainLine> grain;
  std::vector<Notch> notches;
  std::vector<InternalLine> lines;
  std::vector<Annotation> annotations;
  std::optional<PanelPlace> placement;
  std::string region;    ///< of the body (flat/regions.hpp), or "arm", ..: as its source calls it; or empty
  std::string material;  ///< likewise
  std::string size;      ///< likewise: "M"
  int quantity = 1;      ///< how often it is cut
};

/// A part of an edge, from one fraction of its length to another; from > to runs against the edge.
struct SeamPart {
  int panel = 0, edge = 0;
  double from = 0, to = 1;
};

/// sewn: two sides become one. dart: both sides are of one panel and meet at the dart's tip. opening: sewn, unless it
/// is worn open (zip, buttons, lacing).
enum class SeamUse { sewn, dart, opening };
/// Points at equal fractions of the length of both sides come together. A side is one part of an edge or several, one
/// after the other. Sides of unequal length are eased or gathered.
struct PanelSeam {
  std::string name;
  std::vector<SeamPart> a, b;
  SeamUse use = SeamUse::sewn;
  double stiffness_N = 0;     ///< rotational spring along it [N m/(m rad)]: pressed open, topstitched; 0: free
  bool proposed = false;      ///< guessed from lengths and notches, not said by anybody
  bool open = false;          ///< of an opening: nothing holds it but its buttons
  int buttons = 0;            ///< of an open seam: evenly spaced, the first and the last half of that from its ends
  double rest_angle_rad = 0;  ///< of the spring
};

/// Where a pattern comes from.
struct PatternSource {
  std::string file, format, unit;
};

/// Where panels start around a wearer. given: at their placements, or by their regions where some have none; regions:
/// by their regions, whatever their placements (flat/place_panels.hpp).
enum class PanelPlacing { given, regions };

struct FlatPattern {
  std::string name;
  PatternSource source;
  std::vector<Panel> panels;
  std::vector<PanelSeam> seams;
  PanelPlacing placing = PanelPlacing::given;
};

}  // namespace gambeson
