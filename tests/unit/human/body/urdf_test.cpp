#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "human/body/body_file.hpp"
#include "human/body/urdf.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "tools/data_folder.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::expectRefused;
using test::Folder;
using test::replaced;

/// Line numbers of the elements are those that the tests expect.
const std::string arm = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 -0.1"/>
      <mass value="2"/>
      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    </inertial>
    <visual>
      <origin xyz="0 0 -0.15" rpy="0 1.5707963267948966 0"/>
      <geometry><cylinder radius="0.05" length="0.3"/></geometry>
    </visual>
  </link>
  <link name="lower">
    <visual><geometry><box size="0.1 0.2 0.3"/></geometry></visual>
    <visual><geometry><sphere radius="0.07"/></geometry></visual>
  </link>
  <link name="tool"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/>
    <child link="upper"/>
    <origin xyz="0 0 1" rpy="0 0 0"/>
    <axis xyz="0 -2 0"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/>
  </joint>
  <joint name="elbow" type="continuous">
    <parent link="upper"/>
    <child link="lower"/>
    <origin xyz="0 0 -0.3"/>
    <axis xyz="1 0 0"/>
    <mimic joint="shoulder" multiplier="0.5" offset="0.1"/>
  </joint>
  <joint name="slide" type="prismatic">
    <parent link="lower"/>
    <child link="tool"/>
    <axis xyz="0 0 1"/>
    <limit lower="0" upper="0.2" effort="1" velocity="1"/>
    <mimic joint="elbow" multiplier="2" offset="0.01"/>
  </joint>
</robot>
)";

TEST(Urdf, ReadsLinksJointsMimicsAndShapes) {
  const Folder folder;
  const Human h = loadUrdf(folder.write("arm.urdf", arm));
  const Skeleton& s = h.skeleton;
  ASSERT_EQ(s.links.size(), 4u);
  ASSERT_EQ(s.joints.size(), 3u);
  EXPECT_EQ(s.links[0].name, "base");
  EXPECT_DOUBLE_EQ(h.mass_kg, 2);
  EXPECT_DOUBLE_EQ(s.links[1].center_of_mass.z, -0.1);
  EXPECT_EQ(s.joints[0].axis, (Vec3{0, -1, 0}));
  EXPECT_DOUBLE_EQ(s.joints[0].upper, 2);
  EXPECT_TRUE(std::isinf(s.joints[1].upper));
  // slide = 2 elbow + 0.01 = 2 (0.5 shoulder + 0.1) + 0.01
  ASSERT_TRUE(s.joints[2].mimic_of.has_value());
  EXPECT_EQ(*s.joints[2].mimic_of, 0);
  EXPECT_DOUBLE_EQ(s.joints[2].mimic_multiplier, 1);
  EXPECT_DOUBLE_EQ(s.joints[2].mimic_offset, 0.21);
  const auto X = linkPoses(s, std::vector<double>{0.4, 0, 0}, {});
  const Pose expected = Pose{rotationAbout({0, -1, 0}, 0.4), {0, 0, 1}} *
                        Pose{rotationAbout({1, 0, 0}, 0.3), {0, 0, -0.3}} * Pose{{}, {0, 0, 0.61}};
  EXPECT_LT(norm(X[3].origin - expected.origin), 1e-14);

  ASSERT_EQ(h.shapes.size(), 3u);
  EXPECT_EQ(h.shapes[2].name, "lower_1");
  EXPECT_EQ(std::get<Ellipsoid>(h.shapes[2].shape).semi_axes, (Vec3{0.07, 0.07, 0.07}));
  // Closed forms: the volumes of the box, and of the prism over the 48-gon.
  const auto volume = [](const Shape& shape) {
    double v = 0;
    const auto& m = std::get<TriangleMesh>(shape);
    for (const auto& t : m.triangles) v += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
    return v;
  };
  EXPECT_NEAR(volume(h.shapes[1].shape), 0.1 * 0.2 * 0.3, 1e-15);
  EXPECT_NEAR(volume(h.shapes[0].shape), 24 * std::sin(2 * std::numbers::pi / 48) * 0.05 * 0.05 * 0.3, 1e-15);
  // The cylinder lies along x: rpy = (0, 90 degrees, 0) turns z to x.
  EXPECT_LT(norm(h.shapes[0].X_LS.rotation * Vec3{0, 0, 1} - Vec3{1, 0, 0}), 1e-15);
}

