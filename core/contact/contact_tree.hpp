#pragma once
/// Which triangles may touch during a step: a tree of swept boxes over cloth and obstacles that leaves out what cloth
/// provably does not do to itself (Zheng 2013, section 3.6, with certificates in place of tests of neighbours).

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <span>
#include <vector>

#include "core/contact/box.hpp"
#include "core/contact/box_lanes.hpp"
#include "core/contact/contact_mesh.hpp"
#include "core/contact/moving_box.hpp"
#include "core/contact/tile.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The triangles of a patch in the rectangular grid of its samples. `whole` cells consist of two triangles between the
/// cell's four corners; others (cut by trimming) hold what lies in them and are never certified.
/// Without a grid the cells are one row, each a triangle or two with a common edge, near cells near each other in it.
struct GridChart {
  std::array<int, 2> cells{0, 0};
  Lists triangles;          ///< of cell i + cells[0] j
  std::vector<char> whole;  ///< of each cell
  bool has_grid = true;
};

/// Where the corners of a triangle lie in its chart's plane [m], counterclockwise: cells are rectangles there.
using ChartCorners = std::array<Vec2, 3>;

/// Triangles [first, end) of the mesh.
struct TriangleRange {
  int first = 0, end = 0;
};

/// Which pairs matter.
struct PairRules {
  double margin_m = 0;  ///< what comes no nearer does not
  double least = 0;     ///< nor what stays this share of its distance at rest apart, in one cloth (ContactTree)
  bool cloth_with_cloth = true;  ///< or with obstacles only
  double blunt_margin_m = 0;     ///< the margin of pairs with something blunt (BluntFeatures), no more than margin_m
  double obstacle_margin_m = 0;  ///< the least of other pairs with an obstacle, no more than margin_m
};

/// The tree. Cloth is bisected in its grids, so that a node is a rectangle of cells; obstacles by their centres, once.
///
/// Certificate. Let X be reference coordinates in a convex part of a chart (a rectangle of whole cells) and F the
/// gradient of the piecewise linear surface p(X), constant in a triangle. If all F of the part lie within R of a matrix
/// M (3 x 2, singular values s1 >= s2) in the spectral norm, then for any two of its points, because Mᵀp is a strictly
/// monotone map there,
///   |p(X) - p(Y)| >= c |X - Y|,  c = (s2² - s1 R)/s1.
/// p are the paths of a motion (ListedMotion): F is linear in time, and so within half of its whole change of what it
/// is half way. Cloth that is within a distance a of its path at X and b at Y stays c |X - Y| - a - b apart there,
/// whatever the rest of it does: a certificate lasts for as long as its points keep to their paths.
class ContactTree {
 public:
  ContactTree() = default;
  /// Charts hold the mesh's first triangles with their `corners`, obstacles the others; `x` are positions of all
  /// vertices that tell what is near what on obstacles.
  ContactTree(const ContactMesh& mesh, std::vector<GridChart> charts, std::span<const ChartCorners> corners,
              std::span<const TriangleRange> obstacles, std::span<const Vec3> x);

  /// Thin cloth has a margin of its own: two primitives of cloth matter only within the sum of their vertices' largest
  /// half reaches, one of cloth and one of an obstacle within twice the former's or PairRules::obstacle_margin_m, and
  /// never beyond PairRules::margin_m. `half_reach_m` of each vertex; of obstacles they do not count.
  void setHalfReaches(std::span<const float> half_reach_m);
  /// The margin between two tiles.
  double marginOf(const PairRules& rules, int tile_a, int tile_b) const {
    return tile_half_reach_m_.empty() ? rules.margin_m
                                      : marginBetween(rules, tile_half_reach_m_[tile_a], tile_half_reach_m_[tile_b]);
  }

  /// Boxes and certificates of a motion, good for as long as all vertices do what it says.
  void refit(const ContactMesh& mesh, const ListedMotion& motion);
  /// Where some vertices of cloth do otherwise than at the last refit: `motion` says what, and is as it was for all
  /// others. Their leaves are `touched` until the next call. Certificates stay those of the paths of the last refit,
  /// which these vertices are off by so much more.
  void refitSome(const ContactMesh& mesh, const ListedMotion& motion, std::span<const int> vertices);
  bool touched(int triangle) const { return triangle < std::ssize(leaf_of_) && touched_[leaf_of_[triangle]]; }

  /// A part of a search for pairs: within a node, between two, or between a leaf of cloth and all that there is.
  struct Search {
    int a = 0, b = kWithin;  ///< nodes
    bool asked = false;      ///< their hull has no certificate

