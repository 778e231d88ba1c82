/// Lists of a work's examples: what they name is there, they leave nothing of the work out, and the page says of each
/// statement what stands beside it.

#include "cases/verify/examples.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "cases/kinds/any_case.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::verify {
namespace {

const std::filesystem::path references = GAMBESON_SOURCE_DIR "/tests/verify";

const std::string tip = R"json({
  "id": "tip", "title": "A tip", "source": "a book", "doc": "Nothing.",
  "case": {"static": {"steps": 4}},
  "runs": [{"name": "only"}],
  "checks": [
    {"kind": "value", "quantity": "height", "unit": "m", "of": {"run": "only", "summary": "height"}, "reference": 2, "relative": 0.01},
    {"kind": "value", "quantity": "width", "unit": "m", "of": {"run": "only", "summary": "width"}, "reference": 2, "relative": 0.01, "gated": false, "why": "a guess"},
    {"kind": "value", "quantity": "depth", "unit": "m", "of": {"run": "only", "summary": "width"}, "reference": 2, "relative": 0.01}
  ]
})json";

const std::string book = R"json({
  "id": "book", "title": "A book <by> example", "source": "a book",
  "examples": [
    {"section": "1.1", "title": "First", "figures": ["1.2"], "tables": ["1"], "cases": ["../tip.json"],
     "statements": [
       {"where": "table 1", "published": "2 m high", "reference": "tip", "quantity": "height"},
       {"where": "text", "published": "2 m wide", "reference": "tip", "quantity": "width"},
       {"where": "text", "published": "2 m deep", "reference": "tip", "quantity": "depth"},
       {"where": "fig. 1.2", "published": "its shape", "without": "a picture"}
     ]}
  ]
})json";

/// A reference that measured these.
Verified measured(double height, double width, double depth, const std::filesystem::path& file) {
  Verified v{readReference(file), {}, {}};
  const double numbers[] = {height, width, depth};
  for (std::size_t i = 0; i < v.reference.checks.size(); ++i) {
    const Check& c = v.reference.checks[i];
    Result r;
    r.id = "tip", r.quantity = c.quantity, r.unit = c.unit, r.measured = numbers[i], r.reference = 2,
    r.tolerance = 0.02;
    r.gated = c.gated, r.passed = std::abs(numbers[i] - 2) <= 0.02;
    v.judged.push_back({{r}, {}, {}});
  }
  return v;
}

