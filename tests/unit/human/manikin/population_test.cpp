/// People that are drawn have the survey's statistics, and are the same whenever they are drawn.

#include "human/manikin/population.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "human/manikin/odd_measures.hpp"
#include "human/manikin/regressions.hpp"

namespace gambeson {
namespace {

struct Spread {
  double mean = 0, sd = 0;
};

Spread spreadOf(const std::vector<double>& x) {
  Spread s;
  for (const double v : x) s.mean += v / static_cast<double>(x.size());
  for (const double v : x) s.sd += (v - s.mean) * (v - s.mean) / static_cast<double>(x.size() - 1);
  s.sd = std::sqrt(s.sd);
  return s;
}

/// Mean and standard deviation of four measures, as the survey has them [m]: ANSUR II (Gordon et al. 2014,
/// NATICK/TR-15/007), from the public data.
struct Published {
  const char* name;
  std::optional<double> ManikinMeasures::*member;
  Spread male, female;
};
const std::vector<Published> kPublished{
    {"chestcircumference", &ManikinMeasures::chest_m, {1.05871, 0.08744}, {0.94686, 0.0827}},
    {"waistcircumference", &ManikinMeasures::waist_m, {0.94058, 0.11171}, {0.86091, 0.09993}},
    {"buttockcircumference", &ManikinMeasures::hip_m, {1.01952, 0.07668}, {1.02125, 0.07589}},
    {"crotchheight", &ManikinMeasures::inseam_m, {0.84593, 0.0465}, {0.78232, 0.04464}}};

class Population : public testing::TestWithParam<Sex> {};

/// 10,000 people of a sex: means within 1 %, spreads, slopes and residual errors within 5 %, whatever the seed.
TEST_P(Population, HasTheStatisticsOfTheSurvey) {
  const SurveyedPeople p = surveyedPeople(GetParam());
  for (const std::uint64_t seed : {1, 2, 3}) {
    const DrawnPeople drawn = drawPeople(GetParam(), 10000, seed);
    std::vector<double> stature, mass;
    for (const ManikinMeasures& m : drawn.people) stature.push_back(m.stature_m), mass.push_back(m.mass_kg);
    const Spread s = spreadOf(stature), w = spreadOf(mass);
    EXPECT_NEAR(s.mean, p.stature_m, 0.01 * p.stature_m);
    EXPECT_NEAR(w.mean, p.mass_kg, 0.01 * p.mass_kg);
    EXPECT_NEAR(s.sd, p.stature_sd_m, 0.05 * p.stature_sd_m);
    EXPECT_NEAR(w.sd, p.mass_sd_kg, 0.05 * p.mass_sd_kg);
    double together = 0;
    for (std::size_t i = 0; i < stature.size(); ++i)
      together += (stature[i] - s.mean) * (mass[i] - w.mean) / (s.sd * w.sd) / static_cast<double>(stature.size());
    EXPECT_NEAR(together, p.correlation, 0.05 * p.correlation);
    for (const Published& of : kPublished) {
      const auto n = static_cast<Eigen::Index>(stature.size());
      Eigen::MatrixX3d A(n, 3);
      Eigen::VectorXd y(n);
      std::vector<double> values;
      for (Eigen::Index i = 0; i < n; ++i) {
        const auto k = static_cast<std::size_t>(i);
        values.push_back(*(drawn.people[k].*of.member));
        A.row(i) << 1, 1000 * stature[k], mass[k];
        y[i] = 1000 * values.back();
      }
      const Spread& published = GetParam() == Sex::male ? of.male : of.female;
      const Spread v = spreadOf(values);
      EXPECT_NEAR(v.mean, published.mean, 0.01 * published.mean) << of.name;
      EXPECT_NEAR(v.sd, published.sd, 0.05 * published.sd) << of.name;
      const Eigen::Vector3d b = (A.transpose() * A).ldlt().solve(A.transpose() * y);
      const double error = std::sqrt((y - A * b).squaredNorm() / static_cast<double>(n - 3));
      const nlohmann::json r = regressionsFor(GetParam(), 0, 0).of.at("measures").at(of.name);
      for (const int k : {1, 2}) {
        const double slope = r.at(static_cast<std::size_t>(k));
        EXPECT_NEAR(b[k], slope, 0.05 * std::abs(slope)) << of.name << " " << k << " seed " << seed;
      }
      EXPECT_NEAR(error, r.at(3).get<double>(), 0.05 * r.at(3).get<double>()) << of.name;
    }
  }
}

/// Mass is skewed as the survey's is, which a normal distribution would not have: 1st and 99th percentile.
TEST_P(Population, HasTheTailsOfTheSurvey) {
  std::vector<double> mass, stature;
  for (const ManikinMeasures& m : drawPeople(GetParam(), 10000, 1).people)
    mass.push_back(m.mass_kg), stature.push_back(m.stature_m);
  std::sort(mass.begin(), mass.end());
  std::sort(stature.begin(), stature.end());
  const nlohmann::json of = regressionsFor(GetParam(), 0, 0).of;
  for (const auto& [part, at] : {std::pair<double, std::size_t>(0.01, 0), {0.99, 1}}) {
    const auto k = static_cast<std::size_t>(part * 10000);
    EXPECT_NEAR(mass[k], of.at("mass_kg").at(at).get<double>(), 0.02 * mass[k]);
    EXPECT_NEAR(stature[k], of.at("stature_m").at(at).get<double>(), 0.01 * stature[k]);
  }
}

TEST_P(Population, PeopleAreTheSameHoweverManyAreDrawn) {
  const std::vector<ManikinMeasures> few = drawPeople(GetParam(), 7, 5).people,
                                     many = drawPeople(GetParam(), 100, 5).people;
  ASSERT_EQ(few.size(), 7u);
  for (std::size_t k = 0; k < few.size(); ++k) {
    EXPECT_EQ(few[k].stature_m, many[k].stature_m);
    EXPECT_EQ(few[k].mass_kg, many[k].mass_kg);
    EXPECT_EQ(few[k].waist_m, many[k].waist_m);
    EXPECT_EQ(few[k].inseam_m, many[k].inseam_m);
  }
  const std::vector<ManikinMeasures> others = drawPeople(GetParam(), 7, 6).people;
  EXPECT_NE(few[0].mass_kg, others[0].mass_kg);
}

/// The first people of seed 1: the generator, the sequence and the transform are specified, so that they never change.
TEST(PopulationDraw, TheFirstPeopleAreThese) {
  const ManikinMeasures man = drawPeople(Sex::male, 1, 1).people[0], woman = drawPeople(Sex::female, 1, 1).people[0];
  EXPECT_EQ(man.stature_m, 1.778);
  EXPECT_EQ(man.mass_kg, 91.2);
  EXPECT_EQ(woman.stature_m, 1.753);
  EXPECT_EQ(woman.mass_kg, 80.8);
}

/// What is drawn is what a manikin can be made of; what is not is counted.
TEST_P(Population, NobodyContradictsHimself) {
  const DrawnPeople drawn = drawPeople(GetParam(), 30000, 1);
  for (std::size_t k = 0; k < drawn.people.size(); k += 10) ASSERT_TRUE(oddMeasures(drawn.people[k]).empty());
  EXPECT_GT(drawn.contradicting, 0);  // an inseam beyond 4 standard errors: 6 of 100,000
  EXPECT_LT(drawn.contradicting, 20);
}

INSTANTIATE_TEST_SUITE_P(BothSexes, Population, testing::Values(Sex::male, Sex::female),
                         [](const auto& sex) { return sex.param == Sex::male ? "Men" : "Women"; });

}  // namespace
}  // namespace gambeson
