/// Runs that share a device wait for each other's memory.

#include "cases/wear/run/company.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace gambeson {
namespace {

TEST(Company, NeverTakesMoreThanThereIs) {
  Company company(100);
  std::atomic<int> taken = 0, most = 0, alone = 0;
  std::vector<std::thread> runs;
  for (int k = 0; k < 8; ++k)
    runs.emplace_back([&, k] {
      const int bytes = k == 0 ? 250 : 40;  // the first would never fit, and is alone
      const Company::Share share = company.take(static_cast<std::size_t>(bytes));
      const int now = taken += std::min(bytes, 100);
      most = std::max(most.load(), now);
      if (k == 0) alone = now;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      taken -= std::min(bytes, 100);
    });
  for (std::thread& run : runs) run.join();
  EXPECT_LE(most, 100);
  EXPECT_EQ(alone, 100);
}

TEST(Company, WithoutALimitNobodyWaits) {
  Company company(0);
  const Company::Share first = company.take(1000), second = company.take(1000);
  EXPECT_EQ(company.memory(), 0u);
}

}  // namespace
}  // namespace gambeson
