#include "core/cloth/shell/weak_seam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "core/cloth/draft/edge.hpp"
#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/sewing.hpp"
#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(std::size_t seam, const std::string& reason) {
  throw InputError({"", 0, "weak_seams[" + std::to_string(seam) + "]"}, reason);
}

using Scale = StiffnessScale;

Vec3 pointOn(const Garment& g, const PatchEdge& edge, double t, const std::vector<Vec3>& Q) {
  const EdgeBasis b = edgeBasis(g, edge, t);
  return combine(b.columns, b.value, Q);
}

/// An edge at rest as a curve, with points to start searches from.
struct RestEdge {
  const Garment& g;
  PatchEdge edge;
  const std::vector<Vec3>& Q;
  std::vector<double> cells;  ///< breakpoints
  std::vector<double> t;
  std::vector<Vec3> at;
  std::vector<std::pair<double, double>> kept;
  double length = 0;  ///< of the kept parts

  RestEdge(const Garment& garment, const PatchEdge& e, const std::vector<Vec3>& rest) : g(garment), edge(e), Q(rest) {
    cells = breakpoints(alongKnots(g.patches[e.patch], e.side));
    constexpr int kPerCell = 8;
    for (std::size_t c = 0; c + 1 < cells.size(); ++c)
      for (int k = 0; k < kPerCell; ++k) t.push_back(cells[c] + k * (cells[c + 1] - cells[c]) / kPerCell);
    t.push_back(cells.back());
    for (double s : t) at.push_back(pointOn(g, e, s, Q));
    kept = keptRanges(g, e);
    for (const EdgePoint& p : edgePoints(g, e)) length += p.length_m;
  }

  bool isKeptAt(double s) const {
    return std::any_of(kept.begin(), kept.end(), [&](const auto& r) { return r.first <= s && s <= r.second; });
  }

  /// The parameter of the closest point: Gauss-Newton from the closest start, which converges quadratically where the
  /// point lies on the curve. `distance` is what is left.
  double closest(const Vec3& x, double& distance) const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < at.size(); ++i)
      if (norm2(at[i] - x) < norm2(at[best] - x)) best = i;
    double s = t[best];
    for (int iteration = 0; iteration < 30; ++iteration) {
      const EdgeBasis b = edgeBasis(g, edge, s);
      const Vec3 tangent = (edge.reversed ? -1.0 : 1.0) * combine(b.columns, b.along, Q);
      const double next = std::clamp(s - dot(combine(b.columns, b.value, Q) - x, tangent) / norm2(tangent),
                                     cells.front(), cells.back());
      const double step = std::abs(next - s);
      s = next;
      if (step <= 1e-15 * (cells.back() - cells.front())) break;
    }
    distance = norm(pointOn(g, edge, s, Q) - x);
    return s;
  }

  /// Rest length of the cell about a parameter, to the accuracy of its tangent there.
  double cellLength(double s) const {
    const std::size_t i =
        std::min<std::size_t>(std::upper_bound(cells.begin(), cells.end(), s) - cells.begin(), cells.size() - 1);
    const EdgeBasis b = edgeBasis(g, edge, s);
    return norm(combine(b.columns, b.along, Q)) * (cells[i] - cells[i - 1]);
  }

  Scale stiffness(double s) const { return stiffnessScale(fabricAt(g, edge.patch, edgeParameters(g, edge, s))); }
};

/// The parameters of edge a at which pieces of the seam begin and end: its own knots and those of b, and the ends of
/// what trimming leaves of either.
std::vector<double> marksOn(const RestEdge& a, const RestEdge& b, double tolerance) {
  std::vector<double> marks = a.cells, other = b.cells;
  for (const auto& [from, to] : a.kept) marks.insert(marks.end(), {from, to});
  for (const auto& [from, to] : b.kept) other.insert(other.end(), {from, to});
  for (double s : other) {
    double distance = 0;
    const double t = a.closest(pointOn(b.g, b.edge, s, b.Q), distance);
    if (distance <= tolerance) marks.push_back(t);
  }
  std::sort(marks.begin(), marks.end());
  return marks;
}

