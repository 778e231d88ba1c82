/// Twelve studies whose runs' numbers are made up: the sentence and the colour on the cover of each. With
/// GAMBESON_PAGES=DIR in the environment their pages are left there, to be read.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>

#include "cases/study/compare.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::study {
namespace {

const std::string shorts = R"({"name": "shorts",
  "garment": {"shorts": {"cell": "50 mm"}},
  "fabric": {"name": "cotton", "thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "human": {"manikin": "male_p50", "motion": {"walk": {"strides": 2}}},
  "supports": [{"springs": {"edge": "waist", "link": "pelvis"}}],
  "contact": {"friction": 0.3}})";

const char* const thicknesses = R"({"path": "factors.thickness", "values": [0.5, 0.75, 1]})";
const char* const wearers =
    R"({"name": "wearer", "path": "human.manikin", "values": ["female_p5", "male_p50", "male_p95"],
        "labels": ["female_p5", "male_p50", "male_p95"]})";

/// What the runs of a story measured. `part`: of the natural moment of the hip that decides.
struct Story {
  std::string title, axes;
  std::function<double(const Case&, const Variant&)> part;
  std::function<void(RunNumbers&, const Variant&)> more;
  const char* colour;    ///< of the cover
  const char* sentence;  ///< the first of the page
};

JointNumbers joint(const std::string& name, const std::string& label, double natural_Nm, double peak_Nm) {
  JointNumbers j;
  j.name = name;
  j.label = label;
  j.natural_Nm = natural_Nm;
  j.normal_N = 12;
  j.friction_N = 2;
  j.friction_Nm = 0.1 * peak_Nm;
  j.standing_Nm = 0.1 * peak_Nm;
  j.rate_at_peak = 1;
  for (int w = 0; w < 200; ++w) j.torque_Nm.push_back(peak_Nm * std::pow(std::sin(M_PI * (0.005 + 0.01 * w)), 3));
  j.peak_Nm = *std::max_element(j.torque_Nm.begin(), j.torque_Nm.end());
  j.peak_time_s = 0.505;
  j.cause = "swing (60 % of the stride)";
  j.rms_Nm = rms(j.torque_Nm);
  return j;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}
bool has(const std::string& text, const std::string& part) { return count(text, part) > 0; }

/// Natural moments go with the body's mass.
double natural(const std::string& manikin) { return manikin == "male_p95" ? 66 : manikin == "female_p5" ? 34 : 55; }

RunNumbers numbers(const Story& story, const Variant& v) {
  const Case& c = std::get<Case>(v.definition);
  const double part = story.part(c, v), moment = natural(c.human->manikin);
  RunNumbers r;
  r.good = true;
  r.control_points = 900;
  r.recorded_to_s = r.planned_to_s = 2;
  r.garments = {{"", 0.3 * c.factors.thickness, 0.6, 1e-3 * c.factors.thickness, 900}};
  for (int w = 0; w < 200; ++w) r.time_s.push_back(0.005 + 0.01 * w);
  r.joints = {joint("hip_flexion_left", "left hip (flexion)", moment, part * moment),
              joint("hip_flexion_right", "right hip (flexion)", moment, 0.9 * part * moment),
              joint("hip_adduction_left", "left hip (adduction)", 1.2 * moment, 0.5 * part * moment)};
  JointNumbers elbow = joint("elbow_flexion_left", "left elbow (flexion)", 10, 0);
  elbow.normal_N = elbow.friction_N = 0;
  r.joints.push_back(elbow);
  r.zones = {{"thigh", 30, 28, 5}, {"hips", 20, 19, 3}};
  r.contact = {{"thigh_left", 0.3, 15, 30, 14, 2}, {"thigh_right", 0.3, 15, 30, 14, 2}, {"pelvis", 0.4, 20, 40, 19, 3}};
  r.comfort = {{"thigh_left", "green", 900, 3000, 4270, 9810, 27, 0.62, 2000, "swing (70 % of the stride)"}};
  r.stress = {{"front_left", 10, 40, 80, 107, 0.05, 0.09}, {"back_left", 8, 30, 70, 169, 0.04, 0.12}};
  r.largest_strain = 0.12;
  r.stretch = {{0.25, 0.04, 0.1, true, "", "weft"}, {0.25, 0.05, 0.12, true, "", "warp"}};
  r.checks = {{"Momentum", 1e-13, 1e-9, "", true},
              {"Energy", 0.8, 5, "%", true},
              {"Penetration", 0.02, 0.2, "mm", true},
              {"Slipping", 6, 50, "mm", true}};
  story.more(r, v);
  return r;
}

