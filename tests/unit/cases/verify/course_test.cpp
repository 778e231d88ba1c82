/// Checks of courses in time, claims of a list, and runs that are kept.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "cases/verify/verify.hpp"
#include "cases/wear/case/case.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::verify {
namespace {

class Tables : public RunNumbers {
 public:
  std::map<std::string, Numbers> tables;  ///< "run/file"
  double summary(const std::string&, const std::string& path) const override {
    if (path == "peak") return 0.95;
    if (path == "top") return 0.02;
    throw RunError("there is no " + path);
  }
  const Numbers& table(const std::string& run, const std::string& file) const override {
    const auto it = tables.find(run + "/" + file);
    if (it == tables.end()) throw RunError("there is no " + file);
    return it->second;
  }
};

/// Two legs half a stride of 1 s apart; the run "thin" has a third of it.
Tables legs() {
  Tables t;
  for (const auto& [run, size] : {std::pair{"thick", 3.0}, std::pair{"thin", -1.0}}) {
    Numbers& n = t.tables[std::string(run) + "/torques.csv"];
    n.columns = {"time_s", "right", "left", "belt"};
    for (int i = 0; i <= 200; ++i) {
      const double a = 2 * std::numbers::pi * 0.01 * i;
      n.rows.push_back({0.01 * i, size * std::cos(a), -size * std::cos(a), 0.5});
    }
  }
  return t;
}

RunCourse course(const std::string& run, std::vector<std::string> columns) {
  RunCourse h;
  h.run = run;
  h.columns = std::move(columns);
  return h;
}

Check check(Check::Course what, RunCourse first, std::optional<RunCourse> second = {}) {
  Check c;
  c.kind = Check::Kind::course;
  c.course = what;
  c.first = std::move(first);
  c.second = std::move(second);
  c.to_s = 2;
  c.gated = false;
  return c;
}

double measured(const Check& c) { return judge({}, c, legs()).results.at(0).measured.value(); }

TEST(VerifyCourse, EachCourse) {
  using C = Check::Course;
  const RunCourse right = course("thick", {"right"}), left = course("thick", {"left"}),
                  thin = course("thin", {"right"});
  Check c = check(C::correlation, right, left);
  EXPECT_NEAR(measured(c), -1, 1e-9);
  c.shift_s = 0.5;
  EXPECT_NEAR(measured(c), 1, 1e-9);
  EXPECT_NEAR(measured(check(C::peak, right)), 3, 1e-12);
  EXPECT_NEAR(measured(check(C::peak_ratio, thin, right)), 1.0 / 3, 1e-12);
  EXPECT_NEAR(measured(check(C::mean, course("thick", {"right", "belt", "left"}))), 0.5, 1e-12);
  EXPECT_NEAR(measured(check(C::mean_ratio, course("thick", {"belt"}), course("thin", {"belt"}))), 1, 1e-12);
  EXPECT_NEAR(measured(check(C::other_at_peak, right, course("thick", {"belt"}))), 0.5 / 3, 1e-12);
  EXPECT_NEAR(measured(check(C::last_ratio, right, thin)), 3, 1e-12);
  EXPECT_NEAR(measured(check(C::greater_share, right, left)), 0.5, 0.02);
  // cos over a quarter of a turn and line: R^2 = 24 (4 - pi)^2 / (pi^2 (pi^2 - 8)).
  Check line = check(C::linearity, right);
  line.to_s = 0.25;
  const double pi2 = std::numbers::pi * std::numbers::pi;
  EXPECT_NEAR(measured(line), 24 * std::pow(4 - std::numbers::pi, 2) / (pi2 * (pi2 - 8)), 5e-3);
  // |right| falls below 3/2 at 1/6 s and |left|, from 0.5 s on, at 2/3 s.
  Check half = check(C::half_time, right, left);
  half.first->to_s = 0.25, half.second->from_s = 0.5, half.second->to_s = 0.75;
  EXPECT_NEAR(measured(half), -0.5, 1e-9);
  Check quarter = check(C::rank, right);
  quarter.to_s = 0.5;
  EXPECT_NEAR(measured(quarter), -1, 1e-12);
  quarter.course = C::growth;
  quarter.to_s = 0.25;
  EXPECT_NEAR(measured(quarter), 0, 1e-12);
  // RMS of 3 cos - (-cos) over 3.
  Check difference = check(C::difference, right, thin);
  difference.from_s = 0.01;
  EXPECT_NEAR(measured(difference), 4.0 / 3 * std::sqrt(0.5), 1e-3);
  // The peak of |right| at 0, of left at 0.5.
  Check when = check(C::peak_time, right, left);
  when.to_s = 0.9;
  EXPECT_NEAR(measured(when), -0.5, 1e-12);
  Check largest = check(C::mean, course("thick", {"right", "left"}));
  largest.first->of = RunCourse::Of::largest;
  largest.first->scale = 2;
  EXPECT_NEAR(measured(largest), 6 * 2 / std::numbers::pi, 0.02);
  // |(3 cos, -3 cos)| is 3 sqrt(2) |cos|, and above |cos| whatever the signs.
  Check magnitude = check(C::mean, course("thick", {"right", "left"}));
  magnitude.first->of = RunCourse::Of::magnitude;
  EXPECT_NEAR(measured(magnitude), 6 * std::sqrt(2.0) / std::numbers::pi, 0.02);
  Check greater = check(C::greater_share, right, thin);
  EXPECT_NEAR(measured(greater), 0.5, 0.02);
  greater.first->of = greater.second->of = RunCourse::Of::magnitude;
  EXPECT_NEAR(measured(greater), 1, 0.02);
}

TEST(VerifyCourse, CoursesMayHaveTimesOfTheirOwn) {
  Check c = check(Check::Course::peak_ratio, course("thick", {"right"}), course("thick", {"right"}));
  c.first->from_s = 0.25, c.first->to_s = 0.25 + 1.0 / 12;  // up to |cos| = 1/2
  EXPECT_NEAR(measured(c), std::sin(2 * std::numbers::pi * 0.08), 1e-9);
}

TEST(VerifyCourse, WhatIsNotThereFailsWithItsReason) {
  const auto note = [](const Check& c) { return judge({}, c, legs()).results.at(0).note; };
  EXPECT_NE(note(check(Check::Course::peak, course("thick", {"knee"}))).find("\"knee\""), std::string::npos);
  EXPECT_EQ(note(check(Check::Course::peak, course("other", {"right"}))), "there is no torques.csv");
  Check late = check(Check::Course::peak, course("thick", {"right"}));
  late.from_s = 5, late.to_s = 6;
  EXPECT_NE(note(late).find("between 5 and 6 s"), std::string::npos);
  Tables t = legs();
  t.tables["thick/torques.csv"].rows[7][1] = std::nan("");
  EXPECT_FALSE(judge({}, check(Check::Course::peak, course("thick", {"right"})), t).results.at(0).measured);
}

TEST(VerifyCourse, OnlyWhatMustHoldIsGated) {
  Check c = check(Check::Course::peak, course("thick", {"right"}));
  c.gated = true;
  c.at_most = 2;
  c.item = "Z6.4-g";
  for (const auto& [priority, gated] : {std::pair{Check::Priority::must, true},
                                        {Check::Priority::should, false},
                                        {Check::Priority::nice, false},
                                        {Check::Priority::none, true}}) {
    c.priority = priority;
    const Result r = judge({}, c, legs()).results.at(0);
    EXPECT_FALSE(r.passed);
    EXPECT_EQ(r.gated, gated);
    EXPECT_EQ(r.item, "Z6.4-g");
  }
}

TEST(VerifyValue, PhasesDifferByTheNearestWholePeriod) {
  Check c;
  c.of.runs = {"a"};
  c.of.summary = "peak";
  c.minus = c.of;
  c.minus->summary = "top";
  c.reference = 0;
  c.absolute = 0.1;
  EXPECT_FALSE(judge({}, c, legs()).results.at(0).passed);
  c.period = 1;
  const Result r = judge({}, c, legs()).results.at(0);
  EXPECT_TRUE(r.passed);
  EXPECT_NEAR(*r.measured, -0.07, 1e-12);
}

// ---- runs that are kept

const std::string library = GAMBESON_SOURCE_DIR "/cases/library/";

Reference flagReference() {
  Reference r;
  r.id = "flags";
  r.case_file = library + "flag.json";
  r.runs.resize(2);
  r.runs[0].name = "calm";
  r.runs[0].changes = {{"time.duration", "\"1 s\""}};
  r.runs[1].name = "as it is";
  return r;
}

TEST(VerifyKept, ACaseIsKnownByItsValues) {
  const Reference r = flagReference();
  const auto calm = caseHash(r, r.runs[0]), plain = caseHash(r, r.runs[1]);
  ASSERT_TRUE(calm && plain);
  EXPECT_NE(*calm, *plain);
  EXPECT_EQ(*plain, caseIdentity(readCase(library + "flag.json")));
  Reference broken = r;
  broken.runs[0].changes = {{"time.duratio", "1"}};
  EXPECT_FALSE(caseHash(broken, broken.runs[0]));
}

TEST(VerifyKept, OnlyRunsThatCameToTheirEndCount) {
  Folder folder;
  std::filesystem::create_directories(folder.path() / "run");
  const auto write = [&](const std::string& hash, double to) {
    folder.write("run/summary.json",
                 nlohmann::json{
                     {"case_hash", hash}, {"recorded_to_s", to}, {"planned_to_s", 2.7}, {"timings", {{"wall_s", 12.5}}}}
                     .dump());
  };
  const auto run = folder.path() / "run";
  EXPECT_FALSE(completeRun(run, "abc"));
  write("abc", 2.7);
  EXPECT_EQ(completeRun(run, "abc"), 12.5);
  EXPECT_FALSE(completeRun(run, "abd"));
  write("abc", 2.6);
  EXPECT_FALSE(completeRun(run, "abc"));
  folder.write("run/summary.json", "{");
  EXPECT_FALSE(completeRun(run, "abc"));
  EXPECT_FALSE(interruptedRun(run, "abc"));  // there is no recording
}

TEST(VerifyKept, CompleteRunsAreNotRepeated) {
  Folder folder;
  for (const char* name : {"references", "kept/calm"}) std::filesystem::create_directories(folder.path() / name);
  const std::string text = R"({"id": "flags", "title": "t", "source": "s", "doc": "d", "on_demand": true, "case": ")" +
                           library + R"(flag.json", "runs": [{"name": "calm"}], "checks": [{"kind": "value",
    "quantity": "q", "item": "Z1", "priority": "must", "of": {"run": "calm", "summary": "x"}, "reference": 3, "absolute": 0.1}]})";
  folder.write("references/flags.json", text);
  folder.write("kept/calm/summary.json", nlohmann::json{{"case_hash", caseIdentity(readCase(library + "flag.json"))},
                                                        {"recorded_to_s", 1},
                                                        {"planned_to_s", 1},
                                                        {"timings", {{"wall_s", 12.5}}},
                                                        {"x", 3.05}}
                                             .dump());
  Options o;
  o.dir = folder.path() / "references";
  o.out = folder.path() / "out";
  o.binary = "/no/such/program";
  o.jobs = 1;
  std::ostringstream out;
  EXPECT_THROW(chooseReferences(o), InputError);  // on demand: nobody asked for it
  o.filters = {"flags"};
  EXPECT_EQ(runVerify(o, out), 1);  // it cannot be run
  o.results = folder.path() / "kept";
  EXPECT_EQ(runVerify(o, out), 0) << out.str();
  std::ifstream stream(o.out / "verify.json");
  const auto j = nlohmann::json::parse(stream);
  EXPECT_EQ(j.at(0).at("item"), "Z1");
  EXPECT_EQ(j.at(0).at("priority"), "must");
  EXPECT_DOUBLE_EQ(j.at(0).at("seconds").get<double>(), 12.5);
  EXPECT_NE(out.str().find("Z1"), std::string::npos);
}

