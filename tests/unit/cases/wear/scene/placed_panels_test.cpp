/// Panels that have regions and no placements start around the wearers of cases without crossing anything.
#include <gtest/gtest.h>

#include "cases/pattern/pattern_file.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"
#include "core/motion/step.hpp"
#include "human/manikin/manikin.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

using namespace region_patterns;

// clang-format off
const std::string regions_case = R"json({
  "name": "regions",
  "garment": {"pattern": {"path": "pattern.json", "cell": "40 mm"}},
  "fabric": {"thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa", "poisson": 0.2,
             "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.5},
  "dressing": {"layer_by_layer": true, "settle": "0.1 s"}
})json";
// clang-format on

std::filesystem::path written(const Folder& folder, const FlatPattern& pattern) {
  folder.write("pattern.json", patternText(pattern));
  return folder.write("case.json", regions_case);
}

/// What passes through what in the first step of a garment that is put on by itself.
int crossings(const Case& c) {
  const std::unique_ptr<Scenario> s = buildAlone(c, c, 0);
  StepWork work;
  const State start = startOf(*s, work);
  State next;
  const StepReport r = step(*s->model, *s->stage, start, 1e-6, next, work);
  return r.intersections + r.inside;
}

/// A jumpsuit has the panels of a shirt and of trousers.
TEST(PlacedPanels, CrossNothingOnAnyManikin) {
  for (const std::string& manikin : manikinNames()) {
    const Folder folder;
    Size size;
    size.scale = manikin.starts_with("female") ? 0.92 : 1;
    const Case c = readCase(written(folder, jumpsuit(size)), {"human.manikin=" + manikin});
    EXPECT_EQ(crossings(c), 0) << manikin;
  }
}

TEST(PlacedPanels, CrossNothingOnASkin) {
  const Folder folder;
  const Case c = readCase(written(folder, jumpsuit({})), {R"(human.skin={"cell": "30 mm"})"});
  EXPECT_EQ(crossings(c), 0);
}

/// The arms are held aside while a shirt is put on, and hang again when it settles, also in a run that is resumed then;
/// a skirt asks nothing of them.
TEST(PlacedPanels, TheArmsAreAsideWhereTheyAreInTheWay) {
  const Folder folder;
  const Case with_shirt = readCase(written(folder, shirt({})));
  const auto s = buildScenario(with_shirt);
  const auto joint = static_cast<std::size_t>(s->human->skeleton.joint("shoulder_abduction_left"));
  const double hanging = s->motion->at(0).q[joint];
  EXPECT_LT(s->start_s, -0.05);
  EXPECT_NEAR(s->stage->postureAt(s->start_s).q[joint], hanging, 1e-12);
  EXPECT_NEAR(s->stage->postureAt(0).q[joint], hanging, 1e-12);
  const Posture on = puttingOnPosture(with_shirt, with_shirt.garments[0], *s->human);
  EXPECT_GT(on.q[joint], hanging + 0.3) << "it is closed there";
  EXPECT_FALSE(armsAside(readCase(folder.path() / "case.json", {"dressing.settle=0"}))) << "no time to come down";
  const Folder other;
  EXPECT_FALSE(armsAside(readCase(written(other, skirt({})))));
}

TEST(PlacedPanels, WhatIsTooNarrowIsSaidBeforeTheRun) {
  const Folder folder;
  Size narrow;
  narrow.quarter_waist = narrow.quarter_hem = 0.2;
  const Case c = readCase(written(folder, skirt(narrow)));
  const auto s = buildScenario(c);
  std::vector<GarmentFit> fits;
  draftGarments(c, &*s->human, &fits);
  ASSERT_EQ(fits.size(), 1u);
  ASSERT_EQ(fits[0].notes.size(), 1u);
  const std::string& note = fits[0].notes[0];
  EXPECT_NE(note.find("at the hip"), std::string::npos) << note;
  EXPECT_NE(note.find(" cm short"), std::string::npos) << note;
}

TEST(PlacedPanels, WithoutPlaceTheCaseIsRefused) {
  const Folder folder;
  FlatPattern pattern = skirt({});
  pattern.panels[1].region = "skirt_bak";
  try {
    readCase(written(folder, pattern));
    ADD_FAILURE();
  } catch (const InputError& e) {
    const std::string text = e.what();
    EXPECT_NE(text.find("pattern.json"), std::string::npos) << text;
    EXPECT_NE(text.find("panel \"back\" has no placement"), std::string::npos) << text;
    EXPECT_NE(text.find("did you mean \"skirt_back\"?"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace gambeson
