#pragma once
/// Garments of triangles in OBJ files (Wavefront).
///
/// Groups (`g`, else `usemtl`, else the whole file) are patches, in the order in which they first have a face. Faces of
/// more than three corners are cut into triangles around their first. Vertices at exactly the same place are one. vt
/// becomes uv where all faces have it. Lines (`l`) of a group "edge NAME PATCH" are the named edges of that patch.
/// Normals, materials' looks and smoothing are left out.

#include <filesystem>
#include <string>

#include "core/cloth/draft/cloth_mesh.hpp"

namespace gambeson {

/// Throws InputError with file and line where the file cannot be read as such a mesh, has more than 500,000 vertices or
/// faces, or where checkMesh finds a fault.
ClothMesh readObj(const std::filesystem::path& file);

/// The file, with 17 digits: readObj gives the same mesh back. Spaces in names become '_'.
std::string objText(const ClothMesh& mesh, const std::string& name);

}  // namespace gambeson
