/// A case's list of what it wants of a pattern's seams otherwise.
#include "cases/pattern/seam_edits.hpp"

#include <gtest/gtest.h>

#include "cases/pattern/pattern_file.hpp"
#include "cases/pattern/seam_text.hpp"
#include "tryon/pattern/flat/panel_garment.hpp"

namespace gambeson {
namespace {

/// "left side" of front.1 and back.3, "right side" of back.1 and front.3; hems and waists are free.
FlatPattern skirtToEdit() {
  return readPattern(std::filesystem::path(GAMBESON_SOURCE_DIR "/cases/library/garments/skirt_of_two_panels.json"));
}

SeamEdit editOf(const std::string& seam) {
  SeamEdit e;
  e.seam = seam;
  return e;
}

TEST(SeamEdits, ChangeTakeAwayAndAdd) {
  SeamEdit opens = editOf("left side"), removes = editOf("front.3"), adds = editOf("waist");
  opens.use = SeamUse::opening, opens.open = true, opens.buttons = 3, opens.stiffness_N = 0;
  removes.remove = true;
  adds.a = {"front.waist"}, adds.b = {"back.2 reversed"};
  adds.stiffness_N = 0.01, adds.rest_angle_rad = 0.5;
  const EditedPattern edited = editSeams(skirtToEdit(), std::vector{removes, opens, adds});
  const std::vector<PanelSeam>& seams = edited.pattern.seams;
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_EQ(seams[0].name, "left side");
  EXPECT_EQ(seams[0].use, SeamUse::opening);
  EXPECT_TRUE(seams[0].open);
  EXPECT_EQ(seams[0].buttons, 3);
  EXPECT_EQ(seams[0].stiffness_N, 0);
  EXPECT_EQ(seams[1].name, "waist");
  EXPECT_EQ(partText(edited.pattern, seams[1].a[0]), "front.2");
  EXPECT_EQ(partText(edited.pattern, seams[1].b[0]), "back.2 reversed");
  EXPECT_EQ(seams[1].rest_angle_rad, 0.5);
  ASSERT_EQ(edited.origins.size(), 2u);
  EXPECT_EQ(edited.origins[0].edit, 1);
  EXPECT_EQ(edited.origins[1].edit, 2);
  EXPECT_EQ(edited.origins[1].file, -1);

  FlatPattern proposed = skirtToEdit();
  for (PanelSeam& s : proposed.seams) s.proposed = true;
  SeamEdit stiffer = editOf("right side");
  stiffer.stiffness_N = 0.02;
  const EditedPattern looked_at = editSeams(proposed, std::vector{stiffer});
  EXPECT_TRUE(looked_at.pattern.seams[0].proposed);
  EXPECT_FALSE(looked_at.pattern.seams[1].proposed) << "somebody looked at it";
  EXPECT_EQ(looked_at.pattern.seams[1].stiffness_N, 0.02);
  EXPECT_EQ(looked_at.pattern.seams[0].stiffness_N, 0.001) << "as it was";
}

TEST(SeamEdits, WhatIsWrongIsSaidAtTheEdit) {
  const auto refused = [](SeamEdit edit, const std::string& key) {
    SeamEdit removes = editOf("left side");
    removes.remove = true;
    try {
      editSeams(skirtToEdit(), std::vector{removes, edit});
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key) << e.reason();
      return e.reason();
    }
    return std::string("accepted");
  };
  const auto says = [&](const SeamEdit& edit, const std::string& key, const std::string& words) {
    const std::string reason = refused(edit, key);
    EXPECT_NE(reason.find(words), std::string::npos) << reason;
  };
  says(editOf("right sied"), "seams[1].seam", "did you mean \"right side\"?");
  says(editOf("zip"), "seams[1].seam", "allowed: right side, or an edge that is sewn");
  says(editOf("left side"), "seams[1].seam", "is no seam of this pattern");  // gone
  says(editOf("front.hem"), "seams[1].seam", "is sewn to nothing");
  says(editOf("front.hme"), "seams[1].seam", "names no edge of panel \"front\"; allowed: 0 to 3, hem (0), waist (2)");
  says(editOf("fornt.1"), "seams[1].seam", "did you mean \"front\"?");
  SeamEdit e = editOf("right side");
  e.a = {"front.1"}, e.b = {"back.3 reversed"};
  says(e, "seams[1].seam", "is a seam already");
  e.seam = "new";
  e.b = {"back.7"};
  says(e, "seams[1].b[0]", "there is no edge 7 of panel \"back\"; allowed: 0 to 3, hem (0), waist (2)");
  e.b = {"back.1"};
  says(e, "seams[1].b[0]", "is sewn already, by seam \"right side\"");
  e = editOf("right side");
  e.open = true;
  says(e, "seams[1].open", "allowed: with \"use\": \"opening\"");
  e.use = SeamUse::opening;
  says(e, "seams[1].stiffness", "is of a seam that is sewn");
  e = editOf("right side");
  e.use = SeamUse::dart;
  says(e, "seams[1].b[0]", "is of another panel");
  // A seam of which both sides are too unlike is found out as the garment is made, at the edit too.
  e = editOf("gather");
  e.a = {"front.1 from 0 to 0.3"}, e.b = {"back.3 reversed"};
  EditedPattern gathered = editSeams(
      [] {
        FlatPattern p = skirtToEdit();
        p.seams.erase(p.seams.begin());
        return p;
      }(),
      std::vector{e});
  try {
    panelGarment(gathered.pattern, {0.05, 2});
    ADD_FAILURE();
  } catch (const InputError& error) {
    std::string key;
    EXPECT_TRUE(gathered.isOfEdit(error, key)) << error.where().key;
    EXPECT_EQ(key, "seams[0]");
  }
}

}  // namespace
}  // namespace gambeson
