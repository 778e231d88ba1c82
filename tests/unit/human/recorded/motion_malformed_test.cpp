#include <gtest/gtest.h>

#include "human/manikin/manikin.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/motion_file.hpp"
#include "human/skeleton/joint_map.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::expectRefused;
using test::Folder;
using test::replaced;

const std::string mot = "x\ninDegrees=yes\nendheader\ntime\ta\tb\n0\t1\t2\n0.1\t2\t3\n";
const std::string trc =
    "PathFileType\t4\t(X/Y/"
    "Z)\tw.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n100\t2\t2\tmm\nFrame#\tTime\tA\t\t\tB\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n1\t0\t1\t2\t3\t4\t5\t6\n2\t0.1\t1\t2\t3\t4\t5\t6\n";

TEST(MotionMalformed, OpenSimTables) {
  const Folder folder;
  EXPECT_TRUE(readStorage(folder.write("good.mot", mot)).in_degrees);
  EXPECT_FALSE(
      readStorage(folder.write("good.sto", replaced(mot, "inDegrees=yes", "Angles are in radians."))).in_degrees);
  const auto refused = [&](const std::string& from, const std::string& to, int line, const char* words) {
    expectRefused([](const auto& f) { readStorage(f); }, folder.write("m.mot", replaced(mot, from, to)), line, words);
  };
  refused("endheader", "", 0, "endheader");
  refused("inDegrees=yes", "inDegrees=maybe", 2, "yes or no");
  refused("inDegrees=yes", "", 3, "does not say in what its angles are");
  refused("time\ta", "t\ta", 4, "not time");
  refused("a\tb", "a\ta", 4, "stands twice");
  refused("0.1\t2\t3", "0.1\t2", 6, "has 2 values");
  refused("0.1\t2\t3", "0\t2\t3", 6, "does not come after");
  refused("0.1\t2\t3", "0.1\t2\tnan", 6, "column 3 'b'");
  refused("0.1\t2\t3\n", "", 5, "at least two rows");
}

TEST(MotionMalformed, Markers) {
  const Folder folder;
  const MarkerTable good = readTrc(folder.write("good.trc", replaced(trc, "4\t5\t6\n2", "\t\t\n2")));
  EXPECT_TRUE(std::isnan(good.positions[0][1].x));
  EXPECT_NEAR(good.positions[1][1].z, 0.006, 1e-15);
  const auto refused = [&](const std::string& from, const std::string& to, int line, const char* words) {
    expectRefused([](const auto& f) { readTrc(f); }, folder.write("m.trc", replaced(trc, from, to)), line, words);
  };
  refused("PathFileType", "Path", 1, "PathFileType");
  refused("\tmm\n", "\tinch\n", 3, "mm, cm, dm or m");
  refused("100\t2\t2\tmm", "100\t2\tmm", 3, "has 3 values for the 4 names");
  refused("Frame#\tTime", "Frame\tTime", 4, "Frame# and Time");
  refused("B\t\t\n", "A\t\t\n", 4, "stands twice");
  refused("A\t\t\tB", "A\t\tB", 4, "first of three columns");
  refused("2\t0.1\t1\t2\t3", "2\t0.1\t1\t\t3", 7, "only some of its three coordinates");
  refused("2\t0.1\t1", "2\t0.1\tone", 7, "not a finite number");
  refused("2\t0.1", "2\t-1", 7, "does not come after");
  refused("5\t6\n2", "5\t6\t7\n2", 6, "has 9 values");
}

