#pragma once
/// Variants of a garment against each other: exponents, elasticities, traffic lights. Pure functions of numbers.

#include <optional>
#include <span>
#include <string>

namespace gambeson {

/// y = c x^exponent through all points, by least squares in the logarithms.
struct PowerLaw {
  double exponent = 0;
  double standard_error = 0;       ///< of the exponent; NaN for two points, which no line can miss
  double lowest = 0, highest = 0;  ///< exponents between neighbouring points: the law's spread
  int points = 0;
  /// The curve rises somewhere and falls elsewhere: no power describes it.
  bool turns() const { return points > 2 && lowest < -0.05 && highest > 0.05; }
};
/// Nothing where there are less than two points, where x repeats alone, or where a value is not above 0 and finite.
std::optional<PowerLaw> fitPowerLaw(std::span<const double> x, std::span<const double> y);

/// d ln y / d ln f by a central difference: ln(y_high / y_low) / ln(high / low). Nothing where a value is not above 0.
std::optional<double> elasticity(double low, double high, double y_low, double y_high);

/// Parts of a torque: how many per cent it changes with one per cent of each. The forces of the cloth are linear in
/// these five together, so that they sum to 1, but for what contact and supports have of their own.
struct Elasticities {
  std::optional<double> bending, membrane, weight, inertia, drag;
  bool complete() const { return bending && membrane && weight && inertia && drag; }
  /// The sum of all five; nothing where one is missing.
  std::optional<double> sum() const;
  /// The exponent of the thickness that they predict: membrane, weight and inertia go with t, bending with t^3, drag
  /// does not change. Nothing where one of them is missing.
  std::optional<double> thicknessExponent() const;
};

/// Doubtful: it would be green, but for what its number stands on (analysis/trust.hpp).
enum class Light { unknown, green, doubtful, amber, red };
/// The light that a part of the natural moment has; NaN is unknown.
Light lightOf(std::optional<double> part, double green, double red);
const char* nameOf(Light light);
/// The light of this name; unknown for any other name.
Light lightNamed(const std::string& name);

}  // namespace gambeson
