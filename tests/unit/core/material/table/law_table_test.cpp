#include "core/material/table/law_table.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/material/laws/membrane.hpp"
#include "core/material/linearised.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"

namespace gambeson {
namespace {

SheetStrain moved(SheetStrain at, std::size_t direction, double by) {
  (direction < 3 ? at.strain[direction] : at.curvature[direction - 3]) += by;
  return at;
}

double resultantOf(const SheetAnswer& a, std::size_t i) { return i < 3 ? a.resultant[i] : a.moment[i - 3]; }

/// The largest errors of resultants against the energy's differences, and of slopes against the resultants', as parts
/// of the largest in their units.
std::array<double, 2> errorsOf(const LawTable& table, const SheetStrain& at) {
  const SheetAnswer here = table.at(at);
  const double step[6] = {1e-5, 1e-5, 1e-5, 1e-2, 1e-2, 1e-2};
  std::array<double, 2> worst{};
  std::array<double, 2> force{}, largest{};  // of strains and of curvatures, times steps: energies
  for (std::size_t i = 0; i < 6; ++i) force[0] = std::max(force[0], std::abs(resultantOf(here, i)) * step[i]);
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = 0; j < 6; ++j)
      largest[0] = std::max(largest[0], std::abs(here.slope[6 * i + j]) * step[i] * step[j]);
  for (std::size_t j = 0; j < 6; ++j) {
    std::array<SheetAnswer, 4> a;
    for (std::size_t k = 0; k < 4; ++k)
      a[k] = table.at(moved(at, j, step[j] * std::array{-2.0, -1.0, 1.0, 2.0}[k]), SheetParts::resultants);
    const auto difference = [&](auto get) { return (8 * (get(a[2]) - get(a[1])) - (get(a[3]) - get(a[0]))) / 12; };
    const double slope_of_energy = difference([](const SheetAnswer& x) { return x.energy_J_per_m2; });
    worst[0] = std::max(worst[0], std::abs(slope_of_energy - resultantOf(here, j) * step[j]) / force[0]);
    for (std::size_t i = 0; i < 6; ++i) {
      const double change = difference([&](const SheetAnswer& x) { return resultantOf(x, i); });
      worst[1] =
          std::max(worst[1], std::abs(change * step[i] - here.slope[6 * i + j] * step[i] * step[j]) / largest[0]);
    }
  }
  return worst;
}

SheetStrain strainAt(std::mt19937& random, double beyond = 0) {
  const auto in = [&](double low, double high) {
    const double more = beyond * (high - low);
    return std::uniform_real_distribution<double>(low - more, high + more)(random);
  };
  SheetStrain at{{in(-0.019, 0.099), in(-0.019, 0.099), in(-0.49, 0.49)}, {}};
  for (double& k : at.curvature) k = in(-40, 40);
  return at;
}

TEST(LawTable, ResultantsAndSlopesAreTheEnergysDerivatives) {
  for (const bool even : {true, false}) {
    const LawTable table(tableOf({}, 7, 4, even));
    std::mt19937 random(1);
    for (int k = 0; k < 40; ++k) {
      const auto [gradient, slope] = errorsOf(table, strainAt(random));
      EXPECT_LT(gradient, 1e-7);
      EXPECT_LT(slope, 1e-6);
    }
    int beyond = 0;
    for (int k = 0; k < 40; ++k) {
      const SheetStrain at = strainAt(random, 0.3);
      beyond += table.at(at).beyond;
      const auto [gradient, slope] = errorsOf(table, at);
      EXPECT_LT(gradient, 1e-7);
      EXPECT_LT(slope, 1e-6);
    }
    EXPECT_GT(beyond, 20);
  }
}

TEST(LawTable, ClosedLoopsOfStrainAndCurvatureTakeNoEnergy) {
  const LawTable table(tableOf({}, 7, 4));
  // Out beyond the range and back; corners stand where it is left, so that the law is smooth along each leg.
  const std::vector<SheetStrain> corners{{{0.05, 0.04, 0.2}, {0, 10, -5}},  {{0.10, 0.05, 0.3}, {30, 0, 5}},
                                         {{0.15, 0.08, 0.4}, {40, -20, 9}}, {{0.10, 0.07, -0.1}, {10, 5, 0}},
                                         {{0.02, 0.05, -0.2}, {-9, 8, 7}},  {{0.05, 0.04, 0.2}, {0, 10, -5}}};
  constexpr int kSteps = 500;
  double work = 0, size = 0;
  for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg)
    for (int k = 0; k < kSteps; ++k)
      for (const double side : {-0.5, 0.5}) {  // Gauss's rule
        const double t = (k + 0.5 + side / std::sqrt(3.0)) / kSteps;
        const SheetStrain &a = corners[leg], &b = corners[leg + 1];
        SheetStrain at;
        for (std::size_t i = 0; i < 3; ++i) {
          at.strain[i] = std::lerp(a.strain[i], b.strain[i], t);
          at.curvature[i] = std::lerp(a.curvature[i], b.curvature[i], t);
        }
        const SheetAnswer answer = table.at(at, SheetParts::resultants);
        for (std::size_t i = 0; i < 3; ++i)
          for (const double part : {answer.resultant[i] * (b.strain[i] - a.strain[i]),
                                    answer.moment[i] * (b.curvature[i] - a.curvature[i])}) {
            work += part / (2 * kSteps);
            size += std::abs(part) / (2 * kSteps);
          }
      }
  EXPECT_LT(std::abs(work), 1e-10 * size);
}