TEST(Urdf, FloatingJointAtTheRootIsTheRootsFreedom) {
  const Folder folder;
  const std::string text = replaced(arm, "type=\"revolute\"", "type=\"floating\"");
  const Human h = loadUrdf(
      folder.write("a.urdf", replaced(text, "<mimic joint=\"shoulder\" multiplier=\"0.5\" offset=\"0.1\"/>", "")));
  EXPECT_EQ(h.skeleton.links[0].name, "upper");
  EXPECT_EQ(h.skeleton.joints[0].name, "elbow");
  EXPECT_EQ(h.skeleton.links[1].parent_joint, 0);
  expectRefused(loadUrdf, folder.write("b.urdf", replaced(arm, "\"prismatic\"", "\"floating\"")), 34, "floating");
}

TEST(Urdf, ManikinsReadBackEqual) {
  const Folder folder;
  for (const std::string& name : manikinNames()) {
    writeManikin(name, folder.path / "m.urdf", folder.path / "m.json");
    const Human a = makeManikin(name), b = loadHuman(folder.path / "m.urdf", folder.path / "m.json");
    EXPECT_EQ(a.mass_kg, b.mass_kg);
    EXPECT_EQ(a.stature_m, b.stature_m);
    EXPECT_EQ(a.skeleton.name, b.skeleton.name);
    ASSERT_EQ(a.skeleton.links.size(), b.skeleton.links.size());
    for (std::size_t i = 0; i < a.skeleton.links.size(); ++i) {
      const Link &l = a.skeleton.links[i], &m = b.skeleton.links[i];
      EXPECT_TRUE(l.name == m.name && l.parent_joint == m.parent_joint && l.mass_kg == m.mass_kg &&
                  l.center_of_mass == m.center_of_mass)
          << l.name;
    }
    ASSERT_EQ(a.skeleton.joints.size(), b.skeleton.joints.size());
    for (std::size_t i = 0; i < a.skeleton.joints.size(); ++i) {
      const Joint &j = a.skeleton.joints[i], &k = b.skeleton.joints[i];
      EXPECT_TRUE(j.name == k.name && j.type == k.type && j.parent == k.parent && j.child == k.child &&
                  j.X_PJ == k.X_PJ)
          << j.name;
      EXPECT_TRUE(j.axis == k.axis && j.lower == k.lower && j.upper == k.upper && j.mimic_of == k.mimic_of) << j.name;
    }
    ASSERT_EQ(a.shapes.size(), b.shapes.size());
    for (std::size_t i = 0; i < a.shapes.size(); ++i) {
      const BodyShape &s = a.shapes[i], &t = b.shapes[i];
      EXPECT_TRUE(s.link == t.link && s.name == t.name && s.X_LS == t.X_LS) << s.name;
      EXPECT_EQ(std::get<Ellipsoid>(s.shape).semi_axes, std::get<Ellipsoid>(t.shape).semi_axes);
    }
  }
}

struct Subject {
  const char* file;
  int revolute;
  double mass_kg, stature_m;
};
void PrintTo(const Subject& s, std::ostream* out) { *out << s.file; }
class PublicUrdf : public testing::TestWithParam<Subject> {};

// Numbers of joints and masses: the files' names and descriptions (human-gazebo, humanSubject01 and 03).
TEST_P(PublicUrdf, Loads) {
  const auto file = test::dataFolder() / "real" / "human" / GetParam().file;
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no public data: " << file;
  const Human h = loadUrdf(file);
  EXPECT_EQ(std::count_if(h.skeleton.joints.begin(), h.skeleton.joints.end(),
                          [](const Joint& j) { return j.type == JointType::revolute; }),
            GetParam().revolute);
  EXPECT_NEAR(h.mass_kg, GetParam().mass_kg, 0.1);
  EXPECT_NEAR(h.stature_m, GetParam().stature_m, 0.05);
  EXPECT_EQ(h.shapes.size(), 23u);
  EXPECT_EQ(h.skeleton.links[0].name, "Pelvis");
  const Posture p = standing(h);
  double low = 1;
  for (const Pose& X : linkPoses(h.skeleton, p.q, p.root)) low = std::min(low, X.origin.z);
  EXPECT_GT(low, 0);
}
INSTANTIATE_TEST_SUITE_P(Subjects, PublicUrdf,
                         testing::Values(Subject{"humanSubject01_48dof.urdf", 48, 62.2, 1.68},
                                         Subject{"humanSubject03_66dof.urdf", 66, 75.4, 1.80}),
                         [](const auto& i) { return "dof" + std::to_string(i.param.revolute); });

struct Bad {
  const char* what;
  std::string from, to;
  int line;
  const char* words;
};
void PrintTo(const Bad& b, std::ostream* out) { *out << b.what; }
class BadUrdf : public testing::TestWithParam<Bad> {};

