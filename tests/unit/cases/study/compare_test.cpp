/// Studies: what is made of the numbers of their runs.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cases/study/compare.hpp"
#include "unit/cases/study/example.hpp"

namespace gambeson::study {
namespace {

using namespace tested;

TEST(Study, ComparesWhatItsRunsLeft) {
  const Study s = read(good);
  const Comparison c = compare(s, numbersOf(s));
  EXPECT_EQ(c.main_axis, 0);
  EXPECT_EQ(c.mesh_axis, 1);
  EXPECT_EQ(c.mesh_level, 1);
  ASSERT_EQ(c.groups.size(), 2u);
  EXPECT_EQ(c.groups[0].label, "smooth");
  EXPECT_EQ(c.groups[0].members.size(), 3u);
  EXPECT_EQ(c.groups[0].joints, std::vector<std::string>{"hip_flexion_left"});
  // 0.65/2 + 0.31/8 + 0.04 of the baseline's 1.
  const auto at = [&](const std::string& folder) {
    return static_cast<std::size_t>(&variant(s, folder) - s.variants.data());
  };
  const JointRatio& thin = c.ratios[at("thickness_0.5__fine__smooth")][0];
  EXPECT_NEAR(thin.peak, 0.325 + 0.31 / 8 + 0.04, 1e-12);
  EXPECT_NEAR(thin.rms, 0.325 + 0.31 / 8 + 0.04, 1e-12);
  EXPECT_NEAR(thin.likeness.correlation, 1, 1e-12);
  EXPECT_NEAR(*peakAboveStanding(c.runs[0], c.runs[0].joints[0]), std::abs(c.runs[0].joints[0].peak_Nm) + 0.5, 1e-12);

  ASSERT_FALSE(c.elasticities.empty());
  const ElasticityRow& e = c.elasticities[0];
  EXPECT_EQ(e.setting, "coarse, smooth");
  EXPECT_EQ(e.joint, "the highest");
  // A part p of the torque changes it from 1 - 0.2 p to 1 + 0.2 p.
  const auto part = [](double p) { return std::log((1 + 0.2 * p) / (1 - 0.2 * p)) / std::log(1.2 / 0.8); };
  EXPECT_NEAR(*e.e.bending, part(0.31), 1e-9);
  EXPECT_NEAR(*e.e.drag, part(0.04), 1e-9);
  EXPECT_NEAR(*e.e.sum(), part(0.31) + part(0.22) + part(0.28) + part(0.15) + part(0.04), 1e-9);
  EXPECT_NEAR(*e.e.thicknessExponent(), 3 * part(0.31) + part(0.22) + part(0.28) + part(0.15), 1e-9);
  EXPECT_TRUE(e.measured);
  for (const ElasticityRow& row : c.elasticities) EXPECT_EQ(row.joint.find("elbow"), std::string::npos);
  // What to change goes by the largest, where the torque is largest.
  const std::string page = studyPage(s, c, {}, {});
  const std::size_t at_change = page.find("What to change");
  ASSERT_NE(at_change, std::string::npos);
  EXPECT_NE(page.find("<span class=\"q\">10 %</span> less rigidity of bending takes off <span class=\"q\">3.1 %</span>",
                      at_change),
            std::string::npos)
      << page.substr(at_change, 900);
  // Twice as much where it is rough; the fine mesh has 5 % more.
  const std::size_t at_where = page.find("Where it costs most</h3>");
  ASSERT_NE(at_where, std::string::npos);
  EXPECT_LT(page.find("rough: ", at_where), page.find("smooth: ", at_where)) << page.substr(at_where, 400);
  EXPECT_NE(
      page.find("Finer cells gave larger peaks in all pairs of runs, by <span class=\"q\">5 %</span>: what stands "
                "here is rather too small."),
      std::string::npos);

  ASSERT_EQ(c.meshes.size(), 6u);
  for (const MeshRow& m : c.meshes) {
    EXPECT_NEAR(m.difference, 1 / 1.05 - 1, 1e-12);
    EXPECT_EQ(m.coarse_points, 16);
  }
  // Rough is worse: 8.4 Nm of 100 at thickness 1, 3.39 at 0.5, 5.39 at 0.75.
  EXPECT_NEAR(*c.input.mesh_error, 1.25 * (1 - 1 / 1.05) / (25.0 / 16 - 1), 1e-12);
  ASSERT_EQ(c.input.options.size(), 3u);
  EXPECT_EQ(c.verdict.take, 0);
  EXPECT_EQ(c.input.options[0].name, "thickness x 0.5");
  EXPECT_EQ(c.input.baseline, 2);
  ASSERT_EQ(c.input.exponents.size(), 2u);
  EXPECT_EQ(c.input.exponents[0].motion, "smooth");
  // 0.75 comes below 5 % with an error of -7 %, less than the 10.6 % of the mesh.
  EXPECT_NEAR(*c.verdict.holds_up_to,
              1 - 0.05 / (std::abs(c.runs[at("thickness_0.75__fine__rough")].joints[0].peak_Nm) / 100), 1e-6);
  EXPECT_EQ(c.verdict.surety, Surety::no) << c.verdict.choice;
}

const std::string motions = R"({
  "name": "how thick", "case": "cloth.json",
  "axes": [
    {"name": "motion", "sets": [{"contact.friction": 0.1}, {"contact.friction": 0.4}], "labels": ["walking", "stairs"]},
    {"path": "factors.thickness", "values": [0.5, 1]}
  ],
  "baseline": {"motion": "walking", "thickness": "1"},
  "variants": [{"label": "fine", "at": {"motion": "stairs"}, "finer": true,
                "set": {"garment.sheet.cells_u": 3, "garment.sheet.cells_v": 3}}]
})";

