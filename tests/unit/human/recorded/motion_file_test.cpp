#include "human/recorded/motion_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "human/manikin/manikin.hpp"
#include "human/motion/curve.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk.hpp"
#include "human/recorded/retarget.hpp"
#include "unit/human/files/files.hpp"
#include "unit/human/recorded/recorded.hpp"

namespace gambeson {
namespace {

using test::Folder;
using test::replaced;

class MotionFile : public testing::Test {
 protected:
  Human human = makeManikin("male_p50");
  const Skeleton& s = human.skeleton;
  std::unique_ptr<Motion> walk = makeWalk(human, {});
  Folder folder;
  double from = 0.5, to = 2.5;

  void sameAsWalk(const CapturedMotion& r, double joints_rad, const std::vector<std::string>& but = {}) {
    for (std::size_t i = 0; i < r.times.size(); ++i) {
      const Posture p = walk->at(r.times[i]);
      for (std::size_t j = 0; j < p.q.size(); ++j)
        if (r.driven[j] && std::find(but.begin(), but.end(), s.joints[j].name) == but.end()) {
          ASSERT_NEAR(r.q[i][j], p.q[j], joints_rad) << s.joints[j].name << " at " << r.times[i];
        }
      ASSERT_LT(norm(r.hips[i] - p.root.origin), 1e-6);
      ASSERT_LT(norm(r.pelvis[i].a - p.root.rotation.a) + norm(r.pelvis[i].c - p.root.rotation.c), 1e-6);
    }
  }
};

TEST_F(MotionFile, OurWalkComesBackFromOpenSimColumnsInDegreesAndRadians) {
  const JointMap map = findJointMap("gait2392");
  for (const bool degrees : {true, false}) {
    const auto file = folder.write("walk.mot", test::motOf(*walk, human, map, from, to, degrees));
    const StorageTable table = readStorage(file);
    EXPECT_EQ(table.notes.size(), 2u);  // the header's counts are wrong
    sameAsWalk(recordAngles(table, map, human), 1e-8);
  }
}

// Between the rows: our walk is a C2 spline of 50 knots whose third derivative jumps by some 1e4 rad/s^3; a spline over
// steps h of 10 ms errs by about jump h^3 / 96, 1e-4 rad; in the first and last intervals by that of a slope from a
// parabola, h^3 q^(3) / 20.
TEST_F(MotionFile, BetweenTheRowsItErrsByTheInterpolationOnly) {
  MotionFileOptions o;
  o.path = folder.write("walk.mot", test::motOf(*walk, human, findJointMap("gait2392"), 0.3, 2.7, true));
  o.from_s = from, o.to_s = to, o.lead_in_s = 0, o.scale = 1, o.floor_m = 0;
  MotionFileNotes notes;
  const auto motion = loadMotionFile(o, human, &notes);
  EXPECT_EQ(notes.map, "gait2392");
  EXPECT_NEAR(motion->duration(), 2, 1e-12);
  const Posture first = walk->at(from);
  const double heading = anglesOf(first.root.rotation).z - anglesOf(motion->at(0).root.rotation).z;
  for (int i = 0; i <= 777; ++i) {
    const double t = 2.0 * i / 777;
    const Posture a = motion->at(t), b = walk->at(from + t);
    const double bound = t < 0.03 || t > 1.97 ? 5e-4 : 2e-4;
    for (std::size_t j = 0; j < a.q.size(); ++j)
      if (s.joints[j].name.find("shoulder") == std::string::npos &&
          s.joints[j].name.find("elbow") == std::string::npos) {
        ASSERT_NEAR(a.q[j], b.q[j], bound) << s.joints[j].name << " at " << t;
      }
    const Vec3 way = rotationAbout({0, 0, 1}, -heading) * (b.root.origin - first.root.origin);
    ASSERT_NEAR(a.root.origin.x, way.x, bound);
    ASSERT_NEAR(a.root.origin.y, way.y, bound);
    ASSERT_NEAR(a.root.origin.z, b.root.origin.z, bound);
  }
}

/// A body that is carried or turned without measure, or so fast that no number says how fast, is refused with its file.
TEST_F(MotionFile, NowhereIsNoPlace) {
  const std::string text = test::motOf(*walk, human, findJointMap("gait2392"), from, 0.7, true);
  const std::size_t first = text.find('\n', text.find("\ntime") + 1) + 1, end = text.find('\n', first);
  const std::vector<std::string> names = readStorage(folder.write("walk.mot", text)).names;
  MotionFileOptions o;
  o.map = "gait2392";
  const auto refused = [&](const std::string& name, const std::string& value, const char* words) {
    std::istringstream cells(text.substr(first, end - first));
    std::string row, cell;
    for (std::size_t k = 0; std::getline(cells, cell, '\t'); ++k)
      row += (k == 0 ? "" : "\t") + (name == (k == 0 ? "time" : names[k - 1]) ? value : cell);
    o.path = folder.write("far.mot", text.substr(0, first) + row + text.substr(end));
    SCOPED_TRACE(name + " " + value);
    test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, words);
  };
  for (const char* value : {"1e7", "-1e300", "1e308"})
    for (const char* name : {"pelvis_tx", "pelvis_ty", "pelvis_tz"}) refused(name, value, "the body is nowhere");
  refused("time", "0.50999999999", "comes less than 1e-09 s after");
  o.path = folder.write("near.mot", test::motOf(*walk, human, findJointMap("gait2392"), from, 0.7, true));
  EXPECT_NO_THROW(loadMotionFile(o, human));
}

/// OpenSim 4 names coordinates by their paths; SIMM's headers do not say that angles are in degrees.
TEST_F(MotionFile, NamesMayBePathsAndHeadersOld) {
  const JointMap map = findJointMap("gait2392");
  std::string text = test::motOf(*walk, human, map, from, to, true);
  const StorageTable plain = readStorage(folder.write("plain.mot", text));
  const std::size_t labels = text.find("\ntime") + 1, end = text.find('\n', labels);
  std::string paths = "time";
  for (const std::string& name : plain.names) paths += "\t/jointset/some_joint/" + name + "/value";
  const StorageTable named = readStorage(folder.write("paths.sto", text.substr(0, labels) + paths + text.substr(end)));
  EXPECT_EQ(named.names, plain.names);
  EXPECT_EQ(named.columns, plain.columns);
  const std::string simm = "name walk\ndatacolumns 7\ndatarows 7\notherdata 1\nrange 0 2\nendheader\n";
  const StorageTable old = readStorage(folder.write("old.mot", simm + text.substr(labels)));
  EXPECT_TRUE(old.in_degrees);
  EXPECT_EQ(old.columns, plain.columns);
  EXPECT_NE(old.notes.front().find("degrees, as in SIMM's motions"), std::string::npos);
  // Without any of it nothing is guessed.
  test::expectRefused([](const auto& f) { readStorage(f); },
                      folder.write("none.sto", "walk\nversion=1\nendheader\n" + text.substr(labels)), 0, "inDegrees");
}

/// A file whose first frame is a pose apart jumps to its second: continued backwards at that speed, joints bent by
/// hundreds of degrees in the lead-in.
TEST_F(MotionFile, AFirstFrameApartIsNotContinued) {
  std::string text = test::motOf(*walk, human, findJointMap("gait2392"), from, to, true);
  const std::size_t first = text.find('\n', text.find("\ntime") + 1) + 1, second = text.find('\n', first);
  std::string apart = text.substr(first, text.find('\t', first) - first);  // its time
  for (const std::string& name : readStorage(folder.write("walk.mot", text)).names)
    apart += name == "hip_flexion_r" ? "\t100" : name == "pelvis_ty" ? "\t0.95" : "\t0";
  MotionFileOptions o;
  o.path = folder.write("apart.mot", text.substr(0, first) + apart + text.substr(second));
  o.map = "gait2392";
  MotionFileNotes notes;
  const auto motion = loadMotionFile(o, human, &notes);
  EXPECT_LT(notes.beyond_limits_deg, 45);
  bool said = false;
  for (const std::string& line : notes.lines)
    said = said || line.find("a pose apart from the motion?") != std::string::npos;
  EXPECT_TRUE(said);
  // The walk alone has no such jump.
  o.path = folder.path / "walk.mot";
  MotionFileNotes none;
  loadMotionFile(o, human, &none);
  for (const std::string& line : none.lines) EXPECT_EQ(line.find("a pose apart"), std::string::npos) << line;
}

TEST_F(MotionFile, ChoosesTheMapByTheKneesSign) {
  JointMap map = findJointMap("gait2392");
  MotionFileOptions o;
  MotionFileNotes notes;
  o.path = folder.write("negative.mot", test::motOf(*walk, human, map, from, to, true));
  loadMotionFile(o, human, &notes);
  EXPECT_EQ(notes.map, "gait2392");
  for (const char* knee : {"knee_flexion_right", "knee_flexion_left"}) map.joints[knee].scale = 1;
  o.path = folder.write("positive.mot", test::motOf(*walk, human, map, from, to, true));
  loadMotionFile(o, human, &notes);
  EXPECT_EQ(notes.map, "rajagopal");
  o.map = "gait2392";  // and the wrong one is refused, with the row
  test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, "does the map have its sign right");
}