TEST(LawTable, LinearClothIsRepeatedToRounding) {
  const LawTable table(linearTable({400, 300, 50}, 60, {2e-5, 3e-5, 1e-5}, 4e-6));
  const SheetStrain at{{0.08, -0.05, -0.2}, {10, -20, 5}};
  const SheetAnswer a = table.at(at);
  EXPECT_NEAR(a.resultant[0], 400 * 0.08 + 60 * -0.05, 1e-11);
  EXPECT_NEAR(a.resultant[1], 300 * -0.05 + 60 * 0.08, 1e-11);
  EXPECT_NEAR(a.resultant[2], 50 * -0.2, 1e-11);
  EXPECT_NEAR(a.moment[0], 2e-5 * 10 + 4e-6 * -20, 1e-17);
  EXPECT_NEAR(a.moment[1], 3e-5 * -20 + 4e-6 * 10, 1e-17);
  EXPECT_NEAR(a.moment[2], 1e-5 * 5, 1e-17);
  EXPECT_NEAR(a.slope[1], 60, 1e-8);
  EXPECT_NEAR(a.slope[14], 50, 1e-8);
  EXPECT_FALSE(a.beyond);
  EXPECT_TRUE(table.convex());
}

/// Not-a-knot cubics are of order h^4, their derivatives of h^3 (de Boor, chapter V).
TEST(LawTable, ForcesConvergeByTheThirdOrder) {
  const StiffeningCloth cloth;
  const auto error = [&](int extensions, int shears) {
    const LawTable table(tableOf(cloth, extensions, shears));
    std::mt19937 random(3);
    double worst = 0;
    for (int k = 0; k < 200; ++k) {
      const SheetStrain at{strainAt(random).strain, {}};
      const SheetAnswer a = table.at(at, SheetParts::resultants);
      const std::array<double, 3> exact = cloth.resultant(at.strain);
      for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(a.resultant[i] - exact[i]));
    }
    return worst;
  };
  const double coarse = error(9, 5), fine = error(17, 9);
  EXPECT_GT(std::log2(coarse / fine), 2.7);
  EXPECT_LT(fine, 2e-3 * cloth.resultant({0.1, 0.1, 0.5})[0]);
}

TEST(LawTable, TheMirrorTurnsShearAndTwist) {
  const LawTable table(tableOf({}, 7, 4));
  const SheetAnswer a = table.at({{0.03, 0.01, 0.2}, {5, 7, 3}}), b = table.at({{0.03, 0.01, -0.2}, {5, 7, -3}});
  EXPECT_NEAR(a.energy_J_per_m2, b.energy_J_per_m2, 1e-13);
  for (std::size_t i = 0; i < 3; ++i) {
    const double sign = i == 2 ? -1 : 1;
    EXPECT_NEAR(a.resultant[i], sign * b.resultant[i], 1e-11);
    EXPECT_NEAR(a.moment[i], sign * b.moment[i], 1e-15);
  }
  EXPECT_GT(std::abs(a.slope[6 * 3 + 5]), 1e-8) << "D13 has to count in this test";
}

