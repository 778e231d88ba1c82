#pragma once
/// The units that have a name, and the names of what they measure.

#include <array>
#include <string>
#include <string_view>

#include "cases/input/units.hpp"

namespace gambeson {

/// A unit by its name, with a prefix where it takes one. Upper and lower case count, unless no or one reading is left:
/// "PSI" is psi, "MM" could be mm or Mm. Throws InputError that says what is known, or what it could be.
Unit namedUnit(std::string_view name);

/// What has a dimension: "a length", and three units in which people write it.
struct Measure {
  std::string_view name;
  std::array<std::string_view, 3> units;
};
/// Null where the dimension has no name here.
const Measure* measureWith(const Dimension& dimension);

}  // namespace gambeson
