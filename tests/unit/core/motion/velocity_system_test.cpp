/// The linear system of implicit steps: conjugate gradients against a direct solution, definiteness where cloth is
/// compressed.

#include "core/motion/velocity_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "unit/core/cloth/triangles/triangle_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A sheet held at an edge, hung on springs, crumpled by displacements of up to `amplitude` of a cell.
Motion crumpled(double amplitude, const ShellOptions& shell = {}) {
  const Garment g = squareSheet(5, 0.2, 0);
  ModelOptions o;
  for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  o.anchor_count = 1;
  o.springs = {{12, 0, 5}, {80, 0, 50}};
  Motion m(g, {{0, 0, -9.81}, 0.5}, {}, o, {}, {}, {}, shell);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const double t = i;
    if (!m.model->held[i])
      m.state.p[i] += (amplitude * 0.04) * Vec3{std::sin(5 * t), std::cos(7 * t + 1), std::sin(11 * t + 2)};
  }
  m.restart();
  return m;
}

Eigen::MatrixXd dense(const VelocitySystem& system, int n) {
  Eigen::MatrixXd A(3 * n, 3 * n);
  std::vector<Vec3> x(n), y(n);
  for (int c = 0; c < 3 * n; ++c) {
    x.assign(n, Vec3{});
    x[c / 3][c % 3] = 1;
    system.multiply(x, y);
    for (int r = 0; r < 3 * n; ++r) A(r, c) = y[r / 3][r % 3];
  }
  return A;
}

struct Assembled {
  VelocitySystem system;
  bool definite = false;

  Assembled(Motion& m, double dt) {
    const AnchorInstant at(*m.model, m.stage, 0);
    definite = system.assemble(*m.model, m.state, at.frames(), {}, dt, m.work);
  }
};

TEST(VelocitySystem, ConjugateGradientsAgreeWithADirectSolution) {
  for (const double amplitude : {0.0, 0.3, 1.0}) {
    Motion m = crumpled(amplitude);
    const int n = m.model->freeCount();
    Assembled a(m, 5e-3);
    ASSERT_TRUE(a.definite);
    std::vector<Vec3> b(n), x(n);
    for (int i = 0; i < n; ++i)
      b[i] = m.model->mass_kg[i] * Vec3{std::sin(3.0 * i), std::cos(5.0 * i), std::sin(i * i)};
    const CgReport r = a.system.solve(b, 1e-13, x);
    EXPECT_TRUE(r.converged);
    // Without the held points.
    std::vector<int> free;
    for (int i = 0; i < n; ++i)
      if (!m.model->held[i])
        for (int d = 0; d < 3; ++d) free.push_back(3 * i + d);
    const Eigen::MatrixXd A = dense(a.system, n);
    const int size = static_cast<int>(free.size());
    Eigen::MatrixXd reduced(size, size);
    Eigen::VectorXd right(size);
    for (int r2 = 0; r2 < size; ++r2) {
      right(r2) = b[free[r2] / 3][free[r2] % 3];
      for (int c = 0; c < size; ++c) reduced(r2, c) = A(free[r2], free[c]);
    }
    EXPECT_LT((reduced - reduced.transpose()).norm(), 1e-13 * reduced.norm());
    const Eigen::VectorXd direct = reduced.ldlt().solve(right);
    double error = 0;
    for (int k = 0; k < size; ++k) error = std::max(error, std::abs(direct(k) - x[free[k] / 3][free[k] % 3]));
    EXPECT_LT(error, 1e-8 * direct.lpNorm<Eigen::Infinity>()) << amplitude;
    for (int i = 0; i < n; ++i)
      EXPECT_TRUE(!m.model->held[i] || norm(x[i]) == 0);
  }
}

/// Crumpled cloth is compressed: its own stiffness has negative values, what the system takes of it has none, for a
/// step of any length. Internal forces still sum to nothing: K of a translation is none.
TEST(VelocitySystem, IsPositiveWhereClothIsCompressed) {
  for (const CellRule rule : {CellRule::automatic, CellRule::full}) {
    ShellOptions shell;
    shell.rule = rule;
    Motion m = crumpled(0.2, shell);
    for (Vec3& x : m.state.p) x = {0.8 * x.x, 0.9 * x.y, x.z};
    const Cloth& cloth = *m.model->cloth;
    const int n = m.model->freeCount();
    std::vector<Vec3> q(cloth.points());
    cloth.map().T.multiply<Vec3>(m.state.p, q);
    double lowest[2];
    for (const bool definite : {false, true}) {
      const auto tangent = cloth.tangent();
      BlockMatrix K = tangent->sparsity();
      ForceTerms terms;
      terms.definite = definite;
      tangent->assemble({q, {}, {}}, m.work.cloth, K, terms);
      BlockProduct product(K);
      product.set(K);
      Eigen::MatrixXd A(3 * n, 3 * n);
      std::vector<Vec3> x(n), y(n);
      for (int c = 0; c < 3 * n; ++c) {
        x.assign(n, Vec3{});
        x[c / 3][c % 3] = 1;
        product.multiply(x, y);
        for (int r = 0; r < 3 * n; ++r) A(r, c) = y[r / 3][r % 3];
      }
      const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A).eigenvalues();
      lowest[definite] = values(0) / values(values.size() - 1);
      x.assign(n, Vec3{1, 2, 3});
      product.multiply(x, y);
      double most = 0;
      for (const Vec3& f : y) most = std::max(most, norm(f));
      EXPECT_LT(most, 1e-12 * values(values.size() - 1));
    }
    EXPECT_LT(lowest[0], -1e-3);
    EXPECT_GT(lowest[1], -1e-12);
  }
}

}  // namespace
}  // namespace gambeson
