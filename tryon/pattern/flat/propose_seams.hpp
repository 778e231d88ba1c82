#pragma once
/// Seams for patterns whose format has none (DXF): guesses from lengths and notches, to be corrected by a person.

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

struct ProposedSeams {
  std::vector<PanelSeam> seams;
  int edges_left = 0;  ///< edges that fit none
};

/// Pairs of whole edges of different panels whose lengths differ by less than 1 % or 2 mm, those that fit best first;
/// each edge is in one pair at most. How well two edges fit: the difference of lengths relative to `tolerance`, and
/// where their notches lie along them, b run backwards (right sides together, both outlines counter-clockwise). A pair
/// whose notches are as many and lie within 5 mm of each other goes before any without. Edges shorter than 2 cm are
/// left alone.
ProposedSeams proposeSeams(const FlatPattern& pattern);

}  // namespace gambeson
