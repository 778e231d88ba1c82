#pragma once
/// Cells of the tables of a study, and numbers of study.json.

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/io/csv_text.hpp"

namespace gambeson::study::cells {

using Json = nlohmann::ordered_json;

inline Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
inline Json number(const std::optional<double>& x) { return x ? number(*x) : Json(nullptr); }

/// A line of a table; empty cells for what is not known.
inline std::string csvRow(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) line.append(k > 0 ? "," : "").append(csvText(cells[k]));
  return line.append(1, '\n');
}
inline std::string cell(double x) { return std::isfinite(x) ? fmt::format("{}", x) : ""; }
inline std::string cell(const std::optional<double>& x) { return x ? cell(*x) : ""; }

}  // namespace gambeson::study::cells
