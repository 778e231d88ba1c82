#include "core/material/table/curve_energy.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/error.hpp"

namespace gambeson {
namespace {

const std::vector<TensilePoint> stiffening{{0.01, 10}, {0.02, 25}, {0.035, 70}, {0.05, 200}, {0.06, 490}};
const std::vector<TensilePoint> kinked{{0.01, 100}, {0.02, 101}, {0.05, 102}, {0.051, 300}};
const CurveLaw cloth{{stiffening, {{0.02, 60}, {0.08, 490}}}, 80, {2e-5, 3e-5, 1e-5}};

TEST(TensionCurve, PassesItsPointsAndRisesBetweenThem) {
  for (const auto& points : {stiffening, kinked, {{0.1, 5.}}}) {
    const TensionCurve curve(points);
    for (const auto& [e, F] : points) EXPECT_NEAR(curve.force(e), F, 1e-12 * F);
    double before = 0;
    for (int i = 1; i <= 3000; ++i) {
      const double F = curve.force(points.back()[0] * i / 2500);
      EXPECT_GT(F, before) << i;
      before = F;
    }
  }
}

// What a straight line says stays a straight line, beyond it too: F = 300 e.
TEST(TensionCurve, IsAStraightLineOnOne) {
  const TensionCurve curve({{0.01, 3}, {0.05, 15}, {0.06, 18}});
  for (const double e : {0.003, 0.03, 0.059, 0.1}) {
    EXPECT_NEAR(curve.force(e), 300 * e, 1e-12);
    EXPECT_NEAR(curve.work(e), 150 * e * e, 1e-13);
    EXPECT_NEAR(curve.strainAt(300 * e), e, 1e-14);
  }
  EXPECT_NEAR(curve.at(-0.1).tension_N_per_m, -30, 1e-12);
}

// A smooth curve is met with the second order, whatever its ends: F = sinh.
TEST(TensionCurve, ConvergesToASmoothCurve) {
  std::vector<double> errors;
  for (const int n : {8, 16, 32}) {
    std::vector<TensilePoint> points;
    for (int i = 1; i <= n; ++i) points.push_back({0.5 * i / n, std::sinh(4 * 0.5 * i / n)});
    const TensionCurve curve(points);
    double worst = 0;
    for (int i = 0; i <= 1000; ++i)
      worst = std::max(worst, std::abs(curve.force(0.5e-3 * i) - std::sinh(4 * 0.5e-3 * i)));
    errors.push_back(worst);
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.9);
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9);
  EXPECT_LT(errors[2], 1e-3);
}

TEST(TensionCurve, RefusesWhatIsNoCurve) {
  EXPECT_THROW(TensionCurve({}), InputError);
  EXPECT_THROW(TensionCurve({{0, 1}}), InputError);
  EXPECT_THROW(TensionCurve({{0.1, 1}, {0.1, 2}}), InputError);
  EXPECT_THROW(TensionCurve({{0.1, 1}, {0.2, 1}}), InputError);
  EXPECT_THROW(TensionCurve({{0.1, std::nan("")}}), InputError);
}

// Resultants are differences of the energy, slopes those of resultants; on either side of rest and of the last points.
TEST(CurveEnergy, ForcesAndSlopesAreDerivatives) {
  const CurveEnergy law(cloth);
  std::mt19937 random(5);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int trial = 0; trial < 400; ++trial) {
    const SheetStrain at{{in(-0.1, 0.1), in(-0.1, 0.15), in(-0.2, 0.2)}, {in(-50, 50), in(-50, 50), in(-50, 50)}};
    const SheetAnswer a = law.at(at);
    for (std::size_t j = 0; j < 6; ++j) {
      const double step = j < 3 ? 1e-6 : 1e-2;
      const auto moved = [&](double by) {
        SheetStrain s = at;
        (j < 3 ? s.strain[j] : s.curvature[j - 3]) += by;
        return law.at(s, SheetParts::resultants);
      };
      const SheetAnswer up = moved(step), down = moved(-step);
      const double n = j < 3 ? a.resultant[j] : a.moment[j - 3], size = j < 3 ? 100 : 1e-3;
      EXPECT_NEAR((up.energy_J_per_m2 - down.energy_J_per_m2) / (2 * step), n, 1e-6 * (std::abs(n) + size));
      for (std::size_t i = 0; i < 6; ++i) {
        const double change = i < 3 ? up.resultant[i] - down.resultant[i] : up.moment[i - 3] - down.moment[i - 3];
        // dn/dE bends where F'' jumps: to the first order of the step there.
        EXPECT_NEAR(change / (2 * step), a.slope[6 * i + j], 1e-3 * std::abs(a.slope[6 * i + j]) + 1e-9) << i << j;
      }
    }
  }
}

