#pragma once
/// Quantities as people write them: "0.762 mm", "57 deg", "4 kg/(m^2 s)".

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

/// Parses a unit: m g s N Pa rad J Hz with the prefixes n u µ m c d k M G; deg ° in ft min % gf gsm (g/m²); products by
/// space,
/// "*" or "·", quotients by "/", powers by "^" or ² ³ (and negative: s^-1), parentheses, 1 ("1/m"); "" is the plain
/// number. After "/" a product needs parentheses: "kg/m s" is refused because people read it in two ways. Throws
/// InputError (no file, no key).
Unit parseUnit(std::string_view text);

/// Parses "number unit" and gives it in SI; throws InputError where the number is malformed or not finite or where the
/// unit does not measure the same as `si_unit` ("kg/m^3").
double parseQuantity(std::string_view text, std::string_view si_unit);

}  // namespace gambeson
