/// What pages and messages say where a number would mislead.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cases/structure/run.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/results/write.hpp"
#include "cases/wear/run/run.hpp"
#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/walk.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/human/recorded/recorded.hpp"

namespace gambeson {
namespace {

const std::filesystem::path library = std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library";

TEST(Captions, SayOverWhatAPressureIsTheMean) {
  PictureCase picture;
  picture.field = PictureField::body_pressure;
  EXPECT_NE(captionOf(picture, 1, 0.03).find("(the mean over 30 mm)"), std::string::npos);
  picture.field = PictureField::pressure;
  EXPECT_NE(captionOf(picture, 1, 0.03).find("comfort goes by the mean over 30 mm"), std::string::npos);
  picture.field = PictureField::stress;
  EXPECT_EQ(captionOf(picture, 1, 0.03).find("mean"), std::string::npos);
}

/// Cloth beside a man costs him nothing that a number could tell.
TEST(RunPage, AGarmentThatTouchesNothingHasNoTorque) {
  const Folder folder;
  const auto file = folder.write("beside.json", R"({"name": "beside", "gravity": [0, 0, 0],
    "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 4, "cells_v": 4, "corner": [3, 0, 1]}},
    "fabric": {"thickness": "1 mm", "surface_density": 0.2, "young": 1e5, "poisson": 0,
               "bending": {"law": "linear", "rigidity": 1e-5}},
    "human": {"manikin": "male_p50", "motion": {"stand": {"duration": "20 ms"}}}, "dressing": {"settle": 0},
    "contact": {"friction": 0}, "analysis": {"joints": ["hip_flexion_left", "knee_flexion_left"]},
    "output": {"pictures": []}})");
  runCase(readCase(file), {folder.path() / "out", 1});
  const std::string page = content(folder.path() / "out/report.html");
  EXPECT_NE(page.find("The garment touches nothing that a joint moves"), std::string::npos);
  EXPECT_NE(page.find("Left out, as the garment touches nothing that they move: hip flexion left"), std::string::npos);
  EXPECT_EQ(page.find("0 Nm"), std::string::npos);
}

/// A walk that ends before its first stride, within it and after it: what is said is of what was played.
TEST(RunPage, SpeaksOfWhatWasPlayed) {
  const Folder folder;
  const auto file = folder.write("walk.json", R"({"name": "walk", "gravity": [0, 0, 0],
    "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 2, "cells_v": 2, "corner": [3, 0, 3]}},
    "fabric": {"thickness": "1 mm", "surface_density": 0.2, "young": 1e4, "poisson": 0,
               "bending": {"law": "linear", "rigidity": 1e-5}},
    "human": {"manikin": "male_p50",
              "motion": {"walk": {"lead_in": "0.1 s", "strides": 1, "stride_time": "0.5 s"}}},
    "contact": {"friction": 0}, "dressing": {"settle": "20 ms"}, "time": {"max_step": "5 ms"},
    "analysis": {"joints": ["hip_flexion_left"], "task": "natural_walk"}, "output": {"pictures": []}})");
  const auto play = [&](const std::string& duration) {
    runCase(readCase(file, {"time.duration=" + duration}), {folder.path() / "out", 1});
    return std::pair(nlohmann::json::parse(content(folder.path() / "out/summary.json")),
                     content(folder.path() / "out/report.html"));
  };
  const auto [lead_in, of_lead_in] = play("50 ms");
  EXPECT_EQ(lead_in["played"], "the lead-in");
  EXPECT_FALSE(lead_in.contains("strides"));
  EXPECT_FALSE(lead_in["joints"][0].contains("natural_peak_Nm"));
  EXPECT_FALSE(lead_in["joints"][0].contains("stride_phase_of_highest_joint_value"));
  EXPECT_LE(lead_in["feet"]["slip_m"].get<double>(), 0.05);
  EXPECT_NE(of_lead_in.find("The run ended at 0.05 s, in the lead-in: the first stride begins at 0.10 s."),
            std::string::npos);
  EXPECT_EQ(of_lead_in.find("count from the foot strike"), std::string::npos);
  const auto [part, of_part] = play("0.3 s");
  EXPECT_EQ(part["played"], "part of a stride");
  EXPECT_TRUE(part["joints"][0].contains("natural_peak_Nm"));
  EXPECT_NE(of_part.find("in the first stride (0.10 to 0.60 s)"), std::string::npos);
  const auto [whole, of_whole] = play("0.6 s");
  EXPECT_EQ(whole["played"], "strides");
  EXPECT_TRUE(whole["joints"][0].contains("stride_phase_of_highest_joint_value"));
  EXPECT_NE(of_whole.find("count from the foot strike at 0.1"), std::string::npos);
  EXPECT_EQ(of_whole.find("The run ended"), std::string::npos);
}

