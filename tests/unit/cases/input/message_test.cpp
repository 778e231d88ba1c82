/// What the command prints, and what others' texts can do in scripts, tables and names.

#include "cases/input/message.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <sstream>

#include "cases/command/cli.hpp"
#include "cases/runs/shell_word.hpp"
#include "cases/study/numbers.hpp"
#include "cases/wear/results/results.hpp"
#include "core/error.hpp"
#include "core/io/csv.hpp"
#include "core/io/csv_text.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/trajectory.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

struct Said {
  int status = -1;
  std::string out, err;
};

Said command(const std::vector<std::string>& words) {
  std::vector<const char*> argv{"gambeson"};
  for (const std::string& w : words) argv.push_back(w.c_str());
  std::ostringstream out, err;
  const int status = runCommand(static_cast<int>(argv.size()), argv.data(), out, err);
  return {status, out.str(), err.str()};
}

TEST(Message, NotesAreMessagesToo) {
  testing::internal::CaptureStderr();
  sayNote("obstacle " + std::string(3000, 'b') + "\x1b[31m: 3 frames");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_LE(said.size(), 400u);
  EXPECT_TRUE(said.starts_with("note: obstacle bbb")) << said;
  EXPECT_TRUE(said.ends_with("\\x1b[31m: 3 frames\n")) << said;
}

TEST(Message, IsShortAndKeepsItsPlaceAndItsEnd) {
  EXPECT_EQ(messageText("a.json:3: key: 5 is out of range"), "a.json:3: key: 5 is out of range");
  const std::string text = messageText("a.json:3: key: " + std::string(5 << 20, 'k') + " is no number; allowed: > 0");
  EXPECT_LE(text.size(), 390u);
  EXPECT_TRUE(text.starts_with("a.json:3: key: kkk")) << text;
  EXPECT_TRUE(text.ends_with("is no number; allowed: > 0")) << text;
  // Characters of several bytes stay whole.
  std::string umlauts;
  for (int i = 0; i < 1000; ++i) umlauts += "\xc3\xa4";
  EXPECT_TRUE(unfitText(messageText(umlauts)).empty());
}

TEST(Message, OfWhatIsQuotedTheFirstCharactersAreShown) {
  const std::string text =
      messageText("walk.mot:12: the line '" + std::string(300, 'y') + "' is no row; the file's columns are 3");
  EXPECT_EQ(text, "walk.mot:12: the line '" + std::string(80, 'y') + "[...]' is no row; the file's columns are 3");
  const std::string two = messageText("'" + std::string(81, 'a') + "' and '" + std::string(80, 'b') + "'");
  EXPECT_EQ(two, "'" + std::string(80, 'a') + "[...]' and '" + std::string(80, 'b') + "'");
  // Apostrophes quote nothing, nor does one that nothing closes; what is quoted may hold apostrophes.
  const std::string apostrophes = "the body's name is " + std::string(90, 'c') + ", the garment's another's";
  EXPECT_EQ(messageText(apostrophes), apostrophes);
  EXPECT_EQ(messageText("'" + std::string(100, 'd')), "'" + std::string(100, 'd'));
  EXPECT_EQ(messageText("'it's " + std::string(100, 'e') + "'"), "'it's " + std::string(75, 'e') + "[...]'");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "x\xc3\xa4";
  EXPECT_TRUE(unfitText(messageText("'" + umlauts + "'")).empty());
}

TEST(Message, ATerminalIsToldNothing) {
  EXPECT_EQ(messageText("a\x1b[31mb\x07\x7f\r" + std::string(1, '\0')), "a\\x1b[31mb\\x07\\x7f\\x0d\\x00");
  EXPECT_EQ(messageText("\xc2\x9b"
                        "31m"),
            "\\xc2\\x9b31m");  // CSI as one character
  EXPECT_EQ(messageText("\x9b"
                        "31m \xff \xc3"),
            "\\x9b31m \\xff \\xc3");  // no UTF-8
  EXPECT_EQ(messageText("two\nlines \xc3\xa9"), "two\nlines \xc3\xa9");
}

