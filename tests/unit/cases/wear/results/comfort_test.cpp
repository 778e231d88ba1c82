/// Pressure on the body itself, and what a wearer says of it, from frames whose pressures are known.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <utility>

#include "cases/study/study.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/results/body_map.hpp"
#include "cases/wear/results/measure.hpp"
#include "cases/wear/results/write.hpp"
#include "core/error.hpp"
#include "core/io/csv_text.hpp"
#include "human/body/body_zones.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

/// A man with a skin in coarse shorts, standing.
class Comfort : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scenario_ = buildScenario(readCase(GAMBESON_SOURCE_DIR "/cases/library/shorts_walk_skin.json",
                                       {"garment.shorts.cell=0.06", "human.skin.cell=0.016",
                                        R"(human.motion={"stand": {"duration": 1}})", "analysis.task=none",
                                        "air.velocity=[0, 0, 0]", "comfort.thigh.amber=2000", "comfort.thigh.red=4 kPa",
                                        "comfort.thigh.peak=\"9 kPa\"", "comfort.wear=600"}))
                    .release();
    zones_ = new std::vector<int>(BodyZones(*scenario_->human).ofSkin(*scenario_->human->skin));
  }
  static void TearDownTestSuite() {
    delete scenario_;
    delete zones_;
  }
  static int zone(const std::string& name) {
    static const std::vector<std::string> names = BodyZones(*scenario_->human).names();
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
  }
  /// The skin at rest under `pressure` at each vertex.
  static Frame frameOf(double time_s, const std::vector<float>& pressure) {
    Frame f;
    f.time_s = time_s;
    f.positions.assign(3 * static_cast<std::size_t>(scenario_->model->surface.size()), 0);
    Field position{"position", "m", 3, {}};
    for (const Vec3& x : scenario_->human->skin->rest.vertices)
      for (const double v : {x.x, x.y, x.z}) position.data.push_back(static_cast<float>(v));
    f.body_fields = {position, Field{"pressure", "Pa", 1, pressure}};
    return f;
  }
  static Scenario* scenario_;
  static std::vector<int>* zones_;
};
Scenario* Comfort::scenario_ = nullptr;
std::vector<int>* Comfort::zones_ = nullptr;

TEST_F(Comfort, ASensorAveragesOverItsWidth) {
  constexpr double width = 0.04;
  const BodyMap map(*scenario_, width);
  const TriangleMesh& skin = scenario_->human->skin->rest;
  ASSERT_EQ(map.size(), skin.vertices.size());
  // An even pressure is shown as it is.
  for (const double p : map.pressure(frameOf(0, std::vector<float>(map.size(), 1234)))) EXPECT_NEAR(p, 1234, 1e-2);
  // A force on one vertex of the front of the thigh, where the skin is nearly flat, is that over the sensor's area.
  std::size_t at = 0;
  for (std::size_t v = 0; v < map.size(); ++v)
    if ((*zones_)[v] == zone("thigh_left") && skin.vertices[v].x > skin.vertices[at].x) at = v;
  std::vector<float> one(map.size(), 0);
  one[at] = 1e5f;
  const std::vector<double> p = map.pressure(frameOf(0, one));
  const double force = 1e5 * map.area_m2()[at];
  EXPECT_NEAR(p[at] / (force / (M_PI * width * width / 4)), 1, 0.25);
  int reached = 0;
  for (std::size_t v = 0; v < map.size(); ++v) {
    const double far = norm(skin.vertices[v] - skin.vertices[at]);
    if (p[v] > 0) {
      ++reached;
      EXPECT_LE(far, width / 2);
    }
  }
  EXPECT_GT(reached, 3);
}

