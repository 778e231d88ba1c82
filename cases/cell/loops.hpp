#pragma once
/// What the forces of a cell do along a load, and what becomes of it, by the rows that are recorded.

#include <vector>

#include "cases/cell/case.hpp"
#include "core/io/recorded_table.hpp"

namespace gambeson {

/// By area of the cell at rest [J/m²]; work by trapezia of the steps.
struct CellWork {
  double work = 0, stored = 0, lost = 0;
};
/// From the first row to each.
std::vector<CellWork> workAlong(const RecordedTable& rows);

/// Of a load with cycles, each that was walked whole: from its begin there and back.
std::vector<CellWork> loopsOf(const PathCase& path, const RecordedTable& rows);

}  // namespace gambeson
