#pragma once
/// Pairs of primitives that may touch: points against triangles, edges against edges.

#include <compare>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/contact_tree.hpp"

namespace gambeson {

/// A lower bound of the distance of two primitives that do what a list allows for (ListedMotion): `gap_m` less t times
/// `closing`, less what each leaves its path by.
struct Apart {
  float gap_m = 0, closing_m_per_s = 0;

  /// The least of this bound over the times t in [t0, t1].
  double within(double t0, double t1) const { return gap_m - closing_m_per_s * (closing_m_per_s > 0 ? t1 : t0); }
};

/// Compared by which primitives they are.
struct PointTriangle {
  int vertex = 0, triangle = 0;
  Apart apart{};
  auto operator<=>(const PointTriangle& o) const {
    return std::pair(vertex, triangle) <=> std::pair(o.vertex, o.triangle);
  }
  bool operator==(const PointTriangle& o) const { return (*this <=> o) == 0; }
};
struct EdgeEdge {
  int a = 0, b = 0;  ///< a < b
  Apart apart{};
  auto operator<=>(const EdgeEdge& o) const { return std::pair(a, b) <=> std::pair(o.a, o.b); }
  bool operator==(const EdgeEdge& o) const { return (*this <=> o) == 0; }
};
struct CandidatePairs {
  std::vector<PointTriangle> points;  ///< ascending
  std::vector<EdgeEdge> edges;        ///< in an order that does not depend on the number of threads
  /// Scratch of one thread.
  struct OfThread {
    std::vector<PointTriangle> points;
    std::vector<EdgeEdge> edges;
    // Of each tile, where it was asked for.
    std::vector<TileShape> shapes;
    std::vector<double> slacks;
    std::vector<char> shaped;
  };
  /// What a part of the search has found, and where that stands in the end.
  struct Found {
    int thread = 0;
    std::size_t first_point = 0, end_point = 0, first_edge = 0, end_edge = 0;
    std::size_t points_at = 0, edges_at = 0;
  };
  std::vector<OfThread> of_thread;
  std::vector<Found> found;
  std::vector<PointTriangle> unsorted;
  std::vector<int> first_of_vertex;
  std::vector<unsigned char> blunt;  ///< of each triangle, as in PairCollector; empty: as there
};

/// What has no persistent contacts of its own (1) and matters to a list only within PairRules::blunt_margin_m: vertices
/// against triangles, edges against edges. Empty: nothing.
struct BluntFeatures {
  std::vector<char> vertex, edge;
};

/// Every vertex and edge belongs to one of its triangles, so that a pair of primitives comes up with one pair of
/// triangles only (after Curtis, Tamstorf and Manocha, 2008).
class PairCollector {
 public:
  PairCollector() = default;
  explicit PairCollector(const ContactMesh& mesh, const BluntFeatures& blunt = {});

  /// Of ContactTree::pairs, the primitives that may come within their margin of each other in the motion that the tree
  /// was fitted to; those that hang together are not pairs. `also_blunt`: for as long as the list lasts, flags of all
  /// vertices and edges.
  void collect(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion, const PairRules& rules,
               CandidatePairs& out, const BluntFeatures* also_blunt = nullptr) const;
  /// What is on the list of the last `collect`, put right where the tree has been touched since (refitSome). The flags
  /// are those of that call.
  void mend(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion, const PairRules& rules,
            CandidatePairs& out) const;

 private:
  void search(const ContactMesh& mesh, const ContactTree& tree, const ListedMotion& motion, const PairRules& rules,
              std::span<const ContactTree::Search> searches, int threads, CandidatePairs& out) const;

  std::vector<unsigned char> owned_;  ///< of a triangle: bits 0 to 2 its corners, bits 3 to 5 its edges
  std::vector<unsigned char> blunt_;  ///< likewise
  std::vector<int> vertex_owner_, edge_owner_;
};

}  // namespace gambeson
