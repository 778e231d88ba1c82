/// The command gambeson verify: runs that fail and references that are malformed say so; what it writes.

#include "cases/verify/verify.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "cases/command/cli.hpp"
#include "core/error.hpp"
#include "core/io/own_file.hpp"
#include "unit/cases/example.hpp"

namespace gambeson::verify {
namespace {

const std::string reference_text = R"json({
  "id": "tip",
  "title": "A tip",
  "source": "a book",
  "doc": "Nothing to say.",
  "quick": true,
  "case": {"static": {"steps": 4}},
  "table": {"columns": ["P", "W"], "rows": [[0.5, 1.0], [1, 2.5]]},
  "runs": [{"name": "fine", "set": {"static.steps": 8}}, {"name": "coarse"}],
  "checks": [
    {"kind": "value", "quantity": "tip", "unit": "m", "of": {"run": "fine", "summary": "points.tip.w[1]"}, "reference": 2.5, "relative": 0.01},
    {"kind": "table", "quantity": "path", "run": "fine", "also": ["coarse"], "x": {"column": "factor", "reference": "P"},
     "y": {"column": "tip.w", "reference": "W"}, "bound": 1e-6}
  ]
})json";

/// In place of the command: leaves the same numbers whatever the case, fails where the case says so, keeps its
/// arguments, the threads that it was told and the case beside its results.
const std::string fake = R"sh(#!/bin/sh
case_file=$2; out=$4
cp "$case_file" "$out/case.json"
echo "$@" > "$out/arguments"; echo "$OMP_NUM_THREADS" > "$out/threads"
if grep -q '"steps": 666' "$case_file"; then echo "step 3: the residual grows"; exit 1; fi
if grep -q '"steps": 667' "$case_file"; then kill -9 $$; fi
if grep -q '"steps": 668' "$case_file"; then exec tail -f /dev/null; fi
printf '{"points": {"tip.w": [1.0, 2.5]}}' > "$out/summary.json"
printf 'factor,tip.w\n0,0\n0.5,1\n1,2.5\n' > "$out/path.csv"
)sh";

class VerifyCommand : public testing::Test {
 protected:
  Folder folder;
  Options options;
  std::ostringstream out;

  void SetUp() override {
    options.binary = folder.write("fake", fake).string();
    std::filesystem::permissions(options.binary, std::filesystem::perms::owner_all);
    options.dir = folder.path() / "references";
    options.out = folder.path() / "results";
    options.jobs = 2;
    std::filesystem::create_directories(options.dir);
  }
  void write(const std::string& name, const std::string& text) { folder.write("references/" + name + ".json", text); }
  /// Writes a file that the fake left again, as the program does.
  void asTheProgram(const std::string& name) const {
    const std::string text = content(name);
    std::filesystem::remove(options.out / name);
    writeOwnFile(options.out / name, text);
  }
  nlohmann::json written() const {
    std::ifstream stream(options.out / "verify.json");
    return nlohmann::json::parse(stream);
  }
  std::string content(const std::string& file) const {
    std::ifstream stream(options.out / file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
};

TEST_F(VerifyCommand, PassesAndWritesNumbersAndPage) {
  write("tip", reference_text);
  EXPECT_EQ(runVerify(options, out), 0) << out.str();
  const auto all = written();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].at("id"), "tip");
  EXPECT_EQ(all[0].at("source"), "a book");
  EXPECT_EQ(all[0].at("quantity"), "tip");
  EXPECT_EQ(all[0].at("unit"), "m");
  EXPECT_DOUBLE_EQ(all[0].at("measured").get<double>(), 2.5);
  EXPECT_DOUBLE_EQ(all[0].at("reference").get<double>(), 2.5);
  EXPECT_DOUBLE_EQ(all[0].at("tolerance").get<double>(), 0.025);
  EXPECT_TRUE(all[0].at("passed").get<bool>() && all[0].at("gated").get<bool>());
  EXPECT_GE(all[0].at("seconds").get<double>(), 0);
  EXPECT_FALSE(all[2].at("gated").get<bool>());
  const std::string page = content("verify.html");
  EXPECT_NE(page.find("A tip"), std::string::npos);
  EXPECT_NE(page.find("<svg"), std::string::npos);
  EXPECT_EQ(page.find("http"), std::string::npos);  // asks the network for nothing
  EXPECT_NE(out.str().find("1 of 1 references passed"), std::string::npos);
}

