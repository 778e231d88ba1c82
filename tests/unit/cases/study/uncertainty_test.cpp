/// Studies that ask how sure their numbers are: which runs they add, and what is made of these.

#include "cases/study/uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cases/study/compare.hpp"
#include "core/error.hpp"
#include "unit/cases/study/example.hpp"

namespace gambeson::study {
namespace {

using namespace tested;

const std::string unsure = R"({
  "name": "how sure", "case": "cloth.json",
  "axes": [
    {"name": "motion", "sets": [{"contact.friction": 0.1}, {"contact.friction": 0.4}], "labels": ["walking", "stairs"]},
    {"path": "factors.thickness", "values": [0.5, 1]}
  ],
  "baseline": {"motion": "walking", "thickness": "1"},
  "uncertainty": {"seed": 3, "finer": 1.5, "step_duration": "50 ms",
                  "spread": {"thickness": "5 %", "moduli": 0.1, "bending": 0.2, "friction": 0}}
})";

const Case& caseOf(const Variant& v) { return std::get<Case>(v.definition); }

TEST(Uncertainty, AddsTheRunsThatTell) {
  const Study s = read(unsure);
  // Of each motion at the baseline's thickness: one finer, one with half steps, twelve samples.
  ASSERT_EQ(s.variants.size(), 4u + 2 * 14);
  const Variant& reference = variant(s, "stairs__thickness_1");
  const Variant& fine = variant(s, "stairs__thickness_1__cells_1.5_times_smaller");
  EXPECT_TRUE(fine.finer);
  EXPECT_EQ(fine.part, BarPart::mesh);
  EXPECT_EQ(&s.variants[static_cast<std::size_t>(fine.reference)], &reference);
  EXPECT_EQ(std::get<SheetGarment>(caseOf(fine).garments[0].shape).cells_u, 3);
  const Variant& half = variant(s, "stairs__thickness_1__half_steps");
  EXPECT_EQ(caseOf(half).time.step_safety, 0.5 * caseOf(reference).time.step_safety);
  EXPECT_EQ(caseOf(half).time.max_step_s, 0.5 * caseOf(reference).time.max_step_s);
  EXPECT_EQ(caseOf(half).time.duration_s, 0.05);
  const Variant& sample = variant(s, "stairs__thickness_1__fabric_07");
  const FactorsCase& f = caseOf(sample).factors;
  ASSERT_EQ(sample.scores.size(), 3u);  // friction is known to be the same
  EXPECT_NEAR(std::log(f.thickness), std::sqrt(std::log(1 + 0.05 * 0.05)) * sample.scores[0], 1e-12);
  EXPECT_NEAR(std::log(f.membrane), std::sqrt(std::log(1.01)) * sample.scores[1], 1e-12);
  // The rigidity of bending, thickness^3 times its factor, is its own.
  EXPECT_NEAR(std::log(f.bending * std::pow(f.thickness, 3)), std::sqrt(std::log(1.04)) * sample.scores[2], 1e-12);
  EXPECT_EQ(f.friction, 1);
  // The same samples in every motion: what differs between motions is no chance of theirs.
  EXPECT_EQ(variant(s, "walking__thickness_1__fabric_07").scores, sample.scores);
  EXPECT_EQ(s.uncertainty->unknown, std::vector<std::string>{});
}

