/// What a run leaves, from a recording written here, whose forces and thus torques are known in closed form.

#include "cases/wear/results/results.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

#include "analysis/ticks.hpp"
#include "cases/study/numbers.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/recording/zone_ledger.hpp"
#include "cases/wear/results/write.hpp"
#include "cases/wear/run/run.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

/// The library's arm in a coarse sleeve. The elbow's axis is (0, -1, 0) and its centre the origin of the forearm, so
/// that a vertical force F at the distance r along the forearm at rest gives the contact torque r F.
Case sleeve() {
  return readCase(
      GAMBESON_SOURCE_DIR "/cases/library/sleeve_flex.json",
      {"garment.tube.cells_around=8", "garment.tube.cells_along=4", "time.duration=0.05",
       R"(output.pictures=[{"time": "peak", "field": "stress", "view": "left", "width": 320, "height": 240}])"});
}

/// Down on the forearm, 0.1 m from the elbow, one force per window of 10 ms from time 0 on [N]; before that 100 N,
/// which do not count.
const std::vector<double> forces{1, 2, 3, 2, 1};
constexpr double lever_m = 0.1, depth_m = 1e-3;
constexpr float stress_high = 123.456f;

void record(const Scenario& s, const std::filesystem::path& dir, std::size_t windows = 5) {
  const RecordingLayout layout = recordingLayout(s);
  RecordingWriter writer = RecordingWriter::create(dir, layout);
  const auto row = [&](const std::string& table, double start, std::vector<std::pair<std::string, double>> values) {
    const std::vector<std::string>& columns = layout.tables.at(table);
    std::vector<double> r(columns.size(), 0);
    r[0] = start;
    r[1] = start + 0.01;
    for (const auto& [name, value] : values) {
      const auto at = std::find(columns.begin(), columns.end(), name);
      ASSERT_NE(at, columns.end()) << name;
      r[static_cast<std::size_t>(at - columns.begin())] = value;
    }
    writer.append(TableRow{table, r});
  };
  const std::size_t n = static_cast<std::size_t>(s.model->surface.size());
  for (std::size_t w = 0; w <= windows; ++w) {
    const double start = 0.01 * (static_cast<double>(w) - 1), J = 0.01 * (w == 0 ? 100 : forces[w - 1]);
    row("bodies", start,
        {{"forearm_Jz_Ns", -J}, {"forearm_Ly_Nms", lever_m * J}, {"forearm_n_Ns", 2 * J}, {"forearm_t_Ns", J}});
    row("normal", start, {{"forearm_Jz_Ns", -0.75 * J}, {"forearm_Ly_Nms", 0.75 * lever_m * J}});
    const std::string garment = groupName(s.contact_groups.at(0));
    row("body_zones", start,
        {{garment + " on forearm_Ns", 2 * J},
         {garment + " on forearm_n_Ns", 1.5 * J},
         {garment + " on forearm_t_Ns", 0.5 * J},
         {garment + " on forearm_Jx_Ns", 0.6 * J},
         {garment + " on forearm_Jz_Ns", (w % 2 == 0 ? 0.8 : -0.8) * J},
         {garment + " on upper_arm_Ns", J},
         {garment + " on upper_arm_n_Ns", 0.5 * J}});
    row("drag", start, {{"forearm_Jz_Ns", -0.25 * J}, {"forearm_Ly_Nms", 0.25 * lever_m * J}});
    row("supports", start, {{"start held_z_Ns", 0.02}});
    // The energy rises by 2 J a window, of which contact and drag explain 3 - 1.5.
    row("steps", start,
        {{"steps", 10},
         {"shortest_step_s", 1e-3 / static_cast<double>(w + 1)},
         {"longest_step_s", 2e-3},
         {"momentum_error", w == 2 ? 3e-12 : 1e-13},
         {"deepest_m", w == 0 ? 1 : 1e-5},
         {"kinetic_J", 2 * static_cast<double>(w)},
         {"work_contact_J", 3},
         {"work_drag_J", -1.5},
         {"frequency_rad_per_s", w == 3 ? 2000 : 1000},
         {"membrane_share", w == 3 ? 0.2 : 0.7},
         {"bending_share", w == 3 ? 0.8 : 0.3}});
    Frame frame;
    frame.time_s = start + 0.01;
    for (const auto& field : {"velocity", "contact_force"})
      frame.sample_fields.push_back({field, "", 3, std::vector<float>(3 * n)});
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 uv = s.model->surface.parameters[i];
      const double phi = 2 * M_PI * uv.x;
      for (double v : {0.5 * uv.y, 0.06 * std::cos(phi), 0.06 * std::sin(phi)})
        frame.positions.push_back(static_cast<float>(v));
    }
    frame.sample_fields[1].data[2] = 1;
    for (const auto& field : {"pressure", "stress", "stress_second", "strain", "strain_second"})
      frame.sample_fields.push_back({field, "", 1, std::vector<float>(n, 10)});
    if (w == 0) frame.sample_fields[3].data[0] = 1000;  // dressing counts in the recording's range alone
    if (w == 4) frame.sample_fields[3].data[1] = stress_high;
    Field control{"position", "m", 3, {}};
    for (int i = 0; i < s.model->cloth->points(); ++i)
      for (const double v : {0.125, 0.0, 0.0570 - depth_m}) control.data.push_back(static_cast<float>(v));
    frame.control_fields = {control};
    writer.append(std::move(frame));
  }
  writer.closeSegment(Checkpoint{0.01 * static_cast<double>(windows), {}, {}});
  std::ofstream(dir / "case.json") << writeCase(s.definition);
  RunFacts facts{2, "avx2", "", 12.5, {{"cloth forces", 9}, {"other", 3}}, false};
  writeRunFacts(facts, dir);
}

