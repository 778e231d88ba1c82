/// A population of a study: who is drawn, which sizes they try, and what the runs say of them.

#include "cases/study/population.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cases/study/compare.hpp"
#include "core/error.hpp"
#include "unit/cases/study/example.hpp"

namespace gambeson::study {
namespace {

using namespace tested;
using schema::toText;

const std::string shorts = R"({"name": "shorts", "garment": {"shorts": {"cell": "60 mm"}},
  "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "1 s"}}}, "contact": {"friction": 0.3}})";

/// The first line below is line 1 of the file.
const std::string drawn = R"({"name": "whom?", "case": "shorts.json", "pictures": [],
  "population": {
    "source": "ansur2", "count": 5, "women": 0.4, "seed": 3
  }
})";
const std::string sized = R"({"name": "whom?", "case": "shorts.json", "pictures": [],
  "population": {
    "source": "ansur2", "count": 4, "tries": 2,
    "grades": [{"girth": "hip", "path": "garment.shorts.ease", "ease": 0.06},
               {"girth": "waist", "path": "garment.shorts.waist_ease", "ease": 0.06, "least": 0.01}],
    "sizes": [{"label": "S", "hip": "95 cm", "waist": "86 cm"},
              {"label": "M", "hip": "103 cm", "waist": "96 cm"},
              {"label": "L", "hip": "111 cm", "waist": "106 cm", "set": {"garment.shorts.inseam": "22 cm"}}]
  }
})";

Study readPopulation(const std::string& text) {
  static const Folder folder;
  folder.write("shorts.json", shorts);
  return readStudy(folder.write("a.study.json", text));
}

/// Bodies take a while to be made and checked: each study is read once.
const Study& drawnStudy() {
  static const Study study = readPopulation(drawn);
  return study;
}
const Study& sizedStudy() {
  static const Study study = readPopulation(sized);
  return study;
}