TEST_F(Comfort, MeansPeaksDosesAndLights) {
  const Folder folder;
  const RecordingLayout layout = recordingLayout(*scenario_);
  RecordingWriter writer = RecordingWriter::create(folder.path(), layout);
  const std::size_t n = scenario_->human->skin->rest.vertices.size();
  // Left thigh: 5 kPa in half of the frames; right thigh: 1 kPa, and 10 kPa once in ten, at 0.5 s; hips: 3.9 kPa all
  // the time; before the motion 100 kPa everywhere, which do not count.
  for (int k = -1; k < 10; ++k) {
    std::vector<float> p(n, k < 0 ? 1e5f : 0);
    for (std::size_t v = 0; k >= 0 && v < n; ++v) {
      if ((*zones_)[v] == zone("thigh_left")) p[v] = k % 2 == 0 ? 5000 : 0;
      if ((*zones_)[v] == zone("thigh_right")) p[v] = k == 4 ? 10000 : 1000;
      if ((*zones_)[v] == zone("chest")) p[v] = 3900;
    }
    writer.append(frameOf(0.1 * (k + 1), p));
  }
  writer.closeSegment({1, {}, {}});
  Measured m;
  m.strides = Strides{0.3, 1, 1, 0, 0.6};
  measureComfort(*scenario_, RecordingReader(folder.path()), m);
  const auto of = [&](const std::string& name) -> const ComfortMeasure& {
    for (const ComfortMeasure& c : m.comfort)
      if (c.zone == name) return c;
    throw std::out_of_range(name);
  };
  const ComfortMeasure &left = of("thigh_left"), &right = of("thigh_right"), &chest = of("chest");
  EXPECT_EQ(left.limit.red_Pa, 4000);
  EXPECT_NEAR(left.mean_Pa, 2500, 1);  // of a place in the middle
  EXPECT_NEAR(left.peak_Pa, 5000, 1);
  EXPECT_NEAR(left.dose_kPa_min, 25, 0.01);  // 2.5 kPa, 10 min
  EXPECT_EQ(left.light(), Light::amber);
  EXPECT_GT(left.amber_m2, 0.05);
  EXPECT_NEAR(right.peak_Pa, 10000, 1);
  EXPECT_NEAR(right.peak_time_s, 0.5, 1e-12);
  EXPECT_EQ(right.peak_during, "stance (20 % of the stride)");
  EXPECT_EQ(chest.peak_during, "the lead-in from standing");
  EXPECT_NEAR(right.mean_Pa, 1900, 1);
  EXPECT_EQ(right.light(), Light::red);  // the peak alone
  EXPECT_EQ(chest.light(), Light::amber);
  EXPECT_EQ(chest.limit.red_Pa, 4270);
  // Nothing pressed the feet.
  EXPECT_THROW(of("foot_left"), std::out_of_range);

  // A body that does not give way is no wearer where cloth is wedged in a fold of it.
  const auto flesh = [&] {
    const std::vector<AuditCheck> all = auditOf(m);
    return *std::find_if(all.begin(), all.end(), [](const AuditCheck& c) { return c.name == "Pressure on flesh"; });
  };
  EXPECT_TRUE(flesh().holds());
  EXPECT_NEAR(flesh().value, 10, 1e-3);
  EXPECT_NE(flesh().meaning.find("right thigh at 0.50 s"), std::string::npos) << flesh().meaning;
  const double as_it_is = std::exchange(m.comfort[0].peak_Pa, 3e5);
  EXPECT_FALSE(flesh().holds());
  EXPECT_NEAR(flesh().value, 300, 1e-9);
  m.comfort[0].peak_Pa = as_it_is;

  // Frame by frame: what presses most then, and the mean until then.
  writePressures(folder.path() / "pressures.csv", *scenario_, m);
  std::ifstream table(folder.path() / "pressures.csv");
  std::string line;
  std::getline(table, line);
  const std::vector<std::string> columns = csvCells(line);
  EXPECT_EQ(columns[0], "time_s");
  EXPECT_EQ(std::count(columns.begin(), columns.end(), "foot_left_largest_Pa"), 0);
  const auto at = static_cast<std::size_t>(
      std::find(columns.begin(), columns.end(), "thigh_right_largest_Pa") - columns.begin());
  ASSERT_LT(at + 1, columns.size());
  EXPECT_EQ(columns[at + 1], "thigh_right_mean_so_far_Pa");
  int frames = 0;
  for (; std::getline(table, line); ++frames) {
    const std::vector<std::string> row = csvCells(line);
    ASSERT_EQ(row.size(), columns.size());
    EXPECT_NEAR(std::stod(row[0]), 0.1 * (frames + 1), 1e-9);
    EXPECT_NEAR(std::stod(row[at]), frames == 4 ? 10000 : 1000, 1);
    EXPECT_NEAR(std::stod(row[at + 1]), frames < 4 ? 1000 : 1000 + 9000.0 / (frames + 1), 1) << frames;
  }
  EXPECT_EQ(frames, 10);

  ReportInput in;
  addComfort(*scenario_, m, in);
  EXPECT_NE(in.comfort.find("The right thigh is red: 10.0 kPa at 0.50 s"), std::string::npos) << in.comfort;
  ASSERT_EQ(in.comfort_tables.size(), 1u);
  EXPECT_EQ(in.comfort_tables[0].rows[0][0].text, "right thigh");
  EXPECT_EQ(in.comfort_tables[0].rows[0][1].light, "red");

  const std::vector<Picture> pictures = takeBodyPictures(*scenario_, m, folder.path());
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "body_pressure_front_right.png"));
}

