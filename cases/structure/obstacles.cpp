/// Detail of results.hpp: what a sheet touches, as a surface.

#include "analysis/render/shapes.hpp"
#include "cases/structure/results.hpp"

namespace gambeson {
namespace {

/// The obstacles where they stand at a time.
std::vector<RenderMesh> surfacesAt(const StructureModel& model, double time_s) {
  const Model& m = *model.motion;
  std::vector<Placement> placements(m.obstacles.size());
  model.stage->placements(time_s, placements, {});
  std::vector<RenderMesh> meshes;
  for (std::size_t k = 0; k < m.obstacles.size(); ++k) {
    meshes.push_back(meshOf(m.obstacles[k].shape, placements[k], {}));
    if (m.obstacles[k].deforms) model.stage->vertices(static_cast<int>(k), time_s, meshes.back().vertices);
  }
  return meshes;
}

}  // namespace

std::vector<std::array<int, 3>> obstacleTriangles(const StructureModel& model) {
  std::vector<std::array<int, 3>> all;
  if (!model.motion) return all;
  int first = 0;
  for (const RenderMesh& mesh : surfacesAt(model, 0)) {
    for (const std::array<int, 3>& t : mesh.triangles) all.push_back({first + t[0], first + t[1], first + t[2]});
    first += static_cast<int>(mesh.vertices.size());
  }
  return all;
}

std::vector<Vec3> obstacleVertices(const StructureModel& model, double time_s) {
  std::vector<Vec3> all;
  if (!model.motion) return all;
  for (const RenderMesh& mesh : surfacesAt(model, time_s))
    all.insert(all.end(), mesh.vertices.begin(), mesh.vertices.end());
  return all;
}

}  // namespace gambeson
