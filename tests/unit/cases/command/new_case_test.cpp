/// `gambeson new`: what it writes is valid on its wearer, and answers that cannot be are asked for again or refused.

#include "cases/command/new_case.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "cases/wear/case/case.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

std::string written(const Folder& folder, NewCase answers) {
  answers.file = folder.path() / "new.json";
  std::filesystem::remove(answers.file);
  std::ostringstream out;
  EXPECT_EQ(writeNewCase(answers, out), 0);
  return out.str();
}

TEST(NewCase, IsValidOnItsWearer) {
  const Folder folder;
  for (const NewCase& answers :
       {NewCase{"", "trousers", "", "female_p5", "walk", ""}, NewCase{"", "sleeves", "", "male_p95", "aim", ""},
        NewCase{"", "shorts", "petrak_m6_cotton_twill", "", "stairs", ""}, NewCase{"", "shorts", "", "", "sit", ""},
        NewCase{"", "shorts", "", "female_p5", "step_over", ""}}) {
    SCOPED_TRACE(answers.garment + " " + answers.wearer);
    const std::string said = written(folder, answers);
    EXPECT_NE(said.find("It is valid"), std::string::npos) << said;
    EXPECT_NE(said.find("girth of the"), std::string::npos) << said;
    const Case c = readCase(folder.path() / "new.json");
    EXPECT_TRUE(c.human->skin);
    EXPECT_FALSE(c.analysis.joints.empty());
  }
}

TEST(NewCase, AsksUntilAnAnswerCanBe) {
  NewCase answers;
  answers.wearer = "female_p50";
  std::istringstream in("kilt\ntrousers\n\nfly\nwalk\n");
  std::ostringstream out;
  askForCase(answers, in, out);
  EXPECT_EQ(answers.garment, "trousers");
  EXPECT_EQ(answers.fabric, "denim_a");
  EXPECT_EQ(answers.wearer, "female_p50");
  EXPECT_EQ(answers.motion, "walk");
  EXPECT_EQ(answers.cells, "coarse");  // where nothing more is said
  EXPECT_NE(out.str().find("there is no \"kilt\""), std::string::npos) << out.str();
  EXPECT_EQ(out.str().find("Who wears"), std::string::npos) << out.str();
}

TEST(NewCase, WhatCannotBeIsRefused) {
  const Folder folder;
  const auto refused = [&](const NewCase& answers, const char* key, const char* words) {
    std::ostringstream out;
    try {
      writeNewCase(answers, out);
      ADD_FAILURE() << key << " is taken";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, key);
      EXPECT_NE(e.reason().find(words), std::string::npos) << e.reason();
    }
  };
  const std::filesystem::path file = folder.path() / "new.json";
  refused({file, "kilt", "", "", "", ""}, "--garment", "allowed: shorts, trousers");
  refused({file, "", "none.json", "", "", ""}, "--fabric", "there is no file none.json");
  refused({file, "", "", "male_p49", "", ""}, "--wearer", "male_p50");
  EXPECT_FALSE(std::filesystem::exists(file));
  folder.write("new.json", "{}");
  refused({file, "", "", "", "", ""}, "CASE", "is there already");
}

}  // namespace
}  // namespace gambeson
