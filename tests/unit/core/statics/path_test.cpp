/// Equilibrium paths of systems with closed forms: cubic spring, von Mises truss with limit points and snap-back.

#include "core/statics/path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/statics/small_systems.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::vector<StaticPoint> follow(System& system, const StaticOptions& options, StaticReport* report = nullptr,
                                std::vector<double> start = {}) {
  std::vector<StaticPoint> points;
  const StaticReport r = followPath(
      system, options, [&](const StaticPoint& p) { return points.push_back(p), true; }, std::move(start));
  if (report)
    *report = r;
  else
    EXPECT_TRUE(r.reached) << r.why;
  return points;
}

/// y + c y^3 = t P.
SmallSystem cubicSpring(double c, double P) {
  SmallSystem s(1);
  s.force = [c](const Eigen::VectorXd& y) -> Eigen::VectorXd { return y + c * y.cwiseProduct(y).cwiseProduct(y); };
  s.tangent = [c](const Eigen::VectorXd& y) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Constant(1, 1, 1 + 3 * c * y(0) * y(0));
  };
  s.load = [P](double t) { return Eigen::VectorXd::Constant(1, t * P); };
  return s;
}

/// Load on the von Mises truss of two bars at the apex displacement w (downwards): EA/L^3 (w^2 - 2 h w)(w - h).
double trussLoad(double w, double h, double EA) {
  const double L2 = 1 + h * h;
  return EA / (L2 * std::sqrt(L2)) * (w * w - 2 * h * w) * (w - h);
}

TEST(StaticPath, CubicSpringAgreesWithItsEquation) {
  SmallSystem s = cubicSpring(4, 3);
  for (const StaticPoint& p : follow(s, {.steps = 5})) {
    EXPECT_NEAR(p.y[0] + 4 * std::pow(p.y[0], 3), 3 * p.factor, 1e-7);
    EXPECT_EQ(p.negative_pivots, 0);
  }
  const auto points = follow(s, {.steps = 5});
  ASSERT_EQ(points.size(), 5u);
  EXPECT_DOUBLE_EQ(points.back().factor, 1);
  EXPECT_NEAR(follow(s, {.linear = true}).at(0).y[0], 3, 1e-14);
}

/// |r_(k+1)| <= C |r_k|^2 close to the solution: the residual's exponent doubles.
TEST(StaticPath, NewtonConvergesQuadratically) {
  Truss t = misesTruss(0.4, 100, 0);
  SmallSystem s = t.system(Eigen::Vector2d(0.3, -0.8));
  PathState state(s);
  EquilibriumAt at(s, 1);
  const NewtonReport n = solveNewton(at, {.tolerance = 1e-14}, state.y, state.K, state.solver);
  ASSERT_TRUE(n.converged);
  int pairs = 0;
  for (std::size_t k = 0; k + 2 < n.residuals.size(); ++k)
    if (n.residuals[k] < 1e-2 && n.residuals[k + 1] > 1e-13) {
      EXPECT_LT(n.residuals[k + 1], 50 * n.residuals[k] * n.residuals[k]);
      ++pairs;
    }
  EXPECT_GE(pairs, 1);
}

/// A tangent of 1e14 where the force rises by 1: each correction is rounding of a structure of 1 m, and the load stays
/// without its reaction. That is not convergence.
TEST(StaticPath, CorrectionsThatAreRoundingBalanceNothing) {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return y; };
  s.tangent = [](const Eigen::VectorXd&) { return Eigen::MatrixXd::Constant(1, 1, 1.1e14); };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, t); };
  StaticReport report;
  EXPECT_TRUE(follow(s, {.steps = 1, .halvings = 0}, &report).empty());
  EXPECT_FALSE(report.reached);
  EXPECT_NE(report.why.find("corrections are rounding"), std::string::npos) << report.why;
}

