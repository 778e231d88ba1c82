#pragma once
/// Garments of triangles from other programs: OBJ and PLY, as files of ours (tryon/pattern/cloth_mesh_file.hpp).

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "cases/pattern/imported.hpp"
#include "tryon/pattern/cloth_mesh_file.hpp"

namespace gambeson {

struct ImportedMesh {
  ClothMeshFile file;                     ///< in m, z up; uv in m where it is a flat shape of the cloth
  std::vector<std::vector<int>> borders;  ///< bordersOf, the longest first
  FlatPattern flat;                       ///< its islands of uv; no panels where there is no uv
  std::vector<std::string> notes;         ///< what was read in a way that should be known
  std::vector<std::string> dropped;       ///< what the file says and the garment has no place for
};

/// Whether a file is one by its ending: .obj, .ply.
bool isClothMesh(const std::filesystem::path& file);

/// Vertices within 0.01 mm are one; triangles are turned to face one side; patches are the file's groups or materials,
/// and of these each island of uv. The file is in m, with z up, unless the choices say others. Borders are named edges,
/// "border_1" the longest. Throws InputError with the file, the patch and the place: what weldMesh refuses, meshes that
/// are larger or smaller than garments are, those of more than 100,000 triangles.
ImportedMesh importMesh(const std::filesystem::path& file, const ImportChoices& choices, const std::string& name);

/// Patches with areas, borders and seams with lengths; notes and what was dropped are the caller's to say.
void sayMesh(const ImportedMesh& in, std::ostream& out);

}  // namespace gambeson
