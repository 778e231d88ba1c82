#pragma once
/// From drafted garments to the cloth that is worn.

#include <memory>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/cloth/cloth.hpp"
#include "core/motion/stitch.hpp"

namespace gambeson {

/// The garments of a case as one cloth.
struct ClothDraft {
  std::unique_ptr<const Cloth> cloth;
  std::vector<std::vector<NamedEdge>> edges;  ///< of each garment; patches counted in the garment
  std::vector<int> samples_per_cell;          ///< of each patch
  std::vector<Vec3> start_m;                  ///< displacement of each point from rest, that the motion starts from
  std::vector<Vec3> placed_m;                 ///< of that what its garment's draft says of its place, without noise
  std::vector<Stitch> stitches;               ///< of panels that stand apart
};

/// `c`: with its factors; `written`: its factors as they stand, for the springs of seams. `panels`: the one garment
/// without its seams, springs in their place, its panels moved off the body. `closing`: the seams of flat panels are
/// still to be closed. Throws InputError with the garment's key.
ClothDraft clothOf(const Case& c, const FactorsCase& written, const Wardrobe& wardrobe, bool panels, bool closing);

}  // namespace gambeson
