#include "core/cloth/draft/seams.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "core/cloth/draft/part_seam.hpp"
#include "core/cloth/draft/shared_points.hpp"
#include "core/cloth/draft/trim_map.hpp"
#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

[[noreturn]] void reject(int seam, const std::string& reason) {
  throw InputError({"", 0, "seams[" + std::to_string(seam) + "]"}, reason);
}

const KnotVector& knotsAlong(const NurbsPatch& patch, Side side) {
  return side == Side::u0 || side == Side::u1 ? patch.v : patch.u;
}
const KnotVector& knotsAcross(const NurbsPatch& patch, Side side) {
  return side == Side::u0 || side == Side::u1 ? patch.u : patch.v;
}

bool isClamped(const KnotVector& k) { return k.knots.front() == k.front() && k.knots.back() == k.back(); }

struct UnionFind {
  std::vector<int> parent;
  explicit UnionFind(int n) : parent(n) { std::iota(parent.begin(), parent.end(), 0); }
  int find(int i) const {
    while (parent[i] != i) i = parent[i];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
};

void checkMatch(const Garment& g, int s) {
  const Seam& seam = g.seams[s];
  for (const PatchEdge* e : {&seam.a, &seam.b})
    if (e->patch < 0 || e->patch >= static_cast<int>(g.patches.size()))
      reject(s, "patch " + std::to_string(e->patch) + " does not exist");
  const NurbsPatch &pa = g.patches[seam.a.patch], &pb = g.patches[seam.b.patch];
  if (!isClamped(pa.u) || !isClamped(pa.v) || !isClamped(pb.u) || !isClamped(pb.v))
    reject(s, "knots must be clamped at their ends");
  if (!(seam.stiffness_N >= 0)) reject(s, "stiffness must be >= 0");
  if (seam.onPart()) return;  // partOf looks closer
  if (knotsAlong(pa, seam.a.side).degree != knotsAlong(pb, seam.b.side).degree)
    reject(s, "degrees along the edge differ");
  const auto ka = edgeKnots(pa, seam.a), kb = edgeKnots(pb, seam.b);
  if (ka.size() != kb.size()) reject(s, "numbers of knots along the edge differ");
  for (std::size_t i = 0; i < ka.size(); ++i)
    if (std::abs(ka[i] - kb[i]) > 1e-12) reject(s, "knots along the edge differ");
}

double weightOf(const Garment& g, const std::vector<int>& offsets, int control) {
  const int patch = static_cast<int>(std::upper_bound(offsets.begin(), offsets.end(), control) - offsets.begin()) - 1;
  return g.patches[patch].weights[control - offsets[patch]];
}

}  // namespace

std::vector<int> controlOffsets(const Garment& garment) {
  std::vector<int> offsets{0};
  for (const NurbsPatch& p : garment.patches) offsets.push_back(offsets.back() + p.size());
  return offsets;
}

EdgeColumns edgeColumns(const Garment& garment, const PatchEdge& e) {
  const NurbsPatch& p = garment.patches[e.patch];
  const int offset = controlOffsets(garment)[e.patch], nu = p.u.count(), nv = p.v.count();
  EdgeColumns c;
  const int n = e.side == Side::u0 || e.side == Side::u1 ? nv : nu;
  for (int k = 0; k < n; ++k) {
    const int at = e.reversed ? n - 1 - k : k;
    switch (e.side) {
      case Side::u0:
        c.edge.push_back(offset + p.index(0, at)), c.inner.push_back(offset + p.index(1, at));
        break;
      case Side::u1:
        c.edge.push_back(offset + p.index(nu - 1, at)), c.inner.push_back(offset + p.index(nu - 2, at));
        break;
      case Side::v0:
        c.edge.push_back(offset + p.index(at, 0)), c.inner.push_back(offset + p.index(at, 1));
        break;
      case Side::v1:
        c.edge.push_back(offset + p.index(at, nv - 1)), c.inner.push_back(offset + p.index(at, nv - 2));
        break;
    }
  }
  return c;
}

