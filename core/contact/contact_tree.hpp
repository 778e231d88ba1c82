#pragma once
/// Which triangles may touch during a step: a tree of swept boxes over cloth and obstacles that leaves out what cloth
/// provably does not do to itself (Zheng 2013, section 3.6, with certificates in place of tests of neighbours).

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/box.hpp"
#include "core/contact/contact_mesh.hpp"
#include "core/contact/moving_box.hpp"
#include "core/contact/tile.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The triangles of a patch in the rectangular grid of its samples. `whole` cells consist of two triangles between the
/// cell's four corners; others (cut by trimming) hold what lies in them and are never certified.
struct GridChart {
  std::array<int, 2> cells{0, 0};
  Lists triangles;          ///< of cell i + cells[0] j
  std::vector<char> whole;  ///< of each cell
};

/// Where the corners of a triangle lie in its chart's plane [m], counterclockwise: cells are rectangles there.
using ChartCorners = std::array<Vec2, 3>;

/// Triangles [first, end) of the mesh.
struct TriangleRange {
  int first = 0, end = 0;
};

/// Which pairs matter.
struct PairRules {
  double margin_m = 0;           ///< what comes no nearer does not
  double least = 0;              ///< nor do parts of one cloth with a certificate c (ContactTree) of at least this
  bool cloth_with_cloth = true;  ///< or with obstacles only
  double blunt_margin_m = 0;     ///< the margin of pairs with something blunt (BluntFeatures), no more than margin_m
  double obstacle_margin_m = 0;  ///< the least of other pairs with an obstacle, no more than margin_m
};

/// The tree. Cloth is bisected in its grids, so that a node is a rectangle of cells; obstacles by their centres, once.
///
/// Certificate. Let X be reference coordinates in a convex part of a chart (a rectangle of whole cells) and F the
/// gradient of the piecewise linear surface x(X), constant in a triangle. If all F of the part lie within R of a matrix
/// M (3 x 2, singular values s1 >= s2) in the spectral norm, then for any two of its points, because Mᵀx is a strictly
/// monotone map there,
///   |x(X) - x(Y)| >= c |X - Y|,  c = (s2² - s1 R)/s1.
/// With c > 0 the part neither touches itself nor passes through itself. Where no F moves by more than e, c falls by no
/// more than e; on straight paths the farthest F is that of one of the ends.
class ContactTree {
 public:
  ContactTree() = default;
  /// Charts hold the mesh's first triangles with their `corners`, obstacles the others; `x` are positions of all
  /// vertices that tell what is near what on obstacles.
  ContactTree(const ContactMesh& mesh, std::vector<GridChart> charts, std::span<const ChartCorners> corners,
              std::span<const TriangleRange> obstacles, std::span<const Vec3> x);

  /// Thin cloth has a margin of its own: two primitives of cloth matter only within the sum of their vertices' largest
  /// shares, one of cloth and one of an obstacle within twice the former's or PairRules::obstacle_margin_m, and never
  /// beyond PairRules::margin_m.
  /// `share_m` of each vertex; of obstacles they do not count. Where all are the same they make no difference.
  void setShares(std::span<const float> share_m);
  /// The margin between two tiles.
  double marginOf(const PairRules& rules, int tile_a, int tile_b) const {
    return tile_share_m_.empty() ? rules.margin_m : shared(rules, tile_share_m_[tile_a], tile_share_m_[tile_b]);
  }

  /// Boxes and certificates of a motion, good for as long as all vertices do what it says and no gradient moves from
  /// where it is at x by more than `change` of its triangle of cloth (empty: zero).
  void refit(const ContactMesh& mesh, const ListedMotion& motion, std::span<const double> change);

  /// Frobenius norm of F(x1) - F(x0) of each triangle of cloth.
  void gradientChanges(const ContactMesh& mesh, std::span<const Vec3> x0, std::span<const Vec3> x1,
                       std::vector<double>& out) const;
  /// No gradient at x differs by more than its `change` from the last refit, of those that certificates count on: no
  /// column by more than 1/sqrt(2) of it.
  bool gradientsHold(std::span<const Vec3> x) const;

  /// A part of a search for pairs: within a node, or between two.
  struct Search {
    int a = 0, b = -1;   ///< nodes; -1: within a
    bool asked = false;  ///< their hull has no certificate
  };
  /// The search in parts, at least `parts` of them where there is that much to search. One after the other, they visit
  /// the same pairs in the same order however many there are.
  std::vector<Search> searches(const PairRules& rules, int parts) const;