TEST(LawTable, BeyondItsRangeForcesAreContinuousAndTheEnergyConvex) {
  const LawTable table(tableOf({}, 7, 4));
  ASSERT_TRUE(table.convex());
  const auto range = table.range();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t side = 0; side < 2; ++side) {
      SheetStrain at{{0.03, 0.02, 0.1}, {4, 5, 6}};
      at.strain[i] = range[i][side];
      const SheetAnswer in = table.at(at);
      at.strain[i] += side == 0 ? -1e-9 : 1e-9;
      const SheetAnswer out = table.at(at);
      EXPECT_FALSE(in.beyond);
      EXPECT_TRUE(out.beyond);
      EXPECT_NEAR(in.energy_J_per_m2, out.energy_J_per_m2, 1e-6);
      for (std::size_t j = 0; j < 3; ++j) {
        EXPECT_NEAR(in.resultant[j], out.resultant[j], 1e-4);
        EXPECT_NEAR(in.moment[j], out.moment[j], 1e-9);
      }
      EXPECT_GE(out.slope[7 * i], in.slope[7 * i] - 1e-3);
    }
  std::mt19937 random(5);
  for (int k = 0; k < 500; ++k) {
    const SheetAnswer a = table.at({strainAt(random, 2).strain, {}});
    Eigen::Matrix3d H;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) H(i, j) = a.slope[static_cast<std::size_t>(6 * i + j)];
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(H).eigenvalues()[0], 0);
  }
}

TEST(LawTable, NoSlopeSurpassesTheSteepest) {
  const LawTable table(tableOf({}, 7, 4));
  const std::array<double, 36> steepest = table.steepest();
  using Slopes = Eigen::Matrix<double, 6, 6>;
  std::mt19937 random(7);
  double nearest = 1e300;
  for (int k = 0; k < 500; ++k) {
    const SheetAnswer a = table.at({strainAt(random, k % 2 * 0.4).strain, {}});
    const Slopes left = Slopes(steepest.data()) - Slopes(a.slope.data());
    const double least = Eigen::SelfAdjointEigenSolver<Slopes>(left).eigenvalues()[0];
    EXPECT_GT(least, 0);
    for (std::size_t i = 0; i < 3; ++i) nearest = std::min(nearest, steepest[7 * i] / a.slope[7 * i]);
  }
  EXPECT_LT(nearest, 3) << "the bound is of no use where it is far from every slope";
}

/// Of boxes of every size, also across zero shear and beyond the range.
TEST(LawTable, NoSlopeInABoxSurpassesItsSteepest) {
  for (const bool even : {true, false}) {
    const LawTable table(tableOf({}, 7, 4, even));
    const std::array<double, 36> of_all = table.steepest();
    using Slopes = Eigen::Matrix<double, 6, 6>;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> part(0, 1);
    double longest = 0;
    for (int k = 0; k < 300; ++k) {
      const std::array<double, 3> middle = strainAt(random, k % 3 == 0 ? 0.4 : 0).strain;
      StrainBox box = StrainBox{middle, middle}.widened(std::pow(10, -3 + 2 * part(random)));
      const std::array<double, 36> steepest = table.steepest(box);
      for (int inside = 0; inside < 10; ++inside) {
        std::array<double, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = box.low[i] + part(random) * (box.high[i] - box.low[i]);
        const Slopes left = Slopes(steepest.data()) - Slopes(table.at({at, {}}).slope.data());
        EXPECT_GT(Eigen::SelfAdjointEigenSolver<Slopes>(left).eigenvalues()[0], -1e-9 * of_all[0]);
      }
      for (std::size_t i = 0; i < 3; ++i) EXPECT_LE(steepest[7 * i], of_all[7 * i]);
      longest = std::max(longest, of_all[0] / steepest[0]);
    }
    EXPECT_GT(longest, 4) << "of use where the cloth is soft";
  }
}