FreeMap buildFreeMap(const Garment& garment) {
  const std::vector<int> offsets = controlOffsets(garment);
  const int n = offsets.back();
  std::vector<Vec3> Q;
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());

  // Joined edges are one point.
  UnionFind joined(n);
  const std::vector<int> owners = sharedOwners(garment);
  for (int i = 0; i < n; ++i) joined.join(i, owners[i]);
  for (int s = 0; s < static_cast<int>(garment.seams.size()); ++s) {
    checkMatch(garment, s);
    if (garment.seams[s].onPart()) continue;
    const EdgeColumns a = edgeColumns(garment, garment.seams[s].a), b = edgeColumns(garment, garment.seams[s].b);
    for (std::size_t k = 0; k < a.edge.size(); ++k) {
      const double size = norm(Q[a.inner[k]] - Q[a.edge[k]]) + norm(Q[b.inner[k]] - Q[b.edge[k]]);
      if (!(norm(Q[a.edge[k]] - Q[b.edge[k]]) <= 1e-9 * size)) reject(s, "the edges do not meet at rest");
      if (std::abs(weightOf(garment, offsets, a.edge[k]) - weightOf(garment, offsets, b.edge[k])) > 1e-12)
        reject(s, "weights along the edge differ");
      joined.join(a.edge[k], b.edge[k]);
    }
  }

  // How many patch corners and seam ends meet at a point.
  std::map<int, int> corners, seam_ends;
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    const NurbsPatch& patch = garment.patches[p];
    for (int i : {0, patch.u.count() - 1})
      for (int j : {0, patch.v.count() - 1}) ++corners[joined.find(offsets[p] + patch.index(i, j))];
  }
  for (const Seam& seam : garment.seams) {
    if (seam.onPart()) continue;
    const EdgeColumns a = edgeColumns(garment, seam.a);
    ++seam_ends[joined.find(a.edge.front())];
    ++seam_ends[joined.find(a.edge.back())];
  }
  const auto regular = [&](int control) {
    const int c = corners.at(joined.find(control)), e = seam_ends.at(joined.find(control));
    return c == e ? c == 4 : c == 2;  // inside as many seams as patches meet, on the border one less
  };

  // Points as combinations of others: edges on a part of another, and the middle columns of G1 seams, each between its
  // two neighbours.
  struct Combination {
    std::vector<std::pair<int, double>> of;
    int seam;
  };
  std::map<int, Combination> combined;
  std::vector<std::pair<int, Combination>> again;  // of corners that seams on parts of edges hold more than once
  std::vector<int> alike(n, 0);
  for (int i = 0; i < n; ++i) ++alike[joined.find(i)];
  for (int s = 0; s < static_cast<int>(garment.seams.size()); ++s) {
    const Seam& seam = garment.seams[s];
    if (!seam.onPart()) continue;
    const EdgePart part = partOf(garment, s);
    const EdgeColumns a = edgeColumns(garment, seam.a), b = edgeColumns(garment, seam.b);
    for (std::size_t k = 0; k < a.edge.size(); ++k) {
      Combination c{{}, s};
      Vec3 at{};
      for (const auto& [i, weight] : part.rows[k]) {
        c.of.push_back({joined.find(b.edge[i]), weight});
        at += weight * Q[b.edge[i]];
      }
      const double apart = norm(at - Q[a.edge[k]]);
      if (!(apart <= 1e-9 * norm(Q[a.inner[k]] - Q[a.edge[k]]))) reject(s, "the edges do not meet at rest");
      const int point = joined.find(a.edge[k]);
      const bool held = combined.contains(point), corner = k == 0 || k + 1 == a.edge.size();
      if ((held || alike[point] > 1) && !corner)
        reject(s, "an edge on a part of another may not be joined to a third one");
      if (held)
        again.emplace_back(point, std::move(c));
      else
        combined.emplace(point, std::move(c));
    }
  }
  for (int s = 0; s < static_cast<int>(garment.seams.size()); ++s) {
    const Seam& seam = garment.seams[s];
    if (seam.kind != SeamKind::G1) continue;
    const NurbsPatch &pa = garment.patches[seam.a.patch], &pb = garment.patches[seam.b.patch];
    if (knotsAcross(pa, seam.a.side).degree != knotsAcross(pb, seam.b.side).degree)
      reject(s, "G1: degrees across the edge differ");
    const EdgeColumns a = edgeColumns(garment, seam.a), b = edgeColumns(garment, seam.b);
    std::optional<double> ratio;
    for (std::size_t k = 0; k < a.edge.size(); ++k) {
      const bool end = k == 0 || k + 1 == a.edge.size();
      if (end && !regular(a.edge[k])) continue;
      const Vec3 da = Q[a.edge[k]] - Q[a.inner[k]], db = Q[b.inner[k]] - Q[b.edge[k]];
      if (!(norm(da) > 0 && norm(db) > 0)) reject(s, "G1: control points coincide at the edge");
      const double c = dot(da, db) / norm2(da);
      if (!(c > 0) || norm(db - c * da) > 1e-8 * norm(db))
        reject(s, "G1: the rest geometry has a crease at control point " + std::to_string(k) +
                      " of the edge; use a C0 seam with a rotational spring");
      // The ratio of the tangents themselves (eq. 2.27 to 2.29) must be one constant along the edge.
      const double tangent_ratio =
          c * (weightOf(garment, offsets, b.inner[k]) / weightOf(garment, offsets, a.inner[k]));
      if (!ratio) ratio = tangent_ratio;
      if (std::abs(tangent_ratio - *ratio) > 1e-8 * *ratio)
        reject(s, "G1: the ratio of the tangents varies along the edge; use a C0 seam with a rotational spring");
      combined.try_emplace(
          joined.find(a.edge[k]),
          Combination{{{joined.find(a.inner[k]), c / (1 + c)}, {joined.find(b.inner[k]), 1 / (1 + c)}}, s});
    }
  }

  // What trimming leaves without support follows others.
  const std::map<int, TrimFollower> followers = trimFollowers(garment);

  // Substitute until only free points are left.
  FreeMap map;
  std::vector<int> free_index(n, -1);
  for (int i = 0; i < n; ++i)
    if (joined.find(i) == i && !combined.contains(i) && !followers.contains(i)) {
      free_index[i] = static_cast<int>(map.home.size());
      map.home.push_back(i);
    }
  std::map<int, std::map<int, double>> rows;
  std::set<int> open;
  const std::function<const std::map<int, double>&(int)> resolve = [&](int r) -> const std::map<int, double>& {
    if (const auto it = rows.find(r); it != rows.end()) return it->second;
    std::map<int, double> row;
    if (free_index[r] >= 0) {
      row[free_index[r]] = 1;
    } else if (const auto follower = followers.find(r); follower != followers.end()) {
      for (const auto& [c, e] : follower->second.of)
        for (const auto& [i, w] : resolve(joined.find(c))) row[i] += e * w;
    } else {
      const Combination& c = combined.at(r);
      if (!open.insert(r).second)
        reject(c.seam, garment.seams[c.seam].onPart()
                           ? "this seam depends on itself"
                           : "G1: this seam depends on itself; a patch needs more control points between its G1 edges");
      for (const auto& [of, weight] : c.of)
        for (const auto& [i, w] : resolve(of)) row[i] += weight * w;
      open.erase(r);
    }
    return rows.emplace(r, std::move(row)).first->second;
  };
  for (const auto& [point, c] : again) {
    std::map<int, double> row = resolve(point);
    for (const auto& [of, weight] : c.of)
      for (const auto& [i, w] : resolve(joined.find(of))) row[i] -= weight * w;
    for (const auto& [column, value] : row)
      if (std::abs(value) > 1e-9) reject(c.seam, "seams that meet at a corner contradict each other");
  }
  map.T.column_count = static_cast<int>(map.home.size());
  for (int i = 0; i < n; ++i) {
    for (const auto& [column, value] : resolve(joined.find(i))) map.T.add(column, value);
    map.T.endRow();
  }
  map.Tt = transpose(map.T);

  // The rest shape itself must be reachable: seams that cross at a corner agree.
  std::vector<Vec3> p(map.home.size()), back(n);
  for (std::size_t i = 0; i < p.size(); ++i) p[i] = Q[map.home[i]];
  map.T.multiply<Vec3>(p, back);
  for (int i = 0; i < n; ++i)
    if (norm(back[i] - Q[i]) > 1e-7 * (1e-3 + norm(Q[i]))) {
      if (const auto follower = followers.find(i); follower != followers.end() && !follower->second.supported) continue;
      const auto it = combined.find(joined.find(i));
      reject(it == combined.end() ? 0 : it->second.seam, "seams that meet at a corner contradict each other");
    }
  return map;
}

