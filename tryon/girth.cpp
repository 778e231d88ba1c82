#include "tryon/girth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace gambeson {
namespace {

/// Sets of numbers, joined two by two.
class Joined {
 public:
  explicit Joined(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    i = find(i), j = find(j);
    parent_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<std::size_t> parent_;
};

using Edge = std::array<int, 2>;

struct Cut {
  std::array<Edge, 2> edge;
  double rest_m = 0, worn_m = 0;
  Vec3 middle_m;
};

/// Where the plane cuts triangles. A sample in the plane counts as above it.
std::vector<Cut> cutsAt(const Surface& s, std::span<const Vec3> rest, std::span<const Vec3> worn, Vec3 up,
                        double height_m) {
  std::vector<Cut> cuts;
  const auto above = [&](int v) { return dot(worn[static_cast<std::size_t>(v)], up) - height_m; };
  for (const auto& t : s.triangles) {
    Cut cut;
    std::array<Vec3, 2> X, x;
    std::size_t n = 0;
    for (int k = 0; k < 3; ++k) {
      const auto [v, w] = std::minmax(t[static_cast<std::size_t>(k)], t[static_cast<std::size_t>((k + 1) % 3)]);
      const double a = above(v), b = above(w);
      if ((a >= 0) == (b >= 0)) continue;
      const double at = a / (a - b);
      const auto between = [&](std::span<const Vec3> p) {
        return (1 - at) * p[static_cast<std::size_t>(v)] + at * p[static_cast<std::size_t>(w)];
      };
      cut.edge[n] = {v, w};
      X[n] = between(rest);
      x[n] = between(worn);
      ++n;
    }
    if (n != 2) continue;
    cut.rest_m = norm(X[1] - X[0]);
    cut.worn_m = norm(x[1] - x[0]);
    cut.middle_m = 0.5 * (x[0] + x[1]);
    cuts.push_back(cut);
  }
  return cuts;
}

}  // namespace

std::vector<Girth> girthsAt(const Surface& s, std::span<const Vec3> rest, std::span<const Vec3> worn, Vec3 up,
                            double height_m) {
  const std::vector<Cut> cuts = cutsAt(s, rest, worn, up, height_m);
  std::map<Edge, std::vector<std::size_t>> at_edge;
  for (std::size_t k = 0; k < cuts.size(); ++k)
    for (const Edge& e : cuts[k].edge) at_edge[e].push_back(k);
  Joined pieces(cuts.size());
  std::map<int, std::vector<Edge>> border;  // edges of one cut alone, by sample
  std::set<Edge> ends;
  for (const auto& [edge, of] : at_edge) {
    for (const std::size_t k : of) pieces.join(of.front(), k);
    if (of.size() > 1) continue;
    ends.insert(edge);
    for (const int v : edge) border[v].push_back(edge);
  }
  // A border goes on at the other side of a seam: at an edge whose samples are twins of this one's.
  std::set<Edge> sewn;
  for (const auto& [v, w] : s.twins) {
    const auto of_v = border.find(v), of_w = border.find(w);
    if (of_v == border.end() || of_w == border.end()) continue;
    for (const Edge& a : of_v->second)
      for (const Edge& b : of_w->second) {
        pieces.join(at_edge[a].front(), at_edge[b].front());
        sewn.insert(a), sewn.insert(b);
      }
  }
  std::map<std::size_t, Girth> girths;
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    Girth& g = girths.try_emplace(pieces.find(k), Girth{height_m, 0, 0, {}, true}).first->second;
    g.rest_m += cuts[k].rest_m;
    g.worn_m += cuts[k].worn_m;
    g.middle_m += cuts[k].worn_m * cuts[k].middle_m;
    for (const Edge& e : cuts[k].edge)
      if (ends.contains(e) && !sewn.contains(e)) g.closed = false;
  }
  std::vector<Girth> out;
  for (auto& [piece, g] : girths) {
    if (!(g.worn_m > 0)) continue;
    g.middle_m = g.middle_m / g.worn_m;
    out.push_back(g);
  }
  return out;
}

std::vector<Girth> shortGirths(const Surface& s, std::span<const Vec3> rest, std::span<const Vec3> worn, Vec3 up,
                               double part, std::size_t most, double step_m) {
  // Less around than a wrist, or short by less than a millimetre, is no place that a body does not fit into: torn cloth
  // has such cuts.
  constexpr double kNear_m = 0.1, kLeast_m = 0.1, kShort_m = 1e-3;
  double low = 1e300, high = -1e300;
  for (const Vec3& x : worn) low = std::min(low, dot(x, up)), high = std::max(high, dot(x, up));
  std::vector<Girth> found;
  for (double at = (std::floor(low / step_m) + 0.5) * step_m; at < high; at += step_m)
    for (const Girth& g : girthsAt(s, rest, worn, up, at))
      if (g.closed && g.rest_m > kLeast_m && g.short_m() > std::max(kShort_m, part * g.rest_m)) found.push_back(g);
  std::stable_sort(found.begin(), found.end(),
                   [](const Girth& a, const Girth& b) { return a.short_m() > b.short_m(); });
  std::vector<Girth> out;
  for (const Girth& g : found)
    if (out.size() < most &&
        std::none_of(out.begin(), out.end(), [&](const Girth& o) { return norm(o.middle_m - g.middle_m) < kNear_m; }))
      out.push_back(g);
  return out;
}

std::string shortText(std::span<const Girth> girths) {
  std::string text;
  for (const Girth& g : girths)
    text += fmt::format("{}at a height of {:.2f} m it is {:.1f} cm around and worn {:.1f} cm: {:.1f} cm short",
                        text.empty() ? "" : "; ", g.height_m, 100 * g.rest_m, 100 * g.worn_m, 100 * g.short_m());
  return text;
}

}  // namespace gambeson
