#pragma once
/// Round numbers for axes and colour bars, and numbers as people write them.

#include <string>
#include <vector>

namespace gambeson {

struct Ticks {
  std::vector<double> values;  ///< rising, within the range, at multiples of `step`
  double step = 0;             ///< 1, 2 or 5 times a power of ten
  /// The value with as many decimals as `step` needs, U+2212 as the minus sign.
  std::string label(double value) const;
};

/// niceTicks of an axis along which labels stand side by side: fewer than `target` where they would touch. `length` of
/// the axis and `per_character`, both in the same unit.
Ticks ticksThatFit(double low, double high, int target, double length, double per_character);

/// Ticks within [low, high], about `target` of them. Needs finite low < high and target >= 1.
Ticks niceTicks(double low, double high, int target);

/// The value rounded to `digits` significant digits, without exponent between 1e-4 and 1e6: 1.83, 0.0042, 12 300.
/// U+2212 as the minus sign; "not a number" and "infinite" for what is not finite.
std::string formatNumber(double value, int digits = 3);

/// The same without zeros at its end: 5, not 5.00.
std::string formatBrief(double value, int digits = 3);

/// The value rounded up to 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6 or 8 times a power of ten; 0 for what is not above 0.
double roundedUp(double value);

}  // namespace gambeson