  /// Calls visit(a, b, covered) once for every two tiles, not both of obstacles, whose boxes may meet, except those of
  /// a part of cloth with c >= `least`; a == b: for the two triangles of a tile. Tiles for which covered() holds need
  /// not be looked at either; it takes a while to tell.
  template <class Visit>
  void pairs(const PairRules& rules, const Search& search, Visit&& visit) const {
    Traversal<Visit> t{*this, rules, rules.margin_m, rules.least, roundUp(rules.margin_m), visit};
    if (search.b < 0)
      t.within(search.a);
    else
      t.between(search.a, search.b, search.asked);
  }

  /// All of the cloth within the motion, and what comes within the margin of it.
  Box reachOfCloth(const PairRules& rules) const;

  bool empty() const { return nodes_.empty(); }
  std::span<const Tile> tiles() const { return tiles_; }
  const MovingBox& vertexBox(int vertex) const { return vertex_boxes_[vertex]; }
  template <std::size_t N>
  MovingBox boxOf(const std::array<int, N>& vertices) const {
    MovingBox box = vertex_boxes_[vertices[0]];
    for (std::size_t k = 1; k < N; ++k) box.add(vertex_boxes_[vertices[k]]);
    return box;
  }
  TileShape shape(int tile) const {
    const auto& v = tiles_[tile].vertex;
    return {points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]], tiles_[tile].triangle[1] >= 0};
  }
  /// Vertices from this one on are the obstacles'.
  int firstObstacleVertex() const { return first_obstacle_vertex_; }
  /// Of the vertices.
  std::span<const MovingPoint> points() const { return points_; }
  /// Distances from shapes and points are off by no more.
  float shapeError_m() const { return shape_error_m_; }

 private:
  struct Gradient {
    Vec3 s, t;  ///< columns: dx/dX1, dx/dX2
  };
  /// Gradients within `spread` (Frobenius) of the one with columns s and t. In single precision: these are numbers
  /// about 1, and what a millionth of them does is in `certifies`.
  struct Cluster {
    Four s{}, t{};
    float spread = 0;
  };
  struct Node {
    int left = -1, right = -1;  ///< children, after their parent; -1 in leaves
    int first = 0, count = 0;   ///< tiles of a leaf
    int chart = -1;             ///< of cloth
    bool whole = false;         ///< all cells are
  };
  /// Of cloth: what is asked less often.
  struct Part {
    int begin[2]{}, end[2]{};  ///< cells of the rectangle
    Cluster cluster;
    Box rest;  ///< of the rectangle in the chart's plane
  };
  template <class Visit>
  struct Traversal {
    const ContactTree& tree;
    const PairRules& rules;
    double margin, least;
    float reach;  ///< the margin for boxes
    Visit& visit;

    void within(int at) {
      const Node& n = tree.nodes_[at];
      if (n.whole && certifies(tree.parts_[at].cluster, least)) return;
      if (n.left < 0) {
        const auto never = [] { return false; };
        for (int i = n.first; i < n.first + n.count; ++i) {
          if (tree.tiles_[i].triangle[1] >= 0) visit(i, i, never);
          for (int j = i + 1; j < n.first + n.count; ++j) emit(i, j, never);
        }
        return;
      }
      within(n.left);
      within(n.right);
      between(n.left, n.right, n.whole);
    }
    void between(int ia, int ib, bool asked = false) {
      if (mayMeet(tree.boxes_[ia], tree.boxes_[ib], tree.reachOf(rules, reach, ia, ib))) near(ia, ib, asked);
    }
    /// Two nodes whose boxes may meet. `asked`: their hull has no certificate.
    void near(int ia, int ib, bool asked) {
      const Node &a = tree.nodes_[ia], &b = tree.nodes_[ib];
      if (a.left < 0 && b.left < 0) {
        leaves(ia, ib, asked);
        return;
      }
      if (covered(ia, ib, asked)) return;
      if (tree.opensFirst(ia, ib)) {
        between(a.left, ib);
        between(a.right, ib);
      } else {
        between(ia, b.left);
        between(ia, b.right);
      }
    }
    bool covered(int ia, int ib, bool asked) const { return !asked && tree.coveredBetween(ia, ib, margin, least); }
    [[gnu::noinline]] void leaves(int ia, int ib, bool asked) {
      const Node &a = tree.nodes_[ia], &b = tree.nodes_[ib];
      if (a.count == 1 && b.count == 1) {
        visit(a.first, b.first, [&] { return covered(ia, ib, asked); });
        return;
      }
      if (covered(ia, ib, asked)) return;
      for (int i = a.first; i < a.first + a.count; ++i)
        for (int j = b.first; j < b.first + b.count; ++j) emit(i, j, [] { return false; });
    }
    template <class Covered>
    void emit(int i, int j, Covered&& covered) {
      if (mayMeet(tree.boxOf(tree.tiles_[i].vertex), tree.boxOf(tree.tiles_[j].vertex), reach)) visit(i, j, covered);
    }
  };

  int buildChart(const ContactMesh& mesh, int chart, std::array<int, 2> begin, std::array<int, 2> end,
                 std::span<const ChartCorners> corners);
  int buildObstacle(const ContactMesh& mesh, std::span<int> triangles, std::span<const Vec3> centres);
  void addTile(const ContactMesh& mesh, int first, int second);
  bool placePoints(const ListedMotion& motion);
  void findGroups();
  void refitNode(std::size_t i, std::span<const double> change);
  Gradient gradient(const ContactMesh& mesh, int triangle, std::span<const Vec3> x) const;
  Cluster cellCluster(std::span<const int> triangles, std::span<const double> change) const;
  void findSides(const ContactMesh& mesh, std::span<const ChartCorners> corners);
  void watchSides(std::span<const Vec3> x, std::span<const double> change);
  static bool certifies(const Cluster& cluster, double least);
  static Cluster merge(const Cluster& a, const Cluster& b);
  static float distance(const Cluster& a, const Cluster& b) {
    const Four s = a.s - b.s, t = a.t - b.t;
    return std::sqrt(TileShape::dot(s, s) + TileShape::dot(t, t));
  }
  bool hullCertifies(int ia, int ib, double least) const;
  static double shared(const PairRules& rules, float a, float b) {
    const bool obstacle = a < 0 || b < 0;
    const double sum = obstacle ? std::max(2.0 * std::max(a, b), rules.obstacle_margin_m) : static_cast<double>(a) + b;
    return std::clamp(sum, rules.blunt_margin_m, rules.margin_m);
  }
  /// For boxes of nodes, rounded up. `widest`: PairRules::margin_m, so rounded.
  float reachOf(const PairRules& rules, float widest, int ia, int ib) const {
    return node_share_m_.empty() ? widest
                                 : 1.000001f * static_cast<float>(shared(rules, node_share_m_[ia], node_share_m_[ib]));
  }
  bool coveredBetween(int ia, int ib, double margin_m, double least) const;
  /// Of two nodes, not both leaves: the first is the one to look into.
  bool opensFirst(int ia, int ib) const {
    const Node &a = nodes_[ia], &b = nodes_[ib];
    return b.left < 0 || (a.left >= 0 && boxes_[ia].size2() >= boxes_[ib].size2());
  }
  static double restDistance(const Box& a, const Box& b) {
    return norm(maximum(maximum(b.lo - a.hi, a.lo - b.hi), Vec3{}));
  }

  std::vector<GridChart> charts_;
  std::vector<Node> nodes_;
  std::vector<MovingBox> boxes_;            ///< of the nodes
  std::vector<Part> parts_;                 ///< of the nodes of cloth, which come first
  std::vector<int> roots_;                  ///< of the charts, then of the obstacles
  std::vector<std::array<int, 2>> groups_;  ///< nodes [first, end) under one, of a size that a thread takes at once
  std::vector<int> above_;                  ///< the other nodes, ascending
  std::vector<Tile> tiles_;                 ///< leaf by leaf
  std::vector<float> node_share_m_, tile_share_m_;  ///< the largest of their vertices; -1: of obstacles
  std::vector<MovingBox> vertex_boxes_;
  std::vector<MovingPoint> points_;  ///< the vertices
  float shape_error_m_ = 0;
  int first_obstacle_vertex_ = std::numeric_limits<int>::max();
  std::vector<Gradient> gradients_;  ///< at the last refit, of each triangle of cloth
  struct Side {
    int a = 0, b = 0;
    float length_m = 0;  ///< at rest
  };
  struct SideThen {
    float x = 0, y = 0, z = 0;  ///< from a to b at the last refit
    float most2 = 0;            ///< squared change that is allowed for
  };
  std::vector<Side> sides_;  ///< of whole cells, each once
  std::vector<SideThen> sides_then_;
  std::vector<std::array<int, 2>> triangle_sides_;  ///< of each triangle of cloth; -1 in cells that are cut
  Lists side_triangles_;                            ///< and the triangles of each side
  std::vector<std::array<double, 4>> inverse_;      ///< of the reference edges of each triangle of a whole cell
  std::vector<std::vector<Cluster>> cells_;         ///< of each cell of each chart
};

}  // namespace gambeson
