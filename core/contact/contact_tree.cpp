#include "core/contact/contact_tree.hpp"
#include "core/math/parallel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace gambeson {
namespace {
constexpr int kChunk = 1024;    ///< nodes
constexpr int kHullCells = 16;  ///< hulls of so few cells are looked at cell by cell
}  // namespace

ContactTree::ContactTree(const ContactMesh& mesh, std::vector<GridChart> charts, std::span<const ChartCorners> corners,
                         std::span<const TriangleRange> obstacles, std::span<const Vec3> x)
    : charts_(std::move(charts)) {
  for (const ChartCorners& c : corners) {
    const double a = c[1].x - c[0].x, b = c[1].y - c[0].y, d = c[2].x - c[0].x, e = c[2].y - c[0].y;
    const double area2 = a * e - b * d;
    inverse_.push_back({e / area2, -b / area2, -d / area2, a / area2});
  }
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    cells_.emplace_back(charts_[k].whole.size());
    roots_.push_back(buildChart(mesh, static_cast<int>(k), {0, 0}, charts_[k].cells, corners));
  }
  findApart(corners);
  findLeaves(static_cast<int>(corners.size()));
  parts_.shrink_to_fit();
  std::vector<Vec3> centres;
  for (const auto& [a, b, c] : mesh.triangles) centres.push_back(x[a] + x[b] + x[c]);
  for (const TriangleRange& range : obstacles) {
    std::vector<int> triangles(range.end - range.first);
    std::iota(triangles.begin(), triangles.end(), range.first);
    if (!triangles.empty()) roots_.push_back(buildObstacle(mesh, triangles, centres));
  }
  for (const TriangleRange& range : obstacles)
    for (int t = range.first; t < range.end; ++t)
      for (int v : mesh.triangles[t]) first_obstacle_vertex_ = std::min(first_obstacle_vertex_, v);
  boxes_.resize(nodes_.size());
  tile_boxes_.resize(tiles_.size());
  leaf_of_tile_.resize(tiles_.size());
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i)
    if (nodes_[i].left < 0) std::fill_n(leaf_of_tile_.begin() + nodes_[i].first, nodes_[i].count, i);
  findChunks();
}

void ContactTree::setHalfReaches(std::span<const float> half_reach_m) {
  tile_half_reach_m_.clear();
  node_half_reach_m_.clear();
  const std::span<const float> cloth =
      half_reach_m.first(std::min<std::size_t>(half_reach_m.size(), first_obstacle_vertex_));
  const bool obstacles = roots_.size() > charts_.size();
  if (!obstacles && std::all_of(cloth.begin(), cloth.end(), [&](float s) { return s == cloth[0]; })) return;
  tile_half_reach_m_.assign(tiles_.size(), -1);
  node_half_reach_m_.assign(nodes_.size(), -1);
  for (std::size_t k = 0; k < tiles_.size(); ++k)
    for (int v : tiles_[k].vertex)
      if (v < first_obstacle_vertex_) tile_half_reach_m_[k] = std::max(tile_half_reach_m_[k], half_reach_m[v]);
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& n = nodes_[i];
    if (n.left >= 0)
      node_half_reach_m_[i] = std::max(node_half_reach_m_[n.left], node_half_reach_m_[n.right]);
    else
      for (int k = n.first; k < n.first + n.count; ++k)
        node_half_reach_m_[i] = std::max(node_half_reach_m_[i], tile_half_reach_m_[k]);
  }
}

/// Call before obstacles are added: nodes_ holds only cloth.
void ContactTree::findLeaves(int triangles) {
  parent_.assign(nodes_.size(), -1);
  touched_.assign(nodes_.size(), 0);
  leaf_of_.assign(triangles, -1);
  for (int i = 0; i < static_cast<int>(nodes_.size()); ++i) {
    const Node& n = nodes_[i];
    if (n.left >= 0) {
      parent_[n.left] = parent_[n.right] = i;
      continue;
    }
    for (int k = n.first; k < n.first + n.count; ++k)
      for (int t : tiles_[k].triangle)
        if (t >= 0) leaf_of_[t] = i;
  }
}

