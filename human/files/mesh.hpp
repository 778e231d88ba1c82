#pragma once
/// Mesh files, read through assimp, and written.

#include <filesystem>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

/// The triangles of a mesh file (OBJ, PLY, STL, glTF) in metres times `scale`, welded; throws InputError.
TriangleMesh loadMesh(const std::filesystem::path& file, double scale = 1);
/// The same as the file has them: vertices at one place stay apart, in the file's order.
TriangleMesh loadTriangles(const std::filesystem::path& file, double scale = 1);
/// The same with what each vertex has of the first uv; nothing where the file has none.
struct TriangleMeshWithUv {
  TriangleMesh mesh;
  std::vector<Vec2> uv;
};
TriangleMeshWithUv loadTrianglesWithUv(const std::filesystem::path& file, double scale = 1);

/// The files that a glTF file draws its geometry from: its buffers that are not within itself. None for other files.
/// Throws InputError.
std::vector<std::filesystem::path> filesBeside(const std::filesystem::path& file);

/// A mesh as a Wavefront OBJ file, in metres, with numbers that read back to the same bits.
void writeMesh(const TriangleMesh& mesh, const std::filesystem::path& obj);

}  // namespace gambeson
