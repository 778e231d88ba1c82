/// Detail of forces.hpp: on the host, and what both devices share.
#include "gpu/forces/shell_forces.hpp"

namespace gambeson::gpu {

std::optional<std::string> notCarried(const Cloth& cloth) {
  if (const auto* shell = dynamic_cast<const NurbsShell*>(&cloth)) return notCarried(shell->elements());
  return "cloth of triangles";
}

std::unique_ptr<Forces> forcesOnReference(const Cloth& cloth, const ForceOptions& options) {
  return forcesOn<Reference>(cloth, options);
}

std::vector<std::string> quadSizes(QuadPath path) {
  if (path == QuadPath::strips) return {"32 cells, 4 blocks", "32 cells, 5 blocks", "64 cells, 2 blocks"};
  return {"8 x 8 cells", "8 x 12 cells", "8 x 4 cells"};
}

}  // namespace gambeson::gpu
