#pragma once
/// Which edges of a mesh pass through which of its triangles: exact, with ties broken consistently.

#include <span>
#include <vector>

#include "core/contact/bounding_tree.hpp"
#include "core/contact/contact_mesh.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// `side` is +1 where the edge runs (from edges[edge][0] to [1]) from the back of the triangle to its front, the side
/// that its normal (x1 - x0) x (x2 - x0) points to, and -1 where it runs from front to back.
struct Crossing {
  int edge = 0, triangle = 0, side = 1;
  bool operator==(const Crossing&) const = default;
};

/// Boxes of the triangles, for a tree over them.
std::vector<Box> triangleBoxes(const ContactMesh& mesh, std::span<const Vec3> x);

/// All crossings of edges with triangles that do not hang together with them, sorted by edge, then triangle: where a
/// vertex is shared they cannot cross, and the two sides of a sewn seam are one line but for what the chords of both
/// differ by. The points are those of `orientation`: moved by infinitely small amounts, so that every
/// contact is a clean crossing or none. Hence two triangles without a common vertex have no crossing or two; with one
/// common vertex, none or one (their intersection starts at that vertex); with two, none. `triangle_tree` is over
/// triangleBoxes(mesh, x). `obstacle` (one flag per vertex, the same for all vertices of a connected piece; or empty)
/// leaves out the crossings of obstacles with obstacles. Coordinates below 1e-60 m in size count as zero. Throws
/// RunError for coordinates that are not finite or not below 1e60 m. The same bits for any number of threads.
std::vector<Crossing> findCrossings(const ContactMesh& mesh, std::span<const Vec3> x, const BoundingTree& triangle_tree,
                                    std::span<const char> obstacle = {});
std::vector<Crossing> findCrossings(const ContactMesh& mesh, std::span<const Vec3> x,
                                    std::span<const char> obstacle = {});

}  // namespace gambeson
