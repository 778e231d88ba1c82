// Friction in shear: its law, and what KES-FB1 reads of it.
#include "core/material/kes_shear.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/material/laws/point_law.hpp"
#include "unit/core/material/law_check.hpp"

namespace gambeson {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
const double numbers[3] = {260, kDegree, 150};

/// A point that was sheared to these strains one after another.
std::array<double, kShearHistory> afterShear(std::initializer_list<double> strains) {
  std::array<double, kShearHistory> committed{}, trial{};
  for (const double g : strains) {
    Answer<double, 3> out{};
    addShearFriction<only_resultants>(numbers, g, History<double>{committed.data(), trial.data(), 1, true}, 0, out);
    committed = trial;
  }
  return committed;
}

/// Through a point's law, beside a membrane and behind the history of bending.
TEST(ShearFriction, IsTheGradientOfWhatIsStoredAndLost) {
  const std::array<double, kShearHistory> committed = afterShear({0.1, -0.03});
  const auto law = [&]<class S>(const S* e) {
    std::array<double, StopBending::history_size + kShearHistory> own{};
    std::copy(committed.begin(), committed.end(), own.begin() + StopBending::history_size);
    PointNumbers<S> l{};
    l.A[0] = 900, l.A[1] = 800, l.A[2] = 80, l.A[3] = 100;
    for (int i = 0; i < 3; ++i) l.shear[i] = numbers[i];
    const LawUse use{1u << BendingLaws::kind<StopBending>, false, false, true};
    Answer<S, 3> a{};
    evaluateMembrane<all_parts>(use, l, e, History<S>{own.data(), nullptr, 1}, a);
    return evaluated(a);
  };
  // Held, slipping in a part, slipping, beyond 8 degrees; of either sign.
  for (const double g : {-0.029, -0.02, 0.01, 0.06, 0.2, -0.05, -0.2}) {
    const std::array<double, 3> e{0.01, -0.02, g};
    const LawErrors errors = lawErrors<3>(law, e, 1e-6, true);
    EXPECT_LT(errors.gradient, 1e-7) << g;
    EXPECT_LT(errors.slope, 1e-6) << g;
    EXPECT_LT(errors.dual, 1e-12) << g;
  }
}

TEST(ShearFriction, LosesWhatItsLoopEncloses) {
  std::array<double, kShearHistory> committed{}, trial{};
  double work = 0, lost = 0, stored = 0, force = 0, before = 0, most = 0;
  const int steps = 2000;
  for (int s = 0; s <= 2 * steps; ++s) {
    const double g = 0.18 * std::sin(2 * std::numbers::pi * s / steps);
    Answer<double, 3> out{};
    addShearFriction<all_parts>(numbers, g, History<double>{committed.data(), trial.data(), 1, true}, 0, out);
    EXPECT_GE(out.lost, 0);
    most = std::max(most, out.slope[2]);
    if (s > 0) work += 0.5 * (out.resultant[2] + force) * (g - before);
    lost += out.lost;
    stored = out.energy;
    force = out.resultant[2], before = g;
    committed = trial;
  }
  EXPECT_NEAR(work, stored + lost, 1e-3 * work);
  EXPECT_LE(most, steepestShearFriction(numbers));
  EXPECT_GT(most, 0.5 * steepestShearFriction(numbers));
}

/// A monotone way is the same in one step or in a thousand.
TEST(ShearFriction, OneStepIsAThousand) {
  std::array<double, kShearHistory> committed{}, trial{};
  Answer<double, 3> once{}, often{};
  addShearFriction<only_resultants>(numbers, 0.12, History<double>{committed.data(), trial.data(), 1, true}, 0, once);
  for (int s = 1; s <= 1000; ++s) {
    often = {};
    addShearFriction<only_resultants>(numbers, 0.12 * s / 1000, History<double>{committed.data(), trial.data(), 1, true},
                                      0, often);
    committed = trial;
  }
  EXPECT_NEAR(once.resultant[2], often.resultant[2], 1e-12 * once.resultant[2]);
}

TEST(KesShear, FindsTheSheetThatWasRead) {
  const KesShear read{122.5, 4.915, 7.269};
  for (const double span : {0.5 * kDegree, kDegree, 4 * kDegree}) {
    const KesShear again = readKesShear(sheetOfKesShear(read, span));
    EXPECT_NEAR(again.rigidity_N_per_m, read.rigidity_N_per_m, 1e-9);
    EXPECT_NEAR(again.hysteresis_N_per_m, read.hysteresis_N_per_m, 1e-10);
    EXPECT_NEAR(again.hysteresis_5_N_per_m, read.hysteresis_5_N_per_m, 1e-10);
  }
  const ShearedSheet steady = sheetOfKesShear({122.5, 4.915, 0}, kDegree);
  EXPECT_EQ(steady.friction.growth_N_per_m, 0);
  EXPECT_NEAR(readKesShear(steady).hysteresis_5_N_per_m, 4.915, 1e-10) << "as wide everywhere between the turns";
}

TEST(KesShear, RefusesWhatNoFrictionIs) {
  EXPECT_THROW(sheetOfKesShear({122.5, 4.9, 4}, kDegree), InputError) << "a loop that narrows";
  EXPECT_THROW(sheetOfKesShear({122.5, 0.1, 7}, kDegree), InputError) << "nearly none at 0.5 degrees";
  EXPECT_THROW(sheetOfKesShear({10, 4.9, 7}, kDegree), InputError) << "G of friction alone";
}

}  // namespace
}  // namespace gambeson
