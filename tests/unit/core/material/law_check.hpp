#pragma once
/// The check that every law of core/material/laws passes: energy against resultants against slope.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/material/laws/law.hpp"
#include "unit/core/material/dual.hpp"

namespace gambeson {

/// What a law answers to N strains, its slope as a full matrix.
template <class S, int N>
struct Evaluated {
  S potential{};  ///< energy, and what was lost since the history was committed: its gradient are the resultants
  S resultant[N]{};
  S slope[N][N]{};
};

template <class S, int N>
Evaluated<S, N> evaluated(const Answer<S, N>& a) {
  Evaluated<S, N> out;
  out.potential = a.energy + a.lost;
  for (int i = 0; i < N; ++i) out.resultant[i] = a.resultant[i];
  constexpr int voigt[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) out.slope[i][j] = a.slope[voigt[i][j]];
  return out;
}

/// The largest errors of a law at a point, as parts of the largest of what they are errors of.
struct LawErrors {
  double gradient = 0;  ///< resultants against differences of the potential
  double slope = 0;     ///< slope against differences of the resultants
  double dual = 0;      ///< both against the derivatives of dual numbers, which know no step
};

/// `law(x)` is Evaluated<S, N> at N strains x of S = double and S = Dual. `step`: of the differences, of fourth order;
/// the law is smooth within two steps of x.
template <int N, class Law>
LawErrors lawErrors(const Law& law, const std::array<double, N>& x, double step, bool has_potential = true) {
  const auto at = [&](int j, double way) {
    std::array<double, N> y = x;
    y[j] += way * step;
    return law(y.data());
  };
  const auto here = law(x.data());
  double scale = 0, slope_scale = 0, gradient = 0, slope = 0, dual_gradient = 0, dual_slope = 0;
  for (int i = 0; i < N; ++i) {
    scale = std::max(scale, std::abs(here.resultant[i]));
    for (int j = 0; j < N; ++j) slope_scale = std::max(slope_scale, std::abs(here.slope[i][j]));
  }
  for (int j = 0; j < N; ++j) {
    const auto a = at(j, -2), b = at(j, -1), c = at(j, 1), d = at(j, 2);
    const auto difference = [&](auto get) { return (8 * (get(c) - get(b)) - (get(d) - get(a))) / (12 * step); };
    std::array<Dual, N> moved;
    for (int i = 0; i < N; ++i) moved[i] = {x[i], i == j ? 1.0 : 0.0};
    const auto exact = law(moved.data());
    if (has_potential) {
      gradient =
          std::max(gradient, std::abs(difference([](const auto& e) { return e.potential; }) - here.resultant[j]));
      dual_gradient = std::max(dual_gradient, std::abs(exact.potential.slope - here.resultant[j]));
    }
    for (int i = 0; i < N; ++i) {
      slope = std::max(slope, std::abs(difference([&](const auto& e) { return e.resultant[i]; }) - here.slope[i][j]));
      dual_slope = std::max(dual_slope, std::abs(exact.resultant[i].slope - here.slope[i][j]));
    }
  }
  return {gradient / scale, slope / slope_scale, std::max(dual_gradient / scale, dual_slope / slope_scale)};
}

}  // namespace gambeson
