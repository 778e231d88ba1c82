/// Sparse symmetric factorisation: against dense algebra (Eigen), known inertia (Sylvester), singular matrices.

#include "core/math/cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <limits>
#include <random>
#include <thread>

#include "core/error.hpp"

namespace gambeson {
namespace {

SymmetricMatrix sparseOf(const Eigen::MatrixXd& a) {
  SymmetricMatrix m;
  m.size = static_cast<int>(a.rows());
  for (int c = 0; c < m.size; ++c) {
    for (int r = c; r < m.size; ++r)
      if (r == c || a(r, c) != 0) m.rows.push_back(r), m.values.push_back(a(r, c));
    m.offsets.push_back(static_cast<int>(m.rows.size()));
  }
  return m;
}

/// Sparse random symmetric; eigenvalues about +-1, shifted by `shift`.
Eigen::MatrixXd randomSymmetric(int n, double shift, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-1, 1);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  for (int k = 0; k < 4 * n; ++k) {
    const int i = static_cast<int>(random() % n), j = static_cast<int>(random() % n);
    a(i, j) = a(j, i) = d(random);
  }
  return a + shift * Eigen::MatrixXd::Identity(n, n);
}

double relativeError(const SymmetricFactor& factor, const Eigen::MatrixXd& a) {
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(a.rows(), -1, 2), b = a * x, y(a.rows());
  factor.solve({b.data(), static_cast<std::size_t>(b.size())}, {y.data(), static_cast<std::size_t>(y.size())});
  return (y - x).norm() / x.norm();
}

TEST(Cholesky, SolvesRandomPositiveDefiniteSystems) {
  for (int n : {1, 2, 40, 200}) {
    const Eigen::MatrixXd a = randomSymmetric(n, 12, 3);
    SymmetricFactor factor(sparseOf(a));
    ASSERT_EQ(factor.factorise(sparseOf(a)), Definiteness::positive);
    EXPECT_EQ(factor.negativePivots(), 0);
    EXPECT_LT(relativeError(factor, a), 1e-13);
  }
}

/// Entry by entry as in blocks, also side by side: each thread has a factor of its own.
TEST(Cholesky, EntriesWorkSideBySide) {
  for (const double shift : {12.0, 0.4}) {
    const Eigen::MatrixXd a = randomSymmetric(150, shift, 5);
    SymmetricFactor blocks(sparseOf(a));
    const Definiteness is = blocks.factorise(sparseOf(a));
    const auto pivotOf = [&] {
      SymmetricFactor factor(sparseOf(a), Elimination::entries);
      EXPECT_EQ(factor.factorise(sparseOf(a)), is);
      EXPECT_EQ(factor.negativePivots(), blocks.negativePivots());
      EXPECT_LT(relativeError(factor, a), 1e-10);
      return factor.smallestPivot();
    };
    const double alone = pivotOf();
    const auto many = [&] {
      for (int k = 0; k < 20; ++k) EXPECT_EQ(pivotOf(), alone);
    };
    std::thread other(many);
    many();
    other.join();
  }
}

/// Right sides on a few unknowns, of which alone the solution is wanted; an indefinite matrix goes the long way.
TEST(Cholesky, SolvesForWantedUnknowns) {
  for (const double shift : {12.0, 0.4}) {
    const Eigen::MatrixXd a = randomSymmetric(150, shift, 5);
    SymmetricFactor factor(sparseOf(a));
    factor.factorise(sparseOf(a));
    const std::vector<int> wanted{141, 3, 77, 12, 4};
    factor.want(wanted);
    for (int round = 1; round < 3; ++round) {  // nothing of the first is left
      Eigen::VectorXd b = Eigen::VectorXd::Zero(150);
      std::vector<double> right, x(wanted.size());
      for (const int i : wanted) right.push_back(b[i] = round + 0.1 * i);
      factor.solveWanted(right, x);
      const Eigen::VectorXd exact = a.ldlt().solve(b);
      for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(x[k], exact[wanted[k]], 1e-11 * exact.norm());
    }
  }
}

TEST(Cholesky, CountsTheNegativeEigenvaluesOfIndefiniteMatrices) {
  for (double shift : {-8.0, -1.0, -0.1, 0.4, 1.5}) {
    const Eigen::MatrixXd a = randomSymmetric(120, shift, 7);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a);
    const int negative = static_cast<int>((eigen.eigenvalues().array() < 0).count());
    ASSERT_GT(negative, 0);
    SymmetricFactor factor(sparseOf(a));
    ASSERT_EQ(factor.factorise(sparseOf(a)), Definiteness::indefinite);
    EXPECT_EQ(factor.negativePivots(), negative);
    EXPECT_LT(relativeError(factor, a), 1e-9);
  }
}