TEST_P(BadUrdf, IsRefused) {
  const Folder folder;
  const Bad& b = GetParam();
  expectRefused(loadUrdf, folder.write("bad.urdf", replaced(arm, b.from, b.to)), b.line, b.words);
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadUrdf,
    testing::Values(
        // syntax
        Bad{"syntax_unclosed", "<link name=\"base\"/>", "<link name=\"base\">", 0, "not XML"},
        Bad{"syntax_mismatch", "</inertial>", "</inertia>", 0, "not XML"},
        Bad{"syntax_quote", "<link name=\"base\"/>", "<link name=base\"/>", 0, ""},
        Bad{"syntax_root", "<robot name=\"arm\">", "<robots name=\"arm\">", 0, ""},
        // units
        Bad{"units_length", "xyz=\"0 0 1\"", "xyz=\"0 0 1m\"", 23, "'1m' is not a finite number"},
        Bad{"units_mass", "mass value=\"2\"", "mass value=\"2 kg\"", 7, "'kg' is not a finite number"},
        Bad{"units_angle", "lower=\"-1\"", "lower=\"-60deg\"", 25, "-60deg"},
        Bad{"units_comma", "size=\"0.1 0.2 0.3\"", "size=\"0,1 0,2 0,3\"", 16, "0,1"},
        // range
        Bad{"range_mass", "mass value=\"2\"", "mass value=\"-2\"", 7, ">= 0"},
        Bad{"range_radius", "radius=\"0.07\"", "radius=\"0\"", 17, "> 0"},
        Bad{"range_box", "size=\"0.1 0.2 0.3\"", "size=\"0.1 -0.2 0.3\"", 16, "> 0"},
        Bad{"range_limits", "lower=\"-1\"", "lower=\"3\"", 25, "lower 3 is above upper 2"},
        Bad{"range_axis", "<axis xyz=\"0 -2 0\"/>", "<axis xyz=\"0 0 0\"/>", 24, "longer than"},
        // NaN
        Bad{"nan_origin", "xyz=\"0 0 1\"", "xyz=\"0 nan 1\"", 23, "'nan' is not a finite number"},
        Bad{"nan_mass", "mass value=\"2\"", "mass value=\"NaN\"", 7, "NaN"},
        Bad{"nan_limit", "upper=\"2\"", "upper=\"inf\"", 25, "inf"},
        Bad{"nan_overflow", "radius=\"0.07\"", "radius=\"1e999\"", 17, "1e999"},
        // missing
        Bad{"missing_parent", "<parent link=\"base\"/>", "", 20, "has no <parent>"},
        Bad{"missing_child", "<child link=\"tool\"/>", "", 34, "has no <child>"},
        Bad{"missing_limit", "<limit lower=\"-1\" upper=\"2\" effort=\"1\" velocity=\"1\"/>", "", 20,
            "needs a <limit>"},
        Bad{"missing_upper", "upper=\"2\"", "", 25, "has no upper"},
        Bad{"missing_name", "<link name=\"base\"/>", "<link/>", 3, "has no name"},
        Bad{"missing_mass", "<mass value=\"2\"/>", "", 5, "has no <mass>"},
        Bad{"missing_link", "<link name=\"tool\"/>", "", 34, "'tool' is not a link"},
        Bad{"missing_type", "type=\"prismatic\"", "", 34, "has no type"},
        Bad{"missing_number", "xyz=\"0 0 1\"", "xyz=\"0 1\"", 23, "needs 3 numbers"},
        // unknown
        Bad{"unknown_geometry", "<box size=\"0.1 0.2 0.3\"/>", "<capsule radius=\"1\"/>", 16,
            "not known in <geometry>"},
        Bad{"unknown_type", "type=\"prismatic\"", "type=\"screw\"", 34, "'screw' is not known"},
        Bad{"unknown_planar", "type=\"prismatic\"", "type=\"planar\"", 34, "planar"},
        Bad{"unknown_attribute", "multiplier=\"0.5\"", "factor=\"0.5\"", 32, "'factor' is not known"},
        Bad{"unknown_element", "<mass value=\"2\"/>", "<mass value=\"2\"/><weight/>", 7, "not known in <inertial>"},
        Bad{"unknown_mimic", "mimic joint=\"shoulder\"", "mimic joint=\"hip\"", 27, "'hip', which is not a joint"},
        // twice
        Bad{"twice_link", "<link name=\"tool\"/>", "<link name=\"base\"/>", 19, "already in line 3"},
        Bad{"twice_joint", "name=\"slide\"", "name=\"elbow\"", 34, "already in line 27"},
        Bad{"twice_geometry", "<sphere radius=\"0.07\"/>", "<sphere radius=\"0.07\"/><box size=\"1 1 1\"/>", 17,
            "exactly one"},
        // cyclic
        Bad{"cyclic_two_parents", "<child link=\"tool\"/>", "<child link=\"upper\"/>", 34, "already hangs"},
        Bad{"cyclic_detached", "<parent link=\"base\"/>", "<parent link=\"tool\"/>", 0, "cycle"},
        Bad{"cyclic_self", "<parent link=\"lower\"/>", "<parent link=\"tool\"/>", 34, "to itself"},
        Bad{"cyclic_all", "<link name=\"base\"/>", "<!-- -->", 20, "'base' is not a link"},
        Bad{"cyclic_mimic", "<mimic joint=\"shoulder\"", "<mimic joint=\"slide\"", 0, "follows itself"},
        Bad{"two_roots", "<link name=\"tool\"/>", "<link name=\"tool\"/><link name=\"alone\"/>", 19, "second root"},
        // enormous
        Bad{"enormous_length", "xyz=\"0 0 1\"", "xyz=\"0 0 1e30\"", 23, "not within"},
        Bad{"enormous_mass", "mass value=\"2\"", "mass value=\"1e9\"", 7, "not within"},
        Bad{"enormous_radius", "radius=\"0.05\"", "radius=\"2e6\"", 12, "not within"},
        Bad{"enormous_limit", "upper=\"2\"", "upper=\"1e300\"", 25, "not within"}),
    [](const auto& i) { return i.param.what; });