/// As far as a corner of the cell is from its diagonal.
void ContactTree::findApart(std::span<const ChartCorners> corners) {
  for (const GridChart& chart : charts_)
    for (int cell = 0; cell < chart.triangles.size(); ++cell) {
      if (!chart.whole[cell]) continue;
      Box box;
      for (const Vec2& corner : corners[chart.triangles[cell][0]]) box.add(Vec3{corner.x, corner.y, 0});
      const double a = box.hi.x - box.lo.x, b = box.hi.y - box.lo.y;
      apart_m_ = std::min(apart_m_, a * b / std::hypot(a, b));
    }
}

/// A node's descendants follow it without a gap.
void ContactTree::findChunks() {
  std::vector<int> end(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;)
    end[i] = nodes_[i].left < 0 ? static_cast<int>(i) + 1 : end[nodes_[i].right];
  for (int i = 0; i < static_cast<int>(nodes_.size());) {
    if (end[i] - i > kChunk) {
      above_.push_back(i++);
      continue;
    }
    chunks_.push_back({i, end[i]});
    i = end[i];
  }
}

/// Two triangles with a common edge: its ends become opposite corners.
void ContactTree::addTile(const ContactMesh& mesh, int first, int second) {
  const auto& [a, b, c] = mesh.triangles[first];
  Tile tile{{first, second}, {a, b, c, c}};
  if (second >= 0) {
    const auto& other = mesh.triangles[second];
    const auto common = [&](int v) { return std::find(other.begin(), other.end(), v) != other.end(); };
    // The corner that is not common goes first.
    tile.vertex = !common(a) ? std::array{a, b, a, c} : !common(b) ? std::array{b, c, b, a} : std::array{c, a, c, b};
    for (int v : other)
      if (v != a && v != b && v != c) tile.vertex[2] = v;
  }
  tiles_.push_back(tile);
}

int ContactTree::buildChart(const ContactMesh& mesh, int chart, std::array<int, 2> begin, std::array<int, 2> end,
                            std::span<const ChartCorners> corners) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  parts_.emplace_back();
  const GridChart& c = charts_[chart];
  Node node;
  Part part;
  node.chart = chart;
  std::copy_n(begin.begin(), 2, part.begin);
  std::copy_n(end.begin(), 2, part.end);
  const int axis = end[0] - begin[0] >= end[1] - begin[1] ? 0 : 1;
  if (end[axis] - begin[axis] <= 1) {
    const int cell = begin[0] + c.cells[0] * begin[1];
    const std::span<const int> triangles = c.triangles[cell];
    node.first = static_cast<int>(tiles_.size());
    node.whole = c.whole[cell];
    if (node.whole || (!c.has_grid && triangles.size() == 2))
      addTile(mesh, triangles[0], triangles[1]);
    else
      for (int t : triangles) addTile(mesh, t, -1);
    node.count = static_cast<int>(tiles_.size()) - node.first;
    for (int t : triangles)
      for (const Vec2& corner : corners[t]) part.rest.add(Vec3{corner.x, corner.y, 0});
  } else {
    const int middle = begin[axis] + (end[axis] - begin[axis]) / 2;
    std::array<int, 2> left_end = end, right_begin = begin;
    left_end[axis] = right_begin[axis] = middle;
    node.left = buildChart(mesh, chart, begin, left_end, corners);
    node.right = buildChart(mesh, chart, right_begin, end, corners);
    part.rest = parts_[node.left].rest;
    part.rest.add(parts_[node.right].rest);
    node.whole = nodes_[node.left].whole && nodes_[node.right].whole;
  }
  if (node.left >= 0) {
    node.first = nodes_[node.left].first;
    node.count = nodes_[node.left].count + nodes_[node.right].count;
  }
  nodes_[at] = node;
  parts_[at] = part;
  return at;
}

int ContactTree::buildObstacle(const ContactMesh& mesh, std::span<int> triangles, std::span<const Vec3> centres) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  if (triangles.size() == 1) {
    node.first = static_cast<int>(tiles_.size());
    node.count = 1;
    addTile(mesh, triangles[0], -1);
  } else {
    Box box;
    for (int t : triangles) box.add(centres[t]);
    const Vec3 h = box.halfSize();
    const int axis = h.x >= h.y && h.x >= h.z ? 0 : h.y >= h.z ? 1 : 2;
    const std::size_t middle = triangles.size() / 2;
    std::nth_element(triangles.begin(), triangles.begin() + static_cast<std::ptrdiff_t>(middle), triangles.end(),
                     [&](int a, int b) {
                       return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
                     });
    node.left = buildObstacle(mesh, triangles.first(middle), centres);
    node.right = buildObstacle(mesh, triangles.subspan(middle), centres);
    node.first = nodes_[node.left].first;
    node.count = nodes_[node.left].count + nodes_[node.right].count;
  }
  nodes_[at] = node;
  return at;
}