std::vector<Story> stories() {
  const auto by_thickness = [](double a, double b, double c) {
    return [=](const Case& k, const Variant&) {
      return k.factors.thickness < 0.6 ? a : k.factors.thickness < 0.9 ? b : c;
    };
  };
  const auto nothing = [](RunNumbers&, const Variant&) {};
  const auto by_label = [](std::map<std::string, double> parts) {
    return [=](const Case&, const Variant& v) { return parts.at(v.label); };
  };
  const auto fails = [](CheckNumbers check, const std::string& label) {
    return [=](RunNumbers& r, const Variant& v) {
      if (v.label.find(label) != std::string::npos) r.checks.push_back(check);
    };
  };
  return {
      {"01 all green", thicknesses, by_thickness(0.02, 0.03, 0.04), nothing, "green",
       "Take thickness x 1: the thickest studied, and green."},
      {"02 all red", thicknesses, by_thickness(0.2, 0.28, 0.36), nothing, "red",
       "None of the 3 is good enough: thickness x 0.5 adds the least torque."},
      {"03 a check fails", thicknesses, by_thickness(0.02, 0.03, 0.08),
       fails({"Energy", 7.5, 5, "%", false}, "thickness x 0.75"), "doubtful",
       "Take thickness x 0.75, with doubt: the thickest whose torque is low enough, but the check Energy fails in its "
       "run: the cloth gained energy that no work on it explains, 7.5 % of the work of all forces (allowed: 5.0 % "
       "either "
       "way). Whoever wants no doubt takes another: thickness x 0.5 is green and all its checks hold."},
      {"04 the garment falls", thicknesses, by_thickness(0.02, 0.03, 0.04),
       fails({"Slipping", 740, 50, "mm", false}, "thickness"), "unknown",
       "Choose none yet: the garment slips down the body by 740 mm (allowed: 50 mm) in all 3 runs."},
      {"05 stretched too far", thicknesses, by_thickness(0.02, 0.03, 0.04),
       [](RunNumbers& r, const Variant&) {
         r.stretch = {{0.15, 0.21, 0.73, true, "", "weft"}};
         r.largest_strain = 0.73;
       },
       "doubtful",
       "Take thickness x 1, with doubt: the thickest studied, and its torque is low enough, but in all 3 runs the "
       "fabric stretches further than the 15 % that it is meant for: up to 73 %."},
      {"06 wearers", wearers, by_label({{"female_p5", 0.04}, {"male_p50", 0.09}, {"male_p95", 0.17}}), nothing, "red",
       "Red for 1 of 3 wearers: male_p95 pays the largest share of the natural moment."},
      {"07 sizes",
       R"({"name": "size", "labels": ["S", "M", "L"], "sets": [
            {"garment.shorts.ease": "2 %", "human.manikin": "female_p5"},
            {"garment.shorts.ease": "4 %", "human.manikin": "male_p50"},
            {"garment.shorts.ease": "6 %", "human.manikin": "male_p95"}]})",
       by_label({{"S", 0.035}, {"M", 0.02}, {"L", 0.025}}), nothing, "green",
       "Green in all 3 sizes: S costs the largest share of the natural moment."},
      {"08 materials",
       R"({"name": "material", "path": "fabric.young", "values": ["1 MPa", "2 MPa", "4 MPa"],
           "labels": ["jersey", "twill", "denim"]})",
       by_label({{"jersey", 0.07}, {"twill", 0.1}, {"denim", 0.21}}), nothing, "amber",
       "Take jersey: of the 3 materials studied it adds the least torque."},
      {"09 friction", R"({"path": "contact.friction", "values": [0.1, 0.3, 0.5]})",
       by_label({{"friction 0.1", 0.02}, {"friction 0.3", 0.03}, {"friction 0.5", 0.06}}), nothing, "amber",
       "Amber at 1 of 3 frictions: friction 0.5 costs the largest share of the natural moment."},
      {"10 fits", R"({"path": "garment.shorts.ease", "values": ["2 %", "6 %", "12 %"]})",
       by_label({{"ease 2 %", 0.08}, {"ease 6 %", 0.03}, {"ease 12 %", 0.045}}), nothing, "green",
       "Take ease 6 %: of the 3 fits studied it adds the least torque."},
      {"11 no natural moment", wearers, by_label({{"female_p5", 0.04}, {"male_p50", 0.05}, {"male_p95", 0.06}}),
       [](RunNumbers& r, const Variant&) {
         for (JointNumbers& j : r.joints) j.natural_Nm.reset();
       },
       "unknown", "Of the 3 wearers studied male_p95 pays the largest torque: whether that is too much is not known."},
      {"12 thickness for all wearers", std::string(wearers) + ", " + thicknesses,
       [](const Case& k, const Variant&) {
         return k.factors.thickness * (k.human->manikin == "male_p95" ? 0.06 : 0.04);
       },
       nothing, "green", "Take thickness x 0.75: the thickest that stays green for all 3 wearers."},
  };
}

