#include "core/cloth/draft/sewing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/sewn_length.hpp"
#include "core/cloth/draft/shared_points.hpp"
#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

constexpr double kMostGather = 2;
/// Of a row over that of its two sides apart, both squared, below which they move with the same control points: less
/// than about three quarters of a cell from each other, at the tip of a dart. To hold such points together would fold
/// the cloth beside them.
constexpr double kLeastApart = 0.5;
/// The same of two patches that share all control points there: nothing but rounding is left of the row.
constexpr double kShared = 1e-20;
constexpr int kPieces = 2;  ///< of a hat's flank, for the quadrature
constexpr int kPoints = 4;  ///< of the quadrature in each

std::string keyOf(std::size_t seam) { return "sewn_seams[" + std::to_string(seam) + "]"; }

std::string nameOf(const SewnSeam& seam) { return seam.name.empty() ? "" : " (seam \"" + seam.name + "\")"; }

/// Both edges of a seam, measured, and the hats over them.
struct Measured {
  SewnLength a, b;
  int flanks = 0;  ///< hats stand at the fractions k / flanks

  Measured(const Garment& g, std::size_t index)
      : a(g, g.sewn_seams[index].a, keyOf(index)), b(g, g.sewn_seams[index].b, keyOf(index)) {
    const SewnSeam& seam = g.sewn_seams[index];
    const auto reject = [&](const std::string& reason) {
      throw InputError({"", 0, keyOf(index)}, reason + nameOf(seam));
    };
    const auto positive = [](double x) { return x > 0 && std::isfinite(x); };
    checkSpring(g, index);
    if (!positive(seam.factor)) reject("factor must be > 0");
    if (!(seam.rows_per_cell >= 0.25 && seam.rows_per_cell <= 4)) reject("rows per cell must lie in [0.25, 4]");
    const double ratio = std::max(a.length_m(), b.length_m()) / std::min(a.length_m(), b.length_m());
    if (!(ratio <= kMostGather * (1 + 1e-9)))
      reject("its edges are " + std::to_string(a.length_m()) + " m and " + std::to_string(b.length_m()) +
             " m long; allowed: up to 2:1");
    flanks = std::max(1, static_cast<int>(std::lround(seam.rows_per_cell * std::max(a.cells(), b.cells()))));
  }
};

/// Calls visit(fraction, weight, flank, part of the flank) at the points of the quadrature; weights sum to 1.
template <class Visit>
void alongSeam(int flanks, Visit&& visit) {
  static const Quadrature rule = gaussLegendre(kPoints);
  for (int k = 0; k < flanks; ++k)
    for (int piece = 0; piece < kPieces; ++piece)
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const double at = (piece + rule.points[g]) / kPieces;
        visit((k + at) / flanks, rule.weights[g] / (kPieces * flanks), k, at);
      }
}

using Row = std::map<int, double>;

/// The list of all control points; of those that patches share it knows one.
struct Columns {
  std::vector<int> offsets, owners;
  explicit Columns(const Garment& g) : offsets(controlOffsets(g)), owners(sharedOwners(g)) {}
  int of(int patch, int control) const {
    return owners[static_cast<std::size_t>(offsets[static_cast<std::size_t>(patch)] + control)];
  }
};

void addBasis(const Garment& g, const Columns& columns, const SewnPoint& at, double factor, Row& row) {
  const SurfaceBasis basis = surfaceBasis(g.patches[static_cast<std::size_t>(at.patch)], at.uv.x, at.uv.y);
  for (std::size_t k = 0; k < basis.columns.size(); ++k)
    if (basis.values[0][k] != 0) row[columns.of(at.patch, basis.columns[k])] += factor * basis.values[0][k];
}

void addRow(const Row& row, double factor, SparseRows& rows) {
  for (const auto& [column, value] : row)
    if (value != 0) rows.add(column, factor * value);
  rows.endRow();
}