/// The scratch of a solve that went astray holds a tangent of 1e20: by it all forces of a soft spring would be
/// rounding, and the start its equilibrium. So a draped disc stood still with 78 % of its weight unbalanced.
TEST(StaticPath, WhatIsRoundingIsSaidByTheTangentAtHand) {
  SmallSystem s = linearSystem(Eigen::MatrixXd::Constant(1, 1, 2), Eigen::VectorXd::Constant(1, 3));
  PathState state(s);
  state.K.values = {1e20};
  EquilibriumAt at(s, 1);
  const NewtonReport n = solveNewton(at, {}, state.y, state.K, state.solver);
  EXPECT_TRUE(n.converged);
  EXPECT_FALSE(n.rounded);
  EXPECT_NEAR(state.y[0], 1.5, 1e-12);
}

/// Two unknowns tied by a spring of 1e9: its forces, and so the balance, are rounded to 1e-7, which is more than the
/// tolerance asks. Accepted, and said.
TEST(StaticPath, WhatConvergesToRoundingSaysSo) {
  const double k = 1e9;
  const auto K = [k](double more) { return Eigen::MatrixXd{{1 + k, -k}, {-k, k + more}}; };
  SmallSystem s = linearSystem(K(0), Eigen::Vector2d(0.3, 0));
  const auto points = follow(s, {.steps = 3, .tolerance = 1e-15});
  ASSERT_EQ(points.size(), 3u);
  for (const StaticPoint& p : points) {
    EXPECT_TRUE(p.rounded) << p.residual;
    EXPECT_GT(p.residual, 1e-15);
    EXPECT_NEAR(p.y[0], 0.3 * p.factor, 1e-6);
  }
  for (const StaticPoint& p : follow(s, {.steps = 3, .tolerance = 1e-3})) EXPECT_FALSE(p.rounded);
}

/// 2 y/(1 + y^2) is at most 1, at y = 1: a load of 1.2 has no equilibrium.
TEST(StaticPath, LoadStepsStopAtALimitPointAndNameIt) {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, 2 * y(0) / (1 + y(0) * y(0))); };
  s.tangent = [](const Eigen::VectorXd& y) {
    const double d = 1 + y(0) * y(0);
    return Eigen::MatrixXd::Constant(1, 1, 2 * (2 - d) / (d * d));
  };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, 1.2 * t); };
  StaticReport report;
  const auto points = follow(s, {.steps = 10}, &report);
  EXPECT_FALSE(report.reached);
  EXPECT_NE(report.why.find("limit point"), std::string::npos) << report.why;
  EXPECT_NE(report.why.find("load step 9"), std::string::npos) << report.why;
  EXPECT_NE(report.why.find("residual"), std::string::npos) << report.why;
  EXPECT_LE(points.back().factor, 1 / 1.2);
  EXPECT_GT(points.back().factor, 0.99 / 1.2);  // halved down to the limit
  EXPECT_NEAR(2 * points.back().y[0] / (1 + std::pow(points.back().y[0], 2)), 1.2 * points.back().factor, 1e-8);
}

/// y - y^3 + y^5/5 = t P with P between the limit loads: load steps follow the near branch to its limit point and then
/// jump to the far one, once, and say so.
TEST(StaticPath, LoadStepsJumpToAStableStateBeyondALimitPoint) {
  SmallSystem s(1);
  const auto f = [](double y) { return y - std::pow(y, 3) + std::pow(y, 5) / 5; };
  s.force = [f](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, f(y(0))); };
  s.tangent = [](const Eigen::VectorXd& y) {
    return Eigen::MatrixXd::Constant(1, 1, 1 - 3 * y(0) * y(0) + std::pow(y(0), 4));
  };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, 0.8 * t); };
  const double near = std::sqrt((3 - std::sqrt(5)) / 2), far = std::sqrt((3 + std::sqrt(5)) / 2);  // limit points
  for (const auto& [steps, iterations] : {std::pair{20, 6}, {20, 30}, {7, 30}, {10, 2}, {3, 30}, {2, 30}, {1, 30}}) {
    bool beyond = false;
    StaticReport report;
    for (const StaticPoint& p : follow(s, {.steps = steps, .iterations = iterations}, &report)) {
      SCOPED_TRACE(steps);
      EXPECT_NEAR(f(p.y[0]), 0.8 * p.factor, 1e-7);
      EXPECT_EQ(p.jumped, !beyond && p.y[0] > far) << p.factor;
      beyond = beyond || p.y[0] > far;
      EXPECT_EQ(p.negative_pivots, 0);
      EXPECT_TRUE(beyond ? p.y[0] > far : p.y[0] < near) << p.y[0];
      if (!beyond) {
        EXPECT_LE(0.8 * p.factor, f(near) + 1e-9);
      }
    }
    EXPECT_TRUE(report.reached) << report.why;
    EXPECT_TRUE(beyond);
  }
}

