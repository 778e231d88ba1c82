#include "core/contact/contact_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace gambeson {
namespace {
constexpr int kMany = 4096;     ///< from which on threads share the work
constexpr int kGroup = 1024;    ///< nodes
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
  findSides(mesh, corners);
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
  findGroups();
}

void ContactTree::setShares(std::span<const float> share_m) {
  tile_share_m_.clear();
  node_share_m_.clear();
  const std::span<const float> cloth = share_m.first(std::min<std::size_t>(share_m.size(), first_obstacle_vertex_));
  if (std::all_of(cloth.begin(), cloth.end(), [&](float s) { return s == cloth[0]; })) return;
  tile_share_m_.assign(tiles_.size(), -1);
  node_share_m_.assign(nodes_.size(), -1);
  for (std::size_t k = 0; k < tiles_.size(); ++k)
    for (int v : tiles_[k].vertex)
      if (v < first_obstacle_vertex_) tile_share_m_[k] = std::max(tile_share_m_[k], share_m[v]);
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    const Node& n = nodes_[i];
    if (n.left >= 0)
      node_share_m_[i] = std::max(node_share_m_[n.left], node_share_m_[n.right]);
    else
      for (int k = n.first; k < n.first + n.count; ++k) node_share_m_[i] = std::max(node_share_m_[i], tile_share_m_[k]);
  }
}

/// A node's descendants follow it without a gap.
void ContactTree::findGroups() {
  std::vector<int> end(nodes_.size());
  for (std::size_t i = nodes_.size(); i-- > 0;)
    end[i] = nodes_[i].left < 0 ? static_cast<int>(i) + 1 : end[nodes_[i].right];
  for (int i = 0; i < static_cast<int>(nodes_.size());) {
    if (end[i] - i > kGroup) {
      above_.push_back(i++);
      continue;
    }
    groups_.push_back({i, end[i]});
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
    if (node.whole)
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
  }
  nodes_[at] = node;
  return at;
}

ContactTree::Gradient ContactTree::gradient(const ContactMesh& mesh, int triangle, std::span<const Vec3> x) const {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const auto& [ia, ib, ic, id] = inverse_[triangle];
  const Vec3 e = x[b] - x[a], f = x[c] - x[a];
  return {ia * e + ib * f, ic * e + id * f};
}

namespace {
Four single(const Vec3& v) {
  return Four{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
}
}  // namespace

ContactTree::Cluster ContactTree::cellCluster(std::span<const int> triangles, std::span<const double> change) const {
  const Gradient &a = gradients_[triangles[0]], &b = gradients_[triangles[1]];
  Cluster out = merge({single(a.s), single(a.t), 0}, {single(b.s), single(b.t), 0});
  if (!change.empty()) out.spread += static_cast<float>(std::max(change[triangles[0]], change[triangles[1]]));
  return out;
}

void ContactTree::gradientChanges(const ContactMesh& mesh, std::span<const Vec3> x0, std::span<const Vec3> x1,
                                  std::vector<double>& out) const {
  out.resize(inverse_.size());
  const int n = static_cast<int>(inverse_.size());
#pragma omp parallel for schedule(static) if (n > kMany)
  for (int t = 0; t < n; ++t) {
    const Gradient a = gradient(mesh, t, x0), b = gradient(mesh, t, x1);
    out[t] = std::sqrt(norm2(b.s - a.s) + norm2(b.t - a.t));
  }
}

/// The sides of cells along the axes: the columns of F are their quotients by their lengths at rest.
void ContactTree::findSides(const ContactMesh& mesh, std::span<const ChartCorners> corners) {
  triangle_sides_.assign(corners.size(), {-1, -1});
  struct Found {
    int a, b, triangle, axis;
    float length;
  };
  std::vector<Found> found;
  for (const Tile& tile : tiles_)
    for (int t : tile.triangle) {
      if (tile.triangle[1] < 0) continue;
      for (int i = 0; i < 3; ++i) {
        const Vec2 along{corners[t][(i + 1) % 3].x - corners[t][i].x, corners[t][(i + 1) % 3].y - corners[t][i].y};
        const double length = std::max(std::abs(along.x), std::abs(along.y));
        if (std::min(std::abs(along.x), std::abs(along.y)) > 1e-9 * length) continue;  // the diagonal
        const auto [v, w] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
        found.push_back({v, w, t, along.x == 0 || std::abs(along.x) < std::abs(along.y), static_cast<float>(length)});
      }
    }
  std::sort(found.begin(), found.end(), [](const Found& p, const Found& q) {
    return std::tie(p.a, p.b, p.length, p.triangle) < std::tie(q.a, q.b, q.length, q.triangle);
  });
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Found& f = found[k];
    if (k == 0 || f.a != found[k - 1].a || f.b != found[k - 1].b || f.length != found[k - 1].length)
      sides_.push_back({f.a, f.b, f.length});
    triangle_sides_[f.triangle][f.axis] = static_cast<int>(sides_.size()) - 1;
  }
  sides_then_.resize(sides_.size());
  std::vector<std::vector<int>> triangles(sides_.size());
  for (std::size_t t = 0; t < triangle_sides_.size(); ++t)
    for (int k : triangle_sides_[t])
      if (k >= 0) triangles[k].push_back(static_cast<int>(t));
  for (const std::vector<int>& of_side : triangles) {
    side_triangles_.items.insert(side_triangles_.items.end(), of_side.begin(), of_side.end());
    side_triangles_.first.push_back(static_cast<int>(side_triangles_.items.size()));
  }
}

