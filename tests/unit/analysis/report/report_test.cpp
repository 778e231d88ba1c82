#include "analysis/report/report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "analysis/render/render.hpp"
#include "analysis/report/chart.hpp"
#include "analysis/report/html.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

bool has(const std::string& page, const std::string& what) { return page.find(what) != std::string::npos; }

std::size_t count(const std::string& page, const std::string& what) {
  std::size_t n = 0;
  for (auto at = page.find(what); at != std::string::npos; at = page.find(what, at + what.size())) ++n;
  return n;
}

/// The text that a reader sees: without tags.
std::string seen(const std::string& page) {
  std::string text;
  bool in_tag = false;
  for (const char c : page) {
    if (c == '<') in_tag = true;
    if (!in_tag) text += c;
    if (c == '>') in_tag = false;
  }
  return text;
}

/// What stands between each `start` and the next quote.
std::vector<std::string> quoted(const std::string& page, const std::string& start) {
  std::vector<std::string> all;
  for (auto at = page.find(start); at != std::string::npos; at = page.find(start, at + 1)) {
    const auto from = at + start.size();
    all.push_back(page.substr(from, page.find('"', from) - from));
  }
  return all;
}

std::string onePixelPng() {
  Image image;
  image.width = image.height = 1;
  image.rgb = {10, 20, 30};
  return encodePng(image);
}

Series wave(const std::string& name, int n, Tone tone) {
  Series s{name, "Nm", {}, {}, tone};
  for (int i = 0; i < n; ++i) s.time_s.push_back(0.01 * i), s.values.push_back(std::sin(0.1 * i));
  return s;
}

ReportInput example() {
  ReportInput in;
  in.title = "Shorts <walking> & \"more\"";
  in.description = "A man walks.";
  in.task = "walking at natural speed";
  in.joints = {{"knee", "left", 0.021, 0.93, "", 0.0071, {}, {}, {}},
               {"hip", "right", -1.8349, 1.2432, "hip flexion (swing)", 0.6123, 3.31, {}, 4.24},
               {"hip", "left", 1.79, 1.79, "hip flexion (swing)", 0.605, 3.2, {}, {}}};
  Plot plot;
  plot.title = "Hip flexion torque";
  plot.series = {wave("left", 120, Tone::left), wave("right", 120, Tone::right)};
  plot.marks = {{0.5, "first stride"}};
  in.torques = {plot};
  in.contact_charts = {{"Mean contact force", "N", "", {{"right thigh", 5.31}, {"pelvis", 3.9}}}};
  in.contact_tables = {{"Contact force per segment", "", {"segment", "mean [N]"}, {{"right thigh", 5.3149}}}};
  in.stress_tables = {{"Stress", "", {"region", "99 % [N/m]"}, {{"seat", 10.24}}}};
  in.support_tables = {{"Waist springs", "", {"component", "peak [N]"}, {{"up", 4.917}}}};
  in.pictures = {{onePixelPng(), "Stress at the peak", "A figure in <shorts>"}};
  in.audit = {{"momentum", 3.1e-13, 1e-9, "", "change of momentum against impulses"}};
  in.assumptions = {"No self-contact yet."};
  in.facts = {{"steps", "412018"}, {"case", "9f3c22ab"}};
  return in;
}

TEST(Html, EscapesWhatMarkupMeans) {
  EXPECT_EQ(html::escape("a<b & \"c\" > 'd'"), "a&lt;b &amp; &quot;c&quot; &gt; &#39;d&#39;");
  EXPECT_EQ(html::escape("Nm \u00b7 \u2212"), "Nm \u00b7 \u2212");
}

