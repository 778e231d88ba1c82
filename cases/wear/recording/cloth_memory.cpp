#include "cases/wear/recording/cloth_memory.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/material/laws/bending_laws.hpp"

namespace gambeson {
namespace {

/// Doubles that a line of a law remembers, whose set and friction stand behind its stops; 0: it has no lines.
template <class L>
constexpr int lineOf() {
  if constexpr (std::is_base_of_v<CyclicHysteresisBending, L>) return kCyclicHistory;
  return std::is_base_of_v<HysteresisBending, L> ? kStopHistory<kStops, LineCurvature> : 0;
}

/// Points of one patch in buckets of its parameters, so that the nearest ones are found at once.
class Buckets {
 public:
  Buckets(const ClothPatch& patch, std::size_t count)
      : low_(patch.low),
        size_({patch.high.x - patch.low.x, patch.high.y - patch.low.y}),
        across_(std::max(1, static_cast<int>(std::sqrt(static_cast<double>(count) / 4)))),
        of_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(across_)) {}

  void add(int point, const Vec2& place) { of_[slot(at(place, 0), at(place, 1))].push_back({point, scaled(place)}); }

  /// Of up to `count` points, the nearest first: from rings of buckets around the place.
  std::vector<int> nearest(const Vec2& place, int count) const {
    const int u = at(place, 0), v = at(place, 1);
    const Vec2 p = scaled(place);
    std::vector<std::pair<double, int>> found;
    bool enough = false;
    for (int ring = 0; ring < across_; ++ring) {
      for (int j = v - ring; j <= v + ring; ++j)
        for (int i = u - ring; i <= u + ring; ++i) {
          if (std::max(std::abs(i - u), std::abs(j - v)) != ring) continue;
          if (i < 0 || j < 0 || i >= across_ || j >= across_) continue;
          for (const auto& [point, q] : of_[slot(i, j)])
            found.emplace_back((q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y), point);
        }
      if (enough) break;  // one ring more than what holds them
      enough = static_cast<int>(found.size()) >= count;
    }
    std::sort(found.begin(), found.end());
    std::vector<int> of;
    for (std::size_t k = 0; k < found.size() && static_cast<int>(k) < count; ++k) of.push_back(found[k].second);
    return of;
  }

 private:
  Vec2 scaled(const Vec2& place) const {
    return {size_.x > 0 ? (place.x - low_.x) / size_.x : 0, size_.y > 0 ? (place.y - low_.y) / size_.y : 0};
  }
  int at(const Vec2& place, int d) const {
    const Vec2 p = scaled(place);
    return std::clamp(static_cast<int>((d == 0 ? p.x : p.y) * across_), 0, across_ - 1);
  }
  std::size_t slot(int i, int j) const { return static_cast<std::size_t>(j * across_ + i); }

  Vec2 low_, size_;
  int across_;
  std::vector<std::vector<std::pair<int, Vec2>>> of_;
};

/// Of the vertices of triangles the points that remember which lie in triangles about them, and of hinges those at
/// whose ends they are: a point lies by the corners of its triangle whose part of it is more than a quarter. `patch`
/// and `place`: of the points.
std::vector<std::vector<int>> pointsAboutVertices(const Surface& surface, std::span<const int> patch,
                                                  std::span<const Vec2> place) {
  std::vector<std::size_t> first(surface.patch_grid.size(), surface.triangles.size());  // triangle of each patch
  for (std::size_t t = surface.triangles.size(); t-- > 0;)
    first[static_cast<std::size_t>(surface.triangle_patch[t])] = t;
  std::vector<std::vector<int>> about(static_cast<std::size_t>(surface.size()));
  for (std::size_t k = 0; k < place.size(); ++k) {
    const auto p = static_cast<std::size_t>(patch[k]);
    if (!surface.patch_grid[p].empty()) continue;
    const double number = std::floor(0.5 * place[k].x), b = place[k].x - 2 * number, c = place[k].y;
    const std::array<int, 3>& corners = surface.triangles[first[p] + static_cast<std::size_t>(number)];
    const double parts[] = {1 - b - c, b, c};
    for (std::size_t i = 0; i < 3; ++i)
      if (parts[i] > 0.25) about[static_cast<std::size_t>(corners[i])].push_back(static_cast<int>(k));
  }
  // An ear, at which no two triangles meet, has what the other corners of its triangle have.
  for (const std::array<int, 3>& t : surface.triangles)
    for (const int v : t) {
      std::vector<int>& own = about[static_cast<std::size_t>(v)];
      if (own.empty())
        for (const int w : t) {
          const std::vector<int>& other = about[static_cast<std::size_t>(w)];
          if (w != v) own.insert(own.end(), other.begin(), other.end());
        }
    }
  return about;
}

}  // namespace

