#include "cases/wear/results/girths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <variant>

#include "cases/wear/scene/placed_bodies.hpp"
#include "human/body/girths.hpp"
#include "human/body/section.hpp"

namespace gambeson {
namespace {

/// Cloth counts up to this many of the body's own radii from the middle of its section: what is beyond hangs free.
constexpr double kReach = 1.9;
/// A garment goes around where its pieces are seen from the middle under all but this part of the full turn.
constexpr int kSectors = 36, kMissing = 2;

double squaredDistance(const Vec2& x, const std::vector<Vec2>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) least = std::min(least, (p.x - x.x) * (p.x - x.x) + (p.y - x.y) * (p.y - x.y));
  return least;
}

/// The links that a plane does not measure, in the same plane.
GirthPlane ofOthers(const GirthPlane& plane, std::size_t links) {
  GirthPlane out = plane;
  out.links.clear();
  for (int l = 0; l < static_cast<int>(links); ++l)
    if (std::find(plane.links.begin(), plane.links.end(), l) == plane.links.end()) out.links.push_back(l);
  return out;
}

/// Pieces that hang together, each run with a number: those of one patch, which nothing parts.
std::vector<std::size_t> runsOf(const std::vector<ClothPiece>& pieces) {
  std::map<std::array<int, 2>, std::vector<std::size_t>> at_edge;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    for (const auto& edge : pieces[k].edges) at_edge[edge].push_back(k);
  std::vector<std::size_t> run(pieces.size(), pieces.size());
  std::size_t count = 0;
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    if (run[k] < pieces.size()) continue;
    std::vector<std::size_t> open{k};
    run[k] = count;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const auto& edge : pieces[at].edges)
        for (const std::size_t next : at_edge[edge])
          if (run[next] == pieces.size()) run[next] = count, open.push_back(next);
    }
    ++count;
  }
  return run;
}

double lengthOf(const ClothPiece& p) { return std::hypot(p.ends[1].x - p.ends[0].x, p.ends[1].y - p.ends[0].y); }
Vec2 middleOf(const ClothPiece& p) { return {0.5 * (p.ends[0].x + p.ends[1].x), 0.5 * (p.ends[0].y + p.ends[1].y)}; }

/// Whether each piece lies around another part of the body: its run does, by the mean of its distances from the
/// section here and from those of the others. A piece alone tells nothing: the side of a shirt is nearer to an arm that
/// hangs beside it than to the chest.
std::vector<char> areOfOthers(const std::vector<ClothPiece>& pieces, const std::vector<Vec2>& section,
                              const std::vector<Vec2>& others) {
  const std::vector<std::size_t> run = runsOf(pieces);
  std::vector<double> farther(pieces.size(), 0);  // from here than from others, summed over the run's length
  for (std::size_t k = 0; k < pieces.size(); ++k)
    farther[run[k]] += lengthOf(pieces[k]) * (std::sqrt(squaredDistance(middleOf(pieces[k]), section)) -
                                              std::sqrt(squaredDistance(middleOf(pieces[k]), others)));
  std::vector<char> out;
  for (const std::size_t r : run) out.push_back(!others.empty() && farther[r] > 0);
  return out;
}

struct LengthAround {
  double worn_m = 0, rest_m = 0;
};

/// Length of the pieces of cloth around a section, worn and at rest; 0 where they do not go around it. What lies
/// around another part of the body, as a sleeve beside the chest, is left out.
LengthAround lengthAround(const std::vector<ClothPiece>& pieces, const std::vector<Vec2>& section,
                          const std::vector<Vec2>& others) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Vec2 low{inf, inf}, high{-inf, -inf};
  for (const Vec2& p : section) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const Vec2 middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
  const double radius = 0.5 * std::max(high.x - low.x, high.y - low.y);
  std::array<bool, kSectors> seen{};
  const auto sectorOf = [&](const Vec2& p) {
    const double turn = (std::atan2(p.y - middle.y, p.x - middle.x) + std::numbers::pi) / (2 * std::numbers::pi);
    return std::clamp(static_cast<int>(turn * kSectors), 0, kSectors - 1);
  };
  LengthAround length;
  const std::vector<char> of_others = areOfOthers(pieces, section, others);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const auto& [a, b] = pieces[k].ends;
    const Vec2 m = middleOf(pieces[k]);
    if (of_others[k] || std::hypot(m.x - middle.x, m.y - middle.y) > kReach * radius) continue;
    length.worn_m += lengthOf(pieces[k]);
    length.rest_m += pieces[k].rest_m;
    // All that the piece covers, the shorter way from end to end: coarse cells have fewer pieces than there are
    // sectors.
    int from = sectorOf(a), to = sectorOf(b);
    if ((to - from + kSectors) % kSectors > kSectors / 2) std::swap(from, to);
    for (int n = from;; n = (n + 1) % kSectors) {
      seen[static_cast<std::size_t>(n)] = true;
      if (n == to) break;
    }
  }
  return std::count(seen.begin(), seen.end(), false) <= kMissing ? length : LengthAround{};
}

