#pragma once
/// Intersection contours: crossings joined into curves, each of which lies on two surfaces (Zheng 2013, chapter 4).

#include <array>
#include <span>
#include <vector>

#include "core/contact/crossing.hpp"

namespace gambeson {

/// Where a contour passes through an edge of one of its two surfaces, or ends at a vertex that crossing triangles
/// share.
struct ContourPoint {
  Vec3 x;
  int edge = -1;      ///< -1 at a shared vertex
  int owner = 0;      ///< the surface, 0 (element I) or 1 (element II), that has the edge
  int triangle = -1;  ///< of the other surface
  int vertex = -1;    ///< the shared vertex ("loop vertex"), or -1
  /// x = sum of edge_weight[k] x[edges[edge][k]], near to the sum of triangle_weight[k] x[triangles[triangle][k]]. All
  /// weights lie in [0, 1] and sum to 1. At a shared vertex they are 0.
  std::array<double, 2> edge_weight{};
  std::array<double, 3> triangle_weight{};
};

/// The straight piece from point i to point i + 1, on which one triangle of each surface meet.
struct ContourSegment {
  std::array<int, 2> face;  ///< on surface 0 and on surface 1
  /// Travel is along direction * (n0 x n1), where n are the normals by the order of corners; known exactly.
  int direction = 1;
  /// +1 where the normal of the face is that of the first segment's face carried along the surface, -1 where it is
  /// opposite.
  std::array<int, 2> normal{1, 1};
};

struct Contour {
  bool cyclic = false;  ///< the last segment leads from the last point back to the first
  std::vector<ContourPoint> points;
  std::vector<ContourSegment> segments;
  /// Per surface: the contour is cyclic, or both its ends are on borders of this surface. Where only one is closed, the
  /// border of the other surface ends inside this one's triangles (Zheng 2013, fig. 4.8). False too where the normal,
  /// or the two surfaces, come back exchanged after a cycle (one-sided surfaces), at ends on edges of more than two
  /// triangles, and at shared vertices.
  std::array<bool, 2> closed{};

  int next(int point) const { return point + 1 < static_cast<int>(points.size()) ? point + 1 : 0; }
};

/// Contours through all crossings of the mesh, with the positions that the crossings were found with. The order, and
/// the names 0 and 1 of the surfaces, depend on the crossings alone. Where an edge lies exactly in the plane of its
/// triangle the point stands in the middle of their overlap.
std::vector<Contour> traceContours(const ContactMesh& mesh, std::span<const Vec3> x,
                                   std::span<const Crossing> crossings);

/// The part of a contour inside one triangle of one surface (Zheng 2013, fig. 4.3).
struct Subchain {
  enum Type {
    kTwoEdges,  ///< type I: enters and leaves by different edges
    kOneEdge,   ///< type II: by the same edge
    kNoEdge,    ///< type III: a whole cyclic contour inside one triangle
    kEnds       ///< an open contour ends inside the triangle or at its corner
  };
  int face = 0;
  int first_segment = 0, segments = 0;  ///< a cyclic contour's numbers go on at 0 after the last
  Type type = kTwoEdges;
};

/// The subchains of a contour on one of its surfaces (`surface` is 0 or 1), in the order of the contour.
std::vector<Subchain> subchains(const Contour& contour, int surface);

}  // namespace gambeson