Study studyOf(const Story& story) {
  static const Folder folder;
  folder.write("shorts.json", shorts);
  return readStudy(folder.write("a.study.json", R"({"name": "Shorts for walking: )" + story.title.substr(3) +
                                                    R"(", "description": "Made-up numbers.", "case": "shorts.json",
    "pictures": [], "axes": [)" + story.axes + "]}"));
}

Comparison compared(const Study& s, const Story& story) {
  std::vector<RunNumbers> runs;
  for (const Variant& v : s.variants) runs.push_back(numbers(story, v));
  return compare(s, std::move(runs));
}

TEST(VerdictPages, EachSaysWhatItsRunsHold) {
  for (const Story& story : stories()) {
    SCOPED_TRACE(story.title);
    const Study s = studyOf(story);
    const Comparison c = compared(s, story);
    const std::string page = studyPage(s, c, {}, {});
    if (const char* folder = std::getenv("GAMBESON_PAGES")) {
      std::filesystem::create_directories(folder);
      std::string name = story.title;
      std::replace(name.begin(), name.end(), ' ', '_');
      std::ofstream(std::filesystem::path(folder) / (name + ".html")) << page;
    }
    EXPECT_EQ(c.verdict.sentence, story.sentence);
    const std::string colour = c.verdict.cover == Light::unknown ? "unknown" : nameOf(c.verdict.cover);
    EXPECT_EQ(colour, story.colour) << c.verdict.enough;
    EXPECT_NE(page.find("class=\"judged " + colour + "\""), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("not judged</span>") != std::string::npos, trustOf(c.input).spoiling > 0);
    EXPECT_EQ(page.find("<th>left elbow (flexion)"), std::string::npos);
    EXPECT_EQ(page.find("left elbow (flexion):"), std::string::npos);
    // What is taken pays when and why; what to change says what was not asked; doubt stands apart in the sentence.
    const bool told = c.verdict.take >= 0 && trustOf(c.input).spoiling == 0;
    EXPECT_EQ(has(page, "during swing ("), told);
    EXPECT_EQ(has(page, "What to change"), c.verdict.chosen && c.verdict.take >= 0 && c.input.role != Role::model);
    EXPECT_EQ(has(page, "class=\"doubted\""),
              !c.verdict.doubt.empty() && has(c.verdict.sentence, c.verdict.doubt.c_str()));
    // Nothing is green that stands on runs in doubt.
    if (!trustOf(c.input).whole()) {
      EXPECT_EQ(page.find("class=\"judged green\""), std::string::npos);
    }
  }
}