/// The direction into the panel at a point of its border, in (u, v) and of unit length at rest: across the edge, to
/// its left (+1) or right (-1) seen along the edge in the parameters' sense of turning.
Vec2 across(const Garment& g, const SewnPoint& at, double side) {
  const std::array<Vec3, 6> d = surfaceDerivatives(g.patches[static_cast<std::size_t>(at.patch)], at.uv.x, at.uv.y);
  const Vec3 n = normalized(cross(d[1], d[2])), wanted = side * cross(n, at.tangent);
  // d[1] x + d[2] y = wanted, in the plane of both.
  const double uu = norm2(d[1]), vv = norm2(d[2]), uv = dot(d[1], d[2]), det = uu * vv - uv * uv;
  const double wu = dot(wanted, d[1]), wv = dot(wanted, d[2]);
  return {(vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det};
}

/// On which side of the edge the panel lies, +1 or -1, by looking a little to both.
double sideOf(const Garment& g, const SewnLength& edge, double fraction, std::size_t index) {
  const SewnPoint at = edge.at(fraction);
  const NurbsPatch& patch = g.patches[static_cast<std::size_t>(at.patch)];
  const double little_m = 1e-4 * std::min(edge.length_m(), 1 / at.cells_per_m);
  const auto isThere = [&](double side) {
    const Vec2 d = across(g, at, side);
    const Vec2 uv{at.uv.x + little_m * d.x, at.uv.y + little_m * d.y};
    if (!(uv.x >= patch.u.front() && uv.x <= patch.u.back() && uv.y >= patch.v.front() && uv.y <= patch.v.back()))
      return false;
    return !isTrimmed(g, at.patch) || isKept(patch, g.trims[static_cast<std::size_t>(at.patch)], uv);
  };
  const bool left = isThere(1), right = isThere(-1);
  if (left == right)
    throw InputError({"", 0, keyOf(index)}, "an edge does not run along the border of what is kept of patch " +
                                                std::to_string(at.patch) + ": near (" + std::to_string(at.uv.x) + ", " +
                                                std::to_string(at.uv.y) + ") there is " + (left ? "cloth" : "none") +
                                                " on both sides of it" + nameOf(g.sewn_seams[index]));
  return left ? 1 : -1;
}

/// The sides on which the panels of an edge lie, by part of the edge; looked at in the middle of each flank.
class Sides {
 public:
  Sides(const Garment& g, const SewnLength& edge, std::size_t index, int flanks) : corners_(edge.corners()) {
    for (std::size_t part = 0; part + 1 < corners_.size(); ++part) {
      const double from = corners_[part], range = corners_[part + 1] - from;
      const int looks = std::max(1, static_cast<int>(std::lround(range * flanks)));
      for (int k = 0; k < looks; ++k) {
        const double side = sideOf(g, edge, from + (k + 0.5) / looks * range, index);
        if (k == 0) side_.push_back(side);
        if (side != side_.back())
          throw InputError({"", 0, keyOf(index)},
                           "the panel lies now on one side of an edge, now on the other" + nameOf(g.sewn_seams[index]));
      }
    }
  }
  double at(double fraction) const {
    std::size_t part = 0;
    while (part + 1 < side_.size() && corners_[part + 1] <= fraction) ++part;
    return side_[part];
  }

 private:
  std::vector<double> corners_, side_;
};

void addSeam(const Garment& g, std::size_t index, const Columns& columns, SewnRows& out) {
  const Measured m(g, index);
  Sides(g, m.a, index, m.flanks), Sides(g, m.b, index, m.flanks);  // or a message
  const double length = 0.5 * (m.a.length_m() + m.b.length_m());
  std::vector<Row> rows(static_cast<std::size_t>(m.flanks + 1)), of_a(rows.size()), of_b(rows.size());
  std::vector<double> weight(rows.size(), 0.0);
  std::vector<char> one_patch(rows.size(), 0);  // on both sides, somewhere under the hat
  alongSeam(m.flanks, [&](double s, double w, int flank, double at) {
    const SewnPoint a = m.a.at(s), b = m.b.at(s);
    Row pair;
    addBasis(g, columns, a, 1, pair);
    addBasis(g, columns, b, -1, pair);
    for (const int end : {0, 1}) {
      addBasis(g, columns, a, w * (end == 0 ? 1 - at : at), of_a[static_cast<std::size_t>(flank + end)]);
      addBasis(g, columns, b, w * (end == 0 ? 1 - at : at), of_b[static_cast<std::size_t>(flank + end)]);
      if (a.patch == b.patch) one_patch[static_cast<std::size_t>(flank + end)] = 1;
    }
    addRow(pair, 1, out.pairs);
    out.cell_m.push_back(1 / std::max(a.cells_per_m, b.cells_per_m));
    for (const int end : {0, 1}) {
      const double phi = end == 0 ? 1 - at : at;
      weight[static_cast<std::size_t>(flank + end)] += w * phi;
      for (const auto& [column, value] : pair) rows[static_cast<std::size_t>(flank + end)][column] += w * phi * value;
    }
  });
  const auto square = [](const Row& row) {
    double sum = 0;
    for (const auto& [column, value] : row) sum += value * value;
    return sum;
  };
  const int before = out.rows();
  bool blunt = false;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double least = one_patch[k] ? kLeastApart : kShared;
    if (square(rows[k]) < least * (square(of_a[k]) + square(of_b[k]))) {
      blunt = blunt || one_patch[k];
      continue;
    }
    addRow(rows[k], 1 / weight[k], out.C);
    out.length_m.push_back(weight[k] * length);
    out.hat_m.push_back(length / m.flanks);
    out.seam.push_back(static_cast<int>(index));
  }
  if (out.rows() == before && blunt)
    throw InputError({"", 0, keyOf(index)},
                     "its edges are everywhere closer to each other than a cell of the panel; allowed: a finer panel" +
                         nameOf(g.sewn_seams[index]));
}

