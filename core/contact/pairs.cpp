#include "core/contact/pairs.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/contact/four_pairs.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {
namespace {

constexpr unsigned char kAllBlunt = 63;
constexpr int kManyTiles = 256;  ///< likewise of a search
constexpr int kManyLeaves = 16;  ///< and of one around some leaves
constexpr int kParts = 64;       ///< of a search, for each thread

/// Pairs whose boxes may meet, looked at four at a time. A: corners of the first primitive.
template <int A>
class Batch {
 public:
  Batch(const ContactTree& tree, double horizon_s) : tree_(tree), horizon_s_(horizon_s) {}

  /// found(a, b, apart) for those that may come within their margins.
  template <class Found>
  void add(int a, int b, const std::array<int, 4>& vertex, double margin_m, Found&& found) {
    pair_[count_] = {a, b};
    vertex_[count_] = vertex;
    margin_m_[count_] = margin_m;
    if (++count_ == 4) look(found);
  }
  template <class Found>
  void look(Found&& found) {
    if (count_ == 0) return;
    for (int k = count_; k < 4; ++k) vertex_[k] = vertex_[0];
    const FourGaps gaps = gapsOf<A>(tree_.points(), vertex_);
    for (int k = 0; k < count_; ++k) {
      const float now = gaps.now[k] - tree_.shapeError_m(), then = gaps.then[k] - tree_.shapeError_m();
      if (std::min(now, then) > margin_m_[k]) continue;
      // Gaps along a direction are the least of functions linear in time, and so lie above their chords.
      const double closing = horizon_s_ > 0 ? (static_cast<double>(now) - then) / horizon_s_ : 0;
      found(pair_[k][0], pair_[k][1], Apart{now, static_cast<float>(closing + 1e-6 * std::abs(closing))});
    }
    count_ = 0;
  }

 private:
  const ContactTree& tree_;
  double horizon_s_;
  int count_ = 0;
  std::array<std::array<int, 2>, 4> pair_;
  std::array<std::array<int, 4>, 4> vertex_;
  std::array<double, 4> margin_m_;
};

/// n or -n, which points along `way`.
Four facing(const Four& n, const Four& way) { return TileShape::dot(n, way) < 0 ? -n : n; }

/// The search between the primitives of two tiles that nothing has separated.
class Primitives {
  auto foundPoint() {
    return [this](int v, int t, const Apart& gap) { out_.points.push_back({v, t, gap}); };
  }
  auto foundEdges() {
    return [this](int e, int f, const Apart& gap) { out_.edges.push_back({e, f, gap}); };
  }

 public:
  Primitives(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion, const PairRules& rules,
             std::span<const unsigned char> owned, std::span<const unsigned char> blunt, CandidatePairs::OfThread& out)
      : mesh_(mesh), tree_(tree), motion_(motion), rules_(rules), owned_(owned), blunt_(blunt), out_(out) {}
  /// Looks at the pairs that still wait for a full vector of four.
  void finish() {
    points_.look(foundPoint());
    edges_.look(foundEdges());
  }

  /// `beyond`: that far apart the two are, but for what they may leave their paths by.
  void point(int a, int k, int t, const MovingBox& box, double beyond) {
    const bool blunt = blunt_[a] & (1 << k);
    const int v = mesh_.triangles[a][k];
    const std::array<int, 3>& c = mesh_.triangles[t];
    const double margin = marginOf(blunt) + motion_.slack(v) + slackOf(c);
    if (beyond > margin || mesh_.hangTogether(std::array{v}, c)) return;
    if (!mayMeet(tree_.vertexBox(v), box, reachOf(blunt))) return;
    points_.add(v, t, {v, c[0], c[1], c[2]}, margin, foundPoint());
  }
  void points(int a, int t, const MovingBox& box, double beyond) {
    for (int k = 0; k < 3; ++k)
      if (owned_[a] & (1 << k)) point(a, k, t, box, beyond);
  }