/// The page of a study and those of its runs judge by one rule.
TEST(VerdictPages, NoStudyIsGreenWhereARunWarns) {
  for (const Story& story : stories()) {
    SCOPED_TRACE(story.title);
    const Study s = studyOf(story);
    const Comparison c = compared(s, story);
    bool whole = true, reliable = true;
    for (const RunNumbers& r : c.runs) whole = whole && r.trust().whole(), reliable = reliable && r.trust().reliable();
    EXPECT_EQ(trustOf(c.input).whole(), whole);
    EXPECT_EQ(trustOf(c.input).reliable(), reliable);
    EXPECT_TRUE(whole || c.verdict.cover != Light::green);
    for (std::size_t i = 0; i < c.runs.size(); ++i)
      EXPECT_TRUE(c.runs[i].trust().whole() || c.lights[i] != Light::green) << s.variants[i].label;
  }
}

/// Wearers have natural moments of their own, and each is shown beside its share.
TEST(VerdictPages, WearersAreShownWithTheirOwnNaturalMoments) {
  const Story wearer = stories()[5];
  ASSERT_EQ(wearer.title, "06 wearers");
  const Study s = studyOf(wearer);
  EXPECT_EQ(s.axes[0].role, Role::wearer);
  const Comparison c = compared(s, wearer);
  EXPECT_FALSE(c.verdict.chosen);
  EXPECT_TRUE(
      c.verdict.enough.starts_with("Not good enough as it is: male_p95 pays 11.2 Nm at the left hip (flexion), "
                                   "17 % of its natural 66.0 Nm: red, above 15 %."))
      << c.verdict.enough;
  const std::string page = studyPage(s, c, {}, {});
  for (const char* natural_moment : {"34.0 Nm", "55.0 Nm", "66.0 Nm"})
    EXPECT_NE(page.find(natural_moment), std::string::npos) << natural_moment;
  EXPECT_EQ(page.find("Take "), std::string::npos);
  // One of a pair of axes: every wearer counts for every thickness.
  const Story both = stories()[11];
  const Study t = studyOf(both);
  const Comparison d = compared(t, both);
  EXPECT_EQ(d.groups.size(), 3u);
  EXPECT_EQ(d.input.setting, Role::wearer);
  for (std::size_t i = 0; i < t.variants.size(); ++i) {
    const auto& base = std::get<Case>(t.variants[static_cast<std::size_t>(t.variants[i].baseline)].definition);
    EXPECT_EQ(base.human->manikin, std::get<Case>(t.variants[i].definition).human->manikin);
    EXPECT_EQ(base.factors.thickness, 1);
  }
}

/// A garment that touches nothing costs nothing that could be judged.
TEST(VerdictPages, NothingTouchedIsNotGreen) {
  Story story = stories()[0];
  story.more = [](RunNumbers& r, const Variant&) {
    for (JointNumbers& j : r.joints) {
      j.peak_Nm = j.rms_Nm = j.normal_N = j.friction_N = 0;
      j.torque_Nm.assign(j.torque_Nm.size(), 0);
    }
    r.comfort.clear();
  };
  const Study s = studyOf(story);
  const Comparison c = compared(s, story);
  EXPECT_EQ(c.verdict.sentence,
            "No verdict: the garment touches nothing that a joint moves, so that no torque tells what it costs.");
  EXPECT_EQ(c.verdict.cover, Light::unknown);
  for (const Light light : c.lights) EXPECT_EQ(light, Light::unknown);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_EQ(page.find("light green"), std::string::npos);
  EXPECT_EQ(page.find("judged green"), std::string::npos);
}

std::string pageOf(const Story& story) {
  const Study s = studyOf(story);
  return studyPage(s, compared(s, story), {}, {});
}

