#pragma once
/// Quantities as people write them: "0.762 mm", "57 deg", "8 oz/yd^2", "0,172 gf.cm2/cm".

#include <optional>
#include <string>
#include <string_view>

namespace gambeson {

/// Exponents of metre, second, kilogram and radian. The radian counts, so that an angle is not taken for a plain
/// number.
struct Dimension {
  int m = 0, s = 0, kg = 0, rad = 0;
  bool operator==(const Dimension&) const = default;
};

/// A unit: 1 of it is `factor` in SI.
struct Unit {
  double factor = 1;
  Dimension dimension;
};

/// Parses a unit of those in unit_symbols.cpp: products by space, "*", "·", "." or "-", quotients by "/", powers by
/// "^", digits or superscripts (m^2, m2, m², s^-1), parentheses, a number in a denominator ("N/5cm", "1/m"); "" is the
/// plain number. After "/" a product needs parentheses: "kg/m s" is refused because people read it in two ways. Throws
/// InputError (no file, no key).
Unit parseUnit(std::string_view text);

/// A quantity as it was written: its value in SI, and the unit of the text.
struct Quantity {
  double si = 0;
  double value = 0;   ///< in its unit
  std::string unit;   ///< as it was typed, without spaces around; "" for a plain number
  double factor = 1;  ///< of this unit
};

/// Parses "number unit". Between number and unit may stand a space of any kind, or none. A comma is the decimal point
/// where it can be nothing else ("0,45 mm"; "1,234 mm" is refused), and groups of three digits may be apart by spaces.
/// Throws InputError where the number is malformed or not finite or where the unit does not measure the same as
/// `si_unit` ("kg/m^3").
Quantity readQuantity(std::string_view text, std::string_view si_unit);
/// The same of a quantity of any sort; nothing where it is none.
std::optional<Quantity> anyQuantity(std::string_view text);
/// Its value in SI.
double parseQuantity(std::string_view text, std::string_view si_unit);

/// What is measured in a unit of SI, with three examples: "a length, such as mm, cm or in"; "one like N/m^3" where it
/// has no name.
std::string measureOf(std::string_view si_unit);

}  // namespace gambeson
