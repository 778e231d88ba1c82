#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <string_view>

#include "cases/command/cli.hpp"

namespace {

/// The value of --threads, or what OpenMP would take.
int threadsAsked(int argc, char** argv, int cores) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view a = argv[i];
    const char* value = a == "--threads" && i + 1 < argc ? argv[i + 1]
                        : a.starts_with("--threads=")    ? argv[i] + 10
                                                         : "";
    if (std::atoi(value) > 0) return std::atoi(value);
  }
  const char* asked = std::getenv("OMP_NUM_THREADS");
  return asked && std::atoi(asked) > 0 ? std::atoi(asked) : cores;
}

/// OpenMP takes any number from the environment, and faults where a machine cannot start so many threads. A list has
/// one number for each level of nesting.
bool tooManyThreads() {
  constexpr long most = 4096;  // as --threads
  const char* asked = std::getenv("OMP_NUM_THREADS");
  if (!asked || std::strtol(asked, nullptr, 10) <= most) return false;
  std::cerr << "environment: OMP_NUM_THREADS: \"" << std::string_view(asked).substr(0, 40)
            << "\" is out of range; allowed: 1 to " << most << '\n';
  return true;
}

/// Tasks that run or want to, besides this one; as many as there are cores where that is not known.
int othersRunning(int cores) {
  std::ifstream file("/proc/stat");
  for (std::string word; file >> word;) {
    int count = 0;
    if (word == "procs_running" && file >> count) return count - 1;
  }
  return cores;
}

/// The solver's parallel loops take microseconds. Threads that wait for each other by spinning, as OpenMP's do unless
/// told otherwise, lose whole time slices as soon as the cores are shared with other work (20 times slower with two
/// threads on two busy cores); those that sleep at once lose a quarter of their time to being woken where they are not.
/// 500 turns cover the wait for an even share of a loop, 3000 the work between two loops too: that many where enough
/// cores are free as the program starts. The library reads this once, when it is loaded, so the program starts itself
/// again. What the user has set stands.
void waitPatiently(int argc, char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  // These only start others, which ask for themselves.
  for (const char* starter : {"study", "batch", "gallery"})
    if (argc > 1 && std::string_view(argv[1]) == starter) return;
  cpu_set_t mine;
  const int cores = sched_getaffinity(0, sizeof(mine), &mine) == 0 ? std::max(1, CPU_COUNT(&mine)) : 1;
  const bool free = threadsAsked(argc, argv, cores) + othersRunning(cores) <= cores;
  if (setenv("GOMP_SPINCOUNT", free ? "3000" : "500", 1) == 0) execv("/proc/self/exe", argv);
}

}  // namespace

int main(int argc, char** argv) {
  if (tooManyThreads()) return 2;
  waitPatiently(argc, argv);
  return gambeson::runCommand(argc, argv, std::cout, std::cerr);
}
