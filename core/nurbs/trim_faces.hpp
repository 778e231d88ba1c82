#pragma once
/// A trimmed patch as faces that have one outline each.

#include <vector>

#include "core/nurbs/trim.hpp"

namespace gambeson {

/// The same area as faces for programs that know an outline and its holes: the first loop of each is the outline,
/// counter-clockwise, and the others lie in it; of the patch's own rectangle, where that is the outline, there are holes
/// alone. Notches are part of an outline (withoutNotches). A trim without loops is one without loops. Throws InputError
/// as trimBoundary does.
std::vector<Trim> facesOf(const NurbsPatch& patch, const Trim& trim);

}  // namespace gambeson