/// Steep, but continuous: y of a load that softens a hundredfold around 1/2 and stiffens again is no jump at
/// any number of steps.
TEST(StaticPath, SteepPathsAreNoJumps) {
  SmallSystem s(1);
  // y = t + 5 (1 + tanh((t - 1/2)/0.05)), its inverse by Newton on t.
  const auto inverse = [](double y) {
    double low = -20, high = 20;
    for (int k = 0; k < 200; ++k) {
      const double t = 0.5 * (low + high);
      (t + 5 * (1 + std::tanh((t - 0.5) / 0.05)) < y ? low : high) = t;
    }
    return 0.5 * (low + high);
  };
  s.force = [&](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, inverse(y(0))); };
  s.tangent = [&](const Eigen::VectorXd& y) {
    const double c = std::cosh((inverse(y(0)) - 0.5) / 0.05);
    return Eigen::MatrixXd::Constant(1, 1, 1 / (1 + 100 / (c * c)));
  };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, t); };
  for (int steps : {1, 2, 3, 5, 10, 20}) {
    StaticReport report;
    for (const StaticPoint& p : follow(s, {.steps = steps}, &report))
      EXPECT_FALSE(p.jumped) << steps << " " << p.factor;
    EXPECT_TRUE(report.reached) << report.why;
  }
}

TEST(StaticPath, ArcLengthFollowsTheTrussThroughBothLimitPoints) {
  const double h = 0.3, EA = 100, L3 = std::pow(1 + h * h, 1.5), limit = EA / L3 * h * h * h * 2 / (3 * std::sqrt(3));
  Truss t = misesTruss(h, EA, 0);
  SmallSystem s = t.system(Eigen::Vector2d(0, -3 * limit));
  const auto points = follow(s, {.steps = 40, .arc_length = true});
  double most = 0, least = 0;
  for (const StaticPoint& p : points) {
    const double w = -p.y[1];
    EXPECT_NEAR(p.y[0], 0, 1e-9);
    EXPECT_NEAR(3 * limit * p.factor, trussLoad(w, h, EA), 1e-6 * limit);
    // Unstable between the limit points w = h (1 -+ 1/sqrt 3).
    EXPECT_EQ(p.negative_pivots, std::abs(w - h) < h / std::sqrt(3) ? 1 : 0) << w;
    if (w < h) most = std::max(most, 3 * p.factor);
    least = std::min(least, 3 * p.factor);
  }
  EXPECT_NEAR(most, 1, 0.05);
  EXPECT_NEAR(least, -1, 0.05);
  EXPECT_DOUBLE_EQ(points.back().factor, 1);
}

/// With a soft spring above the apex its upper end moves back while the truss snaps: the displacement under the load is
/// not monotone either.
TEST(StaticPath, ArcLengthFollowsASnapBack) {
  const double h = 0.3, EA = 100, L3 = std::pow(1 + h * h, 1.5), limit = EA / L3 * h * h * h * 2 / (3 * std::sqrt(3));
  Truss t = misesTruss(h, EA, 0.4 * EA * h * h);
  SmallSystem s = t.system(Eigen::Vector3d(0, 0, -3 * limit));
  const auto points = follow(s, {.steps = 30, .arc_length = true, .max_points = 400});
  bool back = false;
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR(3 * limit * points[k].factor, trussLoad(-points[k].y[1], h, EA), 1e-6 * limit);
    if (k > 0) {
      EXPECT_LT(points[k].y[1], points[k - 1].y[1]);  // the apex goes on
      back = back || points[k].y[2] > points[k - 1].y[2];
    }
  }
  EXPECT_TRUE(back);
  EXPECT_DOUBLE_EQ(points.back().factor, 1);
}