TEST_F(VerifyCommand, RunsGetTheirCaseValuesAndOneThread) {
  write("tip", reference_text);
  ASSERT_EQ(runVerify(options, out), 0);
  EXPECT_EQ(nlohmann::json::parse(content("tip/fine/case.json")).at("static").at("steps"), 8);
  EXPECT_EQ(nlohmann::json::parse(content("tip/coarse/case.json")).at("static").at("steps"), 4);
  EXPECT_EQ(content("tip/fine/threads"), "1\n");
  EXPECT_NE(content("tip/fine/arguments").find("--threads 1"), std::string::npos);
}

TEST_F(VerifyCommand, ACaseFileIsChangedOnTheCommandLine) {
  write("tip", replaced(reference_text, R"("case": {"static": {"steps": 4}})", R"("case": "../beam.case")"));
  folder.write("beam.case", R"({"static": {"steps": 4}})");
  ASSERT_EQ(runVerify(options, out), 0);
  EXPECT_NE(content("tip/fine/arguments").find("beam.case"), std::string::npos);
  EXPECT_NE(content("tip/fine/arguments").find("--set static.steps=8"), std::string::npos);
}

TEST_F(VerifyCommand, AWrongNumberFails) {
  write("tip", replaced(reference_text, "\"reference\": 2.5", "\"reference\": 2.6"));
  EXPECT_EQ(runVerify(options, out), 1);
  EXPECT_FALSE(written()[0].at("passed").get<bool>());
  EXPECT_NE(out.str().find("FAILED  tip"), std::string::npos);
  EXPECT_NE(content("verify.html").find("FAILED"), std::string::npos);
  std::filesystem::remove_all(options.out);
  // Reported, it does not count.
  write("tip", replaced(reference_text, "\"reference\": 2.5", R"("gated": false, "why": "a slip", "reference": 2.6)"));
  EXPECT_EQ(runVerify(options, out), 0);
  EXPECT_FALSE(written()[0].at("passed").get<bool>());
  EXPECT_EQ(written()[0].at("why"), "a slip");
  EXPECT_NE(content("verify.html").find("Reported only: a slip"), std::string::npos);
}

/// A reference whose checks are all reported cannot fail: neither the console nor the page calls that passed.
TEST_F(VerifyCommand, WhatGatesNothingSaysSo) {
  const std::string first = replaced(reference_text, "\"reference\": 2.5", R"("gated": false, "reference": 2.6)"),
                    all = replaced(replaced(first, "\"kind\": \"table\",", R"("kind": "table", "gated": false,)"),
                                   R"("quick": true)", R"("quick": true, "why": "it only looks")");
  write("tip", all);
  write("top", replaced(reference_text, R"("id": "tip")", R"("id": "top")"));
  EXPECT_EQ(runVerify(options, out), 0);
  EXPECT_NE(out.str().find("reported  tip  gates nothing: 1 of 2 numbers are off"), std::string::npos) << out.str();
  EXPECT_EQ(out.str().find("passed  tip"), std::string::npos);
  EXPECT_NE(out.str().find("1 of 1 references passed (tip gate nothing"), std::string::npos) << out.str();
  const std::string page = content("verify.html");
  const std::size_t banner = page.find("These references gate nothing"), overview = page.find("<table");
  ASSERT_NE(banner, std::string::npos);
  EXPECT_LT(banner, overview);
  EXPECT_NE(page.find("none is gated"), std::string::npos);
  EXPECT_NE(page.find("it only looks"), std::string::npos);
  // With one check gated there is no such banner. (What the fake leaves is not the program's: it goes first.)
  std::filesystem::remove_all(options.out);
  write("tip", replaced(first, "\"gated\": false", R"("gated": false, "why": "it only looks")"));
  EXPECT_EQ(runVerify(options, out), 0);
  EXPECT_EQ(content("verify.html").find("These references gate nothing"), std::string::npos);
  // A run that fails is a failure even so.
  std::filesystem::remove_all(options.out);
  write("tip", replaced(all, "\"static.steps\": 8", "\"static.steps\": 666"));
  EXPECT_EQ(runVerify(options, out), 1);
}

