#pragma once
/// What both readers that use assimp ask of it. For use within readApart.

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <string>

namespace gambeson {

/// The largest file that is read, by itself or named by another.
constexpr std::uintmax_t largest_scene_file = std::uintmax_t{256} << 20;

/// "OBJ" -> ".obj"
std::string extensionOf(const std::filesystem::path& file);

/// Reads a scene (validated, nothing else done to it). Files that it names are regular ones of at most
/// `largest_scene_file` bytes, or InputError; so are the JSON of glTF nested deeper than 64 levels and faces without a
/// corner.
const aiScene& importScene(Assimp::Importer& importer, const std::filesystem::path& file);

/// Post-processing steps (aiProcess_...) on what importScene read.
const aiScene& processScene(Assimp::Importer& importer, unsigned steps, const std::filesystem::path& file);

}  // namespace gambeson