/// The softer a (linear) spring on the apex, the sharper its end turns back: long arcs meet the path where it comes in
/// again, and from there the way on leads against the step. Whatever the first arc, the apex must go on.
TEST(StaticPath, ArcLengthDoesNotTurnBackAtASharpSnapBack) {
  const double h = 0.3, EA = 100, L3 = std::pow(1 + h * h, 1.5), limit = EA / L3 * h * h * h * 2 / (3 * std::sqrt(3));
  for (const double share : {0.4, 0.1, 0.03, 0.01})
    for (int steps = 2; steps <= 40; steps += 2) {
      const double k = share * EA * h * h;
      SmallSystem s(2);  // apex, upper end of the spring
      s.force = [=](const Eigen::VectorXd& y) -> Eigen::VectorXd {
        const double spring = k * (y(1) - y(0));
        return Eigen::Vector2d(trussLoad(y(0), h, EA) - spring, spring);
      };
      s.tangent = [=](const Eigen::VectorXd& y) -> Eigen::MatrixXd {
        const double w = y(0), truss = EA / L3 * (3 * w * w - 6 * h * w + 2 * h * h);
        return Eigen::Matrix2d{{truss + k, -k}, {-k, k}};
      };
      s.load = [=](double t) -> Eigen::VectorXd { return Eigen::Vector2d(0, 3 * limit * t); };
      StaticReport report;
      const auto points = follow(s, {.steps = steps, .arc_length = true, .max_points = 2000}, &report);
      ASSERT_TRUE(report.reached) << share << " " << steps << ": " << report.why;
      for (std::size_t i = 1; i < points.size(); ++i)
        ASSERT_GT(points[i].y[0], points[i - 1].y[0]) << share << " " << steps << ", point " << i;
    }
}

/// Soft at first, then a snap: u/1000 + u^2 (1 - u)^2 + u^4/50 climbs 0.064, falls and climbs again. The tangent at the
/// start, and so the first arc of any number of steps, is a hundred times too long.
TEST(StaticPath, ArcLengthStepsOverNoSnapHoweverSoftTheStart) {
  const auto f = [](double u) { return u / 1000 + u * u * (1 - u) * (1 - u) + u * u * u * u / 50; };
  SmallSystem s(1);
  s.force = [f](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, f(y(0))); };
  s.tangent = [](const Eigen::VectorXd& y) {
    const double u = y(0);
    return Eigen::MatrixXd::Constant(1, 1, 1e-3 + 2 * u * (1 - u) * (1 - 2 * u) + 0.08 * u * u * u);
  };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, 0.2 * t); };
  for (const int steps : {1, 3, 10, 30, 100}) {
    const auto points = follow(s, {.steps = steps, .arc_length = true, .max_points = 500});
    double peak = 0, valley = 1;
    int limits = 0;
    for (const StaticPoint& p : points) {
      EXPECT_NEAR(f(p.y[0]), 0.2 * p.factor, 1e-8);
      EXPECT_FALSE(p.jumped);
      limits += p.limit_point;
      if (p.y[0] < 0.7) peak = std::max(peak, 0.2 * p.factor);
      if (p.y[0] > 0.7) valley = std::min(valley, 0.2 * p.factor);
    }
    EXPECT_EQ(limits, 2) << steps;
    EXPECT_NEAR(peak, 0.06447, 0.002) << steps;
    EXPECT_NEAR(valley, 0.02083, 0.002) << steps;
  }
}

