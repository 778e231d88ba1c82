#include "human/manikin/regressions.hpp"

#include <algorithm>
#include <numbers>

#include "human/files/data.hpp"

namespace gambeson {

double Regressions::m(const char* name) const {
  const nlohmann::json& r = of.at("measures").at(name);
  return 1e-3 * (r.at(0).get<double>() + r.at(1).get<double>() * stature_mm + r.at(2).get<double>() * mass_kg);
}

double Regressions::error_m(const char* name) const { return 1e-3 * of.at("measures").at(name).at(3).get<double>(); }

double Regressions::radius(const char* girth) const { return m(girth) / (2 * std::numbers::pi); }

Regressions regressionsFor(Sex sex, double stature_m, double mass_kg) {
  static const nlohmann::json all = nlohmann::json::parse(data::regressions);
  return {all.at(sex == Sex::female ? "female" : "male"), 1000 * stature_m, mass_kg};
}

double meanMeasure(const char* name, double stature_m, double mass_kg) {
  double sum = 0;
  for (const Sex sex : {Sex::male, Sex::female}) {
    const Regressions range = regressionsFor(sex, 0, 0);
    const double known = std::clamp(stature_m, range.of.at("stature_m").at(0).get<double>(),
                                    range.of.at("stature_m").at(1).get<double>()),
                 scale = stature_m / known;
    const double mass = std::clamp(mass_kg / (scale * scale * scale), range.of.at("mass_kg").at(0).get<double>(),
                                   range.of.at("mass_kg").at(1).get<double>());
    sum += 0.5 * scale * regressionsFor(sex, known, mass).m(name);
  }
  return sum;
}

}  // namespace gambeson