TEST(Urdf, RefusesWhatIsNoFile) {
  const Folder folder;
  expectRefused(loadUrdf, folder.path / "none.urdf", 0, "no such file");
  expectRefused(loadUrdf, folder.path, 0, "folder");
  expectRefused(loadUrdf, folder.write("empty.urdf", ""), 0, "empty");
  expectRefused(loadUrdf, folder.write("blank.urdf", "  \n \n"), 0, "not XML");
  expectRefused(loadUrdf, folder.write("comment.urdf", "<!-- nothing -->"), 0, "");
  expectRefused(loadUrdf, folder.write("robot.urdf", "<robot name=\"x\"/>"), 1, "has no <link>");
  expectRefused(loadUrdf, folder.write("binary.urdf", std::string("\x7f\x45LF\0\0\1", 7)), 0, "zero byte");
  expectRefused(loadUrdf, "/dev/null", 0, "not a regular file");
  const auto locked = folder.write("locked.urdf", arm);
  std::filesystem::permissions(locked, std::filesystem::perms::none);
  if (!std::ifstream(locked)) expectRefused(loadUrdf, locked, 0, "cannot be read");  // root reads everything
}

TEST(Urdf, RefusesEveryTruncation) {
  const Folder folder;
  for (std::size_t n = 1; n + 10 < arm.size(); n += 7)
    EXPECT_THROW(loadUrdf(folder.write("cut.urdf", arm.substr(0, n))), InputError) << n;
}

TEST(Urdf, RefusesEnormousNesting) {
  const Folder folder;
  std::string deep = "<robot name=\"x\">\n";
  for (int i = 0; i < 100000; ++i) deep += "<link name=\"a\">";
  expectRefused(loadUrdf, folder.write("deep.urdf", deep), 2, "nested deeper");
}

/// Links that hang from each other call each other as they are read and destroyed.
TEST(Urdf, RefusesEnormousChains) {
  const Folder folder;
  std::string chain = "<robot name=\"a\"><link name=\"l0\"/>";
  for (int k = 1; k < 100000; ++k) {
    const std::string n = std::to_string(k), above = std::to_string(k - 1);
    chain += "<link name=\"l" + n + "\"/><joint name=\"j" + n + "\" type=\"fixed\"><parent link=\"l" + above +
             "\"/><child link=\"l" + n + "\"/></joint>";
  }
  expectRefused([](const auto& f) { loadUrdf(f); }, folder.write("a.urdf", chain + "</robot>"), 0, "one link too many");
}

TEST(Urdf, RefusesABadMeshByTheMeshsName) {
  const Folder folder;
  folder.write("m.stl", "solid nothing\nendsolid nothing\n");
  const auto file = folder.write("a.urdf", replaced(arm, "<sphere radius=\"0.07\"/>", "<mesh filename=\"m.stl\"/>"));
  expectRefused([&](const auto&) { loadUrdf(file); }, folder.path / "m.stl", 0, "");
}

TEST(Urdf, ScalesAndMirrorsMeshes) {
  const Folder folder;
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  const Human h =
      loadUrdf(folder.write("a.urdf", replaced(arm, "<sphere radius=\"0.07\"/>",
                                               "<mesh filename=\"package://arm/t.obj\" scale=\"2 -3 4\"/>")));
  const auto& m = std::get<TriangleMesh>(h.shapes.back().shape);
  double v = 0;
  for (const auto& t : m.triangles) v += dot(m.vertices[t[0]], cross(m.vertices[t[1]], m.vertices[t[2]])) / 6;
  EXPECT_NEAR(v, 24.0 / 6, 1e-6);
}

}  // namespace
}  // namespace gambeson
