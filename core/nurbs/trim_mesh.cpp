#include "core/nurbs/trim_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/nurbs/trim_outline.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kShort = 0.3;  ///< of the grid's spacing

using Triangle = std::array<int, 3>;

class Mesher {
 public:
  Mesher(const NurbsPatch& patch, Outline outline, std::span<const double> us, std::span<const double> vs,
         std::array<bool, 4> fixed)
      : o_(std::move(outline)), us_(us), vs_(vs) {
    for (Vec2 p : o_.uv) {
      X_.push_back(surfaceDerivatives(patch, p.x, p.y)[0]);
      fixed_.push_back((fixed[0] && p.x == us.front()) || (fixed[1] && p.x == us.back()) ||
                       (fixed[2] && p.y == vs.front()) || (fixed[3] && p.y == vs.back()));
    }
    around_.resize(o_.uv.size());
  }

  TrimMesh run() {
    const int nu = static_cast<int>(us_.size());
    for (const Outline::Cell& cell : o_.cells) {
      if (!cell.whole) {
        for (const auto& polygon : cell.polygons) clip(polygon);
        continue;
      }
      const int a = o_.grid[cell.i + nu * cell.j], b = o_.grid[cell.i + 1 + nu * cell.j];
      const int c = o_.grid[cell.i + 1 + nu * (cell.j + 1)], d = o_.grid[cell.i + nu * (cell.j + 1)];
      if ((cell.i + cell.j) % 2 == 0)
        add({a, b, c}, false), add({a, c, d}, false);
      else
        add({a, b, d}, false), add({b, c, d}, false);
    }
    shrinkShortEdges();
    flipEdges();
    TrimMesh mesh;
    std::vector<int> index(o_.uv.size(), -1);
    std::vector<char> seen(o_.uv.size(), 0);
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (alive_[t])
        for (int p : triangles_[t]) seen[p] = 1;
    for (std::size_t p = 0; p < seen.size(); ++p)
      if (seen[p]) {
        index[p] = static_cast<int>(mesh.uv.size());
        mesh.uv.push_back(o_.uv[p]);
      }
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      if (alive_[t])
        mesh.triangles.push_back({index[triangles_[t][0]], index[triangles_[t][1]], index[triangles_[t][2]]});
    for (int p : o_.grid) mesh.grid.push_back(p < 0 ? -1 : index[p]);
    return mesh;
  }

 private:
  void add(Triangle t, bool cut) {
    for (int p : t) around_[p].push_back(static_cast<int>(triangles_.size()));
    triangles_.push_back(t);
    alive_.push_back(1);
    cut_.push_back(cut);
  }
  void remove(int t) {
    alive_[t] = 0;
    for (int p : triangles_[t]) std::erase(around_[p], t);
  }

