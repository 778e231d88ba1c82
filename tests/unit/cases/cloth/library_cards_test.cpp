// The measured fabrics that ship as cards: all are read, say where they are from, and have the published numbers.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "cases/cloth/card.hpp"
#include "unit/cases/fabric/denims.hpp"

namespace gambeson {
namespace {

std::filesystem::path cardFile(const std::string& name) {
  return std::filesystem::path(GAMBESON_SOURCE_DIR) / "cases/library/cards" / (name + ".card.json");
}

TEST(LibraryCards, AllAreReadAndSayWhereTheyAreFrom) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(cardFile("denim_a").parent_path())) {
    SCOPED_TRACE(entry.path().filename());
    const FabricCard card = readCard(entry.path());
    EXPECT_TRUE(names.insert(card.name).second) << card.name << " is there twice";
    EXPECT_GT(card.source.size(), 40u);
    EXPECT_FALSE(card.description.empty());
    EXPECT_FALSE(card.spread.empty());
    EXPECT_FALSE(card.range.empty());
    const FabricCase fabric = fabricOf(card).fabric;
    EXPECT_GT(fabric.young_weft_Pa, 0);
    EXPECT_GT(fabric.young_warp_Pa, 0);
    EXPECT_GT(fabric.shear_Pa, 0);
    EXPECT_LT(fabric.poisson * fabric.poisson * fabric.young_warp_Pa, fabric.young_weft_Pa);
  }
  EXPECT_EQ(names.size(), 22u);
}

/// Of one cloth of Petrak et al. 2025 (doi:10.3390/su17041388): weight [g/m^2], thickness [mm], G [N/m], rigidity along
/// weft and warp [1e-9 N m], drape coefficient [%].
struct Draping {
  const char* name;
  double weight, thickness, shear, weft, warp, drape;
};

TEST(LibraryCards, ClothsOfPetrakHaveTheNumbersOfTheirTables) {
  for (const Draping& d : {Draping{"m1_polyester_twill", 135.17, 0.31, 41, 610, 1950, 22.3},
                           Draping{"m2_polyester_plain", 83.66, 0.25, 46, 330, 850, 22.8},
                           Draping{"m3_wool_twill", 178.70, 0.40, 50, 2000, 2140, 34.9},
                           Draping{"m4_viscose_twill", 286.13, 0.61, 61, 2400, 2970, 28.6},
                           Draping{"m5_stretch_plain", 242.00, 0.56, 57, 3880, 3220, 44.3},
                           Draping{"m6_cotton_twill", 253.36, 0.62, 126, 3700, 7430, 54.9}}) {
    SCOPED_TRACE(d.name);
    const FabricCard card = readCard(cardFile(std::string("petrak_") + d.name));
    EXPECT_NEAR(*card.weight_kg_per_m2, 1e-3 * d.weight, 1e-12);
    EXPECT_NEAR(card.thickness_m, 1e-3 * d.thickness, 1e-12);
    EXPECT_NEAR(card.shear->rigidity.mean(), d.shear, 1e-9);
    EXPECT_NEAR(*card.bending.rigidity.weft, 1e-9 * d.weft, 1e-16);
    EXPECT_NEAR(*card.bending.rigidity.warp, 1e-9 * d.warp, 1e-16);
    EXPECT_NEAR(card.drape->coefficient, 0.01 * d.drape, 1e-12);
    EXPECT_EQ(card.drape->specimen_m, 0.3);
    EXPECT_FALSE(card.tensile);
  }
}

TEST(LibraryCards, DenimsHaveTheNumbersOfTheirTable) {
  const char* const files[] = {"denim_a", "denim_b", "denim_c", "denim_d", "denim_e", "denim_f"};
  for (std::size_t i = 0; i < denims.size(); ++i) {
    SCOPED_TRACE(files[i]);
    const FabricCard card = readCard(cardFile(files[i])), table = cardOf(denims[i]);
    EXPECT_DOUBLE_EQ(card.thickness_m, table.thickness_m);
    EXPECT_DOUBLE_EQ(*card.tensile->extension.both, *table.tensile->extension.both);
    EXPECT_NEAR(*card.shear->rigidity.both, *table.shear->rigidity.both, 1e-9);
    EXPECT_NEAR(*card.shear->hysteresis.both, *table.shear->hysteresis.both, 1e-12);
    EXPECT_NEAR(*card.shear->hysteresis_5.both, *table.shear->hysteresis_5.both, 1e-12);
    EXPECT_NEAR(*card.bending.rigidity.both, *table.bending.rigidity.both, 1e-15);
    EXPECT_NEAR(*card.bending.hysteresis.both, *table.bending.hysteresis.both, 1e-13);
  }
}

