#pragma once
/// Cubic splines through values at given nodes of one variable.

#include <span>
#include <vector>

namespace gambeson {

/// Splines of degree p = min(3, n - 1) through n nodes, p - 1 times continuously differentiable. Cubic ones are
/// not-a-knot: the third derivative goes on across the second node and the last but one (de Boor, A Practical Guide to
/// Splines, chapter IV).
class SplineAxis {
 public:
  /// Nodes ascend strictly.
  explicit SplineAxis(std::vector<double> nodes);

  /// Functions that do not vanish at a place: p + 1.
  int order() const { return order_; }
  int count() const { return static_cast<int>(nodes_.size()); }
  std::span<const double> nodes() const { return nodes_; }

  /// The functions first, first + 1, ... at a place, and their first and second derivatives. Beyond the nodes the
  /// polynomials of the first and the last piece go on.
  struct Basis {
    int first = 0;
    double value[3][4]{};
  };
  Basis at(double x) const;

  /// From values at nodes to coefficients, both [node][line] with `lines` numbers a node.
  std::vector<double> coefficients(std::span<const double> values, int lines) const;

 private:
  std::vector<double> nodes_, breaks_;
  int order_ = 1;
  /// Of each piece and function the polynomial in the distance from the piece's start, [piece][power][function].
  std::vector<double> pieces_;
};

}  // namespace gambeson