TEST(CurveEnergy, PullsAsTheTestDidAndSaysWhereItEnds) {
  const CurveEnergy law(cloth);
  for (const auto& [e, F] : stiffening) {
    const SheetAnswer a = law.at({{e + 0.5 * e * e - 1e-12, 0, 0}, {}});
    EXPECT_NEAR(a.resultant[0] * (1 + e), F, 1e-6 * F);
    EXPECT_FALSE(a.beyond);
  }
  EXPECT_TRUE(law.at({{0.0619, 0, 0}, {}}).beyond);
  EXPECT_TRUE(law.at({{0, 0.0833, 0}, {}}).beyond);
  EXPECT_FALSE(law.at({{-0.3, -0.3, 1}, {}}).beyond);
}

TEST(CurveEnergy, NoSlopeInABoxIsSteeperThanItsBound) {
  std::mt19937 random(7);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (const auto& points : {stiffening, kinked}) {
    const CurveEnergy law({{points, points}, 80, {2e-5, 3e-5, 1e-5}});
    double sharpest = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const double low = in(-0.05, 0.08), high = low + in(0, 0.03);
      const std::array<double, 36> bound = law.steepest({{low, low, -1}, {high, high, 1}});
      for (int i = 0; i <= 50; ++i) {
        const double slope = law.at({{low + (high - low) * i / 50, 0, 0}, {}}).slope[0];
        EXPECT_LE(slope, bound[0] * (1 + 1e-12));
        sharpest = std::max(sharpest, slope / bound[0]);
      }
    }
    EXPECT_GT(sharpest, 0.9);
    EXPECT_GE(law.steepest()[0], law.at({{0.06, 0, 0}, {}}).slope[0]);
  }
}

TEST(CurveEnergy, RefusesWhatIsNoLaw) {
  const auto keyOf = [](const CurveLaw& law) {
    try {
      CurveEnergy{law};
    } catch (const InputError& e) {
      return e.where().key;
    }
    return std::string("accepted");
  };
  CurveLaw bad = cloth;
  bad.tension[1].clear();
  EXPECT_EQ(keyOf(bad), "warp");
  bad = cloth;
  bad.shear_N_per_m = std::nan("");
  EXPECT_EQ(keyOf(bad), "shear");
  bad = cloth;
  bad.rigidity_Nm[1] = 0;
  EXPECT_EQ(keyOf(bad), "rigidity_warp");
  EXPECT_EQ(keyOf(cloth), "accepted");
}

// WT = LT EMT F/2 of KES-FB1, whatever the linearity; denims B, D and F of Journal of Textiles 2016, 4614168, table 5,
// have WT 9.4, 8.675 and 8.95 gf cm/cm^2 printed beside these.
TEST(KesTension, HasTheWorkAndTheEnd) {
  for (const double linearity : {0.12, 0.3, 0.5, 0.655, 0.8, 1., 1.2, 1.5}) {
    const TensionCurve curve(tensilePointsOfKes(0.05, linearity, 490.3325));
    EXPECT_NEAR(curve.force(0.05), 490.3325, 1e-9);
    EXPECT_NEAR(curve.work(0.05), linearity * 0.05 * 490.3325 / 2, 1e-11) << linearity;
    EXPECT_GT(curve.at(0).stiffness_N_per_m, 0);
  }
  const double published[][3] = {{5.735, 0.655, 9.4}, {5.135, 0.676, 8.675}, {5.455, 0.657, 8.95}};
  for (const auto& [emt, lt, wt] : published)
    EXPECT_NEAR(TensionCurve(tensilePointsOfKes(emt / 100, lt, 490.3325)).work(emt / 100) / 0.980665, wt, 0.02);
}

// The family is Fung's: stiffness grows in proportion to the tension.
TEST(KesTension, StiffensWithTheTension) {
  const TensionCurve curve(tensilePointsOfKes(0.06, 0.6, 490.3325));
  const auto stiffness = [&](double e) { return (curve.force(e + 1e-5) - curve.force(e - 1e-5)) / 2e-5; };
  const double b = (stiffness(0.05) - stiffness(0.03)) / (curve.force(0.05) - curve.force(0.03));
  EXPECT_NEAR((stiffness(0.03) - stiffness(0.01)) / (curve.force(0.03) - curve.force(0.01)), b, 0.05 * b);
}

}  // namespace
}  // namespace gambeson