/// Stairs cost twice as much as walking, at both thicknesses: a ratio to walking would have that in it.
TEST(Study, AMotionIsComparedWithItself) {
  const Study s = read(motions);
  EXPECT_EQ(s.variants[static_cast<std::size_t>(variant(s, "stairs__thickness_0.5").baseline)].folder,
            "stairs__thickness_1");
  EXPECT_EQ(s.variants[static_cast<std::size_t>(variant(s, "walking__thickness_0.5").baseline)].folder,
            "walking__thickness_1");
  const Comparison c = compare(s, numbersOf(s));
  ASSERT_EQ(c.groups.size(), 2u);
  const double thin = 0.325 + 0.31 / 8 + 0.04;
  for (const VariantGroup& g : c.groups) {
    ASSERT_EQ(g.members.size(), 2u);
    EXPECT_EQ(g.baseline, static_cast<int>(g.members[1]));
    EXPECT_NEAR(c.ratios[g.members[0]][0].peak, thin, 1e-12);
    EXPECT_NEAR(c.ratios[g.members[0]][0].likeness.correlation, 1, 1e-12);
  }
  // One number is told once: the verdict has the ratio of the table.
  ASSERT_EQ(c.input.options[0].costs.size(), 2u);
  for (const Option::Cost& cost : c.input.options[0].costs) EXPECT_NEAR(*cost.ratio, thin, 1e-12);
  // Without a baseline named, the motion is no design either.
  Study plain = read(replaced(replaced(motions, R"("baseline": {"motion": "walking", "thickness": "1"},)", ""),
                              R"("path": "factors.thickness", "values": [0.5, 1])",
                              R"("name": "grip", "path": "contact.tolerance", "values": [0.001, 0.002])"));
  EXPECT_EQ(plain.compared, std::vector<int>{1});
  // Motions alone are compared with each other.
  const Study alone = read(replaced(motions, R"({"motion": "walking", "thickness": "1"})", R"({"motion": "walking"})"));
  EXPECT_EQ(alone.variants[static_cast<std::size_t>(variant(alone, "stairs__thickness_1").baseline)].folder,
            "walking__thickness_1");
}

/// One run on a finer mesh, whose torque is 5 % larger, is the error bar of all.
TEST(Study, AFinerRunGivesTheErrorBar) {
  const Study s = read(motions);
  EXPECT_TRUE(variant(s, "stairs__thickness_1__fine").finer);
  const Comparison c = compare(s, numbersOf(s));
  ASSERT_EQ(c.meshes.size(), 1u);
  EXPECT_EQ(c.meshes[0].setting, "stairs, thickness x 1");
  EXPECT_EQ(c.meshes[0].coarse_points, 16);
  EXPECT_EQ(c.meshes[0].fine_points, 25);
  EXPECT_NEAR(c.meshes[0].difference, 1 / 1.05 - 1, 1e-12);
  EXPECT_NEAR(*c.input.mesh_error, 1.25 * 0.05 * 25 / (25 - 16), 1e-12);
  EXPECT_EQ(c.input.mesh_where, "stairs, thickness x 1");
  // It is no option of its own.
  EXPECT_EQ(c.input.options.size(), 2u);
  EXPECT_EQ(c.groups[1].members.size(), 2u);
  const Study none = read(replaced(motions, R"("finer": true)", R"("finer": false)"));
  EXPECT_FALSE(compare(none, numbersOf(none)).input.mesh_error);
}

