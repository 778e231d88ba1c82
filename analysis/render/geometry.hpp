#pragma once
/// The triangles of a scene in camera coordinates, ready to be drawn.

#include <cstdint>
#include <vector>

#include "analysis/render/camera.hpp"

namespace gambeson {

/// As the shaders read it. `map` is the place in the colour map, `mapped` 1 where the colour comes from it.
struct DrawVertex {
  float position[3], normal[3], color[3];
  float map = 0, mapped = 0;
  float lit = 1;  ///< 1: shaded, 0: plain colour (boundary lines)
};

struct DrawList {
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Mean of the triangles' normals at each vertex, weighted by the angle there; zero where there is none.
std::vector<Vec3> smoothNormals(const RenderMesh& mesh);

/// All meshes. Boundary lines are `line_m` wide. Throws RunError where a mesh is not finite or points outside itself.
DrawList drawListOf(const std::vector<RenderMesh>& meshes, const Camera& camera, double low, double high,
                    double line_m);

/// A shaft with a cone, tip at `to`, `radius_m` thick (thinner where the arrow is short), both in camera coordinates.
void addArrow(DrawList& list, const Vec3& from, const Vec3& to, double radius_m, Color color);

}  // namespace gambeson
