/// Which panels of a draft no flat cloth makes.

#include <gtest/gtest.h>

#include "tryon/pattern/flat/flatten_draft.hpp"

namespace gambeson {
namespace {

TEST(BeyondText, NamesWhatLiesFarBeyondWhatTheFabricStands) {
  FlattenedDraft flat;
  for (const char* name : {"front", "top", "back", "under", "cuff"}) {
    flat.pattern.panels.emplace_back();
    flat.pattern.panels.back().name = name;
  }
  flat.flattening = {{0.12, 0.019, 0}, {0.79, 0.08, 0}, {0.05, 0.03, 0}, {0.1, 0.05, 0}, {0.4, 0.01, 0}};
  EXPECT_EQ(
      beyondText(flat, 0.02),
      "top by up to 79 % (8 % in the mean), cuff by up to 40 % (1 % in the mean), under by up to 10 % (5 % in the "
      "mean)");
  EXPECT_EQ(beyondText(flat, 0.11), "top by up to 79 % (8 % in the mean)");
  EXPECT_EQ(beyondText(flat, 0.5), "");
  EXPECT_NE(beyondText(flat, 0.001).find(" and 2 more"), std::string::npos);
}

}  // namespace
}  // namespace gambeson
