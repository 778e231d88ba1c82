#pragma once
/// Loops for programs that know holes and outlines only.

#include "core/nurbs/trim.hpp"

namespace gambeson {

/// The same area, in which no hole runs along the border of the patch: a notch (a hole with straight lines on the
/// border) is part of an outline instead, which goes around it and on along the border. Cut through by notches, a patch
/// has an outline for each part that is left. Where other loops are the outline nothing is changed.
/// Throws InputError as trimBoundary does.
Trim withoutNotches(const NurbsPatch& patch, const Trim& trim);

}  // namespace gambeson
