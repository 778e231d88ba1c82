#pragma once
/// Variants of a garment against each other: exponents, elasticities, and the sentence that says which one to take.
/// Pure functions of numbers.

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gambeson {

/// y = c x^exponent through all points, by least squares in the logarithms.
struct PowerLaw {
  double exponent = 0;
  double standard_error = 0;       ///< of the exponent; NaN for two points, which no line can miss
  double lowest = 0, highest = 0;  ///< exponents between neighbouring points: the law's spread
  int points = 0;
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
  /// Of all five; nothing where one is missing.
  std::optional<double> sum() const;
  /// The exponent of the thickness that they predict: membrane, weight and inertia go with t, bending with t^3, drag
  /// does not change. Nothing where one of them is missing.
  std::optional<double> thicknessExponent() const;
};

enum class Light { unknown, green, amber, red };
/// Of a part of the natural moment; NaN is unknown.
Light lightOf(std::optional<double> part, double green, double red);
const char* nameOf(Light light);

/// One level of what is compared, as a designer may choose it.
struct Option {
  std::string name;            ///< "thickness 0.75"
  std::optional<double> size;  ///< thickness, where it is one
  struct Cost {
    std::string motion;           ///< empty where there is one only
    std::string joint;            ///< "left hip (flexion)"
    double peak_Nm = 0;           ///< size of the largest added torque
    std::optional<double> part;   ///< of the natural moment
    std::optional<double> ratio;  ///< of the peak of the baseline
  };
  std::vector<Cost> costs;  ///< of each motion
  bool missing = false;     ///< a run of it failed
};

struct VerdictInput {
  std::string what;             ///< "thickness"
  bool sized = false;           ///< options are sizes of which more protects more: the thickest that is green is wanted
  std::vector<Option> options;  ///< with sizes: rising
  int baseline = -1;
  double green = 0, red = 0;
  /// Relative difference of a peak between the coarse and the fine mesh, the largest; nothing: one mesh only.
  std::optional<double> mesh_error;
  struct Exponent {
    std::string motion;
    PowerLaw law;
  };
  std::vector<Exponent> exponents;
  int failing_checks = 0, checked_runs = 0;  ///< runs with checks that fail, of how many
};

struct Verdict {
  int take = -1;  ///< option; -1: none can be named
  Light light = Light::unknown;
  std::string sentence;  ///< which one to take
  std::string why;
  std::string sure;  ///< how sure that is
  /// Relative error of the torques up to which the choice stays the same; nothing where no limit decides.
  std::optional<double> holds_up_to;
};
Verdict verdictOf(const VerdictInput& input);

}  // namespace gambeson