TEST(MotionMalformed, JointMaps) {
  const Folder folder;
  const std::string good = R"({"reads": "coordinates", "has": [], "forward": "x", "up": "y",
 "root": {"turns": [["a", "z"], ["b", "x"], ["c", "y"]], "position": ["x", "y", "z"], "hips_m": [0, 0, 0]},
 "joints": {"knee_flexion_right": {"from": "k", "scale": -1}}})";
  EXPECT_EQ(parseJointMap(good, "good").joints.at("knee_flexion_right").scale, -1);
  const auto refused = [&](const std::string& from, const std::string& to, int line, const char* words) {
    expectRefused([](const auto& f) { findJointMap(f.string()); }, folder.write("m.json", replaced(good, from, to)),
                  line, words);
  };
  refused("\"coordinates\"", "\"angles\"", 0, "'angles' is not allowed: coordinates");
  refused("\"forward\": \"x\"", "\"forward\": \"w\"", 0, "x, y, z, -x");
  refused("\"up\": \"y\"", "\"up\": \"-x\"", 0, "across");
  refused("\"up\": \"y\"", "\"up\": \"y\", \"down\": 1", 0, "down: is not known here");
  refused("[\"a\", \"z\"], ", "", 0, "three pairs");
  refused("\"scale\": -1", "\"scale\": 0", 0, "joints.knee_flexion_right.scale: must not be 0");
  refused("\"scale\": -1", "\"sign\": -1", 0, "is not known here");
  refused("\"has\": [],", "\"has\": []", 1, "is not JSON");
  refused("[0, 0, 0]", "[0, 0]", 0, "three numbers");
  EXPECT_THROW(findJointMap("gait2393"), InputError);
  for (const JointMap& m : shippedMaps()) EXPECT_EQ(findJointMap(m.name).has, m.has);
}

TEST(MotionMalformed, ModelsWindowsAndOtherFiles) {
  const Folder folder;
  const Human human = makeManikin("male_p50");
  const auto osim = [&](const std::string& text, const char* words) {
    expectRefused([](const auto& f) { readOsim(f); }, folder.write("m.osim", text), 1, words);
  };
  osim("<Robot/>", "OpenSimDocument");
  osim("<OpenSimDocument><Model/></OpenSimDocument>", "has no <BodySet>");
  osim("<OpenSimDocument><Model><BodySet><objects><Body/></objects></BodySet></Model></OpenSimDocument>",
       "has no name");
  osim(
      "<OpenSimDocument><Model><BodySet><objects/></BodySet><MarkerSet><objects><Marker name=\"m\"><body>b</body>"
      "<location>0 0 0</location></Marker></objects></MarkerSet></Model></OpenSimDocument>",
      "that is not there");
  // A function without its number, and a step between two points.
  const std::string moved =
      "<OpenSimDocument><Model><BodySet><objects><Body name=\"a\"/><Body name=\"b\"><Joint><CustomJoint><parent_body>a"
      "</parent_body><location_in_parent>0 0 0</location_in_parent><SpatialTransform><TransformAxis "
      "name=\"translation1\">"
      "<axis>1 0 0</axis>FUNCTION</TransformAxis></SpatialTransform></CustomJoint></Joint></Body></objects></BodySet>"
      "</Model></OpenSimDocument>";
  const auto by = [&](const char* function) { return test::replaced(moved, "FUNCTION", function); };
  osim(by("<Constant><value/></Constant>"), "has 0 numbers, not 1");
  osim(by("<Constant><value>1 2</value></Constant>"), "has 2 numbers, not 1");
  osim(by("<MultiplierFunction><function><Constant><value>1</value></Constant></function><scale> </scale>"
          "</MultiplierFunction>"),
       "has 0 numbers, not 1");
  const OsimModel model = readOsim(folder.write("step.osim", by("<SimmSpline><x>-1 0 0</x><y>1 2 3</y></SimmSpline>")));
  EXPECT_EQ(model.body("b").originAt(0), (Vec3{3, 0, 0}));
  EXPECT_EQ(model.body("b").originAt(-0.5), (Vec3{1.5, 0, 0}));
  MotionFileOptions o;
  const auto refused = [&](const std::string& name, const std::string& text, const char* words) {
    o.path = folder.write(name, text);
    expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, words);
  };
  refused("a.c3d", "binary", "write its markers as .trc");
  refused("a.fbx", "x", "'.fbx' is not read");
  refused("a.csv", "time_s\n", "trajectory");
  refused("a.mot", mot, "no map that ships goes with the names");
  refused("a.trc", trc, "no map that ships goes with the names");
  o.map = "snu_woody";
  refused("b.mot", mot, "reads another kind of file");
  o.map = "gait2392";
  refused("c.mot", mot, "is missing in the file; the map 'gait2392' asks for it");
  o.up = "z";
  refused("d.mot", mot, "go together");
}

}  // namespace
}  // namespace gambeson
