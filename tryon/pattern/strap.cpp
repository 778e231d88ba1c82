#include "tryon/pattern/strap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr int kMiddle = StrapLine::lines / 2;

StrapLine leaned(StrapLine line, double lean) {
  for (auto* end : {&line.front, &line.back})
    for (Vec3& x : *end) x = leaned(x, lean);
  return line;
}

/// How much of the end's own direction is left at a distance from it [m]: it fades out over 4.5 cm.
double fade(double distance_m) {
  const double x = std::max(0.0, 1 - distance_m / 0.045);
  return x * x * (3 - 2 * x);
}

/// Of profiles, upward: the farthest that any point lies in directions from forward over up to backward.
using Support = std::vector<double>;
constexpr int kDirections = 180;

/// Of what lies under each line, or every third, of a strap that is leaned already: a ball of the clearance rolls over
/// the profile under the line and `beside` others on either side of it, which ask for less.
std::vector<Support> supportsOf(const StrapLine& line, const BodyForm& form, double lean, int every, int beside) {
  const Links torso = form.links({"torso", "upper_arm_left"}, "garment.shirt");  // the shoulder is the arm's
  const double lowest = std::max(line.front[kMiddle].z, line.back[kMiddle].z);
  const double middle = 0.5 * (line.front[kMiddle].y + line.back[kMiddle].y);
  std::vector<Support> out;
  for (int i = 0; i <= StrapLine::lines; i += every) {
    out.emplace_back(kDirections + 1, -HUGE_VAL);
    for (int k = -beside; k <= beside; ++k) {
      const double aside = line.clearance_m * k / (beside + 0.5);
      const double further = std::sqrt(line.clearance_m * line.clearance_m - aside * aside);
      const double y = middle + (static_cast<double>(i) / StrapLine::lines - 0.5) * line.width_m + aside;
      const std::vector<Vec2> profile = form.profile(y, torso, lean);
      for (int d = 0; d <= kDirections; ++d) {
        const double angle = std::numbers::pi * d / kDirections, c = std::cos(angle), s = std::sin(angle);
        for (const Vec2& p : profile)
          if (p.y > lowest) out.back()[d] = std::max(out.back()[d], c * p.x + s * p.y + further);
      }
    }
  }
  return out;
}

/// What the lines ask for together. Cloth follows a hollow across it as far as its cross lines can: a sagitta of a
/// twentieth of the width asks for 8/3 / 20^2 = 0.7 % more cloth. Deeper ones it spans (between chest and arm of a body
/// made of ellipsoids).
void spanHollows(std::vector<Support>& each, double width_m) {
  for (int d = 0; d <= kDirections; ++d) {
    double flat = -HUGE_VAL;
    for (const Support& one : each) flat = std::max(flat, one[d]);
    for (Support& one : each) one[d] = std::max(one[d], flat - width_m / 20);
  }
}

/// The angle of least f, evenly sampled first, since a body may have more than one dent, then between the neighbours.
template <class F>
double leastAt(double from, double to, int steps, const F& f) {
  double best = HUGE_VAL;
  int at = 0;
  for (int k = 0; k <= steps; ++k)
    if (const double x = f(from + (to - from) * k / steps); x < best) best = x, at = k;
  double a = from + (to - from) * std::max(at - 1, 0) / steps, b = from + (to - from) * std::min(at + 1, steps) / steps;
  const double golden = 0.5 * (std::sqrt(5) - 1);
  double c = b - golden * (b - a), d = a + golden * (b - a), fc = f(c), fd = f(d);
  while (b - a > 0.005) {
    if (fc < fd) {
      b = d, d = c, fd = fc, c = b - golden * (b - a), fc = f(c);
    } else {
      a = c, c = d, fc = fd, d = a + golden * (b - a), fd = f(d);
    }
  }
  return 0.5 * (a + b);
}

}  // namespace

/// From end to end over what asks for the support: taut, since it follows the convex hull. Without points where the
/// ends lie inside.
Strap::String Strap::string(const Vec3& front, const Vec3& back, const Support& support) {
  const double lowest = std::max(front.z, back.z);
  std::vector<Vec2> points{{front.x, front.z}, {back.x, back.z}};
  const double step = std::numbers::pi / kDirections;
  for (int d = 0; d < kDirections; ++d) {
    if (!std::isfinite(support[d]) || !std::isfinite(support[d + 1])) continue;
    const double along = (support[d + 1] - support[d] * std::cos(step)) / std::sin(step);
    const double c = std::cos(d * step), s = std::sin(d * step);
    const Vec2 p{c * support[d] - s * along, s * support[d] + c * along};
    if (p.y > lowest) points.push_back(p);
  }
  std::vector<Vec2> hull = convexHull(points);
  const auto isAt = [](const Vec3& x) { return [&x](const Vec2& p) { return p.x == x.x && p.y == x.z; }; };
  const auto start = std::find_if(hull.begin(), hull.end(), isAt(front));
  if (start == hull.end() || std::find_if(hull.begin(), hull.end(), isAt(back)) == hull.end()) return {};
  std::rotate(hull.begin(), start, hull.end());
  String out;
  out.points.assign(hull.begin(), std::find_if(hull.begin(), hull.end(), isAt(back)) + 1);
  out.at.push_back(0);
  for (std::size_t k = 1; k < out.points.size(); ++k) {
    const Vec2 &p = out.points[k - 1], &q = out.points[k];
    out.at.push_back(out.at.back() + std::hypot(q.x - p.x, q.y - p.y));
  }
  return out;
}

