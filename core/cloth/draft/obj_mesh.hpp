#pragma once
/// Garments of triangles in OBJ files (Wavefront).
///
/// Groups are patches, in the order in which they first have a face: `g`, or `usemtl` where faces have no group or all
/// the same one, else the whole file. Faces of more than three corners are cut into triangles around their first.
/// Vertices at exactly the same place are one. vt becomes uv where all faces have it. Lines (`l`) of a group "edge NAME
/// PATCH" are the named edges of that patch. Normals, materials' looks and smoothing are left out.

#include <filesystem>
#include <string>

#include "core/cloth/draft/cloth_mesh.hpp"

namespace gambeson {

/// Throws InputError with file and line where the file cannot be read as such a mesh, has more than 500,000 vertices or
/// faces, or where checkMesh finds a fault.
ClothMesh readObj(const std::filesystem::path& file);

/// The same before checkMesh, and what else the file says.
struct ObjContent {
  ClothMesh mesh;
  int cut_faces = 0;                            ///< of more than three corners
  int bare_faces = 0;                           ///< without vt, in a file in which others have it
  int normals = 0, looks = 0, other_lines = 0;  ///< vn; materials' files; lines, points, curves that are no named edges
};
ObjContent readObjContent(const std::filesystem::path& file);

/// The file, with 17 digits: readObj gives the same mesh back. Spaces in names become '_'.
std::string objText(const ClothMesh& mesh, const std::string& name);

}  // namespace gambeson
