#pragma once
/// Values in the unit that somebody typed them in.

#include <string>

#include "cases/input/schema.hpp"
#include "cases/input/units.hpp"

namespace gambeson::schema {

/// A range in the unit of a quantity: "> 0 and <= 50 mm".
std::string rangeText(const Range& range, const Quantity& in);

/// A value of SI in the unit that the member `key` of an object was typed in ("30 mil"), in `unit` where it has none.
std::string inUnitOf(const Entry& object, const std::string& key, double si, const std::string& unit);

}  // namespace gambeson::schema
