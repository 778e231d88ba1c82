#pragma once
/// Reading a human: URDF through urdfdom, a body file beside it, meshes through assimp.

#include <filesystem>

#include "human/body.hpp"

namespace gambeson {

/// Reads a URDF and validates what urdfdom lets pass (zero axes, inverted limits, detached cycles, unknown geometry,
/// non-finite numbers). Visual boxes, cylinders and spheres become shapes (boxes and cylinders tessellated); meshes per
/// link are read through assimp. Throws InputError with file, line and element.
Human loadUrdf(const std::filesystem::path& urdf);

/// Reads a URDF and a body file (JSON: ellipsoids per link), whose shapes replace the URDF's geometry.
Human loadHuman(const std::filesystem::path& urdf, const std::filesystem::path& body);

/// The triangles of a mesh file (OBJ, PLY, STL, glTF) in metres times `scale`, welded; throws InputError.
TriangleMesh loadMesh(const std::filesystem::path& file, double scale = 1);
/// The same as the file has them: vertices at one place stay apart, in the file's order.
TriangleMesh loadTriangles(const std::filesystem::path& file, double scale = 1);

/// Our own manikin by name (male_p5 ... female_p95), generated from the facts in human/data.
Human makeManikin(const std::string& name);
/// The same manikin as a URDF and a body file that loadHuman reads back.
void writeManikin(const std::string& name, const std::filesystem::path& urdf, const std::filesystem::path& body);

/// A mesh as a Wavefront OBJ file, in metres.
void writeMesh(const TriangleMesh& mesh, const std::filesystem::path& obj);

}  // namespace gambeson
