#pragma once
/// The body file beside a URDF: ellipsoids per link.

#include <filesystem>

#include "human/body/body.hpp"

namespace gambeson {

/// Reads a URDF and a body file (JSON: ellipsoids per link), whose shapes replace the URDF's geometry.
Human loadHuman(const std::filesystem::path& urdf, const std::filesystem::path& body);

}  // namespace gambeson
