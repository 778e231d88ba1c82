#pragma once
/// Lines of the tables that a study leaves, and numbers of study.json.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/study/compare.hpp"
#include "core/io/csv_text.hpp"

namespace gambeson::study {

using StudyJson = nlohmann::ordered_json;

inline StudyJson number(double x) { return std::isfinite(x) ? StudyJson(x) : StudyJson(nullptr); }
inline StudyJson number(const std::optional<double>& x) { return x ? number(*x) : StudyJson(nullptr); }

/// A line of a table; empty cells for what is not known.
inline std::string csvRow(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) line.append(k > 0 ? "," : "").append(csvText(cells[k]));
  return line.append(1, '\n');
}
inline std::string cell(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }
inline std::string cell(const std::optional<double>& x) { return x ? cell(*x) : ""; }

// Detail of tables.cpp.
std::string uncertaintyTable(const Study& study, const Comparison& c);
StudyJson uncertaintyJson(const Study& study, const Comparison& c);

}  // namespace gambeson::study
