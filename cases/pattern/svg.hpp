#pragma once
/// A flat pattern drawn at 1:1, for paper and for whoever edits its seams.

#include <string>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// SVG in millimetres: panels seen from the right side of the cloth, side by side, with names, numbers of edges (as
/// seams of the file name them), grain lines, notches, internal lines; both sides of a seam in one colour with its
/// name, a dot where both start, dashes where it is only proposed; a scale bar, a square of 5 cm, and the list of seams
/// with the lengths of their sides. What was built is not checked again (checkPattern).
std::string patternSvg(const FlatPattern& pattern);

}  // namespace gambeson