/// The mean of inner, middle and outer line, all between the middle's ends; infinite where no string lies so.
double Strap::lengthAt(double lean, const BodyForm& form) const {
  const StrapLine line = leaned(line_, lean);
  std::vector<Support> supports = supportsOf(line, form, lean, kMiddle, 0);
  spanHollows(supports, line.width_m);
  double sum = 0;
  for (const Support& support : supports) {
    const String one = string(line.front[kMiddle], line.back[kMiddle], support);
    sum += one.at.empty() ? HUGE_VAL : one.at.back();
  }
  return sum / supports.size();
}

Strap::Strap(const StrapLine& line, const BodyForm& form) : line_(line) {
  lean_ = leastAt(-0.2, 0.8, 10, [&](double lean) { return lengthAt(lean, form); });
  line_ = leaned(line, lean_);
  std::vector<Support> supports = supportsOf(line_, form, lean_, 1, 4);
  spanHollows(supports, line.width_m);
  for (int i = 0; i <= StrapLine::lines; ++i) {
    strings_.push_back(string(line_.front[i], line_.back[i], supports[i]));
    if (strings_.back().at.empty())
      throw InputError({"", 0, "garment.shirt"},
                       "a strap does not clear the shoulder: its ends lie behind the body's profile");
  }
}

Vec2 Strap::String::point(double s) const {
  const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, s);
  const std::size_t i = above - at.begin();
  const double f = (s - at[i - 1]) / (at[i] - at[i - 1]);
  return {points[i - 1].x + f * (points[i].x - points[i - 1].x), points[i - 1].y + f * (points[i].y - points[i - 1].y)};
}

/// The point of line i where a cross line square to the strip meets it, or near the ends one that turns into them.
Vec2 Strap::point(int i, double t) const {
  const String &string = strings_[i], &middle = strings_[kMiddle];
  const auto before = [](const Vec2& from, const Vec2& to, const Vec3& end, const Vec3& mid) {
    const double size = std::hypot(to.x - from.x, to.y - from.y);
    return ((to.x - from.x) * (mid.x - end.x) + (to.y - from.y) * (mid.z - end.z)) / size;
  };
  constexpr double reach = 0.015;
  const double whole = middle.at.back(), own = string.at.back();
  const double front = before(middle.points.front(), middle.point(reach), line_.front[i], line_.front[kMiddle]);
  const double back = before(middle.points.back(), middle.point(whole - reach), line_.back[i], line_.back[kMiddle]);
  return string.point(front * (1 - fade(t * whole)) + t * (own - front - back) + back * fade((1 - t) * whole));
}

/// The points of all lines on a cross line: sideways as far apart as gives it its width.
std::array<Vec3, StrapLine::lines + 1> Strap::crossLine(double t) const {
  const double to_front = fade(t * length()), to_back = fade((1 - t) * length());
  const auto fromMiddle = [](int i) { return static_cast<double>(i) / StrapLine::lines - 0.5; };
  const auto lengthOf = [](const auto& x) { return norm(x[kMiddle] - x.front()) + norm(x.back() - x[kMiddle]); };
  const double width = line_.width_m + to_front * (lengthOf(line_.front) - line_.width_m) +
                       to_back * (lengthOf(line_.back) - line_.width_m);
  const double middle = line_.front[kMiddle].y + t * (line_.back[kMiddle].y - line_.front[kMiddle].y);
  const auto uneven = [&](const std::vector<Vec3>& end, int i) {
    return end[i].y - end[kMiddle].y - fromMiddle(i) * (end.back().y - end.front().y);
  };
  std::array<Vec3, StrapLine::lines + 1> out;
  for (int i = 0; i <= StrapLine::lines; ++i) {
    const Vec2 x = point(i, t);
    out[i] = {x.x, middle + to_front * uneven(line_.front, i) + to_back * uneven(line_.back, i), x.y};
  }
  // Across the strip a parabola, as cloth bends: of skins of triangles and of bodies made of ellipsoids each line has
  // its own steps. Least squares over -3 ... 3 (sums of squares 28, of fourth powers 196).
  static_assert(StrapLine::lines == 6);
  Vec3 sum{}, first{}, second{};
  for (int i = 0; i <= StrapLine::lines; ++i) {
    const double j = i - kMiddle;
    sum += out[i], first += j * out[i], second += j * j * out[i];
  }
  const Vec3 bend = (7 * second - 28 * sum) / (7 * 196 - 28 * 28);
  for (int i = 0; i <= StrapLine::lines; ++i) {
    const double j = i - kMiddle;
    const Vec3 off = out[i] - ((sum - 28 * bend) / 7 + j / 28 * first + j * j * bend);
    out[i] -= (1 - to_front - to_back) * off;
  }
  const auto spread = [&](double across) {
    auto points = out;
    for (int i = 0; i <= StrapLine::lines; ++i) points[i].y += fromMiddle(i) * across;
    return points;
  };
  double low = 0.5 * line_.width_m, high = 1.1 * line_.width_m;  // longer with every step sideways
  for (int k = 0; k < 30; ++k) {
    const double across = 0.5 * (low + high);
    (lengthOf(spread(across)) < width ? low : high) = across;
  }
  return spread(0.5 * (low + high));
}

Vec3 Strap::at(double s, double t) const {
  const double i = std::clamp(s, 0.0, 1.0) * StrapLine::lines;
  const int k = std::min(static_cast<int>(i), StrapLine::lines - 1);
  const auto x = crossLine(t);
  return leaned(x[k] + (i - k) * (x[k + 1] - x[k]), -lean_);
}

}  // namespace gambeson