TEST(VerifyCourse, MalformedOnesAreBadInput) {
  Folder folder;
  const std::string good = R"({"id": "h", "title": "t", "source": "s", "doc": "d", "case": ")" + library +
                           R"(flag.json", "runs": [{"name": "a"}], "checks": [{"kind": "history", "quantity": "q",
    "item": "Z1", "priority": "must", "course": "peak_ratio", "from": "0 s", "to": "1 s",
    "first": {"run": "a", "columns": ["x"]}, "second": {"run": "a", "columns": ["y"]}, "at_most": 1}]})";
  const auto read = [&](const std::string& text) { return readReference(folder.write("h.json", text)); };
  EXPECT_NO_THROW(read(good));
  struct Wrong {
    std::string from, to, says;
  };
  for (const Wrong& w :
       std::vector<Wrong>{{"peak_ratio", "peak", "second: this course is of one run alone"},
                          {R"("second": {"run": "a", "columns": ["y"]}, )", "", "needs second"},
                          {"\"1 s\"", "\"0 s\"", "must be later than from"},
                          {R"("item": "Z1", )", "", "goes with item"},
                          {"\"must\"", "\"shall\"", "priority"},
                          {R"("second": {"run": "a")", R"("second": {"run": "b")", "there is no run \"b\""},
                          {R"("from": "0 s")", R"("from": "0 m")", "from"},
                          {"\"at_most\": 1", "\"period\": 1", "is not for a check of kind history"}}) {
    try {
      read(replaced(good, w.from, w.to));
      ADD_FAILURE() << w.says;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(w.says), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace gambeson::verify
