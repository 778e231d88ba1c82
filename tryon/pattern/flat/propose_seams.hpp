#pragma once
/// Seams for patterns whose format has none (DXF): guesses from lengths and notches, to be corrected by a person.

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

struct ProposedSeams {
  std::vector<PanelSeam> seams;
  int edges_left = 0;  ///< edges that fit none
};

/// Pairs of whole edges whose lengths differ by less than 3.5 % (ease) or 2 mm, those that fit best first; each edge is
/// in one pair at most, b run backwards (right sides together, both outlines counter-clockwise). Better than others fit
/// edges with as many notches within 5 mm of each other, then those without any, then the two edges beside a hem of one
/// panel; worst are edges of panels that are mirror images, which are sewn only where they are nearly straight (centre
/// lines). Within these, by how much lengths differ and how far the corners of both panels are from 180 degrees
/// together: sewn edges lead on smoothly; what is worse by its sort is not better by that. Pairs beside one that is
/// taken go before others, so that seams go on from panel to panel.
///
/// A grain line tells how a panel hangs. What looks down on both panels (hems, cuffs) is not sewn to each other, nor
/// are two hollows that look up (necks); centre lines of mirror images and the edges beside a hem look aside; and an
/// edge that looks to the right goes rather with one that looks to the left. What is up in panels without a grain line,
/// or on the bias, is not known, and nothing is left out there. Edges shorter than 2 cm are left alone, and patterns
/// with more than 1000 edges.
ProposedSeams proposeSeams(const FlatPattern& pattern);

}  // namespace gambeson
