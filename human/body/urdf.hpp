#pragma once
/// Reading a human from a URDF, through urdfdom.

#include <filesystem>
#include <vector>

#include "human/body/body.hpp"

namespace gambeson {

/// Reads a URDF and validates what urdfdom lets pass (zero axes, inverted limits, detached cycles, unknown geometry,
/// non-finite numbers). Visual boxes, cylinders and spheres become shapes (boxes and cylinders tessellated); meshes per
/// link are read through assimp. Throws InputError with file, line and element.
Human loadUrdf(const std::filesystem::path& urdf);

/// The files that a URDF draws its geometry from: its meshes, and what those name. Throws InputError.
std::vector<std::filesystem::path> filesBesideUrdf(const std::filesystem::path& urdf);

}  // namespace gambeson
