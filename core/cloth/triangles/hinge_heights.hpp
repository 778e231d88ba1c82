#pragma once
/// The two triangles at a hinge, flat as they are at rest, and the fabric's rigidity across their edge.

#include <span>

#include "core/cloth/triangles/rest_elements.hpp"

namespace gambeson {

/// The height of a triangle over an edge, the foot of its third corner on that edge, from its start on, and the length
/// of the edge [m].
struct TriangleHeight {
  double height_m = 0, foot_m = 0, length_m = 0;
};

/// Of both triangles of a hinge over their common edge, which starts at the hinge's corner 0. A seam's edge has a
/// length in each.
struct HingeHeights {
  TriangleHeight first, second;

  HingeHeights(const FoldHinge& hinge, const MembraneTriangle& one, const MembraneTriangle& two);
};

/// d . D d of a hinge [N m], from rigidities of bending D (Voigt 11 22 33 12 13 23): moment across the edge over the
/// curvature across it.
double rigidityAcross(const FoldHinge& hinge, std::span<const double, 6> rigidity_Nm);

}  // namespace gambeson
