/// Errors that are carried out of parallel loops.

#include "core/math/carried_error.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace gambeson {
namespace {

TEST(CarriedError, TheLowestIndexSpeaksForAnyNumberOfThreads) {
  for (const int threads : {1, 4}) {
    CarriedError error;
#pragma omp parallel for num_threads(threads) schedule(static, 1)
    for (int i = 0; i < 100; ++i)
      error.guard(i, [&] {
        if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
      });
    try {
      error.rethrow();
      ADD_FAILURE() << "nothing was kept";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
  }
}

TEST(CarriedError, NothingIsThrownWhereNothingWas) {
  CarriedError error;
  error.guard(0, [] {});
  EXPECT_NO_THROW(error.rethrow());
}

}  // namespace
}  // namespace gambeson
