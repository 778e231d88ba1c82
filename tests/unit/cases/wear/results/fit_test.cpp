/// How garments sit: stretch along weft and warp against the fabric's range, and falls against the body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cases/pattern/pattern_file.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/results/check_words.hpp"
#include "cases/wear/results/girths.hpp"
#include "cases/wear/results/stretch_checks.hpp"
#include "cases/wear/results/write.hpp"
#include "unit/cases/example.hpp"
#include "unit/shell_of.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

/// Frames with the control points and samples where `moved` takes those of the start.
template <class Moved>
void record(const Scenario& s, const std::filesystem::path& dir, const std::vector<double>& times, Moved moved) {
  RecordingWriter writer = RecordingWriter::create(dir, recordingLayout(s));
  StepWork work;
  const State start = startOf(s, work);
  const Model& m = *s.model;
  const auto n = static_cast<std::size_t>(m.surface.size());
  std::vector<Vec3> x(n), q(static_cast<std::size_t>(m.cloth->points()));
  m.surface.WT.multiply<Vec3>(start.p, x);
  m.cloth->map().T.multiply<Vec3>(start.p, q);
  for (const double t : times) {
    Frame frame;
    frame.time_s = t;
    for (const Vec3& p : x)
      for (int c = 0; c < 3; ++c) frame.positions.push_back(static_cast<float>(moved(t, p)[c]));
    for (const auto& field : {"velocity", "contact_force"})
      frame.sample_fields.push_back({field, "", 3, std::vector<float>(3 * n)});
    for (const auto& field : {"pressure", "stress", "stress_second", "strain", "strain_second"})
      frame.sample_fields.push_back({field, "", 1, std::vector<float>(n, 0.1F)});
    Field control{"position", "m", 3, {}};
    for (const Vec3& p : q)
      for (int c = 0; c < 3; ++c) control.data.push_back(static_cast<float>(moved(t, p)[c]));
    frame.control_fields = {control};
    writer.append(std::move(frame));
  }
  writer.closeSegment(Checkpoint{times.back(), {}, {}});
}

const std::string cloth = R"({"name": "cloth",
  "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 3, "cells_v": 3}, "weft_angle": "ANGLE deg"},
  "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3, "limit_strain_weft": "WEFT %",
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "time": {"duration": 0.1}})";

const std::string curves = R"("law": {"curves": {"weft": [["5 %", "15 N/m"], ["20 %", "80 N/m"]],
                               "warp": [["5 %", "15 N/m"], ["20 %", "80 N/m"]], "shear": "100 N/m",
                               "rigidity_weft": 1e-4, "rigidity_warp": 1e-4}})";

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

/// Stretched by a tenth along x and by a twentieth along y: E = (1.1^2 - 1) / 2 = 0.105, (1.05^2 - 1) / 2 = 0.05125.
TEST(Fit, StretchIsToldAlongWeftAndWarp) {
  const Folder folder;
  for (const auto& [angle, weft, warp] : {std::tuple("0", 0.105, 0.05125), std::tuple("90", 0.05125, 0.105)}) {
    const auto s = buildScenario(readCase(folder.write("cloth.json", with(with(cloth, "ANGLE", angle), "WEFT", "10"))));
    const std::filesystem::path dir = folder.path() / angle;
    record(*s, dir, {0, 0.02, 0.04}, [](double t, const Vec3& p) {
      return t > 0.03 ? Vec3{1.1 * p.x, 1.05 * p.y, p.z} : p;  // once is enough
    });
    Measured m;
    m.regions = regionsOf(*s);
    const RecordingReader recording(dir);
    measureFrames(recording, m);
    measureStretch(*s, recording, m);
    ASSERT_EQ(m.stretch.size(), 2u);
    EXPECT_EQ(m.stretch[0].along, "weft");
    EXPECT_NEAR(m.stretch[0].largest, weft, 2e-6);
    EXPECT_NEAR(m.stretch[0].most, weft, 2e-6);
    EXPECT_EQ(m.stretch[0].limit, 0.1);
    EXPECT_TRUE(m.stretch[0].stated);
    EXPECT_EQ(m.stretch[0].holds(), weft < 0.1);
    // Where the fabric states none, that of its law.
    EXPECT_EQ(m.stretch[1].along, "warp");
    EXPECT_NEAR(m.stretch[1].largest, warp, 2e-6);
    EXPECT_EQ(m.stretch[1].limit, kStrainOfLaw);
    EXPECT_FALSE(m.stretch[1].stated);
  }
}

