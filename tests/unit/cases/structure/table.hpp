#pragma once
/// Tables of a run of a structure, for the tests.

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace gambeson {

/// Rows of path.csv by the names of its columns.
inline std::vector<std::map<std::string, double>> tableRows(const std::filesystem::path& csv) {
  std::ifstream stream(csv);
  std::string line, cell;
  std::getline(stream, line);
  std::vector<std::string> names;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(stream, line)) {
    std::size_t k = 0;
    rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) rows.back()[names[k++]] = std::stod(cell);
  }
  return rows;
}

}  // namespace gambeson
