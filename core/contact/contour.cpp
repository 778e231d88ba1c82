#include "core/contact/contour.hpp"

#include <algorithm>
#include <cassert>

#include "core/contact/contour_point.hpp"

namespace gambeson {
namespace {

/// A pair of crossing triangles and its two ends: crossings, or -1 for the vertex by which they hang together.
struct Pair {
  int a, b;  ///< a < b
  std::array<int, 2> end{-1, -1};
};

struct Graph {
  std::vector<Pair> pairs;
  std::vector<std::vector<int>> pairs_at;  ///< per crossing, one pair for each triangle at its edge
};

Graph crossingGraph(const ContactMesh& mesh, std::span<const Crossing> crossings) {
  struct End {
    int a, b, crossing;
  };
  std::vector<End> ends;
  for (std::size_t k = 0; k < crossings.size(); ++k)
    for (int f : mesh.edge_faces[crossings[k].edge]) {
      const auto [a, b] = std::minmax(f, crossings[k].triangle);
      ends.push_back({a, b, static_cast<int>(k)});
    }
  std::sort(ends.begin(), ends.end(), [](const End& p, const End& q) {
    return p.a != q.a ? p.a < q.a : p.b != q.b ? p.b < q.b : p.crossing < q.crossing;
  });
  Graph g;
  g.pairs_at.resize(crossings.size());
  for (std::size_t i = 0; i < ends.size();) {
    Pair pair{ends[i].a, ends[i].b, {}};
    pair.end = {-1, -1};
    std::size_t count = 0;
    for (; i < ends.size() && ends[i].a == pair.a && ends[i].b == pair.b; ++i) {
      assert(count < 2);  // see findCrossings
      pair.end[count++] = ends[i].crossing;
      g.pairs_at[ends[i].crossing].push_back(static_cast<int>(g.pairs.size()));
    }
    g.pairs.push_back(pair);
  }
  return g;
}

/// The vertex of the first triangle by which two hang together.
int sharedVertex(const ContactMesh& mesh, int a, int b) {
  for (int v : mesh.triangles[a])
    for (int w : mesh.triangles[b])
      if (v == w || mesh.areTwins(v, w)) return v;
  assert(false);
  return -1;
}

/// Does the face run through the edge from its lower to its higher vertex?
bool ascending(const ContactMesh& mesh, int face, int edge) {
  for (int k = 0; k < 3; ++k)
    if (mesh.face_edges[face][k] == edge) return mesh.triangles[face][k] == mesh.edges[edge][0];
  assert(false);
  return false;
}

/// ContourSegment::direction from the crossing at the segment's end (or start). Leaving face f, normal n, through its
/// edge p -> q by another triangle of normal n', the direction s (n x n') points out of f: s (n x n') . ((q - p) x n)
/// = -s |n|^2 n' . (q - p) > 0.
int directionAt(const ContactMesh& mesh, const std::array<int, 2>& face, const Crossing& c, bool at_end) {
  const int owner = c.triangle == face[1] ? 0 : 1;
  int s = ascending(mesh, face[owner], c.edge) ? -c.side : c.side;
  if (owner == 1) s = -s;  // n1 x n0
  return at_end ? s : -s;
}

class Tracer {
 public:
  Tracer(const ContactMesh& mesh, std::span<const Vec3> x, std::span<const Crossing> crossings)
      : mesh_(mesh), x_(x), crossings_(crossings), graph_(crossingGraph(mesh, crossings)) {
    used_.resize(graph_.pairs.size());
  }

  std::vector<Contour> all() {
    const int pairs = static_cast<int>(graph_.pairs.size());
    for (int p = 0; p < pairs; ++p)  // contours with ends, from either of them
      for (int k = 0; k < 2; ++k)
        if (!used_[p] && endsAt(graph_.pairs[p].end[k])) trace(p, k);
    for (int p = 0; p < pairs; ++p)
      if (!used_[p]) trace(p, 0);
    return std::move(contours_);
  }

 private:
  /// A contour goes on only where two triangles meet at the edge.
  bool endsAt(int crossing) const { return crossing < 0 || graph_.pairs_at[crossing].size() != 2; }