// The same motion turned by 170 degrees passes 180: the file wraps, the motion does not.
TEST_F(MotionFile, AnglesThatWrapGoOnWithoutJumps) {
  const JointMap map = findJointMap("gait2392");
  std::string text = "x\ninDegrees=yes\nendheader\ntime";
  for (const auto& n : map.has) text += "\t" + n;
  text +=
      "\thip_adduction_r\thip_rotation_r\thip_adduction_l\thip_rotation_l\tlumbar_extension\tlumbar_bending\tlumbar_"
      "rotation\n";
  for (int i = 0; i < 20; ++i) {
    const double yaw = std::remainder(100.0 + 15 * i, 360.0);
    text += fmt::format("{}\t0\t0\t{}\t0\t1\t0\t{}\t0\t-10\t-370\t0\t0\t0\t0\t0\t0\t0\t0\t0\n", 0.1 * i, yaw,
                        i % 2 ? 365 : 5);
  }
  MotionFileOptions o;
  o.path = folder.write("turn.mot", text);
  o.lead_in_s = 0;
  const auto m = loadMotionFile(o, human);
  EXPECT_NEAR(m->at(0.35).q[s.joint("hip_flexion_right")], 5 * rad_per_deg, 1e-9);
  EXPECT_NEAR(m->at(0.35).q[s.joint("knee_flexion_left")], 10 * rad_per_deg, 1e-9);
  for (int i = 0; i < 190; ++i) {
    const double d = anglesOf(m->at(0.01 * (i + 1)).root.rotation).z - anglesOf(m->at(0.01 * i).root.rotation).z;
    EXPECT_NEAR(std::remainder(d, 2 * std::numbers::pi), 1.5 * rad_per_deg, 1e-6);
  }
  o.heading = Heading::straight;
  const auto straight = loadMotionFile(o, human);
  EXPECT_NEAR(anglesOf(straight->at(1).root.rotation).z, 0, 1e-6);
}

