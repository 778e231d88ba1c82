/// gambeson verify: a right number passes, a wrong one fails; runs that fail, and references that are malformed, say
/// so.

#include "cases/verify/verify.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cases/command/cli.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::verify {
namespace {

/// Numbers at hand in place of a run's files.
class Given : public RunNumbers {
 public:
  std::map<std::string, double> numbers;  ///< "run/path"
  std::map<std::string, Numbers> tables;  ///< "run/file"
  double summary(const std::string& run, const std::string& path) const override {
    const auto it = numbers.find(run + "/" + path);
    if (it == numbers.end()) throw RunError("there is no " + path);
    return it->second;
  }
  const Numbers& table(const std::string& run, const std::string& file) const override {
    const auto it = tables.find(run + "/" + file);
    if (it == tables.end()) throw RunError("there is no " + file);
    return it->second;
  }
};

Quantity summaryOf(const std::string& run, const std::string& path) {
  Quantity q;
  q.runs = {run};
  q.summary = path;
  return q;
}

Check valueCheck(double reference, double absolute) {
  Check c;
  c.of = summaryOf("a", "w");
  c.reference = reference;
  c.absolute = absolute;
  return c;
}

TEST(VerifyValue, PassesWithinItsToleranceOnly) {
  Given given;
  given.numbers["a/w"] = 2.5;
  EXPECT_TRUE(judge({}, valueCheck(2.49, 0.011), given).results[0].passed);
  EXPECT_FALSE(judge({}, valueCheck(2.49, 0.009), given).results[0].passed);
  Check relative = valueCheck(-2.5, 1);
  relative.absolute.reset();
  relative.relative = 0.01;
  EXPECT_FALSE(judge({}, relative, given).results[0].passed);
  EXPECT_DOUBLE_EQ(*judge({}, relative, given).results[0].tolerance, 0.025);
}

TEST(VerifyValue, WhatIsNoNumberFails) {
  Given given;
  given.numbers["a/w"] = std::nan("");
  const Result nan = judge({}, valueCheck(0, 1e300), given).results[0];
  EXPECT_FALSE(nan.passed);
  EXPECT_FALSE(nan.measured);
  Check missing = valueCheck(0, 1);
  missing.of = summaryOf("a", "v");
  const Result none = judge({}, missing, given).results[0];
  EXPECT_FALSE(none.passed);
  EXPECT_EQ(none.note, "there is no v");
  Check least = valueCheck(0, 1);
  least.reference.reset();
  least.absolute.reset();
  least.at_least = -1e300;
  EXPECT_FALSE(judge({}, least, given).results[0].passed);
}

TEST(VerifyValue, DifferencesRatiosAndBounds) {
  Given given;
  given.numbers = {{"a/w", 6}, {"a/u", 2}, {"b/w", 8}};
  Check c = valueCheck(0.5, 1e-12);
  c.minus = summaryOf("a", "u");
  c.over = summaryOf("b", "w");
  EXPECT_TRUE(judge({}, c, given).results[0].passed);  // (6 - 2)/8
  c.reference.reset();
  c.absolute.reset();
  c.at_least = 0.51;
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
  c.at_least.reset();
  c.at_most = 0.51;
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  c.at_most.reset();
  c.gated = false;
  const Result reported = judge({}, c, given).results[0];
  EXPECT_TRUE(reported.passed && !reported.gated && !reported.reference);
  EXPECT_EQ(*reported.measured, 0.5);
}

TEST(VerifyValue, SeedsBecomeOneNumber) {
  Given given;
  given.numbers = {{"a/w", 7}, {"b/w", 1}, {"c/w", 4}};
  Check c = valueCheck(4, 1e-12);
  c.of.runs = {"a", "b", "c"};
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  c.of.of = Quantity::Of::largest;
  EXPECT_DOUBLE_EQ(*judge({}, c, given).results[0].measured, 7);
  c.of.of = Quantity::Of::least;
  EXPECT_DOUBLE_EQ(*judge({}, c, given).results[0].measured, 1);
  c.of.of = Quantity::Of::mean;
  EXPECT_DOUBLE_EQ(*judge({}, c, given).results[0].measured, 4);
  given.numbers["b/w"] = std::nan("");  // not the least, nor lost in the median
  for (const auto of : {Quantity::Of::median, Quantity::Of::least, Quantity::Of::largest}) {
    c.of.of = of;
    EXPECT_FALSE(judge({}, c, given).results[0].passed);
  }
}

TEST(VerifyValue, RowsOfATable) {
  Given given;
  given.tables["a/path.csv"] = {{"factor", "w"}, {{0, 0}, {0.5, 1}, {1, 4}}};
  Check c = valueCheck(-39, 1e-9);
  c.of = {};
  c.of.runs = {"a"};
  c.of.column = "w";
  c.of.scale = -10;
  c.of.offset = 1;
  EXPECT_TRUE(judge({}, c, given).results[0].passed);  // 1 - 10 * 4
  c.of.at = 0.75;
  EXPECT_DOUBLE_EQ(*judge({}, c, given).results[0].measured, -24);  // halfway between 1 and 4
  c.of.at = 1.1;
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
  c.of.at.reset();
  c.of.column = "v";
  EXPECT_EQ(judge({}, c, given).results[0].note, "there is no column \"v\"; there are: factor or w");
}

TEST(VerifyValue, CoarseMeshesAreReported) {
  Given given;
  given.numbers = {{"a/w", 1.0}, {"coarse/w", 0.8}};
  Check c = valueCheck(1, 0.01);
  c.also = {"coarse"};
  const Judged j = judge({}, c, given);
  ASSERT_EQ(j.results.size(), 2u);
  EXPECT_TRUE(j.results[0].passed && j.results[0].gated);
  EXPECT_FALSE(j.results[1].passed || j.results[1].gated);
  ASSERT_EQ(j.convergence.size(), 2u);
  EXPECT_EQ(j.convergence[0].first, "coarse");
  EXPECT_DOUBLE_EQ(j.convergence[1].second, 1.0);
}

TEST(VerifyCurve, DistanceFromAPolyline) {
  // A corner at (1, 1): the point (2, 1) is 1 from it; with the x axis divided by 4, a quarter.
  EXPECT_DOUBLE_EQ(nearestOnPolyline({0, 1, 0}, {0, 1, 2}, 2, 1, 1, 1).distance, 1);
  EXPECT_DOUBLE_EQ(nearestOnPolyline({0, 1, 0}, {0, 1, 2}, 2, 1, 4, 1).distance, 0.25);
  // Inside a segment, by hand: (0, 1) from the line y = x is 1/sqrt 2, met at (1/2, 1/2).
  const Nearest n = nearestOnPolyline({0, 1}, {0, 1}, 0, 1, 1, 1);
  EXPECT_NEAR(n.distance, std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(n.x, 0.5, 1e-15);
  // Repeated points and the empty line.
  EXPECT_DOUBLE_EQ(nearestOnPolyline({1, 1}, {1, 1}, 1, 3, 1, 1).distance, 2);
  EXPECT_TRUE(std::isinf(nearestOnPolyline({}, {}, 0, 0, 1, 1).distance));
}

/// A path with a limit point: load sin(3 w), w from 0 to 1, of which the reference has some rows.
struct Snap {
  Given given;
  Reference reference;
  Check check;
  Snap() {
    Numbers& t = given.tables["a/path.csv"];
    t.columns = {"factor", "w_m"};
    for (int i = 0; i <= 400; ++i) t.rows.push_back({std::sin(3 * i / 400.0), i / 400.0});
    reference.table.columns = {"P", "-W"};
    for (const double w : {0.2, 0.5, 0.8, 1.0}) reference.table.rows.push_back({std::sin(3 * w), -100 * w});
    check.kind = Check::Kind::curve;
    check.quantity = "snap";
    check.run = "a";
    check.x = {"w_m", "-W", -100, 0};
    check.y = {"factor", "P", 1, 0};
    check.bound = 1e-4;
  }
};

TEST(VerifyCurve, FollowsAPathThroughALimitPoint) {
  Snap s;
  const Judged j = judge(s.reference, s.check, s.given);
  EXPECT_TRUE(j.results[0].passed) << *j.results[0].measured;
  EXPECT_LT(*j.results[0].measured, 2e-5);  // the chords' error, (3/400)^2/8
  ASSERT_TRUE(j.shown);
  EXPECT_EQ(j.shown->rows.size(), 4u);
}

TEST(VerifyCurve, OneWrongRowFails) {
  Snap s;
  s.reference.table.rows[2][1] *= 1.02;
  const Judged j = judge(s.reference, s.check, s.given);
  EXPECT_FALSE(j.results[0].passed);
  EXPECT_NEAR(j.shown->rows[2].deviation, *j.results[0].measured, 1e-15);
  // Reported instead of gated: the others still are.
  s.check.reported = {"-W", -85, -75};
  const Judged reported = judge(s.reference, s.check, s.given);
  EXPECT_TRUE(reported.results[0].passed);
  ASSERT_EQ(reported.results.size(), 2u);
  EXPECT_FALSE(reported.results[1].gated);
  EXPECT_FALSE(reported.results[1].passed);
  s.reference.table.rows[1][0] += 0.1;
  EXPECT_FALSE(judge(s.reference, s.check, s.given).results[0].passed);
}

TEST(VerifyCurve, APathThatEndsEarlyFails) {
  Snap s;
  s.given.tables["a/path.csv"].rows.resize(300);
  EXPECT_FALSE(judge(s.reference, s.check, s.given).results[0].passed);
  s.given.tables["a/path.csv"].rows.clear();
  EXPECT_FALSE(judge(s.reference, s.check, s.given).results[0].passed);
}

TEST(VerifyCurve, ANumberThatIsNotFiniteFails) {
  Snap s;
  s.given.tables["a/path.csv"].rows[3][1] = std::nan("");
  EXPECT_FALSE(judge(s.reference, s.check, s.given).results[0].passed);
}

TEST(VerifyTable, RowsAreHitOrInterpolated) {
  Given given;
  given.tables["a/path.csv"] = {{"factor", "w"}, {{0, 0}, {0.5, 1}, {1, 4}}};
  Reference r;
  r.table = {{"P", "W"}, {{0.5, 1.02}, {1, 4}}};
  Check c;
  c.kind = Check::Kind::table;
  c.run = "a";
  c.x = {"factor", "P", 1, 0};
  c.y = {"w", "W", 1, 0};
  c.bound = 0.0051;  // 0.02/4
  EXPECT_TRUE(judge(r, c, given).results[0].passed);
  c.bound = 0.0049;
  EXPECT_FALSE(judge(r, c, given).results[0].passed);
  r.table.rows.push_back({0.75, 2.5});
  const Result missed = judge(r, c, given).results[0];
  EXPECT_FALSE(missed.passed);
  EXPECT_NE(missed.note.find("no row at 0.75"), std::string::npos);
  c.bound = 0.0051;
  c.interpolated = true;
  EXPECT_TRUE(judge(r, c, given).results[0].passed);
}

TEST(VerifyRate, OrderFromEnergiesAndFromDifferences) {
  // Energy 2 - 3 h^4: the error in the energy norm falls with h^2.
  Given given;
  Check c;
  c.kind = Check::Kind::rate;
  c.of.summary = "e";
  c.runs = {"a", "b", "c"};
  c.sizes = {0.4, 0.2, 0.1};
  for (std::size_t i = 0; i < 3; ++i) given.numbers[c.runs[i] + "/e"] = 2 - 3 * std::pow(c.sizes[i], 4);
  c.exact = 2;
  c.power = 0.5;
  c.reference = 2;
  c.absolute = 1e-9;
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  c.exact.reset();
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  given.numbers["c/e"] = 2 - 3 * std::pow(0.1, 3.5);
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
  c.exact = 2;
  given.numbers["c/e"] = 2;  // no error, no rate
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
}

TEST(VerifyWaves, CrestsByProminence) {
  // Prominences by hand: 3 at index 1 (saddle 1 towards the 4, end 0), 4 at 3 is the highest (ends 0 and 0), 2.2 at 5
  // rises 0.2 above its saddle 2.
  const std::vector<double> y{0, 3, 1, 4, 2, 2.2, 0};
  EXPECT_EQ(crests(y, 0.1, false), (std::vector<std::size_t>{1, 3, 5}));
  EXPECT_EQ(crests(y, 0.5, false), (std::vector<std::size_t>{1, 3}));
  EXPECT_EQ(crests(y, 2.5, false), (std::vector<std::size_t>{3}));
  std::vector<double> seven;
  for (int i = 0; i < 100; ++i) seven.push_back(1 + 0.2 * std::cos(2 * std::numbers::pi * 7 * i / 100.0));
  EXPECT_EQ(crests(seven, 0.04, true).size(), 7u);
  EXPECT_TRUE(crests({1, 1, 1, 1}, 0.1, true).empty());
}

TEST(VerifyWaves, StraightWrinkles) {
  // Crests at 47 degrees, 25 mm apart, on a sheet of 0.38 x 0.128 m.
  std::vector<double> x, y, w;
  const double n = (47 + 90) * std::numbers::pi / 180;
  for (int j = 0; j <= 60; ++j)
    for (int i = 0; i <= 180; ++i) {
      x.push_back(0.38 * i / 180), y.push_back(0.128 * j / 60);
      w.push_back(1e-3 * std::sin(2 * std::numbers::pi / 0.025 * (std::cos(n) * x.back() + std::sin(n) * y.back())));
    }
  const Wrinkles found = wrinklesOf(x, y, w, 0.15, 0.1);
  EXPECT_NEAR(found.angle_deg, 47, 1);
  EXPECT_NEAR(found.wavelength, 0.025, 0.0005);
  w.pop_back(), x.pop_back(), y.pop_back();
  EXPECT_THROW(wrinklesOf(x, y, w, 0.15, 0.1), RunError);  // no grid any more
}

TEST(VerifyWaves, MeanDistance) {
  Given given;
  Numbers& t = given.tables["a/line.csv"];
  t.columns = {"s", "w"};
  for (int i = 0; i <= 1000; ++i)
    t.rows.push_back({i * 1e-4, std::sin(2 * std::numbers::pi * i * 1e-4 / 0.025) + 0.02 * std::cos(7.0 * i)});
  Check c;
  c.kind = Check::Kind::waves;
  c.run = "a";
  c.file = "line.csv";
  c.x = {"s", "", 1000, 0};
  c.y = {"w", "", 1, 0};
  c.prominence = 0.5;
  c.reference = 25;
  c.relative = 0.02;
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  c.reference = 24;
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
}

TEST(VerifyWaves, FoldsOfAHem) {
  // Rows of two circles; the outer one, u = 1, has 5 folds, the inner one 3.
  Given given;
  Numbers& t = given.tables["a/shape.csv"];
  t.columns = {"u", "v", "x", "y"};
  for (const double u : {0.0, 1.0})
    for (int i = 0; i < 200; ++i) {
      const double angle = 2 * std::numbers::pi * i / 200;
      const double radius = 1 + 0.1 * std::cos((u > 0 ? 5 : 3) * angle);
      t.rows.push_back({u, i / 200.0, radius * std::cos(angle), radius * std::sin(angle)});
    }
  Check c;
  c.kind = Check::Kind::waves;
  c.run = "a";
  c.file = "shape.csv";
  c.x.column = "v";
  c.y.column = "x";
  c.with.emplace().column = "y";
  c.where = {"u", 1, 1};
  c.closed = true;
  c.reference = 5;
  c.absolute = 0.1;
  EXPECT_TRUE(judge({}, c, given).results[0].passed);
  c.where = {"u", 0, 0};
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
  // Medians against each other. b has the circles in turn: 5 folds at u = 0.
  given.tables["b/shape.csv"] = t;
  for (std::vector<double>& row : given.tables["b/shape.csv"].rows) row[0] = 1 - row[0];
  c.run.clear();
  c.reference.reset();
  c.runs = {"a", "b", "a"};
  c.reference_runs = {"a"};
  EXPECT_TRUE(judge({}, c, given).results[0].passed);  // 3, 5, 3 against 3
  c.reference_runs = {"b"};
  EXPECT_FALSE(judge({}, c, given).results[0].passed);
  c.reference_runs = {"c"};
  EXPECT_FALSE(judge({}, c, given).results[0].passed);  // there is no such run
}

TEST(VerifyCsv, AsRunsWriteThem) {
  const Numbers t = parseCsv("factor,\"a, \"\"b\"\"\"\r\n0,1e-3\n\n1,abc\n", "t.csv");
  EXPECT_EQ(t.columns, (std::vector<std::string>{"factor", "a, \"b\""}));
  ASSERT_EQ(t.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(t.rows[0][1], 1e-3);
  EXPECT_TRUE(std::isnan(t.rows[1][1]));
  EXPECT_THROW(parseCsv("a,b\n1\n", "t.csv"), RunError);
  EXPECT_THROW(parseCsv("", "t.csv"), RunError);
}

}  // namespace
}  // namespace gambeson::verify
