// The factor of a matrix within its envelope: against the matrix itself, with rows that depend on others.
#include "core/math/envelope.hpp"

#include <gtest/gtest.h>

#include <random>

namespace gambeson {
namespace {

/// A Aᵀ of a random sparse A with `rows` rows, the last `copies` of which are sums of two others.
SymmetricMatrix gram(int rows, int copies, int columns, std::vector<std::vector<double>>& A) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1, 1);
  A.assign(static_cast<std::size_t>(rows), std::vector<double>(static_cast<std::size_t>(columns), 0.0));
  for (int r = 0; r < rows; ++r)
    for (int k = 0; k < 4; ++k) A[r][static_cast<std::size_t>((7 * r + 3 * k * k) % columns)] += value(random);
  for (int r = rows - copies; r < rows; ++r)
    for (int c = 0; c < columns; ++c) A[r][c] = A[r - copies][c] + 2 * A[r - 2 * copies][c];
  SymmetricMatrix K;
  K.size = rows;
  for (int c = 0; c < rows; ++c) {
    for (int r = c; r < rows; ++r) {
      double sum = 0;
      for (int k = 0; k < columns; ++k) sum += A[r][k] * A[c][k];
      if (r == c || sum != 0) K.rows.push_back(r), K.values.push_back(sum);
    }
    K.offsets.push_back(static_cast<int>(K.rows.size()));
  }
  return K;
}

double residual(const SymmetricMatrix& K, const std::vector<Vec3>& x, const std::vector<Vec3>& b) {
  double worst = 0;
  for (int d = 0; d < 3; ++d) {
    std::vector<double> in, out(x.size());
    for (const Vec3& v : x) in.push_back(v[d]);
    multiply(K, in, out);
    for (std::size_t i = 0; i < b.size(); ++i) worst = std::max(worst, std::abs(out[i] - b[i][d]));
  }
  return worst;
}

TEST(EnvelopeFactor, SolvesForWhatTheMatrixMakes) {
  for (const int copies : {0, 5}) {
    std::vector<std::vector<double>> A;
    const SymmetricMatrix K = gram(40, copies, 60, A);
    const EnvelopeFactor factor(K);
    EXPECT_EQ(factor.leftOut(), copies);
    std::vector<Vec3> b(40), x, scratch;
    for (int r = 0; r < 40; ++r)
      for (int c = 0; c < 60; ++c) b[r] += A[r][c] * Vec3{std::sin(c), std::cos(2.0 * c), 1.0 / (1 + c)};
    x = b;
    factor.solve(x, scratch);
    EXPECT_LT(residual(K, x, b), 1e-11);
  }
}

TEST(EnvelopeFactor, AnEmptyRowIsLeftOut) {
  SymmetricMatrix K;
  K.size = 3;
  K.offsets = {0, 1, 2, 3};
  K.rows = {0, 1, 2};
  K.values = {4, 0, 9};
  std::vector<Vec3> x{{4, 8, 0}, {}, {9, 0, 18}}, scratch;
  const EnvelopeFactor factor(K);
  EXPECT_EQ(factor.leftOut(), 1);
  factor.solve(x, scratch);
  EXPECT_EQ(x[0], (Vec3{1, 2, 0}));
  EXPECT_EQ(x[1], (Vec3{}));
  EXPECT_EQ(x[2], (Vec3{1, 0, 2}));
}

}  // namespace
}  // namespace gambeson
