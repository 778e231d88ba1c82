#pragma once
/// From measured curves of bending to sums of stops (core/material/laws/stops.hpp), and what an instrument would read
/// of one.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/material/laws/stops.hpp"

namespace gambeson {

/// The moment m [N] of cloth that is bent for the first time to a curvature k [1/m], which is its sum of stops: odd,
/// from 0 on concave, straight from `span_per_m` on.
struct VirginCurve {
  std::function<double(double k)> moment;  ///< for 0 <= k <= span
  std::function<double(double k)> slope;   ///< [N m], to the right of k
  double span_per_m = 0;                   ///< K0
  std::vector<double> corners_per_m;       ///< where its slope jumps, if it is a polygon
};

/// Wong 2014, eq. 4.2: m = b1 k + c1 k^2 up to K0 = (b2 - b1)/(2 c1), from there on with the slope b2. Throws
/// InputError unless b1 > b2 >= 0 and c1 < 0 [N m, N m^2]. (Section 4.3 says b1 <= b2; all values used have b1 > b2.)
VirginCurve quadraticCurve(double b1_Nm, double b2_Nm, double c1_Nm2);
/// The same of its ends: from b1 to b2 over K0 > 0 [1/m].
VirginCurve curveOver(double b1_Nm, double b2_Nm, double span_per_m);
/// Zheng 2013, eq. 2.14, as ZhengBending regularises it.
VirginCurve zhengVirginCurve(double b0_Nm, double k0_per_m, double kr_per_m);
/// A polygon through measured points (k, m), from (0, 0) on; its last two points give the last slope. Throws InputError
/// unless k and m rise and the slope falls.
VirginCurve measuredCurve(const std::vector<std::pair<double, double>>& points);

/// A sum of N stops in SI units.
template <int N>
struct Stops {
  StopShape<N> shape;
  double first_Nm = 0, last_Nm = 0;  ///< slopes b1 and b2
  double span_per_m = 0;             ///< K0

  double rise_Nm() const { return first_Nm - last_Nm; }
  /// The friction that all stops hold, M0 [N].
  double frictionMoment() const {
    double sum = 0;
    for (int j = 0; j < N; ++j) sum += shape.drop[j] * shape.reach[j];
    return rise_Nm() * span_per_m * sum;
  }
};

/// Stops whose virgin curve is that one: each has the fall of the slope over its interval, and slips at the centroid of
/// that fall. Intervals end at K0 (j/N)^1.5, or at the corners of a polygon that has at most N. Throws InputError where
/// the curve is not concave.
template <int N>
Stops<N> stopsOf(const VirginCurve& curve) {
  const double span = curve.span_per_m;
  const std::size_t corners = curve.corners_per_m.size();
  const bool polygon = corners > 0 && corners <= N;
  Stops<N> out{{}, curve.slope(0), curve.slope(span), span};
  double from = 0, sum = 0;
  const auto intercept = [&](double k) { return curve.moment(k) - k * curve.slope(k); };
  for (std::size_t j = 0; j < N; ++j) {
    const double to = polygon ? curve.corners_per_m[std::min(j, corners - 1)] : span * std::pow((j + 1.0) / N, 1.5);
    const double drop = curve.slope(from) - curve.slope(to);
    if (!(drop >= 0))
      throw InputError({}, "the curve is steeper at " + std::to_string(to) + " 1/m than before: it must be concave");
    out.shape.drop[j] = drop;
    out.shape.reach[j] = drop > 0 ? std::min((intercept(to) - intercept(from)) / (drop * span), 1.0) : to / span;
    sum += drop;
    from = to;
  }
  for (double& drop : out.shape.drop) drop = sum > 0 ? drop / sum : 1.0 / N;
  return out;
}

/// Set and fatigue of stops: lambda, mu, and the curvature to which a cycle of reference goes [1/m].
struct Ageing {
  double setting = 0, fatigue = 0, cycle_per_m = 250;
};

/// A line of cloth that is bent step by step.
template <int N>
class BentLine {
 public:
  explicit BentLine(const Stops<N>& stops, const Ageing& ageing = {})
      : stops_(stops), ageing_(ageing), wear_(1 / cycleLoss(stops.shape, stops.span_per_m, ageing.cycle_per_m)) {}

