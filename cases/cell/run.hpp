#pragma once
/// Runs a cell's case and leaves its results; pictures and report of such results.

#include "cases/cell/case.hpp"
#include "cases/runs/options.hpp"

namespace gambeson {

/// Builds what a run starts from, with the same errors, and lets it go.
void checkCell(const CellCase& c);

/// Throws InputError at the case's kind: cells are computed by the processor alone.
void requireCarried(const CellCase& c, DeviceKind device);

/// Runs the case into the folder of the options, as runCase does; loads side by side. With `resume`, loads that are
/// recorded stay. Throws RunError where a load is not walked to its end; what was reached is in the folder.
int runCell(const CellCase& c, const RunOptions& options);

/// Whether a results folder was left by runCell.
bool holdsCell(const std::filesystem::path& results);
int renderCellResults(const RenderOptions& options);
int reportCellResults(const ReportOptions& options);

}  // namespace gambeson