/// The closed form: torque 4 Nm (0.22 t m + 0.43 t + 0.31 t^3 b + 0.04) sin, twice as much where it is rough.
TEST(Uncertainty, BarsAreThoseOfTheClosedForm) {
  const Study s = read(unsure);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (s.variants[i].part != BarPart::step) continue;
    for (JointNumbers& j : runs[i].joints)
      for (double& t : j.torque_Nm) t *= 0.99;  // half steps: 1 % less everywhere
    runs[i].time_s.resize(50);
    for (JointNumbers& j : runs[i].joints) j.torque_Nm.resize(50);
  }
  const Comparison c = compare(s, runs);
  ASSERT_EQ(c.budgets.size(), 2u);
  const BarredNumber& n = c.budgets[1].numbers[0];
  EXPECT_EQ(n.what.of, "hip_flexion_left");
  const double peak = n.value;
  EXPECT_NEAR(peak, 8 * std::sin(2 * M_PI * 0.245), 1e-12);
  // The fine mesh has 5 % more, with 25 points to 16: 1.25 x 0.05 x 25/(25 - 16).
  EXPECT_NEAR(*n.bar.mesh, 1.25 * 0.05 * 25 / 9 * peak, 1e-9);
  // Of first order: 1.25 x 0.01 x 2.
  EXPECT_NEAR(*n.bar.step, 0.025 * peak, 1e-9);
  // By first derivatives 0.05 (0.22 + 0.43), 0.1 x 0.22, 0.2 x 0.31 (the rigidity of bending does not go with t).
  const double by_t = 0.05 * 0.65, by_m = 0.1 * 0.22, by_b = 0.2 * 0.31;
  // Curvature and products of factors, which a line through twelve samples misses, move its parts by a tenth.
  ASSERT_TRUE(n.fabric);
  EXPECT_NEAR(std::sqrt(n.fabric->variance[0]) / peak, by_t, 0.15 * by_t);
  EXPECT_NEAR(std::sqrt(n.fabric->variance[1]) / peak, by_m, 0.15 * by_m);
  EXPECT_NEAR(std::sqrt(n.fabric->variance[2]) / peak, by_b, 0.15 * by_b);
  EXPECT_NEAR(*n.bar.fabric, 2 * std::sqrt(by_t * by_t + by_m * by_m + by_b * by_b) * peak, 0.04 * *n.bar.fabric);
  EXPECT_NEAR(*n.bar.combined(),
              std::sqrt(std::pow(*n.bar.mesh, 2) + std::pow(*n.bar.step, 2) + std::pow(*n.bar.fabric, 2)), 1e-12);
  // One notion: the verdict's bar is the same.
  EXPECT_NEAR(*c.input.mesh_error, *n.bar.mesh / peak, 1e-9);
  EXPECT_NEAR(*c.input.step_error, *n.bar.step / peak, 1e-9);
  EXPECT_NEAR(*c.input.fabric_error, *n.bar.fabric / peak, 1e-9);
  // A variant beside has it in per cent.
  const auto thin = static_cast<std::size_t>(&variant(s, "stairs__thickness_0.5") - s.variants.data());
  bool taken_over = false;
  const auto other = barOf(s, c, thin, n.what, &taken_over);
  ASSERT_TRUE(other);
  EXPECT_TRUE(taken_over);
  EXPECT_NEAR(*other->relative(), *n.relative(), 1e-12);
  // What dominates is said, and what to measure: bending, 62 of 74 of the fabric's.
  const std::vector<std::string> advice = adviceOf(s, n);
  ASSERT_EQ(advice.size(), 3u);
  EXPECT_NE(advice[0].find("the mesh"), std::string::npos) << advice[0];
  EXPECT_NE(advice[1].find("finer cells"), std::string::npos) << advice[1];
  EXPECT_NE(advice[2].find("measure the bending rigidity better"), std::string::npos) << advice[2];
}

/// Pressures have bars of the step too: by the largest and by the mean of what the run with half steps saw.
TEST(Uncertainty, PressuresHaveBarsOfTheStep) {
  const Study s = read(unsure);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const bool half = s.variants[i].part == BarPart::step;
    ComfortNumbers c{"thigh_left", "green", 0, 0, 4270, 9810, 0, 0};
    double sum = 0;
    for (int k = 0; k < (half ? 30 : 50); ++k) {
      const double p = (1000 + 20 * k) * (half ? 0.98 : 1);  // rises until the end; half steps: 2 % less
      runs[i].pressure_time_s.push_back(0.02 * (k + 1) + (half ? 1e-13 : 0));
      sum += p;
      c.largest_Pa.push_back(p);
      c.mean_so_far_Pa.push_back(sum / (k + 1));
    }
    c.peak_Pa = c.largest_Pa.back(), c.mean_Pa = c.mean_so_far_Pa.back();
    runs[i].comfort = {c};
  }
  const auto bars = [&] {
    std::vector<BarredNumber> pressures;
    const Comparison c = compare(s, runs);
    for (const BarredNumber& n : c.budgets[0].numbers)
      if (!n.what.isTorque()) pressures.push_back(n);
    return pressures;
  };
  for (const BarredNumber& n : bars()) {
    ASSERT_TRUE(n.bar.step) << n.what.name();
    // 1.25 x 0.02 x 2 of the value of the whole run.
    EXPECT_NEAR(*n.bar.step, 0.05 * n.value, 1e-9) << n.what.name();
  }
  EXPECT_EQ(bars().size(), 2u);
  // Half steps whose frames lie elsewhere tell nothing.
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (s.variants[i].part == BarPart::step)
      for (double& t : runs[i].pressure_time_s) t += 0.001;
  for (const BarredNumber& n : bars()) EXPECT_FALSE(n.bar.step) << n.what.name();
}

/// The page says what to measure of the torque that is least sure, and whose the runs behind the bars are.
TEST(Uncertainty, ThePageSaysWhatToMeasure) {
  const Study s = read(unsure);
  std::vector<RunNumbers> runs = numbersOf(s);
  int spoiled = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].comfort = {{"thigh_left", "green", 900, 3000, 4270, 9810, 27, 0.62}};
    if (s.variants[i].part == BarPart::fabric && spoiled < 3) ++spoiled, runs[i].comfort[0].light = "red";
  }
  const std::string page = studyPage(s, compare(s, runs), {}, {});
  const auto has = [&](const std::string& text) { return page.find(text) != std::string::npos; };
  EXPECT_TRUE(has("What to measure"));
  EXPECT_TRUE(has("measure the bending rigidity better"));
  EXPECT_TRUE(has("It was found with thickness x 1; of the others it is taken to be the same part of their torques."));
  EXPECT_TRUE(
      has("Of the 28 runs of thickness x 1 that tell the error bars 3 have a part of the body that is amber or "
          "red."));
}

