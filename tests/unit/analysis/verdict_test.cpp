/// What the verdict says of synthetic tables.

#include "analysis/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

const char* const hip = "right hip (flexion)";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Three thicknesses in two motions; `parts` of the natural moment in the worse one, stairs.
VerdictInput table(std::vector<double> parts) {
  VerdictInput in;
  in.what = "thickness";
  in.sized = in.multiple = true;
  in.baseline = 2;
  in.green = 0.05;
  in.red = 0.15;
  in.checked_runs = 6;
  const char* names[]{"thickness x 0.5", "thickness x 0.75", "thickness x 1"};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Option o;
    o.name = names[i];
    o.size = 0.5 + 0.25 * static_cast<double>(i);
    o.garments = {{"shirt", 3e-3 * *o.size}, {"pad", 0.01}};
    o.costs = {{"walking", "left hip (flexion)", 40 * parts[i], 0.8 * parts[i], parts[i] / parts.back()},
               {"stairs", hip, 50 * parts[i], parts[i], parts[i] / parts.back()}};
    in.options.push_back(o);
  }
  return in;
}

/// Of the joint that decides: in stairs, and elsewhere.
void addLaw(VerdictInput& in, double exponent, double elsewhere) {
  const auto law = [](double n) { return PowerLaw{n, 0, n, n, 3}; };
  in.exponents = {{"stairs", hip, law(exponent), law(exponent)},
                  {"walking", hip, law(elsewhere), law(elsewhere)},
                  {"walking", "left hip (flexion)", law(9), law(9)}};
}

TEST(Verdict, TakesTheThickestThatStaysGreen) {
  const Verdict v = verdictOf(table({0.02, 0.04, 0.08}));
  EXPECT_EQ(v.take, 1);
  EXPECT_EQ(v.light, Light::green);
  EXPECT_EQ(v.sentence, "Take thickness x 0.75: the thickest that stays green in both motions.");
  EXPECT_EQ(v.garments, "shirt 2.25 mm, pad 10.0 mm");
  EXPECT_EQ(
      v.enough,
      "Good enough: at most 2.00 Nm at the right hip (flexion), 4 % of its natural 50.0 Nm (stairs): green, below "
      "5 %. The next, thickness x 1, costs 4.00 Nm at the right hip (flexion), 8 % of its natural 50.0 Nm (stairs): "
      "amber.");
  EXPECT_EQ(v.estimate, "");
  // 0.04 reaches 0.05 with +25 %; 0.08 falls below with -37.5 %.
  ASSERT_TRUE(v.holds_up_to);
  EXPECT_NEAR(*v.holds_up_to, 0.25, 1e-9);
  EXPECT_EQ(
      v.why,
      "Peak torque in Nm, where it counts most, as a multiple of that with thickness x 1: with thickness x 0.5 it is "
      "0.25 (walking), 0.25 (stairs); with thickness x 0.75 it is 0.50 (walking), 0.50 (stairs).");
  EXPECT_TRUE(has(v.choice, "as long as the torques are right within 25 %")) << v.choice;
  EXPECT_EQ(v.surety, Surety::fairly);
  EXPECT_EQ(v.numbers,
            "No error bar: the study has one mesh, so what a finer one would change is not known. All checks of all "
            "runs hold.");
}

TEST(Verdict, TheMarginMayComeFromTheOneNotTaken) {
  const Verdict v = verdictOf(table({0.01, 0.02, 0.055}));
  EXPECT_EQ(v.take, 1);
  EXPECT_NEAR(*v.holds_up_to, 1 - 0.05 / 0.055, 1e-9);
  EXPECT_TRUE(has(v.sentence, "green in both motions, though only just")) << v.sentence;
  EXPECT_TRUE(has(v.choice, "A narrow margin")) << v.choice;
  EXPECT_EQ(v.surety, Surety::no);
}