/// An ellipsoid of metres, as a mistyped file has it, takes no more memory than a picture can use.
TEST(ComfortOnShapes, AShapeOfMetresHasNoMillionPlaces) {
  auto s = buildScenario(readCase(GAMBESON_SOURCE_DIR "/cases/library/sleeve_flex.json",
                                  {"garment.tube.cells_around=8", "garment.tube.cells_along=4"}));
  const std::size_t as_it_is = BodyMap(*s, 0.03).size();
  auto* ellipsoid = std::get_if<Ellipsoid>(&s->model->obstacles[0].shape);
  ASSERT_NE(ellipsoid, nullptr);
  ellipsoid->semi_axes = {1.9, 0.0588, 0.0588};
  const std::size_t size = BodyMap(*s, 0.03).size();
  EXPECT_GT(size, as_it_is);
  EXPECT_LT(size, as_it_is + 50000);
}

/// On ellipsoids: a sample's force falls on the shape that it is nearest to, where it is.
TEST(ComfortOnShapes, TheForceOfASampleFallsWhereItIs) {
  const auto s = buildScenario(readCase(GAMBESON_SOURCE_DIR "/cases/library/sleeve_flex.json",
                                        {"garment.tube.cells_around=8", "garment.tube.cells_along=4"}));
  const BodyMap map(*s, 0.03);
  Frame frame;
  const Surface& surface = s->model->surface;
  frame.positions.assign(3 * static_cast<std::size_t>(surface.size()), 0);
  Field pressure{"pressure", "Pa", 1, std::vector<float>(static_cast<std::size_t>(surface.size()), 0)};
  // Above the middle of the upper arm, whose radius there is 57 mm.
  frame.positions[0] = 0.125f;
  frame.positions[2] = 0.0575f;
  pressure.data[0] = 1e4f;
  frame.sample_fields = {pressure};
  const std::vector<double> p = map.pressure(frame);
  const auto top = static_cast<std::size_t>(std::max_element(p.begin(), p.end()) - p.begin());
  const double force = 1e4 * surface.area_m2[0];
  EXPECT_NEAR(p[top] / (force / (M_PI * 0.015 * 0.015)), 1, 0.3);
  EXPECT_EQ(BodyZones(*s->human).names()[static_cast<std::size_t>(map.zone()[top])], "upper_arm");
  std::vector<Vec3> x;
  for (const TriangleMesh& mesh : map.meshes(0)) x.insert(x.end(), mesh.vertices.begin(), mesh.vertices.end());
  ASSERT_EQ(x.size(), map.size());
  EXPECT_LT(norm(x[top] - Vec3{0.125, 0, 0.057}), 0.02);
}

