#include "core/cloth/triangles/sewn_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/sewing.hpp"
#include "core/cloth/draft/sewn_length.hpp"
#include "core/cloth/draft/shared_points.hpp"
#include "core/error.hpp"
#include "core/math/planar_mesh.hpp"

namespace gambeson {
namespace {

constexpr double kTogether = 0.25;  // of a cell: corners across a seam are taken together
constexpr double kSame = 1e-7;      // of a border's length
constexpr double kTurn_rad = 0.5;   // of an edge of the mesh, at most
constexpr double kCorner_rad = 0.3;
constexpr int kLooksPerCell = 16;

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }
std::string keyOf(int seam) { return "sewn_seams[" + std::to_string(seam) + "]"; }
std::string nameOf(const SewnSeam& seam) { return seam.name.empty() ? "" : " (seam \"" + seam.name + "\")"; }

/// A patch as a plane: (x, y) = (u su, v sv) in m.
struct Plane {
  double su = 1, sv = 1, cell_m = 0;
};

Plane planeOf(const Garment& g, int index) {
  const NurbsPatch& p = g.patches[static_cast<std::size_t>(index)];
  const double u0 = p.u.front(), v0 = p.v.front(), lu = p.u.back() - u0, lv = p.v.back() - v0;
  const auto d = surfaceDerivatives(p, u0, v0);
  const double su = norm(d[1]), sv = norm(d[2]), size = su * lu + sv * lv;
  bool even = su > 0 && sv > 0 && std::abs(dot(d[1], d[2])) < 1e-9 * su * sv;
  const std::vector<double> us = grevillePoints(p.u), vs = grevillePoints(p.v);
  for (std::size_t j = 0; j < vs.size(); ++j)
    for (std::size_t i = 0; i < us.size(); ++i) {
      const auto k = static_cast<std::size_t>(p.index(static_cast<int>(i), static_cast<int>(j)));
      even = even && norm(p.points[k] - (d[0] + (us[i] - u0) * d[1] + (vs[j] - v0) * d[2])) < 1e-9 * size &&
             std::abs(p.weights[k] / p.weights[0] - 1) < 1e-12;
    }
  if (!even)
    reject("mesh", "triangles are sewn of patches that are flat, with even parameters at right angles; patch " +
                       std::to_string(index) + " is none");
  const double cells = static_cast<double>((breakpoints(p.u).size() - 1) * (breakpoints(p.v).size() - 1));
  return {su, sv, std::sqrt(su * lu * sv * lv / cells)};
}

/// A closed loop of a patch's border, by length along it, in its sense; places on it are taken modulo its length.
struct Border {
  int patch = 0;
  SewnEdge edge;
  std::optional<SewnLength> length;
  std::vector<Vec2> look;  ///< its points at even steps, in m
  std::set<double> breaks;

  double size() const { return length->length_m(); }
  double wrapped(double at) const {
    at = std::fmod(at, size());
    if (at < 0) at += size();
    return at >= size() * (1 - kSame) ? 0 : at;
  }
  SewnPoint point(double at) const { return length->at(wrapped(at) / size()); }
  /// Adds a break unless there is one at this place.
  bool add(double at) {
    at = wrapped(at);
    const auto next = breaks.lower_bound(at - kSame * size());
    if (next != breaks.end() && *next <= at + kSame * size()) return false;
    if (at > size() * (1 - kSame) && breaks.contains(0)) return false;
    breaks.insert(at);
    return true;
  }
};

/// A stretch of a border that is sewn to one of another: places a0 to a1 on `a`, to b0 to b1 on `b`, which may run on
/// over the borders' starts.
struct Link {
  int a = 0, b = 0;
  double a0 = 0, a1 = 0, b0 = 0, b1 = 0;
  int seam = 0;
  bool cut = false;
};

class Meshing {
 public:
  explicit Meshing(const Garment& g) : g_(g) {
    if (!g.seams.empty()) reject("mesh", "triangles that are sewn of panels are joined by sewn seams alone");
    addBorders();
    addLinks();
  }

  SewnMesh run() {
    spreadBreaks();
    countEdges();
    placeVertices();
    pairVertices();
    return std::move(out_);
  }

 private:
  Vec2 flat(int patch, Vec2 uv) const {
    const Plane& plane = plane_[static_cast<std::size_t>(patch)];
    return {uv.x * plane.su, uv.y * plane.sv};
  }