/// The best of those that are all red is no answer: the sentence says so before it names the best.
TEST(Verdict, TakesTheBestOfThoseThatAreNotGoodEnough) {
  const Verdict v = verdictOf(table({0.2, 0.3, 0.4}));
  EXPECT_EQ(v.take, 0);
  EXPECT_EQ(v.light, Light::red);
  EXPECT_EQ(v.sentence, "None of the 3 is good enough: thickness x 0.5 adds the least torque.");
  EXPECT_TRUE(has(v.enough, "Not good enough as it is: up to 10.0 Nm")) << v.enough;
  // The next, 0.75, costs 1.5 times as much.
  EXPECT_NEAR(*v.order, 1.5, 1e-12);
  EXPECT_TRUE(
      has(v.choice,
          "Thickness x 0.75 costs 1.5 times as large a share of the natural moment, each where it costs most. Its "
          "torque is larger in all 2"))
      << v.choice;
  EXPECT_EQ(v.surety, Surety::fairly);
  // Red up to 0.15 / 0.2: 25 %.
  EXPECT_TRUE(has(v.numbers, "It is not red only if the true torque is more than 25 % smaller")) << v.numbers;
  EXPECT_TRUE(has(v.estimate, "cannot be said: how the torque goes with it is not known")) << v.estimate;
  EXPECT_TRUE(has(verdictOf(table({0.07, 0.09, 0.2})).enough, "amber, between 5 % and 15 %"));
}

/// t = 0.5 (limit / part)^(1/n): with n = 2 from 0.2 to 0.15 it is 0.5 sqrt(0.75) = 0.433, with 1 it is 0.375; to 0.05
/// it is 0.25 and 0.125.
TEST(Verdict, SaysWhichThicknessWouldDo) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  addLaw(in, 2, 1);
  NoSize why{};
  const auto red = sizeFor(in, 0, in.red, why);
  ASSERT_TRUE(red);
  EXPECT_NEAR(red->size, 0.5 * std::sqrt(0.75), 1e-12);
  EXPECT_NEAR(red->low, 0.375, 1e-12);
  EXPECT_NEAR(red->high, 0.5 * std::sqrt(0.75), 1e-12);
  EXPECT_EQ(red->motion, "stairs");
  const auto green = sizeFor(in, 0, in.green, why);
  ASSERT_TRUE(green);
  EXPECT_NEAR(green->size, 0.25, 1e-12);
  const Verdict v = verdictOf(in);
  // The pad does not go with the thickness and is not told.
  EXPECT_EQ(
      v.estimate,
      "About thickness x 0.43 (shirt 1.30 mm) would bring it down to amber (range 0.37 to 0.43). About thickness "
      "x 0.25 (shirt 0.750 mm) would bring it down to green (range 0.12 to 0.25). Extrapolated, not run: by how the "
      "peak that decides, at the right hip (flexion) (stairs), goes with the thickness. The range is that of the "
      "exponents of this joint in all motions.");
}

TEST(Verdict, TheJointThatNeedsTheThinnestDecides) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  // In walking 0.16 of the natural moment, but hardly less when thinner: 0.5 (0.15 / 0.16)^(1 / 0.2) = 0.362.
  addLaw(in, 2, 2);
  in.exponents[2].peak.exponent = 0.2;
  NoSize why{};
  const auto red = sizeFor(in, 0, in.red, why);
  ASSERT_TRUE(red);
  EXPECT_EQ(red->motion, "walking");
  EXPECT_NEAR(red->size, 0.5 * std::pow(0.15 / 0.16, 5), 1e-12);
}