  /// Edge k of triangle a against those of a triangle b.
  void edges(int a, int k, int b, const MovingBox& box, double beyond) {
    const int e = mesh_.face_edges[a][k];
    const std::array<int, 2>& v = mesh_.edges[e];
    const double slack = slackOf(v);
    for (int l = 0; l < 3; ++l) {
      if (!(owned_[b] & (8 << l))) continue;
      const int f = mesh_.face_edges[b][l];
      const bool blunt = (blunt_[a] & (8 << k)) || (blunt_[b] & (8 << l));
      const std::array<int, 2>& y = mesh_.edges[f];
      const double margin = marginOf(blunt) + slack + slackOf(y);
      if (beyond > margin || mesh_.hangTogether(v, y)) continue;
      if (!mayMeet(box, tree_.boxOf(y), reachOf(blunt))) continue;
      edges_.add(std::min(e, f), std::max(e, f), {v[0], v[1], y[0], y[1]}, margin, foundEdges());
    }
  }

  /// Two tiles whose boxes may meet; i == j: the two triangles of one.
  template <class Covered>
  void tiles(int i, int j, Covered&& covered) {
    const std::span<const Tile> tiles = tree_.tiles();
    const std::span<const int> as = tiles[i].triangle, bs = tiles[j].triangle;
    wide_margin_m_ = tree_.marginOf(rules_, i, j);
    wide_reach_ = roundUp(wide_margin_m_);
    if (i == j) {
      between(as.first(1), as.last(1), 0);
      return;
    }
    const TileShape &a = shape(i), &b = shape(j);
    const double slack = out_.slacks[i] + out_.slacks[j], far = wide_margin_m_ + slack;
    const auto certain = [&](const Four& gap) { return leastOf(gap)[0] * (1 - 1e-6) - tree_.shapeError_m(); };
    const Four way = a.centre - b.centre;
    if (bs[1] < 0 && blunt_[bs[0]] == kAllBlunt) {
      // A body carries samples on its faces; all else of it meets in impacts only.
      const double near = rules_.blunt_margin_m + slack;
      const Four corners = beyond(a, b, facing(b.normal, way));
      double gap = certain(corners);
      if (gap > far) return;
      if (!(gap > near)) gap = std::max(gap, certain(beyond(a, b, TileShape::unit(way))));
      if (!(gap > near)) gap = std::max(gap, certain(beyond(a, b, facing(a.normal, way))));
      if (gap > far) return;
      if (!(gap > near)) {
        between(as, bs, gap);
        return;
      }
      const MovingBox box = tree_.boxOf(mesh_.triangles[bs[0]]);
      for (int t : as)
        for (int k = 0; t >= 0 && k < 3; ++k) {
          if (!(owned_[t] & (1 << k))) continue;
          const auto at = std::find(tiles[i].vertex.begin(), tiles[i].vertex.end(), mesh_.triangles[t][k]);
          const float height = corners[at - tiles[i].vertex.begin()];
          point(t, k, bs[0], box, std::max(gap, certain(all(height))));
        }
      return;
    }
    // Parts of one sheet side by side, then sheets over each other.
    double gap = certain(beyond(a, b, TileShape::unit(way)));
    if (gap > far) return;
    gap = std::max(gap, certain(beyond(a, b, facing(b.normal, way))));
    if (gap > far || covered()) return;
    between(as, bs, gap);
  }

 private:
  const TileShape& shape(int i) {
    if (!std::exchange(out_.shaped[i], 1)) {
      out_.shapes[i] = tree_.shape(i);
      out_.slacks[i] = slackOf(tree_.tiles()[i].vertex);
    }
    return out_.shapes[i];
  }