  /// Bends it to k [1/m] in one step; returns the moment [N].
  double bend(double k) {
    const StopNumbers<double> numbers{stops_.shape.drop.data(),
                                      stops_.shape.reach.data(),
                                      stops_.rise_Nm(),
                                      stops_.span_per_m,
                                      wear_,
                                      -std::log1p(-ageing_.fatigue),
                                      ageing_.setting};
    double trial[kHistory];
    Answer<double, 1> out{};
    const double D[1] = {stops_.last_Nm};
    sumOfStops<all_parts, N, LineCurvature>(D, numbers, &k, History<double>{committed_.data(), trial, 1, true}, 0, out);
    std::copy(trial, trial + kHistory, committed_.begin());
    stored_ = out.energy;
    lost_ += out.lost;
    return out.resultant[0];
  }
  double set() const { return committed_[N]; }               ///< kp [1/m]
  double friction() const { return 1 - committed_[N + 1]; }  ///< phi
  double stored() const { return stored_; }                  ///< [J/m^2]
  double lost() const { return lost_; }                      ///< [J/m^2], since it was new

 private:
  static constexpr int kHistory = kStopHistory<N, LineCurvature>;
  Stops<N> stops_;
  Ageing ageing_;
  double wear_;
  std::array<double, kHistory> committed_{};
  double stored_ = 0, lost_ = 0;
};

/// What KES-FB2 reads: B, the mean slope between 0.5 and 1.5/cm, and 2HB, the width of the loop at a curvature, each
/// the mean of both sides. Valid for any curve; of one that is straight from K0 < 0.5/cm on, B = b2 and 2HB = 2 M0.
struct KesBending {
  double rigidity_Nm = 0;   ///< B
  double hysteresis_N = 0;  ///< 2HB
};
constexpr double kKesCurvature_per_m = 250, kKesFrom_per_m = 50, kKesTo_per_m = 150, kKesWidthAt_per_m = 100;

/// Reads a loop that has settled, from -2.5 to 2.5/cm and back.
template <int N>
KesBending readKes(const Stops<N>& stops, double width_at_per_m = kKesWidthAt_per_m) {
  BentLine<N> line(stops);
  line.bend(kKesCurvature_per_m);
  line.bend(-kKesCurvature_per_m);
  const double low = line.bend(kKesFrom_per_m), up = line.bend(width_at_per_m), high = line.bend(kKesTo_per_m);
  line.bend(kKesCurvature_per_m);
  return {(high - low) / (kKesTo_per_m - kKesFrom_per_m), up - line.bend(width_at_per_m)};
}

/// The stops of this shape over K0 [1/m] of which KES-FB2 reads this. Throws InputError where there are none: B would
/// have to be smaller than what friction gives it, or friction is overcome where the loop ends.
template <int N>
Stops<N> stopsOfKes(const StopShape<N>& shape, const KesBending& read, double span_per_m,
                    double width_at_per_m = kKesWidthAt_per_m) {
  Stops<N> out{shape, 1, 0, span_per_m};
  const KesBending unit = readKes(out, width_at_per_m);
  const double rise = read.hysteresis_N / unit.hysteresis_N;
  out.last_Nm = read.rigidity_Nm - rise * unit.rigidity_Nm;
  out.first_Nm = out.last_Nm + rise;
  if (!(unit.hysteresis_N > 0 && out.last_Nm >= 0))
    throw InputError({}, "a loop " + std::to_string(read.hysteresis_N) + " N wide whose friction is overcome at " +
                             std::to_string(span_per_m) + " 1/m is steeper by itself than the rigidity that was read");
  return out;
}

}  // namespace gambeson