/// 0.5 (0.05 / 0.2)^(1 / 0.9) = 0.107, less than a third of 0.5: too far to be said.
TEST(Verdict, DoesNotExtrapolateFar) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  addLaw(in, 0.9, 1);
  in.exponents.pop_back();
  in.exponents.push_back({"walking", "left hip (flexion)", {0.9, 0, 0.9, 0.9, 3}, {0.9, 0, 0.9, 0.9, 3}});
  NoSize why{};
  EXPECT_FALSE(sizeFor(in, 0, in.green, why));
  EXPECT_EQ(why, NoSize::too_far);
  EXPECT_TRUE(has(verdictOf(in).estimate, "green cannot be said from this study: it lies more than a factor 3"))
      << verdictOf(in).estimate;
  // A torque that does not fall with the thickness has no thickness that would do.
  for (auto& e : in.exponents) e.peak.exponent = -0.1;
  EXPECT_FALSE(sizeFor(in, 0, in.red, why));
  EXPECT_EQ(why, NoSize::no_exponent);
}

TEST(Verdict, SaysHowSureThatIs) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  in.mesh_error = 0.06;
  in.mesh_where = "walking, thickness x 1";
  EXPECT_TRUE(has(verdictOf(in).choice, "The error bar is smaller, 6 %.")) << verdictOf(in).choice;
  EXPECT_EQ(verdictOf(in).surety, Surety::yes);
  EXPECT_TRUE(has(verdictOf(in).numbers, "Error bar of the peaks: 6 % either way")) << verdictOf(in).numbers;
  EXPECT_TRUE(has(verdictOf(in).numbers, "(walking, thickness x 1)"));
  in.mesh_error = 0.3;
  EXPECT_TRUE(has(verdictOf(in).choice, "The error bar is 30 %: too much to be sure"));
  EXPECT_EQ(verdictOf(in).surety, Surety::no);
}

/// One of two torques may be off upwards, the other downwards: 1.5 is safe with 19 %, (1.19 / 0.81 = 1.47), not
/// with 21.
TEST(Verdict, TheOrderIsSafeWhereBothMayBeOff) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  in.mesh_error = 0.19;
  EXPECT_EQ(verdictOf(in).surety, Surety::yes);
  in.mesh_error = 0.21;
  EXPECT_EQ(verdictOf(in).surety, Surety::no);
}

/// What the order does not hold for is named.
TEST(Verdict, ExceptionsToTheOrderAreNamed) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  EXPECT_TRUE(has(verdictOf(in).choice, "Its torque is larger in all 2 pairs of joint and motion that matter."))
      << verdictOf(in).choice;
  in.options[1].costs[0].peak_Nm = 7.9;  // 8 Nm with the thinnest
  EXPECT_TRUE(
      has(verdictOf(in).choice,
          "Its torque is larger in 1 of the 2 pairs of joint and motion that matter; not at left hip (flexion), "
          "walking: 7.9 Nm against 8.0 Nm."))
      << verdictOf(in).choice;
}

TEST(Verdict, FailingChecksTouchTheSizesOrTheOrder) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  in.failing_runs = 2;
  in.doubts = {{"energy is lost", false}};
  Verdict v = verdictOf(in);
  EXPECT_EQ(v.surety, Surety::fairly);
  EXPECT_TRUE(
      has(v.numbers, "Checks fail in 2 of 6 runs: that makes the sizes of the torques less sure than their order"))
      << v.numbers;
  in.doubts.push_back({"contacts may be missed", true, "Movement", {{"thickness x 1, stairs"}, {2}}});
  v = verdictOf(in);
  EXPECT_EQ(v.surety, Surety::no);
  EXPECT_EQ(v.sentence, "Choose none yet: contacts may be missed in the run thickness x 1, stairs.");
  EXPECT_EQ(v.choice + v.why + v.estimate, "");
  EXPECT_FALSE(has(v.numbers, "than their order")) << v.numbers;
}

