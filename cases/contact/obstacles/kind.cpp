#include "cases/contact/obstacles/kind.hpp"

#include <array>
#include <variant>

#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"

namespace gambeson {

extern const ObstacleKind ellipsoid_obstacle, sphere_obstacle, plane_obstacle, torus_obstacle, mesh_obstacle,
    hurdle_obstacle, sequence_obstacle;

std::span<const ObstacleKind* const> obstacleKinds() {
  static constexpr std::array kinds{&ellipsoid_obstacle, &sphere_obstacle, &plane_obstacle,   &torus_obstacle,
                                    &mesh_obstacle,      &hurdle_obstacle, &sequence_obstacle};
  static_assert(kinds.size() == std::variant_size_v<decltype(ObstacleCase::shape)>);
  return kinds;
}

const ObstacleKind& kindOf(const ObstacleCase& o) { return *obstacleKinds()[o.shape.index()]; }

std::string defectsOf(const TriangleMesh& mesh, const std::string& name, const std::filesystem::path& file) {
  try {
    return meshDefects(meshTopology(mesh));
  } catch (const InputError& e) {
    throw InputError({file.string(), 0, ""}, "the mesh of obstacle " + name + ": " + e.reason());
  }
}

}  // namespace gambeson