  void addBorders() {
    for (int p = 0; p < static_cast<int>(g_.patches.size()); ++p) {
      plane_.push_back(planeOf(g_, p));
      first_border_.push_back(static_cast<int>(borders_.size()));
      std::vector<SewnEdge> loops;
      if (isTrimmed(g_, p)) {
        for (const TrimLoop& loop : g_.trims[static_cast<std::size_t>(p)].loops) {
          loops.emplace_back();
          for (const NurbsCurve& c : loop) loops.back().push_back({p, c, c.knots.front(), c.knots.back()});
        }
      } else {
        const KnotVector &u = g_.patches[static_cast<std::size_t>(p)].u, &v = g_.patches[static_cast<std::size_t>(p)].v;
        const Vec2 corners[] = {
            {u.front(), v.front()}, {u.back(), v.front()}, {u.back(), v.back()}, {u.front(), v.back()}};
        loops.emplace_back();
        for (const NurbsCurve& c : polygon(corners)) loops.back().push_back({p, c, c.knots.front(), c.knots.back()});
      }
      for (SewnEdge& loop : loops) {
        borders_.push_back({p, std::move(loop), {}, {}, {}});
      }
    }
    first_border_.push_back(static_cast<int>(borders_.size()));
    for (Border& b : borders_) {  // which stay where they are from here on
      b.length.emplace(g_, b.edge, "mesh");
      const int looks = std::max(32, static_cast<int>(kLooksPerCell * b.length->cells()));
      for (int k = 0; k < looks; ++k) b.look.push_back(flat(b.patch, b.length->at(static_cast<double>(k) / looks).uv));
      addCorners(b);
    }
  }

  /// Where a border turns sharply.
  void addCorners(Border& b) {
    const double little = 1e-6;
    for (const double at : b.length->corners()) {
      const SewnPoint before = b.point((at - little) * b.size()), after = b.point((at + little) * b.size());
      if (dot(before.tangent, after.tangent) < std::cos(kCorner_rad)) b.add(at * b.size());
    }
    if (b.breaks.empty()) b.add(0);
  }

  /// The places of a border at a point, within rounding.
  std::vector<double> placesOf(const Border& b, Vec2 at) const {
    std::vector<double> out;
    const auto n = static_cast<int>(b.look.size());
    const double step = b.size() / n;
    const auto away = [&](double place) {
      const Vec2 p = flat(b.patch, b.point(place).uv);
      return std::hypot(p.x - at.x, p.y - at.y);
    };
    for (int k = 0; k < n; ++k) {
      const auto near = [&](int i) {
        const Vec2 p = b.look[static_cast<std::size_t>((i + n) % n)];
        return std::hypot(p.x - at.x, p.y - at.y);
      };
      if (near(k) > 2 * step || near(k) > near(k - 1) || near(k) > near(k + 1)) continue;
      double low = (k - 1) * step, high = (k + 1) * step;
      for (int i = 0; i < 80 && high - low > 1e-13 * b.size(); ++i) {
        const double a = low + (high - low) / 3, c = high - (high - low) / 3;
        (away(a) <= away(c) ? high : low) = away(a) <= away(c) ? c : a;
      }
      double found = 0.5 * (low + high);
      for (int i = 0; i < 3; ++i) {  // where the distance is least, it tells the place to half of all digits only
        const SewnPoint p = b.point(found);
        const Vec2 x = flat(b.patch, p.uv), way = flat(b.patch, p.along);
        found += (at.x - x.x) * way.x + (at.y - x.y) * way.y;
      }
      for (const double corner : b.breaks)
        if (std::abs(std::remainder(found - corner, b.size())) < kSame * b.size()) found = corner;
      if (away(found) < kSame * b.size()) out.push_back(found);
    }
    return out;
  }

