#include "tryon/pattern/strap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// From an end's points: how far the outer side lies sideways, limited by the width.
double sideways(const std::vector<Vec3>& end, double width) {
  return std::clamp(end.back().y - end.front().y, 0.5 * width, width);
}

}  // namespace

Strap::Strap(const StrapLine& line, const BodyForm& form) : line_(line) {
  const Links torso = form.links({"torso", "upper_arm_left"}, "garment.shirt");  // the shoulder is the arm's
  const Vec3 &front = line.front[StrapLine::lines / 2], &back = line.back[StrapLine::lines / 2];
  const double lowest = std::max(front.z, back.z);
  const double across = 0.5 * (sideways(line.front, line.width_m) + sideways(line.back, line.width_m));
  const double slope = std::sqrt(line.width_m * line.width_m - across * across);

  // Support of the profiles, each seen from the middle line: h(angle) = max over the lines of h_y + (a - 1/2) m. About
  // every line a ball of the clearance rolls over the body: profiles beside it ask for less.
  struct Profile {
    std::vector<Vec2> points;
    double further = 0;
  };
  std::vector<Profile> profiles;
  constexpr int beside = 4;
  for (int i = 0; i <= StrapLine::lines; ++i)
    for (int k = -beside; k <= beside; ++k) {
      const double aside = line.clearance_m * k / (beside + 0.5);
      Profile profile{{},
                      std::sqrt(line.clearance_m * line.clearance_m - aside * aside) +
                          (static_cast<double>(i) / StrapLine::lines - 0.5) * slope};
      for (const Vec2& p : form.profile(0.5 * (line.front[i].y + line.back[i].y) + aside, torso))
        if (p.y > lowest) profile.points.push_back(p);
      profiles.push_back(std::move(profile));
    }
  constexpr int directions = 180;  // upper half plane: from forward over up to backward
  std::vector<double> support(directions + 1, -HUGE_VAL);
  for (int d = 0; d <= directions; ++d) {
    const double angle = std::numbers::pi * d / directions, c = std::cos(angle), s = std::sin(angle);
    for (const Profile& profile : profiles)
      for (const Vec2& p : profile.points) support[d] = std::max(support[d], c * p.x + s * p.y + profile.further);
  }
  std::vector<Vec2> points{{front.x, front.z}, {back.x, back.z}};
  const double step = std::numbers::pi / directions;
  for (int d = 0; d < directions; ++d) {
    if (!std::isfinite(support[d])) continue;
    const double along = (support[d + 1] - support[d] * std::cos(step)) / std::sin(step);
    const double c = std::cos(d * step), s = std::sin(d * step);
    const Vec2 p{c * support[d] - s * along, s * support[d] + c * along};
    if (p.y > lowest) points.push_back(p);
  }
  std::vector<Vec2> hull = convexHull(points);
  const auto isAt = [](const Vec3& x) { return [&x](const Vec2& p) { return p.x == x.x && p.y == x.z; }; };
  const auto start = std::find_if(hull.begin(), hull.end(), isAt(front));
  if (start == hull.end() || std::find_if(hull.begin(), hull.end(), isAt(back)) == hull.end())
    throw InputError({"", 0, "garment.shirt"},
                     "a strap does not clear the shoulder: its ends lie behind the body's profile");
  std::rotate(hull.begin(), start, hull.end());
  string_.assign(hull.begin(), std::find_if(hull.begin(), hull.end(), isAt(back)) + 1);
  at_.push_back(0);
  for (std::size_t i = 1; i < string_.size(); ++i)
    at_.push_back(at_.back() + std::hypot(string_[i].x - string_[i - 1].x, string_[i].y - string_[i - 1].y));
}

Vec2 Strap::point(double s) const {
  const auto above = std::upper_bound(at_.begin() + 1, at_.end() - 1, s);
  const std::size_t i = above - at_.begin();
  const double f = (s - at_[i - 1]) / (at_[i] - at_[i - 1]);  // beyond the ends straight on
  return {string_[i - 1].x + f * (string_[i].x - string_[i - 1].x),
          string_[i - 1].y + f * (string_[i].y - string_[i - 1].y)};
}

Vec3 Strap::ribbon(double s, double t) const {
  const Vec3 &front = line_.front[StrapLine::lines / 2], &back = line_.back[StrapLine::lines / 2];
  const double length = t * at_.back();
  const Vec2 x = point(length);
  constexpr double reach = 0.015;
  const Vec2 before = point(length - reach), after = point(length + reach);
  const double size = std::hypot(after.x - before.x, after.y - before.y);
  const Vec2 n{(after.y - before.y) / size, -(after.x - before.x) / size};  // outward: the string runs counterclockwise
  const double df = sideways(line_.front, line_.width_m), db = sideways(line_.back, line_.width_m);
  const double across = df + t * (db - df);
  const double slope = std::sqrt(line_.width_m * line_.width_m - across * across);
  const double a = s - 0.5;
  return {x.x - a * slope * n.x, front.y + t * (back.y - front.y) + a * across, x.y - a * slope * n.y};
}

Vec3 Strap::at(double s, double t) const {
  const auto end = [&](const std::vector<Vec3>& points) {
    const double i = std::clamp(s, 0.0, 1.0) * StrapLine::lines;
    const int k = std::min(static_cast<int>(i), StrapLine::lines - 1);
    return points[k] + (i - k) * (points[k + 1] - points[k]);
  };
  constexpr double blend = 0.05;  // [m]
  const double from_front = std::max(0.0, 1 - t * length() / blend),
               from_back = std::max(0.0, 1 - (1 - t) * length() / blend);
  const double to_front = from_front * from_front, to_back = from_back * from_back;
  const auto blended = [&](double side, const Vec3& front, const Vec3& back) {
    return ribbon(side, t) + to_front * (front - ribbon(side, 0)) + to_back * (back - ribbon(side, 1));
  };
  // Directions that turn do not add up to the width; the cross line is given its length again.
  const Vec3 inner = blended(0, line_.front.front(), line_.back.front()),
             outer = blended(1, line_.front.back(), line_.back.back());
  const double width = line_.width_m + to_front * (norm(line_.front.back() - line_.front.front()) - line_.width_m) +
                       to_back * (norm(line_.back.back() - line_.back.front()) - line_.width_m);
  const Vec3 middle = 0.5 * (inner + outer);
  return middle + width / norm(outer - inner) * (blended(s, end(line_.front), end(line_.back)) - middle);
}

}  // namespace gambeson