ClothMemoryView::ClothMemoryView(const Model& m) : model_(m) {
  if (m.cloth->historySize() == 0) return;
  const std::vector<HistoryPlace> places = m.cloth->historyPlaces();
  const std::vector<ClothPatch>& patches = m.cloth->patches();
  std::vector<std::vector<int>> of_patch(patches.size());
  std::vector<Vec2> places_of_points;
  std::vector<int> patch_of_points;
  for (const HistoryPlace& h : places) {
    const Fabric fabric = m.cloth->fabricAt(h.patch, h.place);
    const auto [kind, line] = std::visit(
        []<class L>(const L&) {
          constexpr bool is_tensor = std::is_base_of_v<IsotropicHysteresisBending, L>;
          return std::pair(is_tensor ? Kind::tensor : lineOf<L>() > 0 ? Kind::apart : Kind::none, lineOf<L>());
        },
        fabric.law);
    // What remembers friction in shear alone stands beside.
    const int needed = kind == Kind::tensor ? kStopHistory<kStops, PlaneCurvature> : 3 * line;
    if (h.count < static_cast<std::size_t>(needed)) continue;
    places_of_points.push_back(h.place);
    patch_of_points.push_back(h.patch);
    of_patch[static_cast<std::size_t>(h.patch)].push_back(static_cast<int>(points_.size()));
    points_.push_back({h.first, h.stride, kind, line});
    any_ = any_ || kind != Kind::none;
  }
  if (!any_) return;
  std::vector<Buckets> buckets;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    buckets.emplace_back(patches[p], of_patch[p].size());
    if (m.surface.patch_grid[p].empty()) continue;
    for (const int k : of_patch[p]) buckets.back().add(k, places_of_points[static_cast<std::size_t>(k)]);
  }
  near_ = pointsAboutVertices(m.surface, patch_of_points, places_of_points);
  for (int s = 0; s < m.surface.size(); ++s) {
    const auto p = static_cast<std::size_t>(m.surface.patch[s]);
    if (!m.surface.patch_grid[p].empty())
      near_[static_cast<std::size_t>(s)] = buckets[p].nearest(m.surface.parameters[s], kNearest);
  }
}

ClothMemory ClothMemoryView::at(std::span<const double> history) const {
  std::vector<double> set(points_.size(), 0), left(points_.size(), 1);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& p = points_[k];
    const auto number = [&](int i) { return history[p.first + static_cast<std::size_t>(i) * p.stride]; };
    if (p.kind == Kind::apart) {
      double sum = 0;
      left[k] = 0;
      for (int d = 0; d < 3; ++d) {
        const double kp = number(d * p.line + kStops);
        sum += (d < 2 ? 1 : 0.5) * kp * kp;
        left[k] += (1 - number(d * p.line + kStops + 1)) / 3;
      }
      set[k] = std::sqrt(sum);
    } else if (p.kind == Kind::tensor) {
      const double kp[3] = {number(3 * kStops), number(3 * kStops + 1), number(3 * kStops + 2)};
      set[k] = std::sqrt(PlaneCurvature::norm2(kp));
      left[k] = 1 - number(3 * kStops + 3);
    }
  }
  ClothMemory memory;
  for (int s = 0; s < model_.surface.size(); ++s) {
    double sum = 0, friction = 0;
    const std::vector<int>& near = near_[static_cast<std::size_t>(s)];
    for (const int k : near) {
      sum += set[static_cast<std::size_t>(k)];
      friction += left[static_cast<std::size_t>(k)];
    }
    const double n = static_cast<double>(near.size());
    memory.set_per_m.push_back(near.empty() ? 0 : sum / n);
    memory.friction_left.push_back(near.empty() ? 1 : friction / n);
  }
  return memory;
}

std::vector<std::string> ClothMemoryView::columns(const std::vector<std::string>& patch_names) {
  std::vector<std::string> names;
  for (const std::string& patch : patch_names)
    for (const char* what : {"_set_1_per_m", "_largest_set_1_per_m", "_friction_left", "_least_friction_left"})
      names.push_back(patch + what);
  return names;
}

std::vector<double> ClothMemoryView::row(std::span<const double> history, int patches) const {
  const ClothMemory memory = at(history);
  std::vector<double> out, area(static_cast<std::size_t>(patches), 0);
  for (int p = 0; p < patches; ++p) out.insert(out.end(), {0, 0, 0, 1});
  for (std::size_t s = 0; s < memory.set_per_m.size(); ++s) {
    const auto p = static_cast<std::size_t>(model_.surface.patch[s]);
    const double a = model_.surface.area_m2[s], left = memory.friction_left[s];
    double* const of = &out[kColumns * p];
    area[p] += a;
    of[0] += a * memory.set_per_m[s];
    of[1] = std::max(of[1], memory.set_per_m[s]);
    of[2] += a * left;
    of[3] = std::min(of[3], left);
  }
  for (std::size_t p = 0; p < area.size(); ++p) {
    out[kColumns * p] = area[p] > 0 ? out[kColumns * p] / area[p] : 0;
    out[kColumns * p + 2] = area[p] > 0 ? out[kColumns * p + 2] / area[p] : 1;
  }
  return out;
}

}  // namespace gambeson
