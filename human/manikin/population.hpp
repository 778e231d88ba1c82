#pragma once
/// Wearers drawn from the people of a survey.

#include <cstdint>
#include <vector>

#include "human/manikin/measures.hpp"

namespace gambeson {

/// Stature and mass of one sex of ANSUR II (human/data/regressions.json, key people).
struct SurveyedPeople {
  double stature_m = 0, stature_sd_m = 0;
  double mass_kg = 0, mass_sd_kg = 0;
  double correlation = 0;  ///< of stature and mass
};
SurveyedPeople surveyedPeople(Sex sex);

struct DrawnPeople {
  std::vector<ManikinMeasures> people;  ///< each with chest, waist, hip and inseam
  int contradicting = 0;                ///< draws that no body has (odd_measures.hpp), taken again
};

/// People of one sex, the k-th the same however many are drawn.
///
/// Stature and mass are lognormal together (Silverman and Lipscombe, Open Journal of Statistics 12 (2022) 324, who try
/// it on a large survey):
///   ln S = m_S + s_S z1,  ln M = m_M + s_M (r z1 + sqrt(1 - r^2) z2),  z standard normal,
///   s_X^2 = ln(1 + (sd_X / mean_X)^2),  m_X = ln mean_X - s_X^2 / 2,
///   r = ln(1 + c sd_S sd_M / (mean_S mean_M)) / (s_S s_M),  c the correlation of S and M,
/// which gives means, standard deviations and c of the survey exactly, and its 1st, 5th, 50th, 95th and 99th percentile
/// within 1.6 % (mass) and 0.5 % (stature). Girths of chest, waist and hip (buttock) and the inseam (crotch height) are
///   y = b0 + b1 S + b2 M + e z,
/// regression and standard error of the residuals as in `Regressions`.
///
/// Left out, since the data have regressions and no covariances: that residuals go together (who has a wide waist for
/// stature and mass also has a wide chest), and that they grow with mass. Measures are rounded as a tape and scales
/// have them, to 1 mm and 0.1 kg.
///
/// The z are a Sobol sequence in six dimensions (boost::random::sobol), shifted digit by digit at random by `seed`
/// (L'Ecuyer and Lemieux 2002), through the inverse of the normal distribution: each is a fair draw, and together they
/// lie more evenly than independent ones would, so that few wearers stand for the population better.
DrawnPeople drawPeople(Sex sex, int count, std::uint64_t seed);

}  // namespace gambeson