TEST(Results, KnownImpulsesGiveKnownTorques) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path());
  writeResults(folder.path());
  const auto j = nlohmann::json::parse(content(folder.path() / "summary.json"));

  // The cloth pushes down, against flexion: the wearer must add as much towards flexion, 0.1 m times 3 N.
  ASSERT_EQ(j.at("joints").size(), 1u);
  const auto& elbow = j.at("joints")[0];
  EXPECT_EQ(elbow.at("joint"), "elbow_flexion");
  EXPECT_NEAR(elbow.at("peak_Nm").get<double>(), 0.3, 1e-12);
  EXPECT_NEAR(elbow.at("peak_time_s").get<double>(), 0.025, 1e-12);
  EXPECT_NEAR(elbow.at("rms_Nm").get<double>(), 0.1 * std::sqrt(19.0 / 5), 1e-12);
  EXPECT_NEAR(elbow.at("drag_at_peak_Nm").get<double>(), 0.075, 1e-12);
  EXPECT_NEAR(elbow.at("normal_mean_N").get<double>(), 2 * 9.0 / 5, 1e-12);
  EXPECT_NEAR(elbow.at("friction_mean_N").get<double>(), 9.0 / 5, 1e-12);
  EXPECT_FALSE(elbow.contains("percent_of_natural"));  // no task

  // What does not press rubs: a quarter.
  EXPECT_NEAR(elbow.at("friction_at_peak_Nm").get<double>(), 0.075, 1e-12);
  EXPECT_NEAR(elbow.at("friction_share_at_peak").get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(elbow.at("friction_rms_Nm").get<double>(), 0.025 * std::sqrt(19.0 / 5), 1e-12);
  for (const char* which : {"all", "without_belt_and_springs"}) {
    const auto& zones = j.at("body_zones").at(which);
    EXPECT_NEAR(zones.at("forearm").at("force_N").get<double>(), 2 * 1.8, 1e-12);
    EXPECT_NEAR(zones.at("forearm").at("friction_N").get<double>(), 0.5 * 1.8, 1e-12);
    EXPECT_NEAR(zones.at("forearm").at("mean_resultant_N").get<double>(), 1.8, 1e-12);  // of norms: it turns
    EXPECT_NEAR(zones.at("forearm").at("normal_share").get<double>(), 0.75, 1e-12);
    EXPECT_NEAR(zones.at("sum").at("force_N").get<double>(), 3 * 1.8, 1e-12);
  }

  const auto& forearm = j.at("contact")[1];
  EXPECT_EQ(forearm.at("segment"), "forearm");
  EXPECT_NEAR(forearm.at("peak_N").get<double>(), 3, 1e-12);
  EXPECT_NEAR(forearm.at("mean_N").get<double>(), 1.8, 1e-12);
  EXPECT_NEAR(forearm.at("share").get<double>(), 1, 1e-12);
  EXPECT_NEAR(j.at("supports")[0].at("mean_on_cloth_N")[2].get<double>(), 2, 1e-12);

  // Four windows after the first: 8 J rose, 4 (3 - 1.5) = 6 are explained, of 4 (3 + 1.5) = 18.
  EXPECT_NEAR(j.at("energy").at("drift_J").get<double>(), 2, 1e-12);
  EXPECT_NEAR(j.at("energy").at("drift_ratio").get<double>(), 2.0 / 18, 1e-12);
  EXPECT_EQ(j.at("momentum").at("largest_error_ratio"), 3e-12);
  EXPECT_EQ(j.at("deepest_penetration_m"), 1e-5);
  // All control points lie in one point, above the middle of the upper arm, whose radius there is 57 mm.
  EXPECT_NEAR(j.at("deepest_penetration_of_finer_surface").at("deepest_m").get<double>(), depth_m, 1e-7);
  EXPECT_EQ(j.at("steps").at("count"), 60);
  EXPECT_NEAR(j.at("steps").at("smallest_s").get<double>(), 1e-3 / 6, 1e-15);
  EXPECT_NEAR(j.at("steps").at("mean_s").get<double>(), 1e-3, 1e-15);
  EXPECT_EQ(j.at("steps").at("governing_term"), "bending");

  // To the last bit of what the recording stores.
  EXPECT_EQ(j.at("recording").at("stress_high_N_per_m").get<double>(), 1000.0);
  EXPECT_EQ(j.at("recording").at("last_frame_high_m")[1].get<double>(), double(0.06f));
  EXPECT_EQ(j.at("stress")[0].at("max_N_per_m").get<double>(), double(stress_high));
  EXPECT_EQ(j.at("stress")[0].at("max_time_s").get<double>(), 0.04);
  EXPECT_EQ(j.at("timings").at("wall_s"), 12.5);
  EXPECT_EQ(j.at("case_hash"), caseIdentity(s->definition));

  // As a study reads it.
  const study::RunNumbers read = study::readRun(folder.path());
  ASSERT_TRUE(read.good) << read.why;
  EXPECT_NEAR(read.joints.at(0).friction_Nm.value(), 0.075, 1e-12);
  ASSERT_EQ(read.zones.size(), 2u);
  EXPECT_NEAR(read.pressing_N(), 2 * 1.8, 1e-12);
  EXPECT_EQ(read.joints[0].movement(), "flexion");
  EXPECT_GT(read.joints[0].rate_at_peak, 0.02);  // the elbow flexes against the cloth
  EXPECT_NEAR(read.p99_strain(), 10, 1e-6);
  ASSERT_NE(read.leastComfortable(), nullptr);
  EXPECT_EQ(read.leastComfortable()->light, "green");

  const std::string torques = content(folder.path() / "torques.csv");
  EXPECT_EQ(torques.substr(0, torques.find('\n')), "time_s,elbow_flexion_Nm,elbow_flexion_friction_Nm");
  EXPECT_EQ(std::count(torques.begin(), torques.end(), '\n'), 6);
  double t = 0, tau = 0;
  ASSERT_EQ(std::sscanf(torques.c_str() + torques.find('\n') + 1, "%lf,%lf", &t, &tau), 2);
  EXPECT_NEAR(t, 0.005, 1e-12);
  EXPECT_NEAR(tau, 0.1, 1e-12);

  // What was damaged since is no number, and no joint.
  const auto damaged = [&](const char* file, const std::string& from, const std::string& to, const char* words) {
    const std::string whole = content(folder.path() / file);
    const std::size_t at = whole.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    folder.write(file, std::string(whole).replace(at, from.size(), to));
    const study::RunNumbers bad = study::readRun(folder.path());
    folder.write(file, whole);
    EXPECT_FALSE(bad.good) << words;
    EXPECT_NE(bad.why.find(file), std::string::npos) << bad.why;
    EXPECT_NE(bad.why.find(words), std::string::npos) << bad.why;
  };
  damaged("torques.csv", "\n0.005", "\nx.005", "is no number");
  damaged("pressures.csv", "_mean_so_far_Pa", "_mean_Pa", "has no column");
  damaged("summary.json", R"("side": "")", R"("side": "right hand side")", "is not one of the side");
}

