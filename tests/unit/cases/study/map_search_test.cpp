/// The search for a thickness map, on torques that are formulas.

#include "cases/study/map_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gambeson::study {
namespace {

/// Bending goes with the cube: torque sum(a x^3). At a given mass the least has 3 a_i x_i^2 = lambda m_i (Lagrange), so
/// x_i = r sqrt(m_i / a_i).
const std::vector<double> a{8, 2, 1}, m{0.3, 0.5, 0.4};

double cubic(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += a[i] * x[i] * x[i] * x[i];
  return sum;
}

MapProblem atGivenMass() {
  MapProblem p;
  p.start = {1, 1, 1};
  p.mass_kg = m;
  p.least = 0.25;
  p.most = 2;
  p.step = 0.3;
  p.runs = 60;
  return p;
}

TEST(MapSearch, FindsTheMapOfLeastTorqueAtAGivenMass) {
  const MapProblem p = atGivenMass();
  const auto tried = searchMap(p, cubic);
  double r = 0, sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += m[i] * std::sqrt(m[i] / a[i]);
  r = p.massOf(p.start) / sum;
  std::vector<double> exact;
  for (std::size_t i = 0; i < 3; ++i) exact.push_back(r * std::sqrt(m[i] / a[i]));
  const TriedMap& best = tried[bestOf(p, tried)];
  EXPECT_LT(best.torque_Nm, 1.005 * cubic(exact));  // the start has 1.9 times as much
  EXPECT_GT(cubic(p.start), 1.8 * cubic(exact));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(best.map[i], exact[i], 0.06) << i;
  EXPECT_EQ(tried[0].map, p.start);
  for (const TriedMap& t : tried) {
    EXPECT_NEAR(p.massOf(t.map), p.massOf(p.start), 2e-6);  // factors are rounded to millionths
    for (const double x : t.map) EXPECT_TRUE(x >= p.least && x <= p.most) << x;
  }
}

/// What bounds leave: the region that costs most goes to its least.
TEST(MapSearch, KeepsToBounds) {
  MapProblem p = atGivenMass();
  p.least = 0.8;
  p.most = 1.2;
  const auto tried = searchMap(p, cubic);
  const TriedMap& best = tried[bestOf(p, tried)];
  EXPECT_NEAR(best.map[0], 0.8, 0.02);
  for (const TriedMap& t : tried)
    for (const double x : t.map) EXPECT_TRUE(x >= 0.8 && x <= 1.2) << x;
}

TEST(MapSearch, FindsTheLightestMapBelowATorque) {
  // Thicker cloth of the first region takes torque away: 6 - 3 x0 + x1 <= 4. At x1 = 0.5 that is x0 >= 0.833333.
  MapProblem p;
  p.aim = Aim::mass;
  p.start = {1.2, 1};
  p.mass_kg = {0.4, 0.3};
  p.least = 0.5;
  p.most = 1.5;
  p.limit_Nm = 4;
  p.runs = 60;
  const auto tried = searchMap(p, [](const std::vector<double>& x) { return 6 - 3 * x[0] + x[1]; });
  const TriedMap& best = tried[bestOf(p, tried)];
  EXPECT_LE(best.torque_Nm, p.limit_Nm);
  EXPECT_NEAR(best.map[0], 0.8333, 0.02);
  EXPECT_NEAR(best.map[1], 0.5, 0.02);
}

/// Nothing below the limit: the least torque, and not the least mass.
TEST(MapSearch, WithoutAMapBelowTheLimitTakesTheLowest) {
  MapProblem p;
  p.aim = Aim::mass;
  p.mass_kg = {1};
  p.limit_Nm = 1;
  EXPECT_EQ(bestOf(p, {{{1}, 4}, {{0.5}, 5}, {{1.2}, 3}}), 2u);
  EXPECT_EQ(bestOf(p, {{{1}, 0.9}, {{0.5}, 5}, {{1.2}, 0.5}, {{0.9}, 1}}), 3u);
}

/// A search that was stopped and answers again what it answered before goes on to the same map.
TEST(MapSearch, AsksTheSameAgain) {
  const MapProblem p = atGivenMass();
  const auto whole = searchMap(p, cubic);
  std::size_t answers = 0;
  EXPECT_THROW(searchMap(p,
                         [&](const std::vector<double>& x) {
                           if (++answers == 7) throw std::runtime_error("stopped");
                           return cubic(x);
                         }),
               std::runtime_error);
  EXPECT_EQ(answers, 7u);
  const auto again = searchMap(p, cubic);
  ASSERT_EQ(again.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_EQ(again[i].map, whole[i].map) << i;
}

TEST(MapSearch, TriesNoMoreThanItMayAndNoMapTwice) {
  MapProblem p = atGivenMass();
  p.runs = 5;
  const auto tried = searchMap(p, cubic);
  EXPECT_EQ(tried.size(), 5u);
  for (std::size_t i = 0; i < tried.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_NE(tried[i].map, tried[k].map);
}

TEST(MapSearch, MovesAllWhereTheHeaviestCannotTakeTheRest) {
  const MapProblem p = atGivenMass();
  const double kg = p.massOf(p.start);
  const std::vector<double> wanted{2, 1, 2};  // leaves less than nothing for the heaviest, the second
  const std::vector<double> map = mapOfMass(p, wanted, kg);
  EXPECT_NEAR(p.massOf(map), kg, 1e-12);
  for (const double x : map) EXPECT_TRUE(x >= p.least && x <= p.most) << x;
  EXPECT_DOUBLE_EQ(map[1], p.least);
  EXPECT_DOUBLE_EQ(map[0], map[2]);
}

}  // namespace
}  // namespace gambeson::study
