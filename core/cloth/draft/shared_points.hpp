#pragma once
/// Control points that two patches share: a panel that is cut goes on through the cut.
///
/// A sewn seam whose two sides are one curve, at one place of two patches, is a cut in a sheet (of a panel with a dart:
/// tryon/pattern/flat/panel_pieces.hpp). Where the knots of both patches agree they have the same functions. Of those
/// that reach across the cut both patches share the control points, and the sheet goes on there as if it were not cut;
/// but where both sides of another seam meet at the cut's end, the sheet is slit: what reaches these sides stays apart,
/// or it would hold them together, and there the cut is sewn as seams are. So does what would join them by way of a
/// third patch, where a cut ends on another near a tip.

#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Whether a seam is a cut in a sheet: sewn, its two sides one curve of two patches.
bool isCut(const SewnSeam& seam);

/// Of each control point of a garment (in the list of all) the lowest one that it is one with, or itself.
std::vector<int> sharedOwners(const Garment& garment);

}  // namespace gambeson
