#include "core/material/fit_stops.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gambeson {

std::vector<double> nonNegativeLeastSquares(const std::vector<double>& values, const std::vector<double>& right,
                                            int columns) {
  using Matrix = Eigen::MatrixXd;
  using Vector = Eigen::VectorXd;
  const auto rows = static_cast<Eigen::Index>(right.size());
  const Eigen::Map<const Matrix> A(values.data(), rows, columns);
  const Eigen::Map<const Vector> b(right.data(), rows);
  Vector x = Vector::Zero(columns);
  std::vector<bool> free(static_cast<std::size_t>(columns), false);
  const double tolerance = 1e-12 * (A.transpose() * b).cwiseAbs().maxCoeff();
  // Of the columns that may differ from zero, without a bound.
  const auto solve = [&] {
    std::vector<int> at;
    for (int j = 0; j < columns; ++j)
      if (free[static_cast<std::size_t>(j)]) at.push_back(j);
    Matrix part(rows, static_cast<Eigen::Index>(at.size()));
    for (std::size_t k = 0; k < at.size(); ++k) part.col(static_cast<Eigen::Index>(k)) = A.col(at[k]);
    const Vector s = part.colPivHouseholderQr().solve(b);
    Vector all = Vector::Zero(columns);
    for (std::size_t k = 0; k < at.size(); ++k) all[at[k]] = s[static_cast<Eigen::Index>(k)];
    return all;
  };
  for (int round = 0; round < 3 * columns; ++round) {
    const Vector slope = A.transpose() * (b - A * x);
    int best = -1;
    for (int j = 0; j < columns; ++j)
      if (!free[static_cast<std::size_t>(j)] && slope[j] > tolerance && (best < 0 || slope[j] > slope[best])) best = j;
    if (best < 0) break;
    free[static_cast<std::size_t>(best)] = true;
    for (Vector s = solve();; s = solve()) {
      double part = 1;
      for (int j = 0; j < columns; ++j)
        if (free[static_cast<std::size_t>(j)] && s[j] <= 0) part = std::min(part, x[j] / (x[j] - s[j]));
      x += part * (s - x);
      if (part == 1) break;
      for (int j = 0; j < columns; ++j)
        if (free[static_cast<std::size_t>(j)] && x[j] <= 1e-14 * x.maxCoeff()) {
          free[static_cast<std::size_t>(j)] = false;
          x[j] = 0;
        }
    }
  }
  return {x.data(), x.data() + columns};
}

namespace {

struct Points {
  std::vector<double> k, m;
};

/// Indices of the turns of the curvature, without those of noise: a way back counts from a twentieth of the whole on.
std::vector<std::size_t> turnsOf(const std::vector<LoopSample>& loop) {
  const auto [low, high] = std::minmax_element(loop.begin(), loop.end(), [](const LoopSample& a, const LoopSample& b) {
    return a.curvature_per_m < b.curvature_per_m;
  });
  const double enough = 0.05 * (high->curvature_per_m - low->curvature_per_m);
  std::vector<std::size_t> turns;
  std::size_t top = 0, bottom = 0;
  int way = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const double k = loop[i].curvature_per_m;
    if (k > loop[top].curvature_per_m) top = i;
    if (k < loop[bottom].curvature_per_m) bottom = i;
    if (way <= 0 && k - loop[bottom].curvature_per_m > enough) {
      if (way < 0) turns.push_back(bottom);
      way = 1, top = i;
    } else if (way >= 0 && loop[top].curvature_per_m - k > enough) {
      if (way > 0) turns.push_back(top);
      way = -1, bottom = i;
    }
  }
  turns.push_back(way > 0 ? top : bottom);
  return turns;
}

/// Points of the virgin curve.
Points virginPoints(const std::vector<LoopSample>& loop, LoopFit& fit) {
  const std::vector<std::size_t> turns = turnsOf(loop);
  double longest = 0;
  for (std::size_t t = 1; t < turns.size(); ++t)
    longest = std::max(longest, std::abs(loop[turns[t]].curvature_per_m - loop[turns[t - 1]].curvature_per_m));
  Points points;
  for (std::size_t t = 1; t < turns.size(); ++t) {
    const LoopSample from = loop[turns[t - 1]], to = loop[turns[t]];
    const double way = to.curvature_per_m > from.curvature_per_m ? 1 : -1;
    if (!(std::abs(to.curvature_per_m - from.curvature_per_m) >= 0.5 * longest)) continue;
    ++fit.branches;
    for (std::size_t i = turns[t - 1] + 1; i <= turns[t]; ++i) {
      const double k = 0.5 * way * (loop[i].curvature_per_m - from.curvature_per_m);
      if (!(k > 0)) continue;
      points.k.push_back(k);
      points.m.push_back(0.5 * way * (loop[i].moment_N - from.moment_N));
      fit.amplitude_N = std::max(fit.amplitude_N, std::abs(points.m.back()));
    }
  }
  fit.points = static_cast<int>(points.k.size());
  return points;
}

