#include "core/cloth/draft/shared_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gambeson {
namespace {

bool isCut(const SewnSeam& s) {
  if (s.hold == SeamHold::open || s.a.size() != 1 || s.b.size() != 1) return false;
  const SewnPart &a = s.a[0], &b = s.b[0];
  const auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  return a.patch != b.patch && a.from == b.from && a.to == b.to && a.curve.knots == b.curve.knots &&
         a.curve.weights == b.curve.weights &&
         std::equal(a.curve.points.begin(), a.curve.points.end(), b.curve.points.begin(), b.curve.points.end(), same);
}

using Lines = std::vector<std::array<Vec2, 2>>;

void addLines(const SewnPart& part, Lines& out) {
  const int n = part.curve.knots.degree == 1 && part.curve.points.size() == 2
                    ? 1
                    : 32 * static_cast<int>(breakpoints(part.curve.knots).size() - 1);
  const auto at = [&](int k) { return curvePoint(part.curve, part.from + (part.to - part.from) * k / n).point; };
  for (int k = 0; k < n; ++k) out.push_back({at(k), at(k + 1)});
}

struct Box {
  Vec2 low, high;
};

/// Whether a line has a stretch within a box.
bool reaches(const std::array<Vec2, 2>& line, const Box& box) {
  double first = 0, last = 1;
  for (const int axis : {0, 1}) {
    const auto of = [&](Vec2 p) { return axis == 0 ? p.x : p.y; };
    const double at = of(line[0]), way = of(line[1]) - at;
    const double eps = 1e-9 * (of(box.high) - of(box.low)), low = of(box.low) + eps, high = of(box.high) - eps;
    if (std::abs(way) <= eps) {
      if (at <= low || at >= high) return false;
      continue;
    }
    const double s = (low - at) / way, t = (high - at) / way;
    first = std::max(first, std::min(s, t)), last = std::min(last, std::max(s, t));
  }
  return first < last;
}

bool reach(const Lines& lines, const Box& box) {
  return std::any_of(lines.begin(), lines.end(), [&](const auto& line) { return reaches(line, box); });
}

/// The sides of the seams that end, both sides of each, at an end of the cut.
Lines sidesAt(const Garment& g, const SewnSeam& cut) {
  const SewnPart& way = cut.a[0];
  const double size = std::hypot(way.curve.points.back().x - way.curve.points.front().x,
                                 way.curve.points.back().y - way.curve.points.front().y);
  Lines out;
  for (const SewnSeam& seam : g.sewn_seams) {
    if (&seam == &cut || isCut(seam) || seam.hold == SeamHold::open || seam.a.empty() || seam.b.empty()) continue;
    bool meets = false;
    for (const double t : {way.from, way.to})
      for (const bool end : {false, true}) {
        const auto isThere = [&](const SewnEdge& edge) {
          const SewnPart& part = end ? edge.back() : edge.front();
          if (part.patch != way.patch && part.patch != cut.b[0].patch) return false;
          const Vec2 p = curvePoint(part.curve, end ? part.to : part.from).point, q = curvePoint(way.curve, t).point;
          return std::hypot(p.x - q.x, p.y - q.y) <= 1e-7 * size;
        };
        meets = meets || (isThere(seam.a) && isThere(seam.b));
      }
    if (!meets) continue;
    for (const SewnEdge* edge : {&seam.a, &seam.b})
      for (const SewnPart& part : *edge) addLines(part, out);
  }
  return out;
}

/// Of each function of `a` the one of `b` that has the same knots, or -1.
std::vector<int> sameFunctions(const KnotVector& a, const KnotVector& b) {
  std::vector<int> out(static_cast<std::size_t>(a.count()), -1);
  if (a.degree != b.degree) return out;
  for (int i = 0; i < a.count(); ++i)
    for (int k = 0; k < b.count(); ++k)
      if (std::equal(a.knots.begin() + i, a.knots.begin() + i + a.degree + 2, b.knots.begin() + k))
        out[static_cast<std::size_t>(i)] = k;
  return out;
}

}  // namespace

std::vector<int> sharedOwners(const Garment& g) {
  std::vector<int> first{0};
  for (const NurbsPatch& p : g.patches) first.push_back(first.back() + p.size());
  std::vector<int> owner(static_cast<std::size_t>(first.back()));
  std::iota(owner.begin(), owner.end(), 0);
  const auto find = [&](int i) {
    while (owner[static_cast<std::size_t>(i)] != i) i = owner[static_cast<std::size_t>(i)];
    return i;
  };
  const int patches = static_cast<int>(g.patches.size());
  for (const SewnSeam& cut : g.sewn_seams) {
    if (!isCut(cut)) continue;
    const int left = cut.a[0].patch, right = cut.b[0].patch;
    if (std::min(left, right) < 0 || std::max(left, right) >= patches) continue;  // the rows refuse it
    const NurbsPatch &a = g.patches[static_cast<std::size_t>(left)], &b = g.patches[static_cast<std::size_t>(right)];
    const std::vector<int> us = sameFunctions(a.u, b.u), vs = sameFunctions(a.v, b.v);
    const Lines sides = sidesAt(g, cut);
    Lines way;
    addLines(cut.a[0], way);
    for (int j = 0; j < a.v.count(); ++j)
      for (int i = 0; i < a.u.count(); ++i) {
        const int k = us[static_cast<std::size_t>(i)], l = vs[static_cast<std::size_t>(j)];
        if (k < 0 || l < 0) continue;
        const auto at = [](const KnotVector& knots, int n) { return knots.knots[static_cast<std::size_t>(n)]; };
        const Box box{{at(a.u, i), at(a.v, j)}, {at(a.u, i + a.u.degree + 1), at(a.v, j + a.v.degree + 1)}};
        if (!reach(way, box) || reach(sides, box)) continue;
        const auto of_a = static_cast<std::size_t>(a.index(i, j)), of_b = static_cast<std::size_t>(b.index(k, l));
        const Vec3 &x = a.points[of_a], &y = b.points[of_b];
        if (!(norm(x - y) <= 1e-9 * (1e-3 + norm(x))) || a.weights[of_a] != b.weights[of_b]) continue;
        const int p = find(first[static_cast<std::size_t>(left)] + a.index(i, j)),
                  q = find(first[static_cast<std::size_t>(right)] + b.index(k, l));
        owner[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
      }
  }
  for (int i = 0; i < first.back(); ++i) owner[static_cast<std::size_t>(i)] = find(i);
  return owner;
}

}  // namespace gambeson