    static constexpr int kWithin = -1, kAround = -2;
  };
  /// The search in parts, at least `parts` of them where there is that much to search. One after the other, they visit
  /// the same pairs in the same order however many there are.
  std::vector<Search> searches(const PairRules& rules, int parts) const;
  /// The searches of the touched leaves against all tiles. A pair of touched leaves comes up once.
  std::vector<Search> searchesOfTouched() const;

  /// Calls visit(a, b, covered) once for every two tiles, not both of obstacles, whose boxes may meet, except those of
  /// which a certificate says that they do not matter; a == b: for the two triangles of a tile. Tiles for which
  /// covered() holds need not be looked at either; it takes a while to tell.
  template <class Visit>
  void pairs(const PairRules& rules, const Search& search, Visit&& visit) const {
    Traversal<Visit> t{*this, rules, roundUp(rules.margin_m), visit};
    if (search.b == Search::kWithin)
      t.within(search.a);
    else if (search.b == Search::kAround)
      t.around(search.a);
    else
      t.between(search.a, search.b, search.asked);
  }

  /// All of the cloth within the motion, and what comes within the margin of it.
  Box reachOfCloth(const PairRules& rules) const;

  /// Primitives of whole cells without a common vertex are at least that far apart at rest; infinite where there are
  /// none.
  double apartAtRest() const { return apart_m_; }

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
  /// Where each vertex of the mesh is, and where it goes: as of the last refit.
  std::span<const MovingPoint> points() const { return points_; }
  /// Distances from shapes and points are off by no more.
  float shapeError_m() const { return shape_error_m_; }

 private:
  /// Half way through a motion, and what it changes until then.
  struct Gradient {
    Four s{}, t{};  ///< columns: dp/dX1, dp/dX2
    float change = 0;
  };
  /// Gradients within `spread` (Frobenius) of the one with columns s and t. In single precision: these are numbers
  /// about 1, and what a millionth of them does is in `certifies`.
  struct Cluster {
    Four s{}, t{};
    float spread = 0;
  };
  struct Node {
    int left = -1, right = -1;  ///< children, after their parent; -1 in leaves
    int first = 0, count = 0;   ///< tiles under it
    int chart = -1;             ///< of cloth
    bool whole = false;         ///< all cells are
  };
  /// Of cloth: what is asked less often.
  struct Part {
    int begin[2]{}, end[2]{};  ///< cells of the rectangle
    Cluster cluster;
    float aside_m = 0;  ///< no vertex is farther off its path
    Box rest;           ///< of the rectangle in the chart's plane
  };
  template <class Visit>
  struct Traversal {
    const ContactTree& tree;
    const PairRules& rules;
    float reach;  ///< the margin for boxes
    Visit& visit;
    int around_leaf = -1;  ///< that is searched around

