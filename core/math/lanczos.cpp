#include "core/math/lanczos.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gambeson {
namespace {

using Vector = std::vector<double>;

double inner(const Vector& a, const Vector& b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}
void addTo(Vector& a, double factor, const Vector& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += factor * b[i];
}

}  // namespace

std::vector<double> scatteredVector(int size, unsigned seed) {
  Vector v(size);
  std::uint64_t counter = seed * 0x632be59bd9b4e019ULL;
  for (double& value : v) {
    std::uint64_t z = (counter += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    value = static_cast<double>((z ^ (z >> 31)) >> 11) / 4503599627370496.0 - 1.0;
  }
  return v;
}

std::vector<RitzPair> lanczosLargest(const LinearOperator& A, const LinearOperator& M, std::vector<double> start,
                                     std::span<const RitzPair> against, const LanczosOptions& options) {
  const std::size_t n = start.size();
  std::vector<Vector> known;  // M times the vectors to stay clear of
  for (const RitzPair& pair : against) {
    known.emplace_back(n);
    M(pair.vector, known.back());
  }
  std::vector<Vector> basis, image;  // v and M v
  Vector w = std::move(start), Mw(n);
  const auto orthogonalise = [&](Vector& x) {
    for (int pass = 0; pass < 2; ++pass) {
      for (std::size_t k = 0; k < known.size(); ++k) addTo(x, -inner(known[k], x), against[k].vector);
      for (std::size_t k = 0; k < basis.size(); ++k) addTo(x, -inner(image[k], x), basis[k]);
    }
  };
  std::vector<double> diagonal, off;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  const int most = std::min<int>(options.most_steps, static_cast<int>(n - std::min(n, against.size())));
  M(w, Mw);
  const double start_size = std::sqrt(inner(w, Mw));
  orthogonalise(w);
  M(w, Mw);
  double beta = std::sqrt(std::max(inner(w, Mw), 0.0));
  if (!(beta > 1e-12 * start_size)) return {};
  while (static_cast<int>(basis.size()) < most) {
    for (std::size_t i = 0; i < n; ++i) w[i] /= beta, Mw[i] /= beta;
    basis.push_back(w);
    image.push_back(Mw);
    A(basis.back(), w);
    diagonal.push_back(inner(image.back(), w));
    orthogonalise(w);
    M(w, Mw);
    beta = std::sqrt(std::max(inner(w, Mw), 0.0));
    const int m = static_cast<int>(basis.size());
    double largest = 0;
    for (double d : diagonal) largest = std::max(largest, std::abs(d));
    const bool exhausted = !(beta > 1e-14 * largest) || m == most;
    if (exhausted || m % 4 == 0 || m <= 4) {
      Eigen::MatrixXd T = Eigen::MatrixXd::Zero(m, m);
      for (int k = 0; k < m; ++k) T(k, k) = diagonal[k];
      for (int k = 0; k + 1 < m; ++k) T(k, k + 1) = T(k + 1, k) = off[k];
      ritz.compute(T);
      bool done = m >= options.wanted;
      const double scale = std::max(std::abs(ritz.eigenvalues()(0)), std::abs(ritz.eigenvalues()(m - 1)));
      for (int k = 0; done && k < options.wanted; ++k)
        done = beta * std::abs(ritz.eigenvectors()(m - 1, m - 1 - k)) <=
               std::max(options.tolerance * std::abs(ritz.eigenvalues()(m - 1 - k)), 1e-15 * scale);
      if (done || exhausted) break;
    }
    off.push_back(beta);
  }
  std::vector<RitzPair> pairs;
  const int m = static_cast<int>(basis.size());
  for (int k = 0; k < std::min(options.wanted, m); ++k) {
    RitzPair pair{ritz.eigenvalues()(m - 1 - k), beta * std::abs(ritz.eigenvectors()(m - 1, m - 1 - k)), Vector(n)};
    for (int j = 0; j < m; ++j) addTo(pair.vector, ritz.eigenvectors()(j, m - 1 - k), basis[j]);
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace gambeson
