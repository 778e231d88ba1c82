#pragma once
/// Which edges and corners of bodies are sharp: cloth may rest on them between its samples.

#include <span>

#include "core/contact/sharp_view.hpp"

namespace gambeson {

/// Unit vector from vertex v along an edge that ends there.
Vec3 alongFrom(const ContactMesh& mesh, std::span<const Vec3> x, int v, int edge);
/// Unit vector in the plane of triangle t, from its edge into it.
Vec3 acrossFrom(const ContactMesh& mesh, std::span<const Vec3> x, int edge, int t);

/// Two faces bend by 30 degrees or more, or there is one face.
bool isSharpEdge(const ContactMesh& mesh, std::span<const Vec3> x, int edge);
/// All edges at the vertex lie within 75 degrees of their mean direction.
bool isSharpCorner(const ContactMesh& mesh, std::span<const Vec3> x, int vertex);

}  // namespace gambeson
