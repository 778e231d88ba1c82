#pragma once
/// Seams between flat panels: their edges share no curve at rest, and need not have one length.
///
/// Cloth is cut flat and sewn. A panel is a patch that is flat at rest, trimmed to the shape of its piece; a seam takes
/// a stretch of the border of each of two panels, or two of one (a dart), and holds together the points at equal
/// fractions of their lengths at rest. Of unequal lengths the longer one is gathered evenly.

#include <string>
#include <vector>

#include "core/cloth/patch_edge.hpp"
#include "core/nurbs/curve.hpp"

namespace gambeson {

/// A part of a panel's border: a curve in the parameters (u, v) of its patch, from one of its parameters t to another;
/// from > to runs it backwards.
struct SewnPart {
  int patch = 0;
  NurbsCurve curve;
  double from = 0, to = 1;
};
/// One side of a seam: parts in their order along it, of one panel or of several.
using SewnEdge = std::vector<SewnPart>;

/// projected: explicit steps hold the rows exactly (core/motion/sewing.hpp) and pay nothing with their length; weak: a
/// penalty on each row, for statics and implicit steps; open: nothing holds (a zip that is open).
enum class SeamHold { projected, weak, open };

/// Fractions of length run from the start of `a` and of `b`. The panels are joined in position; the angle between them
/// is free, but for a rotational spring: energy 1/2 stiffness (theta - rest angle)^2 per length, theta as hingeAngle
/// has it, 0 where the panels lie side by side in one plane (a seam that is pressed open), +-pi where they lie on each
/// other.
struct SewnSeam {
  SewnEdge a, b;
  SeamHold hold = SeamHold::projected;
  double stiffness_N = 0;     ///< of the spring: moment per length and angle [N m/(m rad)]
  double rest_angle_rad = 0;  ///< of the spring, within +-pi
  double factor = 1e3;        ///< weak: penalty over the stiffness of a cell, as of WeakSeam
  double rows_per_cell = 3;   ///< hats along the seam for each cell of the finer side (core/cloth/draft/sewing.hpp)
  std::string name{};         ///< for messages; may be empty
};

}  // namespace gambeson
