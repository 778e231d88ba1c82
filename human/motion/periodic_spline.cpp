#include "human/motion/periodic_spline.hpp"

#include <cassert>
#include <cmath>

namespace gambeson {

/// The second derivatives solve m[i-1] + 4 m[i] + m[i+1] = 6 (x[i-1] - 2 x[i] + x[i+1]) / h², a circulant system. Its
/// inverse is the circulant of g[k] = A (z^k + z^(n-k)) / (1 - z^n), z = sqrt(3) - 2, A = 1 / (4 + 2 z).
PeriodicSpline::PeriodicSpline(std::vector<double> values) : x_(std::move(values)), m_(x_.size()) {
  const int n = static_cast<int>(x_.size());
  assert(n >= 3);
  const double z = std::sqrt(3.0) - 2, scale = 1 / (4 + 2 * z) / (1 - std::pow(z, n));
  std::vector<double> g(n), r(n);
  for (int k = 0; k < n; ++k) {
    g[k] = scale * (std::pow(z, k) + std::pow(z, n - k));
    r[k] = 6.0 * n * n * (x_[(k + n - 1) % n] - 2 * x_[k] + x_[(k + 1) % n]);
  }
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) m_[i] += g[k] * r[(i + k) % n];
}

double PeriodicSpline::at(double phase) const {
  const int n = static_cast<int>(x_.size());
  const double s = (phase - std::floor(phase)) * n;
  const int i = std::min(static_cast<int>(s), n - 1), j = (i + 1) % n;
  const double u = s - i, w = 1 - u;
  return w * x_[i] + u * x_[j] + ((w * w * w - w) * m_[i] + (u * u * u - u) * m_[j]) / (6.0 * n * n);
}

}  // namespace gambeson