TEST(Message, NamesHaveNoControlCharacters) {
  EXPECT_TRUE(unfitText("Gambeson \xe2\x82\xac 2'; $(x) \"y\"").empty());
  for (const std::string& bad :
       {std::string("a\0b", 3), std::string("a\nb"), std::string("a\x1b[0m"), std::string("\x7f"),
        std::string("\xc2\x85"), std::string("\xe9t\xe9"), std::string("a\tb")})
    EXPECT_FALSE(unfitText(bad).empty()) << messageText(bad);
  EXPECT_TRUE(unfitText("a\n\tb", true).empty());
  EXPECT_FALSE(unfitText("a\x1b", true).empty());
}

TEST(Message, TheCommandRefusesThemInPathsAndNames) {
  const Folder folder;
  const std::string file = folder.write("example.json", example).string();
  for (const std::string& out : {std::string("a\nb"), std::string("a\x1b]0;x\x07"), std::string("\xff")}) {
    const Said said = command({"run", file, "--out", (folder.path() / out).string()});
    EXPECT_EQ(said.status, 2) << said.err;
    EXPECT_NE(said.err.find("command line: --out: "), std::string::npos) << said.err;
    EXPECT_EQ(said.err.find('\x1b'), std::string::npos);
  }
  // In the file, as JSON writes them; a description may have several lines.
  for (const auto& [text, status] :
       std::array<std::pair<const char*, int>, 5>{{{R"("name": "a\u001b[31m")", 2},
                                                   {R"("name": "a\nb")", 2},
                                                   {R"("name": "a\u0000b")", 2},
                                                   {R"("name": "a\u009bb")", 2},
                                                   {R"("name": "a", "description": "b\nc")", 0}}}) {
    const std::string other = folder.write("other.json", replaced(example, R"("name": "example")", text)).string();
    const Said said = command({"check", other});
    EXPECT_EQ(said.status, status) << text << ": " << said.err;
    if (status == 2) {
      EXPECT_NE(said.err.find("other.json:2: name: "), std::string::npos) << said.err;
    }
    EXPECT_EQ(said.err.find('\x1b'), std::string::npos);
  }
  EXPECT_EQ(command({"check", file, "--set", "name=a\x1b[31m"}).status, 2);
}

TEST(Message, NoMessageIsAsLongAsItsCause) {
  const Folder folder;
  const std::string file = folder.write("example.json", example).string(), big(100000, 'x');
  folder.write("long.json", replaced(example, "\"thickness\"", "\"" + big + "\""));
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", (folder.path() / "long.json").string()},
        {"check", file, "--set", big + "=1"},
        {"check", file, "--set", "contact.friction=" + big},
        {"check", file, "--" + big},
        {"check", (folder.path() / big).string()},
        {big}}) {
    const Said said = command(words);
    EXPECT_EQ(said.status, 2);
    EXPECT_GT(said.err.size(), 10u);
    EXPECT_LE(said.err.size(), 400u) << said.err.substr(0, 200);
  }
}

TEST(Message, WhatCannotBeSaidIsNoSuccess) {
  const Folder folder;
  const std::string file = folder.write("example.json", example).string();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"check", file, "--full"}, {"check", "--schema"}, {"--help"}, {"--version"}}) {
    std::vector<const char*> argv{"gambeson"};
    for (const std::string& w : words) argv.push_back(w.c_str());
    std::ofstream full("/dev/full");
    std::ostringstream err;
    EXPECT_EQ(runCommand(static_cast<int>(argv.size()), argv.data(), full, err), 1);
    EXPECT_NE(err.str().find("standard output"), std::string::npos) << err.str();
  }
}

TEST(Message, NamesOfFilesSayWhatIsWritten) {
  const Folder folder;
  for (const std::vector<std::string>& words : {std::vector<std::string>{"render", "R", "-o", "x.avi"},
                                                {"render", "R", "-o", "x.mov"},
                                                {"render", "R", "-o", "x.jpg"},
                                                {"render", "R", "-o", "x"},
                                                {"export", "R", "--iges", "a.step"},
                                                {"report", "R", "-o", "a.pdf"}}) {
    const Said said = command(words);
    EXPECT_EQ(said.status, 2);
    EXPECT_NE(said.err.find(words.back() + "\" does not end as what is written; allowed: a name that ends in ."),
              std::string::npos)
        << said.err;
  }
}

