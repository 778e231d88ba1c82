#include "core/contact/contact_tree.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>

namespace gambeson {
namespace {
constexpr int kObstacleLeaf = 2;
constexpr int kHullCells = 16;  ///< hulls of so few cells are looked at cell by cell
}  // namespace

ContactTree::ContactTree(const ContactMesh& mesh, std::vector<GridChart> charts, std::span<const ChartCorners> corners,
                         std::span<const TriangleRange> obstacles, std::span<const Vec3> x)
    : charts_(std::move(charts)) {
  boxes_.resize(mesh.triangles.size());
  for (const ChartCorners& c : corners) {
    const double a = c[1].x - c[0].x, b = c[1].y - c[0].y, d = c[2].x - c[0].x, e = c[2].y - c[0].y;
    const double area2 = a * e - b * d;
    inverse_.push_back({e / area2, -b / area2, -d / area2, a / area2});
  }
  for (std::size_t k = 0; k < charts_.size(); ++k) {
    cells_.emplace_back(charts_[k].whole.size());
    roots_.push_back(buildChart(static_cast<int>(k), {0, 0}, charts_[k].cells, corners));
  }
  findSides(mesh, corners);
  std::vector<Vec3> centres;
  for (const auto& [a, b, c] : mesh.triangles) centres.push_back(x[a] + x[b] + x[c]);
  for (const TriangleRange& range : obstacles) {
    const int first = static_cast<int>(order_.size());
    for (int t = range.first; t < range.end; ++t) order_.push_back(t);
    if (range.first < range.end) roots_.push_back(buildObstacle(first, static_cast<int>(order_.size()), centres));
  }
}

int ContactTree::buildChart(int chart, std::array<int, 2> begin, std::array<int, 2> end,
                            std::span<const ChartCorners> corners) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  const GridChart& c = charts_[chart];
  Node node;
  node.chart = chart;
  std::copy_n(begin.begin(), 2, node.begin);
  std::copy_n(end.begin(), 2, node.end);
  const int axis = end[0] - begin[0] >= end[1] - begin[1] ? 0 : 1;
  if (end[axis] - begin[axis] <= 1) {
    const int cell = begin[0] + c.cells[0] * begin[1];
    node.first = static_cast<int>(order_.size());
    node.count = static_cast<int>(c.triangles[cell].size());
    node.whole = c.whole[cell];
    order_.insert(order_.end(), c.triangles[cell].begin(), c.triangles[cell].end());
    for (int t : c.triangles[cell])
      for (const Vec2& corner : corners[t]) node.rest.add(Vec3{corner.x, corner.y, 0});
  } else {
    const int middle = begin[axis] + (end[axis] - begin[axis]) / 2;
    std::array<int, 2> left_end = end, right_begin = begin;
    left_end[axis] = right_begin[axis] = middle;
    node.left = buildChart(chart, begin, left_end, corners);
    node.right = buildChart(chart, right_begin, end, corners);
    node.rest = nodes_[node.left].rest;
    node.rest.add(nodes_[node.right].rest);
    node.whole = nodes_[node.left].whole && nodes_[node.right].whole;
  }
  nodes_[at] = node;
  return at;
}

int ContactTree::buildObstacle(int first, int end, std::span<const Vec3> centres) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  if (end - first <= kObstacleLeaf) {
    node.first = first;
    node.count = end - first;
  } else {
    Box box;
    for (int k = first; k < end; ++k) box.add(centres[order_[k]]);
    const Vec3 h = box.halfSize();
    const int axis = h.x >= h.y && h.x >= h.z ? 0 : h.y >= h.z ? 1 : 2;
    const int middle = first + (end - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
      return centres[a][axis] != centres[b][axis] ? centres[a][axis] < centres[b][axis] : a < b;
    });
    node.left = buildObstacle(first, middle, centres);
    node.right = buildObstacle(middle, end, centres);
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
double distance(const Vec3& s, const Vec3& t) { return std::sqrt(norm2(s) + norm2(t)); }
}  // namespace

ContactTree::Cluster ContactTree::cellCluster(std::span<const int> triangles, std::span<const double> change) const {
  const Gradient &a = gradients_[triangles[0]], &b = gradients_[triangles[1]];
  const double spread = 0.5 * distance(a.s - b.s, a.t - b.t);
  return {{0.5 * (a.s + b.s), 0.5 * (a.t + b.t)},
          spread + (change.empty() ? 0 : std::max(change[triangles[0]], change[triangles[1]]))};
}

