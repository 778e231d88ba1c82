#pragma once
/// Panels that are cut into pieces for what a smooth patch cannot be: slit, and a cone.
///
/// Where both sides of a seam meet in one panel (the tip of a dart), spline functions reach across the slit between
/// them, and would hold both sides together. So the panel is cut on through the tip, along weft or warp, until another
/// border: the pieces are trimmed from one grid, whose control points they share wherever a function does not reach one
/// of the sides. There the cloth goes on as it is (same functions, no seam); within some cells of the tip the cut is
/// sewn.

#include <string>
#include <vector>

#include "core/nurbs/curve.hpp"

namespace gambeson {

/// A place on a panel's border: the edge (numbered through) and its curve's parameter.
struct BorderPlace {
  int edge = 0;
  double t = 0;
};
/// A part of an edge, from one of its parameters to another.
struct BorderPart {
  int edge = 0;
  double from = 0, to = 1;
};
/// Where both sides of a seam meet.
struct SeamTip {
  BorderPlace at;
  std::string seam;  ///< for messages
};

/// A panel's border in (u, v): curves by loops, each ends where the next one starts; counter-clockwise, cutouts
/// clockwise. Edges are numbered through.
using PanelBorder = std::vector<std::vector<NurbsCurve>>;

/// A part of an edge, and the piece whose border it is.
struct PiecePart {
  int piece = 0;
  BorderPart part;
};
/// A straight cut between two pieces: `left` and `right` of the way from its start to its end.
struct PieceCut {
  Vec2 from, to;
  int left = 0, right = 0;
  int tip = 0;  ///< that it belongs to; it starts there, or goes on from there behind a cutout
  bool straight_u = false, straight_v = false;  ///< u, or v, is the same all along
};
struct PanelPieces {
  std::vector<PanelBorder> borders;  ///< of the pieces
  std::vector<PiecePart> parts;      ///< of the edges, in their order
  std::vector<PieceCut> cuts;
};

/// Throws InputError (key of no meaning, panel's words in the reason) where no cut parts both sides of a tip.
PanelPieces cutPanel(const PanelBorder& border, const std::vector<SeamTip>& tips, double cell_m);

}  // namespace gambeson
