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
/// itself, the state at the start.
void checkRun(const Case& c);

int runCase(const Case& c, const RunOptions& options);

}  // namespace gambeson
