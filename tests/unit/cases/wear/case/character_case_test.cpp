/// Characters from files in cases: the same path as a skin of our own.

#include <gtest/gtest.h>

#include "cases/wear/case/human.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "human/skin/make_skin.hpp"
#include "unit/cases/example.hpp"
#include "unit/human/character/character_body.hpp"

namespace gambeson {
namespace {

const test::CharacterBody& man() {
  static const test::CharacterBody c = test::characterBody(90, 0.02);
  return c;
}

// clang-format off
const std::string worn = R"json({
  "name": "character",
  "garment": {"shorts": {"cell": "4 cm"}},
  "fabric": {
    "thickness": "1 mm", "density": "1440 kg/m^3", "young": "0.5 MPa",
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "human": {"character": {"file": "man.gltf", "like": "male_p50"}, "motion": {"walk": {"strides": 1}}},
  "contact": {"friction": 0.5}
})json";
// clang-format on

TEST(CharacterCase, WearsShortsThatAreDraftedOnItAndWalks) {
  const Folder folder;
  writeGltf(folder.path() / "man.gltf", man().bones, {man().part()});
  const Case c = readCase(folder.write("case.json", worn));
  const auto s = buildScenario(c);
  ASSERT_TRUE(s->hasSkin());
  ASSERT_EQ(s->model->obstacles.size(), 1u);
  EXPECT_TRUE(s->model->obstacles[0].deforms);
  EXPECT_NE(s->facts[0].find("man.gltf: bones as in the map unreal, T-pose (arms 90"), std::string::npos)
      << s->facts[0];
  // Two mates of one body: drafted on the character, the shorts are as large as on the manikin's own skin.
  Case own = c;
  own.human->character.reset();
  own.human->manikin = "male_p50";
  own.human->skin = SkinOptions{.cell_m = 0.02};
  const Human human = humanOf(*own.human);
  const auto area = [](const Garment& g) {
    double sum = 0;
    for (const double a : controlAreas(g)) sum += a;
    return sum;
  };
  const double there = area(draftGarments(c, &*s->human)[0]), here = area(draftGarments(own, &human)[0]);
  EXPECT_NEAR(there / here, 1, 0.02);
  EXPECT_GT(s->mean_velocity_m_per_s.x, 1);
}

TEST(CharacterCase, IsAnotherCaseWithAnotherBody) {
  const Folder folder;
  const auto identity = [&](const test::CharacterBody& c) {
    writeGltf(folder.path() / "man.gltf", c.bones, {c.part()});
    return caseIdentity(readCase(folder.write("case.json", worn)));
  };
  test::CharacterBody fat = man();
  fat.skin.vertices[100] *= 1.01;
  const std::string lean = identity(man());
  EXPECT_EQ(identity(man()), lean);
  EXPECT_NE(identity(fat), lean);  // only the buffer beside the .gltf differs
}

TEST(CharacterCase, ItsMeshAsAnObstacleIsAnotherCaseWithAnotherBuffer) {
  const Folder folder;
  const std::string text =
      R"({"name": "worn", "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 4, "cells_v": 4}},
    "fabric": {"name": "f", "thickness": "1 mm", "density": "400 kg/m^3", "young": "1 MPa", "poisson": 0.2,
               "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
    "obstacles": [{"name": "man", "mesh": {"file": "man.gltf", "position": [0, 0, -3]}}],
    "contact": {"friction": 0.3}, "time": {"duration": "0.1 s"}})";
  const auto identity = [&](const test::CharacterBody& c) {
    writeGltf(folder.path() / "man.gltf", c.bones, {c.part()});
    return caseIdentity(readCase(folder.write("case.json", text)));
  };
  test::CharacterBody fat = man();
  fat.skin.vertices[100] *= 1.01;
  EXPECT_NE(identity(fat), identity(man()));
}

TEST(CharacterCase, SaysWhatIsWrong) {
  const Folder folder;
  writeGltf(folder.path() / "man.gltf", man().bones, {man().part()});
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& words) {
    try {
      buildScenario(readCase(folder.write("case.json", replaced(worn, from, to))));
      ADD_FAILURE() << to << " was accepted; expected: " << words;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused("\"motion\"", "\"skin\": {}, \"motion\"", "human.skin: is made around a manikin");
  refused("\"motion\"", "\"manikin\": \"male_p50\", \"motion\"", "human");
  refused("\"like\": \"male_p50\"", "\"like\": \"hero\"", "human.character.like");
  refused("\"like\": \"male_p50\"", "\"height\": \"4 m\"", "human.character.height");
  refused("\"like\": \"male_p50\"", "\"map\": \"maya\"", "there is no map 'maya'");
  refused("\"like\": \"male_p50\"", "\"skeleton\": \"man.gltf\"", "skeleton: goes with MakeHuman's mesh");
  refused("man.gltf", "woman.gltf", "woman.gltf");
}

}  // namespace
}  // namespace gambeson