/// Where a garment is short around the body.
std::vector<Girth> shortOf(const Scenario& s, std::size_t garment, const std::vector<Vec3>& worn) {
  Surface alone = s.model->surface;
  alone.triangles.clear();
  for (std::size_t t = 0; t < s.model->surface.triangles.size(); ++t) {
    const auto patch = static_cast<std::size_t>(alone.triangle_patch[t]);
    if (s.model->cloth->patches()[patch].garment == static_cast<int>(garment))
      alone.triangles.push_back(s.model->surface.triangles[t]);
  }
  std::vector<Vec3> rest(static_cast<std::size_t>(alone.size()));
  alone.W.multiply<Vec3>(s.model->cloth->rest(), rest);
  return shortGirths(alone, rest, worn, {0, 0, 1}, standsOf(fabricOf(s.definition, s.definition.garments[garment])));
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
  std::vector<Vec3> rest(static_cast<std::size_t>(surface.size()));
  surface.W.multiply<Vec3>(s.model->cloth->rest(), rest);
  std::vector<std::vector<std::array<int, 3>>> cloth(s.definition.garments.size());
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    cloth[static_cast<std::size_t>(
              s.model->cloth->patches()[static_cast<std::size_t>(surface.triangle_patch[t])].garment)]
        .push_back(surface.triangles[t]);
  const std::size_t links = s.human->skeleton.links.size();
  std::vector<GirthMeasure> girths;
  for (const GirthPlane& plane : girthPlanes(*s.human, std::span(poses).first(links))) {
    const auto sectionOf = [&](const GirthPlane& p) {
      return bodySection(*s.human, p, std::span(poses).first(links), skin);
    };
    const std::vector<Vec2> section = sectionOf(plane);
    const double body = tapeGirth(section);
    if (!(body > 0)) continue;
    const std::vector<Vec2> others = sectionOf(ofOthers(plane, links));
    GirthMeasure girth{plane.zone, body, {}};
    for (std::size_t g = 0; g < cloth.size(); ++g)
      if (const LengthAround l = lengthAround(cutCloth(plane, x, rest, cloth[g]), section, others); l.worn_m > 0)
        girth.worn.push_back({s.definition.garments[g].name, l.worn_m, l.rest_m});
    girths.push_back(std::move(girth));
  }
  return girths;
}

std::string doesNotFit(const ShortMeasure& t) {
  const std::string which = t.garment.empty() ? "the garment" : "garment \"" + t.garment + "\"";
  return which + " does not fit: " + shortText(t.at);
}

void measureGirths(const Scenario& s, const RecordingReader& recording, Measured& out) {
  if (recording.frameCount() == 0) return;
  int first = 0;  // the last frame before the motion, when all is put on
  while (first + 1 < recording.frameCount() && !(recording.time(first) > -1e-9)) ++first;
  const Frame frame = recording.frame(first);
  const std::vector<Vec3> x = vectorsOf(frame.positions);
  out.girths = girthsAt(s, x, frame.time_s);
  for (std::size_t g = 0; g < s.definition.garments.size(); ++g)
    if (std::holds_alternative<PatternGarment>(s.definition.garments[g].shape))
      if (std::vector<Girth> at = shortOf(s, g, x); !at.empty())
        out.too_short.push_back({s.definition.garments[g].name, std::move(at)});
}

}  // namespace gambeson
