/// Cells that are too coarse for the folds of thin cloth are told before the results.

#include "core/material/coarseness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/wear/scene/scenario.hpp"

namespace gambeson {
namespace {

/// The strip that the threshold is calibrated with: 0.2 m on 32 cells, w L^3/B = 10, t = L/10,000: 3 % off.
TEST(Coarseness, OfTheStripThatItIsCalibratedWith) {
  Fabric f;
  f.thickness_m = 2e-5;
  f.density_kg_per_m3 = 0.1 / f.thickness_m;
  f.law = LinearBending{{8e-5, 8e-5}};
  f.young_weft_Pa = f.young_warp_Pa = 12 * 8e-5 / (f.thickness_m * f.thickness_m * f.thickness_m);
  const double R = std::cbrt(8e-5 / (0.1 * 10));
  const double N = coarseness(f, 0.2 / 32, 10);
  EXPECT_NEAR(N, 0.00625 * 0.00625 / (2e-5 * R), 1e-9 * N);
  EXPECT_GT(N, kCoarse);
  EXPECT_NEAR(coarseness(f, fineEnough(0.2 / 32, N), 10), kCoarse, 1e-9);
  EXPECT_EQ(coarseness(f, 0.2 / 32, 0), 0);
  f.tension_field = true;
  EXPECT_EQ(coarseness(f, 0.2 / 32, 10), 0);
}

/// The table beside the law: 5 % at 45, 10 at 70 to 150, 20 to 25 at 80 to 210.
TEST(Coarseness, SaysWhatTheTableHas) {
  EXPECT_STREQ(coarseError(20), "some 4 %");
  EXPECT_STREQ(coarseError(45), "some 5 %");
  for (const double N : {70.0, 80.0, 115.0, 150.0, 210.0}) EXPECT_STREQ(coarseError(N), "10 to 25 %") << N;
}

bool told(const std::vector<std::string>& overrides) {
  const auto s = buildScenario(readCase(GAMBESON_SOURCE_DIR "/cases/library/sphere_drape.json", overrides));
  return std::any_of(s->notes.begin(), s->notes.end(),
                     [](const std::string& note) { return note.find("bends so easily") != std::string::npos; });
}

/// B/(E h) of a shirt's cotton, 5e-11 m^2, on the library's drape, and stiffer.
TEST(Coarseness, IsANoteOfTheCase) {
  const std::vector<std::string> cotton{R"(fabric={"thickness": "0.3 mm", "surface_density": 0.12, "young": "300 MPa",
    "poisson": 0, "bending": {"law": "linear", "rigidity": 4.5e-6}})"};
  EXPECT_TRUE(told(cotton));
  std::vector<std::string> stiff = cotton;
  stiff.push_back("fabric.young=30 kPa");
  EXPECT_FALSE(told(stiff));
}

}  // namespace
}  // namespace gambeson
