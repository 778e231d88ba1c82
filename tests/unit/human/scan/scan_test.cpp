/// Scans made from our own manikins: joints, girths, volume and weights are known; and scans that are not as they
/// should be, each of which works or says what is wrong.

#include "human/scan/scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>

#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"
#include "human/body/section.hpp"
#include "human/character/character.hpp"
#include "human/scan/joints.hpp"
#include "human/scan/landmarks.hpp"
#include "human/scan/loops.hpp"
#include "human/scan/repair.hpp"
#include "human/scan/upright.hpp"
#include "human/skin/overlap.hpp"
#include "tools/data_folder.hpp"
#include "tools/scan_bodies.hpp"
#include "unit/human/scan/scan_body.hpp"

namespace gambeson {
namespace {

const test::ScanBody& aPose() {
  static const test::ScanBody b = test::scanBody("male_p50", 45);
  return b;
}

Human made(const TriangleMesh& mesh, ScanReport* report = nullptr, ScanOptions options = {}) {
  options.file = "scan.ply";
  return scanOf(mesh, options, report);
}

/// Those found in a scan, whose file has x forward, y left, z up, in metres.
void expectJointsOf(const test::KnownScan& s, double within_m) {
  RepairReport repair;
  std::vector<std::string> notes;
  const TriangleMesh raw = repaired(s.mesh, ScanOptions{}.close_holes, "scan.ply", repair);
  const TriangleMesh body = upright(raw, {}, "scan.ply", notes);
  const Vec3 shift = body.vertices[0] - raw.vertices[0];
  for (const auto& [link, found] : jointsOf(body, landmarksOf(body, "scan.ply")))
    if (s.joints.contains(link)) {
      EXPECT_LT(norm(found - s.joints.at(link) - shift), within_m) << link;
    }
}

/// The scan's frame has the middle of its feet as origin; that of the known joints its pelvis.
void expectJoints(const test::ScanBody& b, double within_m) {
  ScanReport report;
  const Human h = made(b.mesh, &report);
  ASSERT_EQ(h.skin->rest.vertices.size(), b.mesh.vertices.size());
  // Both meshes have the same vertices in an order of their own: their means give the shift.
  Vec3 here, there;
  for (const Vec3& x : h.skin->rest.vertices) here += x / static_cast<double>(b.mesh.vertices.size());
  for (const Vec3& x : b.mesh.vertices)
    there += 1e-3 * Vec3{x.z, x.x, x.y} / static_cast<double>(b.mesh.vertices.size());
  for (const auto& [link, known] : b.joints) {
    if (link.ends_with("_f1") || link.ends_with("_f2")) continue;
    const Vec3 found = h.skin->bind[static_cast<std::size_t>(h.skeleton.link(link))].origin;
    EXPECT_LT(norm(found - known - (here - there)), within_m) << link;
  }
}

TEST(Scan, JointsOfAnAPoseAreWithinTwoCentimetres) { expectJoints(aPose(), 0.02); }
TEST(Scan, JointsOfATPoseAreWithinTwoCentimetres) { expectJoints(test::scanBody("male_p50", 85), 0.02); }
TEST(Scan, JointsOfASmallWomanAreWithinTwoCentimetres) { expectJoints(test::scanBody("female_p5", 40), 0.02); }
// Her thighs touch, so that the crotch of her skin lies low: by shares of the stature above it her knee and her lumbar
// joint are 2.7 cm off.
TEST(Scan, JointsOfALargeWomanWhoseThighsTouchAreWithinTwoCentimetres) {
  expectJoints(test::scanBody("female_p95", 45), 0.02);
}

// Lengths of hands and the first thin section put wrists 2.3 cm off once every twentieth vertex was gone.
TEST(Scan, JointsOfAWorseScanAreWithinTwoCentimetres) {
  const test::KnownScan man = test::knownScan("male_p95", 45);
  expectJointsOf(test::decimated(man, 0.05), 0.02);
  expectJointsOf(test::noisy(man, 0.002), 0.02);
}

TEST(Scan, FeetWithoutSolesAreClosed) {
  const test::KnownScan woman = test::knownScan("female_p50", 60);
  double low = 1;
  for (const Vec3& x : woman.mesh.vertices) low = std::min(low, x.z);
  const test::KnownScan open = test::without(woman, [&](const Vec3& x) { return x.z < low + 0.009; });
  ASSERT_LT(open.mesh.triangles.size(), woman.mesh.triangles.size() - 20);
  expectJointsOf(open, 0.02);
}

TEST(Scan, StandsAgainAsItWasScanned) {
  const Human h = made(aPose().mesh);
  const Posture p = postureOfSkin(h);
  const int arm = h.skeleton.joint("shoulder_abduction_left");
  EXPECT_NEAR(p.q[static_cast<std::size_t>(arm)], 45 * rad_per_deg, 4 * rad_per_deg);
  std::vector<Vec3> x(h.skin->rest.vertices.size());
  skinPositions(*h.skin, linkPoses(h.skeleton, p.q, p.root), x);
  double apart = 0;
  for (std::size_t v = 0; v < x.size(); ++v) apart = std::max(apart, norm(x[v] - h.skin->rest.vertices[v]));
  EXPECT_LT(apart, 1e-9);
}

TEST(Scan, IsAClosedSkinOfTheScansVolumeWhoseWeightsSumToOne) {
  ScanReport report;
  const Human h = made(aPose().mesh, &report);
  EXPECT_EQ(report.pose, 'A');
  EXPECT_NEAR(report.arms_deg, 45, 3);
  EXPECT_NEAR(report.height_m, 1.755, 0.01);
  EXPECT_TRUE(meshTopology(h.skin->rest).closed);
  double volume = 0;
  for (const auto& t : aPose().mesh.triangles)
    volume += dot(aPose().mesh.vertices[t[0]], cross(aPose().mesh.vertices[t[1]], aPose().mesh.vertices[t[2]])) / 6;
  EXPECT_NEAR(report.volume_m3, 1e-9 * std::abs(volume), 1e-9);
  EXPECT_NEAR(h.mass_kg, 1000 * report.volume_m3, 1e-9);
  for (std::size_t v = 0; v + 1 < h.skin->first.size(); ++v) {
    double sum = 0;
    for (int i = h.skin->first[v]; i < h.skin->first[v + 1]; ++i) {
      EXPECT_GE(h.skin->weight[static_cast<std::size_t>(i)], 0);
      sum += h.skin->weight[static_cast<std::size_t>(i)];
    }
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Scan, WeightsChangeGraduallyAndStayOnTheirOwnLimb) {
  const Human h = made(aPose().mesh);
  const Skin& s = *h.skin;
  std::vector<std::vector<double>> w(s.rest.vertices.size(), std::vector<double>(h.skeleton.links.size()));
  for (std::size_t v = 0; v < w.size(); ++v)
    for (int i = s.first[v]; i < s.first[v + 1]; ++i)
      w[v][static_cast<std::size_t>(s.link[static_cast<std::size_t>(i)])] = s.weight[static_cast<std::size_t>(i)];
  double steepest = 0;
  for (const auto& t : s.rest.triangles)
    for (int k = 0; k < 3; ++k)
      for (std::size_t l = 0; l < h.skeleton.links.size(); ++l)
        steepest = std::max(steepest, std::abs(w[t[k]][l] - w[t[(k + 1) % 3]][l]));
  EXPECT_LT(steepest, 0.75);  // edges of 2 cm over bands of 4 to 20 cm; a border without a band would be 1
  for (std::size_t v = 0; v < w.size(); ++v)
    for (std::size_t l = 0; l < h.skeleton.links.size(); ++l) {
      const std::string& name = h.skeleton.links[l].name;
      if (w[v][l] > 0.03 && name.ends_with("_left")) {
        EXPECT_GT(s.rest.vertices[v].y, -0.045) << name;
      }
      if (w[v][l] > 0.03 && name.ends_with("_right")) {
        EXPECT_LT(s.rest.vertices[v].y, 0.045) << name;
      }
      if (w[v][l] > 0.03 && name.starts_with("hand")) {
        EXPECT_GT(std::abs(s.rest.vertices[v].y), 0.4) << name;
      }
    }
}

/// Girth by the tape of the trunk where a level cuts the skin as it stands, arms left out.
double trunkGirth(const Human& h, const std::vector<Vec3>& x, double z) {
  TriangleMesh m{x, {}};
  for (const auto& t : h.skin->rest.triangles) {
    const auto arm = [&](int v) {
      const std::string& name =
          h.skeleton.links[static_cast<std::size_t>(h.skin->segment[static_cast<std::size_t>(v)])].name;
      return name.find("arm") != std::string::npos || name.starts_with("hand");
    };
    if (!arm(t[0]) && !arm(t[1]) && !arm(t[2])) m.triangles.push_back(t);
  }
  return tapeGirth(crossSection(m, {}, z));
}

TEST(Scan, GirthsOfTheTrunkStayWithinOnePercentAsTheArmsComeDown) {
  const Human h = made(aPose().mesh);
  const Posture p = standing(h);
  const std::vector<Pose> X = linkPoses(h.skeleton, p.q, p.root);
  std::vector<Vec3> x(h.skin->rest.vertices.size());
  skinPositions(*h.skin, X, x);
  const double lift = X[0].origin.z - h.skin->bind[0].origin.z;
  for (const double z : {0.95, 1.0, 1.1}) {  // hips, waist, below the chest
    const double scan = trunkGirth(h, h.skin->rest.vertices, z), now = trunkGirth(h, x, z + lift);
    EXPECT_NEAR(now, scan, 0.01 * scan) << z;
  }
}

std::vector<Pose> standingLinks(const Human& h) {
  const Posture p = standing(h);
  return linkPoses(h.skeleton, p.q, p.root);
}

double abductionStanding(const Human& h) {
  return standing(h).q[static_cast<std::size_t>(h.skeleton.joint("shoulder_abduction_left"))] / rad_per_deg;
}

double foldedArea(const Human& h, const std::vector<Pose>& links) {
  std::vector<Vec3> x(h.skin->rest.vertices.size());
  skinPositions(*h.skin, links, x);
  return overlapOf(h.skin->rest.triangles, x).area_m2;
}

TEST(Scan, ArmsComeDownWithoutFoldingIntoTheTrunk) {
  const Human h = made(aPose().mesh);
  EXPECT_LE(foldedArea(h, standingLinks(h)), foldedArea(h, h.skin->bind) + 12e-4);
  EXPECT_GE(abductionStanding(h), 19.9);
  EXPECT_LE(abductionStanding(h), 45);
  // As of a T-pose, from which they come down by more.
  const Human t = made(test::scanBody("male_p50", 85).mesh);
  EXPECT_LE(abductionStanding(t), 45.001);
}

/// Runs with a message of this key, and these words.
void refuses(const TriangleMesh& mesh, const std::string& key, const std::string& words, ScanOptions options = {}) {
  try {
    made(mesh, nullptr, options);
    ADD_FAILURE() << "took it; expected " << key;
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, "scan.ply");
    EXPECT_EQ(e.where().key, key) << e.reason();
    EXPECT_NE(e.reason().find(words), std::string::npos) << e.reason();
  }
}

TriangleMesh without(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& gone) {
  TriangleMesh out{mesh.vertices, {}};
  for (const auto& t : mesh.triangles)
    if (!gone((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3)) out.triangles.push_back(t);
  return out;
}

TriangleMesh changed(const TriangleMesh& mesh, const std::function<Vec3(const Vec3&)>& f) {
  TriangleMesh out = mesh;
  for (Vec3& x : out.vertices) x = f(x);
  return out;
}

TEST(ScanMalformed, SmallHolesAreClosedAndToldLargeOnesNameTheirPlace) {
  const Vec3 navel = aPose().file({0.1, 0, 1.05});
  ScanReport report;
  const Human h = made(without(aPose().mesh, [&](const Vec3& x) { return norm(x - navel) < 45; }), &report);
  EXPECT_TRUE(meshTopology(h.skin->rest).closed);
  EXPECT_TRUE(std::any_of(report.notes.begin(), report.notes.end(),
                          [](const std::string& n) { return n.find("1 holes were closed") != std::string::npos; }));
  refuses(without(aPose().mesh, [&](const Vec3& x) { return norm(x - navel) < 180; }), "holes", "close_holes");
}

TEST(ScanMalformed, TwoBodiesArePointedAt) {
  TriangleMesh two = aPose().mesh;
  const int n = static_cast<int>(two.vertices.size());
  for (const Vec3& x : aPose().mesh.vertices) two.vertices.push_back(x + Vec3{2500, 0, 0});
  for (const auto& t : aPose().mesh.triangles) two.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  refuses(two, "bodies", "two bodies");
}

TEST(ScanMalformed, UpsideDownAndAskewAndInInchesStandsUp) {
  const double c = std::cos(0.5), s = std::sin(0.5);
  const TriangleMesh odd = changed(aPose().mesh, [&](const Vec3& x) {
    return Vec3{c * x.x + s * x.z, -x.y, s * x.x - c * x.z} / 25.4;  // half a turn and askew, in inches
  });
  ScanReport report;
  const Human h = made(odd, &report);
  EXPECT_NEAR(report.height_m, 1.755, 0.01);
  const auto at = [&](const char* link) {
    return h.skin->bind[static_cast<std::size_t>(h.skeleton.link(link))].origin;
  };
  EXPECT_GT(at("head").z, 1.4);
  EXPECT_GT(at("thigh_left").y, 0.06);
  const auto says = [&](const char* words) {
    return std::any_of(report.notes.begin(), report.notes.end(),
                       [&](const std::string& n) { return n.find(words) != std::string::npos; });
  };
  EXPECT_TRUE(says("inches"));
  EXPECT_TRUE(says("up is -y"));
  EXPECT_TRUE(says("askew"));
}

TEST(ScanMalformed, AUnitThatNobodyHasAsksForTheHeight) {
  const TriangleMesh odd = changed(aPose().mesh, [](const Vec3& x) { return 1e-4 * x; });
  refuses(odd, "height", "say its \"height\"");
  ScanOptions told;
  told.height_m = 1.8;
  ScanReport report;
  made(odd, &report, told);
  EXPECT_NEAR(report.height_m, 1.8, 1e-9);
}

TEST(ScanMalformed, NoArmsSaySo) {
  ScanOptions open;
  open.close_holes = 0.5;
  refuses(without(aPose().mesh, [](const Vec3& x) { return std::abs(x.x) > 260; }), "arm_right", "arm", open);
}

TEST(ScanMalformed, EdgesOfThreeTrianglesSayWhere) {
  TriangleMesh odd = aPose().mesh;
  odd.vertices.push_back({0, 1000, 900});
  odd.triangles.push_back({odd.triangles[0][0], odd.triangles[0][1], static_cast<int>(odd.vertices.size()) - 1});
  refuses(odd, "manifold", "more than two triangles, the first at (");
}

TEST(ScanMalformed, TrianglesThatFaceTheWrongWayAreTurned) {
  TriangleMesh odd = aPose().mesh;
  for (std::size_t t = 0; t < odd.triangles.size(); t += 3) std::swap(odd.triangles[t][1], odd.triangles[t][2]);
  ScanReport report;
  EXPECT_TRUE(meshTopology(made(odd, &report).skin->rest).closed);
}

/// A hand at the hip: the forearm bends in until the hand enters the trunk and both surfaces are joined.
TEST(ScanMalformed, AHandAtTheHipNamesTheArm) {
  TriangleMesh odd = aPose().mesh;
  // The left hand's tip and the hip's side get a hole each, whose rims are joined by a tube.
  const auto rimOf = [&](const Vec3& near) {
    std::size_t best = 0;
    const auto middle = [&](std::size_t t) {
      return (odd.vertices[odd.triangles[t][0]] + odd.vertices[odd.triangles[t][1]] +
              odd.vertices[odd.triangles[t][2]]) /
             3;
    };
    for (std::size_t t = 0; t < odd.triangles.size(); ++t)
      if (norm(middle(t) - near) < norm(middle(best) - near)) best = t;
    const auto rim = odd.triangles[best];
    odd.triangles.erase(odd.triangles.begin() + static_cast<std::ptrdiff_t>(best));
    return rim;
  };
  Vec3 tip;
  for (const Vec3& x : odd.vertices)
    if (x.x > tip.x) tip = x;
  const auto hand = rimOf(tip), hip = rimOf(aPose().file({0, 0.17, 0.95}));
  for (std::size_t k = 0; k < 3; ++k) {
    const int a = hand[k], b = hand[(k + 1) % 3], c = hip[(3 - k) % 3], d = hip[(2 - k + 3) % 3];
    odd.triangles.push_back({a, b, d});
    odd.triangles.push_back({a, d, c});
  }
  EXPECT_EQ(handlesOf(odd), 1);
  refuses(odd, "arm_left", "hand at the hip");
}

TEST(ScanMalformed, ALeaningBodySaysByHowMuch) {
  const double c = std::cos(0.45), s = std::sin(0.45);
  refuses(changed(aPose().mesh,
                  [&](const Vec3& x) {
                    return Vec3{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
                  }),
          "up", "leans by");
}

TEST(ScanMalformed, ASpikeSaysHowFarItReaches) {
  TriangleMesh odd = aPose().mesh;
  odd.vertices[odd.vertices.size() / 2].x += 5000;
  refuses(odd, "shape", "a spike");
}

TEST(ScanMalformed, ABodyCutOffAboveItsFeetNamesThem) {
  refuses(without(aPose().mesh, [](const Vec3& x) { return x.y < 110; }), "feet", "cut off above its feet");
}

TEST(ScanMalformed, ABodyWithoutAHeadNamesTheNeck) {
  ScanOptions open;
  open.close_holes = 0.5;
  refuses(without(aPose().mesh, [](const Vec3& x) { return x.y > 1500; }), "neck", "is the head cut off", open);
}

TEST(ScanMalformed, ALimbOfALengthThatNobodyHasNamesIt) {
  Landmarks marks;
  marks.stature_m = 1.75;
  std::map<std::string, Vec3> joints;
  for (const char* side : {"_right", "_left"}) {
    const std::size_t s = side[1] == 'l';
    double z = 0;
    for (const auto& [link, length] : {std::pair{"thigh", 0.41}, {"shank", 0.42}, {"foot", 0.0}})
      joints[std::string(link) + side] = {0, 0, z}, z -= length;
    z = 0;
    for (const auto& [link, length] : {std::pair{"upper_arm", 0.29}, {"forearm", 0.27}, {"hand", 0.19}})
      joints[std::string(link) + side] = {0, 0, z}, z -= length;
    marks.hand_tip[s] = {0, 0, z};
  }
  EXPECT_NO_THROW(checkLengths(joints, marks, "scan.ply"));
  joints["hand_left"].z += 0.12;
  try {
    checkLengths(joints, marks, "scan.ply");
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "arm_left");
    EXPECT_NE(e.reason().find("left forearm"), std::string::npos) << e.reason();
  }
}

/// The mean body of GarmentCode, in A-pose: girths that its authors published, and those of the skin as it stands.
TEST(RealScans, GarmentCodesMeanBodyHasItsPublishedGirths) {
  const auto file = test::dataFolder() / "real" / "body" / "garmentcode_mean_all.obj";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no " << file;
  ScanOptions o;
  o.file = file;
  ScanReport report;
  const Human h = loadScan(o, &report);
  EXPECT_EQ(report.pose, 'A');
  EXPECT_NEAR(report.height_m, 1.7199, 1e-4);
  EXPECT_TRUE(meshTopology(h.skin->rest).closed);
  int compared = 0;
  EXPECT_NEAR(report.arms_deg, 45.5, 4);  // arm_pose_angle of garmentcode_body_mean_all.yaml
  for (const ScanGirth& g : report.girths) {
    // hips, waist, bust and leg_circ of the same file.
    const double published = g.name == "hip" || g.name == "widest hip" ? 1.03478
                             : g.name == "narrowest waist"             ? 0.843338
                             : g.name == "chest"                       ? 0.998407
                             : g.name.starts_with("top of thigh")      ? 0.602039
                                                                       : 0;
    if (published > 0) {
      ++compared;
      EXPECT_NEAR(g.scan_m, published, 0.01 * published) << g.name;
    }
    // The legs come together by 5 degrees: what their tops bulge by is the most that changes.
    EXPECT_NEAR(g.standing_m, g.scan_m, (g.name == "widest hip" ? 0.013 : 0.01) * g.scan_m) << g.name;
  }
  const double scanned = foldedArea(h, h.skin->bind), stands = foldedArea(h, standingLinks(h));
  EXPECT_LT(scanned, 12e-4);           // lips, armpits and crotch
  EXPECT_LE(stands, scanned + 12e-4);  // 181 cm^2 with arms at 20 degrees
  const double arms = abductionStanding(h);
  EXPECT_GT(arms, 30);
  EXPECT_LE(arms, report.arms_deg);  // at 35 degrees 7 cm^2 more of it would fold
  EXPECT_EQ(compared, 6);
}

/// MakeHuman's base mesh without its rig, against the rig. Its hips lie 11 cm from the median plane
/// (human/DECISIONS.md).
TEST(RealScans, MakeHumansBaseMeshHasTheJointsOfItsRig) {
  const auto folder = test::dataFolder() / "real" / "body";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  CharacterOptions rig;
  rig.file = folder / "makehuman_base.obj";
  rig.skeleton = folder / "makehuman_default.mhskel";
  rig.weights = folder / "makehuman_default_weights.mhw";
  const Human known = loadCharacter(rig);
  const Human h = made(known.skin->rest);
  ASSERT_EQ(h.skin->rest.vertices.size(), known.skin->rest.vertices.size());
  Vec3 shift;
  for (const Vec3& x : h.skin->rest.vertices) shift += x / static_cast<double>(h.skin->rest.vertices.size());
  for (const Vec3& x : known.skin->rest.vertices) shift -= x / static_cast<double>(h.skin->rest.vertices.size());
  for (const char* link :
       {"thigh_left", "shank_left", "foot_left", "upper_arm_left", "forearm_left", "hand_left", "torso", "head"}) {
    const auto at = [&](const Human& human) {
      return human.skin->bind[static_cast<std::size_t>(human.skeleton.link(link))].origin;
    };
    EXPECT_LT(norm(at(h) - at(known) - shift), link == std::string("thigh_left") ? 0.033 : 0.021) << link;
  }
}

TEST(CutLoops, OfATubeAreTwoCircles) {
  // A square tube: outer side 2, height 1, closed by nothing.
  TriangleMesh m{{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}, {1, 1, 1}, {-1, 1, 1}, {-1, -1, 1}, {1, -1, 1}}, {}};
  for (int k = 0; k < 4; ++k) {
    const int a = k, b = (k + 1) % 4;
    m.triangles.push_back({a, b, b + 4});
    m.triangles.push_back({a, b + 4, a + 4});
  }
  const std::vector<CutLoop> loops = cutLoops(m, CutPlane::level(0.3));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_TRUE(loops[0].closed);
  EXPECT_NEAR(loops[0].area_m2, 4, 1e-12);
  EXPECT_NEAR(loops[0].girth(), 8, 1e-12);
  EXPECT_NEAR(loops[0].centre.x, 0, 1e-12);
  m.triangles.pop_back();
  const std::vector<CutLoop> open = cutLoops(m, CutPlane::level(0.3));
  ASSERT_EQ(open.size(), 1u);
  EXPECT_FALSE(open[0].closed);
}

}  // namespace
}  // namespace gambeson