  /// Where a part of a seam runs along a border: border, place of its start, and +1 or -1 as it runs with it or
  /// against. `length`: of the part.
  struct Run {
    int border = 0;
    double start = 0, sense = 1, length = 0;
  };
  Run runOf(const SewnPart& part, int seam) const {
    const SewnEdge alone{part};
    const SewnLength measured(g_, alone, keyOf(seam));
    const double length = measured.length_m();
    for (int i = first_border_[static_cast<std::size_t>(part.patch)];
         i < first_border_[static_cast<std::size_t>(part.patch) + 1]; ++i) {
      const Border& b = borders_[static_cast<std::size_t>(i)];
      for (const double start : placesOf(b, flat(part.patch, measured.at(0).uv)))
        for (const double sense : {1.0, -1.0}) {
          const auto runs = [&](double fraction) {
            const Vec2 p = flat(part.patch, b.point(start + sense * fraction * length).uv),
                       q = flat(part.patch, measured.at(fraction).uv);
            return std::hypot(p.x - q.x, p.y - q.y) < 10 * kSame * b.size();
          };
          if (runs(0.23) && runs(0.5) && runs(0.77) && runs(1)) return {i, start, sense, length};
        }
    }
    reject(keyOf(seam), "an edge does not run along the border of patch " + std::to_string(part.patch) +
                            nameOf(g_.sewn_seams[static_cast<std::size_t>(seam)]));
  }

  void addLinks() {
    for (int k = 0; k < static_cast<int>(g_.sewn_seams.size()); ++k) {
      const SewnSeam& seam = g_.sewn_seams[static_cast<std::size_t>(k)];
      if (seam.hold == SeamHold::open) continue;
      if (seam.hold == SeamHold::weak) reject(keyOf(k), "weak seams go with NURBS cloth" + nameOf(seam));
      checkSpring(g_, static_cast<std::size_t>(k));
      std::array<std::vector<Run>, 2> runs;
      for (const SewnPart& part : seam.a) runs[0].push_back(runOf(part, k));
      for (const SewnPart& part : seam.b) runs[1].push_back(runOf(part, k));
      addSeam(k, isCut(seam), runs);
    }
  }

  /// One link for each stretch that is of one part on both sides.
  void addSeam(int seam, bool cut, const std::array<std::vector<Run>, 2>& runs) {
    std::array<double, 2> whole{};
    for (std::size_t side = 0; side < 2; ++side)
      for (const Run& r : runs[side]) whole[side] += r.length;
    std::array<std::size_t, 2> part{};
    std::array<double, 2> done{};  // of the part that is under way
    while (part[0] < runs[0].size() && part[1] < runs[1].size()) {
      std::array<double, 2> left{};
      for (std::size_t side = 0; side < 2; ++side)
        left[side] = (runs[side][part[side]].length - done[side]) / whole[side];
      const double step = std::min(left[0], left[1]);
      std::array<std::array<double, 2>, 2> ends{};
      for (std::size_t side = 0; side < 2; ++side) {
        const Run& r = runs[side][part[side]];
        ends[side][0] = r.start + r.sense * done[side];
        done[side] = left[side] <= step * (1 + 1e-9) ? r.length : done[side] + step * whole[side];
        ends[side][1] = r.start + r.sense * done[side];
      }
      if (step > 1e-9)
        links_.push_back({runs[0][part[0]].border, runs[1][part[1]].border, ends[0][0], ends[0][1], ends[1][0],
                          ends[1][1], seam, cut});
      for (std::size_t side = 0; side < 2; ++side)
        if (done[side] >= runs[side][part[side]].length) ++part[side], done[side] = 0;
    }
  }

  Border& border(int i) { return borders_[static_cast<std::size_t>(i)]; }
  const Border& border(int i) const { return borders_[static_cast<std::size_t>(i)]; }
  double cellOf(const Border& b) const { return plane_[static_cast<std::size_t>(b.patch)].cell_m; }

  /// The breaks of a border strictly within a stretch, as fractions of it, ascending.
  std::vector<double> within(const Border& b, double from, double to) const {
    std::vector<double> out;
    const double low = std::min(from, to), high = std::max(from, to), eps = 2 * kSame * b.size();
    for (const double at : b.breaks)
      for (double place = at + std::floor((low - at) / b.size()) * b.size(); place < high - eps; place += b.size())
        if (place > low + eps) out.push_back((place - from) / (to - from));
    std::sort(out.begin(), out.end());
    return out;
  }