/// The symbolic part is kept: positive, indefinite and positive again with one object, each with its own values.
TEST(Cholesky, FactorisesAgainAfterAnIndefiniteMatrix) {
  const Eigen::MatrixXd positive = randomSymmetric(60, 12, 5), other = randomSymmetric(60, 15, 5),
                        indefinite = randomSymmetric(60, 0.1, 5);
  SymmetricFactor factor(sparseOf(positive));
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(factor.factorise(sparseOf(positive)), Definiteness::positive);
    EXPECT_LT(relativeError(factor, positive), 1e-13);
    EXPECT_EQ(factor.factorise(sparseOf(indefinite)), Definiteness::indefinite);
    EXPECT_LT(relativeError(factor, indefinite), 1e-9);
    EXPECT_EQ(factor.factorise(sparseOf(other)), Definiteness::positive);
    EXPECT_LT(relativeError(factor, other), 1e-13);
  }
  SymmetricFactor moved = std::move(factor);
  EXPECT_LT(relativeError(moved, other), 1e-13);
}

/// A chain of springs without support: the rows sum to zero. And a chain with a loose point (row 7 is zero).
TEST(Cholesky, SeesThatAMatrixIsSingular) {
  const int n = 30;
  Eigen::MatrixXd chain = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    const double k = 1 + 0.1 * i;
    chain(i, i) += k, chain(i + 1, i + 1) += k, chain(i, i + 1) -= k, chain(i + 1, i) -= k;
  }
  SymmetricFactor factor(sparseOf(chain));
  EXPECT_EQ(factor.factorise(sparseOf(chain)), Definiteness::singular);

  Eigen::MatrixXd loose = Eigen::MatrixXd::Identity(n, n);
  loose(7, 7) = 0;
  SymmetricFactor second(sparseOf(loose));
  EXPECT_EQ(second.factorise(sparseOf(loose)), Definiteness::singular);
  EXPECT_EQ(second.weakestUnknown(), 7);
  loose(7, 7) = 1e-16;
  loose(7, 6) = loose(6, 7) = 1e-20;
  SymmetricFactor third(sparseOf(loose));
  EXPECT_EQ(third.factorise(sparseOf(loose)), Definiteness::positive);  // small, but not against its own diagonal
}

TEST(Cholesky, RefusesValuesThatAreNotFinite) {
  SymmetricMatrix m = sparseOf(Eigen::MatrixXd::Identity(3, 3));
  SymmetricFactor factor(m);
  m.values[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(factor.factorise(m), RunError);
}

/// The library's own loops would start three threads more, whatever OMP_NUM_THREADS says. Tried on a new thread, which
/// has no team yet whatever tests ran before.
TEST(Cholesky, StaysOnTheThreadOfItsCaller) {
  const std::filesystem::path tasks = "/proc/self/task";
  if (!std::filesystem::exists(tasks)) GTEST_SKIP() << "this system does not list a process's threads";
  const auto threads = [&] { return std::distance(std::filesystem::directory_iterator(tasks), {}); };
  // Laplacian of a square grid with blocks of 3: large enough for supernodes with many rows.
  constexpr int side = 40;
  SymmetricMatrix a;
  const auto at = [](int i, int j, int k) { return 3 * (side * j + i) + k; };
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i)
      for (int k = 0; k < 3; ++k) {
        const auto add = [&](int row, double value) { a.rows.push_back(row), a.values.push_back(value); };
        add(at(i, j, k), 5);
        for (int l = k + 1; l < 3; ++l) add(at(i, j, l), 0.1);
        for (int l = 0; l < 3 && i + 1 < side; ++l) add(at(i + 1, j, l), l == k ? -1 : 0.01);
        for (int l = 0; l < 3 && j + 1 < side; ++l) add(at(i, j + 1, l), l == k ? -1 : 0.01);
        a.offsets.push_back(static_cast<int>(a.rows.size()));
      }
  a.size = 3 * side * side;
  long before = 0, after = 0;
  std::thread([&] {
    before = threads();
    SymmetricFactor factor(a);
    EXPECT_EQ(factor.factorise(a), Definiteness::positive);
    std::vector<double> b(a.size, 1.0), x(a.size);
    factor.solve(b, x);
    after = threads();
  }).join();
  EXPECT_EQ(after, before);
}

}  // namespace
}  // namespace gambeson