TEST(Results, ReportSaysWhatWasMeasured) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path());
  writeResults(folder.path());
  const std::string page = content(folder.path() / "report.html");
  for (const char* text :
       {"Peak added elbow (flexion) torque", "0.300 Nm", "0.03 s", "flexion of the elbow against the garment",
        "degrees of flexion", "Cloth rests on bodies with its samples", "data:image/png;base64,",
        "governed by the bending term", "start held", "avx", "Which parts of the body bear the garment",
        "Force on the body over time", "Part of it from friction", "Nm at 0.03 s, against the motion",
        "hinders while the joint flexes", "strains below 2 %"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("The run stopped"), std::string::npos);
  EXPECT_EQ(content(folder.path() / "snapshots/01_stress_peak_left.png").substr(1, 3), "PNG");
}

TEST(Results, PicturesSideBySideTakeTheLargerScale) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path());
  const RecordingReader recording(folder.path());
  const PictureCase close{.field = PictureField::stress, .around = PictureAround::garment};
  PictureScale scale = scaleOf(*s, recording, 2, close);
  EXPECT_NEAR(scale.most_N, 1, 1e-12);  // one sample alone is pushed
  EXPECT_EQ(scale.high, 10);
  EXPECT_NEAR(scale.box_m.y, 0.12 + 2 * 0.06 * scale.size_m, 1e-3);
  // The whole arm, of which the sleeve covers the middle.
  const PictureScale whole = scaleOf(*s, recording, 2, {});
  EXPECT_GT(whole.size_m, scale.size_m + 0.05);
  for (const double c : {whole.box_m.x - scale.box_m.x, whole.box_m.y - scale.box_m.y, whole.box_m.z - scale.box_m.z})
    EXPECT_GT(c, -1e-9);
  // A single spot does not stretch the colours of all the rest.
  const PictureScale stressed = scaleOf(*s, recording, 4, close);
  EXPECT_EQ(stressed.high, 10);
  PictureScale other{1, 7, 0.1, {0, 9, 0}};
  other.include(stressed);
  EXPECT_EQ(other.high, stressed.high);
  EXPECT_EQ(other.most_N, 7);
  EXPECT_EQ(other.size_m, stressed.size_m);
  EXPECT_EQ(other.box_m.x, stressed.box_m.x);
  EXPECT_EQ(other.box_m.y, 9);
}

