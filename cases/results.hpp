#pragma once
/// Everything that a run leaves beside its recording: the numbers, tables, pictures and the report.

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cases/scenario.hpp"

namespace gambeson {

/// What the run knows of itself and the recording does not; DIR/run.json.
struct RunFacts {
  int threads = 0;
  std::string kernels, version;
  double wall_s = 0;
  std::vector<std::pair<std::string, double>> phases_s;
  bool resumed = false;
};
void writeRunFacts(const RunFacts& facts, const std::filesystem::path& dir);

/// Reads DIR's recording and run.json; writes summary.json, the tables, the pictures and report.html.
void writeResults(const Scenario& scenario, const std::filesystem::path& dir);

}  // namespace gambeson
