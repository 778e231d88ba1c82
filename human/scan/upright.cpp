#include "human/scan/upright.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "human/scan/loops.hpp"

namespace gambeson {
namespace {

constexpr double kLeast_m = 1.2, kMost_m = 2.3;
constexpr double kAskew_rad = 0.05;
/// In heights: a head is at most this far from above the ankles, and nothing further from them to a side (half the span
/// of arms is 0.52 of a stature, ANSUR II).
constexpr double kMostLean = 0.17, kMostSide = 0.75;

struct Unit {
  const char* name;
  double m;
};
constexpr std::array<Unit, 6> kUnits{{{"metres", 1},
                                      {"decimetres", 0.1},
                                      {"centimetres", 0.01},
                                      {"millimetres", 0.001},
                                      {"inches", 0.0254},
                                      {"feet", 0.3048}}};

/// The body with file's axes turned so that `forward`, cross(up, forward) and `up` become x, y, z.
void turn(TriangleMesh& body, const Vec3& forward, const Vec3& up) {
  const Vec3 left = cross(up, forward);
  for (Vec3& x : body.vertices) x = {dot(forward, x), dot(left, x), dot(up, x)};
}

std::array<Vec3, 2> boxOf(const TriangleMesh& body) {
  Vec3 low = body.vertices.front(), high = low;
  for (const Vec3& x : body.vertices)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  return {low, high};
}

/// Whether the lowest part of the body in direction -up is two pieces side by side and the highest is one: feet and
/// head. Cut at shares of the extent along `up`.
bool standsAlong(const TriangleMesh& body, const Vec3& up) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& x : body.vertices) low = std::min(low, dot(up, x)), high = std::max(high, dot(up, x));
  const auto pieces = [&](double share) {
    std::vector<CutLoop> loops = cutLoops(body, CutPlane::across((low + share * (high - low)) * up, up));
    double most = 0;
    for (const CutLoop& l : loops) most = std::max(most, l.area_m2);
    return std::count_if(loops.begin(), loops.end(), [&](const CutLoop& l) { return l.area_m2 > 0.4 * most; });
  };
  int legs = 0, head = 0;
  for (const double share : {0.08, 0.13, 0.18, 0.24, 0.30}) legs += pieces(share) == 2 ? 1 : 0;
  for (const double share : {0.90, 0.93, 0.96}) head += pieces(share) == 1 ? 1 : 0;
  return legs >= 4 && head >= 2;
}

Vec3 axis(int k, double sign) {
  Vec3 a;
  a[k] = sign;
  return a;
}

}  // namespace

