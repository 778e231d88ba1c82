#include "tryon/pattern/check.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/part_seam.hpp"
#include "core/error.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {

void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

namespace {

constexpr double tolerance_m = 1e-9;

std::string item(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }
std::string number(double x) {
  char s[32];
  std::snprintf(s, sizeof s, "%.3g", x);
  return s;
}

/// How many patch corners stand at x.
int cornersAt(const Garment& g, const Vec3& x) {
  int n = 0;
  for (const NurbsPatch& p : g.patches)
    for (const int i : {0, p.u.count() - 1})
      for (const int j : {0, p.v.count() - 1}) n += norm(p.points[p.index(i, j)] - x) <= tolerance_m;
  return n;
}

/// Edge a on a part of edge b.
void checkPart(const Garment& g, const Seam& s, const std::string& key) {
  EdgePart part;
  try {
    part = partOf(g, static_cast<int>(&s - g.seams.data()));
  } catch (const InputError& e) {
    reject(key, e.reason());
  }
  const NurbsPatch &a = g.patches[s.a.patch], &b = g.patches[s.b.patch];
  const auto ra = edgeRow(a, s.a), rb = edgeRow(b, s.b);
  for (std::size_t k = 0; k < ra.size(); ++k) {
    Vec3 x{};
    for (const auto& [i, w] : part.rows[k]) x += w * b.points[rb[i]];
    const double apart = norm(x - a.points[ra[k]]);
    if (!(apart <= tolerance_m))
      reject(key, "the edge is " + number(apart) + " m from its part of the other at control point " +
                      std::to_string(k) + " along edge a");
  }
}

void checkSeam(const Garment& g, const Seam& s, const std::string& key) {
  for (const auto& [name, e] : {std::pair{".a", s.a}, std::pair{".b", s.b}})
    if (e.patch < 0 || e.patch >= static_cast<int>(g.patches.size()))
      reject(key + name + ".patch", std::to_string(e.patch) + ", there are patches 0 to " +
                                        std::to_string(static_cast<int>(g.patches.size()) - 1));
  if (!(s.stiffness_N >= 0) || !std::isfinite(s.stiffness_N)) reject(key + ".stiffness_N", "must not be negative");
  if (s.onPart()) {
    checkPart(g, s, key);
    return;
  }
  const auto ka = edgeKnots(g.patches[s.a.patch], s.a), kb = edgeKnots(g.patches[s.b.patch], s.b);
  if (ka.size() != kb.size())
    reject(key, "the edges have " + std::to_string(ka.size()) + " and " + std::to_string(kb.size()) +
                    " knots; a seam joins edges of the same degree and knots");
  for (std::size_t i = 0; i < ka.size(); ++i)
    if (!(std::abs(ka[i] - kb[i]) <= 1e-9))
      reject(key, "the edges differ at knot " + std::to_string(i) + " along edge a");
  const NurbsPatch &a = g.patches[s.a.patch], &b = g.patches[s.b.patch];
  const auto ra = edgeRow(a, s.a), rb = edgeRow(b, s.b);
  if (ra.size() != rb.size())
    reject(key,
           "the edges have " + std::to_string(ra.size()) + " and " + std::to_string(rb.size()) + " control points");
  for (std::size_t i = 0; i < ra.size(); ++i) {
    const double apart = norm(a.points[ra[i]] - b.points[rb[i]]);
    if (!(apart <= tolerance_m))
      reject(key,
             "the edges are " + number(apart) + " m apart at control point " + std::to_string(i) + " along edge a");
    if (!(std::abs(a.weights[ra[i]] - b.weights[rb[i]]) <= 1e-9 * a.weights[ra[i]]))
      reject(key, "the edges differ in weight at control point " + std::to_string(i) + " along edge a");
  }
  if (s.kind == SeamKind::G1) {
    const double residual = g1Residual(g, s);
    if (!(residual <= tolerance_m))
      reject(key + ".kind", "G1, but the control points beside the seam are up to " + number(residual) +
                                " m from tangent continuity with a constant ratio; move them or use C0");
  }
}

}  // namespace

