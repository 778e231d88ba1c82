#include "core/motion/lanczos.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace gambeson {

double noiseOfLanczos(int n) { return 0.1 / std::sqrt(n); }

bool goesOn(double length, double first) { return length > 1e-9 * std::abs(first); }

LargestOf largestOf(std::span<const double> diagonal, std::span<const double> off) {
  const int size = static_cast<int>(diagonal.size());
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(size, size);
  for (int k = 0; k < size; ++k) {
    T(k, k) = diagonal[k];
    if (k + 1 < size) T(k, k + 1) = T(k + 1, k) = off[k];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(T);
  LargestOf largest{solver.eigenvalues()(size - 1), {}};
  for (int k = 0; k < size; ++k) largest.vector.push_back(solver.eigenvectors()(k, size - 1));
  return largest;
}

}  // namespace gambeson
