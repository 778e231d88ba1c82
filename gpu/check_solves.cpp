#include "gpu/check_solves.hpp"

#include <fmt/format.h>

#include <chrono>

#include "gpu/scenes/solve_facts.hpp"
#include "tools/recorded_solve.hpp"

namespace gambeson::gpu {
namespace {

constexpr int kMost = 8000;  ///< iterations

int largestIsland(const ContactWork& w) {
  int most = 0;
  for (const ContactWork::Island& i : w.islands) most = std::max(most, i.row_end - i.row);
  return most;
}

/// What an iteration of the gradient method should take at most [us].
double allowedFor(int rows) {
  return rows <= 200 ? 2.8 : rows <= 350 ? 4.5 : rows <= 1500 ? 4 : rows <= 15000 ? 9 : 14;
}

std::vector<ContactProblem> problemsOf(const SolveSettings& settings) {
  std::vector<ContactProblem> all;
  for (int k = 0; k < 10; ++k) {
    const auto file = settings.recorded / fmt::format("solve{}.bin", k);
    if (std::filesystem::exists(file)) all.push_back(recordedSolve(file));
  }
  if (all.empty()) fmt::print("no recorded solves in {}\n", settings.recorded.string());
  for (ContactProblem& problem : manifestProblems()) all.push_back(std::move(problem));
  for (int cells : {8, 28, 50})
    if (cells == 8 || settings.large) all.push_back(contactStack({3, cells, 1}));
  // As many rows to a point as in recorded solves of armour.
  for (int cells : {28, 90, 155})
    if (cells == 28 || settings.large) all.push_back(contactStack({1, cells, 0.31}));
  return all;
}

int checkProblem(const ContactProblem& problem, const SolveSettings& settings) {
  const ContactWork truth = solved(problem, kMost, nullptr);
  const SweepFacts facts = factsOf(truth);
  const int largest = largestIsland(truth);
  fmt::print("{}: {} rows in {} islands, the largest {}; {} sweeps, {:016x}\n", problem.name, facts.rows, facts.islands,
             largest, facts.iterations, facts.hash);
  int different = 0;
  const auto expect = [&](const std::string& what, ContactSweeps& device) {
    const bool same = factsOf(solved(problem, kMost, &device)) == facts;
    if (!same) fmt::print("  NOT the same on {}\n", what);
    different += !same;
  };
  if (facts.rows < 5000) expect("the reference", *sweepsOnReference());
  if (!settings.cuda) return different;
  ContactWork start;
  startProblem(problem, start);
  const std::vector<int> of_islands = gradientIterations(problem, start, kMost);
  const int gradient = *std::ranges::max_element(of_islands);
  const auto time = [&](const std::string& what, const CudaSweepOptions& options) {
    const auto device = sweepsOnCuda(options);
    expect(what, *device);
    device->set(start);
    const double us = 1e3 * device->medianMilliseconds(problem.goal_m_per_s, kMost, 4 * kMost, settings.passes);
    fmt::print("  {:<24} {:9.1f} us, {:6.2f} a sweep; {:6.2f} of {:4.1f} for a step along the gradient ({})\n", what,
               us, us / facts.iterations, us / gradient, allowedFor(largest), gradient);
    expect(what + " after the timing", *device);
  };
  time("64 quads a block", {});
  if (settings.variants) {
    time("32 quads a block", {32, 0, -1});
    time("16 quads a block", {16, 0, -1});
    time("without shared memory", {64, 0, 0});
    if (largest > 1024)
      for (int blocks : {1, 4, 16}) time(fmt::format("{} blocks to an island", blocks), {64, blocks, -1});
  }
  std::fflush(stdout);
  return different;
}

/// Many runs, a stream each.
void timeSideBySide(const ContactProblem& problem, int passes) {
  ContactWork start;
  startProblem(problem, start);
  std::vector<std::unique_ptr<ContactSweeps>> runs;
  for (int count : {1, 2, 4, 8, 16}) {
    while (static_cast<int>(runs.size()) < count) {
      runs.push_back(sweepsOnCuda());
      runs.back()->set(start);
    }
    const auto go = [&](int times) {
      for (int i = 0; i < times; ++i)
        for (auto& run : runs) run->begin(problem.goal_m_per_s, kMost, 4 * kMost);
      for (auto& run : runs) run->wait();
    };
    go(2);
    const auto begin = std::chrono::steady_clock::now();
    go(passes);
    const double us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / passes;
    fmt::print("{}: {} solves side by side take {:.1f} us\n", problem.name, count, us);
  }
}

}  // namespace

int checkSolves(const SolveSettings& settings) {
  int different = 0;
  const std::vector<ContactProblem> problems = problemsOf(settings);
  for (const ContactProblem& problem : problems) different += checkProblem(problem, settings);
  if (settings.cuda)
    for (const ContactProblem& problem : problems)
      if (problem.name == "solve2" || problem.name == "solve3" || problem.name == "solve8")
        timeSideBySide(problem, settings.passes);
  return different;
}

}  // namespace gambeson::gpu
