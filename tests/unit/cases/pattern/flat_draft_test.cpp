/// Drafts as flat patterns in files: what comes back is what went out.

#include "cases/pattern/flat_draft.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "cases/pattern/dxf_write.hpp"
#include "cases/pattern/import.hpp"
#include "cases/pattern/pattern_file.hpp"
#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/flat/flatten_draft.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/pattern.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

std::vector<Garment> drafts() {
  const Human human = makeManikin("female_p50");
  const BodyForm form(human);
  ShortsPattern shorts;
  shorts.cell_m = 0.04, shorts.inseam_m = 0.65;
  ShirtPattern shirt;
  shirt.cell_m = 0.035;
  ShirtPattern sleeved = shirt;
  sleeved.sleeve_length_m = 0.3;
  SkirtPattern skirt;
  return {makeShorts(shorts, form), makeShirt(shirt, form, 1e-3, {}), makeShirt(sleeved, form, 1e-3, {}),
          makeSkirt(skirt, form, 1e-3, {})};
}

void expectSame(const std::vector<SeamPart>& a, const std::vector<SeamPart>& b, const std::string& seam) {
  ASSERT_EQ(a.size(), b.size()) << seam;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].panel, b[k].panel) << seam;
    EXPECT_EQ(a[k].edge, b[k].edge) << seam;
    EXPECT_EQ(a[k].from, b[k].from) << seam;
    EXPECT_EQ(a[k].to, b[k].to) << seam;
  }
}

TEST(FlatDraft, ComesBackFromDxf) {
  const Folder folder;
  for (const Garment& g : drafts()) {
    const FlatPattern out = flattenDraft(g).pattern;
    const ImportedPattern in = importPattern(folder.write(g.name + ".dxf", patternDxf(out)), {});
    EXPECT_EQ(in.pattern.name, g.name);
    EXPECT_EQ(in.pattern.source.unit, "mm");
    ASSERT_EQ(in.pattern.panels.size(), out.panels.size());
    for (std::size_t k = 0; k < out.panels.size(); ++k) {
      const Panel &a = out.panels[k], &b = in.pattern.panels[k];
      EXPECT_EQ(a.name, b.name);
      EXPECT_NEAR(areaOf(b) / areaOf(a), 1, 1e-6) << a.name;
      ASSERT_EQ(a.outline.size(), b.outline.size()) << a.name;
      for (std::size_t e = 0; e < a.outline.size(); ++e)
        EXPECT_NEAR(lengthOf(b, static_cast<int>(e)) / lengthOf(a, static_cast<int>(e)), 1, 2e-6) << a.name << " " << e;
      ASSERT_EQ(a.notches.size(), b.notches.size()) << a.name;
      for (std::size_t n = 0; n < a.notches.size(); ++n) {
        EXPECT_EQ(a.notches[n].edge, b.notches[n].edge) << a.name << " " << n;
        EXPECT_NEAR(a.notches[n].at, b.notches[n].at, 1e-4) << a.name << " " << n;
      }
      ASSERT_TRUE(b.grain);
      EXPECT_NEAR(b.grain->to_m.x, a.grain->to_m.x, 1e-6);
      EXPECT_NEAR(b.grain->to_m.y, a.grain->to_m.y, 1e-6);
    }
    ASSERT_EQ(in.pattern.seams.size(), out.seams.size());
    for (std::size_t s = 0; s < out.seams.size(); ++s) {
      EXPECT_FALSE(in.pattern.seams[s].proposed);
      EXPECT_EQ(in.pattern.seams[s].stiffness_N, out.seams[s].stiffness_N);
      expectSame(out.seams[s].a, in.pattern.seams[s].a, out.seams[s].name);
      expectSame(out.seams[s].b, in.pattern.seams[s].b, out.seams[s].name);
    }
  }
}

TEST(FlatDraft, IsWrittenByItsEnding) {
  const Folder folder;
  const Garment shorts = drafts().front();
  std::ostringstream said;
  for (const char* ending : {".dxf", ".svg", ".json"})
    flatToFile(shorts, folder.path() / ("s" + std::string(ending)), 0.02, said);
  EXPECT_NE(said.str().find("strain rms"), std::string::npos);
  EXPECT_EQ(importPattern(folder.path() / "s.json", {}).pattern.seams.size(), 9u);
  EXPECT_NE(content(folder.path() / "s.svg").find("<svg"), std::string::npos);
  EXPECT_NE(content(folder.path() / "s.dxf").find("PIECE NAME: trunk_left"), std::string::npos);
}

TEST(FlatDraft, TextsOfSeamsAreChecked) {
  const Folder folder;
  std::string dxf = patternDxf(flattenDraft(drafts().front()).pattern);
  const auto refused = [&](const std::string& from, const std::string& to) {
    try {
      importPattern(folder.write("bad.dxf", replaced(dxf, from, to)), {});
    } catch (const InputError& e) {
      return e.where().key + ": " + e.reason();
    }
    return std::string("accepted");
  };
  EXPECT_NE(refused("\"trunk_left.3 reversed\"", "\"trunk.3 reversed\"").find("names no panel"), std::string::npos);
  EXPECT_NE(
      refused("GAMBESON SEAM: { \"name\": \"s1\"", "GAMBESON SEAM: [ \"name\": \"s1\"").find("GAMBESON SEAM text 1"),
      std::string::npos);
}

}  // namespace
}  // namespace gambeson