TEST(Results, SameRecordingSameBytes) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path());
  writeResults(folder.path());
  std::vector<std::string> first;
  const std::vector<std::string> names{"summary.json",
                                       "torques.csv",
                                       "contact.csv",
                                       "collisions.csv",
                                       "stress.csv",
                                       "report.html",
                                       "snapshots/01_stress_peak_left.png"};
  for (const std::string& name : names) first.push_back(content(folder.path() / name));
  writeResults(folder.path());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(content(folder.path() / names[i]), first[i]) << names[i];
  EXPECT_EQ(reportResults({folder.path(), folder.path() / "again.html"}), 0);
  EXPECT_EQ(content(folder.path() / "again.html"), first[5]);
}

TEST(Results, PartialRunSaysSo) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path(), 2);
  std::filesystem::remove(folder.path() / "run.json");  // as a killed run leaves it
  writeResults(folder.path());
  const auto j = nlohmann::json::parse(content(folder.path() / "summary.json"));
  EXPECT_NEAR(j.at("recorded_to_s").get<double>(), 0.02, 1e-12);
  EXPECT_NEAR(j.at("joints")[0].at("peak_Nm").get<double>(), 0.2, 1e-12);
  EXPECT_NE(content(folder.path() / "report.html").find("The run stopped at 0.02 s of 0.05 s"), std::string::npos);
}

