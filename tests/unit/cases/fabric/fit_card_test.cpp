// Numbers of cards from measured points: what noisy points of a known fabric give back, and how often within the
// errors.
#include "cases/fabric/fit_card.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "cases/cloth/card_library.hpp"
#include "cases/cloth/card_terms.hpp"
#include "core/error.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

/// What the points are of, SI.
const std::map<std::string, double> truth{
    {"EMT weft", 0.06}, {"LT weft", 0.65}, {"EMT warp", 0.03},   {"LT warp", 0.85}, {"G", 90},
    {"2HG", 4},         {"B weft", 2e-5},  {"2HB weft", 1.2e-3}, {"B warp", 5e-5},  {"2HB warp", 2e-3}};

/// b of Fung's curve with this LT, by bisection.
double bendOf(double lt) {
  double low = -20, high = 60;
  for (int i = 0; i < 200; ++i) {
    const double b = 0.5 * (low + high), now = std::abs(b) < 1e-9 ? 1 : 2 / b - 2 / std::expm1(b);
    (now > lt ? low : high) = b;
  }
  return 0.5 * (low + high);
}

/// Points of the fabric above, each with an error of its own of these sizes.
Measurements measured(unsigned seed, double noise) {
  std::mt19937 random(seed);
  const auto error = [&](double size) { return std::normal_distribution<double>(0, noise * size)(random); };
  Measurements m;
  for (int i = 0; i < 2; ++i) {
    const double emt = truth.at(i ? "EMT warp" : "EMT weft"), b = bendOf(truth.at(i ? "LT warp" : "LT weft"));
    for (int k = 1; k <= 20; ++k) {
      const double e = emt * k / 20;
      m.tension[i].push_back({e, 490.3325 * std::expm1(b * e / emt) / std::expm1(b) + error(5)});
    }
    const double B = truth.at(i ? "B warp" : "B weft"), width = truth.at(i ? "2HB warp" : "2HB weft");
    for (int k = 0; k <= 60; ++k) {
      const double x = k < 20   ? 12.5 * k
                       : k < 40 ? 250 - 25 * (k - 20)
                                : -250 + 25 * (k - 40),
                   way = k < 20 || k > 40 ? 1 : -1;
      m.bending[i].push_back({x, B * x + 0.5 * way * width + error(1e-4)});
    }
  }
  for (int k = 0; k <= 64; ++k) {
    const double degree = 0.017453292519943295, x = (k < 16   ? 0.5 * k
                                                     : k < 40 ? 8 - 16. * (k - 16) / 24
                                                              : -8 + 16. * (k - 40) / 24) *
                                                    degree;
    m.shear.push_back({x, truth.at("G") * std::tan(x) + (k > 16 && k <= 40 ? -2 : 2) + error(0.3)});
  }
  return m;
}

FabricCard anyCard() { return readCard("denim_a"); }

TEST(FitCard, FindsWhatPointsWithoutErrorsAreOf) {
  FabricCard card = anyCard();
  for (const FittedNumber& n : fitCard(measured(1, 0), card)) {
    EXPECT_NEAR(n.value, truth.at(n.name), 1e-6 * truth.at(n.name)) << n.name;
    EXPECT_LT(n.error, 1e-6 * truth.at(n.name)) << n.name;
  }
  EXPECT_NEAR(*card.tensile->linearity.warp, 0.85, 1e-6);
  EXPECT_NEAR(*card.bending.hysteresis.weft, 1.2e-3, 1e-9);
  EXPECT_NO_THROW(fabricOf(card));
}

// Of many noisy sheets the truth lies within one error in 68 %, within two in 95 % (Gauss; of 400 sheets +- 2.3 and
// 1.1 %, one standard deviation).
TEST(FitCard, TheTruthLiesWithinTheErrors) {
  constexpr int kSheets = 400;
  std::map<std::string, int> within_one, within_two;
  for (unsigned seed = 1; seed <= kSheets; ++seed) {
    FabricCard card = anyCard();
    for (const FittedNumber& n : fitCard(measured(seed, 1), card)) {
      const double off = std::abs(n.value - truth.at(n.name)) / n.error;
      within_one[n.name] += off <= 1;
      within_two[n.name] += off <= 2;
    }
  }
  EXPECT_EQ(within_one.size(), truth.size());
  for (const auto& [name, count] : within_one) {
    EXPECT_NEAR(100. * count / kSheets, 68.3, 8) << name;
    EXPECT_NEAR(100. * within_two[name] / kSheets, 95.4, 4) << name;
  }
}

TEST(FitCard, OverhangsGiveRigidity) {
  FabricCard card = anyCard();
  card.weight_kg_per_m2 = 0.3;
  const double c = lab::lengthOfRigidity(3e-5, 0.3);
  Measurements m;
  for (auto& lengths : m.overhang) lengths = {2 * c - 1e-3, 2 * c, 2 * c + 1e-3};
  const std::vector<FittedNumber> numbers = fitCard(m, card);
  ASSERT_EQ(numbers.size(), 2u);
  EXPECT_NEAR(numbers[0].value, 3e-5, 1e-10);
  // dB/B = 3 dL/L, dL the standard error of the mean.
  EXPECT_NEAR(numbers[0].error, 3e-5 * 3 * 1e-3 / std::sqrt(3.) / (2 * c), 1e-9);
  EXPECT_FALSE(card.bending.hysteresis.any());
}

TEST(FitCard, MeasurementsAreReadAndRefused) {
  const Folder folder;
  const std::string good = R"json({
  "source": "our laboratory",
  "tension_weft": [["1 %", "20 gf/cm"], ["2 %", "60 gf/cm"], ["3 %", "140 gf/cm"], ["4 %", "300 gf/cm"]],
  "tension_warp": [["1 %", "30 gf/cm"], ["2 %", "80 gf/cm"], ["3 %", "200 gf/cm"]],
  "overhang_weft": ["4.1 cm", "4.2 cm"]
}
)json";
  const Measurements m = readMeasurements(folder.write("m.json", good));
  EXPECT_NEAR(m.tension[0][2][1], 140 * 0.980665, 1e-9);
  EXPECT_EQ(m.overhang[0][1], 0.042);
  const std::vector<Bad> cases{{"\"20 gf/cm\"", "20", 3, "tension_weft[0][1]", "has no unit"},
                               {"\"1 %\", \"30", "\"-1 %\", \"30", 4, "tension_warp", "allowed: > 0"},
                               {"\"4.1 cm\"", "\"0 cm\"", 5, "overhang_weft[0]", "out of range"},
                               {"overhang_weft", "overhang", 5, "overhang", "unknown key"},
                               {"  \"source\": \"our laboratory\",\n", "", 1, "source", "required"}};
  for (const Bad& bad : cases) {
    SCOPED_TRACE(bad.from);
    try {
      readMeasurements(folder.write("bad.json", replaced(good, bad.from, bad.to)));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().line, bad.line) << e.what();
      EXPECT_EQ(e.where().key, bad.key) << e.what();
      EXPECT_NE(e.reason().find(bad.reason), std::string::npos) << e.what();
    }
  }
  const auto refused = [&](const Measurements& wrong) {
    FabricCard card = anyCard();
    try {
      fitCard(wrong, card);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return std::string("accepted");
  };
  Measurements few = m;
  few.tension[1].resize(2);
  EXPECT_EQ(refused(few), "tension_warp");
  EXPECT_EQ(refused(m), "overhang_weft") << "the card has no weight";
}

}  // namespace
}  // namespace gambeson
