#pragma once
/// What the command's subcommands do once their input is checked. All return the exit status.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/runs/options.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson {

/// Builds what a run starts from, with the same errors, and lets it go: the scenario, each garment that is put on by
/// itself, the state at the start. Returns what a user should know of it, a line each: the notes of the run (but those
/// of unusual numbers, which the file says better), and of a human the girths as the run starts: of the body, of each
/// garment that goes around it as drafted or placed, and the ease between them.
std::vector<std::string> checkRun(const Case& c);

/// In company (RunOptions) it leaves the results to finishApart: pictures are drawn by one thread of a process at a
/// time.
int runCase(const Case& c, const RunOptions& options);

/// Writes the results of what `out` holds recorded, and says where their page is.
int finishRun(const std::filesystem::path& out);

struct FinishOptions {
  std::filesystem::path out;
  int threads = 0;
};
/// finishRun in a process of its own. Throws as FolderLock and writeResults.
int finishApart(const FinishOptions& options);

}  // namespace gambeson
