#pragma once
/// A manikin by a person's measures, through regressions on stature and mass (human/data/regressions.json).

#include <optional>
#include <string>
#include <vector>

#include "human/body/body.hpp"

namespace gambeson {

enum class Sex { male, female };

/// Girths are by the tape around trunk and, at the hips, the tops of the thighs; arms are left out. What is absent
/// follows from stature and mass: sections then have the breadth and depth of the data, as in the six manikins.
struct ManikinMeasures {
  Sex sex = Sex::male;
  double stature_m = 0, mass_kg = 0;
  std::optional<double> chest_m, waist_m, hip_m;  ///< girths
  std::optional<double> inseam_m;                 ///< height of the crotch
};

/// A girth that was asked for, and what the made body has.
struct MadeGirth {
  std::string name;
  double asked_m = 0, made_m = 0;
};

struct MeasuresReport {
  std::vector<MadeGirth> girths;   ///< those asked for
  std::vector<std::string> notes;  ///< what a user should know
};

/// The manikin. Its heights follow from the regressions; an inseam that differs from theirs stretches what lies between
/// ankle and crotch and shrinks what lies between crotch and the seventh neck vertebra in proportion. A girth grows
/// both semi-axes of its ellipsoid alike, the chest's lateral one up to where the arms hang; how near the made body
/// comes is measured on its sections. The range of validity is that of the people measured (1st to 99th percentile of
/// stature and mass); beyond it a note tells that the regressions are extrapolated. Throws InputError with the key of
/// the measure where measures contradict each other: body-mass index outside 14 to 50 kg/m², a girth or an inseam
/// further from the regression than 6 (inseam: 4) standard errors.
Human makeManikin(const ManikinMeasures& measures, MeasuresReport* report = nullptr);

/// Girth by the tape [m] of links' shapes where a horizontal plane cuts them, in the standing posture for feet at 0.
double girthAt(const Human& human, double height_m, const std::vector<std::string>& links);

}  // namespace gambeson