std::string refusal(const std::string& text) {
  try {
    readPopulation(text);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(StudyPopulation, EveryWearerIsAVariantWithHisOwnBody) {
  const Study& s = drawnStudy();
  ASSERT_TRUE(s.population);
  EXPECT_EQ(s.population->men, 3);
  EXPECT_EQ(s.population->women, 2);
  ASSERT_EQ(s.variants.size(), 5u);
  EXPECT_EQ(s.variants[0].folder, "man_01");
  EXPECT_EQ(s.variants[4].folder, "woman_02");
  EXPECT_EQ(s.axes[0].role, Role::wearer);
  for (std::size_t i = 0; i < s.variants.size(); ++i) {
    const Case& c = std::get<Case>(s.variants[i].definition);
    ASSERT_TRUE(c.human->measures);
    EXPECT_EQ(c.human->measures->mass_kg, s.population->wearers[i].measures.mass_kg);
    EXPECT_EQ(c.human->measures->waist_m, s.population->wearers[i].measures.waist_m);
    EXPECT_EQ(s.variants[i].baseline, -1);
  }
  // A larger population keeps whom it has: what was run is not run again.
  PopulationInput more = s.population->input;
  more.count = 20;
  const Population large = drawPopulation(more);
  EXPECT_EQ(large.wearers[2].folder, "man_03");
  EXPECT_EQ(toText(manikinNode(large.wearers[2].measures)), toText(manikinNode(s.population->wearers[2].measures)));
  EXPECT_EQ(large.wearers[12].folder, "woman_01");
  EXPECT_EQ(toText(manikinNode(large.wearers[12].measures)), toText(manikinNode(s.population->wearers[3].measures)));
}

TEST(StudyPopulation, EachTriesTheNearestSizesThatAreWideEnough) {
  const Study& s = sizedStudy();
  const Population& p = *s.population;
  int without = 0;
  for (const Wearer& w : p.wearers) {
    EXPECT_LE(w.sizes.size(), 2u);
    without += w.sizes.empty();
    EXPECT_EQ(w.sizes.empty(), !w.no_size.empty());
    const double hip = *w.measures.hip_m;
    for (const int k : w.sizes) {
      const GarmentSize& size = p.input.sizes[static_cast<std::size_t>(k)];
      for (const Grade& g : p.input.grades) EXPECT_GE(easeOf(g, size, w.measures), g.least);
    }
    // No other size that is wide enough is nearer than the first.
    for (const GarmentSize& size : p.input.sizes) {
      if (easeOf(p.input.grades[0], size, w.measures) < 0 || easeOf(p.input.grades[1], size, w.measures) < 0.01)
        continue;
      ASSERT_FALSE(w.sizes.empty());
      EXPECT_LE(std::abs(*p.input.sizes[static_cast<std::size_t>(w.sizes[0])].girth_m[2] - hip),
                std::abs(*size.girth_m[2] - hip));
    }
  }
  std::size_t tried = 0;
  for (const Wearer& w : p.wearers) tried += w.sizes.size();
  EXPECT_EQ(s.variants.size(), tried);
  for (const Variant& v : s.variants) {
    const auto& made = std::get<ShortsGarment>(std::get<Case>(v.definition).garments[0].shape);
    const Wearer& w = p.wearers[static_cast<std::size_t>(v.levels[0])];
    const GarmentSize& size = p.input.sizes[static_cast<std::size_t>(v.levels[1])];
    // Its girth is that of the size: (1 + ease) of the body that the size is made for.
    EXPECT_NEAR((1 + made.ease) * *w.measures.hip_m, 1.06 * *size.girth_m[2], 1e-12) << v.folder;
    EXPECT_NEAR((1 + *made.waist_ease) * *w.measures.waist_m, 1.06 * *size.girth_m[1], 1e-12) << v.folder;
    EXPECT_EQ(made.inseam_m, size.label == "L" ? 0.22 : 0.20);
    EXPECT_TRUE(v.grid);
  }
}

TEST(StudyPopulation, WhomNoSizeGoesAroundIsToldHowMuchIsMissing) {
  PopulationInput in = sizedStudy().population->input;
  in.count = 40;
  in.sizes[2].girth_m[1] = 0.97;
  int without = 0;
  for (const Wearer& w : drawPopulation(in).wearers)
    if (w.sizes.empty()) {
      ++without;
      EXPECT_NE(w.no_size.find("cm too narrow for the"), std::string::npos) << w.no_size;
    }
  EXPECT_GT(without, 0);
  EXPECT_LT(without, 40);
}

TEST(StudyPopulation, MistakesAreSaidWithTheirLine) {
  EXPECT_NE(refusal(replaced(drawn, "\"ansur2\"", "\"caesar\"")).find("a.study.json:3: population.source"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(drawn, "\"count\": 5", "\"count\": 0")).find("population.count"), std::string::npos);
  EXPECT_NE(refusal(replaced(drawn, "\"pictures\"", "\"axes\": [], \"pictures\"")).find("excludes population"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(sized, "\"waist\": \"86 cm\"", "\"chest\": \"86 cm\"")).find("population.sizes[0].waist"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(sized, "\"label\": \"M\"", "\"label\": \"S\"")).find("names two sizes"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(sized, "garment.shorts.waist_ease", "garment.shorts.ease")).find("is graded twice"),
            std::string::npos);
  // A grade that leads to no key of the case is said at the study's line.
  EXPECT_NE(refusal(replaced(sized, "garment.shorts.waist_ease", "garment.shorts.waste_ease")).find("waste_ease"),
            std::string::npos);
}

/// Runs whose hips pay a part of their natural moment that grows with the wearer's mass, by size too.
std::vector<RunNumbers> runsOf(const Study& s) {
  std::vector<RunNumbers> runs;
  for (const Variant& v : s.variants) {
    const Wearer& w = s.population->wearers[static_cast<std::size_t>(v.levels[0])];
    RunNumbers r;
    r.good = true;
    r.recorded_to_s = r.planned_to_s = 1;
    r.crossings_dressed = 0;
    JointNumbers hip;
    hip.name = "hip_flexion_left";
    hip.label = "left hip (flexion)";
    hip.natural_Nm = 100;
    hip.peak_Nm = 0.1 * (w.measures.mass_kg - 40) + (v.levels.size() > 1 ? v.levels[1] : 0);
    hip.normal_N = 1;
    JointNumbers elbow;
    elbow.name = elbow.label = "elbow_flexion_left";
    r.joints = {hip, elbow};
    r.comfort = {{"waist", w.measures.mass_kg > 80 ? "amber" : "green", 1000, 2000, 4000, 9000, 1}};
    runs.push_back(r);
  }
  return runs;
}

TEST(StudyPopulation, SharesCountWhoIsSpared) {
  const Study& s = drawnStudy();
  std::vector<RunNumbers> runs = runsOf(s);
  runs[0].crossings_dressed = 2;
  runs[1].good = false;
  runs[1].why = "it did not go on";
  runs[2].checks = {{"Energy", 9, 5, "%", false}};
  const PopulationAnswer a = answerOf(s, runs);
  int green = 0, comfortable = 0;
  for (std::size_t i = 2; i < runs.size(); ++i) {
    green += *runs[i].joints[0].part() < 0.05;
    comfortable += runs[i].comfort[0].light == "green";
  }
  ASSERT_EQ(a.shares.size(), 4u);  // put on, hip, elbow, comfort; no knee was looked at
  EXPECT_EQ(a.shares[0].yes, 3);
  EXPECT_EQ(a.shares[0].no, 2);
  EXPECT_EQ(a.shares[1].what, "hip stays green");
  EXPECT_EQ(a.shares[1].yes, green);
  EXPECT_EQ(a.shares[1].no, 3 - green);
  EXPECT_EQ(a.shares[1].unknown, 2);
  EXPECT_EQ(a.shares[1].doubtful, *runs[2].joints[0].part() < 0.05 ? 1 : 0);
  EXPECT_EQ(a.shares[2].what, "elbow stays green");
  EXPECT_EQ(a.shares[2].yes, 3);
  // What no garment reaches is spared, and no news.
  EXPECT_TRUE(a.shares[1].touched);
  EXPECT_FALSE(a.shares[2].touched);
  EXPECT_EQ(a.sentence.find("elbow"), std::string::npos) << a.sentence;
  EXPECT_EQ(a.shares[3].yes, comfortable);
  // First whom it does not go on, then the heaviest; who has no run cannot be pictured.
  ASSERT_EQ(a.worst.size(), 3u);
  EXPECT_EQ(a.worst[0], 0u);
  std::size_t heaviest = 2;
  for (std::size_t i = 2; i < runs.size(); ++i)
    if (s.population->wearers[i].measures.mass_kg > s.population->wearers[heaviest].measures.mass_kg) heaviest = i;
  EXPECT_EQ(a.worst[1], heaviest);
  EXPECT_TRUE(a.sentence.starts_with("3 of 5 wearers can put it on"));
}

TEST(StudyPopulation, AFabricStretchedBeyondItsCardDoesNotGoOn) {
  const Study& s = drawnStudy();
  std::vector<RunNumbers> runs = runsOf(s);
  for (RunNumbers& r : runs) r.stretch = {{0.02, 0.1, 0.5, false, "", ""}};
  EXPECT_EQ(answerOf(s, runs).shares[0].yes, 5);  // a law's range is no limit of the card
  EXPECT_FALSE(answerOf(s, runs).judged_stretch);
  runs[4].stretch[0] = {0.2, 0.1, 0.25, true, "", "weft"};
  const PopulationAnswer a = answerOf(s, runs);
  EXPECT_EQ(a.shares[0].yes, 4);
  EXPECT_EQ(a.wearers[4].taken()->why, "the fabric is stretched by 25 % along its weft, and stands 20 %");
}

TEST(StudyPopulation, TheSizeIsTheOneThatGoesOnAndBurdensLeast) {
  const Study& s = sizedStudy();
  std::vector<RunNumbers> runs = runsOf(s);
  PopulationAnswer a = answerOf(s, runs);
  for (std::size_t w = 0; w < a.wearers.size(); ++w)
    if (const Fitting* f = a.wearers[w].taken()) {
      for (const int tried : s.population->wearers[w].sizes) EXPECT_LE(f->size, tried);
    }
  // Where that one does not go on, another does.
  std::size_t two = 0;
  while (two < a.wearers.size() && a.wearers[two].fittings.size() < 2) ++two;
  ASSERT_LT(two, a.wearers.size());
  runs[a.wearers[two].taken()->variant].good = false;
  const int before = a.wearers[two].taken()->size;
  a = answerOf(s, runs);
  EXPECT_TRUE(a.wearers[two].taken()->on());
  EXPECT_NE(a.wearers[two].taken()->size, before);
}

TEST(StudyPopulation, TheTableHasARowForEachTry) {
  const Study& s = sizedStudy();
  const PopulationAnswer a = answerOf(s, runsOf(s));
  const std::string csv = populationCsv(s, a);
  std::size_t rows = 0, expected = 1;
  for (const char c : csv) rows += c == '\n';
  for (const WearerAnswer& w : a.wearers) expected += std::max<std::size_t>(1, w.fittings.size());
  EXPECT_EQ(rows, expected);
  const auto j = populationJson(s, a);
  EXPECT_EQ(j.at("wearers").size(), 4u);
  EXPECT_EQ(j.at("shares").at(0).at("yes").get<int>() + j.at("shares").at(0).at("no").get<int>(), 4);
}

/// The page says what was found, and draws it.
TEST(StudyPopulation, ThePageAnswersFirst) {
  const Study& s = drawnStudy();
  const Comparison c = compare(s, runsOf(s));
  ASSERT_TRUE(c.population);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_NE(page.find("5 of 5 wearers can put it on"), std::string::npos);
  EXPECT_NE(page.find("How the burden is spread"), std::string::npos);
  EXPECT_NE(page.find("Where it presses"), std::string::npos);
  EXPECT_NE(page.find("man_01/report.html"), std::string::npos);
  EXPECT_EQ(page.find("baseline"), std::string::npos);
}

}  // namespace
}  // namespace gambeson::study
