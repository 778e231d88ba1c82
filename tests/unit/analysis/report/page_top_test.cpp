#include "analysis/report/page_top.hpp"

#include <gtest/gtest.h>

#include "analysis/render/render.hpp"
#include "analysis/report/html.hpp"
#include "analysis/report/report.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// A run with a headline, two doubts above it, a note and a second picture below.
ReportInput input() {
  Image image;
  image.width = image.height = 1;
  image.rgb = {10, 20, 30};
  ReportInput in;
  in.title = "Shorts <of \"denim\"> & a man";
  in.description = "A man walks.";
  in.outcome = "Largest force: 3 N > 2 N on the man's knee.";
  in.warnings = {"The run stopped at 1.2 s: \"why\" & where"};
  in.notes = {"a note"};
  in.pictures = {{encodePng(image), "the first", ""}, {encodePng(image), "the second", ""}};
  in.audit = {{"Momentum", 2, 1, "%", "sums", "momentum does not balance", true}};
  return in;
}

TEST(PageTop, IsWhatThePageSaysFirst) {
  const PageTop top = pageTopOf(formatReport(input()));
  EXPECT_EQ(top.sentence, "Largest force: 3 N > 2 N on the man's knee.");
  ASSERT_EQ(top.doubts.size(), 2u);
  EXPECT_EQ(top.doubts[0], "The run stopped at 1.2 s: \"why\" & where");
  EXPECT_TRUE(top.doubts[1].starts_with("1 of 1 checks of this run fails: momentum does not balance."))
      << top.doubts[1];
  EXPECT_EQ(top.doubts[1].find('<'), std::string::npos);
  EXPECT_NE(top.figure.find("<figcaption>the first"), std::string::npos);
  EXPECT_NE(top.figure.find("src=\"data:image/png;base64,"), std::string::npos);
  EXPECT_EQ(top.figure.find("the second"), std::string::npos);
}

TEST(PageTop, IsEmptyWhereThePageSaysNothing) {
  ReportInput in = input();
  in.warnings.clear();
  in.audit.clear();
  in.pictures.clear();
  const PageTop top = pageTopOf(formatReport(in));
  EXPECT_TRUE(top.doubts.empty());
  EXPECT_TRUE(top.figure.empty());
}

TEST(PageTop, RefusesWhatIsNoPageOfARun) {
  EXPECT_THROW(pageTopOf(""), RunError);
  EXPECT_THROW(pageTopOf("<html><p class=\"alarm\">x</p></html>"), RunError);
  EXPECT_THROW(pageTopOf("<section class=\"headline\"></section>"), RunError);
  EXPECT_THROW(readPageTop("/nonexistent/report.html"), RunError);
}

TEST(Html, TextOfUndoesEscape) {
  const std::string text = "a < b & \"c\" > 'd' &amp; e";
  EXPECT_EQ(html::textOf(html::escape(text)), text);
  EXPECT_EQ(html::textOf("see <a href=\"#audit\">the checks</a>."), "see the checks.");
}

}  // namespace
}  // namespace gambeson
