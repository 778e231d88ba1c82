#pragma once
/// What is wrong with a flat pattern.

#include <string>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// Throws InputError (key "panels[2].outline[4]", no file) where a panel or a seam is no good: names twice, numbers
/// that are not finite or beyond 10 m, edges without length, arcs out of range, splines that validate() refuses,
/// outlines that enclose less than 1 mm^2 or run clockwise, cutouts that do not lie inside, loops that cross themselves
/// or each other (exact predicates on the loops flattened to 10 um), seams of edges that are not there, parts without
/// length or outside of 0 to 1, an edge's part in two seams, notches and grain lines off the panel.
void checkPattern(const FlatPattern& pattern);

/// The part of it without which areas mean nothing: numbers and edges of the panel's loops, which must not cross. `key`
/// is the panel's.
void checkEdges(const Panel& panel, const std::string& key);

/// What is allowed but seldom meant, in words: panels whose outline touches itself, seams whose sides differ by more
/// than a fifth, panels that no seam holds.
std::vector<std::string> doubtsAbout(const FlatPattern& pattern);

}  // namespace gambeson
