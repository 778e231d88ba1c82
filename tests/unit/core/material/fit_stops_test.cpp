// Stops from raw loops.
#include "core/material/fit_stops.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gambeson {
namespace {

/// From 0 to K, to -K and to K in steps, as an instrument draws it: with the zero of the moment off, and noise.
std::vector<LoopSample> drawn(const Stops<kStops>& stops, double K, int steps, double shift_N, double noise_N) {
  BentLine<kStops> line(stops);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-noise_N, noise_N);
  std::vector<LoopSample> loop{{0, shift_N}};
  double from = 0;
  for (const double to : {K, -K, K}) {
    for (int i = 1; i <= steps; ++i) {
      const double k = from + (to - from) * i / steps;
      loop.push_back({k, line.bend(k) + shift_N + noise(random)});
    }
    from = to;
  }
  return loop;
}

/// The largest difference of the loops that two sums of stops make, over the amplitude of the moment.
double apart(const Stops<kStops>& a, const Stops<kStops>& b, double K) {
  BentLine<kStops> one(a), two(b);
  double most = 0, size = 0, from = 0;
  for (const double to : {K, -K, 0.4 * K, -0.2 * K, K}) {
    for (int i = 1; i <= 50; ++i) {
      const double k = from + (to - from) * i / 50, m = one.bend(k);
      most = std::max(most, std::abs(m - two.bend(k)));
      size = std::max(size, std::abs(m));
    }
    from = to;
  }
  return most / size;
}

TEST(FitStops, FindsTheStopsOfALoop) {
  const Stops<kStops> stops = stopsOf<kStops>(quadraticCurve(7.6e-6, 2.6e-6, -3.8e-8));
  const LoopFit fit = fitStops(drawn(stops, 250, 125, 3e-5, 0));
  EXPECT_EQ(fit.branches, 2) << "the first way starts at no turn";
  EXPECT_NEAR(fit.stops.last_Nm / stops.last_Nm, 1, 0.005);
  EXPECT_NEAR(fit.stops.frictionMoment() / stops.frictionMoment(), 1, 0.01);
  EXPECT_LT(fit.rms_N, 0.002 * fit.amplitude_N);
  EXPECT_LT(apart(stops, fit.stops, 250), 0.01);
  double sum = 0;
  for (const double drop : fit.stops.shape.drop) {
    EXPECT_GE(drop, 0);
    sum += drop;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
}

TEST(FitStops, NoiseDoesNotMatterMuch) {
  const Stops<kStops> stops = stopsOf<kStops>(quadraticCurve(7.6e-6, 2.6e-6, -3.8e-8));
  const LoopFit fit = fitStops(drawn(stops, 250, 125, 0, 1e-5));
  EXPECT_LT(fit.rms_N, 2e-5);
  EXPECT_LT(apart(stops, fit.stops, 250), 0.03);
}

TEST(FitStops, OneStopIsOneStop) {
  Stops<kStops> stops;
  stops.first_Nm = 3e-5;
  stops.last_Nm = 1e-5;
  stops.span_per_m = 40;
  stops.shape.reach.fill(1);
  stops.shape.drop[0] = 1;
  const LoopFit fit = fitStops(drawn(stops, 250, 250, 0, 0));
  EXPECT_LT(apart(stops, fit.stops, 250), 0.01);
}

TEST(FitStops, RefusesWhatIsNoLoop) {
  std::vector<LoopSample> line;
  for (int i = -50; i <= 50; ++i) line.push_back({5. * i, 1e-5 * 5 * i});
  for (int i = 49; i >= -50; --i) line.push_back({5. * i, 1e-5 * 5 * i});
  EXPECT_THROW(fitStops(line), InputError) << "elastic";
  EXPECT_THROW(fitStops({}), InputError);
  EXPECT_THROW(fitStops({{0, 0}, {1, 1}, {0, 0}, {1, 1}}), InputError) << "too few points";
  line[3].moment_N = std::nan("");
  EXPECT_THROW(fitStops(line), InputError);
}

TEST(FitStops, LeastSquaresStayNonNegative) {
  // min |x0 + x1 - 1|, |x0 - x1 - 3|: without bounds (2, -1); with them (2, 0).
  const std::vector<double> x = nonNegativeLeastSquares({1, 1, 1, -1}, {1, 3}, 2);
  EXPECT_NEAR(x[0], 2, 1e-14);
  EXPECT_EQ(x[1], 0);
  const std::vector<double> y = nonNegativeLeastSquares({1, 0, 1, 0, 1, 1}, {2, 3, 4}, 2);
  EXPECT_NEAR(y[0], 5. / 3, 1e-14);
  EXPECT_NEAR(y[1], 8. / 3, 1e-14);
}

}  // namespace
}  // namespace gambeson
