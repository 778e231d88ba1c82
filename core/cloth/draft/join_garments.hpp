#pragma once
/// Several garments, worn over each other, as one.

#include <span>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Patches, seams, trims, fields, fabrics and starting places of all, in turn, each garment with a number of its own,
/// the first innermost. Patch k of garment i is patch first + k, first the number of patches before. Garments of unlike
/// fabrics get their own through a material field of degree 0. Throws InputError where there is none, or one whose own
/// fields do not fit.
Garment joinGarments(std::span<const Garment> garments);

}  // namespace gambeson
