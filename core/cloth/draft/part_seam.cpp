#include "core/cloth/draft/part_seam.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(int seam, const std::string& reason) {
  throw InputError({"", 0, "seams[" + std::to_string(seam) + "]"}, reason);
}

int degreeAlong(const NurbsPatch& p, Side side) {
  return side == Side::u0 || side == Side::u1 ? p.v.degree : p.u.degree;
}

bool equalWeights(const Garment& g, const PatchEdge& e) {
  const NurbsPatch& p = g.patches[e.patch];
  const int offset = controlOffsets(g)[e.patch];
  const std::vector<int> at = edgeColumns(g, e).edge;
  return std::all_of(at.begin(), at.end(), [&](int c) { return p.weights[c - offset] == p.weights[at[0] - offset]; });
}

/// The blossom of the spline's piece on `span` at `at` (as many values as the degree): coefficients of the control
/// points span - p .. span (de Boor's recursion with its own value in each round).
std::vector<std::pair<int, double>> blossom(const KnotVector& k, int span, const std::vector<double>& at) {
  const int p = k.degree;
  std::vector<std::vector<double>> d(p + 1, std::vector<double>(p + 1, 0));
  for (int j = 0; j <= p; ++j) d[j][j] = 1;
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const int i = span - p + j;
      const double a = (at[r - 1] - k.knots[i]) / (k.knots[i + p - r + 1] - k.knots[i]);
      for (int c = 0; c <= p; ++c) d[j][c] = (1 - a) * d[j - 1][c] + a * d[j][c];
    }
  std::vector<std::pair<int, double>> out;
  for (int c = 0; c <= p; ++c)
    if (std::abs(d[p][c]) > 1e-14) out.push_back({span - p + c, d[p][c]});
  return out;
}

}  // namespace

std::vector<double> edgeKnots(const NurbsPatch& patch, const PatchEdge& e) {
  const KnotVector& k = e.side == Side::u0 || e.side == Side::u1 ? patch.v : patch.u;
  std::vector<double> knots;
  for (double value : k.knots) knots.push_back((value - k.front()) / (k.back() - k.front()));
  if (e.reversed) {
    std::reverse(knots.begin(), knots.end());
    for (double& value : knots) value = 1 - value;
  }
  return knots;
}

EdgePart partOf(const Garment& g, int s) {
  const Seam& seam = g.seams[s];
  const NurbsPatch &pa = g.patches[seam.a.patch], &pb = g.patches[seam.b.patch];
  if (seam.kind != SeamKind::C0) reject(s, "a seam on a part of an edge must be C0");
  if (degreeAlong(pa, seam.a.side) != degreeAlong(pb, seam.b.side)) reject(s, "degrees along the edge differ");
  const int p = degreeAlong(pa, seam.a.side);
  if (!equalWeights(g, seam.a) || !equalWeights(g, seam.b))
    reject(s, "a seam on a part of an edge needs equal weights along both edges");
  KnotVector ka{p, edgeKnots(pa, seam.a)};
  const KnotVector kb{p, edgeKnots(pb, seam.b)};
  const std::vector<double> ends = breakpoints(kb);
  const int cells = static_cast<int>(breakpoints(ka).size()) - 1, of = static_cast<int>(ends.size()) - 1;
  if (seam.first_cell + cells > of)
    reject(s, "edge a has " + std::to_string(cells) + " cells, edge b only " + std::to_string(of - seam.first_cell) +
                  " from cell " + std::to_string(seam.first_cell) + " on");
  EdgePart part;
  part.from = ends[seam.first_cell], part.to = ends[seam.first_cell + cells];
  for (double& k : ka.knots) k = part.from + k * (part.to - part.from);

  const double near = 1e-9 * (part.to - part.from);
  std::vector<double> inside_a, inside_b;
  const auto inside = [&](double k) { return k > part.from + near && k < part.to - near; };
  std::copy_if(ka.knots.begin(), ka.knots.end(), std::back_inserter(inside_a), inside);
  std::copy_if(kb.knots.begin(), kb.knots.end(), std::back_inserter(inside_b), inside);
  if (!std::equal(inside_a.begin(), inside_a.end(), inside_b.begin(), inside_b.end(),
                  [&](double x, double y) { return std::abs(x - y) <= near; }))
    reject(s, "edge a has other knots than this part of edge b");

  const int count = ka.count();
  for (int k = 0; k < count; ++k) {
    // Any piece on which control point k acts will do: b is one polynomial there, and so is a.
    double lo = 0, hi = 0;
    for (int j = k; j <= k + p; ++j)
      if (ka.knots[j + 1] - ka.knots[j] > hi - lo) lo = ka.knots[j], hi = ka.knots[j + 1];
    const std::vector<double> at(ka.knots.begin() + k + 1, ka.knots.begin() + k + 1 + p);
    part.rows.push_back(blossom(kb, findSpan(kb, 0.5 * (lo + hi)), at));
  }
  return part;
}

}  // namespace gambeson
