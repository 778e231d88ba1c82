#include "human/manikin/population.hpp"

#include <array>
#include <boost/math/special_functions/erf.hpp>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "human/manikin/odd_measures.hpp"
#include "human/manikin/regressions.hpp"

namespace gambeson {
namespace {

constexpr std::size_t kDimensions = 6;  ///< stature, mass, chest, waist, hip, inseam

/// Standard normal numbers, six by six.
class Normals {
 public:
  Normals(Sex sex, std::uint64_t seed) : sequence_(kDimensions) {
    std::mt19937_64 random(seed);
    // Men take the first numbers of the generator, women the next.
    if (sex == Sex::female) random.discard(kDimensions);
    for (std::uint64_t& s : shift_) s = random();
  }
  std::array<double, kDimensions> next() {
    std::array<double, kDimensions> z{};
    for (std::size_t d = 0; d < kDimensions; ++d) {
      const std::uint64_t digits = sequence_() ^ shift_[d];
      const double u = (static_cast<double>(digits >> 11) + 0.5) * 0x1p-53;  // within (0, 1)
      z[d] = -std::numbers::sqrt2 * boost::math::erfc_inv(2 * u);
    }
    return z;
  }

 private:
  boost::random::sobol sequence_;
  std::array<std::uint64_t, kDimensions> shift_{};
};

double rounded(double value, double per) { return std::round(value * per) / per; }

}  // namespace

SurveyedPeople surveyedPeople(Sex sex) {
  const nlohmann::json p = regressionsFor(sex, 0, 0).of.at("people");
  return {p.at("stature_m").at(0), p.at("stature_m").at(1), p.at("mass_kg").at(0), p.at("mass_kg").at(1),
          p.at("correlation")};
}

DrawnPeople drawPeople(Sex sex, int count, std::uint64_t seed) {
  const SurveyedPeople p = surveyedPeople(sex);
  const double cv_s = p.stature_sd_m / p.stature_m, cv_m = p.mass_sd_kg / p.mass_kg;
  const double s_s = std::sqrt(std::log1p(cv_s * cv_s)), s_m = std::sqrt(std::log1p(cv_m * cv_m));
  const double r = std::log1p(p.correlation * cv_s * cv_m) / (s_s * s_m);
  const double m_s = std::log(p.stature_m) - 0.5 * s_s * s_s, m_m = std::log(p.mass_kg) - 0.5 * s_m * s_m;
  Normals normals(sex, seed);
  Regressions of = regressionsFor(sex, 0, 0);
  DrawnPeople drawn;
  while (static_cast<int>(drawn.people.size()) < count) {
    const auto [z1, z2, chest, waist, hip, inseam] = normals.next();
    ManikinMeasures m;
    m.sex = sex;
    m.stature_m = rounded(std::exp(m_s + s_s * z1), 1000);
    m.mass_kg = rounded(std::exp(m_m + s_m * (r * z1 + std::sqrt(1 - r * r) * z2)), 10);
    of.stature_mm = 1000 * m.stature_m;
    of.mass_kg = m.mass_kg;
    const auto measure = [&](const char* name, double z) { return rounded(of.m(name) + z * of.error_m(name), 1000); };
    m.chest_m = measure("chestcircumference", chest);
    m.waist_m = measure("waistcircumference", waist);
    m.hip_m = measure("buttockcircumference", hip);
    m.inseam_m = measure("crotchheight", inseam);
    if (oddMeasures(m).empty())
      drawn.people.push_back(m);
    else
      ++drawn.contradicting;
  }
  return drawn;
}

}  // namespace gambeson