/// Any file can be named as a trajectory: what stands in it is not for the one who reads the message.
TEST(Message, NoFileIsReadAloud) {
  const Folder folder;
  const std::string secret = "root:$6$salt$hash:19000:0:99999:7:::";
  const auto file = folder.write("walk.csv", secret + "\nmore\n");
  const Human human = makeManikin("male_p50");
  try {
    loadTrajectory(file, human);
    ADD_FAILURE() << "was taken";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find("root"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("walk.csv:1: column 1: the first column must be time_s"), std::string::npos)
        << e.what();
  }
}

/// Results that were damaged: the file and the key, not a library's own words.
TEST(Message, DamagedFilesAreNamedWithTheKey) {
  const Folder folder;
  folder.write(
      "run.json",
      R"({"version": "1", "threads": "two", "kernels": "", "wall_s": 1, "resumed": false, "windows": [], "phases": []})");
  try {
    readRunFacts(folder.path());
    ADD_FAILURE() << "was taken";
  } catch (const InputError& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("run.json"), std::string::npos) << what;
    EXPECT_NE(what.find("run.json: threads: must be a whole number, is string"), std::string::npos) << what;
    EXPECT_EQ(what.find("json.exception"), std::string::npos) << what;
  }
  for (const char* threads : {"4294967297", "-4294967297", "18446744073709551615"}) {
    folder.write("run.json", std::string(R"({"version": "1", "kernels": "", "wall_s": 1, "resumed": false, )") +
                                 R"("windows": [], "phases": [], "threads": )" + threads + "}");
    EXPECT_THROW(readRunFacts(folder.path()), InputError) << threads;
  }
  folder.write("summary.json", R"({"joints": [], "recorded_to_s": 1, "planned_to_s": null})");
  const study::RunNumbers run = study::readRun(folder.path());
  EXPECT_FALSE(run.good);
  for (const char* word : {"summary.json", "planned_to_s: must be a number, is null"})
    EXPECT_NE(run.why.find(word), std::string::npos) << run.why;
  EXPECT_EQ(run.why.find("json.exception"), std::string::npos) << run.why;
}

/// bash itself is asked what it makes of a word.
TEST(ShellWord, MeansItsTextAndNothingElse) {
  const Folder folder;
  for (const std::string text : {"plain", "o'brien", "x'$(touch F)'", "`touch F`", "a b", "$HOME", "\\", "a\"b", "!!",
                                 "-n", "a\nb", "*", "~", "", "#"}) {
    folder.write("script", "printf '%s|' " + shellWord(text) + " > said\n");
    ASSERT_EQ(std::system(("cd '" + folder.path().string() + "' && bash script").c_str()), 0) << text;
    std::ifstream said(folder.path() / "said", std::ios::binary);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(said), {}), text + "|");
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "F"));
  }
  EXPECT_EQ(shellWord("thickness_0.5__rough"), "thickness_0.5__rough");
}

TEST(Csv, NoLabelIsAFormula) {
  for (const std::string text : {"=1+1", "+cmd", "-a", "@sum", "=HYPERLINK(\"x\")", "-", "plain", "a,b", "'=", "'a"}) {
    const std::string cell = csvText(text);
    const char first = cell[0] == '"' ? cell[1] : cell[0];
    EXPECT_EQ(std::string("=+-@").find(first), std::string::npos) << cell;
    if (text != "'=") {
      EXPECT_EQ(csvCells(cell + ",x"), (std::vector<std::string>{text, "x"}));
    }
  }
  EXPECT_EQ(csvText("=a"), "'=a");
  EXPECT_EQ(csvText("-0.5"), "-0.5");  // a number is none
  EXPECT_EQ(csvText("+1e-3"), "+1e-3");
  EXPECT_EQ(formatCsv("segment", {"=a"}, {"@b"}, {{1}}), "segment,'@b\n'=a,1\n");
}

}  // namespace
}  // namespace gambeson
