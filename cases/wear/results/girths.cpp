#include "cases/wear/results/girths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "cases/wear/scene/placed_bodies.hpp"
#include "human/body/girths.hpp"
#include "human/body/section.hpp"

namespace gambeson {
namespace {

/// Cloth counts up to this many of the body's own radii from the middle of its section: beyond it lies that of another
/// limb, or what hangs free.
constexpr double kReach = 1.9;
/// A garment goes around where its pieces are seen from the middle under all but this part of the full turn.
constexpr int kSectors = 36, kMissing = 2;

/// In a plane's axes, where the plane of the same zone of the other side is: cloth nearer to there is the other limb's.
std::optional<Vec2> otherLimb(const std::vector<GirthPlane>& planes, const GirthPlane& mine) {
  const std::string left = "_left", right = "_right";
  std::string other = mine.zone;
  if (other.ends_with(left))
    other.replace(other.size() - left.size(), left.size(), right);
  else if (other.ends_with(right))
    other.replace(other.size() - right.size(), right.size(), left);
  else
    return std::nullopt;
  for (const GirthPlane& p : planes)
    if (p.zone == other) {
      const Vec3 away = p.origin - mine.origin;
      return Vec2{dot(away, mine.e1), dot(away, mine.e2)};
    }
  return std::nullopt;
}

/// Length of the pieces of cloth around a section [m]; 0 where they do not go around it.
double lengthAround(const std::vector<std::array<Vec2, 2>>& pieces, const Vec2& middle, double radius,
                    const std::optional<Vec2>& other) {
  std::array<bool, kSectors> seen{};
  double length = 0;
  for (const auto& [a, b] : pieces) {
    const Vec2 m{0.5 * (a.x + b.x) - middle.x, 0.5 * (a.y + b.y) - middle.y};
    if (std::hypot(m.x, m.y) > kReach * radius) continue;
    if (other) {
      const double x = m.x + middle.x, y = m.y + middle.y;
      if (std::hypot(x - other->x, y - other->y) < std::hypot(x, y)) continue;
    }
    length += std::hypot(b.x - a.x, b.y - a.y);
    const double turn = (std::atan2(m.y, m.x) + std::numbers::pi) / (2 * std::numbers::pi);
    seen[static_cast<std::size_t>(std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1))] = true;
  }
  return std::count(seen.begin(), seen.end(), false) <= kMissing ? length : 0;
}

}  // namespace

std::vector<GirthMeasure> girthsAt(const Scenario& s, const std::vector<Vec3>& x, double time_s) {
  if (!s.human) return {};
  const std::vector<Pose> poses = s.bodyPoses(time_s);
  PlacedBodies placed(s);
  placed.moveTo(time_s);
  std::vector<Vec3> skin;
  if (s.human->skin) skin = placed.deformedMesh(0).vertices;
  const Surface& surface = s.model->surface;
  std::vector<std::vector<std::array<int, 3>>> cloth(s.definition.garments.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    cloth[static_cast<std::size_t>(
              s.model->cloth->patches()[static_cast<std::size_t>(surface.triangle_patch[t])].garment)]
        .push_back(surface.triangles[t]);
  const std::size_t links = s.human->skeleton.links.size();
  std::vector<GirthMeasure> girths;
  const std::vector<GirthPlane> planes = girthPlanes(*s.human, std::span(poses).first(links));
  for (const GirthPlane& plane : planes) {
    const std::optional<Vec2> other = otherLimb(planes, plane);
    const std::vector<Vec2> section = bodySection(*s.human, plane, std::span(poses).first(links), skin);
    const double body = tapeGirth(section);
    if (!(body > 0)) continue;
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}, high{-low.x, -low.y};
    for (const Vec2& p : section) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const Vec2 middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
    const double radius = 0.5 * std::max(high.x - low.x, high.y - low.y);
    GirthMeasure girth{plane.zone, body, {}};
    for (std::size_t g = 0; g < cloth.size(); ++g)
      if (const double length = lengthAround(cutPieces(plane, x, cloth[g]), middle, radius, other); length > 0)
        girth.worn.push_back({s.definition.garments[g].name, length});
    girths.push_back(std::move(girth));
  }
  return girths;
}

void measureGirths(const Scenario& s, const RecordingReader& recording, Measured& out) {
  if (!s.human || recording.frameCount() == 0) return;
  int first = 0;  // the last frame before the motion, when all is put on
  while (first + 1 < recording.frameCount() && !(recording.time(first) > -1e-9)) ++first;
  const Frame frame = recording.frame(first);
  out.girths = girthsAt(s, vectorsOf(frame.positions), frame.time_s);
}

}  // namespace gambeson