TEST(Linearised, HasTheSlopesAtRestAndSomeShearWhereYarnsSlide) {
  Fabric cloth;
  cloth.thickness_m = 2e-3;
  const auto with = [&](const LawTableData& data) { return withEnergy(cloth, std::make_shared<const LawTable>(data)); };
  const Fabric f = with(linearTable({400, 300, 50}, 60, {2e-5, 3e-5, 1e-5}, 4e-6));
  Voigt A{};
  planeStress(f.young_weft_Pa, f.young_warp_Pa, f.shear_Pa, f.poisson, f.thickness_m, A.data());
  EXPECT_NEAR(A[0], 400, 1e-8);
  EXPECT_NEAR(A[1], 300, 1e-8);
  EXPECT_NEAR(A[2], 50, 1e-8);
  EXPECT_NEAR(A[3], 60, 1e-8);
  EXPECT_NEAR(givenRigidities(f.law)->warp_Nm, 3e-5, 1e-17);
  // No shear is resisted at rest, but farther off.
  LawTableData sliding = linearTable({400, 300, 0}, 60, {2e-5, 3e-5, 1e-5}, 4e-6);
  std::size_t at = 0;
  forEachNode(sliding.membrane, [&](const std::array<double, 3>& E) {
    const double g = E[2] < 0.2 ? 0 : E[2] - 0.2;
    sliding.energy[at++] += 10 * g * g;
  });
  EXPECT_GT(with(sliding).shear_Pa, 0);
  EXPECT_LT(with(sliding).shear_Pa * cloth.thickness_m, 1);
  EXPECT_THROW(with(linearTable({-400, 300, 50}, 60, {2e-5, 3e-5, 1e-5}, 4e-6)), InputError);
}

TEST(LawTable, SaysWhereItIsNotConvex) {
  LawTableData data = tableOf({}, 7, 4);
  std::size_t at = 0;
  forEachNode(data.membrane, [&](const std::array<double, 3>& E) { data.energy[at++] -= 400 * E[2] * E[2]; });
  // Stiff along 2 E12 somewhere still: its fourth power.
  at = 0;
  forEachNode(data.membrane, [&](const std::array<double, 3>& E) { data.energy[at++] += 2e3 * std::pow(E[2], 4); });
  EXPECT_FALSE(LawTable(data).convex());
}

TEST(LawTable, RefusesWhatIsNoTable) {
  const LawTableData good = tableOf({}, 5, 3);
  const auto refused = [&](const std::string& key, const std::function<void(LawTableData&)>& spoil) {
    LawTableData bad = good;
    spoil(bad);
    try {
      LawTable{bad};
      ADD_FAILURE() << key << " was taken";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.what();
    }
  };
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  refused("membrane.e11", [](LawTableData& d) { d.membrane.nodes[0] = {0, 0.1}; });
  refused("membrane.e11", [](LawTableData& d) { d.membrane.nodes[0][0] = -0.6; });
  refused("membrane.e22", [](LawTableData& d) { std::swap(d.membrane.nodes[1][0], d.membrane.nodes[1][1]); });
  refused("membrane.e22", [](LawTableData& d) {
    for (double& e : d.membrane.nodes[1]) e += 0.1;
  });
  refused("membrane.g12", [](LawTableData& d) { d.membrane.nodes[2][0] = 0.01; });
  refused("membrane.g12", [](LawTableData& d) { d.membrane.nodes[2][1] = kNothing; });
  refused("membrane.energy", [](LawTableData& d) { d.energy.pop_back(); });
  refused("membrane.energy", [](LawTableData& d) { d.energy[3] = kNothing; });
  refused("membrane.energy", [](LawTableData& d) { std::fill(d.energy.begin(), d.energy.end(), 1.0); });
  refused("bending.e11", [](LawTableData& d) { d.bending.nodes[0].clear(); });
  refused("bending.e22", [](LawTableData& d) { d.bending.nodes[1].back() = 0.2; });
  refused("bending.rigidity", [](LawTableData& d) { d.rigidity.clear(); });
  refused("bending.rigidity", [](LawTableData& d) { d.rigidity[2][3] = 1; });
  refused("bending.rigidity", [](LawTableData& d) { d.rigidity[2][0] = kNothing; });
  refused("bending.moment", [](LawTableData& d) { d.moment.pop_back(); });
  refused("bending.rigidity", [](LawTableData& d) {
    d.bending.nodes = {std::vector{0.0}, std::vector{0.0}, std::vector{0.0}};
    d.moment.clear();
    d.rigidity = {{1, 1, 1, 0, 0.1, 0}};
  });
}

}  // namespace
}  // namespace gambeson
