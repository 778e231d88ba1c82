/// Readers in a process of their own: what they give back, and how their ends are told.

#include "core/io/apart.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>

namespace gambeson {
namespace {

const std::filesystem::path file = "/nowhere/a.bin";

/// The reason for which reading is refused; "" where it is not.
std::string reasonOf(const std::function<void(BytesOut&)>& read, const ApartLimits& limits = {}) {
  try {
    readApart(file, limits, read);
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, file.string());
    return e.reason();
  }
  return "";
}

/// As deep as the stack and deeper.
int fall(int n) {
  volatile char page[4096];
  page[n % 4096] = 1;
  return n > 0 ? fall(n - 1) + page[0] : 0;
}

TEST(Apart, GivesBackWhatItRead) {
  // Threads that have run in this process do not matter.
#pragma omp parallel num_threads(4)
  {}
  const std::vector<double> numbers(100000, 0.5);
  BytesIn in = readApart(file, {}, [&](BytesOut& out) {
    out.put(7);
    out.put(std::string("a\0b", 3));
    out.put(numbers);
    out.put(std::vector<std::string>{"one", "", "three"});
    out.put(std::vector<int>{});
  });
  int seven = 0;
  std::string text;
  std::vector<double> back;
  std::vector<std::string> words;
  std::vector<int> none{1};
  in.get(seven), in.get(text), in.get(back), in.get(words), in.get(none);
  EXPECT_EQ(seven, 7);
  EXPECT_EQ(text, std::string("a\0b", 3));
  EXPECT_EQ(back, numbers);
  EXPECT_EQ(words, (std::vector<std::string>{"one", "", "three"}));
  EXPECT_TRUE(none.empty());
  EXPECT_THROW(in.get(seven), RunError);
}

TEST(Apart, ErrorsComeBackWithTheirPlace) {
  try {
    readApart(file, {}, [](BytesOut&) { throw InputError({"other", 12, "key"}, "is wrong"); });
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "other:12: key: is wrong");
  }
  EXPECT_EQ(reasonOf([](BytesOut&) { throw std::runtime_error("odd"); }), "cannot be read: odd");
}

TEST(Apart, AReaderThatDiesIsARefusal) {
  EXPECT_NE(reasonOf([](BytesOut&) { std::raise(SIGSEGV); }).find("ends its reader"), std::string::npos);
  EXPECT_NE(reasonOf([](BytesOut&) { std::abort(); }).find("ends its reader"), std::string::npos);
  EXPECT_NE(reasonOf([](BytesOut& out) { out.put(fall(1 << 20)); }).find("ends its reader"), std::string::npos);
  EXPECT_NE(reasonOf([](BytesOut&) { _exit(5); }), "");
}

TEST(Apart, MemoryAndTimeAreLimited) {
#ifndef __SANITIZE_ADDRESS__
  ApartLimits small;
  small.memory_bytes = std::size_t{64} << 20;
  EXPECT_EQ(reasonOf([](BytesOut& out) { out.put(std::vector<double>(std::size_t{1} << 24, 1.0)); }, small),
            "cannot be read: that takes more than 64 MB of memory");
#endif
  ApartLimits brief;
  brief.cpu_s = 0.1;
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(reasonOf([](BytesOut&) { pause(); }, brief).find("takes longer"), std::string::npos);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
  volatile bool on = true;
  EXPECT_NE(reasonOf(
                [&](BytesOut&) {
                  while (on) {
                  }
                },
                brief)
                .find("takes longer"),
            std::string::npos);
}

TEST(Apart, WhatItPrintsIsDropped) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(reasonOf([](BytesOut&) { std::fputs("noise\n", stderr); }), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace gambeson
