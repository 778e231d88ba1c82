#pragma once
/// The rows and springs of a garment's sewn seams.
///
/// Both edges are measured at rest, and hats phi_k are laid over the fraction s of length: multipliers lambda(s) = sum
/// phi_k lambda_k of a mortar method (Bernardi, Maday and Patera 1994; of NURBS: Brivadis, Buffa, Wohlmuth and
/// Wunderlich, Comput. Methods Appl. Mech. Engrg. 284 (2015) 292-319). With one hat for each cell of the finer side the
/// multipliers are as fine as the cloth; what gapes between them is of the third order of the cell where cloth is
/// smooth, but some percent of a cell where it crumples. Three keep it below 1 % there too, and what they cost in
/// motions that cells which do not match cannot share does not show (core/cloth/DECISIONS.md has the numbers).

#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/sewn_rows.hpp"

namespace gambeson {

/// The part [from, to] of one of a patch's own sides, as fractions of its parameter in the edge's sense.
SewnPart sidePart(const Garment& garment, const PatchEdge& edge, double from = 0, double to = 1);
/// A curve of a trimming loop.
SewnPart loopPart(const Garment& garment, int patch, int loop, int curve, bool backwards = false);

/// Length at rest [m].
double lengthOf(const Garment& garment, const SewnEdge& edge);

/// Throws InputError (key "sewn_seams[i]") where a number of a seam's spring is out of range.
void checkSpring(const Garment& garment, std::size_t seam);

/// Where both sides of a seam are less than about three quarters of a cell apart in one panel (the tip of a dart) there
/// is no row: both move with the same control points there. Of the seams that are held so (of control points). Throws
/// InputError (key "sewn_seams[i]") where a patch does not exist, an edge leaves the patch, has no length or does not
/// run along the border of what is kept, where one edge is more than twice as long as the other, or where a number is
/// out of range.
SewnRows buildSewnRows(const Garment& garment, SeamHold hold);

/// The rotational springs of all sewn seams that are not open.
std::vector<HingePoint> buildSewnHinges(const Garment& garment);

}  // namespace gambeson