/// The stretch of the verdict is that of the table, and so is its limit.
TEST(VerdictPages, StretchHasOneValueAndOneLimit) {
  const Story story = stories()[4];
  const Study s = studyOf(story);
  const Comparison c = compared(s, story);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_TRUE(has(page, "99 % of it by less than 21 %") || has(c.verdict.numbers, "99 % of it by less than 21 %"));
  EXPECT_TRUE(has(page, ">21.0</td>"));
  EXPECT_FALSE(has(page, ">5.00</td>"));
  EXPECT_TRUE(has(page, ">15 (weft)</td>"));
  EXPECT_TRUE(has(page, "what the fabric stands by its card or case, less than 15 % along the weft"));
  EXPECT_FALSE(has(page, "sets no limit"));
  // How sure the choice is knows of it.
  EXPECT_EQ(c.verdict.surety, Surety::no);
  EXPECT_TRUE(has(c.verdict.choice, "The fabric stretches further than the 15 % that it is meant for in all 3 runs"))
      << c.verdict.choice;
  EXPECT_EQ(c.input.stretched.names.size(), 3u);
}

/// A limit that the case states counts; that the law ends before it stands beside the checks.
TEST(VerdictPages, StretchBeyondTheLawIsToldBesideTheChecks) {
  const Story story = stories()[0];
  const Study s = studyOf(story);
  const Comparison c = compared(s, story);
  EXPECT_EQ(c.verdict.cover, Light::green);
  EXPECT_TRUE(
      has(c.verdict.numbers,
          "All checks of all runs hold. The fabric stretches by up to 12 %, less than the 25 % that it is meant "
          "for, and that limit counts; its law is taken for strains below 2 %, and continued beyond."))
      << c.verdict.numbers;
  EXPECT_TRUE(has(pageOf(story),
                  "Pull the fabric in a test up to <span class=\"q\">12 %</span> of stretch: the numbers that the runs "
                  "have of it hold up to <span class=\"q\">2 %</span>."));
}

TEST(VerdictPages, AFailingCheckIsNamedWithItsRun) {
  Story story = stories()[2];
  const auto sentence = [&](const std::string& label) {
    story.more = [=](RunNumbers& r, const Variant& v) {
      if (v.label == label) r.checks.push_back({"Energy", 7.5, 5, "%", false});
    };
    const Study s = studyOf(story);
    return compared(s, story).verdict.sentence;
  };
  const std::string other = sentence("thickness x 0.5");
  EXPECT_TRUE(has(other, "the check Energy fails in the run thickness x 0.5, not in its own: the cloth gained"))
      << other;
  EXPECT_FALSE(has(other, "wants no doubt")) << other;
}

/// Where none can be chosen, no answer is told, and the reason once.
TEST(VerdictPages, NothingIsAnsweredWhereNothingCanBeReliedOn) {
  const Story story = stories()[3];
  const Study s = studyOf(story);
  const Comparison c = compared(s, story);
  const std::string page = studyPage(s, c, {}, {});
  for (const char* text : {"Why this one", "It stays the answer", "Thickness</dt>", "Weighs</dt>", "Costs</dt>",
                           "others hold all checks", "in doubt", "not known</span>", "Which one"})
    EXPECT_FALSE(has(page, text)) << text;
  EXPECT_EQ(c.verdict.comfort, "Comfort: not judged.");
  // The description of the page, the sentence, and each run among the checks that fail.
  EXPECT_EQ(count(page, "740 mm"), 2u + 3u);
}

/// A multiple says of what it is.
TEST(VerdictPages, MultiplesSayWhetherTheyAreOfTorqueOrOfShare) {
  const Story story = stories()[6];
  const Study s = studyOf(story);
  const Comparison c = compared(s, story);
  EXPECT_TRUE(c.verdict.why.starts_with("Peak torque in Nm, ")) << c.verdict.why;
  EXPECT_TRUE(has(c.verdict.choice, "S costs 1.4 times as large a share of the natural moment as L, the next"))
      << c.verdict.choice;
  // Of S, the worst by its share, and not of L, whose torque is the largest: 0.035 of 34 Nm.
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_TRUE(has(page, "peak 1.19 Nm at 0.49 s"));
  EXPECT_TRUE(has(page, "Marked is the peak of S."));
  EXPECT_FALSE(has(page, "peak 1.65 Nm at 0.49 s"));
  const Story materials = stories()[7];
  const Study t = studyOf(materials);
  EXPECT_TRUE(has(compared(t, materials).verdict.choice, "times as large a share of the natural moment, each where"));
}

