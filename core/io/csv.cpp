#include "core/io/csv.hpp"
#include "core/io/csv_text.hpp"
#include "core/io/own_file.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace gambeson {
namespace {

/// What a spreadsheet would take for a formula.
bool beginsLikeAFormula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r\n").find(text[0]) != std::string_view::npos;
}

bool isNumber(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && error != std::errc::invalid_argument && end == text.data() + text.size();
}

void appendNumber(std::string& s, double value) {
  char buffer[32];
  s.append(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

void appendRow(std::string& s, const std::vector<double>& row, std::size_t columns, bool after_label) {
  if (row.size() != columns)
    throw std::logic_error("a CSV row has " + std::to_string(row.size()) + " values for " + std::to_string(columns) +
                           " columns");
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (i > 0 || after_label) s += ',';
    appendNumber(s, row[i]);
  }
  s += '\n';
}

}  // namespace

std::string shortest(double value) {
  std::string s;
  appendNumber(s, value);
  return s;
}

namespace {

/// In quotes where it holds what would end a cell.
std::string quoted(const std::string& text, const char* ends) {
  if (text.find_first_of(ends) == std::string::npos) return text;
  std::string s = "\"";
  for (const char c : text) {
    if (c == '"') s += '"';
    s += c;
  }
  return s + '"';
}

}  // namespace

std::string csvText(const std::string& text) {
  return quoted(beginsLikeAFormula(text) && !isNumber(text) ? "'" + text : text, ",\"\r\n");
}

std::string europeanCsv(std::string_view csv) {
  std::string out, cell;
  bool inside = false;
  const auto finish = [&] {
    if (isNumber(cell)) std::replace(cell.begin(), cell.end(), '.', ',');
    out += quoted(cell, ";\"\r\n");
    cell.clear();
  };
  for (std::size_t i = 0; i < csv.size(); ++i) {
    const char c = csv[i];
    if (inside && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"')
      cell += csv[++i];
    else if (c == '"')
      inside = !inside;
    else if (!inside && (c == ',' || c == '\n'))
      finish(), out += c == ',' ? ';' : '\n';
    else
      cell += c;
  }
  if (!cell.empty()) finish();
  return out;
}

std::vector<std::string> csvCells(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  for (std::string& cell : cells)
    if (cell.starts_with('\'') && beginsLikeAFormula(std::string_view(cell).substr(1))) cell.erase(0, 1);
  return cells;
}

std::string formatCsv(const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  std::string s;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (i > 0) s += ',';
    s += csvText(columns[i]);
  }
  s += '\n';
  for (const auto& row : rows) appendRow(s, row, columns.size(), false);
  return s;
}

std::string formatCsv(const std::string& label_column, const std::vector<std::string>& labels,
                      const std::vector<std::string>& columns, const std::vector<std::vector<double>>& rows) {
  if (labels.size() != rows.size()) throw std::logic_error("a CSV table needs one label per row");
  std::string s = csvText(label_column);
  for (const auto& column : columns) {
    s += ',';
    s += csvText(column);
  }
  s += '\n';
  for (std::size_t r = 0; r < rows.size(); ++r) {
    s += csvText(labels[r]);
    appendRow(s, rows[r], columns.size(), true);
  }
  return s;
}

void writeCsv(const std::filesystem::path& path, const std::vector<std::string>& columns,
              const std::vector<std::vector<double>>& rows) {
  writeOwnFile(path, formatCsv(columns, rows));
}

}  // namespace gambeson
