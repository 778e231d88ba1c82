/// Detail of kind.hpp: triangles from a file.

#include "cases/contact/obstacles/kind.hpp"
#include "cases/input/table.hpp"
#include "human/files/mesh.hpp"

namespace gambeson {
namespace schema {
namespace {

const Range world = between(-1e3, 1e3);

Object meshTable() {
  using M = MeshObstacle;
  return Table<M>("Mesh")
      .path("file", &M::file, "OBJ, PLY, STL or glTF, relative to the case's folder")
      .required()
      .number("scale", &M::scale, "", aboveTo(0, 1e6), "metres per unit of the file")
      .vector("position", &M::position_m, "m", world, "where the file's origin stands")
      .build();
}

}  // namespace
}  // namespace schema

extern const ObstacleKind mesh_obstacle;
const ObstacleKind mesh_obstacle{
    .word = "mesh",
    .addTo =
        [](schema::Table<ObstacleCase>& table) {
          table.alternative<MeshObstacle>("mesh", &ObstacleCase::shape, schema::meshTable(), "triangles from a file");
        },
    .make =
        [](const ObstacleCase& o, const Hurdle*) {
          const auto& m = std::get<MeshObstacle>(o.shape);
          TriangleMesh mesh = loadMesh(m.file, m.scale);
          std::vector<std::string> notes;
          if (const std::string defects = defectsOf(mesh, o.name, m.file); !defects.empty())
            notes.push_back("obstacle " + o.name + " (" + m.file.filename().string() + ") " + defects);
          return MadeObstacle{std::move(mesh), m.position_m, nullptr, std::move(notes)};
        },
    .check =
        [](const ObstacleCase& o) {
          const auto& m = std::get<MeshObstacle>(o.shape);
          loadMesh(m.file, m.scale);
        },
    .files =
        [](ObstacleCase& o, const ObstacleKind::Take& take) {
          auto& m = std::get<MeshObstacle>(o.shape);
          for (std::filesystem::path file : filesBeside(m.file)) take(file);
          take(m.file);
        },
};

}  // namespace gambeson