TEST_F(VerifyCommand, WhatIsReportedOnlySaysWhy) {
  const auto messageOf = [&](const std::string& text) {
    write("tip", text);
    try {
      readReference(options.dir / "tip.json");
    } catch (const InputError& e) {
      return e.where().key + ": " + e.reason();
    }
    return std::string();
  };
  const std::string silent = replaced(reference_text, "\"unit\": \"m\"", R"("gated": false)");
  EXPECT_NE(messageOf(silent).find("checks[0]: is reported only and says nowhere why"), std::string::npos)
      << messageOf(silent);
  EXPECT_EQ(messageOf(replaced(silent, "\"gated\": false", R"("gated": false, "why": "here")")), "");
  EXPECT_EQ(messageOf(replaced(silent, R"("quick": true)", R"("why": "there")")), "");
  for (const char* claim : {R"("item": "A", "priority": "should")", R"("item": "A", "priority": "nice")"})
    EXPECT_NE(messageOf(replaced(reference_text, "\"unit\": \"m\"", claim)), "") << claim;
  EXPECT_NE(messageOf(replaced(reference_text, "\"unit\": \"m\"", R"("why": "gated all the same")")), "");
}

TEST_F(VerifyCommand, ARunThatFailsSaysWhy) {
  const std::array<std::pair<const char*, const char*>, 2> ways{
      {{"666", "step 3: the residual grows"}, {"667", "ended by signal 9"}}};
  for (const auto& [steps, why] : ways) {
    write("tip", replaced(reference_text, "\"static.steps\": 8", std::string("\"static.steps\": ") + steps));
    std::filesystem::remove_all(options.out);
    EXPECT_EQ(runVerify(options, out), 1);
    const auto all = written();
    EXPECT_EQ(all[0].at("quantity"), "run fine");
    EXPECT_NE(all[0].at("note").get<std::string>().find(why), std::string::npos) << all[0];
    EXPECT_TRUE(all[1].at("measured").is_null());
    EXPECT_FALSE(all[1].at("passed").get<bool>());
  }
}

TEST_F(VerifyCommand, ARunThatTakesTooLongIsStopped) {
  write("tip", replaced(reference_text, "\"static.steps\": 8}", "\"static.steps\": 668}, \"time_limit\": 0.2"));
  EXPECT_EQ(runVerify(options, out), 1);
  EXPECT_NE(written()[0].at("note").get<std::string>().find("its limit"), std::string::npos);
}

TEST_F(VerifyCommand, AMissingBinaryFails) {
  write("tip", reference_text);
  options.binary = "/no/such/program";
  EXPECT_EQ(runVerify(options, out), 1);
  EXPECT_NE(written()[0].at("note").get<std::string>().find("/no/such/program"), std::string::npos);
}

TEST_F(VerifyCommand, OldResultsAreNotTakenForNewOnes) {
  write("tip", reference_text);
  ASSERT_EQ(runVerify(options, out), 0);
  // What stands there was not written by the program: it is refused, and stays.
  EXPECT_THROW(runVerify(options, out), InputError);
  EXPECT_TRUE(std::filesystem::exists(options.out / "tip/fine/summary.json"));
  for (const char* run : {"fine", "coarse"})
    for (const char* file : {"case.json", "summary.json", "path.csv"})
      asTheProgram(std::string("tip/") + run + "/" + file);
  write("tip", replaced(reference_text, "\"static.steps\": 8", "\"static.steps\": 666"));
  ASSERT_EQ(runVerify(options, out), 1);
  EXPECT_FALSE(std::filesystem::exists(options.out / "tip/fine/summary.json"));
}

TEST_F(VerifyCommand, FiltersAndTheQuickHalf) {
  write("tip", reference_text);
  write("slow", replaced(replaced(reference_text, "\"tip\",\n  \"title\"", "\"slow\",\n  \"title\""), "true", "false"));
  EXPECT_EQ(chooseReferences(options).size(), 2u);
  options.quick = true;
  ASSERT_EQ(chooseReferences(options).size(), 1u);
  EXPECT_EQ(chooseReferences(options)[0].id, "tip");
  options.filters = {"s*"};
  EXPECT_THROW(chooseReferences(options), InputError);
  options.quick = false;
  EXPECT_EQ(chooseReferences(options)[0].id, "slow");
  options.filters = {"x*", "t?p"};
  EXPECT_EQ(chooseReferences(options)[0].id, "tip");
}

