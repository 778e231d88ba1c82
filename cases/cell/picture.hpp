#pragma once
/// Pictures of a cell's yarns.

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/report/report.hpp"
#include "cases/cell/recording.hpp"

namespace gambeson {

/// Throws RunError where no shape of the load is recorded.
void renderCell(const RecordedCell& cell, const CellPicture& picture, const std::filesystem::path& png);

/// The pictures that the case asks for; without any one of the cell at rest, and of the ends of the first eight loads.
/// One that fails leaves its reason.
std::vector<Picture> takeCellPictures(const RecordedCell& cell, const std::filesystem::path& folder,
                                      std::vector<std::string>& failures);

}  // namespace gambeson
