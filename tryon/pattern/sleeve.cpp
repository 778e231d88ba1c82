#include "tryon/pattern/sleeve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "tryon/pattern/check.hpp"

namespace gambeson {
namespace {

constexpr double bend_below_m = 0.08;  ///< of the armhole's lowest point: where the cap begins
constexpr double level_m = 0.003;      ///< between cross-sections of the hull
constexpr double tube_level_m = 0.01;  ///< between those of the tube
constexpr int cap_pieces = 48;         ///< of a line over the cap
/// From the armhole: within it a line comes off the hull, or into what is kept around the body, to its point.
constexpr double drawn_m = 0.06, let_in_m = 0.02;

/// 1 at distance 0, 0 from `reach_m` on, smooth at both.
double nearness(double distance_m, double reach_m) {
  const double x = std::max(0.0, 1 - distance_m / reach_m);
  return x * x * (3 - 2 * x);
}

}  // namespace

Vec3 ArmholePart::at(double s) const {
  const double x = std::clamp(s, 0.0, 1.0) * static_cast<double>(points.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(x), points.size() - 2);
  const double f = x - static_cast<double>(k);
  return (1 - f) * points[k] + f * points[k + 1];
}

SleeveDraft::SleeveDraft(const ArmForm& arm, std::array<ArmholePart, 4> armhole, double cell_m, double wider_under)
    : arm_(arm), armhole_(std::move(armhole)), wider_under_(wider_under) {
  double lowest = HUGE_VAL, highest = arm.top();
  for (ArmholePart& part : armhole_) {
    for (Vec3& x : part.points) {
      x = arm.toArm() * x;
      lowest = std::min(lowest, x.z), highest = std::max(highest, x.z);
    }
  }
  if (!(arm.hem() <= lowest - cell_m))
    throw InputError({"", 0, "sleeve_length_m"},
                     fmt::format("{:.4g} m, ends before it is below the armhole; allowed: at least {:.4g} m",
                                 -arm.hem(), cell_m - lowest));
  bend_ = std::max(arm.hem() + std::min(0.25 * (lowest - arm.hem()), 0.01), lowest - bend_below_m);

  const int heights = 2 + static_cast<int>(std::ceil((highest - bend_) / level_m));
  std::vector<std::vector<Vec2>> sections(static_cast<std::size_t>(heights));
  const auto height = [&](int k) { return bend_ + (highest - bend_) * k / (heights - 1); };
  for (int k = 0; k < heights; ++k)
    if (height(k) <= arm.top()) sections[static_cast<std::size_t>(k)] = arm.at(height(k));
  for (const ArmholePart& part : armhole_)
    for (std::size_t i = 0; i + 1 < part.points.size(); ++i) {
      const Vec3 &a = part.points[i], &b = part.points[i + 1];
      const auto row = [&](double z) { return (z - bend_) / (highest - bend_) * (heights - 1); };
      const double low = row(std::min(a.z, b.z)), high = row(std::max(a.z, b.z));
      for (int k = static_cast<int>(std::floor(low)); k <= static_cast<int>(std::ceil(high)); ++k) {
        if (k < 0 || k >= heights) continue;
        const double f = a.z == b.z ? 0 : std::clamp((height(k) - a.z) / (b.z - a.z), 0.0, 1.0);
        sections[static_cast<std::size_t>(k)].push_back({a.x + f * (b.x - a.x), a.y + f * (b.y - a.y)});
      }
    }
  hull_ = Wrap(sections, bend_, highest);

  const int tubes = 2 + static_cast<int>(std::ceil((bend_ - arm.hem()) / tube_level_m));
  for (int k = 0; k < tubes; ++k) {
    tube_.emplace_back(arm.at(arm.hem() + (bend_ - arm.hem()) * k / (tubes - 1)));
    outermost_.push_back(tube_.back().crossing(tube_.back().centroid(), {0, 1}));
  }

  double sum = 0;
  constexpr int looks = 8;
  for (int part = 0; part < 4; ++part)
    for (int i = 0; i < looks; ++i) sum += lineOf(part, (i + 0.5) / looks).at.back();
  along_ = cellsFor(sum / (4 * looks), cell_m, 4);
}

/// Where the ray from the arm's middle through x leaves a wrap, over the distance of x; above the shoulder joint's
/// height rays start from there. 0 where the ray starts outside.
double SleeveDraft::reach(const Wrap& of, const Vec3& x) const {
  const Vec3 c = middleAt(x.z), ray = x - c;
  const auto isIn = [&](double scale) {
    const Vec3 p = c + scale * ray;
    return p.z <= of.to() && of.beyond(p.z, {p.x, p.y}) <= 0;
  };
  double in = 0, out = 1;
  while (isIn(out) && out < 1e3) in = out, out *= 2;
  for (int k = 0; k < 40; ++k) {
    const double middle = 0.5 * (in + out);
    (isIn(middle) ? in : out) = middle;
  }
  return in;
}

SleeveDraft::Line SleeveDraft::makeLine(int part, double s) const {
  const ArmholePart& own = armhole_[static_cast<std::size_t>(part)];
  const auto width = [&](int p) {  // in cells
    return (p == 3 ? wider_under_ : 1) * armhole_[static_cast<std::size_t>(p)].cells;
  };
  double before = -width(0) - 0.5 * width(1);  // from the outermost line
  for (int p = 0; p < part; ++p) before += width(p);
  const double share = (before + s * width(part)) / (width(0) + width(1) + width(2) + width(3));
  Line line;
  for (std::size_t k = 0; k < tube_.size(); ++k) {
    const Vec2 x = tube_[k].point(outermost_[k] + share * tube_[k].length());
    const double z = arm_.hem() + (bend_ - arm_.hem()) * static_cast<double>(k) / static_cast<double>(tube_.size() - 1);
    line.points.push_back({x.x, x.y, z});
  }
  // How much of the line lies over the shoulder: none under the arm.
  const double over = part == 0 ? s : part == 1 ? 1 : part == 2 ? 1 - s : 0;
  const Vec3 p = line.points.back(), a = own.at(s);
  // The arc's corner: over the shoulder above p, as high along the arm as the armhole's point; under the arm on the
  // straight way to it, so that sleeve and wrap come up to their seam as two sides of a fold and bend nowhere else.
  const Vec3 above{p.x, p.y, std::max(p.z, a.z)};
  const Vec3 m = over * above + (0.5 * (1 - over)) * (p + a);
  // How far the armhole's point stands inside: there a line comes back to it.
  const double hulled = std::max(1.0, reach(*hull_, a)), kept = std::max(1.0, reach(arm_.kept(), a));
  for (int k = 1; k < cap_pieces; ++k) {
    const double t = static_cast<double>(k) / cap_pieces;
    const Vec3 x = (1 - t) * (1 - t) * p + 2 * t * (1 - t) * m + t * t * a;
    const double far = norm(x - a);
    const double out = over * reach(*hull_, x) / (1 + (hulled - 1) * nearness(far, drawn_m)) + 1 - over;
    const double least = reach(arm_.kept(), x) / (1 + (kept - 1) * nearness(far, let_in_m));
    const Vec3 c = middleAt(x.z);
    line.points.push_back(c + std::max(out, least) * (x - c));
  }
  line.points.push_back(a);
  line.at.push_back(0);
  for (std::size_t k = 1; k < line.points.size(); ++k)
    line.at.push_back(line.at.back() + norm(line.points[k] - line.points[k - 1]));
  return line;
}

const SleeveDraft::Line& SleeveDraft::lineOf(int part, double s) const {
  const auto found = lines_.find({part, s});
  if (found != lines_.end()) return found->second;
  return lines_.emplace(std::pair{part, s}, makeLine(part, s)).first->second;
}

Vec3 SleeveDraft::at(int part, double s, double t) const {
  const Line& line = lineOf(part, s);
  const double length = t * line.at.back();
  const auto above = std::upper_bound(line.at.begin() + 1, line.at.end() - 1, length);
  const std::size_t i = static_cast<std::size_t>(above - line.at.begin());
  const double f = (length - line.at[i - 1]) / (line.at[i] - line.at[i - 1]);
  return arm_.toWorld() * (line.points[i - 1] + f * (line.points[i] - line.points[i - 1]));
}

}  // namespace gambeson