/// A garment whose fabric is of a card fails a check that names it, where it is stretched past the card's elongation;
/// of a limit that a case states without a card the check has the fabric's name.
TEST(Fit, PastTheLimitOfItsCardAGarmentFailsACheckByName) {
  const Folder folder;
  folder.write("knit.card.json", R"json({"name": "Soft knit", "source": "made up for a test", "description": "none",
    "weight": "500 g/m^2", "tensile": {"modulus": "1000 N/m"}, "shear": {"G": "300 N/(m rad)"},
    "bending": {"B": "1e-4 N m"}, "elongation_weft": "8 %", "elongation_warp": "8 %"})json");
  const std::string of_card = R"json({"name": "cloth",
    "garment": {"sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 3, "cells_v": 3}},
    "fabric": {"card": "knit.card.json"}, "time": {"duration": 0.1}})json";
  const std::string stated =
      with(with(with(cloth, "ANGLE", "0"), "WEFT", "8"), "\"fabric\": {", "\"fabric\": {\"name\": \"Felt\", ");
  const std::string of_law = with(stated, "\"young\": \"1 MPa\", \"poisson\": 0.3,", ""),
                    of_curves = with(of_law, R"("bending": {"law": "linear", "rigidity": "1e-4 N m"})", curves);
  for (const auto& [text, name, limit] : {std::tuple(of_card, "Soft knit (card knit.card.json)", 8.32),
                                          std::tuple(stated, "Felt", 8.), std::tuple(of_curves, "Felt", 8.)})
    for (const double stretch : {1.05, 1.1}) {
      SCOPED_TRACE(testing::Message() << name << " " << stretch);
      const auto s = buildScenario(readCase(folder.write("cloth.json", text)));
      const std::filesystem::path dir = folder.path() / (std::string(name) + std::to_string(stretch));
      record(*s, dir, {0, 0.02}, [=](double, const Vec3& p) { return Vec3{stretch * p.x, p.y, p.z}; });
      Measured m;
      m.regions = regionsOf(*s);
      const RecordingReader recording(dir);
      measureFrames(recording, m);
      measureStretch(*s, recording, m);
      const std::vector<AuditCheck> checks = stretchChecks(s->definition, m.stretch);
      const auto found = std::find_if(checks.begin(), checks.end(), [&](const AuditCheck& c) {
        return c.name == std::string("Stretch along the weft, ") + name;
      });
      ASSERT_NE(found, checks.end());
      EXPECT_NEAR(found->value, 100 * (stretch * stretch - 1) / 2, 1e-3);
      EXPECT_NEAR(found->limit, limit, 1e-9);
      EXPECT_EQ(found->holds(), stretch < 1.08);
      const std::string said = notMet(found->name, found->value, found->limit, found->unit);
      EXPECT_NE(said.find("It may not come back, or tear"), std::string::npos) << said;
      EXPECT_NE(checkWords(found->name, found->value, found->limit, found->unit).wrong.find(name), std::string::npos);
    }
}