  /// Twice the area in parameters, over that of the grid cell there.
  double orientation(int a, int b, int c) const {
    const Vec2 p = o_.uv[a], q = o_.uv[b], r = o_.uv[c];
    const auto [hu, hv] = spacing({(p.x + q.x + r.x) / 3, (p.y + q.y + r.y) / 3});
    return ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x)) / (hu * hv);
  }
  /// The smallest angle of the triangle at rest; negative where it is turned over in the parameters.
  double quality(int a, int b, int c) const {
    if (!(orientation(a, b, c) > 1e-9)) return -1;
    double least = 10;
    const int v[3] = {a, b, c};
    for (int k = 0; k < 3; ++k) {
      const Vec3 e = X_[v[(k + 1) % 3]] - X_[v[k]], f = X_[v[(k + 2) % 3]] - X_[v[k]];
      least = std::min(least, std::atan2(norm(cross(e, f)), dot(e, f)));
    }
    return least;
  }
  std::array<double, 2> spacing(Vec2 p) const {
    const auto of = [](std::span<const double> lines, double x) {
      const long at = std::upper_bound(lines.begin(), lines.end(), x) - lines.begin() - 1;
      const long cell = std::clamp(at, 0L, static_cast<long>(lines.size()) - 2);
      return lines[cell + 1] - lines[cell];
    };
    return {of(us_, p.x), of(vs_, p.y)};
  }
  double length(int a, int b) const {
    const Vec2 p = o_.uv[a], q = o_.uv[b];
    const auto [hu, hv] = spacing({0.5 * (p.x + q.x), 0.5 * (p.y + q.y)});
    return std::hypot((p.x - q.x) / hu, (p.y - q.y) / hv);
  }

  /// Ears, the one with the largest smallest angle first.
  void clip(std::vector<int> polygon) {
    while (polygon.size() > 3) {
      const int n = static_cast<int>(polygon.size());
      int best = -1;
      double best_quality = -2;
      for (int k = 0; k < n; ++k) {
        const int a = polygon[(k + n - 1) % n], b = polygon[k], c = polygon[(k + 1) % n];
        const double q = quality(a, b, c);
        if (q < 0 || q <= best_quality) continue;
        bool empty = true;
        for (int p : polygon)
          if (empty && p != a && p != b && p != c)
            empty = !(orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0);
        if (empty) best = k, best_quality = q;
      }
      if (best < 0) {
        // Only flat corners are left (or points on the ears' rims): cut off what has no area, it is nothing.
        double least = 1e300;
        for (int k = 0; k < n; ++k) {
          const double area = std::abs(orientation(polygon[(k + n - 1) % n], polygon[k], polygon[(k + 1) % n]));
          if (area < least) least = area, best = k;
        }
        if (least > 1e-6)
          throw InputError({"", 0, "loops"}, "what a loop leaves of a cell of the sample grid cannot be meshed");
        polygon.erase(polygon.begin() + best);
        continue;
      }
      add({polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]}, true);
      polygon.erase(polygon.begin() + best);
    }
    if (polygon.size() == 3 && quality(polygon[0], polygon[1], polygon[2]) > 0)
      add({polygon[0], polygon[1], polygon[2]}, true);
  }

  std::vector<int> trianglesOf(int a, int b) const {
    std::vector<int> out;
    for (int t : around_[a])
      if (std::find(triangles_[t].begin(), triangles_[t].end(), b) != triangles_[t].end()) out.push_back(t);
    return out;
  }
  std::set<int> neighbours(int a) const {
    std::set<int> out;
    for (int t : around_[a])
      for (int p : triangles_[t])
        if (p != a) out.insert(p);
    return out;
  }

  /// The worst angle around `gone` after it has moved onto `stays`; below 0 where that may not be, or where it spoils
  /// (by far: two short edges at a corner go one after the other) an angle that was better than 6 degrees.
  double shrunk(int gone, int stays) const {
    if (fixed_[gone] || o_.rank[gone] == OutlineRank::corner || o_.rank[gone] > o_.rank[stays]) return -1;
    const auto shared = trianglesOf(gone, stays);
    // Along the outline only; and inner edges that join two points of the outline stay, they span the cloth.
    if (o_.rank[gone] == OutlineRank::edge && shared.size() != 1) return -1;
    if (shared.empty()) return -1;
    std::set<int> apexes, common;
    for (int t : shared)
      for (int p : triangles_[t])
        if (p != gone && p != stays) apexes.insert(p);
    const auto na = neighbours(gone), nb = neighbours(stays);
    std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::inserter(common, common.end()));
    if (common != apexes) return -1;
    double worst = 10, before = 0.1;
    for (int t : around_[gone]) {
      before = std::min(before, quality(triangles_[t][0], triangles_[t][1], triangles_[t][2]));
      if (std::find(shared.begin(), shared.end(), t) != shared.end()) continue;
      Triangle n = triangles_[t];
      std::replace(n.begin(), n.end(), gone, stays);
      worst = std::min(worst, quality(n[0], n[1], n[2]));
    }
    return worst == 10 || worst < 0.3 * before ? -1 : worst;  // a last triangle does not vanish
  }

  void shrinkShortEdges() {
    struct Candidate {
      double length;
      int a, b;
    };
    for (int pass = 0; pass < 50; ++pass) {
      std::vector<Candidate> edges;
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (alive_[t] && cut_[t])
          for (int k = 0; k < 3; ++k) {
            const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3];
            const double l = length(a, b);
            if (l < kShort) edges.push_back({l, std::min(a, b), std::max(a, b)});
          }
      std::sort(edges.begin(), edges.end(), [](const Candidate& x, const Candidate& y) {
        return x.length != y.length ? x.length < y.length : x.a != y.a ? x.a < y.a : x.b < y.b;
      });
      bool changed = false;
      std::set<int> touched;
      for (const Candidate& e : edges) {
        if (touched.contains(e.a) || touched.contains(e.b)) continue;
        const double ab = shrunk(e.a, e.b), ba = shrunk(e.b, e.a);
        if (!(std::max(ab, ba) > 0)) continue;
        const int gone = ab >= ba ? e.a : e.b, stays = ab >= ba ? e.b : e.a;
        for (int p : neighbours(gone)) touched.insert(p);
        touched.insert(gone);
        for (int t : trianglesOf(gone, stays)) remove(t);
        const std::vector<int> rest = around_[gone];
        for (int t : rest) {
          std::replace(triangles_[t].begin(), triangles_[t].end(), gone, stays);
          cut_[t] = 1;
          around_[stays].push_back(t);
        }
        around_[gone].clear();
        changed = true;
      }
      if (!changed) break;
    }
    for (int& p : o_.grid)
      if (p >= 0 && around_[p].empty()) p = -1;
  }

  void flipEdges() {
    for (int pass = 0; pass < 20; ++pass) {
      bool changed = false;
      for (int t = 0; t < static_cast<int>(triangles_.size()); ++t) {
        if (!alive_[t] || !cut_[t]) continue;
        for (int k = 0; k < 3; ++k) {
          const int a = triangles_[t][k], b = triangles_[t][(k + 1) % 3], c = triangles_[t][(k + 2) % 3];
          const auto shared = trianglesOf(a, b);
          if (shared.size() != 2) continue;
          const int other = shared[0] == t ? shared[1] : shared[0];
          int d = -1;
          for (int p : triangles_[other])
            if (p != a && p != b) d = p;
          if (!trianglesOf(c, d).empty()) continue;
          const double before = std::min(quality(a, b, c), quality(b, a, d));
          const double after = std::min(quality(c, a, d), quality(d, b, c));
          if (!(after > before + 1e-9)) continue;
          remove(t);
          remove(other);
          triangles_[t] = {c, a, d};
          triangles_[other] = {d, b, c};
          for (int s : {t, other}) {
            alive_[s] = 1;
            cut_[s] = 1;
            for (int p : triangles_[s]) around_[p].push_back(s);
          }
          changed = true;
          break;
        }
      }
      if (!changed) break;
    }
  }

  Outline o_;
  std::span<const double> us_, vs_;
  std::vector<Vec3> X_;
  std::vector<char> fixed_;
  std::vector<Triangle> triangles_;
  std::vector<char> alive_, cut_;
  std::vector<std::vector<int>> around_;  ///< live triangles of each vertex
};

}  // namespace

TrimMesh trimMesh(const NurbsPatch& patch, const Trim& trim, std::span<const double> us, std::span<const double> vs,
                  std::array<bool, 4> fixed_sides) {
  return Mesher(patch, cutGrid(trimBoundary(patch, trim), us, vs), us, vs, fixed_sides).run();
}

}  // namespace gambeson
