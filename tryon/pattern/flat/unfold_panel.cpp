#include "tryon/pattern/flat/unfold_panel.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tryon/pattern/flat/turn_panel.hpp"

namespace gambeson {
namespace {

constexpr double kOn_m = 2e-4;  ///< from the fold: on it

class Fold {
 public:
  Fold(Vec2 a, Vec2 b) : a_(a) {
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    along_ = {(b.x - a.x) / length, (b.y - a.y) / length};
  }
  bool has(Vec2 p) const { return std::abs((p.x - a_.x) * along_.y - (p.y - a_.y) * along_.x) <= kOn_m; }
  bool has(const PanelEdge& e, Vec2 end) const {
    const auto* line = std::get_if<PolylineEdge>(&e.curve);
    return has(e.start_m) && has(end) &&
           (std::holds_alternative<StraightEdge>(e.curve) ||
            (line && std::all_of(line->points_m.begin(), line->points_m.end(), [&](Vec2 p) { return has(p); })));
  }
  Vec2 onto(Vec2 p) const {
    const double t = (p.x - a_.x) * along_.x + (p.y - a_.y) * along_.y;
    return {a_.x + t * along_.x, a_.y + t * along_.y};
  }
  Vec2 beyond(Vec2 p) const {
    const Vec2 q = onto(p);
    return {2 * q.x - p.x, 2 * q.y - p.y};
  }
  /// A loop beyond the fold, which there runs the other way round.
  PanelLoop beyond(PanelLoop loop) const {
    for (PanelEdge& e : loop) {
      e.start_m = beyond(e.start_m);
      std::visit([&](auto& curve) { turn(curve); }, e.curve);
    }
    return loop;
  }

 private:
  void turn(std::vector<Vec2>& points) const {
    for (Vec2& p : points) p = beyond(p);
  }
  void turn(StraightEdge&) const {}
  void turn(BezierEdge& e) const { turn(e.controls_m); }
  void turn(ArcEdge& e) const { e.turn_rad = -e.turn_rad; }
  void turn(SplineEdge& e) const { turn(e.controls_m); }
  void turn(PolylineEdge& e) const { turn(e.points_m); }

  Vec2 a_, along_;
};

struct Unfolded {
  PanelLoop loop;
  std::size_t first = 0, kept = 0;  ///< edges of the half that stay: from this one on, so many
};

std::optional<Unfolded> unfolded(const PanelLoop& half, const Fold& fold) {
  const std::size_t n = half.size();
  std::vector<char> on(n);
  for (std::size_t k = 0; k < n; ++k) on[k] = fold.has(half[k], half[(k + 1) % n].start_m);
  std::size_t starts = 0, first = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (on[k] && !on[(k + 1) % n]) {
      ++starts;
      first = (k + 1) % n;
    }
  if (starts != 1) return std::nullopt;
  Unfolded out;
  out.first = first;
  out.kept = static_cast<std::size_t>(std::count(on.begin(), on.end(), 0));
  // The half with one edge along the fold, its last, ...
  PanelLoop open;
  for (std::size_t i = 0; i < out.kept; ++i) open.push_back(half[(first + i) % n]);
  open.front().start_m = fold.onto(open.front().start_m);
  open.push_back({"", fold.onto(half[(first + out.kept) % n].start_m), StraightEdge{}});
  // ... and what lies beyond, whose first edge is that one.
  const PanelLoop other = reversed(fold.beyond(open));
  out.loop.assign(open.begin(), open.end() - 1);
  out.loop.insert(out.loop.end(), other.begin() + 1, other.end());
  return out;
}

}  // namespace

bool unfold(Panel& panel, Vec2 a, Vec2 b) {
  if (!(std::hypot(b.x - a.x, b.y - a.y) > kOn_m)) return false;
  const Fold fold(a, b);
  const std::optional<Unfolded> outline = unfolded(panel.outline, fold);
  if (!outline) return false;
  const std::size_t n = panel.outline.size(), whole = outline->loop.size();
  std::size_t in_cutouts = 0;
  for (const PanelLoop& c : panel.cutouts) in_cutouts += c.size();
  std::vector<Notch> notches;
  for (const Notch& given : panel.notches) {
    Notch here = given, there = given;
    there.at = 1 - given.at;
    std::size_t edge = static_cast<std::size_t>(given.edge);
    if (edge < n) {
      edge = (edge + n - outline->first) % n;
      if (edge >= outline->kept) continue;
      here.edge = static_cast<int>(edge);
      there.edge = static_cast<int>(whole - 1 - edge);
    } else {
      edge -= n;
      here.edge = static_cast<int>(whole + edge);
      std::size_t start = 0;
      for (const PanelLoop& c : panel.cutouts) {
        if (edge < start + c.size()) {
          there.edge = static_cast<int>(whole + in_cutouts + start + c.size() - 1 - (edge - start));
          break;
        }
        start += c.size();
      }
    }
    notches.push_back(here);
    notches.push_back(there);
  }
  panel.notches = std::move(notches);
  const std::vector<PanelLoop> cutouts = panel.cutouts;
  for (const PanelLoop& c : cutouts) panel.cutouts.push_back(reversed(fold.beyond(c)));
  const std::vector<InternalLine> lines = panel.lines;
  for (const InternalLine& l : lines) {
    if (std::all_of(l.points_m.begin(), l.points_m.end(), [&](Vec2 p) { return fold.has(p); })) continue;
    InternalLine other = l;
    for (Vec2& p : other.points_m) p = fold.beyond(p);
    panel.lines.push_back(std::move(other));
  }
  if (!panel.cut_line.empty()) {
    const std::optional<Unfolded> cut = unfolded(panel.cut_line, fold);
    panel.cut_line = cut ? cut->loop : PanelLoop{};
  }
  panel.outline = outline->loop;
  return true;
}

}  // namespace gambeson
