#include "analysis/uncertainty/spread_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace gambeson {

double SpreadFit::total() const {
  double sum = residual * residual;
  for (const double v : variance) sum += v;
  return sum;
}

double SpreadFit::deviation() const { return std::sqrt(total()); }

SpreadFit fitSpread(const std::vector<std::vector<double>>& scores, const std::vector<double>& y) {
  const auto runs = static_cast<Eigen::Index>(y.size());
  const auto factors = static_cast<Eigen::Index>(scores.at(0).size());
  assert(scores.size() == y.size() && runs > factors + 1);
  Eigen::MatrixXd X(runs, factors + 1);
  Eigen::VectorXd Y(runs);
  for (Eigen::Index i = 0; i < runs; ++i) {
    X(i, 0) = 1;
    for (Eigen::Index f = 0; f < factors; ++f) X(i, f + 1) = scores[std::size_t(i)][std::size_t(f)];
    Y(i) = y[std::size_t(i)];
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(X);
  const Eigen::VectorXd c = qr.solve(Y);
  const Eigen::MatrixXd inverse = (X.transpose() * X).inverse();
  const double left = (Y - X * c).squaredNorm();
  const double about = (Y.array() - Y.mean()).matrix().squaredNorm();
  const double s2 = left / static_cast<double>(runs - factors - 1);
  SpreadFit fit;
  fit.center = c(0);
  fit.residual = std::sqrt(s2);
  fit.explained = about > 0 ? 1 - left / about : 1;
  fit.runs = y.size();
  for (Eigen::Index f = 1; f <= factors; ++f) {
    fit.slope.push_back(c(f));
    fit.variance.push_back(std::max(0.0, c(f) * c(f) - s2 * inverse(f, f)));
  }
  return fit;
}

}  // namespace gambeson
