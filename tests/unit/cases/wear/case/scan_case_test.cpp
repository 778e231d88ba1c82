/// Wearers in cases by measures and by scans: read, written again, worn.

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "cases/wear/case/human.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/scene/garments.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/cloth/draft/areas.hpp"
#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/skin/make_skin.hpp"
#include "unit/cases/example.hpp"
#include "unit/human/scan/scan_body.hpp"

namespace gambeson {
namespace {

std::string caseOf(const std::string& wearer) {
  return R"json({
  "name": "wearer",
  "garment": {"shorts": {"cell": "4 cm"}},
  "fabric": {
    "thickness": "1 mm", "density": "1440 kg/m^3", "young": "0.5 MPa",
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "human": {)json" +
         wearer + R"json(, "motion": {"walk": {"strides": 1}}},
  "contact": {"friction": 0.5}
})json";
}

TEST(WearerCase, MeasuresAreWrittenAgainAndTheirGirthsTold) {
  const Folder folder;
  const Case c = readCase(folder.write(
      "case.json", caseOf(R"("manikin": {"sex": "female", "stature": "168 cm", "mass": "63 kg", "waist": "78 cm"})")));
  ASSERT_TRUE(c.human->measures);
  EXPECT_NEAR(*c.human->measures->waist_m, 0.78, 1e-12);
  EXPECT_FALSE(c.human->measures->chest_m);
  const Case again = readCase(folder.write("again.json", writeCase(c)));
  EXPECT_EQ(writeCase(again), writeCase(c));
  const auto s = buildScenario(c);
  EXPECT_NE(s->facts[0].find("manikin: waist 78.0 cm, asked for 78.0 cm"), std::string::npos) << s->facts[0];
}

TEST(WearerCase, AScanWearsShortsAsLargeAsTheBodysThatItIsOf) {
  const Folder folder;
  writeMesh(test::scanBody("male_p50", 45).mesh, folder.path() / "man.obj");
  const Case c = readCase(folder.write("case.json", caseOf(R"("scan": {"file": "man.obj"})")));
  const Case again = readCase(folder.write("again.json", writeCase(c)));
  EXPECT_EQ(writeCase(again), writeCase(c));
  const auto s = buildScenario(c);
  ASSERT_TRUE(s->hasSkin());
  const auto says = [&](const std::string& words) {
    for (const std::string& note : s->facts)
      if (note.find(words) != std::string::npos) return true;
    return false;
  };
  EXPECT_TRUE(says("scan man.obj: taken to be in millimetres"));
  EXPECT_TRUE(says("scan man.obj: A-pose"));
  EXPECT_TRUE(says("scan man.obj: girths in cm as scanned, and standing: hip "));
  Case own = c;
  own.human->scan.reset();
  own.human->manikin = "male_p50";
  own.human->skin = SkinOptions{.cell_m = 0.02};
  const Human human = humanOf(*own.human);
  const auto area = [](const Garment& g) {
    double sum = 0;
    for (const double a : controlAreas(g)) sum += a;
    return sum;
  };
  EXPECT_NEAR(area(draftGarments(c, &*s->human)[0]) / area(draftGarments(own, &human)[0]), 1, 0.05);
}

TEST(WearerCase, CheckSaysTheGirthsOfAScanAndTheEaseOfWhatItWears) {
  const Folder folder;
  writeMesh(test::scanBody("male_p50", 45).mesh, folder.path() / "man.obj");
  const Case c = readCase(folder.write("case.json", caseOf(R"("scan": {"file": "man.obj"})")));
  const std::vector<std::string> lines = checkRun(c);
  // The match of a line, as numbers.
  const auto numbers = [&](const std::string& form) {
    std::vector<double> found;
    for (const std::string& line : lines)
      if (std::smatch m; std::regex_search(line, m, std::regex(form)))
        for (std::size_t k = 1; k < m.size(); ++k) found.push_back(std::stod(m[k]));
    return found;
  };
  const auto scanned = numbers(R"(scan man\.obj: girths in cm as scanned, and standing: hip ([0-9.]+), ([0-9.]+))"),
             worn = numbers(
                 R"(girth of the hip: body ([0-9.]+) cm; garment ([0-9.]+) cm, ease ([0-9.]+) cm \(([0-9.]+) %\))"),
             bare = numbers(R"(that nothing is seen to go around: .*\bchest ([0-9.]+) cm)");
  ASSERT_EQ(scanned.size(), 2u);
  ASSERT_EQ(worn.size(), 4u);
  EXPECT_EQ(bare.size(), 1u);
  EXPECT_NEAR(worn[0], scanned[1], 0.11);
  EXPECT_NEAR(worn[1] - worn[0], worn[2], 0.11);
  EXPECT_NEAR(100 * worn[2] / worn[0], worn[3], 0.11);
  EXPECT_GT(worn[2], 1);
}

TEST(WearerCase, AScanThatIsNoneNamesItsFileAndWhatIsMissing) {
  const Folder folder;
  folder.write("box.obj", "v 0 0 0\nv 1 0 0\nv 0 1.8 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  try {
    readCase(folder.write("case.json", caseOf(R"("scan": {"file": "box.obj"})")));
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, (folder.path() / "box.obj").string());
    EXPECT_EQ(e.where().key, "up");
  }
}

}  // namespace
}  // namespace gambeson