  /// Looks at each primitive of the triangles `as` with each of the triangles `bs`.
  void between(std::span<const int> as, std::span<const int> bs, double beyond) {
    MovingBox of_b;
    for (int b : bs) {
      if (b < 0) continue;
      const MovingBox box = tree_.boxOf(mesh_.triangles[b]);
      of_b.add(box);
      for (int a : as)
        if (a >= 0) points(a, b, box, beyond);
    }
    for (int a : as) {
      if (a < 0) continue;
      const MovingBox box = tree_.boxOf(mesh_.triangles[a]);
      for (int b : bs)
        if (b >= 0) points(b, a, box, beyond);
      for (int k = 0; k < 3; ++k) {
        if (!(owned_[a] & (8 << k))) continue;
        const MovingBox edge = tree_.boxOf(mesh_.edges[mesh_.face_edges[a][k]]);
        if (!mayMeet(edge, of_b, wide_reach_)) continue;
        for (int b : bs)
          if (b >= 0) edges(a, k, b, edge, beyond);
      }
    }
  }

  double marginOf(bool blunt) const { return blunt ? rules_.blunt_margin_m : wide_margin_m_; }
  float reachOf(bool blunt) const { return blunt ? narrow_reach_ : wide_reach_; }
  template <std::size_t N>
  double slackOf(const std::array<int, N>& vertices) const {
    double most = 0;
    for (int v : vertices) most = std::max(most, motion_.slack(v));
    return most;
  }

  const ContactMesh& mesh_;
  const ContactTree& tree_;
  const ListedMotion& motion_;
  const PairRules& rules_;
  std::span<const unsigned char> owned_, blunt_;
  CandidatePairs::OfThread& out_;
  Batch<1> points_{tree_, motion_.horizon_s};
  Batch<2> edges_{tree_, motion_.horizon_s};
  const float narrow_reach_ = roundUp(rules_.blunt_margin_m);
  double wide_margin_m_ = 0;  ///< of the two tiles that are looked at
  float wide_reach_ = 0;
};

/// Moves out.unsorted to out.points, sorted by vertex and then by triangle, and fills out.first_of_vertex.
void sortPoints(int vertex_count, CandidatePairs& out) {
  out.points.resize(out.unsorted.size());
  std::vector<int>& first = out.first_of_vertex;
  first.assign(vertex_count + 1, 0);
  for (const PointTriangle& p : out.unsorted) ++first[p.vertex + 1];
  for (int v = 0; v < vertex_count; ++v) first[v + 1] += first[v];
  for (const PointTriangle& p : out.unsorted) out.points[first[p.vertex]++] = p;
  // Of each vertex the first now is where it ends.
  forAll(Each::value, vertex_count,
         [&](int v) { std::sort(out.points.begin() + (v > 0 ? first[v - 1] : 0), out.points.begin() + first[v]); });
}

}  // namespace

PairCollector::PairCollector(const ContactMesh& mesh, const BluntFeatures& blunt) : owned_(mesh.triangles.size(), 0) {
  std::vector<char> vertex_taken(mesh.vertex_count, 0), edge_taken(mesh.edges.size(), 0);
  blunt_.resize(mesh.triangles.size(), 0);
  vertex_owner_.resize(mesh.vertex_count);
  edge_owner_.resize(mesh.edges.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int vertex = mesh.triangles[t][k], edge = mesh.face_edges[t][k];
      if (!std::exchange(vertex_taken[vertex], 1)) {
        owned_[t] |= 1 << k;
        vertex_owner_[vertex] = static_cast<int>(t);
      }
      if (!std::exchange(edge_taken[edge], 1)) {
        owned_[t] |= 8 << k;
        edge_owner_[edge] = static_cast<int>(t);
      }
      if (!blunt.vertex.empty() && blunt.vertex[vertex]) blunt_[t] |= 1 << k;
      if (!blunt.edge.empty() && blunt.edge[edge]) blunt_[t] |= 8 << k;
    }
}

void PairCollector::collect(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion,
                            const PairRules& rules, CandidatePairs& out, const BluntFeatures* also_blunt) const {
  out.blunt.clear();
  if (also_blunt) {
    out.blunt.resize(blunt_.size());
    const int n = static_cast<int>(blunt_.size());
    forAll(Each::value, n, [&](int t) {
      unsigned char bits = blunt_[t];
      for (int k = 0; k < 3; ++k)
        bits |= static_cast<unsigned char>((also_blunt->vertex[mesh.triangles[t][k]] ? 1 << k : 0) |
                                           (also_blunt->edge[mesh.face_edges[t][k]] ? 8 << k : 0));
      // What a triangle does not own does not come up with it.
      out.blunt[t] = bits == 0 ? bits : static_cast<unsigned char>(bits | (kAllBlunt & ~owned_[t]));
    });
  }
  const int threads = std::ssize(tree.tiles()) > kManyTiles ? omp_get_max_threads() : 1;
  out.edges.clear();
  search(mesh, tree, motion, rules, tree.searches(rules, threads > 1 ? kParts * threads : 1), threads, out);
  sortPoints(mesh.vertex_count, out);
}