TEST_F(VerifyCommand, MalformedReferencesAreBadInput) {
  struct Wrong {
    std::string from, to, says;
  };
  const std::vector<Wrong> all{
      {"\"quick\"", "\"quik\"", ":6: quik: unknown key"},
      {"\"tip\",\n  \"title\"", "\"tap\",\n  \"title\"", ":2: id: \"tap\" is not the name of the file"},
      {"\"a book\"", "\"\"", "source"},
      {"\"quick\": true", "\"quick\": 1", "expected true or false"},
      {"\"name\": \"coarse\"", "\"name\": \"fine\"", "is the name of two runs"},
      {"\"name\": \"coarse\"", "\"name\": \"../coarse\"", "no slashes"},
      {"\"reference\": 2.5, \"relative\": 0.01", "\"reference\": 2.5", "needs a tolerance"},
      {"\"relative\": 0.01", "\"relative\": 0.01, \"absolute\": 1", "one of relative and absolute"},
      {"\"relative\": 0.01", "\"relative\": 0", "relative"},
      {"\"relative\": 0.01", "\"relative\": -0.01", "relative"},
      {"\"relative\": 0.01", "\"relative\": 0.01, \"bound\": 1", "is not for a check of kind value"},
      {"\"reference\": 2.5, \"relative\": 0.01", "\"note\": \"no goal\"", "needs either reference"},
      {"\"reference\": 2.5, \"relative\": 0.01", "\"at_most\": 1, \"at_least\": 1", "exclude each other"},
      {"\"kind\": \"value\"", "\"kind\": \"values\"", "kind"},
      {"\"kind\": \"table\"", "\"kind\": \"rate\"", "a check of kind rate needs of"},
      {"\"run\": \"fine\", \"summary\"", "\"run\": \"fin\", \"summary\"", "there is no run \"fin\""},
      {"\"run\": \"fine\", \"summary\"", "\"summary\"", "needs run"},
      {"\"summary\": \"points.tip.w[1]\"", "\"scale\": 1", "one of summary and column"},
      {"[\"coarse\"]", "[\"coars\"]", "there is no run \"coars\""},
      {"\"reference\": \"W\"", "\"reference\": \"V\"", "there is no column \"V\""},
      {", \"bound\": 1e-6", "", "needs bound"},
      {"[1, 2.5]", "[1]", ":8: table.rows[1]: 1 numbers for 2 columns"},
      {"[1, 2.5]", "[1, null]", "rows[1][1]"},
      {"\"case\": {\"static\": {\"steps\": 4}},", "", "has no case"},
      {"\"case\": {\"static\": {\"steps\": 4}}", "\"case\": \"none.json\"", "there is no file"},
      {"\"set\": {\"static.steps\": 8}", "\"set\": 3", "expected an object"},
      {"\"doc\": \"Nothing to say.\",", "", "doc: is required"},
      {"\"run\": \"fine\", \"also\"", "\"table\": \"../../../etc/passwd\", \"run\": \"fine\", \"also\"",
       "without folders"},
      {"\"run\": \"fine\", \"also\"", "\"table\": \"/etc/passwd\", \"run\": \"fine\", \"also\"", "without folders"},
      {"\"summary\": \"points.tip.w[1]\"", "\"column\": \"a\", \"table\": \"../fine/path.csv\"", "without folders"},
  };
  for (const Wrong& w : all) {
    write("tip", replaced(reference_text, w.from, w.to));
    try {
      chooseReferences(options);
      ADD_FAILURE() << w.to << " is accepted";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(w.says), std::string::npos) << w.to << ": " << e.what();
      EXPECT_NE(std::string(e.what()).find("tip.json"), std::string::npos) << e.what();
    }
  }
}

TEST_F(VerifyCommand, ThePathOfAChangeMustFitTheCase) {
  write("tip", replaced(reference_text, "\"static.steps\": 8", "\"static[0]\": 8"));
  EXPECT_THROW(runVerify(options, out), InputError);
}

TEST_F(VerifyCommand, ExitStatusOfTheCommand) {
  const auto status = [&](std::vector<std::string> arguments) {
    std::vector<const char*> argv{"gambeson", "verify"};
    for (const std::string& a : arguments) argv.push_back(a.c_str());
    std::ostringstream err;
    return runCommand(static_cast<int>(argv.size()), argv.data(), out, err);
  };
  EXPECT_EQ(status({"--dir", "/no/such/folder"}), 2);
  EXPECT_EQ(status({"--dir", options.dir.string()}), 2);  // holds no references
  write("tip", reference_text);
  EXPECT_EQ(status({"--dir", options.dir.string(), "--filter", "nothing*"}), 2);
  EXPECT_EQ(status({"--dir", options.dir.string(), "--jobs", "-1"}), 2);
  EXPECT_EQ(status({"--fast"}), 2);
}

TEST(VerifyReferences, TheShippedOnesRead) {
  for (const auto& entry : std::filesystem::directory_iterator(GAMBESON_SOURCE_DIR "/tests/verify"))
    if (entry.path().extension() == ".json") {
      EXPECT_NO_THROW(readReference(entry.path())) << entry.path();
    }
}

}  // namespace
}  // namespace gambeson::verify
