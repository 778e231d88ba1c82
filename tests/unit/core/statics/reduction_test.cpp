/// The reduction Cᵀ K C against dense algebra, for selections, slanted supports, ties and chains.

#include "core/statics/reduction.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "core/cloth/constraint.hpp"

namespace gambeson {
namespace {

/// Blocks between points at most two apart; diagonal blocks symmetric.
BlockMatrix bandOfBlocks(int points) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> d(-1, 1);
  BlockMatrix K;
  for (int r = 0; r < points; ++r) {
    for (int c = r; c < std::min(points, r + 3); ++c) {
      K.columns.push_back(c);
      double b[9];
      for (double& v : b) v = d(random);
      if (r == c) b[3] = b[1], b[6] = b[2], b[7] = b[5];
      K.values.insert(K.values.end(), b, b + 9);
    }
    K.offsets.push_back(static_cast<long>(K.columns.size()));
  }
  return K;
}

Eigen::MatrixXd dense(const BlockMatrix& K) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * K.rows(), 3 * K.rows());
  for (int r = 0; r < K.rows(); ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          a(3 * r + i, 3 * K.columns[k] + j) = a(3 * K.columns[k] + j, 3 * r + i) = K.values[9 * k + 3 * i + j];
  return a;
}

Eigen::MatrixXd dense(const SparseRows& C) {
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(C.rows(), C.column_count);
  for (int r = 0; r < C.rows(); ++r)
    for (int k = C.offsets[r]; k < C.offsets[r + 1]; ++k) a(r, C.columns[k]) = C.values[k];
  return a;
}

void expectReduced(const std::vector<LinearConstraint>& constraints) {
  const int points = 7;
  FreeMap map{identityRows(points), identityRows(points), {}};
  const DofMap dofs = buildDofMap(map, constraints, 0);
  const BlockMatrix K = bandOfBlocks(points);
  const Reduction reduction(K, dofs.C);
  SymmetricMatrix out = reduction.sparsity();
  reduction.reduce(K, out);
  const Eigen::MatrixXd C = dense(dofs.C), expected = C.transpose() * dense(K) * C;
  Eigen::MatrixXd got = Eigen::MatrixXd::Zero(out.size, out.size);
  for (int c = 0; c < out.size; ++c) {
    ASSERT_EQ(out.rows[out.offsets[c]], c);  // the diagonal comes first
    for (int k = out.offsets[c]; k < out.offsets[c + 1]; ++k) {
      if (k > out.offsets[c]) {
        EXPECT_GT(out.rows[k], out.rows[k - 1]);
      }
      got(out.rows[k], c) = got(c, out.rows[k]) = out.values[k];
    }
  }
  EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(Reduction, AgreesWithTheDenseProduct) {
  const auto hold = [](int point, Vec3 d) { return LinearConstraint{{{point, d}}, 0, -1, ""}; };
  expectReduced({});
  expectReduced({hold(0, {1, 0, 0}), hold(0, {0, 1, 0}), hold(3, {0, 0, 1})});
  expectReduced({hold(0, {1, 2, 3}), hold(4, {0, 1, -1}), hold(6, {3, -1, 0.5})});
  expectReduced({{{{0, {1, 0, 0}}, {1, {-1, 0, 0}}}, 0, -1, ""}, {{{1, {1, 0, 0}}, {2, {0, -1, 0.5}}}, 0, -1, ""}});
  expectReduced({{{{0, {1, 0, 0}}, {6, {-1, 0, 0}}}, 0, -1, ""}, {{{2, {1, 1, 0}}, {5, {0, -1, 2}}}, 0, -1, ""}});
}

TEST(Reduction, BlockProductAgreesWithTheDenseProduct) {
  const BlockMatrix K = bandOfBlocks(6);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(18, -1, 3);
  Eigen::VectorXd y(18);
  multiply(K, {x.data(), 18}, {y.data(), 18});
  EXPECT_LT((y - dense(K) * x).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace gambeson