/// Curves end at a Green-Lagrange strain of 22 %: that the law says no more is no limit that has a name.
TEST(Fit, TheRangeOfALawIsNoLimitOfTheFabric) {
  const Folder folder;
  std::string text = with(with(cloth, "ANGLE", "0"), R"("limit_strain_weft": "WEFT %",)", "");
  text = with(with(text, "\"young\": \"1 MPa\", \"poisson\": 0.3,", ""),
              R"("bending": {"law": "linear", "rigidity": "1e-4 N m"})", curves);
  const auto s = buildScenario(readCase(folder.write("cloth.json", text)));
  record(*s, folder.path() / "out", {0, 0.02}, [](double, const Vec3& p) { return Vec3{1.3 * p.x, p.y, p.z}; });
  Measured m;
  m.regions = regionsOf(*s);
  const RecordingReader recording(folder.path() / "out");
  measureFrames(recording, m);
  measureStretch(*s, recording, m);
  ASSERT_FALSE(m.stretch.empty());
  EXPECT_GT(m.stretch[0].largest, m.stretch[0].limit);
  EXPECT_TRUE(stretchChecks(s->definition, m.stretch).empty());
}

TEST(Fit, WithoutALimitTheLawsOwnRangeHolds) {
  const Folder folder;
  const auto s = buildScenario(
      readCase(folder.write("cloth.json", with(with(cloth, "ANGLE", "0"), R"("limit_strain_weft": "WEFT %",)", ""))));
  record(*s, folder.path() / "out", {0, 0.02}, [](double, const Vec3& p) { return p; });
  Measured m;
  m.regions = regionsOf(*s);
  const RecordingReader recording(folder.path() / "out");
  measureFrames(recording, m);
  measureStretch(*s, recording, m);
  ASSERT_EQ(m.stretch.size(), 1u);
  EXPECT_EQ(m.stretch[0].along, "");
  EXPECT_NEAR(m.stretch[0].largest, 0.1, 1e-7);  // the recorded principal strain
  EXPECT_EQ(m.stretch[0].limit, 0.02);
  EXPECT_FALSE(m.stretch[0].holds());
}

const std::string shorts = R"({"name": "shorts", "garment": {"shorts": {"cell": "60 mm"}},
  "fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "human": {"manikin": "male_p50", "motion": {"walk": {"lead_in": "0.3 s", "strides": 1}}},
  "contact": {"friction": 0.3}, "dressing": {"settle": 0}})";

const AuditCheck* checkOf(const std::vector<AuditCheck>& checks, const std::string& name) {
  for (const AuditCheck& c : checks)
    if (c.name == name) return &c;
  return nullptr;
}

/// Shorts that go along with the pelvis stay on; 0.4 m below it they have fallen.
TEST(Fit, AGarmentThatFallsFailsItsCheck) {
  const Folder folder;
  const auto s = buildScenario(readCase(folder.write("shorts.json", shorts)));
  const int pelvis = s->human->skeleton.link("pelvis");
  const Pose start = s->bodyPoses(0)[static_cast<std::size_t>(pelvis)];
  for (const double fallen_m : {0.0, 0.4}) {
    const std::filesystem::path dir = folder.path() / (fallen_m > 0 ? "fallen" : "worn");
    record(*s, dir, {0, 0.4, 0.8}, [&](double t, const Vec3& p) {
      const Pose now = s->bodyPoses(t)[static_cast<std::size_t>(pelvis)];
      const Vec3 carried = now.rotation * transposeTimes(start.rotation, p - start.origin) + now.origin;
      return carried - Vec3{0, 0, t > 0.5 ? fallen_m : 0};
    });
    Measured m;
    measureFalls(*s, RecordingReader(dir), m);
    ASSERT_EQ(m.falls.size(), 1u);
    EXPECT_NEAR(m.falls[0].largest_m, fallen_m, fallen_m > 0 ? 0.05 : 1e-6);
    const auto checks = auditOf(m);
    const AuditCheck* check = checkOf(checks, "Slipping");
    ASSERT_TRUE(check);
    EXPECT_EQ(check->holds(), fallen_m == 0);
  }
}