TEST_F(MotionFile, LeadsInFromStandingWithContinuousVelocity) {
  MotionFileOptions o;
  o.path = folder.write("walk.mot", test::motOf(*walk, human, findJointMap("gait2392"), from, to, true));
  o.stand_s = 0.2;
  for (const double begin : {0.5, 1.1}) {  // without and with something before the window
    o.from_s = begin;
    MotionFileNotes notes;
    const auto m = loadMotionFile(o, human, &notes);
    EXPECT_NEAR(notes.window_s, 0.7, 1e-12);
    const Posture rest = standing(human);
    for (const double t : {0.0, 0.1, 0.2}) EXPECT_EQ(m->at(t).q, rest.q);
    EXPECT_LT(norm(m->at(0.2).root.origin - rest.root.origin), 1e-9);
    for (std::size_t j = 0; j < rest.q.size(); ++j)
      if (s.joints[j].name.starts_with("knee")) {
        EXPECT_NEAR(m->at(0.7).q[j], walk->at(begin).q[j], 1e-9);
      }
    const double h = 1e-6;
    for (int i = 1; i < 2 * 1499; ++i) {
      const double t = m->duration() * i / 2999;
      const Posture a = m->at(t - h), b = m->at(t), c = m->at(t + h);
      for (std::size_t j = 0; j < b.q.size(); ++j)
        ASSERT_NEAR((b.q[j] - a.q[j]) / h, (c.q[j] - b.q[j]) / h, 5e-3) << s.joints[j].name << " at " << t;
      ASSERT_LT(norm((b.root.origin - a.root.origin) / h - (c.root.origin - b.root.origin) / h), 1e-3) << t;
    }
    EXPECT_LT(notes.feet.deepest_m, 0.012);
    EXPECT_LT(notes.feet.highest_m, 0.012);
  }
}