/// The parts of a virgin curve with stops at these curvatures, the last of what never slips.
std::vector<double> partsOf(const Points& p, const std::vector<double>& reach) {
  std::vector<double> A;
  for (const double r : reach)
    for (const double k : p.k) A.push_back(std::min(k, r));
  A.insert(A.end(), p.k.begin(), p.k.end());
  return nonNegativeLeastSquares(A, p.m, static_cast<int>(reach.size()) + 1);
}

struct Stop {
  double weight = 0, reach = 0;
};

/// Puts together the two neighbours whose merging moves the curve least, until `most` are left.
void merge(std::vector<Stop>& stops, std::size_t most) {
  while (stops.size() > most) {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j + 1 < stops.size(); ++j) {
      const double a = stops[j].weight, b = stops[j + 1].weight;
      const double moves = a * b / (a + b) * std::pow(stops[j + 1].reach - stops[j].reach, 2);
      if (moves < least) least = moves, best = j;
    }
    Stop& a = stops[best];
    const Stop b = stops[best + 1];
    a = {a.weight + b.weight, (a.weight * a.reach + b.weight * b.reach) / (a.weight + b.weight)};
    stops.erase(stops.begin() + static_cast<long>(best) + 1);
  }
}

}  // namespace

LoopFit fitStops(const std::vector<LoopSample>& loop) {
  constexpr int kGrid = 40;
  for (const LoopSample& s : loop)
    if (!(std::isfinite(s.curvature_per_m) && std::isfinite(s.moment_N)))
      throw InputError({}, "a number of the loop is not finite");
  LoopFit fit;
  const Points p = loop.empty() ? Points{} : virginPoints(loop, fit);
  if (fit.points < 3 * kStops / 2 || !(fit.amplitude_N > 0))
    throw InputError({}, fmt::format("{} points between turns are too few for a loop; allowed: at least {} on one way "
                                     "from turn to turn",
                                     fit.points, 3 * kStops / 2));
  const double span = *std::max_element(p.k.begin(), p.k.end());
  std::vector<double> reach;
  for (int j = 1; j < kGrid; ++j) reach.push_back(span * std::pow(static_cast<double>(j) / kGrid, 1.5));
  std::vector<double> weight = partsOf(p, reach);
  std::vector<Stop> stops;
  for (std::size_t j = 0; j < reach.size(); ++j)
    if (weight[j] > 0) stops.push_back({weight[j], reach[j]});
  // What is next to nothing is noise of the slope, and its curvature would be taken for the end of friction.
  double all = 0;
  for (const Stop& s : stops) all += s.weight;
  std::erase_if(stops, [&](const Stop& s) { return s.weight < 2e-3 * all; });
  merge(stops, kStops);
  reach.clear();
  for (const Stop& s : stops) reach.push_back(s.reach);
  weight = partsOf(p, reach);
  double rise = 0, far = 0;
  for (std::size_t j = 0; j < reach.size(); ++j) {
    rise += weight[j];
    if (weight[j] > 0) far = reach[j];
  }
  if (!(rise > 1e-6 * (rise + weight.back())))
    throw InputError({}, "the loop encloses nothing: bending is elastic, and there are no stops to find");
  fit.stops.last_Nm = weight.back();
  fit.stops.first_Nm = weight.back() + rise;
  fit.stops.span_per_m = far;
  fit.stops.shape.reach.fill(1);
  for (std::size_t j = 0; j < reach.size(); ++j) {
    fit.stops.shape.drop[j] = weight[j] / rise;
    fit.stops.shape.reach[j] = std::min(reach[j] / far, 1.0);
  }
  double sum = 0;
  for (std::size_t i = 0; i < p.k.size(); ++i) {
    double m = weight.back() * p.k[i];
    for (std::size_t j = 0; j < reach.size(); ++j) m += weight[j] * std::min(p.k[i], reach[j]);
    const double off = 2 * std::abs(m - p.m[i]);
    sum += off * off;
    fit.largest_N = std::max(fit.largest_N, off);
  }
  fit.rms_N = std::sqrt(sum / static_cast<double>(p.k.size()));
  return fit;
}

}  // namespace gambeson