namespace {
Four single(const Vec3& v) {
  return Four{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
}  // namespace

ContactTree::Gradient ContactTree::gradient(const ContactMesh& mesh, int triangle, const ListedMotion& m) const {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto& [ia, ib, ic, id] = inverse_[triangle];
  const Vec3 e = m.x[b] - m.x[a], f = m.x[c] - m.x[a];
  const double half = 0.5 * m.horizon_s;
  const Vec3 de = half * (m.velocity(b) - m.velocity(a)), df = half * (m.velocity(c) - m.velocity(a));
  const double change = std::sqrt(norm2(ia * de + ib * df) + norm2(ic * de + id * df));
  return {single(ia * (e + de) + ib * (f + df)), single(ic * (e + de) + id * (f + df)), static_cast<float>(change)};
}

ContactTree::Cluster ContactTree::cellCluster(std::span<const int> triangles) const {
  const Gradient &a = gradients_[triangles[0]], &b = gradients_[triangles[1]];
  return merge({a.s, a.t, a.change}, {b.s, b.t, b.change});
}

ContactTree::Cluster ContactTree::merge(const Cluster& a, const Cluster& b) {
  Cluster out;
  out.s = all(0.5f) * (a.s + b.s), out.t = all(0.5f) * (a.t + b.t);
  out.spread = std::max(a.spread, b.spread) + 0.5f * distance(a, b);
  return out;
}

/// Points and boxes of the vertices; whether any vertex of an obstacle moved or may move otherwise than before.
bool ContactTree::placePoints(const ListedMotion& motion) {
  const std::size_t n = motion.x.size();
  const bool known = vertex_boxes_.size() == n;
  vertex_boxes_.resize(n);
  points_.resize(n);
  off_m_.assign(n, 0);
  shape_error_m_ = 0;
  if (n == 0) return false;
  origin_ = motion.x[0];
  const int count = static_cast<int>(n);
  struct Placed {
    bool changed = false;
    float error = 0;
  };
  const auto place = [&](int i) {
    const MovingBox before = vertex_boxes_[i];
    placePoint(motion, i);
    return Placed{i >= first_obstacle_vertex_ && !(vertex_boxes_[i] == before), shapeError(points_[i])};
  };
  const Placed all = joined(Each::value, count, Placed{!known, 0}, place, [](const Placed& a, const Placed& b) {
    return Placed{a.changed || b.changed, std::max(a.error, b.error)};
  });
  shape_error_m_ = all.error;
  return all.changed;
}

void ContactTree::placePoint(const ListedMotion& motion, int vertex) {
  vertex_boxes_[vertex] = MovingBox(motion, vertex);
  const Vec3 now = motion.x[vertex] - origin_;
  points_[vertex] = {single(now), single(now + motion.horizon_s * motion.velocity(vertex))};
}

/// Each coordinate is off by 2^-24 of itself, a sum of three products by four times that; two of them make a distance.
float ContactTree::shapeError(const MovingPoint& p) {
  return 2e-6f * mostOf(most(most(p.now, -p.now), most(p.then, -p.then)))[0] + 1e-9f;
}

void ContactTree::refit(const ContactMesh& mesh, const ListedMotion& motion) {
  const bool obstacles_changed = placePoints(motion);
  gradients_.resize(inverse_.size());
  const int triangles = static_cast<int>(inverse_.size()), chunks = static_cast<int>(chunks_.size());
  forAll(Each::value, triangles, [&](int t) { gradients_[t] = gradient(mesh, t, motion); });
  const int end = static_cast<int>(obstacles_changed ? nodes_.size() : parts_.size());
  forAllUneven(Each::much, chunks, [&](int g) {
    for (int i = std::min(chunks_[g][1], end); i-- > chunks_[g][0];) refitNode(i, motion);
  });
  for (std::size_t k = above_.size(); k-- > 0;)
    if (above_[k] < end) refitNode(above_[k], motion);
}

/// Call after the children of the node are refitted.
void ContactTree::refitNode(int i, const ListedMotion& motion) {
  const Node& n = nodes_[i];
  if (n.left < 0) {
    refitLeaf(i, motion);
    if (!n.whole) return;
    Part& part = parts_[i];
    part.cluster = cellCluster(tiles_[n.first].triangle);
    cells_[n.chart][part.begin[0] + charts_[n.chart].cells[0] * part.begin[1]] = part.cluster;
    return;
  }
  boxes_[i] = boxes_[n.left];
  boxes_[i].add(boxes_[n.right]);
  if (n.chart < 0) return;
  parts_[i].aside_m = std::max(parts_[n.left].aside_m, parts_[n.right].aside_m);
  if (n.whole) parts_[i].cluster = merge(parts_[n.left].cluster, parts_[n.right].cluster);
}

/// What vertices may do.
void ContactTree::refitLeaf(int i, const ListedMotion& motion) {
  const Node& n = nodes_[i];
  boxes_[i] = {};
  for (int k = n.first; k < n.first + n.count; ++k) {
    const MovingBox box = boxOf(tiles_[k].vertex);
    tile_boxes_.set(k, box);
    boxes_[i].add(box);
  }
  if (n.chart < 0) return;
  float& aside = parts_[i].aside_m;
  aside = 0;
  for (int k = n.first; k < n.first + n.count; ++k)
    for (int v : tiles_[k].vertex) aside = std::max(aside, roundUp(off_m_[v] + motion.slack(v)));
}

void ContactTree::refitSome(const ContactMesh& mesh, const ListedMotion& motion, std::span<const int> vertices) {
  for (int leaf : touched_leaves_) touched_[leaf] = 0;
  touched_leaves_.clear();
  for (int v : vertices) {
    const MovingPoint before = points_[v];
    placePoint(motion, v);
    const auto far2 = [](const Four& d) { return TileShape::dot(d, d); };
    const float off2 = std::max(far2(points_[v].now - before.now), far2(points_[v].then - before.then));
    const float error = std::max(shapeError(before), shapeError(points_[v]));
    off_m_[v] = roundUp(off_m_[v] + 1.000001 * std::sqrt(off2) + error);
    shape_error_m_ = std::max(shape_error_m_, error);
    for (int t : mesh.vertex_faces[v])
      if (!std::exchange(touched_[leaf_of_[t]], 1)) touched_leaves_.push_back(leaf_of_[t]);
  }
  std::sort(touched_leaves_.begin(), touched_leaves_.end());
  for (int leaf : touched_leaves_) {
    refitLeaf(leaf, motion);
    // Those above hold what was there too: that is no less.
    for (int i = parent_[leaf]; i >= 0; i = parent_[i]) {
      boxes_[i].add(boxes_[leaf]);
      parts_[i].aside_m = std::max(parts_[i].aside_m, parts_[leaf].aside_m);
    }
  }
}

Box ContactTree::reachOfCloth(const PairRules& rules) const {
  Box box;
  for (std::size_t k = 0; k < charts_.size(); ++k) box.add(boxes_[roots_[k]].points());
  return box.grown(rules.margin_m);
}

bool ContactTree::certifies(const Cluster& cluster, double least) {
  const double ss = TileShape::dot(cluster.s, cluster.s), tt = TileShape::dot(cluster.t, cluster.t);
  // Without dividing. A part in a thousand, and a part in a hundred thousand of the largest, for the rounding of all
  // this: far more than it is.
  const double half = 0.5 * (ss + tt), needed = least + 1.001 * cluster.spread + 1e-5 * std::sqrt(2 * half);
  if (!(half > needed * needed)) return false;  // s1 >= c + R, and s2 no more than s1
  const double st = TileShape::dot(cluster.s, cluster.t);
  const double root = std::sqrt(0.25 * (ss - tt) * (ss - tt) + st * st), least2 = 0.999 * (half - root);
  return least2 > 0 && least2 * least2 >= (half + root) * needed * needed;
}

bool ContactTree::hullCertifies(int ia, int ib, double least) const {
  const Part &a = parts_[ia], &b = parts_[ib];
  const int i0 = std::min(a.begin[0], b.begin[0]), i1 = std::max(a.end[0], b.end[0]);
  const int j0 = std::min(a.begin[1], b.begin[1]), j1 = std::max(a.end[1], b.end[1]);
  const long cells = static_cast<long>(i1 - i0) * (j1 - j0);
  const auto count = [](const Part& n) { return static_cast<long>(n.end[0] - n.begin[0]) * (n.end[1] - n.begin[1]); };
  if (nodes_[ia].whole && nodes_[ib].whole && cells == count(a) + count(b))
    return certifies(merge(a.cluster, b.cluster), least);
  if (cells > kHullCells) return false;
  const GridChart& chart = charts_[nodes_[ia].chart];
  const std::vector<Cluster>& clusters = cells_[nodes_[ia].chart];
  Cluster hull;
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      const int cell = i + chart.cells[0] * j;
      if (!chart.whole[cell]) return false;
      hull.s += clusters[cell].s;
      hull.t += clusters[cell].t;
    }
  const Four share = all(1.0f / static_cast<float>(cells));
  hull.s *= share, hull.t *= share;
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      const Cluster& c = clusters[i + chart.cells[0] * j];
      hull.spread = std::max(hull.spread, c.spread + distance(c, hull));
    }
  return certifies(hull, least);
}

