#include "core/nurbs/trim_notches.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/nurbs/trim_arcs.hpp"

namespace gambeson {
namespace {

/// The border, counter-clockwise from its corner (u0, v0): four sides of length 1.
class Border {
 public:
  explicit Border(const TrimBoundary& b) : b_(b) {}

  /// Where along the border a point lies that is on side `side`; nothing where it is not on it.
  std::optional<double> at(Vec2 p, int side) const {
    const double s = (p.x - b_.u0) / (b_.u1 - b_.u0), t = (p.y - b_.v0) / (b_.v1 - b_.v0);
    const double off[4] = {t, 1 - s, 1 - t, s}, along[4] = {s, t, 1 - s, 1 - t};
    if (std::abs(off[side]) > kOn) return std::nullopt;
    return side + along[side];
  }
  std::optional<double> at(Vec2 p) const {
    for (int side = 0; side < 4; ++side)
      if (const auto s = at(p, side)) return std::fmod(*s, 4.0);
    return std::nullopt;
  }
  /// The curve lies in one side.
  bool holds(const NurbsCurve& c) const {
    for (int side = 0; side < 4; ++side)
      if (std::all_of(c.points.begin(), c.points.end(), [&](Vec2 p) { return at(p, side).has_value(); })) return true;
    return false;
  }
  /// Straight lines from one point of the border to another, counter-clockwise.
  void follow(Vec2 from, Vec2 to, TrimLoop& loop) const {
    double s = *at(from);
    const double end = s + ahead(s, *at(to));
    Vec2 p = from;
    for (int k = static_cast<int>(std::floor(s + kOn)) + 1; k < end - kOn; ++k) {
      const Vec2 next = corner(k % 4);
      loop.push_back(line(p, next));
      p = next;
    }
    if (end - s > kOn) loop.push_back(line(p, to));
  }
  /// The way from s to t, counter-clockwise.
  static double ahead(double s, double t) { return std::fmod(t - s + 4 + kOn, 4.0) - kOn; }

 private:
  Vec2 corner(int k) const { return {k == 1 || k == 2 ? b_.u1 : b_.u0, k >= 2 ? b_.v1 : b_.v0}; }

  static constexpr double kOn = 1e-10;  ///< of a side: trimBoundary takes a tenth of it for nothing
  const TrimBoundary& b_;
};

Vec2 startOf(const TrimLoop& curves) { return curvePoint(curves.front(), curves.front().knots.front()).point; }
Vec2 endOf(const TrimLoop& curves) { return curvePoint(curves.back(), curves.back().knots.back()).point; }

}  // namespace

Trim withoutNotches(const NurbsPatch& patch, const Trim& trim) {
  const TrimBoundary boundary = trimBoundary(patch, trim);
  if (!boundary.rectangle_is_outline) return trim;
  const Border border(boundary);
  Trim out = trim;
  out.loops.clear();
  std::vector<TrimLoop> cuts;  // what of the notches leads from border to border
  for (const TrimLoop& loop : trim.loops) {
    const auto first = std::find_if(loop.begin(), loop.end(), [&](const NurbsCurve& c) { return border.holds(c); });
    if (first == loop.end()) {
      out.loops.push_back(loop);
      continue;
    }
    bool open = false;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const NurbsCurve& c = loop[(static_cast<std::size_t>(first - loop.begin()) + k) % loop.size()];
      const bool on = border.holds(c);
      if (!on && !open) cuts.emplace_back();
      if (!on) cuts.back().push_back(c);
      open = !on;
    }
  }
  std::vector<char> used(cuts.size(), 0);
  for (std::size_t first = 0; first < cuts.size(); ++first) {
    if (used[first]) continue;
    TrimLoop outline;
    for (std::size_t at = first;;) {
      used[at] = 1;
      outline.insert(outline.end(), cuts[at].begin(), cuts[at].end());
      // On along the border, to where the next cut begins.
      const double here = *border.at(endOf(cuts[at]));
      const auto way = [&](const TrimLoop& cut) { return Border::ahead(here, *border.at(startOf(cut))); };
      const auto next = std::min_element(cuts.begin(), cuts.end(),
                                         [&](const TrimLoop& a, const TrimLoop& b) { return way(a) < way(b); });
      border.follow(endOf(cuts[at]), startOf(*next), outline);
      at = static_cast<std::size_t>(next - cuts.begin());
      if (at == first) break;
    }
    out.loops.push_back(outline);
  }
  return out;
}

}  // namespace gambeson
