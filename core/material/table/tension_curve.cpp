#include "core/material/table/tension_curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// The cubic in an interval of length h, by the values and slopes at its ends, at t = (e - e_0)/h.
struct Cubic {
  double h, F, linear, square, cube;  ///< F + linear t + square t^2 + cube t^3
  Cubic(double h_, double F0, double slope0, double F1, double slope1)
      : h(h_),
        F(F0),
        linear(h * slope0),
        square(3 * (F1 - F0) - h * (2 * slope0 + slope1)),
        cube(-2 * (F1 - F0) + h * (slope0 + slope1)) {}
  double value(double t) const { return F + t * (linear + t * (square + t * cube)); }
  double slope(double t) const { return (linear + t * (2 * square + t * 3 * cube)) / h; }
  double work(double t) const { return h * t * (F + t * (linear / 2 + t * (square / 3 + t * cube / 4))); }
  double greatestSlope() const {
    double most = std::max(slope(0), slope(1));
    if (const double t = -square / (3 * cube); cube < 0 && t > 0 && t < 1) most = std::max(most, slope(t));
    return most;
  }
};

}  // namespace

TensionCurve::TensionCurve(const std::vector<TensilePoint>& points) : knots_{{0, 0, 0, 0}} {
  for (const auto& [e, F] : points) {
    if (!(e > knots_.back().e && F > knots_.back().F) || !std::isfinite(e) || !std::isfinite(F))
      throw InputError({"", 0, ""},
                       fmt::format("point {}, {:g} and {:g} N/m: strains and forces must ascend strictly from above 0, "
                                   "the point before is at {:g} and {:g} N/m",
                                   knots_.size(), e, F, knots_.back().e, knots_.back().F));
    knots_.push_back({e, F, 0, 0});
  }
  if (points.empty()) throw InputError({"", 0, ""}, "has no point; allowed: at least one");
  const std::size_t last = knots_.size() - 1;
  const auto length = [&](std::size_t i) { return knots_[i + 1].e - knots_[i].e; };
  const auto secant = [&](std::size_t i) { return (knots_[i + 1].F - knots_[i].F) / length(i); };
  for (std::size_t i = 1; i < last; ++i) {
    const double a = length(i - 1) + 2 * length(i), b = 2 * length(i - 1) + length(i);
    knots_[i].slope = (a + b) / (b / secant(i - 1) + a / secant(i));
  }
  const auto outer = [](double s, double inner) { return std::min(s * s / inner, 3 * s); };
  knots_[0].slope = last == 1 ? secant(0) : outer(secant(0), knots_[1].slope);
  knots_[last].slope = last == 1 ? secant(0) : outer(secant(last - 1), knots_[last - 1].slope);
  for (std::size_t i = 0; i < last; ++i)
    knots_[i + 1].work =
        knots_[i].work + Cubic(length(i), knots_[i].F, knots_[i].slope, knots_[i + 1].F, knots_[i + 1].slope).work(1);
}

const TensionCurve::Knot& TensionCurve::knotBefore(double e) const {
  return *std::prev(
      std::upper_bound(std::next(knots_.begin()), knots_.end(), e, [](double x, const Knot& k) { return x < k.e; }));
}

double TensionCurve::force(double e) const {
  const Knot& k = knotBefore(e);
  if (&k == &knots_.back()) return k.F + k.slope * (e - k.e);
  const Knot& next = *(&k + 1);
  return Cubic(next.e - k.e, k.F, k.slope, next.F, next.slope).value((e - k.e) / (next.e - k.e));
}

double TensionCurve::work(double e) const {
  const Knot& k = knotBefore(e);
  if (&k == &knots_.back()) return k.work + (e - k.e) * (k.F + 0.5 * k.slope * (e - k.e));
  const Knot& next = *(&k + 1);
  return k.work + Cubic(next.e - k.e, k.F, k.slope, next.F, next.slope).work((e - k.e) / (next.e - k.e));
}

double TensionCurve::strainAt(double F) const {
  const Knot& last = knots_.back();
  if (F >= last.F) return last.e + (F - last.F) / last.slope;
  double low = 0, high = last.e;
  while (true) {
    const double e = 0.5 * (low + high);
    if (!(e > low && e < high)) return e;
    (force(e) < F ? low : high) = e;
  }
}

TensionAnswer TensionCurve::at(double E) const {
  if (!(E > 0)) {
    const double K = knots_.front().slope;
    return {0.5 * K * E * E, K * E, K, false};
  }
  const double stretch = std::sqrt(1 + 2 * E), e = 2 * E / (stretch + 1);
  const Knot& k = knotBefore(e);
  const bool beyond = &k == &knots_.back() && E > end();
  double slope = k.slope;
  if (&k != &knots_.back()) {
    const Knot& next = *(&k + 1);
    slope = Cubic(next.e - k.e, k.F, k.slope, next.F, next.slope).slope((e - k.e) / (next.e - k.e));
  }
  const double n = force(e) / stretch;
  return {work(e), n, (slope - n) / (stretch * stretch), beyond};
}

double TensionCurve::steepest(double low, double high) const {
  double most = low < 0 ? knots_.front().slope : 0;
  const double from = std::sqrt(1 + 2 * std::max(low, 0.)) - 1, to = std::sqrt(1 + 2 * std::max(high, 0.)) - 1;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const Knot& k = knots_[i];
    const bool last = i + 1 == knots_.size();
    if (k.e > to || (!last && knots_[i + 1].e < from)) continue;
    const double stretch = 1 + std::max(k.e, from);  // F' over (1 + e)^2 is no less than dn/dE
    const double slope =
        last ? k.slope
             : Cubic(knots_[i + 1].e - k.e, k.F, k.slope, knots_[i + 1].F, knots_[i + 1].slope).greatestSlope();
    most = std::max(most, slope / (stretch * stretch));
  }
  return most;
}

double TensionCurve::end() const {
  const double e = knots_.back().e;
  return e + 0.5 * e * e;
}

std::vector<TensilePoint> tensilePointsOfKes(double extension, double linearity, double force_N_per_m) {
  constexpr int kPoints = 25;
  const auto points = [&](double b) {  // b: times the extension
    std::vector<TensilePoint> out;
    for (int i = 1; i <= kPoints; ++i) {
      const double x = static_cast<double>(i) / kPoints;
      out.push_back({x * extension,
                     i == kPoints ? force_N_per_m : force_N_per_m * (b == 0 ? x : std::expm1(b * x) / std::expm1(b))});
    }
    return out;
  };
  const auto linearityOf = [&](double b) {
    return TensionCurve(points(b)).work(extension) / (0.5 * extension * force_N_per_m);
  };
  if (linearity == 1) return points(0);
  double low = -6, high = 40;  // LT falls with b
  for (int i = 0; i < 200 && std::nextafter(low, high) < high; ++i) {
    const double b = 0.5 * (low + high);
    (linearityOf(b) > linearity ? low : high) = b;
  }
  return points(0.5 * (low + high));
}

}  // namespace gambeson
