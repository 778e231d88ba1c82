#pragma once
/// Sheets made by code without a mathematics library, for what is compared between machines.

#include <memory>
#include <string>
#include <vector>

#include "core/cloth/shell/nurbs_shell.hpp"

namespace gambeson::gpu {

struct ForceScene {
  std::string name;
  std::shared_ptr<const Cloth> cloth;
  std::vector<Vec3> p;  ///< free points of a state that is stretched and bent
};

/// One patch of so many cells of about 13 mm, uneven; cloth of the size of a garment's.
ForceScene forceSheet(int cells_u, int cells_v, bool rational, int degree = 2);
/// Two of them, sewn along an edge that may fold.
ForceScene sewnSheets(int cells);

/// Scenes whose forces are kept in gpu/manifest.json by hash.
std::vector<ForceScene> manifestForceScenes();

/// Of forces in their order.
std::uint64_t hashOfForces(const std::vector<Vec3>& forces);

}  // namespace gambeson::gpu