/// Of one cloth of Wang, O'Brien and Ramamoorthi 2011: mass per area [kg/m^2]; of the rows at no stretch and at a
/// stretch of 1/6 the stiffness c11 along the weft, c22 along the warp, c33 along the bias and c12, c22 along the weft
/// [N/m]; rigidity along weft and warp at the smallest curvature [1e-6 N m].
struct Measured {
  const char* name;
  double weight;
  double c11[2], c22[2], c33[2], c12[2], c22_weft;
  double weft, warp;
};

// A fabric is linear: it has the mean of the two rows, which is the secant stiffness at a stretch of 1/12 as theirs is
// linear in the stretch, twice, as their program doubles all rows. Of shear stress c33 times half the angle is left.
TEST(LibraryCards, ClothsOfWangHaveTheStiffnessOfATwelfth) {
  const Measured all[] = {
      {"11oz_black_denim",
       0.324,
       {205.352005, 232.027634},
       {1013.88629, 1051.55712},
       {53.387184, 83.99202},
       {10.234077, 40.646339},
       1052.84289,
       64.196457,
       96.951576},
      {"camel_ponte_roma",
       0.284,
       {31.146198, 78.707756},
       {44.028667, 191.777588},
       {31.896357, 44.65733},
       {-12.802702, 26.754574},
       268.680725,
       36.348366,
       37.157593},
      {"gray_interlock",
       0.187,
       {16.593832, 46.364765},
       {34.477123, 405.872833},
       {36.860302, 44.217571},
       {-14.69599, 53.694656},
       261.013855,
       23.191698,
       14.267624},
      {"ivory_rib_knit",
       0.276,
       {42.871021, 52.422512},
       {65.166023, 254.593491},
       {83.175644, 27.60943},
       {-0.234556, 7.219094},
       245.337158,
       46.237591,
       32.243889},
      {"navy_sparkle_sweat",
       0.224,
       {12.486332, 32.172089},
       {3.272434, 243.264908},
       {17.616289, 6.1077},
       {-19.875324, 56.01276},
       283.46637,
       59.469658,
       45.625023},
      {"pink_ribbon_brown",
       0.228,
       {151.503906, 164.124344},
       {244.830673, 359.792633},
       {30.250183, 129.643188},
       {106.02816, 33.689709},
       268.195221,
       117.070122,
       59.774277},
      {"royal_target",
       0.22,
       {2016.55456, 2109.51684},
       {2034.97644, 2152.73852},
       {104.759674, 121.482445},
       {9.170511, 38.604588},
       2173.93969,
       125.409805,
       125.409805},
      {"tango_red_jet_set",
       0.113,
       {43.067627, 75.151695},
       {171.424835, 404.867188},
       {14.3147, 41.386868},
       {54.373299, 82.195221},
       236.163773,
       14.293814,
       20.345654},
      {"white_dots_on_blk",
       0.128,
       {2002.08618, 2107.22753},
       {2027.48559, 2150.4768},
       {19.189022, 101.462021},
       {0.345588, 36.371597},
       2171.73339,
       51.713814,
       31.282822},
      {"white_swim_solid",
       0.204,
       {47.971176, 40.369045},
       {104.615456, 124.468513},
       {60.773663, 35.973194},
       {6.834521, 23.092957},
       169.66629,
       60.237942,
       51.018833},
  };
  for (const Measured& m : all) {
    SCOPED_TRACE(m.name);
    const FabricCard card = readCard(cardFile(std::string("wang_") + m.name));
    EXPECT_DOUBLE_EQ(*card.weight_kg_per_m2, m.weight);
    EXPECT_NEAR(card.thickness_m, m.weight / 400, 1e-9);
    EXPECT_NEAR(*card.tensile->modulus_N_per_m.weft, m.c11[0] + m.c11[1], 5e-4 * (m.c11[0] + m.c11[1]));
    EXPECT_NEAR(*card.tensile->modulus_N_per_m.warp, m.c22[0] + m.c22[1], 5e-4 * (m.c22[0] + m.c22[1]));
    EXPECT_NEAR(*card.shear->rigidity.both, 0.5 * (m.c33[0] + m.c33[1]), 5e-4 * (m.c33[0] + m.c33[1]));
    EXPECT_NEAR(*card.tensile->poisson, (m.c12[0] + m.c12[1]) / (m.c22[0] + m.c22_weft), 6e-4);
    EXPECT_NEAR(*card.bending.rigidity.weft, 1e-6 * m.weft, 5e-10 * m.weft);
    EXPECT_NEAR(*card.bending.rigidity.warp, 1e-6 * m.warp, 5e-10 * m.warp);
    EXPECT_FALSE(card.bending.hysteresis.any());
  }
}

}  // namespace
}  // namespace gambeson
