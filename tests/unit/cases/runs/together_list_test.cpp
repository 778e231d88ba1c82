/// What a process that makes several runs is told, and what it tells.

#include "cases/runs/together_list.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

TEST(TogetherList, ComesBackAsItWas) {
  const Folder folder;
  const std::vector<TogetherRun> runs{{"a b.json", "out/a", "logs/a.log", false},
                                      {"c.json", "out/c", "logs/c.log", true}};
  const std::vector<TogetherRun> back = readTogetherList(folder.write("list.json", togetherList(runs)));
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0].case_file, "a b.json");
  EXPECT_EQ(back[1].out, "out/c");
  EXPECT_EQ(back[1].log, "logs/c.log");
  EXPECT_FALSE(back[0].resume);
  EXPECT_TRUE(back[1].resume);
  for (const char* damaged : {"", "[{}]", R"([{"case": 1, "out": "a", "log": "b", "resume": false}])"})
    EXPECT_THROW(readTogetherList(folder.write("list.json", damaged)), InputError) << damaged;
  EXPECT_THROW(readTogetherList(folder.path() / "none.json"), InputError);
}

TEST(TogetherList, EventsAreWholeLines) {
  const std::string line = eventLine({3, true, false, "two\nlines \"and\" a byte \xff", 1.5});
  EXPECT_EQ(line.find('\n'), line.size() - 1);
  const auto ended = readEvent(line);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->run, 3u);
  EXPECT_TRUE(ended->ended);
  EXPECT_FALSE(ended->good);
  EXPECT_EQ(ended->why.substr(0, 15), "two\nlines \"and\"");
  EXPECT_EQ(ended->seconds, 1.5);
  const auto begins = readEvent(eventLine({4, false, false, "", 0}));
  ASSERT_TRUE(begins);
  EXPECT_FALSE(begins->ended);
  for (const char* damaged : {"", "{", "[]", "{\"run\": 1}", "{\"run\": \"x\", \"ended\": false}"})
    EXPECT_FALSE(readEvent(damaged)) << damaged;
  EXPECT_FALSE(readEvent(line.substr(0, line.size() / 2)));
}

}  // namespace
}  // namespace gambeson
