#pragma once
/// How cloth of triangles bends.

namespace gambeson {

/// midedge: by the tensor of curvature of each triangle, from the angles that its edges' normals make with its own;
/// each edge's normal turns by an unknown of its own. triangle: the same with normals halfway between those of both
/// triangles. hinge: each edge by itself. springs: between the corners that neighbours do not share. quadratic: each edge
/// by itself, as flat cloth does for small folds.
enum class BendingElements { midedge, triangle, hinge, springs, quadratic };

/// Whether each triangle has a tensor of curvature, whose law and memory are the triangle's.
constexpr bool bendTriangles(BendingElements e) {
  return e == BendingElements::midedge || e == BendingElements::triangle;
}

}  // namespace gambeson