/// Points whose distance at rest is D, at least `rest`, are c D apart on their paths: enough are those that are farther
/// apart than the margin, or than the share `least` of D.
bool ContactTree::coveredBetween(int ia, int ib, double margin_m, double least) const {
  if (nodes_[ia].chart < 0 || nodes_[ia].chart != nodes_[ib].chart) return false;
  const Part &a = parts_[ia], &b = parts_[ib];
  const double rest = std::max(restDistance(a.rest, b.rest), apart_m_);
  return hullCertifies(ia, ib, std::min(least, margin_m / rest) + (static_cast<double>(a.aside_m) + b.aside_m) / rest);
}

bool ContactTree::certifiedWithin(int node, double margin_m, double least) const {
  return certifies(parts_[node].cluster, std::min(least, margin_m / apart_m_) + 2.0 * parts_[node].aside_m / apart_m_);
}

std::vector<ContactTree::Search> ContactTree::searchesOfTouched() const {
  std::vector<Search> found;
  for (int leaf : touched_leaves_) found.push_back({leaf, Search::kAround, false});
  return found;
}

std::vector<ContactTree::Search> ContactTree::searches(const PairRules& rules, int parts) const {
  std::vector<Search> found, next;
  const int charts = static_cast<int>(charts_.size()), roots = static_cast<int>(roots_.size());
  for (int i = 0; i < charts; ++i) {
    if (rules.cloth_with_cloth) found.push_back({roots_[i]});
    for (int j = rules.cloth_with_cloth ? i + 1 : charts; j < roots; ++j)
      found.push_back({roots_[i], roots_[j], false});
  }
  // What Traversal does first, level by level.
  const float widest = roundUp(rules.margin_m);
  bool opened = true;
  while (opened && static_cast<int>(found.size()) < parts) {
    opened = false;
    next.clear();
    for (const Search& s : found) {
      const Node& a = nodes_[s.a];
      if (s.b < 0) {
        if (a.left < 0) {
          next.push_back(s);
        } else if (!a.whole || !certifiedWithin(s.a, reachOf(rules, widest, s.a, s.a), rules.least)) {
          next.insert(next.end(), {{a.left}, {a.right}, {a.left, a.right, a.whole}});
          opened = true;
        }
        continue;
      }
      const Node& b = nodes_[s.b];
      const float reach = reachOf(rules, widest, s.a, s.b);
      if (!mayMeet(boxes_[s.a], boxes_[s.b], reach)) continue;
      if (a.left < 0 && b.left < 0) {
        next.push_back(s);
        continue;
      }
      if (!s.asked && coveredBetween(s.a, s.b, reach, rules.least)) continue;
      if (opensFirst(s.a, s.b))
        next.insert(next.end(), {{a.left, s.b, false}, {a.right, s.b, false}});
      else
        next.insert(next.end(), {{s.a, b.left, false}, {s.a, b.right, false}});
      opened = true;
    }
    found.swap(next);
  }
  return found;
}

}  // namespace gambeson
