#include "human/recorded/marker_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "human/body/segment_ellipsoid.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/walk.hpp"

namespace gambeson {
namespace {

constexpr double every_s = 0.01;
constexpr WorldAxes ours{{1, 0, 0}, {0, 0, 1}};

/// A man who walks as a camera would see him: markers at his joints and one beside each thigh and shank, every 10 ms
/// from 5 s on. Axes as ours.
struct Seen {
  Human human = makeManikin("male_p50");
  std::unique_ptr<Motion> walk = makeWalk(human, {});
  MarkerTable table;
  std::vector<MarkedSegment> segments;

  Seen() {
    table.file = "walk.trc";
    for (const char* side : {"right", "left"}) {
      const std::string s = side;
      table.names.insert(table.names.end(), {"hip_" + s, "knee_" + s, "ankle_" + s, "thigh_" + s, "shank_" + s});
      segments.push_back({"thigh_" + s, {"hip_" + s}, {"knee_" + s}, {"thigh_" + s}, {0.22, 0.09, 0.08}});
      segments.push_back({"shank_" + s, {"knee_" + s}, {"ankle_" + s}, {"shank_" + s}, {0.23, 0.06, 0.06}});
    }
    for (int i = 0; i * every_s < walk->duration(); ++i) {
      table.times.push_back(5 + i * every_s);
      table.positions.push_back(at(i * every_s));
    }
  }
  std::vector<Vec3> at(double t) const {
    const Posture p = walk->at(t);
    const auto X = linkPoses(human.skeleton, p.q, p.root);
    std::vector<Vec3> points;
    for (const char* side : {"right", "left"}) {
      const std::string s = side;
      const Pose thigh = X[human.skeleton.link("thigh_" + s)], shank = X[human.skeleton.link("shank_" + s)];
      points.insert(points.end(), {thigh.origin, shank.origin, X[human.skeleton.link("foot_" + s)].origin,
                                   thigh * Vec3{0.02, s == "left" ? 0.1 : -0.1, -0.2}, shank * Vec3{0.1, 0, -0.1}});
    }
    return points;
  }
};

double difference(const Mat3& a, const Mat3& b) { return norm(a.a - b.a) + norm(a.b - b.b) + norm(a.c - b.c); }

struct MarkerBody {
  Human human;
  std::unique_ptr<Motion> motion;
};
MarkerBody markerBody(const MarkerTable& table, const std::vector<MarkedSegment>& segments, const WorldAxes& world) {
  return {markedHuman(segments), markedMotion(table, segments, world)};
}

std::vector<Pose> shapePoses(const MarkerBody& body, double t) {
  const Posture p = body.motion->at(t);
  const auto X = linkPoses(body.human.skeleton, p.q, p.root);
  std::vector<Pose> poses;
  for (const BodyShape& s : body.human.shapes) poses.push_back(X[s.link] * s.X_LS);
  return poses;
}

// Man 2006, 5.1: centres midway between the joints of the file, to 1e-9 m, and his basis.
TEST(MarkerBody, StandsWhereTheMarkersSay) {
  const Seen seen;
  const MarkerBody body = markerBody(seen.table, seen.segments, ours);
  ASSERT_EQ(body.human.shapes.size(), 4u);
  EXPECT_EQ(body.human.skeleton.links[body.human.shapes[1].link].name, "shank_right");
  EXPECT_NEAR(body.motion->duration(), seen.table.times.back() - 5, 1e-12);
  for (std::size_t f = 0; f < seen.table.times.size(); ++f) {
    const auto poses = shapePoses(body, seen.table.times[f] - 5);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto point = [&](const Points& names) { return seen.table.positions[f][seen.table.marker(names.front())]; };
      const MarkedSegment& s = seen.segments[k];
      const Pose X = segmentPose(point(s.J1), point(s.J2), point(s.M), s.name);
      EXPECT_LT(norm(poses[k].origin - 0.5 * (point(s.J1) + point(s.J2))), 1e-9);
      EXPECT_LT(difference(poses[k].rotation, X.rotation), 1e-9);
    }
  }
}

// Between the instants the motion that was seen there: the error falls more than fourfold with half the steps.
TEST(MarkerBody, MovesSmoothlyBetween) {
  const Seen seen;
  const auto errorOf = [&](std::size_t stride) {
    MarkerTable sparse = seen.table;
    sparse.times.clear(), sparse.positions.clear();
    for (std::size_t f = 0; f < seen.table.times.size(); f += stride)
      sparse.times.push_back(seen.table.times[f]), sparse.positions.push_back(seen.table.positions[f]);
    const MarkerBody body = markerBody(sparse, seen.segments, ours);
    double most = 0;
    for (double t = 0.7; t < 2; t += 0.0173) {
      const auto poses = shapePoses(body, t);
      const auto points = seen.at(t);
      const Pose thigh = segmentPose(points[0], points[1], points[3], "thigh");
      most = std::max(most, norm(poses[0] * Vec3{0, 0.1, 0} - thigh * Vec3{0, 0.1, 0}));
    }
    return most;
  };
  const double coarse = errorOf(4), fine = errorOf(2);
  EXPECT_LT(fine, 3e-4);
  EXPECT_GT(coarse, 4 * fine);
  const MarkerBody body = markerBody(seen.table, seen.segments, ours);
  const double h = 1e-5;
  double jump = 0;
  for (double t = every_s; t < 2; t += every_s) {
    const auto a = shapePoses(body, t - h), b = shapePoses(body, t), c = shapePoses(body, t + h);
    for (std::size_t k = 0; k < a.size(); ++k)
      jump = std::max(jump, norm(c[k].origin - 2 * b[k].origin + a[k].origin) / h);
  }
  EXPECT_LT(jump, 0.01);
}

// A segment that turns twice about its bone, and one whose bone turns over: angles go on, and so does what is between.
TEST(MarkerBody, TurnsOnAndOn) {
  MarkerTable table;
  table.file = "turns.trc";
  table.names = {"a", "b", "m", "c", "n"};
  const auto at = [](double angle) {
    const Mat3 about_z = rotationAbout({0, 0, 1}, angle), about_y = rotationAbout({0, 1, 0}, angle);
    return std::vector<Vec3>{{0, 0, 1},
                             {0, 0, 0.6},
                             Vec3{0, 0, 0.8} + about_z * Vec3{0.1, 0, 0},
                             Vec3{0, 0, 1} + about_y * Vec3{0, 0.01, -0.4},
                             Vec3{0, 0, 1} + about_y * Vec3{0.1, 0, -0.2}};
  };
  for (int i = 0; i <= 100; ++i) {
    table.times.push_back(every_s * i);
    table.positions.push_back(at(0.04 * std::numbers::pi * i));
  }
  const std::vector<MarkedSegment> segments{{"spun", {"a"}, {"b"}, {"m"}, {0.2, 0.1, 0.1}},
                                            {"swung", {"a"}, {"c"}, {"n"}, {0.2, 0.1, 0.1}}};
  const MarkerBody body = markerBody(table, segments, ours);
  for (int i = 2; i < 98; ++i) {
    const double u = i + 0.5;
    const auto poses = shapePoses(body, every_s * u);
    const auto p = at(0.04 * std::numbers::pi * u);
    EXPECT_LT(difference(poses[0].rotation, segmentPose(p[0], p[1], p[2], "").rotation), 1e-4) << i;
    EXPECT_LT(difference(poses[1].rotation, segmentPose(p[0], p[3], p[4], "").rotation), 1e-4) << i;
  }
}

TEST(MarkerBody, TurnsAxesOfTheFile) {
  Seen seen;
  const auto before = shapePoses(markerBody(seen.table, seen.segments, ours), 1);
  for (auto& frame : seen.table.positions)
    for (Vec3& p : frame) p = {p.x, p.z, -p.y};  // y up, as OpenSim has it
  const auto after = shapePoses(markerBody(seen.table, seen.segments, {{1, 0, 0}, {0, 1, 0}}), 1);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_LT(norm(before[k].origin - after[k].origin), 1e-12);
    EXPECT_LT(difference(before[k].rotation, after[k].rotation), 1e-12);
  }
}

TEST(MarkerBody, NamesWhatIsMissing) {
  const Seen seen;
  const auto keyOf = [&](auto change) -> std::string {
    MarkerTable table = seen.table;
    std::vector<MarkedSegment> segments = seen.segments;
    change(table, segments);
    try {
      markerBody(table, segments, ours);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "nothing";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(keyOf([](auto& table, auto&) { table.names[1] = "x"; }), "knee_right");
  EXPECT_EQ(keyOf([&](auto& table, auto&) { table.positions[7][2] = {nan, nan, nan}; }), "ankle_right");
  EXPECT_EQ(keyOf([](auto& table, auto&) { table.positions[7][3] = table.positions[7][1]; }), "thigh_right[7]");
  EXPECT_EQ(keyOf([](auto&, auto& segments) { segments[2].semi_axes_m.y = 0; }), "thigh_left");
  EXPECT_EQ(keyOf([](auto&, auto& segments) { segments[3].M.clear(); }), "shank_left");
  EXPECT_EQ(keyOf([](auto&, auto& segments) { segments[3].name = segments[1].name; }), "shank_right");
}

}  // namespace
}  // namespace gambeson