/// Each column may change by 1/sqrt(2) of what the triangle may.
void ContactTree::watchSides(std::span<const Vec3> x, std::span<const double> change) {
  const int n = static_cast<int>(sides_.size());
#pragma omp parallel for schedule(static) if (n > kMany)
  for (int k = 0; k < n; ++k) {
    const Vec3 d = x[sides_[k].b] - x[sides_[k].a];
    float most2 = std::numeric_limits<float>::infinity();
    for (int t : side_triangles_[k]) {
      // Less by the rounding of all this: that of the sides is 1e-7 of them.
      const float most = (0.7071f * static_cast<float>(change.empty() ? 0 : change[t]) - 1e-5f) * sides_[k].length_m;
      most2 = std::min(most2, most > 0 ? most * most : -1.0f);
    }
    sides_then_[k] = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z), most2};
  }
}

bool ContactTree::gradientsHold(std::span<const Vec3> x) const {
  const int n = static_cast<int>(sides_.size());
  const auto holds = [&](int k) {
    const SideThen& then = sides_then_[k];
    const Vec3 d = x[sides_[k].b] - x[sides_[k].a];
    const float dx = static_cast<float>(d.x) - then.x, dy = static_cast<float>(d.y) - then.y,
                dz = static_cast<float>(d.z) - then.z;
    return dx * dx + dy * dy + dz * dz <= then.most2;
  };
  int fail = 0;
  if (n > kMany) {
#pragma omp parallel for schedule(static) reduction(+ : fail)
    for (int k = 0; k < n; ++k) fail += !holds(k);
  } else {
    for (int k = 0; k < n && fail == 0; ++k) fail = !holds(k);
  }
  return fail == 0;
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
  if (n == 0) return false;
  const Vec3 origin = motion.x[0];
  const int count = static_cast<int>(n);
  int changes = !known;
  Four far{};
#pragma omp parallel if (count > kMany) reduction(+ : changes)
  {
    Four mine{};
#pragma omp for schedule(static)
    for (int i = 0; i < count; ++i) {
      const MovingBox box(motion, i);
      changes += i >= first_obstacle_vertex_ && !(box == vertex_boxes_[i]);
      vertex_boxes_[i] = box;
      const Vec3 now = motion.x[i] - origin, then = now + motion.horizon_s * motion.velocity(i);
      MovingPoint& p = points_[i];
      p.now = single(now);
      p.then = single(then);
      mine = most(mine, most(most(p.now, -p.now), most(p.then, -p.then)));
    }
#pragma omp critical
    far = most(far, mine);
  }
  // Each coordinate is off by 2^-24 of itself, a sum of three products by four times that; two of them make a distance.
  shape_error_m_ = 2e-6f * mostOf(far)[0] + 1e-9f;
  return changes > 0;
}

