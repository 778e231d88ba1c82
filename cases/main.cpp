#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "cases/cli.hpp"

namespace {

/// The solver's parallel loops take microseconds. Threads that wait for each other by spinning, as OpenMP's do unless
/// told otherwise, lose whole time slices as soon as the cores are shared with other work (20 times slower with two
/// threads on two busy cores); 500 turns cover the wait for an even share of a loop, then the thread sleeps. The
/// library reads this once, when it is loaded, so the program starts itself again. What the user has set stands.
void waitPatiently(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  if (setenv("GOMP_SPINCOUNT", "500", 1) == 0) execv("/proc/self/exe", argv);
}

}  // namespace

int main(int argc, char** argv) {
  waitPatiently(argv);
  return gambeson::runCommand(argc, argv, std::cout, std::cerr);
}
