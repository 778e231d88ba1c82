#pragma once
/// Small systems with known answers, for the solvers.

#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "core/math/vec.hpp"
#include "core/statics/system.hpp"

namespace gambeson::shapes {

/// The full lower triangle of a dense matrix.
inline SymmetricMatrix fullMatrix(const Eigen::MatrixXd& a) {
  SymmetricMatrix m;
  m.size = static_cast<int>(a.rows());
  for (int c = 0; c < m.size; ++c) {
    for (int r = c; r < m.size; ++r) m.rows.push_back(r), m.values.push_back(a(r, c));
    m.offsets.push_back(static_cast<int>(m.rows.size()));
  }
  return m;
}

/// A system given by functions: internal force, its derivative, and an external force.
class SmallSystem : public System {
 public:
  using Vector = Eigen::VectorXd;
  using Matrix = Eigen::MatrixXd;
  std::function<Vector(const Vector&)> force;
  std::function<Matrix(const Vector&)> tangent;
  std::function<Vector(double)> load;
  Matrix M;
  double rayleigh_mass = 0, rayleigh_stiffness = 0;
  int evaluations = 0;

  explicit SmallSystem(int n) : M(Matrix::Identity(n, n)), sparsity_(fullMatrix(Matrix::Zero(n, n))) {
    load = [n](double) { return Vector::Zero(n); };
  }
  static Vector vectorOf(std::span<const double> y) {
    return Eigen::Map<const Vector>(y.data(), static_cast<long>(y.size()));
  }

  int size() const override { return sparsity_.size; }
  const SymmetricMatrix& sparsity() const override { return sparsity_; }
  double residual(std::span<const double> y, double t, std::span<double> g) override {
    ++evaluations;
    const Vector internal = force(vectorOf(y)), external = load(t), sum = internal - external;
    std::copy(sum.data(), sum.data() + sum.size(), g.begin());
    return std::max(internal.norm(), external.norm());
  }
  void stiffness(std::span<const double> y, double, SymmetricMatrix& K, bool) override {
    K.values = fullMatrix(tangent(vectorOf(y))).values;
  }
  void change(std::span<const double>, double t0, double t1, std::span<double> dg) override {
    const Vector d = load(t0) - load(t1);
    std::copy(d.data(), d.data() + d.size(), dg.begin());
  }
  std::string describe(std::span<const double> motion) const override {
    int most = 0;
    for (int i = 0; i < size(); ++i)
      if (std::abs(motion[i]) > std::abs(motion[most])) most = i;
    return "unknown " + std::to_string(most) + " is loose";
  }
  void mass(bool, SymmetricMatrix& m) override { m.values = fullMatrix(M).values; }
  void damping(std::span<const double> y, double, bool, bool stiffness_part, SymmetricMatrix& D) override {
    const Matrix d = rayleigh_mass * M + (stiffness_part ? rayleigh_stiffness : 0.0) * tangent(vectorOf(y));
    D.values = fullMatrix(d).values;
  }
  bool hasStiffnessDamping() const override { return rayleigh_stiffness > 0; }

 private:
  SymmetricMatrix sparsity_;
};

/// Linear: force K y.
inline SmallSystem linearSystem(const Eigen::MatrixXd& K, const Eigen::VectorXd& load) {
  SmallSystem s(static_cast<int>(K.rows()));
  s.force = [K](const Eigen::VectorXd& y) -> Eigen::VectorXd { return K * y; };
  s.tangent = [K](const Eigen::VectorXd&) { return K; };
  s.load = [load](double t) -> Eigen::VectorXd { return t * load; };
  return s;
}

/// Bars of Green's strain, energy 1/2 EA L ((l^2 - L^2)/(2 L^2))^2; the unknowns are the displacements of all
/// components that are not held.
struct Truss {
  struct Bar {
    int a, b;
    double EA;
  };
  std::vector<Vec3> points;
  std::vector<Bar> bars;
  std::vector<int> unknown;  ///< of each component, -1 where held

  int count() const {
    int n = 0;
    for (int u : unknown) n = std::max(n, u + 1);
    return n;
  }
  SmallSystem system(const Eigen::VectorXd& load) const {
    SmallSystem s(count());
    const Truss t = *this;
    const auto evaluate = [t](const Eigen::VectorXd& y, Eigen::VectorXd* f, Eigen::MatrixXd* K) {
      const auto at = [&](int i) {
        Vec3 x = t.points[i];
        for (int d = 0; d < 3; ++d)
          if (t.unknown[3 * i + d] >= 0) x[d] += y(t.unknown[3 * i + d]);
        return x;
      };
      for (const Bar& bar : t.bars) {
        const double L = norm(t.points[bar.b] - t.points[bar.a]);
        const Vec3 r = at(bar.b) - at(bar.a);
        const double strain = (norm2(r) - L * L) / (2 * L * L);
        for (int e = 0; e < 6; ++e) {
          const int i = t.unknown[3 * (e < 3 ? bar.a : bar.b) + e % 3];
          const double si = e < 3 ? -1 : 1;
          if (i < 0) continue;
          if (f) (*f)(i) += si * bar.EA * strain / L * r[e % 3];
          if (K)
            for (int c = 0; c < 6; ++c) {
              const int j = t.unknown[3 * (c < 3 ? bar.a : bar.b) + c % 3];
              const double sj = c < 3 ? -1 : 1;
              if (j < 0) continue;
              (*K)(i, j) += si * sj * bar.EA / L * (r[e % 3] * r[c % 3] / (L * L) + (e % 3 == c % 3 ? strain : 0.0));
            }
        }
      }
    };
    const int n = count();
    s.force = [evaluate, n](const Eigen::VectorXd& y) {
      Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
      evaluate(y, &f, nullptr);
      return f;
    };
    s.tangent = [evaluate, n](const Eigen::VectorXd& y) {
      Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
      evaluate(y, nullptr, &K);
      return K;
    };
    s.load = [load](double factor) -> Eigen::VectorXd { return factor * load; };
    return s;
  }
};

/// Two bars from (-1, 0, 0) and (1, 0, 0) to the apex (0, 0, h), free in x and z; above it a bar of stiffness `spring`
/// carries the load at its upper end, free in z, where `spring` > 0.
inline Truss misesTruss(double h, double EA, double spring) {
  Truss t{{{-1, 0, 0}, {1, 0, 0}, {0, 0, h}}, {{0, 2, EA}, {1, 2, EA}}, {-1, -1, -1, -1, -1, -1, 0, -1, 1}};
  if (spring > 0) {
    t.points.push_back({0, 0, h + 10});
    t.bars.push_back({2, 3, spring * 10});
    t.unknown.insert(t.unknown.end(), {-1, -1, 2});
  }
  return t;
}

}  // namespace gambeson::shapes
