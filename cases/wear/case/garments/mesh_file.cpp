/// Detail of kind.hpp: a garment of triangles from a mesh.

#include <cmath>

#include "cases/input/table.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "core/error.hpp"
#include "tryon/pattern/cloth_mesh_file.hpp"

namespace gambeson {
namespace schema {
namespace {

Object meshFileTable() {
  using M = MeshGarment;
  return Table<M>("Mesh file")
      .path("path", &M::path,
            "an OBJ or PLY file, or what gambeson import writes of one (JSON), relative to the case's folder; vertices "
            "at "
            "one place are one. OBJ: groups are patches (materials, where there is one group), lines of a group \"edge "
            "NAME PATCH\" are edges that supports may name. PLY: one patch, \"cloth\", without uv and named edges")
      .required()
      .choice("rest", &M::rest,
              std::vector<std::pair<std::string, MeshRest>>{
                  {"fabric", MeshRest::fabric}, {"shape", MeshRest::shape}, {"uv", MeshRest::flat}},
              "how the cloth lies without stress. fabric: as the mesh stands, its hinges flat unless the fabric's "
              "bending.rest is "
              "\"shape\", as a draft does; shape: as the mesh stands, its hinges with the mesh's angles (collars, "
              "pleats). In both "
              "uv turns the threads alone, weft where u grows. uv: flat, as the mesh's uv says")
      .number("unit", &M::unit_m, "m", between(1e-6, 1e3), "length of a unit of the file")
      .number("uv_unit", &M::uv_unit_m, "m", between(1e-6, 1e3),
              "length of a unit of uv, where the cloth lies as uv says")
      .build();
}

}  // namespace
}  // namespace schema

extern const GarmentKind mesh_file_garment;
const GarmentKind mesh_file_garment{
    .word = "mesh_file",
    .addTo =
        [](schema::Table<GarmentCase>& table) {
          table.alternative<MeshGarment>("mesh_file", &GarmentCase::shape, schema::meshFileTable(),
                                         "a garment of triangles from a mesh");
        },
    .make =
        [](const GarmentMaking& m) {
          const ClothMesh mesh_of_file = readClothMesh(std::get<MeshGarment>(m.worn.shape).path);
          Garment mesh;  // of no patches: its cloth reads the file
          mesh.name = "mesh";
          mesh.patch_names = mesh_of_file.patch_names;
          mesh.edges = namedEdges(mesh_of_file);
          return mesh;
        },
    .look =
        [](const GarmentCase& g) {
          const auto& file = std::get<MeshGarment>(g.shape);
          const ClothMesh mesh = readClothMesh(file.path);
          if (file.path.extension() == ".json" && (file.unit_m != 1 || file.uv_unit_m != 1))
            throw InputError({file.path.string(), 0, file.unit_m != 1 ? "unit" : "uv_unit"},
                             "has no meaning for a mesh that gambeson import wrote: it is in m; allowed: leave it out");
          if (file.rest == MeshRest::flat && mesh.uv.empty())
            throw InputError(
                {file.path.string(), 0, "rest"},
                "the mesh has no uv coordinates to lie flat by; allowed: \"rest\": \"shape\", or vt at all corners");
          Garment seen;
          seen.patch_names = mesh.patch_names;
          seen.patches.resize(mesh.patch_names.size());
          seen.edges = namedEdges(mesh);
          return seen;
        },
    .files = [](GarmentCase& g, const GarmentKind::Take& take) { take(std::get<MeshGarment>(g.shape).path); },
    .triangles =
        [](const GarmentCase& worn, const Fabric& fabric) {
          const auto& file = std::get<MeshGarment>(worn.shape);
          MeshDraft g;
          g.mesh = readClothMesh(file.path);
          g.rest = file.rest;
          g.fabrics = {fabric};
          for (Vec3& x : g.mesh.vertices) x = file.unit_m * x + worn.position_m;
          const double c = std::cos(worn.weft_angle_rad), s = std::sin(worn.weft_angle_rad);
          for (auto& corners : g.mesh.uv)
            for (Vec2& at : corners)
              at = {file.uv_unit_m * (c * at.x + s * at.y), file.uv_unit_m * (c * at.y - s * at.x)};
          return g;
        },
};

}  // namespace gambeson
