#pragma once
/// How supports and loads take hold of a cloth of triangles.

#include <memory>

#include "core/cloth/mounting.hpp"

namespace gambeson {

class TriangleCloth;

/// An edge is held by its vertices. A clamp holds the normals of an edge that has unknowns of its own (midedge), which
/// turn back what their triangles turn, to first order in that angle; a moment acts on these normals. Else a clamp
/// keeps the triangles at the edge from turning about it: the cloth is built in a third of a triangle's height inside,
/// an error of the first order. Lives no longer than the cloth.
std::unique_ptr<const Mounting> triangleMounting(const TriangleCloth& cloth);

}  // namespace gambeson