void ContactTree::gradientChanges(const ContactMesh& mesh, std::span<const Vec3> x0, std::span<const Vec3> x1,
                                  std::vector<double>& out) const {
  out.resize(inverse_.size());
  for (std::size_t t = 0; t < inverse_.size(); ++t) {
    const Gradient a = gradient(mesh, static_cast<int>(t), x0), b = gradient(mesh, static_cast<int>(t), x1);
    out[t] = distance(b.s - a.s, b.t - a.t);
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
  for (const Node& n : nodes_)
    for (int k = n.whole && n.left < 0 ? n.first : n.first + n.count; k < n.first + n.count; ++k) {
      const int t = order_[k];
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
}

/// Each column may change by 1/sqrt(2) of what the triangle may.
void ContactTree::watchSides(std::span<const Vec3> x, std::span<const double> change) {
  for (std::size_t k = 0; k < sides_.size(); ++k) {
    const Vec3 d = x[sides_[k].b] - x[sides_[k].a];
    sides_then_[k] = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                      std::numeric_limits<float>::infinity()};
  }
  for (std::size_t t = 0; t < triangle_sides_.size(); ++t)
    for (int k : triangle_sides_[t]) {
      if (k < 0) continue;
      // Less by the rounding of all this: that of the sides is 1e-7 of them.
      const float most = (0.7071f * static_cast<float>(change.empty() ? 0 : change[t]) - 1e-5f) * sides_[k].length_m;
      sides_then_[k].most2 = std::min(sides_then_[k].most2, most > 0 ? most * most : -1.0f);
    }
}

bool ContactTree::gradientsHold(std::span<const Vec3> x) const {
  bool hold = true;
  for (std::size_t k = 0; k < sides_.size() && hold; ++k) {
    const SideThen& then = sides_then_[k];
    const Vec3 d = x[sides_[k].b] - x[sides_[k].a];
    const float dx = static_cast<float>(d.x) - then.x, dy = static_cast<float>(d.y) - then.y,
                dz = static_cast<float>(d.z) - then.z;
    hold = dx * dx + dy * dy + dz * dz <= then.most2;
  }
  return hold;
}

ContactTree::Cluster ContactTree::merge(const Cluster& a, const Cluster& b) {
  Cluster out;
  out.mean = {0.5 * (a.mean.s + b.mean.s), 0.5 * (a.mean.t + b.mean.t)};
  out.spread = std::max(a.spread, b.spread) + 0.5 * distance(a.mean.s - b.mean.s, a.mean.t - b.mean.t);
  return out;
}

void ContactTree::refit(const ContactMesh& mesh, const ListedMotion& motion, std::span<const double> change) {
  gradients_.resize(inverse_.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    boxes_[t] = {};
    for (int v : mesh.triangles[t]) boxes_[t].add(MovingBox(motion, v));
    if (t < gradients_.size()) gradients_[t] = gradient(mesh, static_cast<int>(t), motion.x);
  }
  watchSides(motion.x, change);
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& n = nodes_[i];
    n.box = {};
    if (n.left >= 0) {
      n.box = nodes_[n.left].box;
      n.box.add(nodes_[n.right].box);
      if (n.whole) n.cluster = merge(nodes_[n.left].cluster, nodes_[n.right].cluster);
      continue;
    }
    for (int k = n.first; k < n.first + n.count; ++k) n.box.add(boxes_[order_[k]]);
    if (!n.whole) continue;
    n.cluster = cellCluster({order_.data() + n.first, 2}, change);
    cells_[n.chart][n.begin[0] + charts_[n.chart].cells[0] * n.begin[1]] = n.cluster;
  }
}

double ContactTree::certifiedBound(const Cluster& cluster) {
  const Vec3 &s = cluster.mean.s, &t = cluster.mean.t;
  const double ss = norm2(s), tt = norm2(t), st = dot(s, t);
  const double half = 0.5 * (ss + tt), root = std::sqrt(0.25 * (ss - tt) * (ss - tt) + st * st);
  const double largest = std::sqrt(half + root), least2 = std::max(0.0, half - root);
  // A part in a thousand for the rounding of all this, far more than it is.
  return largest > 0 ? (0.999 * least2 - largest * cluster.spread) / largest : 0;
}

double ContactTree::hullBound(const Node& a, const Node& b) const {
  const int i0 = std::min(a.begin[0], b.begin[0]), i1 = std::max(a.end[0], b.end[0]);
  const int j0 = std::min(a.begin[1], b.begin[1]), j1 = std::max(a.end[1], b.end[1]);
  const long cells = static_cast<long>(i1 - i0) * (j1 - j0);
  const auto count = [](const Node& n) { return static_cast<long>(n.end[0] - n.begin[0]) * (n.end[1] - n.begin[1]); };
  if (a.whole && b.whole && cells == count(a) + count(b)) return certifiedBound(merge(a.cluster, b.cluster));
  if (cells > kHullCells) return -1;
  const GridChart& chart = charts_[a.chart];
  const std::vector<Cluster>& clusters = cells_[a.chart];
  Cluster hull;
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      const int cell = i + chart.cells[0] * j;
      if (!chart.whole[cell]) return -1;
      hull.mean.s += (1.0 / cells) * clusters[cell].mean.s;
      hull.mean.t += (1.0 / cells) * clusters[cell].mean.t;
    }
  for (int j = j0; j < j1; ++j)
    for (int i = i0; i < i1; ++i) {
      const Cluster& c = clusters[i + chart.cells[0] * j];
      hull.spread = std::max(hull.spread, c.spread + distance(c.mean.s - hull.mean.s, c.mean.t - hull.mean.t));
    }
  return certifiedBound(hull);
}

}  // namespace gambeson
