#include "core/material/kes_shear.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

double strainAt(double degrees) { return std::tan(degrees * std::numbers::pi / 180); }

}  // namespace

KesShear readKesShear(const ShearedSheet& sheet) {
  const double numbers[3] = {sheet.friction.rise_N_per_m, sheet.friction.span, sheet.friction.growth_N_per_m};
  std::array<double, kShearHistory> committed{}, trial{};
  const auto shearTo = [&](double degrees) {
    Answer<double, 3> out{};
    out.resultant[0] = out.resultant[1] = 0;
    const double g = strainAt(degrees);
    out.resultant[2] = sheet.elastic_N_per_m * g;
    addShearFriction<only_resultants>(numbers, g, History<double>{committed.data(), trial.data(), 1, true}, 0, out);
    committed = trial;
    return out.resultant[2];
  };
  shearTo(8);
  shearTo(-8);
  const double low = shearTo(0.5), high = shearTo(2.5), up_5 = shearTo(5);
  shearTo(8);
  const double down_5 = shearTo(5), down = shearTo(0.5);
  return {(high - low) / ((2.5 - 0.5) * std::numbers::pi / 180), low - down, up_5 - down_5};
}

ShearedSheet sheetOfKesShear(const KesShear& read, double span) {
  // All that is read is linear in the three numbers.
  const KesShear elastic = readKesShear({1, {}}), steady = readKesShear({0, {1, span, 0}}),
                 growing = readKesShear({0, {0, span, 1}});
  ShearedSheet sheet;
  sheet.friction.span = span;
  if (read.hysteresis_5_N_per_m > 0) {
    const double a = steady.hysteresis_N_per_m, b = growing.hysteresis_N_per_m, c = steady.hysteresis_5_N_per_m,
                 d = growing.hysteresis_5_N_per_m, determinant = a * d - b * c;
    sheet.friction.rise_N_per_m = (d * read.hysteresis_N_per_m - b * read.hysteresis_5_N_per_m) / determinant;
    sheet.friction.growth_N_per_m = (a * read.hysteresis_5_N_per_m - c * read.hysteresis_N_per_m) / determinant;
    if (!(sheet.friction.rise_N_per_m >= 0 && sheet.friction.growth_N_per_m >= -1e-9 * read.hysteresis_N_per_m / a))
      throw InputError({}, fmt::format("2HG5 = {:.4g} N/m is out of range; allowed beside 2HG = {:.4g} N/m: {:.4g} to "
                                       "{:.4g} N/m",
                                       read.hysteresis_5_N_per_m, read.hysteresis_N_per_m,
                                       read.hysteresis_N_per_m * c / a, read.hysteresis_N_per_m * d / b));
    sheet.friction.growth_N_per_m = std::max(0.0, sheet.friction.growth_N_per_m);
  } else {
    sheet.friction.rise_N_per_m = read.hysteresis_N_per_m / steady.hysteresis_N_per_m;
  }
  const double of_friction = sheet.friction.rise_N_per_m * steady.rigidity_N_per_m +
                             sheet.friction.growth_N_per_m * growing.rigidity_N_per_m;
  sheet.elastic_N_per_m = (read.rigidity_N_per_m - of_friction) / elastic.rigidity_N_per_m;
  if (!(sheet.elastic_N_per_m > 0))
    throw InputError({}, fmt::format("G = {:.4g} N/m per radian is out of range; allowed with these widths of the "
                                     "loop: > {:.4g} N/m, what friction alone gives it",
                                     read.rigidity_N_per_m, of_friction));
  return sheet;
}

}  // namespace gambeson