TEST(Html, Base64OfRfc4648Section10) {
  EXPECT_EQ(html::base64(""), "");
  EXPECT_EQ(html::base64("f"), "Zg==");
  EXPECT_EQ(html::base64("fo"), "Zm8=");
  EXPECT_EQ(html::base64("foo"), "Zm9v");
  EXPECT_EQ(html::base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(html::base64("\xff\xfe\x00"), "//4=");  // the literal ends at its NUL
}

TEST(Report, HeadlineNamesTorqueSideTimeCauseAndShare) {
  EXPECT_EQ(headlineOf(example()),
            "Peak added hip torque: 1.83 Nm, right side, at 1.24 s, during hip flexion (swing); 3.3 % of the natural "
            "hip moment.");
  ReportInput bare;
  bare.joints = {{"elbow", "", 0.5, 2.0, "", 0.1, {}, {}, {}}};
  EXPECT_EQ(headlineOf(bare), "Peak added elbow torque: 0.500 Nm, at 2.00 s.");
  bare.joints[0].peak_Nm = NAN;
  EXPECT_EQ(headlineOf(bare), "No joint torque of this run is a finite number.");
  EXPECT_EQ(headlineOf({}), "This run measured no joint torques.");
}

/// A torque of a garment that fell off is no headline of its own.
TEST(Report, WhatSpoilsTheNumbersComesBeforeThem) {
  ReportInput in = example();
  in.audit.push_back({"Slipping", 740, 50, "mm", "", "the garment slips down the body by 740 mm", true});
  EXPECT_TRUE(headlineOf(in).starts_with(
      "Not to be relied on, as the garment slips down the body by 740 mm: peak added hip torque: 1.83 Nm"))
      << headlineOf(in);
  in.audit.back().value = 40;
  EXPECT_TRUE(headlineOf(in).starts_with("Peak added hip torque"));
}

TEST(Report, StretchBeyondTheFabricsRangeIsSaidAtTheTop) {
  ReportInput in = example();
  in.stretch = {{0.15, 0.21, 0.73, true, "", "weft"}};
  EXPECT_FALSE(trustOf(in).whole());
  EXPECT_TRUE(trustOf(in).reliable());
  EXPECT_NE(formatReport(in).find("stretches by up to 73 % along its weft"), std::string::npos);
  in.stretch[0].largest = 0.1;
  EXPECT_EQ(formatReport(in).find("stretches by"), std::string::npos);
  in.joints[1].natural_Nm = 55.4;
  EXPECT_NE(headlineOf(in).find("3.3 % of the natural hip moment of 55.4 Nm"), std::string::npos) << headlineOf(in);
}

TEST(Report, HighestJointIsTheLargestMagnitudeAndNeverNan) {
  ReportInput in = example();
  EXPECT_EQ(highestJoint(in), &in.joints[1]);
  in.joints[1].peak_Nm = NAN;
  EXPECT_EQ(highestJoint(in), &in.joints[2]);
  EXPECT_TRUE(has(seen(formatReport(in)), "The peak is not a number."));
}

TEST(Report, ShowsTheNumbersThatItIsGiven) {
  const std::string page = seen(formatReport(example()));
  for (const char* number :
       {"1.83 Nm, at the hip", "3.3 % of the natural hip moment in walking at natural speed", "4.2 %",
        "root mean square 0.612 Nm", "0.0210 Nm peak", "at 0.93 s", "5.31 N", "3.90 N", "10.2", "4.92", "3.1e\u221213",
        "1.0e\u22129", "412018", "9f3c22ab", "No self-contact yet.", "first stride", "not known"})
    EXPECT_TRUE(has(page, number)) << number;
}

TEST(Report, KeepsNumberAndUnitOnOneLine) {
  const std::string page = formatReport(example());
  for (const char* quantity : {"1.83 Nm", "1.24 s", "3.3 %", "0.605 Nm"})
    EXPECT_TRUE(has(page, "<span class=\"q\">" + std::string(quantity) + "</span>")) << quantity;
}

TEST(Report, EscapesEveryTextOfTheUser) {
  ReportInput in = example();
  const std::string evil = "<script>x</script>\"&'";
  in.title = in.description = in.task = evil;
  in.warnings = {evil};
  for (auto& j : in.joints) j.joint = j.cause = j.side = evil;
  in.torques[0].title = in.torques[0].caption = in.torques[0].marks[0].label = evil;
  for (auto& s : in.torques[0].series) s.name = s.unit = evil;
  in.contact_charts = {{evil, evil, evil, {{evil, 1}}}};
  in.contact_tables = {{evil, evil, {evil, evil}, {{evil, evil}}}};
  in.pictures = {{onePixelPng(), evil, evil}, {std::filesystem::path(evil), evil, evil}};
  in.audit = {{evil, 0, 1, evil, evil}};
  in.assumptions = {evil};
  in.facts = {{evil, evil}};
  const std::string page = formatReport(in);
  EXPECT_EQ(count(page, "<script>"), 1u);  // the page's own
  EXPECT_FALSE(has(page, "x</script>"));
  EXPECT_FALSE(has(page, "\"&'"));
}

TEST(Report, AsksTheNetworkForNothing) {
  const std::string page = formatReport(example());
  EXPECT_FALSE(has(page, "http://"));
  EXPECT_FALSE(has(page, "https://"));
  EXPECT_FALSE(has(page, "src=\"//"));
  EXPECT_FALSE(has(page, "@import"));
  EXPECT_FALSE(has(page, "url("));
  EXPECT_TRUE(has(page, "default-src 'none'"));
  for (const auto& target : quoted(page, "src=\"")) EXPECT_EQ(target.rfind("data:", 0), 0u) << target;
  for (const auto& target : quoted(page, "href=\"")) EXPECT_EQ(target.rfind("#", 0), 0u) << target;
  EXPECT_EQ(quoted(page, "src=\"").size(), 1u);
}

TEST(Report, IsReadableByAll) {
  const std::string page = formatReport(example());
  EXPECT_EQ(count(page, "<img "), count(page, "<img alt=\""));
  EXPECT_TRUE(has(page, "alt=\"A figure in &lt;shorts&gt;\""));
  EXPECT_EQ(count(page, "<svg "), count(page, "aria-label=\"") - count(page, "<section class=\"headline"));
  EXPECT_EQ(count(page, "<table>"), count(page, "<thead>"));
  EXPECT_EQ(count(page, "<table>"), count(page, "<caption>"));
  EXPECT_TRUE(has(page, "<html lang=\"en\">"));
  for (const char* tag : {"section", "figure", "table", "div", "p", "svg", "main", "tr", "td"})
    EXPECT_EQ(count(page, std::string("<") + tag + " ") + count(page, std::string("<") + tag + ">"),
              count(page, std::string("</") + tag + ">"))
        << tag;
}

TEST(Report, NotesFollowTheHeadlineAndFactsAreFolded) {
  ReportInput in = example();
  in.notes = {"Cells are coarse."};
  in.found = {"scan a.obj: waist 80 cm", "a lonely fact", "scan a.obj: hip <98> cm"};
  const std::string page = formatReport(in);
  EXPECT_FALSE(has(page, "class=\"alarm\""));
  EXPECT_TRUE(has(page, "<li>Cells are coarse.</li>"));
  EXPECT_LT(page.find("Peak added torque"), page.find("Cells are coarse."));
  EXPECT_LT(page.find("Cells are coarse."), page.find("<details"));
  EXPECT_TRUE(has(page, "3 notes)</summary>"));
  EXPECT_EQ(count(page, "<p class=\"about\">Scan a.obj</p>"), 1u);
  for (const char* item : {"<li>waist 80 cm</li>", "<li>hip &lt;98&gt; cm</li>", "<li>a lonely fact</li>"})
    EXPECT_EQ(count(page, item), 1u) << item;
  EXPECT_LT(page.find("hip &lt;98&gt;"), page.find("a lonely fact"));
  in.notes.resize(4, "More.");  // many fold too
  EXPECT_TRUE(has(formatReport(in), "<summary>4 notes that bear on this result</summary>"));
}

TEST(Report, WhatWasNotPlayedIsNotGreen) {
  ReportInput in = example();
  in.audit.clear();
  in.stretch.clear();
  EXPECT_TRUE(trustOf(in).whole());
  in.played = false;
  EXPECT_FALSE(trustOf(in).whole());
  EXPECT_TRUE(trustOf(in).reliable());
}

TEST(Report, FailedCheckAndWarningStandAtTheTop) {
  ReportInput in = example();
  EXPECT_FALSE(has(formatReport(in), "class=\"alarm\""));
  in.warnings = {"The run stopped at 1.2 s."};
  in.audit.push_back({"energy", NAN, 0.01, "", ""});
  in.audit.push_back({"sign", -2, 1, "", "", "it is <lost>"});
  const std::string page = formatReport(in);
  EXPECT_TRUE(has(seen(page), "2 of 3 checks of this run fail: it is &lt;lost&gt;. Do not rely"));
  EXPECT_LT(page.find("The run stopped at 1.2 s."), page.find("Peak added torque"));
  EXPECT_EQ(count(page, "\u2717 fails"), 2u);
  EXPECT_EQ(count(page, "\u2713 holds"), 1u);
}

TEST(Report, MissingPartsSaySo) {
  const std::string page = seen(formatReport({}));
  for (const char* message : {"This run has no joint torques.", "This run was not audited.",
                              "The assumptions of this run were not recorded."})
    EXPECT_TRUE(has(page, message)) << message;
  ReportInput in;
  in.pictures = {{std::filesystem::path("/nonexistent.png"), "A", ""}, {std::string("GIF89a"), "B", ""}};
  in.torques = {Plot{}};
  in.contact_charts = {BarChart{}};
  const std::string other = seen(formatReport(in));
  EXPECT_TRUE(has(other, "The picture /nonexistent.png cannot be read."));
  EXPECT_TRUE(has(other, "A picture is not a PNG."));
  EXPECT_EQ(count(other, "There is nothing to plot."), 2u);
}

TEST(Report, MoreJointsThanCardsGetATable) {
  ReportInput in = example();
  for (int i = 0; i < 5; ++i) in.joints.push_back({"ankle", "left", 0.001 * i, 0.1, "", 0, {}, {}, {}});
  const std::string page = formatReport(in);
  EXPECT_EQ(count(page, "<div class=\"card "), 6u);
  EXPECT_TRUE(has(page, "All joints"));
}

TEST(Chart, HasOnePointPerValue) {
  Plot plot{"T", "", {wave("left", 57, Tone::left)}, {}, true};
  const std::string svg = lineChart(plot);
  const std::string path = quoted(svg, " d=\"").at(0);
  EXPECT_EQ(count(path, "M"), 1u);
  EXPECT_EQ(count(path, "L"), 56u);
}

TEST(Chart, PointsStandWhereTheAxesSay) {
  // Linear between the ends of the frame that the figure states.
  Plot plot{"T", "", {{"a", "Nm", {0, 1, 4}, {0, 2, -1}, Tone::third}}, {}, true};
  const std::string svg = lineChart(plot);
  std::istringstream frame(quoted(svg, "data-frame=\"").at(0));
  double x0, x1, y0, y1, t0, t1, v0, v1;
  frame >> x0 >> x1 >> y0 >> y1 >> t0 >> t1 >> v0 >> v1;
  const std::string path = quoted(svg, " d=\"").at(0);
  std::istringstream second(path.substr(path.find('L') + 1));
  double x, y;
  second >> x >> y;
  EXPECT_NEAR(t0 + (x - x0) / (x1 - x0) * (t1 - t0), 1, 0.01);
  EXPECT_NEAR(v0 + (y - y0) / (y1 - y0) * (v1 - v0), 2, 0.01);
  EXPECT_TRUE(has(svg, "peak 2.00 Nm at 1.00 s"));
}

/// What comes before the window that counts is shaded, and a higher point there is not the peak.
TEST(Chart, TheStartThatIsNotCountedIsShadedAndSaid) {
  Plot plot{"T", "Sign.", {{"a", "Nm", {0, 1, 2, 3, 4}, {0, 9, 1, -2, 0}, Tone::third}}, {}, true};
  EXPECT_TRUE(has(lineChart(plot), "peak 9.00 Nm at 1.00 s"));
  EXPECT_FALSE(has(lineChart(plot), "uncounted"));
  plot.mark_from_s = 2;
  plot.peak_note = "against the motion";
  const std::string svg = lineChart(plot);
  EXPECT_TRUE(has(svg, "peak \u22122.00 Nm at 3.00 s, against the motion")) << svg;
  std::istringstream frame(quoted(svg, "data-frame=\"").at(0));
  double x0, x1;
  frame >> x0 >> x1;
  const auto shaded = svg.find("<rect class=\"uncounted\"");
  ASSERT_NE(shaded, std::string::npos);
  EXPECT_NEAR(std::stod(quoted(svg.substr(shaded), " width=\"").at(0)), 0.5 * (x1 - x0), 0.1);
  // Far from the label of a peak below 0.
  const auto yOf = [&](const std::string& label) {
    return std::stod(quoted(svg.substr(svg.rfind("<text", svg.find(label))), " y=\"").at(0));
  };
  EXPECT_LT(yOf(">not counted<"), yOf(">peak \u2212") - 100);
  EXPECT_TRUE(
      has(svg, "Sign. Counted is what comes from 2.00 s on; the shaded start before it is shown but not judged."));
}

/// A name begins where its line has ended, and what has no room beside the others has a row of its own above them.
TEST(Chart, NamesStandClearOfTheirLines) {
  Plot plot{"hip", "", {wave("thickness x 0.75", 20, Tone::left), wave("thickness x 0.5", 20, Tone::right)}, {}};
  plot.series.push_back(wave("thickness x 0.25", 20, Tone::third));
  const std::string svg = lineChart(plot);
  for (const Series& s : plot.series) {
    const auto name = svg.find(">" + s.name + "</text>"), text = svg.rfind("<text x=\"", name),
               line = svg.rfind(" x2=\"", text);
    ASSERT_NE(name, std::string::npos);
    EXPECT_TRUE(has(svg.substr(text, name - text), "text-anchor=\"start\""));
    EXPECT_GE(std::stod(svg.substr(text + 9)), std::stod(svg.substr(line + 5)) + 4);
    EXPECT_LE(std::stod(svg.substr(text + 9)) + 8.2 * static_cast<double>(s.name.size()), 500);
  }
  EXPECT_TRUE(has(svg, "viewBox=\"0 -19 500 319\"")) << svg.substr(0, 200);
}

/// The peak of the series that is named, though another is higher; of all where none has that name.
TEST(Chart, MarksThePeakOfTheSeriesNamed) {
  Plot plot{"hip", "", {{"low", "Nm", {0, 1}, {1, 2}}, {"high", "Nm", {0, 1}, {5, 9}}}, {}};
  EXPECT_TRUE(has(lineChart(plot), "peak 9.00 Nm at 1.00 s"));
  plot.mark_of = "low";
  EXPECT_TRUE(has(lineChart(plot), "peak 2.00 Nm at 1.00 s"));
  plot.mark_of = "another";
  EXPECT_TRUE(has(lineChart(plot), "peak 9.00 Nm at 1.00 s"));
}

TEST(Chart, NanInterruptsTheLineAndIsCounted) {
  Plot plot{"T", "", {wave("right", 30, Tone::right)}, {}, true};
  plot.series[0].values[10] = NAN;
  plot.series[0].values[11] = INFINITY;
  const std::string svg = lineChart(plot);
  const std::string path = quoted(svg, " d=\"").at(0);
  EXPECT_EQ(count(path, "M"), 2u);
  EXPECT_EQ(count(path, "L"), 26u);
  EXPECT_FALSE(has(path, "n"));
  EXPECT_TRUE(has(svg, "2 of the 30 values of right are not finite numbers and are left out."));
  plot.series[0].gaps = true;
  EXPECT_FALSE(has(lineChart(plot), "not finite"));
  EXPECT_EQ(quoted(lineChart(plot), " d=\"").at(0), path);
}

TEST(Chart, EmptyAndUnusableSeriesSaySo) {
  Plot plot{"T", "", {{"left", "Nm", {}, {}, Tone::left}, {"right", "Nm", {0, 1}, {NAN, NAN}, Tone::right}}, {}, true};
  const std::string svg = lineChart(plot);
  EXPECT_TRUE(has(svg, "No values of left were recorded."));
  EXPECT_TRUE(has(svg, "None of the 2 values of right is a finite number."));
  EXPECT_FALSE(has(svg, "<svg"));
  plot.series[0] = {"one", "Nm", {1}, {0}, Tone::left};
  EXPECT_TRUE(has(lineChart(plot), "<svg"));  // a single point and a constant have a frame too
  plot.series[0].time_s.push_back(2);
  EXPECT_THROW(lineChart(plot), InputError);
}

TEST(Chart, BarsAreAsLongAsTheirValues) {
  const std::string svg = barChart({"F", "N", "", {{"a", 4}, {"b", 1}, {"c", NAN}, {"d", 0}}});
  std::vector<double> w;
  for (const auto& width : quoted(svg, " width=\"")) w.push_back(std::stod(width));
  ASSERT_EQ(w.size(), 4u);
  EXPECT_NEAR(w[0] / w[1], 4, 0.01);
  EXPECT_EQ(w[2], 0);
  EXPECT_TRUE(has(svg, "not a number N"));
}

TEST(Report, IsWrittenWholeOrNotAtAll) {
  const auto file = std::filesystem::temp_directory_path() / "gambeson_report_test.html";
  writeReport(example(), file);
  std::ifstream in(file);
  std::ostringstream all;
  all << in.rdbuf();
  EXPECT_EQ(all.str(), formatReport(example()));
  std::filesystem::remove(file);
  EXPECT_THROW(writeReport(example(), "/nonexistent/report.html"), RunError);
}

}  // namespace
}  // namespace gambeson
