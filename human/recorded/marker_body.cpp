#include "human/recorded/marker_body.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "human/body/segment_ellipsoid.hpp"
#include "human/motion/curve.hpp"
#include "human/skeleton/limb_angles.hpp"

namespace gambeson {
namespace {

using std::numbers::pi;

constexpr std::array<Vec3, 3> axes{Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}};  ///< of pitch, roll, yaw
/// Axes of the link in the ellipsoid's frame: x towards M, z against the bone.
constexpr Mat3 link_S{{0, 1, 0}, {0, 0, -1}, {-1, 0, 0}};

Vec3 pointOf(const MarkerTable& table, const Points& names, std::size_t frame) {
  Vec3 sum;
  for (const std::string& name : names) {
    const int m = table.marker(name);
    if (m < 0) throw InputError({table.file, 0, name}, "is missing in the file; a segment of the body asks for it");
    const Vec3 p = table.positions[frame][static_cast<std::size_t>(m)];
    if (!std::isfinite(p.x))
      throw InputError({table.file, 0, name}, fmt::format("was not seen at {} s", table.times[frame]));
    sum += p;
  }
  return sum / static_cast<double>(names.size());
}

/// Of the two solutions, and of the turns that each may have more, the angles that are nearest to those before.
std::array<double, 3> nearestAngles(const Mat3& R, const std::array<double, 3>& before) {
  const auto a = threeAngles(R, axes);
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::array<double, 3> q : {a, {a[0] + pi, pi - a[1], a[2] + pi}}) {
    double distance = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      q[k] += 2 * pi * std::round((before[k] - q[k]) / (2 * pi));
      distance += std::pow(q[k] - before[k], 2);
    }
    if (distance < least) least = distance, best = q;
  }
  return best;
}

constexpr std::size_t joints_per_segment = 6;

void addSegment(Human& human, const MarkedSegment& segment) {
  Skeleton& s = human.skeleton;
  constexpr double inf = std::numeric_limits<double>::infinity();
  constexpr std::array<Vec3, joints_per_segment> along{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1},
                                                       axes[0],       axes[1],       axes[2]};
  constexpr std::array<const char*, joints_per_segment> names{"_x", "_y", "_z", "_pitch", "_roll", "_yaw"};
  int parent = 0;
  for (std::size_t k = 0; k < names.size(); ++k) {
    Joint j;
    j.name = segment.name + names[k];
    j.type = k < 3 ? JointType::prismatic : JointType::revolute;
    j.parent = parent;
    j.child = parent = static_cast<int>(s.links.size());
    j.axis = along[k];
    j.lower = -inf, j.upper = inf;
    s.links.push_back(
        {k + 1 < names.size() ? segment.name + names[k] : segment.name, static_cast<int>(s.joints.size()), 0, {}});
    s.joints.push_back(j);
  }
  human.shapes.push_back({parent, segment.name, Ellipsoid{segment.semi_axes_m}, {transpose(link_S), {}}});
}

/// Leaves the window that is asked for.
void cut(MarkerTable& table, const MarkersOptions& o) {
  const double begin = table.times.front(), end = table.times.back();
  const double from = o.from_s.value_or(begin), to = o.to_s.value_or(end);
  const auto check = [&](const char* key, double value, double low) {
    if (!(value >= low && value <= end))
      throw InputError({"", 0, key}, fmt::format("{} s is not allowed: {} to {} s", value, low, end));
  };
  check("from", from, begin), check("to", to, from);
  MarkerTable left = std::move(table);
  table.file = left.file, table.names = left.names;
  table.times.clear(), table.positions.clear();
  for (std::size_t f = 0; f < left.times.size(); ++f)
    if (left.times[f] >= from && left.times[f] <= to)
      table.times.push_back(left.times[f]), table.positions.push_back(std::move(left.positions[f]));
  if (table.times.size() < 2)
    throw InputError({"", 0, "to"}, fmt::format("from {} to {} s the file has {} instants; allowed: two and more", from,
                                                to, table.times.size()));
}

}  // namespace

Human markedHuman(const std::vector<MarkedSegment>& segments) {
  Human human;
  human.skeleton.name = "markers";
  human.skeleton.links.push_back({"world", -1, 0, {}});
  for (const MarkedSegment& segment : segments) {
    const auto refuse = [&](const std::string& why) { throw InputError({"", 0, segment.name}, why); };
    if (human.skeleton.link(segment.name) >= 0)
      refuse("is the name of another link already; allowed: a name of its own");
    for (const auto& [points, what] :
         {std::pair{&segment.J1, "upper_joint"}, {&segment.J2, "lower_joint"}, {&segment.M, "marker"}})
      if (points->empty())
        refuse(fmt::format("names no marker for {}; allowed: one or more, whose mean is taken", what));
    for (int i = 0; i < 3; ++i)
      if (!(segment.semi_axes_m[i] > 0))
        refuse(fmt::format("a semi-axis of {} m is not allowed: > 0", segment.semi_axes_m[i]));
    addSegment(human, segment);
  }
  return human;
}

std::unique_ptr<Motion> markedMotion(const MarkerTable& table, const std::vector<MarkedSegment>& segments,
                                     const WorldAxes& world) {
  const Mat3 to_ours = axesOf(world.forward, world.up);
  std::vector<double> times;
  for (const double t : table.times) times.push_back(t - table.times.front());
  std::vector<MotionColumn> columns;
  for (const MarkedSegment& segment : segments) {
    SegmentCourse course{segment.name, {}, {}, {}};
    for (std::size_t f = 0; f < table.times.size(); ++f) {
      course.J1.push_back(to_ours * pointOf(table, segment.J1, f));
      course.J2.push_back(to_ours * pointOf(table, segment.J2, f));
      course.M.push_back(to_ours * pointOf(table, segment.M, f));
    }
    std::array<MotionColumn, joints_per_segment> of;
    std::array<double, 3> angles{};
    for (const Pose& X : segmentPoses(course)) {
      angles = nearestAngles(X.rotation * link_S, angles);
      for (int i = 0; i < 3; ++i) of[i].x.push_back(X.origin[i]), of[i + 3].x.push_back(angles[i]);
    }
    for (MotionColumn& column : of) {
      column.joint = static_cast<int>(columns.size());
      column.slope = splineSlopes(times, column.x);
      columns.push_back(std::move(column));
    }
  }
  const Posture rest{std::vector<double>(columns.size(), 0.0), {}};
  return makeSampledMotion(std::move(times), std::move(columns), rest);
}

std::unique_ptr<Motion> loadMarkers(const MarkersOptions& o, const std::vector<MarkedSegment>& segments) {
  MarkerTable table = readTrc(o.path);
  const WorldAxes world{namedAxis(o.forward), namedAxis(o.up)};
  for (const auto& [axis, key, word] : {std::tuple{world.forward, "forward", o.forward}, {world.up, "up", o.up}})
    if (axis == Vec3{}) throw InputError({"", 0, key}, "\"" + word + "\" is not allowed: x, -x, y, -y, z or -z");
  if (dot(world.forward, world.up) != 0)
    throw InputError({"", 0, "up"}, "\"" + o.up + "\" is not allowed: an axis across \"forward\"");
  cut(table, o);
  return markedMotion(table, segments, world);
}

}  // namespace gambeson