/// Two squares of 10 cm that start a metre apart. Then they lie side by side, but for a wedge between them: nothing at
/// its tip, what is said at the other end of the seam. That has its last point 0.3 % before the end.
TEST(Fit, ASeamThatGapesFailsItsCheck) {
  using region_patterns::edge, region_patterns::panel;
  const Folder folder;
  FlatPattern pattern;
  pattern.name = "two";
  for (const double x_m : {0.0, 1.1}) {
    pattern.panels.push_back(
        panel(x_m > 0 ? "right" : "left", "", {edge(0, 0), edge(0.1, 0), edge(0.1, 0.1), edge(0, 0.1)}));
    pattern.panels.back().placement = PanelPlace{{x_m, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  }
  pattern.seams = {{"middle", {{0, 1, 0, 1}}, {{1, 3, 1, 0}}}};
  checkPattern(pattern);
  folder.write("pattern.json", patternText(pattern));
  const std::string sheet = R"("sheet": {"width": "0.1 m", "height": "0.1 m", "cells_u": 3, "cells_v": 3})";
  const auto s = buildScenario(
      readCase(folder.write("cloth.json", with(with(with(cloth, "ANGLE", "0"), R"("limit_strain_weft": "WEFT %",)", ""),
                                               sheet, R"("pattern": {"path": "pattern.json", "cell": "25 mm"})"))));
  for (const double gap_m : {0.2e-3, 3e-3}) {
    const std::filesystem::path dir = folder.path() / (gap_m > 1e-3 ? "gapes" : "holds");
    record(*s, dir, {0, 0.02, 0.04}, [&](double t, const Vec3& p) {
      if (p.x < 0.6 || t == 0) return p;
      return p - Vec3{1 - (t > 0.03 ? gap_m : 0.5 * gap_m) * p.y / 0.1, 0, 0};
    });
    Measured m;
    m.seam_gap = widestSeamGap(*s, RecordingReader(dir));
    ASSERT_TRUE(m.seam_gap);
    EXPECT_NEAR(m.seam_gap->gap_m, gap_m, 0.005 * gap_m);
    EXPECT_NEAR(m.seam_gap->cells, gap_m / 0.025, 0.01 * gap_m / 0.025);
    EXPECT_EQ(m.seam_gap->time_s, 0.04);
    EXPECT_NEAR(norm(m.seam_gap->at_m - Vec3{0.1, 0.1, 0}), 0, 0.5e-3);
    const auto checks = auditOf(m);
    const AuditCheck* check = checkOf(checks, "Seams");
    ASSERT_TRUE(check);
    EXPECT_EQ(check->holds(), gap_m < 1e-3);
  }
}

/// Two skirts a tenth wider than they were cut: too short where the fabric may be stretched by a fiftieth, worn as it
/// is meant to be where it is a knit.
TEST(Fit, WhichGarmentIsTooShortGoesByItsFabric) {
  const Folder folder;
  folder.write("skirt.json", patternText(region_patterns::skirt({})));
  const std::string fabric =
      R"("fabric": {"thickness": "1 mm", "density": "500 kg/m^3", "young": "1 MPa", "poisson": 0.3,
      LIMIT "bending": {"law": "linear", "rigidity": "1e-4 N m"}})";
  const auto s = buildScenario(readCase(folder.write(
      "two.json", R"({"name": "two", "garments": [
      {"name": "woven", "pattern": {"path": "skirt.json", "cell": "60 mm"}},
      {"name": "knit", "pattern": {"path": "skirt.json", "cell": "60 mm"}, )" +
                      with(fabric, "LIMIT", R"("limit_strain_weft": "50 %", "limit_strain_warp": "50 %",)") + "}], " +
                      with(fabric, "LIMIT", "") + R"(,
      "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "0.02 s"}}}, "contact": {"friction": 0.3},
      "dressing": {"layer_by_layer": true, "settle": 0}})")));
  for (const double wider : {1.0, 1.1}) {
    const std::filesystem::path dir = folder.path() / std::to_string(wider);
    record(*s, dir, {0, 0.02}, [&](double, const Vec3& p) { return Vec3{wider * p.x, wider * p.y, p.z}; });
    Measured m;
    measureGirths(*s, RecordingReader(dir), m);
    ASSERT_EQ(m.too_short.size(), wider > 1 ? 1u : 0u);
    if (m.too_short.empty()) continue;
    EXPECT_EQ(m.too_short[0].garment, "woven");
    for (const Girth& g : m.too_short[0].at) EXPECT_NEAR(g.worn_m, wider * g.rest_m, 0.02 * g.rest_m);  // the panels bend
    const ReportInput page = reportInput(*s, m, {}, "", {});
    EXPECT_TRUE(std::any_of(page.warnings.begin(), page.warnings.end(), [](const std::string& w) {
      return w.starts_with("Garment \"woven\" does not fit: at a height of ");
    }));
  }
}

/// Shorts over shorts that are drafted in one place, in the second frame with either where a test wants it.
struct TwoShorts {
  Folder folder;
  double front_m = 0;  ///< the foremost point of the first frame
  std::unique_ptr<Scenario> scenario = buildScenario(
      readCase(folder.write("two.json", with(shorts, R"("garment": {"shorts": {"cell": "60 mm"}})",
                                             R"("garments": [{"name": "inner", "shorts": {"cell": "60 mm"}},
                                                             {"name": "outer", "shorts": {"cell": "60 mm"}}])"))));
  Vec3 middle() const {
    const std::vector<Pose> poses = scenario->bodyPoses(0);
    return poses[static_cast<std::size_t>(scenario->human->skeleton.link("pelvis"))].origin;
  }
  /// `place`: of a point of the lower shorts or of the upper ones.
  Measured measured(const std::function<Vec3(bool lower, const Vec3& p)>& place) {
    const Surface& surface = scenario->model->surface;
    // Samples come component by component, those of the inner shorts first, then the control points.
    const auto inner = std::count_if(surface.patch.begin(), surface.patch.end(),
                                     [&](int p) { return shellOf(*scenario->model).garment().garmentOf(p) == 0; });
    const long calls = 3L * (surface.size() + scenario->model->cloth->points());
    long at = 0;
    record(*scenario, folder.path() / "out", {0, 0.4}, [&](double t, const Vec3& p) {
      const bool lower = at++ % calls / 3 < inner;
      if (t > 0.2) return place(lower, p);
      front_m = std::max(front_m, p.x);
      return p;
    });
    Measured m;
    measureGarmentOrder(*scenario, RecordingReader(folder.path() / "out"), m);
    EXPECT_EQ(m.garment_order.size(), 1u);
    std::printf("[ measured ] %.1f %% of the upper shorts lie inside\n", 100 * m.garment_order[0].largest);
    return m;
  }
};

/// With the upper ones blown up these lie outside, with the lower ones blown up the upper ones lie inside, though
/// nothing crosses.
TEST(Fit, AGarmentInsideOfOneThatBelongsUnderItFailsItsCheck) {
  for (const bool wrong : {false, true}) {
    TwoShorts two;
    const Vec3 middle = two.middle();
    const Measured m = two.measured([&](bool lower, const Vec3& p) {
      const Vec3 radial{p.x - middle.x, p.y - middle.y, 0};
      return lower == wrong ? p + 0.015 / norm(radial) * radial : p;
    });
    const auto checks = auditOf(m);
    const AuditCheck* check = checkOf(checks, "Layer order, outer over inner");
    ASSERT_TRUE(check);
    EXPECT_EQ(check->holds(), !wrong);
    // Seen from the pelvis the insides of the legs move to the other side of the cloth.
    if (wrong)
      EXPECT_GT(m.garment_order[0].largest, 0.7);
    else
      EXPECT_LT(m.garment_order[0].largest, 0.25);
    EXPECT_EQ(m.garment_order[0].time_s, 0.4);
  }
}

/// Where a body folds, belly against thigh, the upper garment has the outer side of the lower one before it: here the
/// lower ones stand before the upper ones, turned to face them.
TEST(Fit, TheOuterSideOfALowerGarmentMayLieBeforeAnUpperOne) {
  TwoShorts two;
  const Vec3 middle = two.middle();
  const Measured m = two.measured([&](bool lower, const Vec3& p) {
    return lower ? Vec3{2 * (two.front_m + 0.005) - p.x, 2 * middle.y - p.y, p.z} : p;
  });
  EXPECT_LT(m.garment_order[0].largest, 0.01);
}

/// Until the motion starts a garment may come down by 0.1 m: a skirt finds the hips so.
TEST(Fit, AGarmentMayComeDownWhileItIsPutOn) {
  const Folder folder;
  const auto s =
      buildScenario(readCase(folder.write("shorts.json", with(shorts, R"({"walk": {"lead_in": "0.3 s", "strides": 1}})",
                                                              R"({"stand": {"duration": "1 s"}})"))));
  for (const auto& [down_m, counts_m] : {std::pair(0.09, 0.0), std::pair(0.16, 0.06)}) {
    const std::filesystem::path dir = folder.path() / std::to_string(down_m);
    record(*s, dir, {-0.4, -0.2, 0, 0.5}, [&](double t, const Vec3& p) {
      return p - Vec3{0, 0, t > -0.3 ? down_m : 0};
    });
    Measured m;
    measureFalls(*s, RecordingReader(dir), m);
    ASSERT_EQ(m.falls.size(), 1u);
    EXPECT_NEAR(m.falls[0].largest_m, counts_m, 1e-6);
  }
}

/// Works of rounding are no works: without gravity, at rest, nothing is unaccounted for.
TEST(Fit, WorksOfRoundingAreNoWorks) {
  EnergyMeasure e;
  e.change = 5.6e-31;
  e.absolute = 1e-31;
  e.negligible = 0.5 * 0.3 * 1e-12;  // 0.3 kg at 1 um/s
  EXPECT_EQ(e.relative(), 0);
  e.change = 5.6e-9;
  e.absolute = 1e-9;
  EXPECT_NEAR(e.relative(), 5.6, 1e-9);
}

/// A shirt of 0.2 kg that hangs still: half a millijoule of work, and a drift that could lift it by 0.03 mm. What could
/// lift it by 0.06 mm fails (5 %), with whatever sign, without any work at all, and where nothing is a number.
TEST(Fit, DriftsOfClothAtRestAreMeasuredByItsWeight) {
  EnergyMeasure e;
  e.negligible = 0.5 * 0.2 * 1e-12;
  e.lift = 0.2 * 9.81 * EnergyMeasure::lift_m;
  e.absolute = 0.5e-3;
  e.contact = -0.4e-3;
  e.change = e.contact + 0.2 * 9.81 * 0.03e-3;
  EXPECT_NEAR(e.relative(), 0.03, 1e-12);
  e.change = e.contact - 0.2 * 9.81 * 0.06e-3;
  EXPECT_NEAR(e.relative(), -0.06, 1e-12);
  e.absolute = e.contact = 0;
  e.change = -0.2 * 9.81 * 0.06e-3;
  e.integrator = 0.2 * 9.81 * 0.1e-3;
  EXPECT_NEAR(e.relative(), -0.16, 1e-12);
  EXPECT_NEAR(e.made(), 0.1, 1e-12);
  // In motion the works count alone.
  e.integrator.reset();
  e.change = 0.4;
  e.absolute = 10;
  EXPECT_NEAR(e.relative(), 0.04, 1e-12);
  e.absolute = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(e.relative() <= 0.05);
}

}  // namespace
}  // namespace gambeson