/// Zheng 2013, table 4.1: means over the steps that looked.
TEST(Results, WhatAStepTakesToFindAndFreeIntersections) {
  const Folder folder;
  const auto s = buildScenario(sleeve());
  record(*s, folder.path());
  writeRunFacts({1, "", "", 4, {{"finding intersections", 0.35}, {"freeing intersections", 0.05}}, false, 20, 3.2},
                folder.path());
  writeResults(folder.path());
  const auto timings = nlohmann::json::parse(content(folder.path() / "summary.json")).at("timings");
  const auto& j = timings.at("intersections");
  EXPECT_EQ(j.at("steps"), 20);
  EXPECT_NEAR(j.at("step_ms").get<double>(), 160, 1e-9);
  EXPECT_NEAR(j.at("finding_ms").get<double>(), 17.5, 1e-9);
  EXPECT_NEAR(j.at("freeing_ms").get<double>(), 2.5, 1e-9);
  EXPECT_NEAR(j.at("share_of_freeing").get<double>(), 0.125, 1e-9);
  EXPECT_NEAR(j.at("share_of_the_step").get<double>(), 0.125, 1e-9);
}

TEST(Results, FactsSurviveAndDamageIsNamed) {
  const Folder folder;
  writeRunFacts({3, "avx2", "9.9", 1.25, {{"b", 2}, {"a", 1}}, true, 7, 0.5}, folder.path());
  const RunFacts f = readRunFacts(folder.path());
  EXPECT_EQ(f.threads, 3);
  EXPECT_EQ(f.version, "9.9");
  EXPECT_EQ(f.phases_s, (std::vector<std::pair<std::string, double>>{{"b", 2}, {"a", 1}}));
  EXPECT_TRUE(f.resumed);
  EXPECT_EQ(f.searches, 7);
  EXPECT_EQ(f.searched_steps_s, 0.5);
  const std::string windows = "\"windows\": ";
  const std::string whole = content(folder.path() / "run.json");
  const auto taken = [&](const std::string& rows) {
    const std::size_t at = whole.find(windows) + windows.size();
    folder.write("run.json", std::string(whole).replace(at, whole.find_first_of(",}\n", at) - at, rows));
    readRunFacts(folder.path());
  };
  EXPECT_NO_THROW(taken("[[0, 1, 0.5, 0.5], [1, 2, 1, 0.5]]"));
  for (const char* rows :
       {"[[]]", "[null]", "[[0]]", "[[0, 1, 0.5, 0.5], [1, 2, 1]]", "[[0, 1, 2, 3, 4]]", "[[0, 1, null, 3]]"})
    EXPECT_THROW(taken(rows), InputError) << rows;
  folder.write("run.json", "{\"version\": ");
  EXPECT_THROW(readRunFacts(folder.path()), InputError);
  EXPECT_THROW(recordedRun(folder.path()), InputError);
}