    void within(int at) {
      const Node& n = tree.nodes_[at];
      if (n.whole && tree.certifiedWithin(at, reachOf(at, at), rules.least)) return;
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
    /// A touched leaf and all else.
    void around(int leaf) {
      const int charts = static_cast<int>(tree.charts_.size()), mine = tree.nodes_[leaf].chart;
      for (int k = 0; k < static_cast<int>(tree.roots_.size()); ++k) {
        if (k < charts && !rules.cloth_with_cloth) continue;
        if (k == mine)
          alongTo(leaf, tree.roots_[k]);
        else
          inOrder(leaf, tree.roots_[k]);
      }
    }
    /// A leaf and all else under `at`, which is above it.
    void alongTo(int leaf, int at) {
      while (at != leaf) {
        const Node& n = tree.nodes_[at];
        if (n.whole && tree.certifiedWithin(at, reachOf(at, at), rules.least)) return;
        const bool on_right = leaf >= n.right;
        inOrder(leaf, on_right ? n.left : n.right);
        at = on_right ? n.right : n.left;
      }
      within(leaf);
    }
    /// As the whole search has them: the earlier one first.
    void inOrder(int leaf, int other) {
      around_leaf = leaf;
      between(std::min(leaf, other), std::max(leaf, other));
      around_leaf = -1;
    }
    void between(int ia, int ib, bool asked = false) {
      if (mayMeet(tree.boxes_[ia], tree.boxes_[ib], reachOf(ia, ib))) near(ia, ib, asked);
    }
    /// Two nodes whose boxes may meet. `asked`: their hull has no certificate.
    void near(int ia, int ib, bool asked) {
      const Node &a = tree.nodes_[ia], &b = tree.nodes_[ib];
      const bool one = a.count == 1 && b.count == 1;  // asked last
      if (!one && covered(ia, ib, asked)) return;
      if (a.count <= BoxLanes::kMost && b.count <= BoxLanes::kMost) {
        blocks(ia, ib, asked || !one);
      } else if (tree.opensFirst(ia, ib)) {
        between(a.left, ib);
        between(a.right, ib);
      } else {
        between(ia, b.left);
        between(ia, b.right);
      }
    }
    bool covered(int ia, int ib, bool asked) const {
      return !asked && tree.coveredBetween(ia, ib, reachOf(ia, ib), rules.least);
    }
    float reachOf(int ia, int ib) const { return tree.reachOf(rules, reach, ia, ib); }
    /// Each tile of one node with each of the other. `asked`: the hull of both has no certificate.
    void blocks(int ia, int ib, bool asked) {
      const Node &a = tree.nodes_[ia], &b = tree.nodes_[ib];
      const float near = reachOf(ia, ib);
      for (int i = a.first; i < a.first + a.count; ++i) {
        const MovingBox box = a.count == 1 ? tree.boxes_[ia] : tree.boxOf(tree.tiles_[i].vertex);
        if (a.count > 1 && !mayMeet(box, tree.boxes_[ib], near)) continue;
        const int la = tree.leaf_of_tile_[i];
        for (unsigned bits = tree.tile_boxes_.meeting(box, b.first, b.count, near); bits != 0; bits &= bits - 1) {
          const int j = b.first + std::countr_zero(bits), lb = tree.leaf_of_tile_[j];
          if (around_leaf >= 0 && tree.comesLater(around_leaf, ia == around_leaf ? lb : la)) continue;
          visit(i, j, [&] { return covered(la, lb, asked && la == ia && lb == ib); });
        }
      }
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
  void placePoint(const ListedMotion& motion, int vertex);
  static float shapeError(const MovingPoint& p);
  void findChunks();
  void findLeaves(int triangles);
  void findApart(std::span<const ChartCorners> corners);
  void refitNode(int i, const ListedMotion& motion);
  void refitLeaf(int i, const ListedMotion& motion);
  Gradient gradient(const ContactMesh& mesh, int triangle, const ListedMotion& motion) const;
  Cluster cellCluster(std::span<const int> triangles) const;
  /// c >= least.
  static bool certifies(const Cluster& cluster, double least);
  bool certifiedWithin(int node, double margin_m, double least) const;
  static Cluster merge(const Cluster& a, const Cluster& b);
  static float distance(const Cluster& a, const Cluster& b) {
    const Four s = a.s - b.s, t = a.t - b.t;
    return std::sqrt(TileShape::dot(s, s) + TileShape::dot(t, t));
  }
  bool hullCertifies(int ia, int ib, double least) const;
  static double marginBetween(const PairRules& rules, float a, float b) {
    const bool obstacle = a < 0 || b < 0;
    const double sum = obstacle ? std::max(2.0 * std::max(a, b), rules.obstacle_margin_m) : static_cast<double>(a) + b;
    return std::clamp(sum, rules.blunt_margin_m, rules.margin_m);
  }
  /// The margin between two nodes, rounded up. `widest` is PairRules::margin_m, rounded up too.
  float reachOf(const PairRules& rules, float widest, int ia, int ib) const {
    return node_half_reach_m_.empty()
               ? widest
               : 1.000001f * static_cast<float>(marginBetween(rules, node_half_reach_m_[ia], node_half_reach_m_[ib]));
  }
  bool coveredBetween(int ia, int ib, double margin_m, double least) const;
  /// Two touched leaves come up with the first of them.
  bool comesLater(int leaf, int other) const { return other < leaf && touched_[other]; }
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
  std::vector<std::array<int, 2>> chunks_;  ///< nodes [first, end) under one, of a size that a thread takes at once
  std::vector<int> above_;                  ///< the other nodes, ascending
  std::vector<Tile> tiles_;                 ///< leaf by leaf
  std::vector<int> leaf_of_tile_;           ///< node
  BoxLanes tile_boxes_;
  std::vector<int> parent_, leaf_of_;                         ///< of the nodes of cloth, and of its triangles
  std::vector<char> touched_;                                 ///< of the nodes of cloth
  std::vector<int> touched_leaves_;                           ///< ascending
  std::vector<float> node_half_reach_m_, tile_half_reach_m_;  ///< the largest of their vertices; -1: of obstacles
  std::vector<MovingBox> vertex_boxes_;
  std::vector<MovingPoint> points_;  ///< the vertices
  Vec3 origin_;                      ///< of `points_`
  std::vector<float> off_m_;         ///< of each vertex of cloth: its path, from that of the last refit
  float shape_error_m_ = 0;
  int first_obstacle_vertex_ = std::numeric_limits<int>::max();
  std::vector<Gradient> gradients_;             ///< of each triangle of cloth
  std::vector<std::array<double, 4>> inverse_;  ///< of the reference edges of each triangle of a whole cell
  std::vector<std::vector<Cluster>> cells_;     ///< of each cell of each chart
  double apart_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace gambeson
