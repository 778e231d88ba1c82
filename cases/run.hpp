#pragma once
/// What the command's subcommands do once their input is checked. All return the exit status.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/case.hpp"

namespace gambeson {

struct RunOptions {
  std::filesystem::path out;  ///< results folder
  int threads = 0;            ///< 0: OMP_NUM_THREADS, or as many as the machine has
  bool resume = false;        ///< continue what an interrupted run left in `out`
};

struct RenderOptions {
  std::filesystem::path results;  ///< folder of a run
  std::filesystem::path png;
  PictureField field = PictureField::stress;
  PictureTime when = PictureTime::end;
  double time_s = 0;  ///< where `when` is `at`
  View view = View::front_right;
  int width = 1280, height = 960;
};

struct ReportOptions {
  std::filesystem::path results;
  std::filesystem::path html;
};

/// Builds what a run starts from, with the same errors, and lets it go: the scenario, each garment that is put on by
/// itself, the state at the start.
void checkRun(const Case& c);

int runCase(const Case& c, const RunOptions& options);
int renderResults(const RenderOptions& options);
int reportResults(const ReportOptions& options);

}  // namespace gambeson
