#pragma once
/// Body measures that follow from stature and mass.

#include <nlohmann/json.hpp>
#include <string>

#include "human/manikin/measures.hpp"

namespace gambeson {

/// y [mm] = b0 + b1 stature [mm] + b2 mass [kg], with the standard error of the residuals: least squares over the 4082
/// men or 1986 women of ANSUR II (human/data/regressions.json). Valid from the 1st to the 99th percentile of stature
/// and mass; beyond it extrapolated. Names of measures are those of the survey ("crotchheight").
struct Regressions {
  nlohmann::json of;  ///< one sex
  double stature_mm, mass_kg;

  double m(const char* name) const;
  double error_m(const char* name) const;
  double radius(const char* girth) const;  ///< of a circle with that girth
};

Regressions regressionsFor(Sex sex, double stature_m, double mass_kg);

/// The mean of both sexes' regressions, for a person of unknown sex. Statures that nobody of the survey has take the
/// measure of the nearest stature with the same build (mass over stature cubed), scaled: a statuette has a person's
/// proportions.
double meanMeasure(const char* name, double stature_m, double mass_kg);

}  // namespace gambeson