/// Thighs that are held together pass through each other: the note names what holds them apart.
TEST(LegsThatMeet, AreSaidWithWhatHoldsThemApart) {
  const Folder folder;
  const Human human = makeManikin("male_p50");
  folder.write("walk.mot", test::motOf(*makeWalk(human, {}), human, findJointMap("gait2392"), 0.5, 1.5, true));
  const auto notesAt = [&](const std::string& apart) {
    const auto file = folder.write("legs.json", R"({"name": "legs",
      "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 4, "cells_v": 4, "corner": [0, 0, 3]}},
      "fabric": {"thickness": "1 mm", "surface_density": 0.2, "young": 1e5, "poisson": 0,
                 "bending": {"law": "linear", "rigidity": 1e-5}},
      "contact": {"friction": 0}, "human": {"manikin": "male_p50", "skin": {"cell": "43 mm"},
                "motion": {"file": {"path": "walk.mot", "lead_in": 0, "hips_apart": ")" +
                                                    apart + R"("}}}})");
    const auto s = buildScenario(readCase(file));
    std::string all;
    for (const std::string& note : s->notes) all += note + "\n";
    return all;
  };
  EXPECT_NE(notesAt("-15 deg").find("hips_apart and arms_apart hold the limbs apart"), std::string::npos);
  EXPECT_EQ(notesAt("4 deg").find("hold the limbs apart"), std::string::npos);
}

/// A sleeve that is stretched by 12 % on a cylinder presses with T/R, T = E t lambda (lambda^2 - 1)/2 (St. Venant,
/// nu = 0), which is force by present area; by the area at rest it would be 12 % more.
TEST(Pressure, IsForceByPresentArea) {
  const Folder folder;
  folder.write("cylinder.urdf", R"(<robot name="c"><link name="trunk"><visual>
    <origin xyz="0 0 0.05" rpy="0 1.5707963267948966 0"/><geometry><cylinder radius="0.05" length="0.4"/></geometry>
    </visual></link><link name="tip"/><joint name="bend" type="revolute"><parent link="trunk"/><child link="tip"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="0" velocity="0"/></joint></robot>)");
  folder.write("still.csv", "time_s,root_x_m,root_y_m,root_z_m,bend_rad\n0,0,0,0,0\n0.1,0,0,0,0\n");
  const auto file = folder.write("sleeve.json", R"({"name": "sleeve", "gravity": [0, 0, 0],
    "garment": {"tube": {"radius": 0.045, "length": 0.2, "cells_around": 16, "cells_along": 6, "start": [-0.1, 0, 0.05],
                         "axis": [1, 0, 0]}},
    "fabric": {"thickness": "0.5 mm", "surface_density": 1, "young": 2e5, "poisson": 0,
               "bending": {"law": "linear", "rigidity": 1e-7}},
    "human": {"urdf": "cylinder.urdf", "motion": {"trajectory": {"file": "still.csv"}}}, "contact": {"friction": 0},
    "air": {"drag": 40}, "dressing": {"projecting": {"clearance": "2 mm", "grow": "50 ms"}, "settle": "0.1 s"},
    "output": {"pictures": []}})");
  runCase(readCase(file), {folder.path() / "out", 1});
  const auto s = buildScenario(readCase(file));
  const RecordingReader recording(folder.path() / "out");
  const Frame frame = recording.frame(recording.frameCount() - 1);
  const auto field = std::find_if(frame.sample_fields.begin(), frame.sample_fields.end(),
                                  [](const Field& f) { return f.name == "pressure"; });
  ASSERT_NE(field, frame.sample_fields.end());
  const std::vector<double> area = sampleAreas(*s, frame);
  double force = 0, size = 0, radius = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    const double x = frame.positions[3 * i], y = frame.positions[3 * i + 1], z = frame.positions[3 * i + 2] - 0.05;
    if (!(std::abs(x) < 0.05)) continue;
    force += field->data[i] * area[i];
    size += area[i];
    radius += std::hypot(y, z) * area[i];
  }
  radius /= size;
  const double lambda = radius / 0.045, tension = 2e5 * 0.5e-3 * lambda * (lambda * lambda - 1) / 2;
  std::printf("[ measured ] %.0f Pa, T/R %.0f Pa at a stretch of %.3f\n", force / size, tension / radius, lambda);
  EXPECT_GT(lambda, 1.11);
  EXPECT_NEAR(force / size / (tension / radius), 1, 0.02);
}

/// Loads beyond all measure end in a message and exit 1, with the report of what there is.
TEST(StructureRuns, WhatIsNotFiniteIsNoSuccess) {
  const Folder folder;
  const StructureCase c =
      readStructureCase(library / "cantilever.json", {"loads[0].force=[0, 0, 1e15]", "output.pictures=[]"});
  try {
    runStructure(c, {folder.path() / "out", 1});
    FAIL() << "runs";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("not finite"), std::string::npos) << e.what();
  }
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "out/report.html"));
}

}  // namespace
}  // namespace gambeson
