#include "core/cloth/draft/shared_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace gambeson {

bool isCut(const SewnSeam& s) {
  if (s.hold == SeamHold::open || s.a.size() != 1 || s.b.size() != 1) return false;
  const SewnPart &a = s.a[0], &b = s.b[0];
  const auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  return a.patch != b.patch && a.from == b.from && a.to == b.to && a.curve.knots == b.curve.knots &&
         a.curve.weights == b.curve.weights &&
         std::equal(a.curve.points.begin(), a.curve.points.end(), b.curve.points.begin(), b.curve.points.end(), same);
}

namespace {

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

/// A seam whose sides meet at an end of a cut: a slit in a sheet, as far as its patches are of the sheet.
struct Slit {
  std::vector<std::array<int, 2>> patches;  ///< that it parts: of a part of either side
  Lines sides;
};

bool isSlit(const Garment& g, const SewnSeam& seam) {
  if (isCut(seam) || seam.hold == SeamHold::open || seam.a.empty() || seam.b.empty()) return false;
  const auto meetsAt = [&](const SewnSeam& cut, double t) {
    const NurbsCurve& way = cut.a[0].curve;
    const double size =
        std::hypot(way.points.back().x - way.points.front().x, way.points.back().y - way.points.front().y);
    const Vec2 q = curvePoint(way, t).point;
    const auto isThere = [&](const SewnEdge& edge, bool end) {
      const SewnPart& part = end ? edge.back() : edge.front();
      if (part.patch != cut.a[0].patch && part.patch != cut.b[0].patch) return false;
      const Vec2 p = curvePoint(part.curve, end ? part.to : part.from).point;
      return std::hypot(p.x - q.x, p.y - q.y) <= 1e-7 * size;
    };
    return (isThere(seam.a, false) && isThere(seam.b, false)) || (isThere(seam.a, true) && isThere(seam.b, true));
  };
  return std::any_of(g.sewn_seams.begin(), g.sewn_seams.end(), [&](const SewnSeam& cut) {
    return isCut(cut) && (meetsAt(cut, cut.a[0].from) || meetsAt(cut, cut.a[0].to));
  });
}

std::vector<Slit> slitsOf(const Garment& g) {
  std::vector<Slit> out;
  for (const SewnSeam& seam : g.sewn_seams) {
    if (!isSlit(g, seam)) continue;
    Slit slit;
    for (const SewnPart& a : seam.a)
      for (const SewnPart& b : seam.b)
        if (a.patch != b.patch) slit.patches.push_back({a.patch, b.patch});
    for (const SewnEdge* edge : {&seam.a, &seam.b})
      for (const SewnPart& part : *edge) addLines(part, slit.sides);
    out.push_back(std::move(slit));
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

/// A function that two patches share across a cut between them, by its number among all control points.
struct Link {
  std::array<int, 2> point, patch;
  Box box;  ///< within which it is not zero
};

/// Those that reach a cut, and no slit between its two patches.
std::vector<Link> linksOf(const Garment& g, const std::vector<int>& first, const std::vector<Slit>& slits) {
  std::vector<Link> out;
  const int patches = static_cast<int>(g.patches.size());
  for (const SewnSeam& cut : g.sewn_seams) {
    if (!isCut(cut)) continue;
    const int left = cut.a[0].patch, right = cut.b[0].patch;
    if (std::min(left, right) < 0 || std::max(left, right) >= patches) continue;  // the rows refuse it
    const NurbsPatch &a = g.patches[static_cast<std::size_t>(left)], &b = g.patches[static_cast<std::size_t>(right)];
    const std::vector<int> us = sameFunctions(a.u, b.u), vs = sameFunctions(a.v, b.v);
    Lines way, sides;
    addLines(cut.a[0], way);
    for (const Slit& slit : slits)
      for (const auto& [p, q] : slit.patches)
        if (std::minmax(p, q) == std::minmax(left, right)) {
          sides.insert(sides.end(), slit.sides.begin(), slit.sides.end());
          break;
        }
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
        out.push_back({{first[static_cast<std::size_t>(left)] + a.index(i, j),
                        first[static_cast<std::size_t>(right)] + b.index(k, l)},
                       {left, right},
                       box});
      }
  }
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
  const auto join = [&](const Link& link) {
    const int p = find(link.point[0]), q = find(link.point[1]);
    owner[static_cast<std::size_t>(std::max(p, q))] = std::min(p, q);
  };
  const std::vector<Slit> slits = slitsOf(g);
  const std::vector<Link> links = linksOf(g, first, slits);
  for (const Link& link : links) join(link);
  // The patches of each shared function.
  std::map<int, std::pair<Box, std::set<int>>> sheets;
  for (const Link& link : links) {
    auto& sheet = sheets[find(link.point[0])];
    sheet.first = link.box;
    sheet.second.insert(link.patch.begin(), link.patch.end());
  }
  std::set<int> slit;
  for (const auto& [root, sheet] : sheets)
    for (const Slit& s : slits)
      if (std::any_of(s.patches.begin(), s.patches.end(),
                      [&](const auto& p) { return sheet.second.contains(p[0]) && sheet.second.contains(p[1]); }) &&
          reach(s.sides, sheet.first))
        slit.insert(root);
  std::vector<char> kept;
  for (const Link& link : links) kept.push_back(!slit.contains(find(link.point[0])));
  std::iota(owner.begin(), owner.end(), 0);
  for (std::size_t k = 0; k < links.size(); ++k)
    if (kept[k]) join(links[k]);
  for (int i = 0; i < first.back(); ++i) owner[static_cast<std::size_t>(i)] = find(i);
  return owner;
}

}  // namespace gambeson
