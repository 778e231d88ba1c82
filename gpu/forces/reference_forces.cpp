/// Detail of forces.hpp: on the host, and what both devices share.
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "gpu/forces/shell_forces.hpp"

namespace gambeson::gpu {

std::optional<std::string> notCarried(const Cloth& cloth) {
  if (const auto* shell = dynamic_cast<const NurbsShell*>(&cloth)) return notCarried(shell->elements());
  return dynamic_cast<const TriangleCloth*>(&cloth) ? "cloth of triangles" : "cloths of several kinds";
}

std::unique_ptr<Forces> forcesOnReference(const Cloth& cloth, const ForceOptions& options) {
  return forcesOn<Reference>(cloth, options);
}

namespace {
template <class... Tiles>
std::vector<std::string> tileNames(std::type_identity<std::tuple<Tiles...>>) {
  return {(std::to_string(Tiles::kCellsU) + " x " + std::to_string(Tiles::kCellsV) + " cells, " +
           std::to_string(Tiles::kResident) + " blocks")...};
}
template <class... Strips>
std::vector<std::string> stripNames(std::type_identity<std::tuple<Strips...>>) {
  return {(std::to_string(Strips::kCellsU) + " cells, " + std::to_string(Strips::kResident) + " blocks")...};
}
}  // namespace

std::vector<std::string> quadSizes(QuadPath path) {
  if (path == QuadPath::strips) return stripNames(std::type_identity<QuadStrips>{});
  return tileNames(std::type_identity<QuadTiles>{});
}

}  // namespace gambeson::gpu