TEST(VerdictPages, WithoutNaturalMomentsNoneIsPromised) {
  const std::string page = pageOf(stories()[10]);
  EXPECT_FALSE(has(page, "Bovi"));
  EXPECT_FALSE(has(page, "in per cent of the joint"));
  EXPECT_FALSE(has(page, "share of its natural moment"));
  EXPECT_TRUE(has(page, "No natural moment of this task is known: torques have no light"));
  EXPECT_TRUE(has(pageOf(stories()[0]), "Bovi"));
}

/// Names have no powers, and a curve that falls and rises again has none either.
TEST(VerdictPages, ExponentsAreOfNumbersAndOfPowersAlone) {
  const Study materials = studyOf(stories()[7]);
  EXPECT_TRUE(compared(materials, stories()[7]).exponents.empty());
  EXPECT_FALSE(has(pageOf(stories()[7]), "power of the material"));
  const std::string fits = pageOf(stories()[9]), thick = pageOf(stories()[0]);
  EXPECT_FALSE(has(fits, "a power of the ease"));
  EXPECT_TRUE(has(thick, "a power of the thickness"));
  EXPECT_FALSE(has(fits, "xponent"));
  EXPECT_TRUE(has(thick, "xponent"));
}

TEST(VerdictPages, EachMovementHasItsOwnWords) {
  EXPECT_TRUE(has(pageOf(stories()[0]), "more towards adduction because of the garment"));
}

/// What is alike for all has no name.
TEST(VerdictPages, ComfortThatIsAlikeIsToldOnce) {
  const Story story = stories()[8];
  const Study s = studyOf(story);
  const std::string comfort = compared(s, story).verdict.comfort;
  EXPECT_TRUE(
      comfort.starts_with("Comfortable: on the left thigh 3.00 kPa at the peak (limit 9.81 kPa), at 0.62 s, during "
                          "swing (70 % of the stride). The "
                          "pressure is the same at all 3 frictions."))
      << comfort;
  EXPECT_FALSE(has(comfort, "friction 0.")) << comfort;
}

/// Every word of the lights stands in the legend, and doubtful looks like no other.
TEST(VerdictPages, LightsAreTold) {
  const std::string page = pageOf(stories()[4]);
  for (const char* word : {"Green: ", "Amber: ", "Red: ", "Doubtful: ", "Not judged: ", "Not known: "})
    EXPECT_TRUE(has(page, word)) << word;
  EXPECT_TRUE(has(page, "\u25d0 doubtful</span>"));
  EXPECT_FALSE(has(page, ".amber, .judged.doubtful"));
  EXPECT_FALSE(has(page, ".light.amber, .light.doubtful"));
}

/// On a narrow page the names of rows and the titles stay in sight, and a sign tells that there is more.
TEST(VerdictPages, WideTablesScrollWithASign) {
  const std::string page = pageOf(stories()[0]);
  EXPECT_EQ(count(page, "<caption><span>"), count(page, "<table>"));
  EXPECT_EQ(count(page, "class=\"scroll\" tabindex=\"0\""), count(page, "<table>"));
  for (const char* rule : {".panel.more::before", ".panel.more th:first-child { position:sticky", "scrollWidth"})
    EXPECT_TRUE(has(page, rule)) << rule;
}

/// One number, one value: what the picture calls the largest pull stands in the table too.
TEST(VerdictPages, TheLargestPullIsThatOfAnyPatch) {
  const Story story = stories()[0];
  const Study s = studyOf(story);
  const std::string page = studyPage(s, compared(s, story), {}, {});
  EXPECT_NE(page.find("single spots of any patch, up to [N/m]"), std::string::npos);
  EXPECT_NE(page.find(">169</td>"), std::string::npos);
  EXPECT_EQ(page.find(">107</td>"), std::string::npos);
  EXPECT_NE(page.find("Pressure is the mean over <span class=\"q\">30 mm</span>"), std::string::npos);
}

}  // namespace
}  // namespace gambeson::study