/// The thickest that is low enough is a matter of sizes: a check that touches them touches the choice.
TEST(Verdict, FailingChecksTouchAChoiceThatLimitsMake) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  in.mesh_error = 0.06;
  in.failing_runs = 1;
  in.doubts = {{"energy is lost", false, "Energy", {{"thickness x 0.75, walking"}, {1}}}};
  in.options[1].trust.check(false, false);
  for (Option& o : in.options) o.comforts = {{"walking", "chest", Light::green, 500, 4270, 1000, 9810}};
  const Verdict v = verdictOf(in);
  EXPECT_EQ(v.light, Light::green);
  EXPECT_EQ(v.cover, Light::doubtful);
  EXPECT_EQ(v.doubt, "the check Energy fails in its run thickness x 0.75, walking: energy is lost");
  EXPECT_TRUE(v.sentence.ends_with("Whoever wants no doubt takes another: thickness x 0.5 is green and all its checks hold.")) << v.sentence;
  EXPECT_EQ(v.surety, Surety::no);
  EXPECT_TRUE(has(v.choice, "The checks that fail touch the sizes of the torques")) << v.choice;
  EXPECT_EQ(v.comfort_light, Light::doubtful);
  EXPECT_TRUE(v.comfort.starts_with("Comfortable, with doubt: on the chest")) << v.comfort;
  EXPECT_TRUE(has(v.enough, "By its torque it would be good enough")) << v.enough;
}

/// Kinds of cloth of one garment are laid side by side: none is taken, least torque or not.
TEST(Verdict, OfKindsOfClothNoneIsTaken) {
  VerdictInput in = table({0.08, 0.16, 0.02});
  in.sized = in.multiple = false;
  in.what = "cloth";
  in.role = Role::model;
  const char* names[]{"smooth patches", "springs", "triangles"};
  for (std::size_t i = 0; i < 3; ++i) {
    in.options[i].name = names[i];
    in.options[i].size.reset();
    for (Option::Cost& c : in.options[i].costs) c.part.reset();
  }
  Verdict v = verdictOf(in);
  EXPECT_FALSE(v.chosen);
  EXPECT_EQ(v.take, 1);
  EXPECT_EQ(v.sentence,
            "One garment as 3 kinds of cloth: the largest torque (springs) is 8.0 times the least (triangles).");
  EXPECT_TRUE(v.enough.ends_with("As springs it costs 8.00 Nm at the right hip (flexion) (stairs).")) << v.enough;
  EXPECT_TRUE(v.choice.starts_with("As springs it costs 2.0 times as large a torque as smooth patches, the next, and "
                                   "8.0 times that of triangles, the least."))
      << v.choice;
  in.options[0].costs[1].part = 0.08;
  in.options[1].costs[1].part = 0.16;
  in.options[2].costs[1].part = 0.02;
  v = verdictOf(in);
  EXPECT_TRUE(v.sentence.ends_with("(triangles). By the largest it is red.")) << v.sentence;
}

/// Of what is not chosen the worst decides, by its share of its own natural moment, and all of them are counted.
TEST(Verdict, OfWearersTheWorstIsTheVerdict) {
  VerdictInput in = table({0.08, 0.16, 0.02});
  in.sized = in.multiple = false;
  in.role = Role::wearer;
  in.options[1].costs[1].peak_Nm = 0.1;  // of a natural moment that is small
  Verdict v = verdictOf(in);
  EXPECT_FALSE(v.chosen);
  EXPECT_EQ(v.take, 1);
  EXPECT_EQ(v.cover, Light::red);
  EXPECT_EQ(v.sentence, "Red for 1 of 3 wearers: thickness x 0.75 pays the largest share of the natural moment.");
  EXPECT_TRUE(
      v.choice.starts_with("Thickness x 0.75 pays 2.0 times as large a share of the natural moment as "
                           "thickness x 0.5, the next, and 8.0 times that of thickness x 1, the least."))
      << v.choice;
  EXPECT_EQ(v.estimate, "");
  EXPECT_EQ(v.garments, "");
  // One of whom nothing is known leaves no green.
  for (Option& o : in.options)
    for (Option::Cost& c : o.costs) c.part = 0.01;
  EXPECT_EQ(verdictOf(in).cover, Light::green);
  in.options[2].missing = true;
  v = verdictOf(in);
  EXPECT_EQ(v.cover, Light::doubtful);
  EXPECT_TRUE(has(v.sentence, "of thickness x 1 nothing is known, as a run failed")) << v.sentence;
  in.options[2].missing = false;
  for (Option::Cost& c : in.options[2].costs) c.part.reset();
  EXPECT_TRUE(has(verdictOf(in).sentence, "no natural moment is known of thickness x 1")) << verdictOf(in).sentence;
}