TriangleMesh upright(TriangleMesh body, const Stance& given, const std::string& file, std::vector<std::string>& notes) {
  const auto fail = [&](const char* key, const std::string& reason) { throw InputError({file, 0, key}, reason); };
  const auto box = boxOf(body);
  const Vec3 extent = box[1] - box[0];

  std::optional<Vec3> up = given.up;
  if (!up) {
    for (int k = 0; k < 3; ++k)
      for (const double sign : {1.0, -1.0})
        if (!up && standsAlong(body, axis(k, sign))) up = axis(k, sign);
    if (!up)
      fail("up",
           "no axis of the file has two legs at one end and a head at the other: does it stand, with legs apart? "
           "Say \"up\" if it does, or turn the file");
    for (int k = 0; k < 3; ++k)
      if (std::abs((*up)[k]) > 0.5)
        notes.push_back(fmt::format("up is {}{} of the file", (*up)[k] < 0 ? "-" : "", "xyz"[k]));
  }
  int upward = 0;
  for (int k = 0; k < 3; ++k)
    if (std::abs((*up)[k]) > 0.5) upward = k;
  const double tall = extent[upward];
  double scale = 1;
  if (given.height_m) {
    scale = *given.height_m / tall;
  } else {
    const Unit* unit = nullptr;
    for (const Unit& u : kUnits)
      if (tall * u.m >= kLeast_m && tall * u.m <= kMost_m) unit = &u;
    if (!unit)
      fail("height", fmt::format("is {:.4g} units tall, which is {} to {} m in no unit: say its \"height\"", tall,
                                 kLeast_m, kMost_m));
    scale = unit->m;
    notes.push_back(fmt::format("taken to be in {}: it is {:.3f} m tall", unit->name, scale * tall));
  }
  for (Vec3& x : body.vertices) x = scale * x;

  // A provisional forward axis, then the principal axis of the level spread as "left".
  Vec3 forward = given.facing.value_or(axis(upward == 0 ? 1 : 0, 1));
  if (std::abs(dot(forward, *up)) > 0.5) fail("facing", "is the axis that is up; allowed: one across it");
  turn(body, forward, *up);
  Vec3 mean;
  for (const Vec3& x : body.vertices) mean += x / static_cast<double>(body.vertices.size());
  double xx = 0, yy = 0, xy = 0;
  for (const Vec3& x : body.vertices) {
    const Vec3 d = x - mean;
    xx += d.x * d.x, yy += d.y * d.y, xy += d.x * d.y;
  }
  if (!given.facing) {
    // The angle of the longer principal axis from y.
    double angle = 0.5 * std::atan2(2 * xy, yy - xx);
    const double quarter = std::round(angle / (0.5 * std::numbers::pi)) * 0.5 * std::numbers::pi;
    const bool askew = std::abs(angle - quarter) > kAskew_rad;
    if (!askew) angle = quarter;
    turn(body, {std::cos(angle), -std::sin(angle), 0}, {0, 0, 1});
    if (askew)
      notes.push_back(
          fmt::format("it stood {:.0f} degrees askew about the vertical", (angle - quarter) * 180 / std::numbers::pi));
  }
  auto now = boxOf(body);
  for (Vec3& x : body.vertices) x.z -= now[0].z;
  const double H = now[1].z - now[0].z;
  // Toes reach further from the ankle than the heel does.
  Vec3 ankle, low{std::numeric_limits<double>::infinity(), 0, 0}, high = -low;
  double n = 0;
  double left = -low.x, right = low.x;
  for (const Vec3& x : body.vertices) {
    if (x.z < 0.03 * H) {
      low.x = std::min(low.x, x.x), high.x = std::max(high.x, x.x);
      left = std::max(left, x.y), right = std::min(right, x.y);
    }
    if (x.z > 0.07 * H && x.z < 0.12 * H) ankle += x, n += 1;
  }
  if (!(n > 0) || !(high.x > low.x)) fail("facing", "shows no feet that would tell where it faces: say \"facing\"");
  ankle = ankle / n;
  const double ahead = high.x - ankle.x, behind = ankle.x - low.x;
  if (!given.facing) {
    if (!(std::max(ahead, behind) > 1.25 * std::min(ahead, behind)))
      fail("facing",
           fmt::format("its feet reach {:.3f} m to one side of the ankles and {:.3f} m to the other: toes and "
                       "heels cannot be told apart. Say \"facing\"",
                       ahead, behind));
    if (behind > ahead) turn(body, {-1, 0, 0}, {0, 0, 1}), std::swap(left, right), left = -left, right = -right;
  }
  const double middle_x = behind > ahead && !given.facing ? -ankle.x : ankle.x;
  for (Vec3& x : body.vertices) x.x -= middle_x, x.y -= 0.5 * (left + right);
  Vec3 head;
  double tops = 0;
  for (const Vec3& x : body.vertices) {
    if (x.z > 0.93 * H) head += x, tops += 1;
    if (const double aside = std::max(std::abs(x.x), std::abs(x.y)); aside > kMostSide * H)
      fail("shape",
           fmt::format("has a point {:.2f} m to a side of its feet, {:.2f} of its height; arms reach 0.5 of it: "
                       "a spike, or something beside the body. Remove it from the file",
                       aside, aside / H));
  }
  if (const double lean = std::hypot(head.x / tops, head.y / tops); lean > kMostLean * H)
    fail("up",
         fmt::format("its head is {:.2f} m beside its feet, so it leans by {:.0f} degrees from the axis that is up. "
                     "Turn the file until the body is upright",
                     lean, std::atan2(lean, 0.9 * H) * 180 / std::numbers::pi));
  return body;
}

}  // namespace gambeson