void PairCollector::mend(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion,
                         const PairRules& rules, CandidatePairs& out) const {
  forAllUneven(Each::much, 2, [&](int k) {
    if (k == 0)
      std::erase_if(out.points, [&](const PointTriangle& p) {
        return tree.touched(p.triangle) || tree.touched(vertex_owner_[p.vertex]);
      });
    else
      std::erase_if(out.edges, [&](const EdgeEdge& p) {
        return tree.touched(edge_owner_[p.a]) || tree.touched(edge_owner_[p.b]);
      });
  });
  const std::vector<ContactTree::Search> searches = tree.searchesOfTouched();
  search(mesh, tree, motion, rules, searches, std::ssize(searches) > kManyLeaves ? omp_get_max_threads() : 1, out);
  std::sort(out.unsorted.begin(), out.unsorted.end());
  const std::ptrdiff_t kept = std::ssize(out.points);
  out.points.insert(out.points.end(), out.unsorted.begin(), out.unsorted.end());
  std::inplace_merge(out.points.begin(), out.points.begin() + kept, out.points.end());
}

/// Of the points all that they find, in out.unsorted; edges go behind those that are there.
void PairCollector::search(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion,
                           const PairRules& rules, std::span<const ContactTree::Search> searches, int threads,
                           CandidatePairs& out) const {
  const std::span<const unsigned char> blunt = out.blunt.empty() ? blunt_ : out.blunt;
  const int count = static_cast<int>(searches.size()), tile_count = static_cast<int>(tree.tiles().size());
  out.found.assign(count, {});
  if (static_cast<int>(out.of_thread.size()) < threads) out.of_thread.resize(threads);
  const auto begin = [&](int me) {
    CandidatePairs::OfThread& mine = out.of_thread[me];
    mine.points.clear();
    mine.edges.clear();
    mine.shapes.resize(tile_count);
    mine.slacks.resize(tile_count);
    mine.shaped.assign(tile_count, 0);
    return Primitives(mesh, tree, motion, rules, owned_, blunt, mine);
  };
  forAllInTeam(threads, count, begin, [&](Primitives& primitives, int me, int k) {
    const CandidatePairs::OfThread& mine = out.of_thread[me];
    CandidatePairs::Found& found = out.found[k];
    found.thread = me;
    found.first_point = mine.points.size();
    found.first_edge = mine.edges.size();
    tree.pairs(rules, searches[k], [&](int i, int j, auto&& covered) { primitives.tiles(i, j, covered); });
    primitives.finish();
    found.end_point = mine.points.size();
    found.end_edge = mine.edges.size();
  });
  std::size_t points = 0, edges = out.edges.size();
  for (CandidatePairs::Found& f : out.found) {
    f.points_at = points;
    f.edges_at = edges;
    points += f.end_point - f.first_point;
    edges += f.end_edge - f.first_edge;
  }
  out.unsorted.resize(points);
  out.edges.resize(edges);
  forAll(threads > 1 ? Each::much : Each::value, count, [&](int k) {
    const CandidatePairs::Found& f = out.found[k];
    const CandidatePairs::OfThread& mine = out.of_thread[f.thread];
    std::copy(mine.points.begin() + f.first_point, mine.points.begin() + f.end_point,
              out.unsorted.begin() + f.points_at);
    std::copy(mine.edges.begin() + f.first_edge, mine.edges.begin() + f.end_edge, out.edges.begin() + f.edges_at);
  });
}

}  // namespace gambeson