TEST(Verdict, SaysHowTheTorqueGoesWithTheThickness) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  in.exponents = {{"stairs", hip, {1.6, 0.05, 1.4, 1.8, 3}, {1.6, 0.05, 1.4, 1.8, 3}}};
  EXPECT_TRUE(has(verdictOf(in).why, "to the power 1.6 (stairs; 1.4 to 1.8 from one thickness to the next)"))
      << verdictOf(in).why;
  in.exponents[0].peak.lowest = -0.4;  // falls first
  EXPECT_FALSE(has(verdictOf(in).why, "to the power")) << verdictOf(in).why;
}

TEST(Verdict, ComfortIsSaidAndWhetherTheThicknessMatters) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  for (Option& o : in.options)
    o.comforts = {{"walking", "chest", Light::green, 500, 4270, 1000, 9810},
                  {"stairs", "waist", Light::red, 25300 + 400 * *o.size, 4670, 101e3, 9810}};
  Verdict v = verdictOf(in);
  EXPECT_EQ(v.comfort_light, Light::red);
  EXPECT_EQ(
      v.comfort,
      "Not comfortable: on the waist (stairs) 25.5 kPa in the mean (limit 4.67 kPa), 101 kPa at the peak (limit "
      "9.81 kPa). With thickness x 0.75 it is 25.6 kPa: the thickness hardly matters here. With thickness x 1 it is "
      "25.7 kPa: the thickness hardly matters here.");
  in.options[2].comforts[1].mean_Pa = 60e3;
  EXPECT_TRUE(verdictOf(in).comfort.ends_with("With thickness x 1 it is 60.0 kPa.")) << verdictOf(in).comfort;
  // Where it is worse than another although that costs more.
  in.options[0].comforts[0] = {"walking", "left thigh", Light::amber, 3000, 4270, 9000, 9810};
  EXPECT_TRUE(has(verdictOf(in).comfort,
                  "Less comfortable than thickness x 1 (walking): 9.00 kPa on the left thigh "
                  "(amber) against 1.00 kPa on the chest (green)."))
      << verdictOf(in).comfort;
  in.options[0].comforts[0] = in.options[1].comforts[0];
  for (Option& o : in.options) o.comforts.resize(1);
  v = verdictOf(in);
  EXPECT_EQ(v.comfort_light, Light::green);
  EXPECT_TRUE(v.comfort.starts_with("Comfortable: on the chest (walking) 0.500 kPa in the mean")) << v.comfort;
}

TEST(Verdict, WithoutNaturalMomentsItSaysWhatCostsLeast) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  for (Option& o : in.options)
    for (Option::Cost& c : o.costs) c.part.reset();
  const Verdict v = verdictOf(in);
  EXPECT_EQ(v.take, 0);
  EXPECT_EQ(v.light, Light::unknown);
  EXPECT_TRUE(has(v.sentence, "Take thickness x 0.5: of the 3 studied it adds the least torque.")) << v.sentence;
  EXPECT_TRUE(has(v.enough, "no natural moment")) << v.enough;
  EXPECT_FALSE(v.holds_up_to);
}

