/// What check says of how garments fit: the girths of panels and of sleeves, and cells that are folded.

#include <gtest/gtest.h>

#include <regex>

#include "cases/pattern/pattern_file.hpp"
#include "cases/wear/results/girths.hpp"
#include "cases/wear/run/run.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/motion/step.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/flat/panel_fit.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

std::string caseOf(const std::string& garment) {
  return R"json({"name": "girths", "garment": )json" + garment + R"json(,
  "fabric": {"thickness": "0.5 mm", "surface_density": "200 gsm", "young": "1 MPa", "poisson": 0.2,
             "bending": {"law": "linear", "rigidity": "1e-5 N m"}},
  "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}},
  "contact": {"friction": 0.5},
  "dressing": {"layer_by_layer": true, "settle": "0.1 s"}})json";
}

/// The numbers of the first line that has a match.
std::vector<double> numbersIn(const std::vector<std::string>& lines, const std::string& form) {
  for (const std::string& line : lines)
    if (std::smatch m; std::regex_search(line, m, std::regex(form))) {
      std::vector<double> found;
      for (std::size_t k = 1; k < m.size(); ++k) found.push_back(std::stod(m[k]));
      return found;
    }
  return {};
}

TEST(CheckGirths, OfPanelsWithTheirEaseBeforeTheyAreSewn) {
  const Folder folder;
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, standing(human));
  folder.write("pattern.json", patternText(region_patterns::skirt({})));
  const std::vector<std::string> lines = checkRun(
      readCase(folder.write("case.json", caseOf(R"({"pattern": {"path": "pattern.json", "cell": "60 mm"}})"))));
  const std::vector<double> hip =
      numbersIn(lines, R"(girth of the hip: body ([0-9.]+) cm; panels ([0-9.]+) cm at ([0-9.]+) m, where the body is )"
                       R"(([0-9.]+) cm: ease (-?[0-9.]+) cm \((-?[0-9.]+) %\))");
  ASSERT_EQ(hip.size(), 6u) << testing::PrintToString(lines);
  EXPECT_GT(hip[1], 4 * 21.5) << "between its waist and its hem";
  EXPECT_LT(hip[1], 4 * 30);
  EXPECT_NEAR(hip[2], form.origin(form.link("thigh_left")).z, 0.006);
  EXPECT_NEAR(hip[0], hip[3], 0.2) << "measured in the plane of the hip joints both times";
  EXPECT_NEAR(hip[4], hip[1] - hip[3], 0.11);
  EXPECT_NEAR(hip[5], 100 * hip[4] / hip[3], 0.11);
  EXPECT_EQ(numbersIn(lines, R"(that nothing is seen to go around: .*left thigh ([0-9.]+) cm)").size(), 1u);
}

/// Sleeves beside the chest are no part of what goes around it, and an arm is gone around by fewer pieces than there
/// are directions to look in: both were missed before.
TEST(CheckGirths, OfAShirtAreToldFromThoseOfItsSleeves) {
  const Folder folder;
  const auto s = buildScenario(readCase(
      folder.write("case.json", caseOf(R"({"shirt": {"sleeve_length": "30 cm", "cell": "35 mm", "ease": "10 %"}})"))));
  std::vector<Vec3> x(static_cast<std::size_t>(s->model->surface.size()));
  s->model->surface.W.multiply<Vec3>(s->model->cloth->rest(), x);
  std::map<std::string, GirthMeasure> at;
  for (const GirthMeasure& g : girthsAt(*s, x, s->start_s)) at.emplace(g.zone, g);
  const auto ease = [&](const std::string& zone) {
    const GirthMeasure& g = at.at(zone);
    EXPECT_EQ(g.worn.size(), 1u) << zone;
    return g.worn.empty() ? 0 : g.worn[0].rest_m / g.body_m - 1;
  };
  // Whole sleeves would more than double it. The strip of a sleeve between an arm that hangs and the chest still counts
  // to the chest: it lies nearer to it.
  EXPECT_GT(ease("chest"), 0.05);
  EXPECT_LT(ease("chest"), 0.5);
  EXPECT_NEAR(ease("waist"), 0.10, 0.08);
  for (const char* arm : {"upper_arm_left", "upper_arm_right"}) {
    EXPECT_GT(ease(arm), 0.05) << arm;
    EXPECT_LT(ease(arm), 0.8) << arm;
  }
  // Pulled wider by a tenth than it was cut, it is worn longer and not cut longer.
  const double cut_m = at.at("waist").worn[0].rest_m;
  for (Vec3& p : x) p.x *= 1.1, p.y *= 1.1;
  for (const GirthMeasure& g : girthsAt(*s, x, s->start_s))
    if (g.zone == "waist") {
      ASSERT_EQ(g.worn.size(), 1u);
      EXPECT_NEAR(g.worn[0].rest_m, cut_m, 1e-6);
      EXPECT_NEAR(g.worn[0].length_m, 1.1 * cut_m, 2e-3);
    }
}

/// With cells of 70 mm one of a sleeve turns by 96 degrees; with the cell that is said to do none is folded.
TEST(CheckGirths, AFoldedCellIsSaidWithTheLargestThatIsNone) {
  const Folder folder;
  const std::string form =
      R"(a cell of "sleeve[^"]*" turns by ([0-9]+) degrees and is folded.*the largest "cell" without one is ([0-9.]+) mm)";
  const Case coarse =
      readCase(folder.write("case.json", caseOf(R"({"shirt": {"sleeve_length": "50 cm", "cell": "70 mm"}})")));
  const std::vector<double> said = numbersIn(buildScenario(coarse)->notes, form);
  ASSERT_EQ(said.size(), 2u);
  EXPECT_GT(said[0], 95);
  EXPECT_LT(said[1], 70);
  EXPECT_GE(said[1], 35);
  const Case finer = readCase(folder.path() / "case.json", {"garment.shirt.cell=" + std::to_string(1e-3 * said[1])});
  const auto fine = buildScenario(finer);
  for (const std::string& note : fine->notes) EXPECT_EQ(note.find("is folded"), std::string::npos) << note;
}

}  // namespace
}  // namespace gambeson
