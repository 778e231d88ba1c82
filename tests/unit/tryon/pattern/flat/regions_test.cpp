/// Words for regions of the body, and what names of panels say of them.
#include "tryon/pattern/flat/regions.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

TEST(Regions, EveryWordIsReadBack) {
  for (const std::string& name : regionNames()) {
    const std::optional<PanelRegion> region = regionOf(name);
    ASSERT_TRUE(region) << name;
    EXPECT_EQ(wordOf(*region), name);
  }
  EXPECT_EQ(regionOf("Left Sleeve"), regionOf("left_sleeve"));
  EXPECT_EQ(regionOf("skirt-front"), regionOf("skirt_front"));
  EXPECT_FALSE(regionOf("body"));
  EXPECT_FALSE(regionOf(""));
}

TEST(Regions, NamesThatSayOne) {
  const std::pair<const char*, const char*> names[] = {{"FRONT", "front"},
                                                       {"Back left", "left_back"},
                                                       {"frontLeft", "left_front"},
                                                       {"sleeve_R", "right_sleeve"},
                                                       {"LEFT SLEEVE 2", "left_sleeve"},
                                                       {"left_ftorso", "left_front"},
                                                       {"right_btorso", "right_back"},
                                                       {"pant_f_l", "left_leg_front"},
                                                       {"pant_b_r", "right_leg_back"},
                                                       {"right_sleeve_b", "right_sleeve"},
                                                       {"skirt_front", "skirt_front"},
                                                       {"wb_back", "waistband"},
                                                       {"Vorderteil", "front"},
                                                       {"R\xc3\xbc"
                                                        "ckenteil links",
                                                        "left_back"},
                                                       {"R\xc3\x9c"
                                                        "CKEN",
                                                        "back"},
                                                       {"\xc3\x84rmel rechts", "right_sleeve"},
                                                       {"Vorderhose links", "left_leg_front"},
                                                       {"Hosenbund", "waistband"},
                                                       {"Vorderrock", "skirt_front"},
                                                       {"manche gauche", "left_sleeve"},
                                                       {"devant droit", "right_front"},
                                                       {"jupe dos", "skirt_back"},
                                                       {"manga izquierda", "left_sleeve"},
                                                       {"espalda", "back"},
                                                       {"Kragen", "collar"}};
  for (const auto& [name, region] : names) EXPECT_EQ(proposedRegion(name), region) << name;
}

TEST(Regions, NamesThatSayNoneOrTwo) {
  for (const char* name :
       {"", "11", "Pattern2D_768516", "sleeve", "B", "front and back", "left right front", "front pocket",
        "back facing", "collar sleeve", "pants front", "Futter Vorderteil", "cuff left"})
    EXPECT_EQ(proposedRegion(name), "") << name;
}

}  // namespace
}  // namespace gambeson
