#pragma once
/// The two parts into which closed contours cut a surface, and which of them is on the wrong side (Zheng 2013,
/// section 4.2).

#include <span>
#include <vector>

#include "core/contact/contour.hpp"

namespace gambeson {

/// A contour as seen on one of its surfaces, on which it is closed.
struct ContourPath {
  const Contour* contour = nullptr;
  int surface = 0;
};

/// Omega+ lies to the left of the contour's travel, seen against the normal of its segments; Omega- to the right.
struct ContourRegion {
  bool found = false;         ///< false where nothing keeps the two sides of the contour apart
  int sign = 1;               ///< which one: +1 Omega+, -1 Omega-
  double area_m2 = 0;         ///< of that region: whole triangles and the polygons of those that are cut
  std::vector<int> vertices;  ///< of that region, ascending; none where it lies inside the cut triangles
};

/// Scratch of floodRegion: a label for each vertex, all 0 between calls.
struct FloodWork {
  std::vector<signed char> label;
};

/// The region of the given sign beside the first contour or, where sign = 0, the smaller one. The other contours on the
/// same surface bound it too: two cuts along a tube, none of which divides it alone. Flood fill over the vertices from
/// both sides of the first contour at once, until one side has no more to grow and is the wanted one: the cost is that
/// of the smaller region. The sides of a vertex on crossed edges follow from the sum of the signs of an edge's
/// crossings, which is what the nearest one says (a contour crosses an edge in alternating directions) but needs no
/// comparison of distances; a contour that crosses every edge an even number of times encloses no vertex, and the sign
/// of its area tells the sides. A contour that crosses itself on the surface has no regions. Where contours of the list
/// cross each other in one triangle that triangle's share is approximate.
ContourRegion floodRegion(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const ContourPath> contours,
                          int sign, FloodWork& work);

}  // namespace gambeson
