#include "core/statics/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gambeson {

double dot(std::span<const double> a, std::span<const double> b) {
  double s = 0;
  for (std::size_t i = 0; i < a.size(); ++i) s += a[i] * b[i];
  return s;
}
double norm(std::span<const double> a) { return std::sqrt(dot(a, a)); }

double roundingForce(const SymmetricMatrix& K, double length_m) {
  double sum = 0;
  for (int c = 0; c < K.size; ++c) sum += K.values[K.offsets[c]] * K.values[K.offsets[c]];
  return std::numeric_limits<double>::epsilon() * std::sqrt(sum) * length_m;
}

bool endsByRounding(double size, double force, double rounding, bool still) {
  constexpr double kLargest = 1e-3;  // of the forces
  return (size <= rounding || still) && (size <= kLargest * force || force <= rounding);
}

bool isFinite(const SymmetricMatrix& K) {
  return std::all_of(K.values.begin(), K.values.end(), [](double v) { return std::isfinite(v); });
}

namespace {

/// y + s dy, its residual and G(s) = dy . r.
class Line {
 public:
  Line(Equations& equations, const std::vector<double>& y, const std::vector<double>& dy)
      : equations_(equations), y_(y), dy_(dy), point(y.size()), r(dy.size()) {}

  double slope(double s) {
    equations_.retract(y_, dy_, s, point);
    force = equations_.residual(point, r);
    at = s;
    return dot(dy_, r);
  }

 private:
  Equations& equations_;
  const std::vector<double>&y_, &dy_;

 public:
  std::vector<double> point, r;  ///< of the last evaluation
  double force = 0, at = 0;
};

constexpr double kSlopeRatio = 0.8, kLeastStep = 0.02;
constexpr int kSearches = 6;

/// Ends on a point of the line; false where no finite one was found. `finite` becomes false where one was not.
bool search(Line& line, double slope0, bool line_search, bool& finite) {
  double right = 1, slope = line.slope(1);
  for (int k = 0; !std::isfinite(slope) && k < 10; ++k) finite = false, slope = line.slope(right *= 0.5);
  if (!std::isfinite(slope)) return false;
  if (!line_search || std::abs(slope) <= kSlopeRatio * std::abs(slope0) || slope * slope0 >= 0) return true;
  double left = 0, slope_left = slope0, slope_right = slope;
  for (int k = 0; k < kSearches; ++k) {
    double s = left + (right - left) * slope_left / (slope_left - slope_right);
    s = std::clamp(s, left + 0.1 * (right - left), right - 0.1 * (right - left));
    if (s < kLeastStep) s = kLeastStep;
    slope = line.slope(s);
    if (!std::isfinite(slope)) return false;
    if (std::abs(slope) <= kSlopeRatio * std::abs(slope0) || s == kLeastStep) return true;
    if (slope * slope0 > 0) {
      left = s, slope_left = slope, slope_right *= 0.5;  // Illinois
    } else {
      right = s, slope_right = slope, slope_left *= 0.5;
    }
  }
  return true;
}

}  // namespace

NewtonReport solveNewton(Equations& equations, const NewtonOptions& options, std::vector<double>& y, SymmetricMatrix& K,
                         SymmetricFactor& factor) {
  NewtonReport report;
  std::vector<double> r(static_cast<std::size_t>(K.size)), dy(r.size());
  double force = equations.residual(y, r);
  bool still = false;  // the last correction was rounding
  double raise = 0;    // of the diagonal, descending only
  for (;; ++report.iterations) {
    const double size = norm(r);
    report.force = std::max(force, options.least_force);
    report.residual = size == 0 ? 0 : size / report.force;
    report.residuals.push_back(report.residual);
    if (!std::isfinite(size)) {
      report.finite = false;
      return report;
    }
    const bool balanced = size <= options.tolerance * report.force;
    const auto isRounding = [&] {
      return endsByRounding(size, report.force, roundingForce(K, options.length_m), still);
    };
    bool rounded = !balanced && isRounding();
    if (rounded) {  // by the tangent of another state, which may have been far away
      equations.tangent(y, K);
      rounded = isRounding();
    }
    if (balanced || rounded) {
      report.converged = true;
      report.rounded = rounded;
      return report;
    }
    report.stalled = still;
    if (report.iterations == options.iterations) return report;
    equations.tangent(y, K);
    if (!isFinite(K)) {
      report.finite = false;
      return report;
    }
    double largest_diagonal = 0;
    for (int c = 0; c < K.size; ++c) largest_diagonal = std::max(largest_diagonal, std::abs(K.values[K.offsets[c]]));
    raise = raise > 1e-11 * largest_diagonal ? 0.3 * raise : 0;
    for (int c = 0; c < K.size && raise > 0; ++c) K.values[K.offsets[c]] += raise;
    Definiteness definite = factor.factorise(K);
    ++report.factorisations;
    while (options.descend && definite != Definiteness::positive && raise < largest_diagonal) {
      const double more = std::max(4 * raise, 1e-10 * largest_diagonal) - raise;
      raise += more;
      for (int c = 0; c < K.size; ++c) K.values[K.offsets[c]] += more;
      definite = factor.factorise(K);
      ++report.factorisations;
    }
    report.singular = definite == Definiteness::singular;
    report.negative_pivots = factor.negativePivots();
    if (!factor.solvable()) return report;
    factor.solve(r, dy);
    for (double& v : dy) v = -v;
    double largest = 0;
    for (double v : dy) largest = std::max(largest, std::abs(v));
    if (!std::isfinite(largest)) {
      report.finite = false;
      return report;
    }
    still = largest <= 1e-14 * options.length_m;
    Line line(equations, y, dy);
    if (!search(line, dot(dy, r), options.line_search || options.descend, report.finite)) {
      report.finite = false;
      return report;
    }
    y.swap(line.point);
    r.swap(line.r);
    force = line.force;
  }
}

}  // namespace gambeson
