#pragma once
/// Pairs of primitives that may touch: points against triangles, edges against edges.

#include <span>
#include <vector>

#include "core/contact/contact_tree.hpp"

namespace gambeson {

struct PointTriangle {
  int vertex = 0, triangle = 0;
  auto operator<=>(const PointTriangle&) const = default;
};
struct EdgeEdge {
  int a = 0, b = 0;  ///< a < b
  auto operator<=>(const EdgeEdge&) const = default;
};
struct CandidatePairs {
  std::vector<PointTriangle> points;
  std::vector<EdgeEdge> edges;
};

/// Every vertex and edge belongs to one of its triangles, so that a pair of primitives comes up with one pair of
/// triangles only (after Curtis, Tamstorf and Manocha, 2008).
class PairCollector {
 public:
  PairCollector() = default;
  explicit PairCollector(const ContactMesh& mesh);

  /// Of ContactTree::pairs, the primitives whose own boxes are within `margin_m`, x and slack_m being what the tree was
  /// fitted to; those that share a vertex are not pairs. In no order.
  void collect(const ContactMesh& mesh, const ContactTree& tree, std::span<const Vec3> x,
               std::span<const double> slack_m, double margin_m, double least, CandidatePairs& out) const;

 private:
  std::vector<unsigned char> owned_;  ///< of a triangle: bits 0 to 2 its corners, bits 3 to 5 its edges
};

}  // namespace gambeson