void ContactTree::refit(const ContactMesh& mesh, const ListedMotion& motion, std::span<const double> change) {
  const bool obstacles_changed = placePoints(motion);
  gradients_.resize(inverse_.size());
  const int triangles = static_cast<int>(inverse_.size()), groups = static_cast<int>(groups_.size());
#pragma omp parallel for schedule(static) if (triangles > kMany)
  for (int t = 0; t < triangles; ++t) gradients_[t] = gradient(mesh, t, motion.x);
  watchSides(motion.x, change);
  const int end = static_cast<int>(obstacles_changed ? nodes_.size() : parts_.size());
#pragma omp parallel for schedule(dynamic) if (end > kMany)
  for (int g = 0; g < groups; ++g)
    for (int i = std::min(groups_[g][1], end); i-- > groups_[g][0];) refitNode(i, change);
  for (std::size_t k = above_.size(); k-- > 0;)
    if (above_[k] < end) refitNode(above_[k], change);
}

/// After its children.
void ContactTree::refitNode(std::size_t i, std::span<const double> change) {
  const Node& n = nodes_[i];
  MovingBox& box = boxes_[i];
  if (n.left >= 0) {
    box = boxes_[n.left];
    box.add(boxes_[n.right]);
    if (n.whole) parts_[i].cluster = merge(parts_[n.left].cluster, parts_[n.right].cluster);
    return;
  }
  box = {};
  for (int k = n.first; k < n.first + n.count; ++k) box.add(boxOf(tiles_[k].vertex));
  if (!n.whole) return;
  Part& part = parts_[i];
  part.cluster = cellCluster(tiles_[n.first].triangle, change);
  cells_[n.chart][part.begin[0] + charts_[n.chart].cells[0] * part.begin[1]] = part.cluster;
}

Box ContactTree::reachOfCloth(const PairRules& rules) const {
  Box box;
  for (std::size_t k = 0; k < charts_.size(); ++k) box.add(boxes_[roots_[k]].points());
  return box.grown(rules.margin_m);
}

/// c >= least, without dividing.
bool ContactTree::certifies(const Cluster& cluster, double least) {
  const double ss = TileShape::dot(cluster.s, cluster.s), tt = TileShape::dot(cluster.t, cluster.t);
  // A part in a thousand, and a part in a hundred thousand of the largest, for the rounding of all this: far more than
  // it is.
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

/// Points whose distance at rest is D are at least c D apart.
bool ContactTree::coveredBetween(int ia, int ib, double margin_m, double least) const {
  if (nodes_[ia].chart < 0 || nodes_[ia].chart != nodes_[ib].chart) return false;
  const double rest = restDistance(parts_[ia].rest, parts_[ib].rest);
  return hullCertifies(ia, ib, least * rest > margin_m ? margin_m / rest : least);
}

std::vector<ContactTree::Search> ContactTree::searches(const PairRules& rules, int parts) const {
  std::vector<Search> found, next;
  const int charts = static_cast<int>(charts_.size()), roots = static_cast<int>(roots_.size());
  for (int i = 0; i < charts; ++i) {
    if (rules.cloth_with_cloth) found.push_back({roots_[i], -1, false});
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
        } else if (!a.whole || !certifies(parts_[s.a].cluster, rules.least)) {
          next.insert(next.end(), {{a.left, -1, false}, {a.right, -1, false}, {a.left, a.right, a.whole}});
          opened = true;
        }
        continue;
      }
      const Node& b = nodes_[s.b];
      if (!mayMeet(boxes_[s.a], boxes_[s.b], reachOf(rules, widest, s.a, s.b))) continue;
      if (a.left < 0 && b.left < 0) {
        next.push_back(s);
        continue;
      }
      if (!s.asked && coveredBetween(s.a, s.b, rules.margin_m, rules.least)) continue;
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