std::vector<HingePoint> buildHinges(const Garment& garment) {
  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<Vec3> Q;
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  std::vector<HingePoint> hinges;
  for (std::size_t number = 0; number < garment.seams.size(); ++number) {
    const Seam& seam = garment.seams[number];
    if (seam.stiffness_N == 0) continue;
    EdgePart part;  // of edge b
    if (seam.onPart()) part = partOf(garment, static_cast<int>(number));
    const KnotVector& knots = knotsAlong(garment.patches[seam.a.patch], seam.a.side);
    const std::vector<double> ends = breakpoints(knots);
    const Quadrature rule = gaussLegendre(knots.degree + 1);
    for (std::size_t cell = 0; cell + 1 < ends.size(); ++cell)
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const double along = ends[cell] + rule.points[g] * (ends[cell + 1] - ends[cell]);
        const double fraction = (along - knots.front()) / (knots.back() - knots.front());
        const double sense = seam.a.reversed ? 1 - fraction : fraction;  // in the sense of the seam
        HingePoint h;
        std::map<int, std::array<double, 3>> row;
        for (int which : {0, 1}) {
          const PatchEdge& e = which == 0 ? seam.a : seam.b;
          const NurbsPatch& patch = garment.patches[e.patch];
          const KnotVector &ka = knotsAlong(patch, e.side), &kc = knotsAcross(patch, e.side);
          const double s = which == 0 ? sense : part.from + sense * (part.to - part.from);
          const double t = ka.front() + (e.reversed ? 1 - s : s) * (ka.back() - ka.front());
          const bool across_u = e.side == Side::u0 || e.side == Side::u1,
                     far = e.side == Side::u1 || e.side == Side::v1;
          const double c = far ? kc.back() : kc.front();
          const SurfaceBasis basis = surfaceBasis(patch, across_u ? c : t, across_u ? t : c);
          for (std::size_t k = 0; k < basis.columns.size(); ++k) {
            auto& entry = row[offsets[e.patch] + basis.columns[k]];
            const double d_across = (far ? -1 : 1) * basis.values[across_u ? 1 : 2][k];
            if (which == 0) entry[0] += basis.values[across_u ? 2 : 1][k];
            entry[1 + which] += d_across;
          }
        }
        for (const auto& [column, v] : row) {
          if (v[0] == 0 && v[1] == 0 && v[2] == 0) continue;
          h.columns.push_back(column);
          h.t.push_back(v[0]);
          h.a.push_back(v[1]);
          h.b.push_back(v[2]);
        }
        Vec3 tangent{};
        for (std::size_t k = 0; k < h.columns.size(); ++k) tangent += h.t[k] * Q[h.columns[k]];
        h.stiffness_length = seam.stiffness_N * rule.weights[g] * (ends[cell + 1] - ends[cell]) * norm(tangent);
        h.theta0 = hingeAngle(h, Q, nullptr);
        hinges.push_back(std::move(h));
      }
  }
  return hinges;
}

