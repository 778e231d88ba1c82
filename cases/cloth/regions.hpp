#pragma once
/// The key `regions` of garments: named parts of a garment, each with a factor on its thickness.

#include <array>
#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// A rectangle in the parameters of a patch. u and v are fractions of the patch's range, in hundredths.
struct RegionRectangle {
  std::string patch;  ///< by name; empty: every patch of the garment
  std::array<double, 2> u{0, 1}, v{0, 1};
};

struct RegionCase {
  std::string name;
  std::vector<RegionRectangle> parts;  ///< empty: all of the garment
  double thickness = 1;                ///< over that of the fabric
};

/// Multiplies the thickness of a garment, region by region: a degree-0 field on each patch that a region is on, 1 where
/// there is none. Mass and membrane stiffness follow in proportion, bending with the cube (fabricAt); springs along
/// seams stay. Throws InputError whose key is "regions[i].parts[k].KEY" where a patch is not there, has a field of its
/// thickness, or where two parts share cloth.
void applyRegions(const std::vector<RegionCase>& regions, Garment& garment);

/// The largest factor that a region has, at least 1: what is in no region keeps its thickness.
double largestFactor(const std::vector<RegionCase>& regions);

}  // namespace gambeson