/// A sleeve that is stretched on a cylinder: every place bears force by the area of the body, T/R, whatever the cloth's
/// area at rest and however the samples lie between the places.
TEST(ComfortOnShapes, AnEvenPressureIsShownAsItIs) {
  const Folder folder;
  std::ofstream(folder.path() / "cylinder.urdf") << R"(<robot name="c"><link name="trunk"><visual>
    <origin xyz="0 0 0.05" rpy="0 1.5707963267948966 0"/><geometry><cylinder radius="0.05" length="0.4"/></geometry>
    </visual></link><link name="tip"/><joint name="bend" type="revolute"><parent link="trunk"/><child link="tip"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="0" velocity="0"/></joint></robot>)";
  std::ofstream(folder.path() / "sleeve.json") << R"({"name": "sleeve", "gravity": [0, 0, 0],
    "garment": {"tube": {"radius": 0.045, "length": 0.2, "cells_around": 24, "cells_along": 12, "start": [-0.1, 0, 0.05],
                         "axis": [1, 0, 0]}},
    "fabric": {"thickness": "0.5 mm", "surface_density": 0.2, "young": 1e6, "poisson": 0,
               "bending": {"law": "linear", "rigidity": 1e-7}},
    "human": {"urdf": "cylinder.urdf", "motion": {"trajectory": {"file": "still.csv"}}}, "contact": {"friction": 0}})";
  std::ofstream(folder.path() / "still.csv") << "time_s,root_x_m,root_y_m,root_z_m,bend_rad\n0,0,0,0,0\n0.1,0,0,0,0\n";
  const auto s = buildScenario(readCase(folder.path() / "sleeve.json"));
  const BodyMap map(*s, 0.03);
  // The tube drawn out to the cylinder, with the area that it then has.
  const Surface& surface = s->model->surface;
  const auto n = static_cast<std::size_t>(surface.size());
  Frame frame;
  Field pressure{"pressure", "Pa", 1, std::vector<float>(n, 1500)}, area{"area", "m^2", 1, {}};
  StepWork work;
  State state = initialState(*s->model, *s->stage, 0, work);
  for (Vec3& q : state.p) q = {q.x, q.y * 0.0505 / 0.045, 0.05 + (q.z - 0.05) * 0.0505 / 0.045};
  std::vector<Vec3> x;
  samplePositions(*s->model, state.p, x);
  for (std::size_t i = 0; i < n; ++i) {
    for (const double c : {x[i].x, x[i].y, x[i].z}) frame.positions.push_back(static_cast<float>(c));
    area.data.push_back(static_cast<float>(surface.area_m2[i] * 0.0505 / 0.045));
  }
  frame.sample_fields = {pressure, area};
  // What a recording holds of the same state: the area as it is.
  RecordingWriter writer = RecordingWriter::create(folder.path() / "recording", recordingLayout(*s));
  Recorder recorder(*s, writer);
  state.time_s = 0.01;
  recorder.closeWindow(state, 0, true, work);
  writer.closeSegment({0.01, {}, {}});
  const std::vector<double> recorded = sampleAreas(*s, RecordingReader(folder.path() / "recording").frame(0));
  double now_m2 = 0;
  for (const double a : recorded) now_m2 += a;
  EXPECT_NEAR(now_m2, 2 * M_PI * 0.0505 * 0.2, 1e-3 * now_m2);
  const std::vector<double> p = map.pressure(frame);
  double low = 1e9, high = 0;
  std::size_t at = 0;
  for (const TriangleMesh& mesh : map.meshes(0))
    for (const Vec3& v : mesh.vertices) {
      if (std::abs(v.x) < 0.06) low = std::min(low, p[at]), high = std::max(high, p[at]);
      ++at;
    }
  std::printf("[ measured ] %.0f to %.0f Pa of 1500\n", low, high);
  // The rim of the sensor cuts between samples 6 to 8 mm apart, of which 13 lie under it.
  EXPECT_GT(low, 0.87 * 1500);
  EXPECT_LT(high, 1.13 * 1500);
}

TEST(ComfortLimits, OfEffortAreTheStudys) {
  const study::Limits published = study::publishedLimits();
  EXPECT_EQ(ComfortCase{}.effort_amber, published.green);
  EXPECT_EQ(ComfortCase{}.effort_red, published.red);
}

}  // namespace
}  // namespace gambeson
