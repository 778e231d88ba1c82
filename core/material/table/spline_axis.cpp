#include "core/material/table/spline_axis.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace gambeson {
namespace {

constexpr int kOrder = 4;

/// The functions of a piece and all their derivatives at its start, of knots t, t[span] <= x < t[span + 1]
/// (Piegl and Tiller, The NURBS Book, eq. 2.5 and 2.9).
std::array<std::array<double, kOrder>, kOrder> derivatives(const std::vector<double>& t, std::size_t span,
                                                           std::size_t degree, double x) {
  // Of degree r: N[r][j] is the function that ends last but `r - j` of those alive.
  std::array<std::array<double, kOrder>, kOrder> N{};
  N[0][0] = 1;
  for (std::size_t r = 1; r <= degree; ++r)
    for (std::size_t j = 0; j <= r; ++j) {
      const std::size_t i = span - r + j;
      if (j > 0) N[r][j] += (x - t[i]) / (t[i + r] - t[i]) * N[r - 1][j - 1];
      if (j < r) N[r][j] += (t[i + r + 1] - x) / (t[i + r + 1] - t[i + 1]) * N[r - 1][j];
    }
  std::array<std::array<double, kOrder>, kOrder> out{};
  for (std::size_t d = 0; d <= degree; ++d) {
    std::array<double, kOrder> D = N[degree - d];
    for (std::size_t r = degree - d + 1; r <= degree; ++r) {
      std::array<double, kOrder> next{};
      for (std::size_t j = 0; j <= r; ++j) {
        const std::size_t i = span - r + j;
        const double p = static_cast<double>(r);
        if (j > 0) next[j] += p / (t[i + r] - t[i]) * D[j - 1];
        if (j < r) next[j] -= p / (t[i + r + 1] - t[i + 1]) * D[j];
      }
      D = next;
    }
    out[d] = D;
  }
  return out;
}

}  // namespace

SplineAxis::SplineAxis(std::vector<double> nodes) : nodes_(std::move(nodes)) {
  const std::size_t n = nodes_.size(), degree = std::min<std::size_t>(3, n - 1);
  order_ = static_cast<int>(degree) + 1;
  if (degree == 0) {
    breaks_ = {nodes_[0], nodes_[0] + 1};
    pieces_ = {1};
    return;
  }
  // Inner knots: all inner nodes but the outermost where cubic, none where there are as many functions without.
  breaks_.push_back(nodes_.front());
  if (degree == 3)
    for (std::size_t i = 2; i + 2 < n; ++i) breaks_.push_back(nodes_[i]);
  breaks_.push_back(nodes_.back());
  std::vector<double> knots(degree, nodes_.front());
  knots.insert(knots.end(), breaks_.begin(), breaks_.end());
  knots.insert(knots.end(), degree, nodes_.back());
  for (std::size_t piece = 0; piece + 1 < breaks_.size(); ++piece) {
    const auto at = derivatives(knots, piece + degree, degree, breaks_[piece]);
    double factorial = 1;
    for (std::size_t power = 0; power <= degree; ++power) {
      if (power > 0) factorial *= static_cast<double>(power);
      for (std::size_t k = 0; k <= degree; ++k) pieces_.push_back(at[power][k] / factorial);
    }
  }
}

SplineAxis::Basis SplineAxis::at(double x) const {
  const auto next = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, x);
  Basis b;
  b.first = static_cast<int>(next - breaks_.begin()) - 1;
  const double s = x - breaks_[static_cast<std::size_t>(b.first)];
  const double* c = pieces_.data() + static_cast<std::ptrdiff_t>(b.first) * order_ * order_;
  for (int power = order_ - 1; power >= 0; --power)
    for (int k = 0; k < order_; ++k) {
      b.value[2][k] = b.value[2][k] * s + 2 * b.value[1][k];
      b.value[1][k] = b.value[1][k] * s + b.value[0][k];
      b.value[0][k] = b.value[0][k] * s + c[power * order_ + k];
    }
  return b;
}

std::vector<double> SplineAxis::coefficients(std::span<const double> values, int lines) const {
  const auto n = static_cast<Eigen::Index>(nodes_.size());
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Basis b = at(nodes_[static_cast<std::size_t>(row)]);
    for (int k = 0; k < order_; ++k) M(row, b.first + k) = b.value[0][k];
  }
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Rows found = M.partialPivLu().solve(Eigen::Map<const Rows>(values.data(), n, lines));
  return {found.data(), found.data() + found.size()};
}

}  // namespace gambeson
