#pragma once
/// Better triangles on an implicit surface: splits, collapses, flips and relaxation (Botsch and Kobbelt 2004).

#include "human/skin/mesh.hpp"

namespace gambeson {

/// `half` is a mesh of the part y >= 0 whose border lies on y = 0, where it stays. Edges come to between 4/5 and 4/3 of
/// the wanted length, points onto the surface.
TriangleMesh remeshHalf(const TriangleMesh& half, const ImplicitSurface& surface);

}  // namespace gambeson