class VerifyExamples : public testing::Test {
 protected:
  Folder folder;
  void SetUp() override {
    std::filesystem::create_directories(folder.path() / "examples");
    folder.write("tip.json", tip);
  }
  std::filesystem::path write(const std::string& text) { return folder.write("examples/book.json", text); }
  std::string why(const std::string& from, const std::string& to) {
    try {
      readWork(write(replaced(book, from, to)));
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }
};

TEST_F(VerifyExamples, PageSaysWhatStandsBesideEachStatement) {
  const Work work = readWork(write(book));
  const std::string page = formatWork(work, {measured(2.001, 2.5, 3.5, folder.path() / "tip.json")}, "gambeson verify");
  EXPECT_NE(page.find("A book &lt;by&gt; example"), std::string::npos);
  for (const char* said : {"2 m high", "2.001 m", "within 0.02 of 2 m", "its shape", "a picture", "fig. 1.2; table 1"})
    EXPECT_NE(page.find(said), std::string::npos) << said;
  // One holds, one is reported and off, one fails, one has no number: each in its own row.
  const auto row = [&](const std::string& what) {
    const std::size_t at = page.find(what), begin = page.rfind("<tr>", at);
    return page.substr(begin, page.find("</tr>", at) - begin);
  };
  EXPECT_NE(row("2 m high").find(">holds<"), std::string::npos);
  EXPECT_NE(row("2 m wide").find("reported, off"), std::string::npos);
  EXPECT_NE(row("2 m deep").find("FAILS"), std::string::npos);
  EXPECT_NE(row("its shape").find("no number"), std::string::npos);
  EXPECT_NE(page.find("1 FAILED"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);
}

TEST_F(VerifyExamples, ABoundIsSaidOnce) {
  Verified v = measured(1.9, 2, 2, folder.path() / "tip.json");
  Result& height = v.judged[0].results[0];
  height.tolerance.reset();
  height.note = "at most; of all frames";
  const std::string page = formatWork(readWork(write(book)), {v}, "gambeson verify");
  EXPECT_NE(page.find("(at most 2 m)"), std::string::npos);
  EXPECT_NE(page.find(">of all frames<"), std::string::npos);
}

TEST_F(VerifyExamples, ReferencesThatDidNotRunSayHow) {
  const Work work = readWork(write(book));
  const std::string page = formatWork(work, {}, "gambeson verify");
  EXPECT_NE(page.find("gambeson verify --filter tip"), std::string::npos);
  EXPECT_NE(page.find("3 not run"), std::string::npos);
  EXPECT_EQ(page.find("holds"), std::string::npos);
}

TEST_F(VerifyExamples, ANumberOfAnEarlierRunIsDated) {
  folder.write("tip.json", replaced(tip, "\"doc\"", "\"on_demand\": true, \"doc\""));
  const std::string dated = "\"quantity\": \"height\", \"recorded\": {\"value\": 1.99, \"date\": \"2026-11-22\"}";
  const Work work = readWork(write(replaced(book, "\"quantity\": \"height\"", dated)));
  const std::string before = formatWork(work, {}, "gambeson verify");
  EXPECT_NE(before.find("1.99"), std::string::npos);
  EXPECT_NE(before.find("on 2026-11-22, not run this time"), std::string::npos);
  const std::string after = formatWork(work, {measured(2.001, 2, 2, folder.path() / "tip.json")}, "gambeson verify");
  EXPECT_EQ(after.find("1.99"), std::string::npos);
}

TEST_F(VerifyExamples, WhatAListNamesMustBeThere) {
  EXPECT_NE(why("\"reference\": \"tip\", \"quantity\": \"height\"", "\"reference\": \"tap\", \"quantity\": \"height\"")
                .find(":6: examples[0].statements[0].reference: there is no reference"),
            std::string::npos);
  EXPECT_NE(why("\"height\"", "\"heights\"").find("tip has no checks of \"heights\""), std::string::npos);
  EXPECT_NE(why("../tip.json", "../tap.json").find("there is no file"), std::string::npos);
  EXPECT_NE(why("\"without\": \"a picture\"", "\"quantity\": \"height\"").find("needs one of reference and without"),
            std::string::npos);
  EXPECT_NE(
      why("\"without\": \"a picture\"", "\"without\": \"a picture\", \"quantity\": \"height\"").find("go together"),
      std::string::npos);
  EXPECT_NE(why("\"quantity\": \"height\"",
                "\"quantity\": \"height\", \"recorded\": {\"value\": 1, \"date\": \"2026-11-22\"}")
                .find("that run only by name"),
            std::string::npos);
  EXPECT_NE(why("\"id\": \"book\"", "\"id\": \"page\"").find("is not the name of the file"), std::string::npos);
  EXPECT_EQ(why("2 m high", "3 m high"), "accepted");
}

/// verify writes the page of a work that one of its references belongs to, and links it; else none.
TEST_F(VerifyExamples, TheCommandWritesThePage) {
  write(replaced(book, "\"cases\": [\"../tip.json\"],", ""));
  folder.write("other.json", replaced(tip, "\"id\": \"tip\"", "\"id\": \"other\""));
  Options o;
  o.binary =
      folder.write("fake", "#!/bin/sh\nprintf '{\"height\": 2.001, \"width\": 2.5}' > \"$4/summary.json\"\n").string();
  std::filesystem::permissions(o.binary, std::filesystem::perms::owner_all);
  o.dir = folder.path(), o.out = folder.path() / "results", o.jobs = 1;
  std::ostringstream out;
  const auto content = [&](const char* file) {
    std::ifstream stream(o.out / file);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  o.filters = {"other"};
  runVerify(o, out);
  EXPECT_FALSE(std::filesystem::exists(o.out / "book.html"));
  EXPECT_EQ(content("verify.html").find("book.html"), std::string::npos);
  o.filters = {"tip"};
  runVerify(o, out);
  EXPECT_NE(content("book.html").find("2.001 m"), std::string::npos);
  EXPECT_NE(content("verify.html").find("<a href=\"book.html\">A book &lt;by&gt; example</a>"), std::string::npos);
}

/// Zheng 2013: every numbered example of chapters 2 to 6, every figure and table that belongs to one.
TEST(VerifyExamplesShipped, ZhengIsWhole) {
  const Work work = readWork(references / "examples/zheng_2013.json");
  std::set<std::string> sections, figures, tables;
  for (const Example& e : work.examples) {
    sections.insert(e.section);
    for (const std::string& f : e.figures) EXPECT_TRUE(figures.insert(f).second) << f << " stands there twice";
    for (const std::string& t : e.tables) EXPECT_TRUE(tables.insert(t).second) << t << " stands there twice";
    // A table is compared number by number.
    const std::map<std::string, int> numbers{{"2.1", 1}, {"4.1", 3}, {"5.1", 12}, {"5.2", 12}, {"5.3", 12}};
    for (const std::string& t : e.tables) {
      int compared = 0;
      for (const Statement& s : e.statements)
        compared += s.where.find("table " + t) != std::string::npos && !s.reference.empty();
      EXPECT_GE(compared, numbers.at(t)) << "table " << t;
    }
  }
  EXPECT_EQ(sections,
            (std::set<std::string>{"2.5.1", "2.5.2", "2.5.3", "3.7.1", "3.7.2", "3.7.3", "3.7.4", "4.5.1", "4.5.2",
                                   "4.5.3", "5.6.1", "5.6.2", "5.6.3", "5.6.4", "6.2", "6.3", "6.4", "6.5", "6.6"}));
  EXPECT_EQ(tables, (std::set<std::string>{"2.1", "4.1", "5.1", "5.2", "5.3"}));
  std::set<std::string> all;
  const auto add = [&](int chapter, int first, int last) {
    for (int k = first; k <= last; ++k) all.insert(std::to_string(chapter) + "." + std::to_string(k));
  };
  add(2, 7, 12), add(3, 4, 12), add(4, 5, 11), add(5, 2, 8), add(6, 2, 23);
  EXPECT_EQ(figures, all);
}

/// The cases that lists name are cases, which the program reads.
TEST(VerifyExamplesShipped, CasesRead) {
  for (const Work& work : readWorks(references))
    for (const Example& e : work.examples)
      for (const auto& file : e.cases) EXPECT_NO_THROW(readAnyCase(file)) << file;
}

}  // namespace
}  // namespace gambeson::verify