void requirePositive(const char* key, double value) {
  if (!(value > 0) || !std::isfinite(value)) reject(key, number(value) + ", must be positive");
}
void requireDegree(int degree, int least) {
  if (degree < least || degree > 9)
    reject("degree", std::to_string(degree) + ", must be " + std::to_string(least) + " to 9");
}
void requireCells(const char* key, int cells, int least) {
  if (cells < least || cells > 10000)
    reject(key, std::to_string(cells) + ", must be " + std::to_string(least) + " to 10000");
}
int cellsFor(double length_m, double cell_m, int least) {
  const double n = std::round(length_m / cell_m);
  if (!(n <= 1000)) reject("cell_m", std::to_string(cell_m) + ", too small: more than 1000 cells along an edge");
  return std::max(least, static_cast<int>(n));
}

// Zheng 2013, eq. 2.31 for control points: b1 - e = c (e - a1) with one c > 0 for the seam, here the least-squares one.
double g1Residual(const Garment& g, const Seam& s) {
  const NurbsPatch &a = g.patches[s.a.patch], &b = g.patches[s.b.patch];
  const auto e = edgeRow(a, s.a), a1 = edgeRow(a, s.a, 1), b1 = edgeRow(b, s.b, 1);
  const auto free = [&](int k) {
    const int n = cornersAt(g, a.points[e[k]]);
    return n == 2 || n == 4;
  };
  const int last = static_cast<int>(e.size()) - 1, from = free(0) ? 0 : 1, to = free(last) ? last : last - 1;
  double over = 0, under = 0;
  for (int k = from; k <= to; ++k) {
    const Vec3 back = a.points[e[k]] - a.points[a1[k]], on = b.points[b1[k]] - a.points[e[k]];
    over += dot(on, back);
    under += dot(back, back);
  }
  const double c = over / under;
  if (!(c > 0)) return HUGE_VAL;
  double worst = 0;
  for (int k = from; k <= to; ++k) {
    const Vec3 back = a.points[e[k]] - a.points[a1[k]], on = b.points[b1[k]] - a.points[e[k]];
    worst = std::max(worst, norm(on - c * back) / (1 + c));
  }
  return worst;
}

void validate(const Garment& g) {
  if (g.patches.empty()) reject("patches", "there are none");
  for (std::size_t i = 0; i < g.patches.size(); ++i) try {
      validate(g.patches[i]);
    } catch (const InputError& e) {
      reject(item("patches", i) + "." + e.where().key, e.reason());
    }
  if (g.weft.size() != g.patches.size())
    reject("weft", std::to_string(g.weft.size()) + " directions for " + std::to_string(g.patches.size()) + " patches");
  for (std::size_t i = 0; i < g.weft.size(); ++i)
    if (!(norm(g.weft[i]) > 0) || !std::isfinite(norm(g.weft[i])))
      reject(item("weft", i), "must be a direction, not zero");
  if (!g.trims.empty() && g.trims.size() != g.patches.size())
    reject("trims", std::to_string(g.trims.size()) + " for " + std::to_string(g.patches.size()) + " patches");
  if (!g.patch_names.empty() && g.patch_names.size() != g.patches.size())
    reject("patch_names",
           std::to_string(g.patch_names.size()) + " for " + std::to_string(g.patches.size()) + " patches");
  if (!g.placed.empty() && g.placed.size() != g.patches.size())
    reject("placed", std::to_string(g.placed.size()) + " for " + std::to_string(g.patches.size()) + " patches");
  for (std::size_t i = 0; i < g.placed.size(); ++i)
    if (!g.placed[i].empty() && g.placed[i].size() != g.patches[i].points.size())
      reject(item("patches", i) + ".placed_m",
             std::to_string(g.placed[i].size()) + " points, must be " + std::to_string(g.patches[i].points.size()));
  for (std::size_t i = 0; i < g.edges.size(); ++i)
    for (const PatchEdge& e : g.edges[i].edges)
      if (e.patch < 0 || e.patch >= static_cast<int>(g.patches.size()))
        reject(item("edges", i), "there is no patch " + std::to_string(e.patch));
  std::vector<std::pair<int, Side>> used;
  for (std::size_t i = 0; i < g.seams.size(); ++i) {
    const Seam& s = g.seams[i];
    checkSeam(g, s, item("seams", i));
    for (const PatchEdge& e : {s.a, s.b}) {
      if (s.onPart() && e.patch == s.b.patch && e.side == s.b.side) continue;
      if (std::find(used.begin(), used.end(), std::pair{e.patch, e.side}) != used.end())
        reject(item("seams", i), "an edge of patch " + std::to_string(e.patch) + " is already in a seam");
      used.push_back({e.patch, e.side});
    }
  }
}

}  // namespace gambeson
