/// The command, through the binary: exit status 0 done, 2 bad input, and messages that name the place.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <nlohmann/json.hpp>

#include "example.hpp"

namespace gambeson {
namespace {

struct Outcome {
  int status = -1;
  std::string out, err;
};

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

Outcome gambeson(const Folder& folder, const std::string& arguments) {
  const std::filesystem::path out = folder.path() / "stdout", err = folder.path() / "stderr";
  const std::string command = "cd '" + folder.path().string() + "' && '" GAMBESON_BINARY "' " + arguments + " >'" +
                              out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int raw = std::system(command.c_str());
  return {WIFEXITED(raw) ? WEXITSTATUS(raw) : -1, content(out), content(err)};
}

TEST(Command, HelpForNewcomers) {
  const Folder folder;
  for (const char* subcommand : {"", "run ", "check ", "render ", "report ", "verify "}) {
    const Outcome o = gambeson(folder, std::string(subcommand) + "--help");
    SCOPED_TRACE(subcommand);
    EXPECT_EQ(o.status, 0);
    EXPECT_NE(o.out.find("Usage"), std::string::npos);
    EXPECT_NE(o.out.find("  gambeson "), std::string::npos);  // an example
  }
  EXPECT_NE(gambeson(folder, "--version").out.find("gambeson 0."), std::string::npos);
}

TEST(Command, CheckAcceptsTheLibrary) {
  const Folder folder;
  for (const char* name : {"shorts_walk", "sleeve_flex", "inclined_plane", "sphere_drape", "flag", "cantilever",
                           "roll_up", "hinged_roof", "plate_modes", "flag_dynamic"}) {
    const Outcome o = gambeson(folder, "check '" GAMBESON_SOURCE_DIR "/cases/library/" + std::string(name) + ".json'");
    EXPECT_EQ(o.status, 0) << o.err;
    EXPECT_NE(o.out.find("valid"), std::string::npos);
  }
}

TEST(Command, CheckSaysWhatACaseIs) {
  const Folder folder;
  folder.write("example.json", example);
  const Outcome full =
      gambeson(folder, "check example.json --full --set fabric.thickness='0.4 mm' --set gravity=[0,0,-1.62]");
  ASSERT_EQ(full.status, 0) << full.err;
  const auto j = nlohmann::json::parse(full.out);
  EXPECT_DOUBLE_EQ(j.at("fabric").at("thickness").get<double>(), 0.4e-3);
  EXPECT_DOUBLE_EQ(j.at("gravity").at(2).get<double>(), -1.62);
  EXPECT_TRUE(nlohmann::json::accept(gambeson(folder, "check --schema").out));
  EXPECT_NE(gambeson(folder, "check --doc").out.find("| `thickness` | number | required |"), std::string::npos);
}

TEST(Command, BadInputExitsWithTwo) {
  const Folder folder;
  folder.write("example.json", example);
  folder.write("typo.json", replaced(example, "\"thickness\"", "\"thicknes\""));
  folder.write("unit.json", replaced(example, "\"1 mm\"", "\"1 kg\""));
  folder.write("empty.json", "");
  folder.write("truncated.json", example.substr(0, 300));
  const std::array<std::pair<std::string, std::string>, 18> cases{{
      {"", "gambeson run cases/library/shorts_walk.json"},
      {"dance", "there is no command \"dance\"; there are run, check, render, report and verify"},
      {"run", "CASE"},
      {"run example.json --fast", "--fast"},
      {"run example.json --threads -1", "--threads"},
      {"run example.json --threads many", "--threads"},
      {"run example.json --device gpu", "--device"},
      {"run example.json --device cuda", "--device: \"cuda\" is not in this build; allowed: auto or cpu"},
      {"run example.json --set contact.friction=-1",
       "command line: contact.friction: -1 is out of range; allowed: >= 0 and <= 5"},
      {"run typo.json", "typo.json:9: fabric.thicknes: unknown key; did you mean \"thickness\"?"},
      {"check unit.json", "unit.json:9: fabric.thickness: \"1 kg\" has the wrong unit"},
      {"check empty.json", "empty.json: the file is empty"},
      {"check truncated.json", "truncated.json:"},
      {"check missing.json", "missing.json: there is no such file"},
      {"check", "CASE"},
      {"render results -o x.png --time soon", "time: \"soon\""},
      {"render results -o x.png --size 12", "--size"},
      {"report results", "--output"},
  }};
  for (const auto& [arguments, message] : cases) {
    SCOPED_TRACE(arguments);
    const Outcome o = gambeson(folder, arguments);
    EXPECT_EQ(o.status, 2) << o.err;
    EXPECT_NE((o.out + o.err).find(message), std::string::npos) << o.out << o.err;
  }
}

}  // namespace
}  // namespace gambeson