/// Adds one point with the weight `length` [m].
void addPoint(const WeakSeam& seam, const RestEdge& a, const RestEdge& b, double ta, double tb, double length,
              WeakPoints& out) {
  const EdgeBasis ba = edgeBasis(a.g, a.edge, ta), bb = edgeBasis(b.g, b.edge, tb);
  const double h = 0.5 * (a.cellLength(ta) + b.cellLength(tb));
  const Scale sa = a.stiffness(ta), sb = b.stiffness(tb);

  std::map<int, std::array<double, 4>> rows;  // gap, along, into a, into b
  for (std::size_t k = 0; k < ba.columns.size(); ++k) {
    auto& r = rows[ba.columns[k]];
    r[0] += ba.value[k], r[1] += ba.along[k], r[2] += ba.inward[k];
  }
  for (std::size_t k = 0; k < bb.columns.size(); ++k) {
    auto& r = rows[bb.columns[k]];
    r[0] -= bb.value[k], r[3] += bb.inward[k];
  }
  GapPoint gap;
  gap.stiffness_N_per_m = seam.factor * std::max(sa.membrane, sb.membrane) / h * length;
  HingePoint hinge;
  hinge.stiffness_length =
      (seam.kind == SeamKind::G1 ? seam.factor * std::max(sa.bending, sb.bending) / h : seam.stiffness_N) * length;
  for (const auto& [column, r] : rows) {
    if (r[0] != 0) {
      gap.columns.push_back(column);
      gap.row.push_back(r[0]);
    }
    if (r[1] == 0 && r[2] == 0 && r[3] == 0) continue;
    hinge.columns.push_back(column);
    hinge.t.push_back(r[1]);
    hinge.a.push_back(r[2]);
    hinge.b.push_back(r[3]);
  }
  out.gaps.push_back(std::move(gap));
  if (hinge.stiffness_length == 0) return;
  hinge.theta0 = hingeAngle(hinge, a.Q, nullptr);
  out.hinges.push_back(std::move(hinge));
}

void addSeam(const Garment& g, std::size_t index, const std::vector<Vec3>& Q, WeakPoints& out) {
  const WeakSeam& seam = g.weak_seams[index];
  const std::string key = "weak_seams[" + std::to_string(index) + "]";
  checkEdge(g, seam.a, key);
  checkEdge(g, seam.b, key);
  if (seam.a.patch == seam.b.patch && seam.a.side == seam.b.side) reject(index, "joins an edge to itself");
  if (!(seam.factor > 0 && std::isfinite(seam.factor))) reject(index, "factor must be > 0");
  if (!(seam.stiffness_N >= 0 && std::isfinite(seam.stiffness_N))) reject(index, "stiffness must be >= 0");

  const RestEdge a(g, seam.a, Q), b(g, seam.b, Q);
  const double shorter = std::min(a.length, b.length), tolerance = 1e-7 * shorter;
  const int degree = std::max(alongKnots(g.patches[seam.a.patch], seam.a.side).degree,
                              alongKnots(g.patches[seam.b.patch], seam.b.side).degree);
  const Quadrature rule = gaussLegendre(degree + 1);
  const std::vector<double> marks = marksOn(a, b, tolerance);
  double joined = 0;
  for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
    const double range = marks[i + 1] - marks[i], middle = 0.5 * (marks[i] + marks[i + 1]);
    if (!(range > 1e-10 * (marks.back() - marks.front())) || !a.isKeptAt(middle)) continue;
    double distance = 0;
    const double opposite = b.closest(pointOn(g, seam.a, middle, Q), distance);
    if (distance > tolerance || !b.isKeptAt(opposite)) continue;  // b ends before this piece
    for (std::size_t k = 0; k < rule.points.size(); ++k) {
      const double ta = marks[i] + rule.points[k] * range;
      const double tb = b.closest(pointOn(g, seam.a, ta, Q), distance);
      if (distance > tolerance)
        reject(index, "the edges do not lie on one curve at rest: they are " + std::to_string(1e3 * distance) +
                          " mm apart near the parameter " + std::to_string(ta) + " of the first");
      const EdgeBasis basis = edgeBasis(g, seam.a, ta);
      const double length = norm(combine(basis.columns, basis.along, Q)) * range * rule.weights[k];
      addPoint(seam, a, b, ta, tb, length, out);
      joined += length;
    }
  }
  if (!(joined >= (1 - 1e-3) * shorter))
    reject(index, "the edges meet at rest over " + std::to_string(joined) + " m; the shorter one has " +
                      std::to_string(shorter) + " m");
}

}  // namespace

