#pragma once
/// Garments of triangles as files: those of ours (JSON), which a designer can edit, OBJ and PLY.
///
///   {"format": "gambeson mesh 1", "name": "shirt",
///    "source": {"file": "shirt.obj", "format": "OBJ", "unit": "cm"},      optional
///    "vertices_m": [[x, y, z], ...],                                      each once
///    "patches": [{"name": "front", "triangles": [[0, 1, 2], ...],         numbers of vertices, from 0
///                 "uv_m": [u, v, u, v, ...]}, ...],                       of each corner of each triangle; all have it
///                 or none
///    "edges": [{"name": "hem", "patch": "front", "vertices": [4, 5, 6]}]}   what supports may name, optional
/// Unknown keys are errors.

#include <filesystem>
#include <string>

#include "core/cloth/draft/cloth_mesh.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

struct ClothMeshFile {
  std::string name;
  PatternSource source;
  ClothMesh mesh;
};

/// What their "format" begins with.
inline constexpr const char* kClothMeshFormat = "gambeson mesh";
/// More triangles than a garment has that is worn.
inline constexpr std::size_t kMostClothTriangles = 100000;

/// Reads and checks one of ours (checkMesh). Throws InputError with the file and the line or key.
ClothMeshFile loadClothMesh(const std::filesystem::path& file);
/// The text of one, which is read back to the bit.
std::string clothMeshText(const ClothMeshFile& file);

/// The mesh of a file by its ending: .obj (readObj); .ply (one patch, "cloth", without uv and named edges, its vertices
/// at one place one); .json, one of ours. Throws InputError.
ClothMesh readClothMesh(const std::filesystem::path& file);

}  // namespace gambeson