  /// Breaks go over all seams until each link has as many on both sides; links end at them then.
  void spreadBreaks() {
    for (Link& l : links_) {
      border(l.a).add(l.a0), border(l.a).add(l.a1);
      border(l.b).add(l.b0), border(l.b).add(l.b1);
    }
    for (int round = 0; round < 100; ++round) {
      bool any = false;
      std::vector<Link> next;
      for (const Link& l : links_) {
        const std::vector<double> a = within(border(l.a), l.a0, l.a1), b = within(border(l.b), l.b0, l.b1);
        if (a.empty() && b.empty()) {
          next.push_back(l);
          continue;
        }
        any = true;
        const double near = l.cut ? 0
                                  : kTogether * std::min(cellOf(border(l.a)), cellOf(border(l.b))) /
                                        std::min(std::abs(l.a1 - l.a0), std::abs(l.b1 - l.b0));
        std::vector<std::pair<double, double>> cuts{{0, 0}};
        for (std::size_t i = 0, k = 0; i < a.size() || k < b.size();) {
          const bool both = i < a.size() && k < b.size();
          const double apart = both ? std::abs(a[i] - b[k]) : 0;
          if (both && apart <= std::max(near, 1e-6) && !(i + 1 < a.size() && std::abs(a[i + 1] - b[k]) < apart) &&
              !(k + 1 < b.size() && std::abs(b[k + 1] - a[i]) < apart)) {
            cuts.emplace_back(a[i++], b[k++]);
          } else if (k == b.size() || (i < a.size() && a[i] < b[k])) {
            cuts.emplace_back(a[i], a[i]), ++i;
          } else {
            cuts.emplace_back(b[k], b[k]), ++k;
          }
        }
        cuts.emplace_back(1, 1);
        for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
          const auto on_a = [&](double t) { return l.a0 + t * (l.a1 - l.a0); };
          const auto on_b = [&](double t) { return l.b0 + t * (l.b1 - l.b0); };
          border(l.a).add(on_a(cuts[c].first)), border(l.b).add(on_b(cuts[c].second));
          next.push_back({l.a, l.b, on_a(cuts[c].first), on_a(cuts[c + 1].first), on_b(cuts[c].second),
                          on_b(cuts[c + 1].second), l.seam, l.cut});
        }
      }
      links_ = std::move(next);
      if (!any) return;
    }
    reject("mesh", "corners go round and round over its seams");
  }

  /// A stretch of a border between two breaks.
  struct Interval {
    int border = 0;
    double from = 0, to = 0;
    int edges = 1;
    int first_vertex = 0;  ///< of its patch
  };

  /// The interval that a link's side covers.
  std::size_t intervalAt(int i, double from, double to) const {
    const double middle = border(i).wrapped(0.5 * (from + to));
    for (std::size_t k = 0; k < intervals_.size(); ++k) {
      const Interval& v = intervals_[k];
      if (v.border != i) continue;
      if ((middle >= v.from && middle <= v.to) || (middle + border(i).size() <= v.to)) return k;
    }
    reject("mesh", "a seam lies outside of its border");
  }

  void countEdges() {
    for (int i = 0; i < static_cast<int>(borders_.size()); ++i) {
      const Border& b = border(i);
      const std::vector<double> at(b.breaks.begin(), b.breaks.end());
      for (std::size_t k = 0; k < at.size(); ++k) {
        Interval v{i, at[k], k + 1 < at.size() ? at[k + 1] : at[0] + b.size()};
        const double cell = plane_[static_cast<std::size_t>(b.patch)].cell_m;
        double turned = 0;
        constexpr int looks = 16;
        for (int n = 0; n < looks; ++n) {
          const auto tangent = [&](int m) {
            return b.point(v.from + (m + 0.5) / (looks + 1) * (v.to - v.from)).tangent;
          };
          turned += std::acos(std::clamp(dot(tangent(n), tangent(n + 1)), -1.0, 1.0));
        }
        v.edges = std::max({1, static_cast<int>(std::lround((v.to - v.from) / cell)),
                            static_cast<int>(std::ceil(turned / kTurn_rad - 1e-6))});
        if (at.size() == 1) v.edges = std::max(v.edges, 3);
        intervals_.push_back(v);
      }
    }
    // Intervals that are sewn to each other have as many as the most of them.
    std::vector<std::size_t> of(intervals_.size());
    std::iota(of.begin(), of.end(), std::size_t{0});
    const auto find = [&](std::size_t k) {
      while (of[k] != k) k = of[k];
      return k;
    };
    for (const Link& l : links_) {
      sides_.push_back({intervalAt(l.a, l.a0, l.a1), intervalAt(l.b, l.b0, l.b1)});
      if (sides_.back()[0] == sides_.back()[1])
        reject(keyOf(l.seam), "both of its sides are one" + nameOf(g_.sewn_seams[static_cast<std::size_t>(l.seam)]));
      const std::size_t a = find(sides_.back()[0]), b = find(sides_.back()[1]);
      if (a == b) continue;
      intervals_[a].edges = std::max(intervals_[a].edges, intervals_[b].edges);
      of[b] = a;
    }
    for (std::size_t k = 0; k < intervals_.size(); ++k) intervals_[k].edges = intervals_[find(k)].edges;
  }

