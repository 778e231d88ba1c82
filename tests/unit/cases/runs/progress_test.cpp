#include "cases/runs/progress.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

TEST(Progress, DurationsReadWell) {
  EXPECT_EQ(durationText(0), "0 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(190), "3 min 10 s");
  EXPECT_EQ(durationText(3900), "1 h 05 min");
}

TEST(Progress, TimeLeftFollowsTheWorkDoneHere) {
  // 1 of 4 s after 10 s of work: 30 s left. Resumed at 0.5 s the same 10 s bought only half a second: 60 s left.
  EXPECT_EQ(progressLine("walk", 1, 4, 0, 10), "walk  25 %  1.00 of 4.00 s  30 s left");
  EXPECT_EQ(progressLine("walk", 1, 4, 0.5, 10), "walk  25 %  1.00 of 4.00 s  1 min 00 s left");
  EXPECT_EQ(progressLine("walk", 1, 4, 0, 1), "walk  25 %  1.00 of 4.00 s");
  EXPECT_EQ(progressLine("walk", 0, 0, 0, 10), "walk  0 %  0.00 of 0.00 s");
}

TEST(Progress, QuietWhereThereIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  ASSERT_NE(file, nullptr);
  {
    Progress progress(1, 0, file);
    progress.update(0.5, "walk");
    progress.update(1, "walk");
  }
  EXPECT_EQ(std::ftell(file), 0);
  std::fclose(file);
}

/// Whoever starts a run in the background reads how far it is in a file.
TEST(Progress, StandsInAFileToo) {
  const Folder folder;
  const std::filesystem::path file = folder.path() / "progress.txt";
  const auto line = [&] {
    std::ifstream stream(file);
    std::string text;
    std::getline(stream, text);
    return text;
  };
  std::FILE* quiet = std::tmpfile();
  ASSERT_NE(quiet, nullptr);
  {
    Progress progress(4, 0, quiet, " s", file);
    progress.update(1, "walk");
    EXPECT_EQ(line(), "walk  25 %  1.00 of 4.00 s");
    progress.update(2, "walk");
    EXPECT_EQ(line(), "walk  25 %  1.00 of 4.00 s") << "written anew within two seconds";
    progress.update(4, "walk");
  }
  EXPECT_EQ(line(), "walk  100 %  4.00 of 4.00 s");
  EXPECT_EQ(std::ftell(quiet), 0);
  std::fclose(quiet);
}

}  // namespace
}  // namespace gambeson
