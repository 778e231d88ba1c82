/// Runs the benchmarks and prints what they say together: shares of the peak, gain by the second thread, shares of the
/// phases.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <map>

#include "bench_table.hpp"

namespace {
std::map<std::string, double>& notes() {
  static std::map<std::string, double> values;
  return values;
}
}  // namespace

void gambeson::bench::note(const std::string& name, double value) {
  double& kept = notes()[name];
  if (value > kept) kept = value;
}

int main(int argc, char** argv) {
  // One thread to a core: a scheduler may leave two short-lived loops' threads on one core for the whole measurement.
  // The OpenMP library reads this once, when it is loaded.
  if (!std::getenv("OMP_PROC_BIND") && setenv("OMP_PROC_BIND", "true", 1) == 0) execv("/proc/self/exe", argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  const auto& n = notes();
  const auto ratio = [&](const char* what, const std::string& a, const std::string& b, double at_least) {
    if (!n.contains(a) || !n.contains(b) || !(n.at(b) > 0)) return;
    const double r = n.at(a) / n.at(b);
    fmt::print("{:<58}{:>8.3f}   wanted {:>5.2f}  {}\n", what, r, at_least, r >= at_least ? "yes" : "NO");
  };
  fmt::print("\n");
  if (n.contains("peak"))
    fmt::print("{:<58}{:>8.1f}\n", "multiply-add peak of a core, double precision [GFlop/s]", n.at("peak"));
  ratio("cell forces / peak, one thread", "kernel 1", "peak", 0.25);
  ratio("whole internal force / peak, one thread", "force 1", "peak", 0.25);
  ratio("cell forces, two threads / one", "kernel 2", "kernel 1", 1.8);
  ratio("whole internal force, two threads / one", "force 2", "force 1", 1.8);
  double total = 0;
  for (const auto& [name, value] : n)
    if (name.starts_with("phase ")) total += value;
  for (const auto& [name, value] : n)
    if (name.starts_with("phase "))
      fmt::print("{:<58}{:>8.1f} %\n", "step of shorts_walk, " + name.substr(6), 100 * value / total);
  benchmark::Shutdown();
}