  void placeVertices() {
    std::size_t interval = 0;
    for (int p = 0; p < static_cast<int>(g_.patches.size()); ++p) {
      const Plane& plane = plane_[static_cast<std::size_t>(p)];
      std::vector<std::vector<Vec2>> loops;
      int vertices = 0;
      for (int i = first_border_[static_cast<std::size_t>(p)]; i < first_border_[static_cast<std::size_t>(p) + 1];
           ++i) {
        loops.emplace_back();
        first_vertex_.push_back(vertices);
        for (; interval < intervals_.size() && intervals_[interval].border == i; ++interval) {
          Interval& v = intervals_[interval];
          v.first_vertex = vertices + static_cast<int>(loops.back().size());
          for (int k = 0; k < v.edges; ++k)
            loops.back().push_back(flat(p, border(i).point(v.from + (v.to - v.from) * k / v.edges).uv));
        }
        vertices += static_cast<int>(loops.back().size());
        end_vertex_.push_back(vertices);
      }
      PlanarMesh mesh;
      try {
        mesh = planarMesh(loops, plane.cell_m);
      } catch (const InputError& e) {
        reject("mesh",
               "the border of patch " + std::to_string(p) +
                   (g_.patch_names.empty() ? "" : " (\"" + g_.patch_names[static_cast<std::size_t>(p)] + "\")") +
                   " cannot be meshed with cells of " + std::to_string(1e3 * plane.cell_m) + " mm: " + e.reason());
      }
      SewnMesh::Patch patch{{}, std::move(mesh.triangles), plane.cell_m};
      for (const Vec2 at : mesh.points) patch.uv.push_back({at.x / plane.su, at.y / plane.sv});
      out_.patches.push_back(std::move(patch));
    }
  }

  /// Vertex k of an interval, the end of which is the start of the next.
  int vertexOf(const Interval& v, int k) const {
    const int at = v.first_vertex + k;
    const auto i = static_cast<std::size_t>(v.border);
    return at == end_vertex_[i] ? first_vertex_[i] : at;
  }

  MeshVertex vertexAlong(const Interval& v, bool forward, int k) const {
    return {border(v.border).patch, vertexOf(v, forward ? k : v.edges - k)};
  }

  void pairVertices() {
    std::set<std::array<int, 4>> known;
    for (std::size_t n = 0; n < links_.size(); ++n) {
      const Link& l = links_[n];
      const Interval &a = intervals_[sides_[n][0]], &b = intervals_[sides_[n][1]];
      const double spacing = 0.5 * (a.to - a.from + b.to - b.from) / a.edges;
      const auto on_a = [&](int k) { return vertexAlong(a, l.a1 > l.a0, k); };
      const auto on_b = [&](int k) { return vertexAlong(b, l.b1 > l.b0, k); };
      for (int k = 0; k < a.edges && !l.cut; ++k)
        out_.edges.push_back({{on_a(k), on_a(k + 1)}, {on_b(k), on_b(k + 1)}, l.seam});
      for (int k = 0; k <= a.edges; ++k) {
        const MeshVertex va = on_a(k), vb = on_b(k);
        if (va.patch == vb.patch && va.vertex == vb.vertex) continue;
        if (l.cut) {
          out_.cuts.push_back({va, vb});
          continue;
        }
        if (!known.insert({va.patch, va.vertex, vb.patch, vb.vertex}).second) continue;
        known.insert({vb.patch, vb.vertex, va.patch, va.vertex});
        out_.pairs.push_back({va, vb, l.seam, (k == 0 || k == a.edges ? 0.5 : 1) * spacing, spacing});
      }
    }
  }

  const Garment& g_;
  std::vector<Plane> plane_;
  std::vector<Border> borders_;
  std::vector<int> first_border_;               ///< of each patch, and the end
  std::vector<int> first_vertex_, end_vertex_;  ///< of each border, in its patch
  std::vector<Link> links_;
  std::vector<Interval> intervals_;
  std::vector<std::array<std::size_t, 2>> sides_;  ///< of each link: its intervals
  SewnMesh out_;
};

}  // namespace

SewnMesh sewnMesh(const Garment& garment) { return Meshing(garment).run(); }

}  // namespace gambeson
