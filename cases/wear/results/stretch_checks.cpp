#include "cases/wear/results/stretch_checks.hpp"

#include <fmt/format.h>

#include "cases/cloth/limit_name.hpp"

namespace gambeson {
namespace {

/// The fabric that states the limit which counts along a thread (0: weft, 1: warp), as a check calls it; empty where
/// that is a law's range.
std::string limitingFabric(const Case& c, const GarmentCase& g, std::size_t thread, double counts) {
  const auto limitOf = [&](const FabricCase& f) { return thread == 0 ? f.limit_strain_weft : f.limit_strain_warp; };
  const FabricCase own = fabricOf(c, g);
  const FabricCase* least = limitOf(own) ? &own : nullptr;
  for (const FabricCase& other : g.other_fabrics)
    if (limitOf(other) && (!least || *limitOf(other) < *limitOf(*least))) least = &other;
  if (!least || *limitOf(*least) > counts || least->limit_of_law[thread]) return "";
  return nameOfLimit(least->card, least->name);
}

}  // namespace

std::vector<AuditCheck> stretchChecks(const Case& c, std::span<const Stretch> measured) {
  std::vector<AuditCheck> checks;
  for (const Stretch& s : measured)
    for (const GarmentCase& g : c.garments) {
      if (!s.stated || !(s.garment.empty() || s.garment == g.name)) continue;
      const std::string fabric = limitingFabric(c, g, s.along == "warp" ? 1 : 0, s.limit);
      if (!fabric.empty())
        checks.push_back(
            {fmt::format("Stretch along the {}, {}{}", s.along, s.garment.empty() ? "" : s.garment + ", ", fabric),
             100 * s.largest, 100 * s.limit, "%",
             "the largest Green-Lagrange strain along these threads over the motion, against how far the "
             "fabric may be stretched"});
      break;
    }
  return checks;
}

}  // namespace gambeson
