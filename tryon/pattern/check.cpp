#include "tryon/pattern/check.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "tryon/pattern/fit.hpp"

namespace gambeson {
namespace {

constexpr double tolerance_m = 1e-9;

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }
std::string item(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }
std::string number(double x) {
  char s[32];
  std::snprintf(s, sizeof s, "%.3g", x);
  return s;
}

/// Knots along an edge, over [0, 1] in the edge's sense.
std::vector<double> edgeKnots(const Garment& g, const PatchEdge& e) {
  const NurbsPatch& p = g.patches[e.patch];
  const KnotVector& k = e.side == Side::u0 || e.side == Side::u1 ? p.v : p.u;
  std::vector<double> out;
  for (const double x : k.knots) out.push_back((x - k.front()) / (k.back() - k.front()));
  if (e.reversed) {
    std::reverse(out.begin(), out.end());
    for (double& x : out) x = 1 - x;
  }
  return out;
}

/// How many patch corners stand at x.
int cornersAt(const Garment& g, const Vec3& x) {
  int n = 0;
  for (const NurbsPatch& p : g.patches)
    for (const int i : {0, p.u.count() - 1})
      for (const int j : {0, p.v.count() - 1}) n += norm(p.points[p.index(i, j)] - x) <= tolerance_m;
  return n;
}

void checkSeam(const Garment& g, const Seam& s, const std::string& key) {
  for (const auto& [name, e] : {std::pair{".a", s.a}, std::pair{".b", s.b}})
    if (e.patch < 0 || e.patch >= static_cast<int>(g.patches.size()))
      reject(key + name + ".patch", std::to_string(e.patch) + ", there are patches 0 to " +
                                        std::to_string(static_cast<int>(g.patches.size()) - 1));
  if (!(s.stiffness_N >= 0) || !std::isfinite(s.stiffness_N)) reject(key + ".stiffness_N", "must not be negative");
  const auto ka = edgeKnots(g, s.a), kb = edgeKnots(g, s.b);
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
  std::vector<std::pair<int, Side>> used;
  for (std::size_t i = 0; i < g.seams.size(); ++i) {
    const Seam& s = g.seams[i];
    checkSeam(g, s, item("seams", i));
    for (const PatchEdge& e : {s.a, s.b}) {
      if (std::find(used.begin(), used.end(), std::pair{e.patch, e.side}) != used.end())
        reject(item("seams", i), "an edge of patch " + std::to_string(e.patch) + " is already in a seam");
      used.push_back({e.patch, e.side});
    }
  }
}

}  // namespace gambeson