// A treadmill: the same walk with the pelvis kept in place is noticed, and goes as far as the walk where the feet say
// so.
TEST_F(MotionFile, FeetTakeAWalkerOffTheTreadmill) {
  class Treadmill : public Motion {
   public:
    explicit Treadmill(const Motion& m) : m_(m) {}
    double duration() const override { return m_.duration(); }
    Posture at(double t) const override {
      Posture p = m_.at(t);
      p.root.origin.x = p.root.origin.y = 0;
      return p;
    }
    const Motion& m_;
  };
  MotionFileOptions o;
  o.path = folder.write("t.mot", test::motOf(Treadmill(*walk), human, findJointMap("gait2392"), from, to, true));
  o.lead_in_s = 0;
  MotionFileNotes notes;
  loadMotionFile(o, human, &notes);
  ASSERT_FALSE(notes.lines.empty());
  EXPECT_NE(notes.lines[2].find("treadmill"), std::string::npos) << notes.lines[2];
  o.travel = Travel::feet;
  const auto m = loadMotionFile(o, human, &notes);
  const double walked = walk->at(to).root.origin.x - walk->at(from).root.origin.x;
  EXPECT_NEAR(m->at(2).root.origin.x - m->at(0).root.origin.x, walked, 0.03 * walked);
}

TEST_F(MotionFile, RepeatsAStrideAndRefusesWhatIsNone) {
  const JointMap map = findJointMap("gait2392");
  MotionFileOptions o;
  o.path = folder.write("stride.mot", test::motOf(*walk, human, map, 0.5, 1.6, true));
  o.lead_in_s = 0, o.repeat = 3, o.slower = 2, o.scale = 1;
  const auto m = loadMotionFile(o, human);
  EXPECT_NEAR(m->duration(), 6.6, 1e-9);
  const int hip = s.joint("hip_flexion_left");
  EXPECT_NEAR(m->at(1).q[hip], m->at(5.4).q[hip], 1e-6);
  EXPECT_NEAR(m->at(1).q[hip], walk->at(1).q[hip], 1e-3);
  EXPECT_GT(m->at(6.6).root.origin.x, 2.9 * m->at(2.2).root.origin.x);
  o.path = folder.write("half.mot", test::motOf(*walk, human, map, 0.5, 1.1, true));
  test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, "not one whole stride");
}

// The thigh's marker lies beside the hip, not beside the slightly slanting bone: some 1e-4 rad while the knee is
// straight.
TEST_F(MotionFile, OurWalkComesBackFromMarkersAtItsJoints) {
  std::vector<test::MarkerOn> markers{{"SACR", "pelvis", {-0.15, 0, 0}}};
  for (const std::string& side : {std::string("right"), std::string("left")}) {
    const std::string R = side == "right" ? "R" : "L";
    const double y = side == "right" ? -1 : 1;
    const Vec3 middle = 0.5 * s.joints[s.joint("knee_flexion_" + side)].X_PJ.origin;  // of the thigh's bone
    markers.push_back({R + "HJC", "thigh_" + side, {}});
    markers.push_back({R + "KJC", "shank_" + side, {}});
    markers.push_back({R + "AJC", "foot_" + side, {}});
    markers.push_back({R + "HEE", "foot_" + side, {-0.05, 0, -0.04}});
    markers.push_back({R + "TOE", "foot_" + side, {0.15, 0, -0.04}});
    markers.push_back({R + "THI", "thigh_" + side, middle + Vec3{0, 0.1 * y, 0}});
  }
  const auto file = folder.write("walk.trc", test::trcOf(*walk, human, markers, from, to));
  sameAsWalk(recordMarkers(readTrc(file), findJointMap("joint_centres"), nullptr, human), 1e-6,
             {"lumbar_flexion", "lumbar_bending", "lumbar_rotation"});
}

