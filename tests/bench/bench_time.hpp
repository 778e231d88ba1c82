#pragma once
/// Times of single calls.

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <vector>

namespace gambeson::bench {

enum class Clock {
  wall,      ///< what a user waits for, other work on the machine included
  processor  ///< spent by all threads of this process; other work only counts by the caches and memory it takes
};

inline double seconds(Clock clock) {
  timespec t{};
  clock_gettime(clock == Clock::wall ? CLOCK_MONOTONIC : CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Seconds of each call, in order of size.
template <class Work>
std::vector<double> times(benchmark::State& state, Clock clock, Work&& work) {
  std::vector<double> all;
  for (auto _ : state) {
    const double start = seconds(clock);
    work();
    all.push_back(seconds(clock) - start);
    state.SetIterationTime(all.back());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// Middle one of `count` calls outside the benchmark's own loop, to compare with in the same run [s].
template <class Work>
double medianOf(int count, Work&& work) {
  std::vector<double> all;
  for (int i = 0; i < count; ++i) {
    const double start = seconds(Clock::processor);
    work();
    all.push_back(seconds(Clock::processor) - start);
  }
  std::sort(all.begin(), all.end());
  return all[all.size() / 2];
}

}  // namespace gambeson::bench
