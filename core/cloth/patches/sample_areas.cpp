#include "core/cloth/patches/sample_areas.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Areas below this part of those of the triangles are none: the dual runs away, and they fall on.
constexpr double kNone = 1e-6;
constexpr int kMostSteps = 300;

Matrix matrixOf(const SparseRows& WT) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < WT.rows(); ++r)
    for (int k = WT.offsets[r]; k < WT.offsets[r + 1]; ++k) entries.emplace_back(r, WT.columns[k], WT.values[k]);
  Matrix W(WT.rows(), WT.column_count);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

/// Whether no function follows from others: of each its pivot leaves something, however small its support.
bool isRegular(const Eigen::SimplicialLDLT<Matrix>& factor, const Eigen::VectorXd& diagonal) {
  if (factor.info() != Eigen::Success) return false;
  const Eigen::VectorXd pivots = factor.vectorD();
  for (long i = 0; i < diagonal.size(); ++i)
    if (!(pivots(factor.permutationP().indices()(i)) > 1e-12 * diagonal(i))) return false;
  return true;
}

/// The function that the samples see least, of integral >= 0: inverse iteration from one that is everywhere.
Eigen::VectorXd unseen(Matrix gram, const Eigen::VectorXd& A) {
  Eigen::VectorXd y(A.size());
  for (long i = 0; i < gram.rows(); ++i) {
    double& own = gram.coeffRef(i, i);
    if (own == 0) return Eigen::VectorXd::Unit(A.size(), i);  // no sample sees it at all
    own *= 1 + 1e-12;
  }
  const Eigen::SimplicialLDLT<Matrix> factor(gram);
  if (factor.info() != Eigen::Success)
    throw InputError({"", 0, "sampling"}, "the surface samples do not tell the control points apart");
  for (long i = 0; i < y.size(); ++i) y(i) = std::sin(1.0 + 2.3 * static_cast<double>(i));
  for (int k = 0; k < 5; ++k) y = factor.solve(y).normalized();
  return A.dot(y) < 0 ? Eigen::VectorXd(-y) : y;
}

}  // namespace

std::vector<double> consistentAreas(const SparseRows& WT, std::span<const double> free_area) {
  const Matrix W = matrixOf(WT);
  const Matrix gram = W.transpose() * W;
  Eigen::SimplicialLDLT<Matrix> factor(gram);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-9 * factor.vectorD().maxCoeff()))
    throw InputError({"", 0, "sampling"},
                     "the surface samples do not see every control point; use more samples per cell");
  const Eigen::VectorXd A = Eigen::Map<const Eigen::VectorXd>(free_area.data(), static_cast<long>(free_area.size()));
  Eigen::VectorXd y = factor.solve(A);
  y += factor.solve(A - gram * y);  // one refinement: the identity W^T a = A is used as exact
  const Eigen::VectorXd a = W * y;
  return {a.data(), a.data() + a.size()};
}

SampleAreas positiveAreas(const SparseRows& WT, std::span<const double> free_area, std::span<const double> tributary) {
  const Matrix W = matrixOf(WT);
  const Eigen::VectorXd A = Eigen::Map<const Eigen::VectorXd>(free_area.data(), static_cast<long>(free_area.size()));
  const Eigen::VectorXd g = Eigen::Map<const Eigen::VectorXd>(tributary.data(), static_cast<long>(tributary.size()));
  Eigen::VectorXd a = g, y = Eigen::VectorXd::Zero(A.size());
  Eigen::SimplicialLDLT<Matrix> factor;
  const double small = 1e-14 * A.maxCoeff();
  bool decided = false;
  for (int k = 0; k < kMostSteps && !decided; ++k) {
    const Eigen::VectorXd left = A - W.transpose() * a;
    if (left.cwiseAbs().maxCoeff() <= small) return {{a.data(), a.data() + a.size()}, false, {}};
    const Matrix hessian = W.transpose() * a.asDiagonal() * W;
    if (k == 0) factor.analyzePattern(hessian);
    factor.factorize(hessian);
    if (!isRegular(factor, hessian.diagonal())) {
      if (k == 0) y = unseen(hessian, A);
      decided = true;
      break;
    }
    const Eigen::VectorXd step = factor.solve(left), move = W * step;
    // No area changes more than e-fold in a step; then halve until the dual does not rise.
    double scale = std::min(1.0, 1 / std::max(1e-300, move.cwiseAbs().maxCoeff()));
    const double slope = left.dot(step);
    for (int halvings = 0;; ++halvings, scale *= 0.5) {
      const Eigen::VectorXd next = (a.array() * (scale * move).array().exp()).matrix();
      const double change = (next - a).sum() - scale * A.dot(step);
      if (change <= -1e-4 * scale * slope || halvings == 40 || slope <= 1e-13 * A.sum()) {
        a = next;
        y += scale * step;
        break;
      }
    }
    decided = (a.array() / g.array()).minCoeff() < kNone;
  }
  const double error = (A - W.transpose() * a).cwiseAbs().maxCoeff();
  if (error <= 1e3 * small) return {{a.data(), a.data() + a.size()}, false, {}};
  return {{}, !decided, {y.data(), y.data() + y.size()}};
}

}  // namespace gambeson
