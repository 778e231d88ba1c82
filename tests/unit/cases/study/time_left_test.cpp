/// How long the rest of a study takes.

#include "cases/study/time_left.hpp"

#include <gtest/gtest.h>

namespace gambeson::study {
namespace {

RunTime done(std::vector<int> levels, double took_s) { return {std::move(levels), true, took_s}; }
RunTime waiting(std::vector<int> levels) { return {std::move(levels)}; }
RunTime running(std::vector<int> levels, double seconds, double part, double from = 0) {
  return {std::move(levels), false, {}, seconds, from, part};
}

/// A fine run takes ten times as long as a coarse one: the mean of all would say 55 s for each.
TEST(TimeLeft, ComesFromTheRunsThatAreMostAlike) {
  const std::vector<RunTime> runs{done({0, 0}, 10), done({0, 1}, 100), waiting({1, 0}), waiting({1, 1})};
  EXPECT_DOUBLE_EQ(*timeLeft(runs, 1), 110);
  EXPECT_DOUBLE_EQ(*timeLeft(runs, 2), 100);
}

TEST(TimeLeft, OneUnderWayGoesOnAsItWent) {
  // A quarter in 30 s: 90 s more. From a checkpoint at a half, a quarter in 30 s: 30 s more.
  EXPECT_DOUBLE_EQ(*timeLeft(std::vector<RunTime>{running({0}, 30, 0.25)}, 1), 90);
  EXPECT_DOUBLE_EQ(*timeLeft(std::vector<RunTime>{running({0}, 30, 0.75, 0.5)}, 1), 30);
  // The one that waits takes as long as that one seems to.
  EXPECT_DOUBLE_EQ(*timeLeft(std::vector<RunTime>{running({0}, 30, 0.25), waiting({1})}, 1), 90 + 120);
  // One that has just started takes what the others took, less what it ran.
  EXPECT_DOUBLE_EQ(*timeLeft(std::vector<RunTime>{done({0}, 50), running({1}, 5, 0.01)}, 1), 45);
}

TEST(TimeLeft, NothingIsSaidBeforeARunTells) {
  EXPECT_FALSE(timeLeft(std::vector<RunTime>{running({0}, 5, 0.02), waiting({1})}, 2));
  EXPECT_FALSE(timeLeft(std::vector<RunTime>{{{0}, true, {}}, waiting({1})}, 2));  // one that failed tells nothing
  EXPECT_DOUBLE_EQ(*timeLeft(std::vector<RunTime>{{{0}, true, {}}}, 2), 0);
}

}  // namespace
}  // namespace gambeson::study