/// The baseline is first and every level keeps its place, whichever runs a chart has.
TEST(Study, ALevelLooksTheSameEverywhere) {
  const Study s = read(replaced(motions, "[0.5, 1]", "[0.5, 1, 2]"));
  const Comparison c = compare(s, numbersOf(s));
  for (std::size_t i = 0; i < s.variants.size(); ++i)
    EXPECT_EQ(memberOrder(s, c, i), s.variants[i].levels[1] == 1 ? 0u : s.variants[i].levels[1] == 0 ? 1u : 2u);
  const std::string page = studyPage(s, c, {}, {});
  std::size_t charts = 0;
  for (std::size_t at = 0; (at = page.find("data-name=\"thickness x ", at)) != std::string::npos; ++at, ++charts) {
    const std::string path = page.substr(page.rfind('<', at), at - page.rfind('<', at) + 40);
    const char* wanted = path.find("\"thickness x 1\"") != std::string::npos     ? "left"
                         : path.find("\"thickness x 0.5\"") != std::string::npos ? "right"
                                                                                 : "third";
    EXPECT_NE(path.find(std::string("series ") + wanted), std::string::npos) << path;
  }
  EXPECT_EQ(charts, 6u);
}

/// The joint of the largest torque has the largest natural moment; the other one decides, and both are shown.
TEST(Study, TheLightIsThatOfTheJointThatDecides) {
  const Study s = read(motions);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (RunNumbers& r : runs) {
    JointNumbers weak = r.joints[0];
    weak.name = "hip_flexion_right", weak.label = "right hip (flexion)";
    weak.peak_Nm *= 0.5;
    weak.natural_Nm = 10;
    for (double& t : weak.torque_Nm) t *= 0.5;
    JointNumbers idle = weak;
    idle.name = "hip_rotation_left", idle.label = "left hip (rotation)";
    idle.peak_Nm *= 0.1;
    idle.natural_Nm = 1000;
    r.joints.insert(r.joints.end(), {weak, idle});
  }
  const Comparison c = compare(s, runs);
  EXPECT_EQ(c.groups[0].joints, (std::vector<std::string>{"hip_flexion_right", "hip_flexion_left"}));
  EXPECT_EQ(worstCost(c.input.options[0])->joint, "right hip (flexion)");
  EXPECT_EQ(c.verdict.light, Light::red);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_NE(page.find("left hip (flexion)"), std::string::npos);
  EXPECT_EQ(page.find("left hip (rotation)"), std::string::npos);
  // Nor is it left out where its torque is small and all is green.
  for (RunNumbers& r : runs) r.joints[0].natural_Nm = 1e4, r.joints[2].peak_Nm *= 0.2, r.joints[2].natural_Nm = 100;
  EXPECT_EQ(compare(s, runs).groups[0].joints, (std::vector<std::string>{"hip_flexion_right", "hip_flexion_left"}));
}

