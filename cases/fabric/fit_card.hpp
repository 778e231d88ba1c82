#pragma once
/// From points that a laboratory measured to the numbers of a card, with their errors.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/cloth/card.hpp"

namespace gambeson {

/// Points of tests, SI; empty: not measured.
struct Measurements {
  std::string source;
  std::vector<TensilePoint> tension[2];           ///< weft, warp: strain, force per width
  std::vector<std::array<double, 2>> shear;       ///< angle [rad], force per width, in the order of the loop
  std::vector<std::array<double, 2>> bending[2];  ///< weft, warp: curvature [1/m], moment per width [N], likewise
  std::vector<double> overhang[2];                ///< weft, warp: of ASTM D1388, each of one specimen [m]
};

/// Throws InputError with file, line and key.
Measurements readMeasurements(const std::filesystem::path& file);

struct FittedNumber {
  std::string name, unit;
  double per_unit = 1;          ///< SI of one of the unit
  double value = 0, error = 0;  ///< SI; one standard deviation
  int points = 0;               ///< that it was found from
  double rms = 0;               ///< what the fit misses of them, SI of what was measured
};

/// Finds the numbers by least squares (core/math/least_squares.hpp), each test by itself, and puts them into the card
/// in place of its own:
///   tension: EMT and LT of F = F_max (exp(b e/EMT) - 1)/(exp(b) - 1), the law of tensilePointsOfKes, at
///     F_max = 500 gf/cm; LT = 2/b - 2/(exp(b) - 1), its error by dLT/db; the card's law stays;
///   shear: F = G tan(angle) +- 2HG/2, the sign that of the way on which the point lies, of angles from 0.5 degrees on;
///   bending: M = B k +- 2HB/2 likewise, of |k| from 0.5 to 1.5/cm, where KES-FB2 reads B;
///   overhang: L/2 = (B/(W g))^(1/3), with the card's weight (Peirce, ASTM D1388).
/// The first point of a loop is on no way and is left out. Throws InputError (key of the test, reason) where a test has
/// too few points, does not determine its numbers, or gives some that no card has.
std::vector<FittedNumber> fitCard(const Measurements& m, FabricCard& card);

/// What is said of them on the terminal.
std::string fittedTable(const std::vector<FittedNumber>& numbers);

namespace schema {
struct Object;
/// Of such a file, for the documentation.
const Object& measurementsTable();
}  // namespace schema

}  // namespace gambeson
