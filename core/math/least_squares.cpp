#include "core/math/least_squares.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include <cmath>
#include <cstddef>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// As Eigen wants residuals: of numbers in units of their start.
struct Functor {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Residuals& residuals;
  const std::vector<double>& unit;
  int count;

  int inputs() const { return static_cast<int>(unit.size()); }
  int values() const { return count; }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    std::vector<double> y(unit.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = x[static_cast<long>(i)] * unit[i];
    residuals(y, {r.data(), static_cast<std::size_t>(r.size())});
    return r.allFinite() ? 0 : -1;
  }
};

}  // namespace

LeastSquares leastSquares(const Residuals& residuals, int count, const std::vector<double>& start) {
  const int n = static_cast<int>(start.size());
  if (!(count > n))
    throw InputError({"", 0, ""}, fmt::format("{} measurements determine no {} numbers and their errors; allowed: at "
                                              "least {}",
                                              count, n, n + 1));
  using Central = Eigen::NumericalDiff<Functor, Eigen::Central>;
  Central functor(Functor{residuals, start, count});
  Eigen::LevenbergMarquardt<Central> solver(functor);
  solver.parameters.xtol = solver.parameters.ftol = 1e-12;
  solver.parameters.maxfev = 2000;
  Eigen::VectorXd x = Eigen::VectorXd::Ones(n), r(count);
  solver.minimize(x);
  Eigen::MatrixXd J(count, n);
  if (!x.allFinite() || functor(x, r) < 0 || functor.df(x, J) < 0 || !J.allFinite())
    throw InputError({"", 0, ""}, "no numbers fit: residuals are not finite");
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J);
  if (qr.rank() < n) throw InputError({"", 0, ""}, "the measurements do not determine all numbers");
  const Eigen::MatrixXd covariance = (J.transpose() * J).inverse() * (r.squaredNorm() / (count - n));
  LeastSquares out;
  out.rms = std::sqrt(r.squaredNorm() / count);
  for (int i = 0; i < n; ++i) {
    const double unit = start[static_cast<std::size_t>(i)];
    out.value.push_back(x[i] * unit);
    out.error.push_back(std::sqrt(covariance(i, i)) * std::abs(unit));
  }
  return out;
}

}  // namespace gambeson