  ContourPoint point(int crossing, const std::array<int, 2>& face) const {
    ContourPoint p;
    if (crossing < 0) {
      p.vertex = sharedVertex(mesh_, face[0], face[1]);
      p.x = x_[p.vertex];
    } else {
      p = crossingPoint(mesh_, x_, crossings_[crossing].edge, crossings_[crossing].triangle);
      p.owner = p.triangle == face[1] ? 0 : 1;
    }
    return p;
  }

  bool onBorder(const ContourPoint& p, int surface) const {
    return p.vertex < 0 && p.owner == surface && mesh_.border(p.edge);
  }

  /// Leaves pair p, which it enters at end k.
  void trace(int p, int k) {
    Contour c;
    const int first = graph_.pairs[p].end[k];
    std::array<int, 2> face{graph_.pairs[p].a, graph_.pairs[p].b}, normal{1, 1};
    c.points.push_back(point(first, face));
    std::array<bool, 2> two_sided{true, true};
    for (;;) {
      used_[p] = 1;
      const Pair& pair = graph_.pairs[p];
      const int from = pair.end[k], to = pair.end[1 - k];
      const int direction =
          to >= 0 ? directionAt(mesh_, face, crossings_[to], true) : directionAt(mesh_, face, crossings_[from], false);
      c.segments.push_back({face, direction, normal});
      if (endsAt(to)) {
        c.points.push_back(point(to, face));
        break;
      }
      const auto& at = graph_.pairs_at[to];
      const int next = at[0] == p ? at[1] : at[0];
      const auto& [edge, triangle, side] = crossings_[to];
      const int owner = triangle == face[1] ? 0 : 1;
      const int across = graph_.pairs[next].a == triangle ? graph_.pairs[next].b : graph_.pairs[next].a;
      if (ascending(mesh_, across, edge) == ascending(mesh_, face[owner], edge)) normal[owner] = -normal[owner];
      face[owner] = across;
      if (to == first) {
        c.cyclic = true;
        const ContourSegment& start = c.segments.front();
        const bool same = start.face == face;  // else the two surfaces are one, exchanged by the cycle
        for (int s = 0; s < 2; ++s) two_sided[s] = same && normal[s] == start.normal[s];
        break;
      }
      c.points.push_back(point(to, c.segments.back().face));
      k = graph_.pairs[next].end[0] == to ? 0 : 1;
      p = next;
    }
    for (int s = 0; s < 2; ++s)
      c.closed[s] = c.cyclic ? two_sided[s] : onBorder(c.points.front(), s) && onBorder(c.points.back(), s);
    contours_.push_back(std::move(c));
  }

  const ContactMesh& mesh_;
  std::span<const Vec3> x_;
  std::span<const Crossing> crossings_;
  Graph graph_;
  std::vector<char> used_;
  std::vector<Contour> contours_;
};

}  // namespace

std::vector<Contour> traceContours(const ContactMesh& mesh, std::span<const Vec3> x,
                                   std::span<const Crossing> crossings) {
  return Tracer(mesh, x, crossings).all();
}

std::vector<Subchain> subchains(const Contour& c, int surface) {
  const int segments = static_cast<int>(c.segments.size()), points = static_cast<int>(c.points.size());
  const auto cuts = [&](int i) { return c.points[i].vertex < 0 && c.points[i].owner == surface; };
  int start = 0;
  if (c.cyclic) {
    while (start < points && !cuts(start)) ++start;
    if (start == points) return {{c.segments[0].face[surface], 0, segments, Subchain::kNoEdge}};
  }
  std::vector<Subchain> out;
  for (int done = 0; done < segments;) {
    const int first = (start + done) % points;
    int count = 0, i = first;
    do {
      i = c.next(i);
      ++count;
    } while (done + count < segments && !cuts(i));
    const Subchain::Type type = !cuts(first) || !cuts(i)                   ? Subchain::kEnds
                                : c.points[first].edge == c.points[i].edge ? Subchain::kOneEdge
                                                                           : Subchain::kTwoEdges;
    out.push_back({c.segments[first].face[surface], first, count, type});
    done += count;
  }
  return out;
}

}  // namespace gambeson
