#pragma once
/// Runs a structure's case and leaves its results; pictures and report of such results.

#include "cases/runs/options.hpp"
#include "cases/structure/case.hpp"

namespace gambeson {

/// Builds what a run starts from, with the same errors, and lets it go.
void checkStructure(const StructureCase& c);

/// Throws InputError at the case's kind: structures are computed by the processor alone.
void requireCarried(const StructureCase& c, DeviceKind device);

/// Runs the case into the folder of the options, as runCase does. Throws RunError where the run fails; what converged
/// before is in the folder.
int runStructure(const StructureCase& c, const RunOptions& options);

/// Whether a results folder was left by runStructure.
bool holdsStructure(const std::filesystem::path& results);
int renderStructureResults(const RenderOptions& options);
int reportStructureResults(const ReportOptions& options);

}  // namespace gambeson