/// A model of OpenSim's whose bodies are our links, with three markers each where gait2392 has them.
std::string modelOf(const Human& human, std::vector<test::MarkerOn>& markers) {
  const Skeleton& s = human.skeleton;
  const Mat3 A = axesOf({1, 0, 0}, {0, 1, 0});
  const auto triple = [&](const Vec3& ours) {
    const Vec3 v = transpose(A) * ours;
    return fmt::format("{} {} {}", v.x, v.y, v.z);
  };
  std::string bodies = "<Body name=\"pelvis\"/><Body name=\"torso\"/>", set;
  const auto body = [&](const std::string& name, const std::string& parent, const Vec3& at) {
    bodies += fmt::format(
        "<Body name=\"{}\"><Joint><CustomJoint><parent_body>{}</parent_body><location_in_parent>{}"
        "</location_in_parent></CustomJoint></Joint></Body>",
        name, parent, triple(at));
  };
  const auto marker = [&](const std::string& name, const std::string& of, const std::string& link, const Vec3& at) {
    markers.push_back({name, link, at});
    set += fmt::format("<Marker name=\"{}\"><body>{}</body><location>{}</location></Marker>", name, of, triple(at));
  };
  marker("R.ASIS", "pelvis", "pelvis", {0.1, -0.13, 0.1}), marker("L.ASIS", "pelvis", "pelvis", {0.1, 0.13, 0.1});
  marker("V.Sacral", "pelvis", "pelvis", {-0.1, 0, 0.1});
  marker("Sternum", "torso", "torso", {0.1, 0, 0.3}), marker("R.Acromium", "torso", "torso", {0, -0.17, 0.4});
  marker("L.Acromium", "torso", "torso", {0, 0.17, 0.4});
  for (const std::string& side : {std::string("right"), std::string("left")}) {
    const std::string R = side == "right" ? "R" : "L", r = side == "right" ? "_r" : "_l", of = "_" + side;
    const double y = side == "right" ? -1 : 1;
    body("femur" + r, "pelvis", s.joints[s.joint("hip_flexion" + of)].X_PJ.origin);
    body("tibia" + r, "femur" + r, s.joints[s.joint("knee_flexion" + of)].X_PJ.origin);
    body("talus" + r, "tibia" + r, s.joints[s.joint("ankle_flexion" + of)].X_PJ.origin);
    body("calcn" + r, "talus" + r, {-0.05, 0, -0.04});
    const Vec3 calcn{-0.05, 0, -0.04};
    for (const auto& [name, of_body, link, base] :
         {std::tuple{"Thigh", "femur", "thigh", Vec3{0, 0, -0.25}}, {"Shank", "tibia", "shank", Vec3{0, 0, -0.1}}}) {
      marker(R + "." + name + ".Upper", of_body + r, link + of, base + Vec3{0, 0.08 * y, 0.05});
      marker(R + "." + name + ".Front", of_body + r, link + of, base + Vec3{0.1, 0, 0});
      marker(R + "." + name + ".Rear", of_body + r, link + of, base + Vec3{-0.02, 0.08 * y, -0.08});
    }
    const auto on_foot = [&](const std::string& name, const Vec3& at) {  // `at` in the heel bone's frame
      markers.push_back({R + name, "foot" + of, at + calcn});
      set += fmt::format("<Marker name=\"{}\"><body>calcn{}</body><location>{}</location></Marker>", R + name, r,
                         triple(at));
    };
    on_foot(".Heel", {-0.02, 0, 0.01}), on_foot(".Toe.Tip", {0.25, 0, 0}),
        on_foot(".Midfoot.Lat", {0.12, 0.06 * y, 0.01});
  }
  return "<OpenSimDocument Version=\"20303\"><Model><BodySet><objects>" + bodies +
         "</objects></BodySet><MarkerSet><objects>" + set + "</objects></MarkerSet></Model></OpenSimDocument>";
}

TEST_F(MotionFile, OurWalkComesBackFromMarkersOnAModel) {
  std::vector<test::MarkerOn> markers;
  MotionFileOptions o;
  o.model = folder.write("m.osim", modelOf(human, markers));
  o.path = folder.write("walk.trc", test::trcOf(*walk, human, markers, from, 1.0));
  const OsimModel model = readOsim(o.model);
  sameAsWalk(recordMarkers(readTrc(o.path), findJointMap("gait2392_markers"), &model, human), 1e-5);
  MotionFileNotes notes;
  loadMotionFile(o, human, &notes);
  EXPECT_EQ(notes.map, "gait2392_markers");
  EXPECT_NEAR(notes.scale, 1, 1e-9);
  o.model.clear();
  test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, "scaled OpenSim model");
}

}  // namespace
}  // namespace gambeson