double hingeAngle(const HingePoint& h, std::span<const Vec3> q, std::vector<Vec3>* gradient) {
  Vec3 t{}, a{}, b{};
  for (std::size_t k = 0; k < h.columns.size(); ++k) {
    const Vec3& x = q[h.columns[k]];
    t += h.t[k] * x;
    a += h.a[k] * x;
    b += h.b[k] * x;
  }
  const double length = norm(t);
  const Vec3 e = t / length;
  const Vec3 a_perp = a - dot(a, e) * e, b_perp = b - dot(b, e) * e;
  // theta = angle from -a_perp to b_perp about e: 0 where the surface is flat.
  const double theta = std::atan2(dot(cross(-a_perp, b_perp), e), dot(-a_perp, b_perp));
  if (gradient) {
    // Turning v_perp about e by d(phi) moves it along n = e x v_perp/|v_perp|; with a tilting e,
    // d(phi) = n . (dv - (v.e) de) / |v_perp| and n . de = n . dt/|t|; the twist of the frame about e cancels in the
    // difference.
    const double alpha = norm(a_perp), beta = norm(b_perp);
    const Vec3 na = cross(e, a_perp) / (alpha * alpha), nb = cross(e, b_perp) / (beta * beta);
    const double ca = dot(a, e) / length, cb = dot(b, e) / length;
    gradient->resize(h.columns.size());
    for (std::size_t k = 0; k < h.columns.size(); ++k)
      (*gradient)[k] = (h.b[k] - cb * h.t[k]) * nb - (h.a[k] - ca * h.t[k]) * na;
  }
  return theta;
}

}  // namespace gambeson
