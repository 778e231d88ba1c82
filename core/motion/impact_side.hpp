#pragma once
/// From which side of a body's surface cloth meets it within a step: whether an impact is one with the outside.
/// Detail of core/motion/collisions.hpp, a pair at a time, for host and device.

#include "core/contact/contact_mesh_view.hpp"
#include "core/motion/impact_row.hpp"

namespace gambeson {

/// Where the vertices of a step go, samples of the cloth first, then vertices of bodies.
struct ImpactSurfaces {
  ContactMeshView mesh;
  int samples = 0;
  const Vec3 *x0 = nullptr, *x1 = nullptr;
};

/// Whether cloth comes to what it meets of a body from inside of that body.
///
/// A search along straight paths finds all that would meet, also what comes after something else has stopped the cloth:
/// an edge of cloth that slides over a corner passes through one edge or face of the body, and from inside out through
/// the next. What it meets from inside is no contact: the surface there faces away from the cloth, and its row would
/// pull the cloth into the body against the rows of what it met first.
///
/// Law: let n be the normal of the impact, from the body to where the cloth was at the start, and n_f the outward
/// normals, at the time of the impact, of all faces that meet at what is touched (one at a face, two at an edge, those
/// around a corner). The impact is from inside where n . n_f < 0 for all of them. Nothing is from inside at the border
/// of an open surface.
///
/// It leaves out nothing that could be a contact. Just before the impact the cloth's nearest point is at x + e n, x
/// being the point touched, e -> 0. Where a face f bounds the body at x and n . n_f < 0 for all faces there, these seen
/// along n are a graph over the plane through x, with the body on the side of n: x + e n is inside, whether the edge or
/// the corner is convex or not. Cloth whose samples and edges were outside at the start has passed the surface before,
/// and the first time that a sample, an edge or a triangle of it came to the surface from outside is an impact of it,
/// of its own edges or of its own corners that has n . n_f >= 0 for a face and stands in the list. So the list of the
/// others is empty only where nothing passes through anything. At edges and corners that are not convex cloth may also
/// come from inside where only some n . n_f < 0; rows of those push out of a face, and stay.
GAMBESON_HD inline bool comesFromInside(const ImpactPair& pair, const ImpactSurfaces& at) {
  const bool a_is_body = pair.vertex[0] >= at.samples, b_is_body = pair.vertex[pair.edges ? 2 : 1] >= at.samples;
  if (a_is_body == b_is_body) return false;
  const Vec3 from_b = placeOf(pair).normal, n = a_is_body ? -from_b : from_b;
  const auto position = [&](int v) { return at.x0[v] + pair.time * (at.x1[v] - at.x0[v]); };
  const auto facesAway = [&](int face) {
    const std::array<int, 3>& t = at.mesh.triangles[face];
    const Vec3 a = position(t[0]);
    return dot(n, cross(position(t[1]) - a, position(t[2]) - a)) < 0;
  };
  const auto allFaceAway = [&](int edge) {
    const std::span<const int> faces = at.mesh.edge_faces[edge];
    for (int face : faces)
      if (!facesAway(face)) return false;
    return faces.size() > 1;
  };
  if (pair.edges) return allFaceAway(a_is_body ? pair.a : pair.b);
  if (b_is_body) return facesAway(pair.b);
  const std::span<const int> edges = at.mesh.vertex_edges[pair.a];
  for (int edge : edges)
    if (!allFaceAway(edge)) return false;
  return !edges.empty();
}

}  // namespace gambeson
