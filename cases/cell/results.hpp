#pragma once
/// What a run of a cell leaves beside its recording: curves.csv, summary.json, run.json, report.html. All of it, but
/// for what the machine took, is made from the recording.

#include <filesystem>
#include <vector>

#include "analysis/report/report.hpp"
#include "cases/cell/recording.hpp"

namespace gambeson {

/// The machine's part of a run.
struct CellRunFacts {
  double wall_s = 0;  ///< of the last start, where it was resumed
  int threads = 1;
  bool resumed = false;
};
void writeCellRunFacts(const CellRunFacts& facts, const std::filesystem::path& results);
/// Throws InputError where the file is missing or damaged.
CellRunFacts readCellRunFacts(const std::filesystem::path& results);

/// curves.csv: the name of the load, then curveColumns, a row for each step.
void writeCurves(const RecordedCell& cell, const std::filesystem::path& csv);

/// summary.json; all but "timings" is decided by the case alone.
void writeCellSummary(const RecordedCell& cell, const std::vector<AuditCheck>& checks, const CellRunFacts& facts,
                      const std::filesystem::path& json);

/// `pictures` with captions.
void writeCellPage(const RecordedCell& cell, const std::vector<AuditCheck>& checks, const CellRunFacts& facts,
                   const std::vector<Picture>& pictures, const std::filesystem::path& html);

/// What the cell is like at rest.
struct CellMeasures {
  double length_m = 0, width_m = 0, height_m = 0;  ///< of one repeat
  double volume_fraction = 0;                      ///< of the cell, that yarns fill
  std::array<double, 2> crimp{};                   ///< length of a yarn over that of the cloth, less 1; by direction
};
CellMeasures measuresOf(const CellCase& c);

/// Of a bar: Y/(integral of dy/E), its harmonic mean (Man 2006, eq. 4.32).
double harmonicMean(const PeriodicBar& bar);

}  // namespace gambeson
