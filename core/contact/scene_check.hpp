#pragma once
/// Is the cloth anywhere in the body, or the body through the cloth? Independent of the contact solver.

#include <optional>
#include <span>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "core/contact/proximity.hpp"

namespace gambeson {

struct Penetration {
  double depth_m = 0;  ///< > 0
  int point = -1, obstacle = -1;
};

/// The deepest of many surface points (denser than the contact samples, so that what lies between them is seen).
/// None: no point is inside any obstacle.
std::optional<Penetration> deepestPenetration(const ProximityQuery& query, std::span<const Placement> placement,
                                              std::span<const Vec3> points, const DeformedSurfaces* deformed = nullptr);

/// An edge of an obstacle's surface that passes through a triangle of the cloth.
struct Piercing {
  int obstacle = 0;
  int v = 0, w = 0;  ///< the edge: vertices of the obstacle's mesh, or of ellipsoidMesh
  int triangle = 0;  ///< of the cloth
};

/// All pairs of an obstacle's edge and a cloth triangle that cross; touching counts. With ends on both sides of the
/// cloth an edge tells of a body vertex through it, even where the cloth's own points stay outside (a spike between
/// them). Ellipsoids are tested by inscribed meshes (ellipsoidMesh, `levels`): a crossing of a chord is a crossing of
/// the ellipsoid. Sorted. `vertices`: of the obstacles that deform; empty where there is none.
std::vector<Piercing> piercings(std::span<const Obstacle> obstacles, std::span<const Placement> placement,
                                const TriangleMesh& cloth, int levels = 4, const DeformedVertices& vertices = {});

/// Triangles with corners on the ellipsoid: the icosahedron, each triangle split into 4 `levels` times.
TriangleMesh ellipsoidMesh(const Ellipsoid& shape, int levels);

}  // namespace gambeson
