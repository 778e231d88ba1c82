#include "cases/gallery/gallery.hpp"

#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "unit/cases/study/example.hpp"

namespace gambeson::gallery {
namespace {

bool has(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

Exhibit shown() {
  Exhibit e;
  e.sort = Sort::cloth;
  e.folder = "flag";
  e.title = "A flag <falls>";
  e.description = "It hangs. How far does it fall?";
  e.top.sentence = "It falls by 3 mm.";
  e.top.figure = "<figure><img alt=\"a flag\" src=\"data:image/png;base64,AA\"></figure>\n";
  return e;
}

TEST(Gallery, TheQuestionIsWhatTheDescriptionAsks) {
  const Question asked =
      questionOf("Shorts (Zheng 2013, section 6.2) on a man. How much torque? And where? With --set more.");
  EXPECT_TRUE(asked.asked);
  EXPECT_EQ(asked.text, "How much torque? And where?");
  const Question first = questionOf("Zheng 2013, section 3.7.2, fig. 8 and fig. B: a sheet falls 5 mm. It rests.");
  EXPECT_FALSE(first.asked);
  EXPECT_EQ(first.text, "Zheng 2013, section 3.7.2, fig. 8 and fig. B: a sheet falls 5 mm.");
  EXPECT_EQ(questionOf("Sheets (their size is ours. They lie) are pulled.").text,
            "Sheets (their size is ours. They lie) are pulled.");
  EXPECT_EQ(questionOf("no stop").text, "no stop");
  EXPECT_EQ(questionOf("").text, "");
}

/// What a reader needs of each: picture, title with the way to the report, question, answer.
TEST(Gallery, ThePageShowsPictureQuestionAndAnswer) {
  const std::string page = formatGallery({shown()}, {});
  for (const char* what : {"data:image/png;base64,AA", "<a href=\"flag/report.html\">A flag &lt;falls&gt;</a>",
                           "How far does it fall?", "It falls by", "Cloth without a wearer (1)"})
    EXPECT_TRUE(has(page, what)) << what;
  for (const char* not_there : {"failed", "Not shown", "Garments on people"})
    EXPECT_FALSE(has(page, not_there)) << not_there;
}

/// Nothing is dropped: what fails, what has no picture, what is no case.
TEST(Gallery, ThePageSaysWhatFailsAndWhatIsMissing) {
  Exhibit doubtful = shown(), failed = shown(), bare = shown();
  doubtful.folder = "doubtful", doubtful.top.doubts = {"1 of 9 checks fails: energy is lost."};
  failed.folder = "failed_one", failed.failed = "the step is <too> small", failed.no_page = "its run left no report.";
  failed.top = {};
  bare.folder = "bare", bare.top.figure.clear();
  const std::string page = formatGallery({doubtful, failed, bare}, {{"cards/a.card.json", "a fabric card"}});
  for (const char* what : {"1 of 9 checks fails: energy is lost.", "1 of 3 failed: <a href=\"#case_failed_one\">",
                           "The run failed:", "the step is &lt;too&gt; small", "No picture: its run left no report.",
                           "No picture: its report begins with none.", "cards/a.card.json: a fabric card"})
    EXPECT_TRUE(has(page, what)) << what;
  EXPECT_FALSE(has(page, "failed_one/report.html")) << "a link to nothing";
}

TEST(Gallery, OfALibraryEachFileIsShownOrListed) {
  const Folder folder;
  std::filesystem::create_directories(folder.path() / "cards");
  folder.write("cloth.json", study::tested::cloth);
  folder.write("slip.study.json", study::tested::good);
  folder.write("cards/blue.card.json", "{}");
  folder.write("walk.png", "");
  folder.write("law.json", "{\"units\": 1}");
  const Chosen chosen = chooseLibrary(folder.path());
  ASSERT_EQ(chosen.cases.variants.size(), 1u);
  EXPECT_EQ(chosen.cases.variants[0].folder, "cloth");
  ASSERT_EQ(chosen.studies.size(), 1u);
  EXPECT_EQ(folderOf(chosen.studies[0]), "slip.study");
  ASSERT_EQ(chosen.left_out.size(), 3u);
  EXPECT_EQ(chosen.left_out[0].first, "cards/blue.card.json");
  EXPECT_TRUE(has(chosen.left_out[0].second, "gambeson fabric blue"));
}

/// Of the library that ships: every case and study, and what belongs to which.
TEST(Gallery, TheLibraryIsComplete) {
  const std::filesystem::path library = GAMBESON_SOURCE_DIR "/cases/library";
  EXPECT_EQ(findLibrary(GAMBESON_BINARY), library);
  const Chosen chosen = chooseLibrary(library);
  std::set<std::size_t> kinds;
  for (const study::Variant& v : chosen.cases.variants) kinds.insert(v.definition.index());
  EXPECT_EQ(kinds.size(), std::variant_size_v<AnyCase>);
  EXPECT_GE(chosen.studies.size(), 8u);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(library)) files += entry.is_regular_file();
  EXPECT_EQ(chosen.cases.variants.size() + chosen.studies.size() + chosen.left_out.size(), files);
  for (const auto& [file, why] : chosen.left_out)
    EXPECT_EQ(file == "funnel.obj", why == "a part of wong_funnel") << file;
}

TEST(Gallery, RefusesWhatCannotBeShown) {
  const Folder folder;
  folder.write("cloth.json", study::tested::cloth);
  std::filesystem::create_directories(folder.path() / "other");
  folder.write("other/cloth.json", study::tested::cloth);
  folder.write("typo.json", R"({"garment": {}, "colour": 1})");
  const auto refused = [&](auto call, const std::string& word) {
    try {
      call();
      ADD_FAILURE() << word;
    } catch (const InputError& e) {
      EXPECT_TRUE(has(e.what(), word)) << e.what();
    }
  };
  refused([&] { chooseFiles({folder.path() / "cloth.json", folder.path() / "other/cloth.json"}); }, "same name");
  refused([&] { chooseFiles({folder.path() / "typo.json"}); }, "typo.json:1: colour: unknown key");
  refused([&] { chooseFiles({folder.path() / "absent.json"}); }, "there is no such file");
  refused([&] { chooseLibrary(folder.path() / "absent"); }, "there is no folder");
  refused([&] { chooseLibrary(folder.path() / "other/none"); }, "--library");
  refused([&] { findLibrary("/nonexistent/bin/gambeson"); }, "no library");
}

}  // namespace
}  // namespace gambeson::gallery
