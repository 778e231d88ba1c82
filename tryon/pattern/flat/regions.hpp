#pragma once
/// Regions of the body that panels cover, by name: where a panel stands that has no placement of its own.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gambeson {

enum class RegionPart { trunk, skirt, leg, sleeve, collar, waistband };
enum class RegionSide { both, left, right };  ///< of the wearer
enum class RegionFace { both, front, back };

struct PanelRegion {
  RegionPart part = RegionPart::trunk;
  RegionSide side = RegionSide::both;
  RegionFace face = RegionFace::both;
  bool operator==(const PanelRegion&) const = default;
};

/// All words, in the order of the documentation: "front", "back", "left_front", ..
const std::vector<std::string>& regionNames();
/// The region of a word: "left_sleeve", "Left sleeve"; small or large letters, spaces and hyphens as underscores. None
/// where it is none of them.
std::optional<PanelRegion> regionOf(std::string_view word);
/// The word of a region; empty where it has none.
std::string wordOf(const PanelRegion& region);

/// What a piece's name says of where it is worn, as a word of regionNames(): "FRONT", "sleeve_R", "Back left",
/// "pant_f_l", "Vorderteil", "Ärmel links", "manche gauche", "espalda". English, German, French and Spanish words.
/// Empty where the name says nothing or not enough ("sleeve" without a side), two things ("front and back"), or names a
/// part that is sewn onto others (pocket, facing, lining, cuff, ..).
std::string proposedRegion(std::string_view name);

}  // namespace gambeson
