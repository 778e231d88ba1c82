#pragma once
/// Public frames as scenes for the search for impacts.

#include <filesystem>

#include "gpu/scenes/scene.hpp"
#include "tools/collision_data.hpp"

namespace gambeson::gpu {

struct FramesFiles {
  const char *name, *folder, *start, *end, *number;
};
inline constexpr FramesFiles kPublicFrames[] = {
    {"cloth-ball 92->93", "cloth-ball", "cloth_ball92.ply", "cloth_ball93.ply", "92"},
    {"cloth-funnel 227->228", "cloth-funnel", "227.ply", "228.ply", "227"}};

/// collision: the folder real/collision of the data. Separation 0.
inline Scene framesScene(const std::filesystem::path& collision, const FramesFiles& files) {
  const auto start = collision::readPly(collision / files.folder / files.start);
  const auto end = collision::readPly(collision / files.folder / files.end);
  Scene scene;
  scene.name = files.name;
  scene.mesh = {static_cast<int>(start.vertices.size()), start.faces, collision::edgesOf(start)};
  scene.x0 = start.vertices, scene.x1 = end.vertices;
  scene.options.tolerance_m = 1e-10;
  return scene;
}

}  // namespace gambeson::gpu