void addHinges(const Garment& g, std::size_t index, const Columns& columns, std::vector<HingePoint>& out) {
  const SewnSeam& seam = g.sewn_seams[index];
  const Measured m(g, index);
  const Sides side_a(g, m.a, index, m.flanks), side_b(g, m.b, index, m.flanks);
  const double length = 0.5 * (m.a.length_m() + m.b.length_m());
  const Quadrature rule = gaussLegendre(3);
  for (int flank = 0; flank < m.flanks; ++flank)
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double s = (flank + rule.points[q]) / m.flanks;
      std::map<int, std::array<double, 3>> row;  // along, into a, into b
      for (const int which : {0, 1}) {
        const SewnLength& edge = which == 0 ? m.a : m.b;
        const SewnPoint at = edge.at(s);
        const Vec2 into = across(g, at, (which == 0 ? side_a : side_b).at(s));
        // The tangent is the mean of both by fraction, in lengths of the seam.
        const double part = 0.5 * edge.length_m() / length;
        const SurfaceBasis basis = surfaceBasis(g.patches[static_cast<std::size_t>(at.patch)], at.uv.x, at.uv.y);
        for (std::size_t k = 0; k < basis.columns.size(); ++k) {
          std::array<double, 3>& r = row[columns.of(at.patch, basis.columns[k])];
          const double du = basis.values[1][k], dv = basis.values[2][k];
          r[0] += part * (at.along.x * du + at.along.y * dv);
          r[1 + static_cast<std::size_t>(which)] += into.x * du + into.y * dv;
        }
      }
      HingePoint hinge;
      for (const auto& [column, r] : row) {
        if (r[0] == 0 && r[1] == 0 && r[2] == 0) continue;
        hinge.columns.push_back(column);
        hinge.t.push_back(r[0]), hinge.a.push_back(r[1]), hinge.b.push_back(r[2]);
      }
      hinge.stiffness_length = seam.stiffness_N * length * rule.weights[q] / m.flanks;
      hinge.theta0 = seam.rest_angle_rad;
      out.push_back(std::move(hinge));
    }
}

}  // namespace

SewnPart sidePart(const Garment& garment, const PatchEdge& edge, double from, double to) {
  if (edge.patch < 0 || edge.patch >= static_cast<int>(garment.patches.size()))
    throw InputError({"", 0, edgeName(edge)}, "patch " + std::to_string(edge.patch) + " does not exist");
  const NurbsPatch& patch = garment.patches[static_cast<std::size_t>(edge.patch)];
  const bool along_v = edge.side == Side::u0 || edge.side == Side::u1;
  const KnotVector &along = along_v ? patch.v : patch.u, &other = along_v ? patch.u : patch.v;
  const double c = edge.side == Side::u1 || edge.side == Side::v1 ? other.back() : other.front();
  const auto at = [&](double fraction) {
    const double t = along.front() + (edge.reversed ? 1 - fraction : fraction) * (along.back() - along.front());
    return along_v ? Vec2{c, t} : Vec2{t, c};
  };
  return {edge.patch, line(at(from), at(to)), 0, 1};
}

SewnPart loopPart(const Garment& garment, int patch, int loop, int curve, bool backwards) {
  const NurbsCurve& c = garment.trims.at(static_cast<std::size_t>(patch))
                            .loops.at(static_cast<std::size_t>(loop))
                            .at(static_cast<std::size_t>(curve));
  const double front = c.knots.front(), back = c.knots.back();
  return {patch, c, backwards ? back : front, backwards ? front : back};
}

double lengthOf(const Garment& garment, const SewnEdge& edge) {
  return SewnLength(garment, edge, "sewn_seams").length_m();
}

void checkSpring(const Garment& garment, std::size_t index) {
  const SewnSeam& seam = garment.sewn_seams[index];
  const auto reject = [&](const std::string& reason) {
    throw InputError({"", 0, keyOf(index)}, reason + nameOf(seam));
  };
  if (!(seam.stiffness_N >= 0 && std::isfinite(seam.stiffness_N))) reject("stiffness must be >= 0 N m/(m rad)");
  if (!(std::abs(seam.rest_angle_rad) <= 3.14159265358979324)) reject("rest angle must lie within +-pi rad");
}

SewnRows buildSewnRows(const Garment& garment, SeamHold hold) {
  const Columns columns(garment);
  SewnRows out;
  out.C.column_count = out.pairs.column_count = columns.offsets.back();
  for (std::size_t i = 0; i < garment.sewn_seams.size(); ++i)
    if (garment.sewn_seams[i].hold == hold) addSeam(garment, i, columns, out);
  return out;
}

std::vector<HingePoint> buildSewnHinges(const Garment& garment) {
  const Columns columns(garment);
  std::vector<HingePoint> out;
  for (std::size_t i = 0; i < garment.sewn_seams.size(); ++i)
    if (garment.sewn_seams[i].hold != SeamHold::open && garment.sewn_seams[i].stiffness_N != 0)
      addHinges(garment, i, columns, out);
  return out;
}

}  // namespace gambeson