TEST(Verdict, MissingRunsAreNotTakenAndAreSaid) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  in.options[1].missing = true;
  const Verdict v = verdictOf(in);
  EXPECT_EQ(v.take, 0);
  EXPECT_TRUE(has(v.choice, "1 of 3 are missing because runs failed")) << v.choice;
  EXPECT_EQ(v.surety, Surety::no);
  for (Option& o : in.options) o.missing = true;
  EXPECT_EQ(verdictOf(in).take, -1);
  EXPECT_TRUE(has(verdictOf(in).sentence, "No verdict"));
}

/// Cuts, say, have no size: the one that costs least is taken.
TEST(Verdict, WithoutSizesTheCheapestIsTaken) {
  VerdictInput in = table({0.04, 0.02, 0.03});
  in.sized = false;
  for (Option& o : in.options) o.size.reset();
  const Verdict v = verdictOf(in);
  EXPECT_EQ(v.take, 1);
  EXPECT_TRUE(has(v.sentence, "it adds the least torque")) << v.sentence;
  EXPECT_TRUE(has(v.choice, "Thickness x 1 costs 1.5 times as large a share of the natural moment")) << v.choice;
}

TEST(Verdict, ASmallNaturalMomentIsExplainedByTheOtherSide) {
  VerdictInput in = table({0.2, 0.3, 0.4});
  for (Option& o : in.options) {
    o.costs[1].lever_m = 0.0091;
    o.costs.push_back(
        {"stairs", "left hip (flexion)", 60 * o.costs[1].part.value(), 0.2 * o.costs[1].part.value(), {}});
  }
  EXPECT_EQ(
      verdictOf(in).enough,
      "Not good enough as it is: up to 10.0 Nm at the right hip (flexion), 20 % of its natural 50.0 Nm (stairs): "
      "red, above 15 %. That moment is small because the ground\u2019s force on this foot passes only 0.91 cm off "
      "the joint: at the left hip (flexion), 12.0 Nm of natural 300 Nm are 4 %.");
  in.options[0].costs[2].peak_Nm = 4;  // of natural 100 Nm: no great difference
  EXPECT_FALSE(has(verdictOf(in).enough, "That moment is small"));
}

TEST(Verdict, TellsWhatIsExtrapolatedAndWhatTheEndCutsOff) {
  VerdictInput in = table({0.02, 0.04, 0.08});
  for (Option& o : in.options) o.costs[1].end_part = 0.98;
  in.stretch = {0.02, 0.13, 0.395};
  const std::string numbers = verdictOf(in).numbers;
  EXPECT_TRUE(has(numbers,
                  "In stairs the torque of the right hip (flexion) is at 98 % of its largest value when the run ends: "
                  "what going on would cost is not known."))
      << numbers;
  EXPECT_FALSE(has(numbers, "In walking"));
  EXPECT_TRUE(has(numbers,
                  "Fabric stretches by up to 40 % (99 % of it by less than 13 %), and its law is meant for less than 2 "
                  "%: beyond that its stress is extrapolated."))
      << numbers;
  in.stretch->largest = 0.019;
  for (Option& o : in.options) o.costs[1].end_part = 0.8;
  EXPECT_FALSE(has(verdictOf(in).numbers, "stretches"));
  EXPECT_FALSE(has(verdictOf(in).numbers, "when the run ends"));
}

TEST(Verdict, PercentagesTellTheirSideOfALimit) {
  EXPECT_EQ(percentBeside(0.052, 0.05, 0.15), "5.2 %");
  EXPECT_EQ(percentBeside(0.05, 0.05, 0.15), "5 %");
  EXPECT_EQ(percentBeside(0.0504, 0.05, 0.15), "5.04 %");
  EXPECT_EQ(percentBeside(0.04996, 0.05, 0.15), "4.996 %");
  EXPECT_EQ(percentBeside(0.1497, 0.05, 0.15), "14.97 %");
  EXPECT_EQ(percentBeside(0.39, 0.05, 0.15), "39 %");
}

}  // namespace
}  // namespace gambeson