TEST(Results, FactsOfTheDeviceSurvive) {
  const Folder folder;
  RunFacts facts{3, "avx2", "9.9", 1.25, {{"a", 1}}};
  writeRunFacts(facts, folder.path());
  EXPECT_EQ(readRunFacts(folder.path()).device.kind, DeviceKind::cpu);
  EXPECT_EQ(content(folder.path() / "run.json").find("steps_by_cpu"), std::string::npos);
  facts.device = {DeviceKind::cuda,
                  "GPU X",
                  "580.82, CUDA 13.0",
                  "CUDA 12.4",
                  "abc",
                  900,
                  12,
                  2,
                  {{"impact zones", 5}, {"intersections", 7}}};
  writeRunFacts(facts, folder.path());
  const DeviceFacts d = readRunFacts(folder.path()).device;
  EXPECT_EQ(d.kind, DeviceKind::cuda);
  EXPECT_EQ(d.gpu, "GPU X");
  EXPECT_EQ(d.driver, "580.82, CUDA 13.0");
  EXPECT_EQ(d.runtime, "CUDA 12.4");
  EXPECT_EQ(d.kernels, "abc");
  EXPECT_EQ(d.steps, 900);
  EXPECT_EQ(d.by_cpu, 12);
  EXPECT_EQ(d.repeated, 2);
  EXPECT_EQ(d.reasons, facts.device.reasons);
  const std::string whole = content(folder.path() / "run.json");
  folder.write("run.json", replaced(whole, "\"cuda\"", "\"abacus\""));
  EXPECT_THROW(readRunFacts(folder.path()), InputError);
  folder.write("run.json", replaced(whole, "\"intersections\": 7", "\"intersections\": \"many\""));
  EXPECT_THROW(readRunFacts(folder.path()), InputError);
  // Runs of before had no devices.
  folder.write("run.json", whole.substr(0, whole.rfind(",\n  \"device\"")) + "\n}\n");
  EXPECT_EQ(readRunFacts(folder.path()).device.kind, DeviceKind::cpu);
}

TEST(Results, RoundedUpReadsWell) {
  EXPECT_EQ(roundedUp(0), 0);
  EXPECT_EQ(roundedUp(-1), 0);
  EXPECT_EQ(roundedUp(std::numeric_limits<double>::quiet_NaN()), 0);
  EXPECT_DOUBLE_EQ(roundedUp(1), 1);
  EXPECT_DOUBLE_EQ(roundedUp(0.031), 0.04);
  EXPECT_DOUBLE_EQ(roundedUp(87), 100);
  EXPECT_DOUBLE_EQ(roundedUp(1e-5 * 1.3), 1.5e-5);
}

TEST(Results, PhaseCountsFromTheOwnFootStrike) {
  const Strides strides{0.5, 1.1, 2, 0, 0.62};
  EXPECT_NEAR(strides.phase(0.5, "right"), 0, 1e-12);
  EXPECT_NEAR(strides.phase(0.5 + 0.55, "right"), 0.5, 1e-12);
  EXPECT_NEAR(strides.phase(0.5 + 0.55, "left"), 0, 1e-12);
  JointMeasure m;
  m.part = "hip", m.movement = "flexion", m.side = "right";
  m.peak = {-1, 1.5};
  m.rate_at_peak = 1, m.position_at_peak = 0.4, m.phase_at_peak = 0.8;
  EXPECT_EQ(causeOf(m, strides),
            "swing (80 % of the stride), while the hip flexes with the garment's push, at 23 degrees of flexion");
  m.peak.value = 1, m.phase_at_peak = 0.3, m.rate_at_peak = 0, m.position_at_peak = -0.2;
  EXPECT_EQ(causeOf(m, strides), "stance (30 % of the stride), while the hip is held, at 11 degrees of extension");
}

}  // namespace
}  // namespace gambeson
