#include "cases/fabric/raw_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <string>

#include "cases/input/schema.hpp"
#include "core/error.hpp"
#include "core/io/csv_text.hpp"

namespace gambeson {
namespace {

const std::map<std::string, double> curvatures{{"curvature_per_cm", 100}, {"curvature_per_m", 1}};
const std::map<std::string, double> moments{{"moment_gf_cm_per_cm", 9.80665e-3}, {"moment_N", 1}, {"moment_mN", 1e-3}};

std::vector<std::string> namesOf(const std::map<std::string, double>& columns) {
  std::vector<std::string> names;
  for (const auto& [name, unit] : columns) names.push_back(name);
  return names;
}

/// Where a column of these stands, and its unit.
std::pair<std::size_t, double> find(const std::vector<std::string>& header,
                                    const std::map<std::string, double>& columns, const std::string& file) {
  for (std::size_t i = 0; i < header.size(); ++i)
    if (const auto it = columns.find(header[i]); it != columns.end()) return {i, it->second};
  throw InputError({file, 1, ""},
                   fmt::format("there is no column {}; allowed in the first line: names with commas between, each with "
                               "its unit",
                               schema::joined(namesOf(columns))));
}

std::string trimmed(std::string cell) {
  while (!cell.empty() && (cell.back() == '\r' || cell.back() == ' ')) cell.pop_back();
  return cell.substr(std::min(cell.find_first_not_of(' '), cell.size()));
}

}  // namespace

std::vector<LoopSample> readLoop(const std::filesystem::path& path) {
  constexpr std::size_t kMost = 1'000'000;
  const std::string file = path.string();
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) throw InputError({file, 0, ""}, "there is no such file");
  std::ifstream stream(path);
  if (!stream) throw InputError({file, 0, ""}, "cannot be opened");
  std::string line;
  if (!std::getline(stream, line)) throw InputError({file, 0, ""}, "is empty");
  std::vector<std::string> header = csvCells(line);
  for (std::string& name : header) name = trimmed(name);
  const auto [at_k, unit_k] = find(header, curvatures, file);
  const auto [at_m, unit_m] = find(header, moments, file);
  std::vector<LoopSample> loop;
  for (int row = 2; std::getline(stream, line); ++row) {
    if (trimmed(line).empty()) continue;
    std::vector<std::string> cells = csvCells(line);
    const auto numberAt = [&, &names = header](std::size_t at, double most) {
      if (at >= cells.size()) throw InputError({file, row, names[at]}, "is missing: the row is too short");
      const std::string cell = trimmed(cells[at]);
      double x = 0;
      const auto [end, wrong] = std::from_chars(cell.data(), cell.data() + cell.size(), x);
      if (wrong != std::errc() || end != cell.data() + cell.size() || !std::isfinite(x))
        throw InputError({file, row, names[at]}, fmt::format("\"{}\" is no number", cell.substr(0, 40)));
      if (!(std::abs(x) <= most))
        throw InputError({file, row, names[at]},
                         fmt::format("{} is out of range; allowed: a magnitude up to {}", x, most));
      return x;
    };
    loop.push_back({unit_k * numberAt(at_k, 1e5 / unit_k), unit_m * numberAt(at_m, 1e3 / unit_m)});
    if (loop.size() > kMost) throw InputError({file, row, ""}, fmt::format("has more than {} rows", kMost));
  }
  return loop;
}

}  // namespace gambeson