/// The samples are no elasticities, no options and no members of a group.
TEST(Uncertainty, ItsRunsAreNoVariantsToCompare) {
  const Study s = read(unsure);
  const Comparison c = compare(s, numbersOf(s));
  EXPECT_TRUE(c.elasticities.empty());
  EXPECT_EQ(c.input.options.size(), 2u);
  for (const VariantGroup& g : c.groups) EXPECT_EQ(g.members.size(), 2u);
}

/// A run that failed is left out and counted; too few leave no bar, and the reason.
TEST(Uncertainty, FailedSamplesAreLeftOut) {
  const Study s = read(unsure);
  std::vector<RunNumbers> runs = numbersOf(s);
  int left = 2;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (s.variants[i].part == BarPart::fabric && s.variants[i].levels[0] == 0 && left-- > 0) runs[i].good = false;
  Comparison c = compare(s, runs);
  EXPECT_EQ(c.budgets[0].failed, 2);
  EXPECT_EQ(c.budgets[0].numbers[0].fabric->runs, 10u);
  left = 6;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (s.variants[i].part == BarPart::fabric && s.variants[i].levels[0] == 0 && left-- > 0) runs[i].good = false;
  c = compare(s, runs);
  EXPECT_FALSE(c.budgets[0].numbers[0].bar.fabric);
  EXPECT_EQ(c.budgets[0].no_fabric, "6 of 12 samples failed");
}

/// Half steps that end before the torque rises say nothing of its peak.
TEST(Uncertainty, AShortWindowOfHalfStepsSaysSo) {
  const Study s = read(unsure);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (s.variants[i].part == BarPart::step) {
      runs[i].time_s.resize(2);
      for (JointNumbers& j : runs[i].joints) j.torque_Nm.resize(2);
    }
  const Comparison c = compare(s, runs);
  EXPECT_FALSE(c.budgets[0].numbers[0].bar.step);
  EXPECT_NE(c.budgets[0].no_step.find("less than a fifth of the peak"), std::string::npos) << c.budgets[0].no_step;
}

/// A study may ask of one case alone.
TEST(Uncertainty, OfOneCase) {
  const Study s = read(R"({"name": "one", "case": "cloth.json", "uncertainty": {"spread": {"bending": "10 %"}}})");
  ASSERT_EQ(s.variants.size(), 1u + 14);
  EXPECT_EQ(s.uncertainty->unknown, (std::vector<std::string>{"thickness", "moduli", "friction"}));
  const Comparison c = compare(s, numbersOf(s));
  ASSERT_EQ(c.budgets.size(), 1u);
  EXPECT_EQ(c.groups[0].members.size(), 1u);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_NE(page.find("No spread is given of thickness, moduli or friction"), std::string::npos);
  EXPECT_NE(page.find("\u00b1"), std::string::npos);
}

/// A finer variant of its own is the mesh's part: no further run is made.
TEST(Uncertainty, MeshesOfTheStudyCount) {
  const Study s = read(replaced(replaced(unsure, R"("finer": 1.5, )", ""), R"("baseline")",
                                R"("variants": [{"label": "fine", "finer": true, "set": {"garment.sheet.cells_u": 3}}],
                                   "baseline")"));
  for (const Variant& v : s.variants) EXPECT_NE(v.part, BarPart::mesh) << v.folder;
  const Comparison c = compare(s, numbersOf(s));
  EXPECT_NEAR(*c.budgets[0].numbers[0].bar.mesh / c.budgets[0].numbers[0].value, 1.25 * 0.05 * 25 / 9, 1e-9);
  EXPECT_FALSE(c.budgets[0].mesh_taken_over);
  // The other motion has no finer run: the same in per cent, and said so.
  EXPECT_NEAR(*c.budgets[1].numbers[0].bar.mesh / c.budgets[1].numbers[0].value, 1.25 * 0.05 * 25 / 9, 1e-9);
  EXPECT_TRUE(c.budgets[1].mesh_taken_over);
}

TEST(Uncertainty, WhatIsWrongIsNamed) {
  const auto with = [](const std::string& text) {
    return R"({"name": "n", "case": "cloth.json", "uncertainty": )" + text + "}";
  };
  const auto reasonOf = [&](const std::string& text) -> std::string {
    try {
      read(with(text));
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(reasonOf(R"({"runs": 11})"), "runs")) << reasonOf(R"({"runs": 11})");
  EXPECT_TRUE(has(reasonOf(R"({"spread": {"bending": -0.1}})"), ">= 0 and <= 1"));
  EXPECT_TRUE(has(reasonOf(R"({"spread": {"weight": 0.1}})"), "weight"));
  EXPECT_TRUE(has(reasonOf(R"({"finer": 0.5})"), "finer"));
  EXPECT_TRUE(has(reasonOf(R"({"step": false, "finer": 1})"), "asks for nothing"));
  EXPECT_TRUE(has(reasonOf(R"({"step_duration": "9 s"})"), "at most the motion's 0.1 s"));
  EXPECT_TRUE(has(reasonOf(R"({"where": {"mesh": ["a"]}})"), "there are no axes"));
}

}  // namespace
}  // namespace gambeson::study