/// What a reader must know to read the numbers stands beside them.
TEST(Study, ThePageSaysHowItsNumbersAreMeant) {
  const Study s = read(motions);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (RunNumbers& r : runs) {
    JointNumbers& j = r.joints[0];
    r.counted_from_s = 0.2;
    j.label = "left hip (flexion)";
    j.rate_at_peak = j.peak_Nm > 0 ? 1 : -1;
    j.foot_part = 0.63;
    j.lever_m = 0.28;
    r.stress = {{"trunk", 1, 2, 3, 4, 0.031, 0.46}, {"leg", 1, 2, 3, 4, 0.02, 0.1}};
  }
  EXPECT_EQ(runs[0].p99_strain(), 0.031);
  const std::string page = studyPage(s, compare(s, runs), {}, {});
  for (const char* text :
       {"means 0.5 times the thickness that the garment was designed with, in every garment",
        "(walking from 0.20 s on; stairs from 0.20 s on)", "the shaded start before it is shown but not judged",
        "natural 100 Nm<br>foot bears 63 %,<br>28 cm off the joint", "<br>against the motion</small>",
        ", against the motion</text>", "hinders while the joint flexes",
        "Nobody states how far this fabric may be stretched"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("with the motion</"), std::string::npos);
  for (RunNumbers& r : runs) r.joints[0].rate_at_peak *= -1;
  EXPECT_NE(studyPage(s, compare(s, runs), {}, {}).find("<br>with the motion</small>"), std::string::npos);
}

TEST(Study, FailingChecksAreToldInWords) {
  const Study s = read(motions);
  std::vector<RunNumbers> runs = numbersOf(s);
  runs[0].checks = {{"Penetration between samples", 0.3, 0.2, "mm", false}, {"Energy", 1, 5, "%", true}};
  runs[1].checks = {{"Penetration between samples", 0.4, 0.2, "mm", false}};
  Comparison c = compare(s, runs);
  ASSERT_EQ(c.input.doubts.size(), 1u);
  EXPECT_EQ(c.input.doubts[0].text,
            "between its contact points the cloth dips up to 0.40 mm (allowed: 0.20 mm) into the skin, thinnest cloth "
            "1.0 mm");
  EXPECT_EQ(c.input.doubts[0].check, "Penetration between samples");
  EXPECT_EQ(c.input.doubts[0].runs.names, (std::vector<std::string>{s.variants[0].label, s.variants[1].label}));
  EXPECT_EQ(c.input.doubts[0].runs.options, (std::vector<int>{0, 1}));
  EXPECT_FALSE(c.input.options[0].trust.whole());
  EXPECT_FALSE(c.input.doubts[0].order);
  EXPECT_EQ(c.input.failing_runs, 2);
  std::string page = studyPage(s, c, {}, {});
  EXPECT_EQ(page.find("role=\"alert\""), std::string::npos);  // it does not touch the order
  EXPECT_NE(page.find(", thinnest cloth <span class=\"q\">0.50 mm</span>"), std::string::npos);
  runs[0].checks[0] = {"Momentum", 1, 1e-9, "", false};
  c = compare(s, runs);
  EXPECT_EQ(c.verdict.surety, Surety::no);
  page = studyPage(s, c, {}, {});
  EXPECT_NE(page.find("Do not rely on this page"), std::string::npos);
}

/// Red by its peak is further from comfortable than red by its mean, where the peak is further above its limit.
TEST(Study, ComfortIsOfTheLimitThatIsFurthestSurpassed) {
  RunNumbers r;
  r.comfort = {{"chest", "red", 6000, 5000, 4000, 10000, 0}, {"waist", "red", 2000, 90000, 4000, 10000, 0}};
  EXPECT_EQ(r.leastComfortable()->zone, "waist");
  EXPECT_EQ(r.leastComfortable()->part_of_limit(), 9);
}

/// A motion that costs a thousandth of the other may be wrong by half: that is no error of the verdict.
TEST(Study, MeshErrorsCountByTheTorqueThatDecides) {
  const Study s = read(good);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (std::get<Case>(s.variants[i].definition).contact.friction == 0.1)
      runs[i].joints[0].peak_Nm *= runs[i].control_points == 16 ? 1.5e-3 : 1e-3;
  const Comparison c = compare(s, runs);
  EXPECT_NEAR(c.meshes[0].difference, 1.5 / 1.05 - 1, 1e-12);
  EXPECT_NEAR(*c.input.mesh_error, 1.25 * (1 - 1 / 1.05) / (25.0 / 16 - 1), 1e-12);
}

TEST(Study, FailedRunsAreLeftOutAndSaid) {
  const Study s = read(good);
  std::vector<RunNumbers> runs = numbersOf(s);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (s.variants[i].folder.starts_with("thickness_0.5")) runs[i] = RunNumbers{}, runs[i].why = "it <broke>";
  const Comparison c = compare(s, runs);
  EXPECT_TRUE(c.input.options[0].missing);
  EXPECT_NE(c.verdict.take, 0);
  const std::string page = studyPage(s, c, {}, {});
  EXPECT_NE(page.find("thickness x 0.5, fine, smooth failed: it &lt;broke&gt;"), std::string::npos);
  EXPECT_NE(page.find("joints beyond which the garment touches nothing: elbow<"), std::string::npos);
  EXPECT_NE(page.find("href=\"thickness_1__fine__smooth/report.html\""), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

/// Two meshes alone are no choice: the fine one is judged.
TEST(Study, AMeshIsNeverTaken) {
  const Study s = read(R"({"name": "mesh", "case": "cloth.json", "axes": [
    {"name": "mesh", "labels": ["coarse", "fine"], "sets": [{"garment.sheet.cells_u": 2, "garment.sheet.cells_v": 2},
                                                           {"garment.sheet.cells_u": 3, "garment.sheet.cells_v": 3}]}]})");
  const Comparison c = compare(s, numbersOf(s));
  EXPECT_EQ(c.main_axis, -1);
  EXPECT_EQ(c.mesh_axis, 0);
  EXPECT_EQ(c.verdict.sentence.find("Take"), std::string::npos) << c.verdict.sentence;
  EXPECT_TRUE(c.input.mesh_error);
  EXPECT_EQ(c.input.options.size(), 1u);
}

TEST(Study, TablesHaveOneRowPerVariant) {
  const Study s = read(good);
  const Folder folder;
  writeStudyTables(s, compare(s, numbersOf(s)), folder.path());
  std::ifstream stream(folder.path() / "variants.csv");
  std::string line;
  std::getline(stream, line);
  const auto columns = std::count(line.begin(), line.end(), ',');
  std::size_t rows = 0;
  for (; std::getline(stream, line); ++rows) EXPECT_EQ(std::count(line.begin(), line.end(), ','), columns) << line;
  EXPECT_EQ(rows, s.variants.size());
}

TEST(Study, LimitsHaveASource) {
  const Limits l = publishedLimits();
  EXPECT_EQ(l.green, 0.05);
  EXPECT_EQ(l.red, 0.15);
  EXPECT_FALSE(l.source.empty());
}

}  // namespace
}  // namespace gambeson::study