StiffnessScale stiffnessScale(const Fabric& f) {
  StiffnessScale s;
  const Laminate* laminate = f.laminate();
  if (!laminate) {
    const double modulus =
        std::max(f.young_weft_Pa, f.young_warp_Pa) / (1 - f.poisson * f.poisson * f.young_warp_Pa / f.young_weft_Pa);
    s.membrane = modulus * f.thickness_m;
    s.bending = std::visit(
        [&]<class L>(const L& law) {
          if constexpr (L::is_solid)
            return s.membrane * f.thickness_m * f.thickness_m / 12;
          else
            return steepestSlope(law, law.most_Nm());
        },
        f.law);
    return s;
  }
  double bottom = -laminate->thickness_m() / 2;
  for (const Ply& ply : laminate->plies) {
    const double top = bottom + ply.thickness_m;
    const double modulus =
        std::max(ply.young1_Pa, ply.young2_Pa) / (1 - ply.poisson12 * ply.poisson12 * ply.young2_Pa / ply.young1_Pa);
    s.membrane += modulus * ply.thickness_m;
    s.bending += modulus * (top * top * top - bottom * bottom * bottom) / 3;
    bottom = top;
  }
  return s;
}

std::vector<GapPoint> weakSewnRows(const Garment& garment) {
  std::vector<GapPoint> out;
  const SewnRows rows = buildSewnRows(garment, SeamHold::weak);
  for (int r = 0; r < rows.rows(); ++r) {
    const SewnSeam& seam = garment.sewn_seams[static_cast<std::size_t>(rows.seam[r])];
    GapPoint gap;
    double membrane = 0;
    for (const SewnEdge* edge : {&seam.a, &seam.b})
      for (const SewnPart& part : *edge)
        membrane = std::max(
            membrane,
            stiffnessScale(fabricAt(garment, part.patch, curvePoint(part.curve, 0.5 * (part.from + part.to)).point))
                .membrane);
    gap.stiffness_N_per_m = seam.factor * membrane * rows.length_m[r] / rows.hat_m[r];
    for (int k = rows.C.offsets[r]; k < rows.C.offsets[r + 1]; ++k) {
      gap.columns.push_back(rows.C.columns[k]);
      gap.row.push_back(rows.C.values[k]);
    }
    out.push_back(std::move(gap));
  }
  return out;
}

WeakPoints buildWeakSeams(const Garment& garment) {
  const std::vector<Vec3> Q = restControls(garment);
  WeakPoints points;
  for (std::size_t i = 0; i < garment.weak_seams.size(); ++i) addSeam(garment, i, Q, points);
  return points;
}

Vec3 gapOf(const GapPoint& gap, std::span<const Vec3> q) { return combine(gap.columns, gap.row, q); }

double addWeakForce(const WeakPoints& points, std::span<const Vec3> q, std::span<Vec3> f) {
  double energy = 0;
  for (const GapPoint& p : points.gaps) {
    const Vec3 gap = gapOf(p, q);
    energy += 0.5 * p.stiffness_N_per_m * norm2(gap);
    for (std::size_t k = 0; k < p.columns.size(); ++k) f[p.columns[k]] -= p.stiffness_N_per_m * p.row[k] * gap;
  }
  std::vector<Vec3> gradient;
  for (const HingePoint& h : points.hinges) {
    const double turn = hingeAngle(h, q, &gradient) - h.theta0;
    energy += 0.5 * h.stiffness_length * turn * turn;
    for (std::size_t k = 0; k < h.columns.size(); ++k) f[h.columns[k]] -= h.stiffness_length * turn * gradient[k];
  }
  return energy;
}

void gapStiffness(const GapPoint& p, std::vector<std::array<double, 9>>& blocks) {
  const std::size_t n = p.columns.size();
  blocks.assign(n * n, {});
  for (std::size_t I = 0; I < n; ++I)
    for (std::size_t J = 0; J < n; ++J)
      for (int d = 0; d < 3; ++d) blocks[I * n + J][4 * d] = p.stiffness_N_per_m * p.row[I] * p.row[J];
}

}  // namespace gambeson