/// What an arc may move at most can be said.
TEST(StaticPath, ArcsAreNoLongerThanAsked) {
  SmallSystem s = cubicSpring(0.01, 3);
  double before = 0;
  const auto points = follow(s, {.steps = 1, .arc_length = true, .largest_arc_m = 0.05});
  EXPECT_GT(points.size(), 50u);
  for (const StaticPoint& p : points) {
    EXPECT_LE(p.y[0] - before, 0.05 * 1.001);
    before = p.y[0];
  }
}

/// A path that splits: the tangent changes its sign where the factor goes on.
TEST(StaticPath, ArcLengthSaysWhatItPassed) {
  SmallSystem s(2);  // y0 - y1^2/2 = t, (0.55 - y0) y1 = 0
  s.force = [](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    return Eigen::Vector2d(y(0) - 0.5 * y(1) * y(1), (0.55 - y(0)) * y(1));
  };
  s.tangent = [](const Eigen::VectorXd& y) -> Eigen::MatrixXd {
    return Eigen::Matrix2d{{1, -y(1)}, {-y(1), 0.55 - y(0)}};
  };
  s.load = [](double t) -> Eigen::VectorXd { return Eigen::Vector2d(t, 0); };
  int passed = 0, limits = 0;
  double at = 0, last = 0;
  for (const StaticPoint& p : follow(s, {.steps = 10, .arc_length = true})) {
    passed += p.bifurcation;
    limits += p.limit_point;
    if (p.bifurcation) {
      EXPECT_TRUE(last <= 0.55 && p.factor >= 0.55) << last << " " << p.factor;
    }
    last = p.factor;
    at = p.y[1];
  }
  EXPECT_EQ(passed, 1);
  EXPECT_EQ(limits, 0);
  EXPECT_EQ(at, 0);
}

/// A stiffening bar string, flat at first: the first whole Newton step overshoots the far side by orders of magnitude.
TEST(StaticPath, AHardSpringNeedsTheLineSearchOrHalving) {
  SmallSystem s = cubicSpring(1e8, 1000);
  const auto points = follow(s, {.steps = 1});
  EXPECT_NEAR(points.back().y[0] + 1e8 * std::pow(points.back().y[0], 3), 1000, 1e-4);
}

/// sqrt is not a number below zero: steps into it are cut.
TEST(StaticPath, StatesThatAreNotFiniteAreLeft) {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, 2 - 2 * std::sqrt(1 - y(0))); };
  s.tangent = [](const Eigen::VectorXd& y) { return Eigen::MatrixXd::Constant(1, 1, 1 / std::sqrt(1 - y(0))); };
  s.load = [](double t) { return Eigen::VectorXd::Constant(1, 1.9 * t); };
  EXPECT_NEAR(follow(s, {.steps = 1}).back().y[0], 1 - 0.05 * 0.05, 1e-7);
}

TEST(StaticPath, AMechanismIsNamed) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Identity(3, 3);
  K(1, 1) = 0;
  SmallSystem s = linearSystem(K, Eigen::Vector3d(1, 1, 1));
  try {
    follow(s, {});
    FAIL() << "accepted";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("unknown 1"), std::string::npos) << e.what();
  }
}

TEST(StaticPath, StartsFromAGivenStateAndFindsItsEquilibriumFirst) {
  const double h = 0.3;
  Truss t = misesTruss(h, 100, 0);
  SmallSystem s = t.system(Eigen::Vector2d(0, -1e-3));
  const auto points = follow(s, {.steps = 2}, nullptr, {0, -1.9 * h});  // close to the mirrored rest shape
  EXPECT_NEAR(points.back().y[1], -2 * h, 1e-2 * h);
  EXPECT_THROW(follow(s, {}, nullptr, {0}), InputError);
  EXPECT_THROW(follow(s, {.steps = 0}), InputError);
}

TEST(StaticPath, AnObserverStopsThePath) {
  SmallSystem s = cubicSpring(1, 1);
  int points = 0;
  const StaticReport r = followPath(s, {.steps = 10}, [&](const StaticPoint&) { return ++points < 3; });
  EXPECT_EQ(points, 3);
  EXPECT_FALSE(r.reached);
  EXPECT_TRUE(r.why.empty());
}

}  // namespace
}  // namespace gambeson
